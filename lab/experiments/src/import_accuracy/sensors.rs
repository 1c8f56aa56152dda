//! Simulated sensors: what an accelerometer, a force sensor and a device write to files.

use std::{
    fmt::Write as _,
    fs,
    io::{self, Write as _},
    path::Path,
};

use asperity::model::{TapBank, TextureModel};
use asperity_recording::signal::{
    filter::{derivative, low_pass},
    resample::{Clock, resample},
};
use rand_core::SeedableRng;
use rand_xoshiro::Xoshiro256PlusPlus;

use super::{
    perform::Performance,
    tool::{self, Resonance},
};
use asperity_sim::random::unit;

/// Rate of the ticks, Hz.
const TICK_HZ: f64 = 1000.0;
/// Standard gravity, m/s².
pub const GRAVITY_M_S2: f64 = 9.806_65;
/// Motion of the hand ends here, Hz. What is faster is vibration, which the texture makes.
const HAND_HZ: f64 = 8.0;
/// Half the length of the filter that tells it, ticks.
pub const HAND_HALF: usize = 120;
/// Parts of the vibration along the stroke and along the normal: their squares add up to one.
const SHARES: (f64, f64) = (0.8, 0.6);
/// The part along the normal comes later: the tool bends, s.
pub const BENT_S: f64 = 0.0007;
/// Time over which the direction of a stroke is taken, ticks.
const DIRECTION: usize = 15;

/// The sensors of a bench.
#[derive(Debug, Clone, PartialEq)]
pub struct Sensors {
    /// Rate of the accelerometer, Hz.
    pub accel_hz: f64,
    /// Its range, m/s².
    pub accel_range_m_s2: f64,
    /// Its noise density, m/s²/√Hz: 80 µg/√Hz.
    pub accel_noise: f64,
    /// Its axes are turned by this about the vertical, rad.
    pub tilt_rad: f64,
    /// Rate of the force sensor, Hz.
    pub force_hz: f64,
    /// Its noise, N RMS.
    pub force_noise_n: f64,
    /// Its bias, N.
    pub force_bias_n: f64,
    /// Errors of the clocks of accelerometer, force sensor and device, as fractions.
    pub drift: [f64; 3],
    /// Delays of the same, s.
    pub late_s: [f64; 3],
    /// The resonance of the tool with the accelerometer, if it has one.
    pub resonance: Option<Resonance>,
    /// Taps on the tool in free air at the start.
    pub free_taps: usize,
    /// True if the device reports its position along z.
    pub has_height: bool,
}

impl Sensors {
    /// Sensors as one can buy them, a little different for every seed.
    #[must_use]
    pub fn seeded(seed: u64) -> Self {
        let mut rng = Xoshiro256PlusPlus::seed_from_u64(seed ^ 0x5E45_0125);
        let mut signed = || 2.0 * unit(&mut rng) - 1.0;
        Self {
            accel_hz: 5000.0,
            accel_range_m_s2: 16.0 * GRAVITY_M_S2,
            accel_noise: 80e-6 * GRAVITY_M_S2,
            tilt_rad: 0.05 * signed(),
            force_hz: 1000.0,
            force_noise_n: 0.005,
            force_bias_n: 0.05 * signed(),
            drift: [40e-6 * signed(), 40e-6 * signed(), 40e-6 * signed()],
            late_s: [0.0, 0.003 * signed(), 0.003 * signed()],
            resonance: None,
            free_taps: 0,
            has_height: true,
        }
    }
}

/// Sensor data, in the units of the files.
#[derive(Debug, Clone)]
struct Measured {
    /// m/s², at the accelerometer's rate.
    accel: [Vec<f32>; 3],
    /// N.
    force: [Vec<f32>; 3],
    /// mm.
    position: [Vec<f32>; 3],
}

/// Writes a recording of a performance into a folder.
///
/// # Errors
/// What the file system says.
pub fn record(
    performance: &Performance,
    texture: &TextureModel,
    sensors: &Sensors,
    seed: u64,
    folder: &Path,
) -> io::Result<()> {
    let measured = measure(performance, &texture.taps, sensors, seed);
    write(&measured, sensors, &texture.name, folder)
}

/// Samples of every sensor.
fn measure(performance: &Performance, taps: &TapBank, sensors: &Sensors, seed: u64) -> Measured {
    let mut rng = Xoshiro256PlusPlus::seed_from_u64(seed);
    let mut gauss = || (0..12).map(|_| unit(&mut rng)).sum::<f64>() - 6.0;
    let records = &performance.records;
    let seconds = records.len() as f64 / TICK_HZ;
    let ticks = Clock {
        start_s: 0.0,
        rate_hz: TICK_HZ,
    };
    let clock = |sensor: usize, rate_hz: f64| Clock {
        start_s: 0.0,
        rate_hz: rate_hz * (1.0 + sensors.drift[sensor]),
    };
    let column =
        |pick: &dyn Fn(usize) -> f64| -> Vec<f64> { (0..records.len()).map(pick).collect() };
    let places: Vec<[f64; 3]> = records.iter().map(|record| record.true_m).collect();
    let vibration = column(&|n| f64::from(records[n].output.vib_m_s2));
    let sources = of_tool(&places, &vibration, TICK_HZ);
    let accel_clock = clock(0, sensors.accel_hz);
    let count = (seconds * accel_clock.rate_hz) as usize;
    let as_f32 = |x: &[f64]| -> Vec<f32> { x.iter().map(|x| *x as f32).collect() };
    let mut accel = sources.map(|axis| resample(&as_f32(&axis), ticks, accel_clock, count));
    let bent = Clock {
        start_s: BENT_S,
        rate_hz: TICK_HZ,
    };
    let normal = resample(&as_f32(&across(&vibration)), bent, accel_clock, count);
    accel[2].iter_mut().zip(normal).for_each(|(a, b)| *a += b);
    for &(tick, speed_m_s) in &performance.impacts {
        add_tap(
            &mut accel[2],
            accel_clock,
            taps,
            tick as f64 / TICK_HZ,
            speed_m_s,
        );
    }
    tool::add_free_taps(&mut accel, accel_clock, sensors.free_taps);
    if let Some(resonance) = sensors.resonance {
        for axis in &mut accel {
            *axis = resonance.felt(axis, sensors.accel_hz);
        }
    }
    let (sin, cos) = libm::sincos(sensors.tilt_rad);
    let turned: Vec<(f64, f64)> = accel[0]
        .iter()
        .zip(&accel[1])
        .map(|(x, y)| (cos * x - sin * y, sin * x + cos * y))
        .collect();
    (accel[0], accel[1]) = turned.into_iter().unzip();
    let noise = sensors.accel_noise * (0.5 * sensors.accel_hz).sqrt();
    let accel = accel.map(|axis| {
        axis.into_iter()
            .map(|a| (a + noise * gauss()) as f32)
            .collect()
    });
    let force_clock = clock(1, sensors.force_hz);
    let count = (seconds * force_clock.rate_hz) as usize;
    let force = [0, 1, 2].map(|axis| {
        let source = as_f32(&column(&|n| f64::from(records[n].output.force_n[axis])));
        let bias = if axis == 2 {
            sensors.force_bias_n
        } else {
            0.3 * sensors.force_bias_n
        };
        let samples = resample(&source, ticks, force_clock, count);
        samples
            .into_iter()
            .map(|f| (f + bias + sensors.force_noise_n * gauss()) as f32)
            .collect()
    });
    let position = [0, 1, 2].map(|axis| {
        records
            .iter()
            .map(|r| (1e3 * r.measured_m[axis]) as f32)
            .collect()
    });
    Measured {
        accel,
        force,
        position,
    }
}

/// Acceleration of the tool at every tick without what comes later along the normal, m/s²: the slow
/// motion of the hand, gravity, and the vibration along the stroke.
pub fn of_tool(places_m: &[[f64; 3]], vibration: &[f64], rate_hz: f64) -> [Vec<f64>; 3] {
    let count = places_m.len();
    // Where the stroke goes.
    let along = |n: usize, axis: usize| {
        let (ahead, behind) = ((n + DIRECTION).min(count - 1), n.saturating_sub(DIRECTION));
        let step = |axis: usize| places_m[ahead][axis] - places_m[behind][axis];
        let length = libm::hypot(step(0), step(1));
        if length > 1e-7 {
            step(axis) / length
        } else {
            0.0
        }
    };
    let mut sources = [0, 1, 2].map(|axis| {
        let axis_m: Vec<f64> = places_m.iter().map(|place_m| place_m[axis]).collect();
        let slow = low_pass(&axis_m, HAND_HZ / rate_hz, HAND_HALF);
        let accel = derivative(&derivative(&slow));
        let felt = |n: usize| {
            let felt = if axis < 2 {
                SHARES.0 * vibration[n] * along(n, axis)
            } else {
                0.0
            };
            accel[n] * rate_hz * rate_hz + felt
        };
        (0..count).map(felt).collect::<Vec<f64>>()
    });
    sources[2].iter_mut().for_each(|a| *a += GRAVITY_M_S2);
    sources
}

/// The part of the vibration along the normal, which comes [`BENT_S`] later, m/s².
pub fn across(vibration: &[f64]) -> Vec<f64> {
    vibration.iter().map(|v| SHARES.1 * v).collect()
}

/// Adds the transient of an impact.
fn add_tap(accel: &mut [f64], clock: Clock, taps: &TapBank, at_s: f64, speed_m_s: f64) {
    let Some(trace) = tap_at(taps, speed_m_s) else {
        return;
    };
    // Silence on both sides, so that the interpolation has no edge.
    let lead = 400;
    let mut padded = vec![0.0_f32; lead];
    padded.extend(trace.iter().map(|a| *a as f32));
    padded.extend(vec![0.0; lead]);
    let from = Clock {
        start_s: at_s - lead as f64 / taps.sample_rate_hz,
        rate_hz: taps.sample_rate_hz,
    };
    let first = clock.sample(from.start_s).ceil().max(0.0) as usize;
    let count = (padded.len() as f64 / taps.sample_rate_hz * clock.rate_hz) as usize;
    let to = Clock {
        start_s: clock.time_s(first as f64),
        rate_hz: clock.rate_hz,
    };
    for (n, a) in resample(&padded, from, to, count).into_iter().enumerate() {
        if let Some(sum) = accel.get_mut(first + n) {
            *sum += a;
        }
    }
}

/// The transient of a bank at an impact speed, as the runtime mixes it.
pub(super) fn tap_at(taps: &TapBank, speed_m_s: f64) -> Option<Vec<f64>> {
    let traces = &taps.traces;
    let scaled = |trace: &asperity::model::TapTrace| {
        trace
            .accel_m_s2
            .iter()
            .map(|a| a * speed_m_s / trace.speed_m_s)
            .collect()
    };
    let above = traces.iter().position(|trace| trace.speed_m_s >= speed_m_s);
    match above {
        None => traces.last().map(|last| last.accel_m_s2.clone()),
        Some(0) => traces.first().map(scaled),
        Some(n) => {
            let (low, high) = (&traces[n - 1], &traces[n]);
            let w = (speed_m_s - low.speed_m_s) / (high.speed_m_s - low.speed_m_s);
            Some(
                low.accel_m_s2
                    .iter()
                    .zip(&high.accel_m_s2)
                    .map(|(a, b)| (1.0 - w) * a + w * b)
                    .collect(),
            )
        }
    }
}

/// Writes the files: acceleration as WAV of 24 bits, force as NumPy, position as CSV.
fn write(measured: &Measured, sensors: &Sensors, name: &str, folder: &Path) -> io::Result<()> {
    let spec = hound::WavSpec {
        channels: 3,
        sample_rate: sensors.accel_hz as u32,
        bits_per_sample: 24,
        sample_format: hound::SampleFormat::Int,
    };
    let full = libm::ldexp(1.0, 23) - 1.0;
    let to_io = |error: hound::Error| io::Error::other(error);
    let mut wav = hound::WavWriter::create(folder.join("accel.wav"), spec).map_err(to_io)?;
    for n in 0..measured.accel[0].len() {
        for axis in &measured.accel {
            let part = (f64::from(axis[n]) / sensors.accel_range_m_s2).clamp(-1.0, 1.0);
            wav.write_sample((part * full).round() as i32)
                .map_err(to_io)?;
        }
    }
    wav.finalize().map_err(to_io)?;

    let count = measured.force[0].len();
    let mut npy = io::BufWriter::new(fs::File::create(folder.join("force.npy"))?);
    let header = format!("{{'descr': '<f4', 'fortran_order': False, 'shape': ({count}, 3), }}");
    let padded = format!("{header:<117}\n");
    npy.write_all(b"\x93NUMPY\x01\x00")?;
    npy.write_all(&(padded.len() as u16).to_le_bytes())?;
    npy.write_all(padded.as_bytes())?;
    for n in 0..count {
        for axis in &measured.force {
            npy.write_all(&axis[n].to_le_bytes())?;
        }
    }
    npy.flush()?;

    let mut csv = String::from(if sensors.has_height {
        "time_s,x,y,z\n"
    } else {
        "time_s,x,y\n"
    });
    let period_s = (1.0 + sensors.drift[2]) / TICK_HZ;
    for n in 0..measured.position[0].len() {
        let [x, y, z] = [0, 1, 2].map(|axis| measured.position[axis][n]);
        // Writing to a string cannot fail.
        let time_s = n as f64 * period_s + sensors.late_s[2];
        let _ = write!(csv, "{time_s:.6},{x:.4},{y:.4}");
        if sensors.has_height {
            let _ = write!(csv, ",{z:.4}");
        }
        csv.push('\n');
    }
    fs::write(folder.join("position.csv"), csv)?;
    fs::write(folder.join("recording.toml"), description(sensors, name))
}

fn description(sensors: &Sensors, name: &str) -> String {
    let mut text = format!(
        "name = {name:?}\ndevice = \"simulated bench\"\n\n[tool]\nname = \"stylus\"\nmass_kg = 0.05\n"
    );
    let mut file = |path: &str,
                    head: &str,
                    quantity: &str,
                    unit: &str,
                    columns: &[&str],
                    more: &str| {
        let _ = writeln!(text, "\n[[file]]\npath = \"{path}\"\n{head}");
        for (column, axis) in columns.iter().zip(["x", "y", "z"]) {
            let _ = writeln!(
                text,
                "[[file.channel]]\ncolumn = {column}\nquantity = \"{quantity}\"\naxis = \"{axis}\"\nunit = \"{unit}\"\n{more}"
            );
        }
    };
    let scale = format!("scale = {}\n", sensors.accel_range_m_s2);
    file(
        "accel.wav",
        "",
        "acceleration",
        "m/s^2",
        &["0", "1", "2"],
        &scale,
    );
    let head = format!(
        "rate_hz = {}\nstart_s = {:.6}",
        sensors.force_hz, sensors.late_s[1]
    );
    file("force.npy", &head, "force", "N", &["0", "1", "2"], "");
    let columns = ["\"x\"", "\"y\"", "\"z\""];
    file(
        "position.csv",
        "clock = \"time_s\"",
        "position",
        "mm",
        &columns[..if sensors.has_height { 3 } else { 2 }],
        "",
    );
    text
}
