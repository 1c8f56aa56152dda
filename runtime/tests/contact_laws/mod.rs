//! The laws of materials that give way.

mod closed_forms;
mod safety;

use asperity_formats::Asset;
use asperity_runtime::{
    Config, Output, RenderArithmetic, Renderer, Sample, State, arithmetic::Scalar as _,
};
use asperity_tests::texture::{Contact, HostSlot, Texture, TextureKind, random};

/// A silent texture of a stiffness without taps.
fn material(stiffness_n_m: f32, contact: Option<Contact>) -> Texture {
    let mut texture = random(1, TextureKind::nyquist(4));
    texture.traces.clear();
    for vertex in &mut texture.vertices {
        vertex.sigma_m_s2 = 0.0;
    }
    texture.mu = 0.4;
    texture.coupling.stiffness_n_m = stiffness_n_m;
    texture.coupling.damping_n_s_m = 0.0;
    texture.contact = contact;
    texture
}

/// A device that absorbs anything, so that nothing is lowered.
fn bench(rate_hz: f32) -> Config {
    let mut config = Config {
        servo_rate_hz: rate_hz,
        ..Config::default()
    };
    config.limits.peak_n = 100.0;
    config.limits.slew_n_s = 1e6;
    config.mechanics.damping_n_s_m = 1000.0;
    config.mechanics.coulomb_n = 100.0;
    config
}

/// A texture in the hand of a test.
struct Hand<A: RenderArithmetic> {
    renderer: Renderer<A>,
    slot: Box<HostSlot<A>>,
    state: State<A>,
}

impl<A: RenderArithmetic> Hand<A> {
    fn new(texture: &Texture, config: &Config) -> Self {
        let mut texture = texture.clone();
        texture.sample_rate_hz = config.servo_rate_hz;
        let mut slot = Box::new(HostSlot::new());
        let bytes = texture.encode();
        let asset = Asset::parse(&bytes).unwrap();
        slot.load(&asset, config.servo_rate_hz).unwrap();
        Self {
            renderer: Renderer::prepare(config).unwrap(),
            slot,
            state: State::new(1),
        }
    }

    fn tick(&mut self, sample: Sample) -> Output<A> {
        self.renderer
            .tick(&self.slot, &mut self.state, &Sample::of(&sample))
    }

    /// Presses to a depth, m, and returns the load, N.
    fn press(&mut self, depth_m: f64) -> f64 {
        let output = self.tick(Sample::at([0.0, 0.0, -depth_m as f32]));
        output.normal_force_n.value().into()
    }
}

fn near(found: f64, exact: f64, share: f64, least: f64) -> bool {
    (found - exact).abs() <= share * exact.abs() + least
}
