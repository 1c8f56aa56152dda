//! From a texture model to verified bytes, pass by pass.
//!
//! The [driver](crate::driver) takes a texture through all of them. Each is a method, so that a
//! search over fidelities, as for a [scene](crate::scene), runs the same passes in another order.
//! Every pass is named and timed.
//!
//! ```
//! use asperity::{sources::builtin, pipeline::{Pass, Pipeline}, passes::reduce::Fidelity};
//!
//! let mut pipeline = Pipeline::default();
//! let reduced = pipeline.reduce(&builtin::texture(), Fidelity::Auto).texture;
//! let lowered = pipeline.lower(&reduced, None)?;
//! pipeline.verify(&reduced, &lowered.bytes)?;
//! let passes: Vec<Pass> = pipeline.timings().iter().map(|(pass, _)| pass).collect();
//! assert_eq!(passes, [Pass::Reduce, Pass::Lower, Pass::Verify]);
//! # Ok::<(), asperity::pipeline::PipelineError>(())
//! ```

mod error;
mod timings;

pub use error::PipelineError;
pub use timings::{Clock, Pass, Timings};

use crate::{
    edit_memory::{Memory, remember},
    emit::{
        lower::{self, LowerError, Lowered},
        raise::raise,
        verify::{self, VerifyError, VerifyReport},
    },
    passes::{
        ceiling,
        reduce::{self, Fidelity, Reduction},
        rerate,
        stabilise::stabilise,
    },
    views::preview,
};
use asperity_formats::Asset;
use asperity_texture::model::{ModelGrid, TextureModel};

/// Fractions of the way to white noise that are tried in turn on a texture that rings.
const STABILISED: [f64; 4] = [0.25, 0.5, 0.75, 1.0];

/// Options common to all textures, whatever their source.
#[derive(Debug, Clone, PartialEq)]
pub struct Request {
    /// Name of the texture; that of the source if `None`.
    pub name: Option<String>,
    /// Level that the vibration is brought to, dB re 1 N RMS; none is if `None`.
    pub loudness_db: Option<f64>,
    /// Fidelity of the asset to the models.
    pub fidelity: Fidelity,
    /// Rate of the models, Hz; that of the source if `None`.
    pub rate_hz: Option<f64>,
    /// Rate of the servo loop that it is for, Hz: models whose own rate does not divide it are
    /// converted to it. `None` for any loop.
    pub servo_rate_hz: Option<f64>,
    /// Width and height of the preview, pixels; none is drawn if `None`.
    pub preview_px: Option<u32>,
}

impl Default for Request {
    fn default() -> Self {
        Self {
            name: None,
            loudness_db: None,
            fidelity: Fidelity::Full,
            rate_hz: None,
            servo_rate_hz: None,
            preview_px: None,
        }
    }
}

impl Request {
    /// The rate that models at `own_hz` are converted to; `None` where they keep theirs.
    pub(crate) fn conversion(&self, own_hz: f64) -> Option<f64> {
        let unserved = |servo_hz: &f64| !serves(*servo_hz, own_hz);
        self.rate_hz.or(self.servo_rate_hz.filter(unserved))
    }
}

/// Returns true if models at `model_hz` keep their own rate in a servo loop at `servo_hz`.
pub(crate) fn serves(servo_hz: f64, model_hz: f64) -> bool {
    asperity_runtime::ticks_per_sample(model_hz as f32, servo_hz as f32).is_some()
}

/// Treatment of a texture that rings without bound in motion.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Ringing {
    /// It is an error.
    Refused,
    /// Its models are moved towards white noise. The numerator has to be 1 + z⁻¹.
    Stabilised,
}

/// Contents of an asset besides its texture.
pub(crate) struct Attachments<'a> {
    /// A picture in the place of a preview.
    pub(crate) picture: Option<&'a [u8]>,
    pub(crate) memory: Option<&'a Memory>,
}

/// A texture that passed verification.
pub(crate) struct Passed {
    pub(crate) whole: TextureModel,
    pub(crate) texture: TextureModel,
    pub(crate) reduction: reduce::Report,
    pub(crate) preview: Option<Vec<u8>>,
    pub(crate) lowered: Lowered,
    pub(crate) verified: VerifyReport,
    pub(crate) stabilised: f64,
}

/// Runs passes and times them.
#[derive(Debug, Clone, Default)]
pub struct Pipeline {
    clock: Clock,
    timings: Timings,
}

impl Pipeline {
    /// Creates a pipeline that times its passes by a clock.
    #[must_use]
    pub fn timed(clock: Clock) -> Self {
        Self {
            clock,
            timings: Timings::default(),
        }
    }

    /// Creates a pipeline with the same clock, for another thread.
    pub(crate) fn another(&self) -> Self {
        Self::timed(self.clock)
    }

    /// Takes a model through all passes.
    pub(crate) fn compile(
        &mut self,
        mut whole: TextureModel,
        request: &Request,
        ringing: Ringing,
        attachments: &Attachments<'_>,
    ) -> Result<Passed, PipelineError> {
        whole.provenance.fidelity = request.fidelity.to_string();
        whole.grid = self.converted(whole.grid, request)?;
        if ringing == Ringing::Refused {
            return self.attempt(whole, 0.0, request, attachments);
        }
        let mut result = self.attempt(whole.clone(), 0.0, request, attachments);
        for fraction in STABILISED {
            match &result {
                Err(error) if error.rings() => {
                    let stabilised = self.stabilise(&whole, fraction);
                    result = self.attempt(stabilised, fraction, request, attachments);
                }
                _ => break,
            }
        }
        result
    }

    fn attempt(
        &mut self,
        whole: TextureModel,
        stabilised: f64,
        request: &Request,
        attachments: &Attachments<'_>,
    ) -> Result<Passed, PipelineError> {
        let Reduction {
            mut texture,
            report,
        } = self.reduce(&whole, request.fidelity);
        self.run(Pass::Ceiling, || ceiling::limit(&mut texture));
        let preview = match (attachments.picture, request.preview_px) {
            (Some(png), _) => Some(png.to_owned()),
            (None, Some(size_px)) => Some(self.preview(&texture, size_px)?),
            (None, None) => None,
        };
        let mut lowered = self.lower(&texture, preview.as_deref())?;
        if let Some(memory) = attachments.memory {
            let remembering = self.run(Pass::Lower, || remember(&lowered.bytes, memory));
            lowered.set_bytes(remembering.map_err(LowerError::from)?)?;
        }
        let verified = self.verify(&texture, &lowered.bytes)?;
        Ok(Passed {
            whole,
            texture,
            reduction: report,
            preview,
            lowered,
            verified,
            stabilised,
        })
    }

    /// The grid at the rate that is asked for.
    pub(crate) fn converted(
        &mut self,
        grid: ModelGrid,
        request: &Request,
    ) -> Result<ModelGrid, PipelineError> {
        let from_hz = grid.sample_rate_hz;
        let Some(to_hz) = request.conversion(from_hz) else {
            return Ok(grid);
        };
        self.rerate(&grid, to_hz)
            .map_err(|error| match request.rate_hz {
                Some(_) => error,
                None => PipelineError::ServoRate { from_hz, to_hz },
            })
    }

    /// The grid with its models at another rate.
    ///
    /// # Errors
    /// [`PipelineError::Rate`] for a rate that the models cannot have.
    pub fn rerate(&mut self, grid: &ModelGrid, rate_hz: f64) -> Result<ModelGrid, PipelineError> {
        let rerated = self.run(Pass::Rerate, || rerate::rerate(grid, rate_hz));
        rerated.ok_or(PipelineError::Rate(rate_hz))
    }

    /// The texture with its models moved this fraction of the way to white noise.
    pub fn stabilise(&mut self, texture: &TextureModel, fraction: f64) -> TextureModel {
        self.run(Pass::Stabilise, || stabilise(texture, fraction))
    }

    /// The texture at a fidelity.
    pub fn reduce(&mut self, texture: &TextureModel, fidelity: Fidelity) -> Reduction {
        self.run(Pass::Reduce, || reduce::reduce(texture, fidelity))
    }

    /// A preview of the texture as PNG. It is drawn from what an asset keeps of the texture, so
    /// that it can be drawn again from the asset.
    ///
    /// # Errors
    /// [`PipelineError`] for a size that pictures cannot have, and for a texture that does not fit
    /// an asset.
    pub fn preview(
        &mut self,
        texture: &TextureModel,
        size_px: u32,
    ) -> Result<Vec<u8>, PipelineError> {
        self.run(Pass::Preview, || {
            let lowered = lower::lower(texture, None)?;
            let asset = Asset::parse(&lowered.bytes).map_err(VerifyError::from)?;
            Ok(preview::png(&raise(&asset), size_px)?)
        })
    }

    /// The texture as the bytes of an asset.
    ///
    /// # Errors
    /// [`PipelineError::Lower`] for a texture that does not fit an asset.
    pub fn lower(
        &mut self,
        texture: &TextureModel,
        preview_png: Option<&[u8]>,
    ) -> Result<Lowered, PipelineError> {
        Ok(self.run(Pass::Lower, || lower::lower(texture, preview_png))?)
    }

    /// Verifies the bytes of a texture with the runtime itself.
    ///
    /// # Errors
    /// [`PipelineError::Verify`] for an asset that is not fit to be felt.
    pub fn verify(
        &mut self,
        texture: &TextureModel,
        bytes: &[u8],
    ) -> Result<VerifyReport, PipelineError> {
        Ok(self.run(Pass::Verify, || verify::verify(texture, bytes))?)
    }

    /// Does what a source calls a pass.
    pub fn run<T>(&mut self, pass: Pass, work: impl FnOnce() -> T) -> T {
        let start = (self.clock.0)();
        let result = work();
        let took = (self.clock.0)().saturating_sub(start);
        self.timings.add(pass, took);
        result
    }

    /// Adds the times of another pipeline, such as that of another thread.
    pub fn merge(&mut self, other: &Timings) {
        self.timings.merge(other);
    }

    /// The passes that ran, with their times.
    #[must_use]
    pub fn timings(&self) -> &Timings {
        &self.timings
    }
}
