//! Assets for the AudioWorklet: resampled to a rate that divides its own, and without a picture.

use asperity::{
    driver,
    emit::{lower::LowerError, raise::raise, sections::without_preview},
    passes::rerate::RATE_RANGE_HZ,
    pipeline::Request,
    sources::{SourceOutput, Tools},
};
use asperity_formats::{Asset, EncodeError};
use asperity_io::diagnostic::Failure;
use asperity_runtime::ticks_per_sample;

/// Rate at which the worklet ticks, Hz.
const TICK_HZ: u16 = 16_000;
/// Most ticks for a sample of the models.
const MOST_TICKS: u16 = 20;

/// The rate at which the worklet renders models of this rate, Hz: their own where the runtime serves it, else the
/// nearest whole one that it serves and that models can be converted to.
pub(crate) fn rate_hz(own_hz: f64) -> f64 {
    if ticks_per_sample(own_hz as f32, f32::from(TICK_HZ)).is_some() {
        return own_hz;
    }
    let (low, high) = RATE_RANGE_HZ;
    (1..=MOST_TICKS)
        .filter(|ticks| TICK_HZ.is_multiple_of(*ticks))
        .map(|ticks| f64::from(TICK_HZ / ticks))
        .filter(|rate_hz| (low..=high).contains(rate_hz))
        .min_by(|a, b| (a - own_hz).abs().total_cmp(&(b - own_hz).abs()))
        .unwrap_or(own_hz)
}

/// The asset for the worklet.
///
/// # Errors
/// Where its models cannot be converted, or ring at the other rate.
pub(crate) fn worklet_asset(bytes: &[u8]) -> Result<Vec<u8>, Failure> {
    let unreadable = |error| LowerError::from(EncodeError::from(error));
    let asset = Asset::parse(bytes).map_err(unreadable)?;
    let own_hz = f64::from(asset.grid().sample_rate_hz());
    let rate_hz = rate_hz(own_hz);
    if rate_hz == own_hz {
        return Ok(without_preview(bytes).map_err(LowerError::from)?);
    }
    let request = Request {
        rate_hz: Some(rate_hz),
        ..Request::default()
    };
    let source = SourceOutput::new(raise(&asset));
    let compiled = driver::compile(&source, &request, &Tools::default())?;
    Ok(compiled.lowered.bytes)
}

#[cfg(test)]
mod tests {
    use super::*;
    use asperity::{emit::lower::lower, sources::builtin};

    #[test]
    fn rates_that_divide_16_khz_stay_and_others_move_to_the_nearest() {
        for (own_hz, worklet_hz) in [
            (800.0, 800.0),
            (1000.0, 1000.0),
            (3200.0, 3200.0),
            (16_000.0, 16_000.0),
            (500.0, 800.0),
            (1300.0, 1600.0),
            (1299.0, 1000.0),
            (1500.0, 1600.0),
            (10_000.0, 2000.0),
        ] {
            assert_eq!(rate_hz(own_hz), worklet_hz, "{own_hz} Hz");
        }
    }

    #[test]
    fn the_worklet_gets_no_picture_and_a_rate_that_it_serves() {
        let texture = builtin::texture();
        let plain = lower(&texture, None).unwrap().bytes;
        let with = lower(&texture, Some(b"\x89PNG\r\n\x1a\n and pixels"))
            .unwrap()
            .bytes;
        assert_eq!(worklet_asset(&with).unwrap(), plain);
        let request = Request {
            rate_hz: Some(1500.0),
            ..Request::default()
        };
        let slower =
            driver::compile(&SourceOutput::new(texture), &request, &Tools::default()).unwrap();
        let served = worklet_asset(&slower.lowered.bytes).unwrap();
        let served = Asset::parse(&served).unwrap();
        assert_eq!(served.grid().sample_rate_hz(), 1600.0);
        assert!(served.preview_png().is_none());
        assert!(worklet_asset(&plain[1..]).is_err());
    }
}
