//! From the heights of a surface to the vibration of a tip that is stroked over it.
//!
//! 1. [`map`]: a picture of heights is read and checked, and becomes [`heights`] on a grid.
//! 2. [`contact`]: the contact of a tip averages heights, and the tip rolls over the crests that are left.
//! 3. [`wave_spectrum`]: the power of heights by wave vector, its axis, and its spectrum along a direction.
//! 4. [`stroke`]: at a speed, heights become accelerations of a [`stylus`] in a hand.
//! 5. [`direction`]: the ratios by which strokes along an axis follow from those across it.
//! 6. [`vibration`]: sampled power spectra, and the AR model of one.
//!
//! The corpus's generator shares [`stylus`] and [`vibration`] with the import of surfaces; its contact is fitted to strokes.
//!
//! ```
//! use asperity_surface::{
//!     contact::{Contact, Tip}, heights::HeightField, stroke::Strokes, stylus::Support, wave_spectrum::WaveSpectrum,
//! };
//!
//! // A grating of 1 mm and 1 µm, 20 mm wide; a stroke in x at 100 mm/s meets it at 100 Hz.
//! let heights = (0..400 * 400).map(|n| (std::f32::consts::TAU * (n % 400) as f32 / 20.0).sin());
//! let field = HeightField::new(400, [0.05, 0.05], heights.collect()).expect("a field");
//! let (support, speed_mm_s) = (Support { modulus_mpa: 1e3, loss_factor: 0.1, force_n: 1.0 }, 100.0);
//! let waves = WaveSpectrum::of(&Contact::with(&field.levelled()).followed(&Tip::STYLUS, &support));
//! let power = Strokes::over(&waves.along(waves.across_rad())).power(speed_mm_s, &support);
//! let loudest = (0..power.len()).max_by(|&a, &b| power[a].total_cmp(&power[b])).expect("a point");
//! assert!((asperity_surface::vibration::freq_hz(loudest) / 100.0 - 1.0).abs() < 0.1);
//! ```
#![forbid(unsafe_code)]

pub mod contact;
pub mod direction;
pub mod heights;
pub mod map;
mod plane;
mod staircase;
pub mod stroke;
pub mod stylus;
pub mod vibration;
pub mod wave_spectrum;
