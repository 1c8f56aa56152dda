//! Faults that people make, seeded.

use std::{io, path::Path};

use asperity::model::TextureModel;
use asperity_recording::check::{Checked, Kind, Severity};
use rand_core::SeedableRng;
use rand_xoshiro::Xoshiro256PlusPlus;

use super::{
    perform::Performance,
    sensors::{Measured, Sensors, measure, write},
};
use asperity_sim::random::unit;

/// A fault of a recording.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum RecordingFault {
    /// The accelerometer or the force sensor saturates.
    Clipping,
    /// A channel holds, zeroes or loses its values for some tens of milliseconds, several times.
    DropOuts,
    /// A file comes 20 ms early or late.
    Misaligned,
    /// g for m/s², or kilogram-force for newton, or the other way round.
    By9Point81,
    /// Millimetres for metres, millinewtons for newtons, milli-g for g, or the other way round.
    By1000,
}

impl RecordingFault {
    /// All of them.
    pub const ALL: [Self; 5] = [
        Self::Clipping,
        Self::DropOuts,
        Self::Misaligned,
        Self::By9Point81,
        Self::By1000,
    ];

    /// Returns the kind of finding that the check must report.
    #[must_use]
    pub fn kind(self) -> Kind {
        match self {
            Self::Clipping => Kind::Clipping,
            Self::DropOuts => Kind::DropOut,
            Self::Misaligned => Kind::Delay,
            Self::By9Point81 | Self::By1000 => Kind::Unit,
        }
    }

    /// Returns true if a check found the fault and named its channel or file.
    #[must_use]
    pub fn is_named(self, checked: &Checked, file: &str) -> bool {
        checked
            .at_least(Severity::Warning)
            .any(|finding| finding.kind == self.kind() && finding.file == file)
    }
}

/// Writes a recording with a fault into a folder, and gives the file that has it.
///
/// # Errors
/// What the file system says.
pub fn faulty(
    performance: &Performance,
    texture: &TextureModel,
    fault: RecordingFault,
    seed: u64,
    folder: &Path,
) -> io::Result<&'static str> {
    let mut sensors = Sensors::seeded(seed);
    let mut measured = measure(performance, &texture.taps, &sensors, seed);
    let mut rng = Xoshiro256PlusPlus::seed_from_u64(seed ^ 0xFA01_7000);
    let mut pick = |count: usize| (unit(&mut rng) * count as f64) as usize;
    let file = match fault {
        RecordingFault::Clipping => {
            let (axes, file) = if pick(2) == 0 {
                (&mut measured.accel, "accel.wav")
            } else {
                (&mut measured.force, "force.npy")
            };
            // The normal axis of the force; any axis of the accelerometer.
            let axis = if file == "force.npy" { 2 } else { pick(3) };
            clip(&mut axes[axis], 0.45 + 0.04 * pick(6) as f64);
            file
        }
        RecordingFault::DropOuts => {
            let (axes, file, rate) = match pick(3) {
                0 => (&mut measured.accel, "accel.wav", sensors.accel_hz),
                1 => (&mut measured.force, "force.npy", sensors.force_hz),
                _ => (&mut measured.position, "position.csv", 1000.0),
            };
            let how = pick(if file == "accel.wav" { 2 } else { 3 });
            for _ in 0..6 {
                let (start, length) = (
                    pick(axes[0].len() * 9 / 10),
                    ((0.02 + 0.005 * pick(9) as f64) * rate) as usize,
                );
                for axis in axes.iter_mut() {
                    let held = [axis[start], 0.0, f32::NAN][how];
                    axis[start..start + length].fill(held);
                }
            }
            file
        }
        RecordingFault::Misaligned => {
            let which = 1 + pick(2);
            let late_s = if pick(2) == 0 { 0.02 } else { -0.02 };
            sensors.late_s[which] += late_s;
            ["accel.wav", "force.npy", "position.csv"][which]
        }
        RecordingFault::By9Point81 => {
            let file = if pick(2) == 0 {
                "accel.wav"
            } else {
                "force.npy"
            };
            let factor = if file == "accel.wav" || pick(2) == 0 {
                1.0 / 9.806_65
            } else {
                9.806_65
            };
            scale(&mut measured, file, factor);
            file
        }
        RecordingFault::By1000 => {
            let file = ["accel.wav", "force.npy", "position.csv"][pick(3)];
            scale(
                &mut measured,
                file,
                if file == "accel.wav" || pick(2) == 0 {
                    1e-3
                } else {
                    1e3
                },
            );
            file
        }
    };
    write(&measured, &sensors, &texture.name, folder)?;
    Ok(file)
}

/// Cuts an axis off at a part of its largest distance from its middle.
fn clip(axis: &mut [f32], part: f64) {
    let middle = axis.iter().map(|x| f64::from(*x)).sum::<f64>() / axis.len() as f64;
    let reach = axis
        .iter()
        .map(|x| (f64::from(*x) - middle).abs())
        .fold(0.0, f64::max);
    let (low, high) = (
        (middle - part * reach) as f32,
        (middle + part * reach) as f32,
    );
    axis.iter_mut().for_each(|x| *x = x.clamp(low, high));
}

fn scale(measured: &mut Measured, file: &str, factor: f64) {
    let axes = match file {
        "accel.wav" => &mut measured.accel,
        "force.npy" => &mut measured.force,
        _ => &mut measured.position,
    };
    axes.iter_mut()
        .flatten()
        .for_each(|x| *x = (f64::from(*x) * factor) as f32);
}
