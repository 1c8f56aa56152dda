//! The target of the fuzzer: any bytes as an asset, and any numbers as samples.

use crate::{damage::seal, force_limits::ForceLimits};
use asperity_formats::{Asset, Library};
use asperity_runtime::{Config, HostTexture, Renderer, Sample, State};

/// Result of a case.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Outcome {
    /// The bytes were refused.
    Refused,
    /// The asset was loaded and this many samples were rendered.
    Rendered(usize),
}

/// Reads `data` as a library and as an asset, loads it, and renders samples that are made of
/// its bytes. If the first byte is odd, the CRCs of the asset are recomputed before.
///
/// # Panics
/// If a force leaves the limits, a weight leaves [0, 1], or the force does not come back
/// after good samples. The fuzzer looks for such panics.
pub fn load_then_tick(data: &[u8]) -> Outcome {
    let Some((&first, asset)) = data.split_first() else {
        return Outcome::Refused;
    };
    if let Ok(library) = Library::parse(asset) {
        for index in 0..library.index().len() {
            let _ = library.asset(index);
        }
    }
    let mut asset = asset.to_vec();
    if first % 2 == 1 {
        seal(&mut asset);
    }
    let _ = Asset::parse_haptic(&asset);
    let Ok(parsed) = Asset::parse(&asset) else {
        return Outcome::Refused;
    };
    let config = Config {
        servo_rate_hz: parsed.grid().sample_rate_hz().clamp(100.0, 20_000.0),
        ..Config::default()
    };
    let Ok(renderer) = Renderer::new(&config) else {
        return Outcome::Refused;
    };
    let mut texture = Box::new(HostTexture::new());
    if texture.load(&parsed, config.servo_rate_hz).is_err() {
        return Outcome::Refused;
    }
    queries(&texture, data);
    let mut state = State::new(u64::from(first));
    let mut limits = ForceLimits::new(&config);
    let mut render = |state: &mut State, sample: &Sample| {
        limits.check(&renderer.tick(&texture, state, sample));
    };
    let mut rendered = 0;
    for chunk in data.chunks_exact(13).rev().take(200) {
        let number = |i: usize| {
            let bits = [chunk[i], chunk[i + 1], chunk[i + 2], chunk[i + 3]];
            f32::from_le_bytes(bits)
        };
        let wild = chunk[12] % 4 == 0;
        // Most samples stay near the surface, where there are contacts and taps.
        let near = |i: usize| f32::from(chunk[i] as i8) * 1e-4;
        let sample = Sample {
            position_m: if wild {
                [number(0), number(4), number(8)]
            } else {
                [near(0), near(4), near(8)]
            },
            elapsed_ticks: if wild { u32::from(chunk[12]) / 64 } else { 1 },
        };
        render(&mut state, &sample);
        rendered += 1;
    }
    // After any samples, good samples out of contact lead to zero force.
    let step_n = config.limits.slew_n_s / config.servo_rate_hz;
    let ticks = (config.limits.peak_n / step_n) as usize + texture.taps().ticks() + 10;
    for _ in 0..ticks {
        render(&mut state, &Sample::at([0.0, 0.0, 0.1]));
    }
    let last = limits.last_n();
    assert!(last.iter().all(|f| f.abs() < 1e-6), "no recovery: {last:?}");
    Outcome::Rendered(rendered)
}

fn queries(texture: &HostTexture, data: &[u8]) {
    for pair in data.chunks_exact(8).take(100) {
        let number =
            |i: usize| f32::from_le_bytes([pair[i], pair[i + 1], pair[i + 2], pair[i + 3]]);
        for (speed, force) in [
            (number(0), number(4)),
            (f32::from(pair[0]), f32::from(pair[4]) * 0.02),
            (0.0, 0.0),
        ] {
            let query = texture.weights_at(speed, force);
            let sum: f32 = query.values().iter().sum();
            assert!(
                query.values().iter().all(|w| (0.0..=1.0).contains(w)) && (sum - 1.0).abs() < 1e-5,
                "({speed}, {force}): {query:?}"
            );
            let filter = texture.filter_at(speed, force);
            assert!(
                filter.a.iter().chain(&filter.b).all(|c| c.is_finite())
                    && filter.level_m_s2.is_finite(),
                "({speed}, {force}): {filter:?}"
            );
        }
    }
}
