//! A texture with a picture that was made elsewhere.

use super::Authored;
use crate::pipeline::{Pipeline, PipelineError};

impl Authored {
    /// Puts a picture into the asset, and says in its notes what made it: `by diffusion: …`. The
    /// asset is verified again.
    ///
    /// # Errors
    /// [`PipelineError`] as for every other asset.
    pub fn illustrate(&mut self, png: Vec<u8>, made: &str) -> Result<(), PipelineError> {
        let notes = &mut self.texture.provenance.notes;
        *notes = format!("{notes} Preview {made}.").trim().to_owned();
        let mut pipeline = Pipeline::default();
        self.lowered = pipeline.lower(&self.texture, Some(&png))?;
        self.verified = pipeline.verify(&self.texture, &self.lowered.bytes)?;
        self.timings.merge(pipeline.timings());
        self.preview = Some(png);
        Ok(())
    }
}
