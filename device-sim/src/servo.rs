//! Servos: whatever answers a measured position with a force.

use asperity_runtime::{Flags, HostTexture, Output, Renderer, Sample, State};

/// Answers one sample with one output, once in a servo tick.
///
/// Implementations stack: a [`FaultInjector`](crate::fault::FaultInjector) is a servo around a
/// servo.
pub trait Servo {
    /// Answers one tick. `sample.elapsed_ticks` is 0 for a sample that is not new.
    fn tick(&mut self, sample: &Sample) -> Output;
}

impl<F: FnMut(&Sample) -> Output> Servo for F {
    fn tick(&mut self, sample: &Sample) -> Output {
        self(sample)
    }
}

/// The runtime with a texture in its slot, as it runs on a desk.
#[derive(Debug)]
pub struct RenderedTexture<'a> {
    renderer: Renderer,
    texture: &'a HostTexture,
    state: State,
}

impl<'a> RenderedTexture<'a> {
    /// A renderer at rest; `seed` is the seed of the texture's excitation.
    #[must_use]
    pub fn new(renderer: Renderer, texture: &'a HostTexture, seed: u64) -> Self {
        Self {
            renderer,
            texture,
            state: State::new(seed),
        }
    }

    /// The renderer's state, with its counters.
    #[must_use]
    pub fn state(&self) -> &State {
        &self.state
    }

    /// The renderer.
    #[must_use]
    pub fn renderer(&self) -> &Renderer {
        &self.renderer
    }
}

impl Servo for RenderedTexture<'_> {
    fn tick(&mut self, sample: &Sample) -> Output {
        self.renderer.tick(self.texture, &mut self.state, sample)
    }
}

/// The output of a servo that has done nothing yet.
#[must_use]
pub fn silence() -> Output {
    Output {
        force_n: [0.0; 3],
        depth_m: 0.0,
        speed_mm_s: 0.0,
        normal_force_n: 0.0,
        vib_m_s2: 0.0,
        tap_n: 0.0,
        friction_n: 0.0,
        flags: Flags::default(),
    }
}
