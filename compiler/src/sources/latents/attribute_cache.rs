//! Attributes of latents, each part measured once: a search comes back to where it began, and moves one part while
//! the others stay.

use crate::{
    edit_memory::Latents,
    learned::{Latent, friction, texture},
    passes::reduce::{reduce_grid, reduce_taps},
    pipeline::{Pipeline, Request},
    sources::prompt::PromptCompiler,
};
use asperity_io::diagnostic::Fault;
use asperity_texture::{
    model::{
        ModelGrid, TapBank,
        attributes::{Attributes, Meter},
        defaults,
        shift::{adjust_level, adjust_taps, adjusted_mu},
    },
    signal::spectrum::Vibration,
};
use std::cell::RefCell;

/// The attributes of the latents of one search.
pub(super) struct AttributeCache<'a> {
    prompt_compiler: &'a PromptCompiler,
    request: &'a Request,
    meter: RefCell<Meter>,
    grids: Memo<Latent, ModelGrid>,
    banks: Memo<Latent, TapBank>,
    vibrations: Memo<(State, Latent, f64), Option<Vibration>>,
    centroids: Memo<(State, Latent, f64), Option<f64>>,
}

/// The state of a texture that is measured.
#[derive(Debug, Clone, Copy, PartialEq)]
enum State {
    /// All that is decoded.
    Decoded,
    /// Restricted to the contents of an asset of the request.
    Kept,
}

impl<'a> AttributeCache<'a> {
    pub(super) fn new(prompt_compiler: &'a PromptCompiler, request: &'a Request) -> Self {
        Self {
            prompt_compiler,
            request,
            meter: RefCell::default(),
            grids: Memo::default(),
            banks: Memo::default(),
            vibrations: Memo::default(),
            centroids: Memo::default(),
        }
    }

    /// The attributes of what these latents decode to, before anything is reduced.
    pub(super) fn decoded(&self, latents: &Latents) -> Result<Attributes, Fault> {
        self.attributes(latents, State::Decoded)
    }

    /// The attributes of the asset that these latents give: what is left out counts no more.
    pub(super) fn kept(&self, latents: &Latents) -> Result<Attributes, Fault> {
        self.attributes(latents, State::Kept)
    }

    fn attributes(&self, latents: &Latents, state: State) -> Result<Attributes, Fault> {
        let shift = &latents.shift;
        let vibration = self
            .vibrations
            .once(&(state, latents.slide, shift.rough_db), || {
                self.vibration(&latents.slide, shift.rough_db, state)
            })?;
        let hard_hz = self.centroids.once(&(state, latents.tap, shift.hard), || {
            self.hard_hz(&latents.tap, shift.hard, state)
        })?;
        let mu = adjusted_mu(self.mu(&latents.friction), shift.slippery);
        Ok(Attributes::of_parts(vibration, hard_hz, mu))
    }

    fn vibration(
        &self,
        slide: &Latent,
        rough_db: f64,
        state: State,
    ) -> Result<Option<Vibration>, Fault> {
        let model = self.prompt_compiler.model();
        let mut grid = self.grids.once(slide, || {
            let decoded = model.decode_grid(slide)?;
            Ok(texture::grid(&model.description().grid, &decoded))
        })?;
        adjust_level(&mut grid, rough_db);
        if state == State::Kept {
            grid = Pipeline::default().converted(grid, self.request)?;
            grid = reduce_grid(&grid, self.request.fidelity);
        }
        Ok(self.meter.borrow_mut().vibration(&grid))
    }

    fn hard_hz(&self, tap: &Latent, hard: f64, state: State) -> Result<Option<f64>, Fault> {
        let model = self.prompt_compiler.model();
        let gains = defaults::gains();
        let mut bank = self.banks.once(tap, || {
            let decoded = model.decode_taps(tap)?;
            Ok(texture::taps(model.description(), &decoded, &gains))
        })?;
        adjust_taps(&mut bank, &gains, hard);
        if state == State::Kept {
            bank = reduce_taps(&bank, self.request.fidelity);
        }
        Ok(self.meter.borrow_mut().hard_hz(&bank))
    }

    /// μ of a latent, before it is shifted.
    pub(super) fn mu(&self, z: &Latent) -> f64 {
        let description = self.prompt_compiler.model().description();
        let near = friction::neighbours(z, &description.anchors, description.friction);
        friction::mu(&near, &description.anchors)
    }
}

/// Results by key.
struct Memo<K, V>(RefCell<Vec<(K, V)>>);

impl<K, V> Default for Memo<K, V> {
    fn default() -> Self {
        Self(RefCell::default())
    }
}

impl<K: Copy + PartialEq, V: Clone> Memo<K, V> {
    /// Returns the result for this key, computing it by `find` on the first use.
    fn once(&self, key: &K, find: impl FnOnce() -> Result<V, Fault>) -> Result<V, Fault> {
        // Searches take tens of looks. A key with a NaN is looked at again.
        let known = self.0.borrow().iter().find(|(of, _)| of == key).cloned();
        if let Some((_, value)) = known {
            return Ok(value);
        }
        let value = find()?;
        self.0.borrow_mut().push((*key, value.clone()));
        Ok(value)
    }
}
