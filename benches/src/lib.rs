//! Cost of a tick: textures of a known size, scripted motions, and a reference to compare with. The criterion benches
//! and the commands `instructions` and `paired` share them.
#![forbid(unsafe_code)]

pub mod callgrind;
pub mod load;
pub mod motion;
pub mod queries;
pub mod reference;
pub mod texture;

use asperity_formats::Asset;
use asperity_runtime::{Config, Flags, HostTexture, Output, Renderer, Sample, State};
use motion::Motion;

/// A renderer, a loaded texture and a state, ready to tick.
pub struct Rig {
    renderer: Renderer,
    texture: Box<HostTexture>,
    state: State,
}

impl Rig {
    /// The default renderer (Touch, 1 kHz, plane z = 0) on the bytes of an asset.
    ///
    /// # Panics
    /// If the bytes are not an asset at 1 kHz, since a bench of nothing must not run.
    #[must_use]
    pub fn new(bytes: &[u8]) -> Self {
        Self::at(bytes, Config::default().servo_rate_hz)
    }

    /// As [`Rig::new`], in a servo loop at a multiple of 1 kHz.
    ///
    /// # Panics
    /// If the bytes are not an asset, or the asset cannot run at this rate.
    #[must_use]
    pub fn at(bytes: &[u8], servo_rate_hz: f32) -> Self {
        let config = Config {
            servo_rate_hz,
            ..Config::default()
        };
        let mut texture = Box::new(HostTexture::new());
        texture
            .load(
                &Asset::parse(bytes).expect("a valid asset"),
                config.servo_rate_hz,
            )
            .expect("a texture that fits, at a rate that divides");
        Self {
            renderer: Renderer::new(&config).expect("a valid configuration"),
            texture,
            state: State::new(1),
        }
    }

    /// Samples of a cycle of the texture.
    #[must_use]
    pub const fn cycle_samples(&self) -> u8 {
        self.texture.cycle_samples()
    }

    /// Renders a tick.
    #[inline(never)]
    pub fn tick(&mut self, sample: &Sample) -> Output {
        self.renderer.tick(&self.texture, &mut self.state, sample)
    }
}

/// Checks that a stroke sounds and that every force is finite and within 3.3 N, so that what is
/// timed is a tick.
///
/// # Panics
/// If one of these does not hold.
pub fn check(bytes: &[u8]) {
    let mut rig = Rig::new(bytes);
    let mut loudest = 0.0_f32;
    for sample in (0..2000).map(|tick| Motion::Stroke.sample(tick)) {
        let output = rig.tick(&sample);
        assert!(output.force_n.iter().all(|f| f.abs() <= 3.3));
        assert!(output.flags.contains(Flags::CONTACT));
        loudest = loudest.max(output.vib_m_s2.abs());
    }
    assert!(loudest > 0.1, "the stroke must sound: {loudest}");
}
