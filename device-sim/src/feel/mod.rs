//! What a session of a hand on a texture amounts to: summary, CSV, sheet, sound.

pub mod csv;
mod percentile;
pub mod resample;
mod run;
pub mod sheet;
pub mod spectrogram;
mod stroke;
pub mod summary;
mod tap;
pub mod wav;

pub use run::{FeelOptions, record};
pub use stroke::{StrokeReport, strokes};
pub use summary::Summary;
pub use tap::{TapReport, Taps, taps};

use asperity::diagnostic::Diagnostic;
use asperity_runtime::{Counters, LoadError};

use crate::device::{DeviceConfig, DeviceCounts};
use crate::hand::{Grip, Motion};
use crate::session::Record;

/// A session that has run, with all that its reports need.
#[derive(Debug, Clone)]
pub struct Recording {
    /// What was touched.
    pub texture: TextureFacts,
    /// With what.
    pub device: DeviceConfig,
    /// By whom.
    pub grip: Grip,
    /// Seed of script and excitation.
    pub seed: u64,
    /// The script; a record refers to it by index.
    pub motions: Vec<Motion>,
    /// Every tick.
    pub records: Vec<Record>,
    /// What the renderer counted.
    pub counters: Counters,
    /// What the device counted.
    pub device_counts: DeviceCounts,
    /// Slew limit of the renderer, N/s.
    pub slew_limit_n_s: f64,
}

/// What the reports say about a texture.
#[derive(Debug, Clone, PartialEq)]
pub struct TextureFacts {
    /// Its name.
    pub name: String,
    /// Where it came from: a file's name, or `built in`.
    pub origin: String,
    /// Coefficient of friction.
    pub mu: f64,
    /// Wall stiffness, N/m.
    pub stiffness_n_m: f64,
    /// Force a unit of vibration, N per m/s².
    pub vib_n_per_m_s2: f64,
    /// Fastest speed and largest force of its grid, mm/s and N.
    pub grid: (f64, f64),
    /// What a reader must know: synthetic parts, unconfirmed defaults.
    pub caveats: Vec<String>,
}

/// A span of one motion of the script, in ticks.
#[derive(Debug, Clone, Copy)]
pub struct Span<'a> {
    /// Index in the script.
    pub index: usize,
    /// The motion.
    pub motion: Motion,
    /// Its records.
    pub records: &'a [Record],
}

impl Recording {
    /// Servo period, s.
    #[must_use]
    pub fn tick_s(&self) -> f64 {
        1.0 / self.device.timing.servo_rate_hz
    }

    /// Virtual time that passed, s.
    #[must_use]
    pub fn duration_s(&self) -> f64 {
        self.records.len() as f64 * self.tick_s()
    }

    /// Vibration before device gain, m/s².
    #[must_use]
    pub fn vibration_m_s2(&self) -> Vec<f64> {
        self.records
            .iter()
            .map(|r| f64::from(r.output.vib_m_s2))
            .collect()
    }

    /// The motions that ran, each with its records.
    #[must_use]
    pub fn spans(&self) -> Vec<Span<'_>> {
        self.records
            .chunk_by(|a, b| a.intent.motion == b.intent.motion)
            .filter_map(|records| {
                let index = records.first()?.intent.motion;
                Some(Span {
                    index,
                    motion: *self.motions.get(index)?,
                    records,
                })
            })
            .collect()
    }
}

/// Why a report could not be made.
#[derive(Debug, thiserror::Error)]
pub enum FeelError {
    /// The texture does not fit the slot or the servo rate.
    #[error("the texture cannot be loaded: {0}")]
    Load(#[from] LoadError),
    /// No renderer can serve the device.
    #[error("the device cannot be served: {0}")]
    Config(#[from] asperity_runtime::ConfigError),
    /// The sheet could not be drawn.
    #[error(transparent)]
    Plot(#[from] asperity_plot::PlotError),
    /// The sound could not be encoded.
    #[error("cannot encode the sound as WAV: {0}")]
    Wav(#[from] hound::Error),
    /// The table could not be encoded.
    #[error("cannot encode the table as CSV: {0}")]
    Csv(#[from] ::csv::Error),
    /// A transform of the wrong size.
    #[error("cannot transform the vibration: {0}")]
    Transform(#[from] realfft::FftError),
}

impl Diagnostic for FeelError {
    fn remedy(&self) -> String {
        match self {
            Self::Load(LoadError::Rate { model_hz, .. }) => format!(
                "set `timing.servo_rate_hz = {model_hz}`, or 2, 3, … 20 times as much, in the device file, or make the texture for the device's rate"
            ),
            Self::Load(_) => "make the texture again with fewer vertices or a lower order".into(),
            Self::Config(_) => "change the value in the device file".into(),
            Self::Plot(_) | Self::Wav(_) | Self::Csv(_) | Self::Transform(_) => {
                "run again with fewer --seconds".into()
            }
        }
    }
}
