//! Plausibility of a calibration: its gain against the mass in the profile, its force against the device's limit, its
//! mean acceleration against gravity, its filter against the largest coefficient that a force bears.

use asperity_host::profile::Profile;
use asperity_host::profile::compensation::{Design, REFERENCE_M_S2_N};
use asperity_host::profile::response::{BAND_HZ, Response};
use asperity_recording::description::{GRAVITY_M_S2, Quantity, Unit};
use asperity_recording::signal::quantile::median;

use super::{CalibrationError, Measured};

/// Factor by which a gain may differ from that of the profile's mass: ±12 dB.
const MOST_OFF: f64 = 4.0;
/// The same once the right unit is taken.
const FITS: f64 = 2.6;
/// Largest coefficient of a filter; it multiplies the force of a vibration.
const MOST_TAP: f32 = 4.0;
/// Largest force of a sweep that moves anything, at least, N.
const LEAST_FORCE_N: f64 = 0.01;
/// Factor beyond a limit that is no rounding.
const ROUNDING: f64 = 1.01;
/// Factor beyond gravity that no sensor's error explains.
const GRAVITY_OFF: f64 = 1.25;

/// Returns the implausible parts of a calibration; empty if it is plausible. `file` names the table.
#[must_use]
pub fn doubts(
    file: &str,
    measured: &Measured,
    response: &Response,
    design: &Design,
    profile: &Profile,
) -> Vec<CalibrationError> {
    let mut doubts = Vec::new();
    let mut doubt = |what: String, remedy: String| {
        let file = file.into();
        doubts.push(CalibrationError::Implausible { file, what, remedy });
    };
    let expected = 1.0 / f64::from(profile.mechanics.mass_kg);
    let gain = median_gain(response);
    let ratio = gain / expected;
    let peak_n = f64::from(profile.limits.peak_n);
    let force_n = largest(&measured.force_n);
    let is_beyond = force_n > ROUNDING * peak_n;
    let (is_off, unit) = (
        is_beyond_factor(ratio, MOST_OFF),
        fitting(ratio, force_n, peak_n),
    );
    if let Some(unit) = unit.filter(|_| is_off) {
        let (channel, named, factor) = match unit.quantity {
            Quantity::Force => ("force_n", "N", 1.0 / unit.to_si),
            _ => ("accel_m_s2", "m/s^2", unit.to_si),
        };
        doubt(
            format!(
                "the gain is {} times too {} for {}, whose mass is {} kg; {channel} fits {} instead of \
                 {named}, a factor of {}",
                digits(ratio.max(1.0 / ratio)),
                if ratio < 1.0 { "low" } else { "high" },
                profile.name,
                profile.mechanics.mass_kg,
                unit.name,
                digits(factor.max(1.0 / factor)),
            ),
            format!("convert {channel} to {named}, or give the device's own --profile"),
        );
        return doubts;
    }
    if is_off {
        doubt(
            format!(
                "the gain is {} times too {} for {}, whose mass is {} kg, and no unit of accel_m_s2 or \
                 force_n explains it",
                digits(ratio.max(1.0 / ratio)),
                if ratio < 1.0 { "low" } else { "high" },
                profile.name,
                profile.mechanics.mass_kg,
            ),
            "check the range of the accelerometer (2, 4, 8 or 16 g), its axis, and --profile"
                .into(),
        );
    }
    if is_beyond {
        doubt(
            format!(
                "force_n reaches {} N, {} the limit of {}, {peak_n} N",
                digits(force_n),
                times(force_n / peak_n),
                profile.name
            ),
            "write the force that the device gave, in N, or give the device's own --profile".into(),
        );
    }
    let mean = measured.accel_m_s2.iter().sum::<f64>() / measured.accel_m_s2.len() as f64;
    if mean.abs() > GRAVITY_OFF * GRAVITY_M_S2 {
        doubt(
            format!(
                "accel_m_s2 is {} m/s² in the mean, {} gravity, and the tip goes nowhere",
                digits(mean),
                times(mean.abs() / GRAVITY_M_S2)
            ),
            "check the unit, the range and the bias of the accelerometer".into(),
        );
    }
    let taps = design.filter.taps.iter();
    let largest = taps.fold(0.0_f32, |most, tap| most.max(tap.abs()));
    if largest > MOST_TAP && !is_off {
        doubt(
            format!(
                "the filter has a coefficient of {}, and {MOST_TAP} is the most that a force bears; \
                 the gain is {} below the reference",
                digits(f64::from(largest)),
                times(REFERENCE_M_S2_N / gain),
            ),
            "check accel_m_s2 and force_n; a heavy device takes it with --force".into(),
        );
    }
    doubts
}

/// Gain in the middle of the band, m/s² a newton.
pub fn median_gain(response: &Response) -> f64 {
    let in_band = |freq_hz: f64| (BAND_HZ.0..=BAND_HZ.1).contains(&freq_hz);
    let band = response
        .points
        .iter()
        .filter(|point| in_band(point.freq_hz));
    median(band.map(|point| point.gain_m_s2_n))
}

fn is_beyond_factor(ratio: f64, factor: f64) -> bool {
    !(1.0 / factor..=factor).contains(&ratio)
}

fn largest(values: &[f64]) -> f64 {
    values.iter().fold(0.0, |most, value| most.max(value.abs()))
}

/// The unit of one channel with which the gain fits best, and the force is one of the device.
fn fitting(ratio: f64, force_n: f64, peak_n: f64) -> Option<Unit> {
    let named = |name| {
        let mut quantities = [Quantity::Acceleration, Quantity::Force].into_iter();
        quantities.find_map(|quantity| Unit::named(name, quantity))
    };
    let names = ["g", "mg", "mm/s^2", "mN", "kN", "kgf", "gf"];
    let units = names.into_iter().filter_map(named);
    let corrected = |unit: &Unit| match unit.quantity {
        Quantity::Force => (ratio / unit.to_si, force_n * unit.to_si),
        _ => (ratio * unit.to_si, force_n),
    };
    let fits = units.filter(|unit| {
        let (ratio, force_n) = corrected(unit);
        !is_beyond_factor(ratio, FITS) && (LEAST_FORCE_N..=ROUNDING * peak_n).contains(&force_n)
    });
    let off = |unit: &Unit| libm::log(corrected(unit).0).abs();
    fits.min_by(|a, b| off(a).total_cmp(&off(b)))
}

/// A number with three digits.
fn digits(value: f64) -> String {
    match value.abs() {
        100.0.. => format!("{value:.0}"),
        10.0..100.0 => format!("{value:.1}"),
        _ => format!("{value:.2}"),
    }
}

fn times(factor: f64) -> String {
    format!("{} times", digits(factor))
}
