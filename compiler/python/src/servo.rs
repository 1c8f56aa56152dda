//! A renderer, a texture and a state in one arithmetic.

use crate::columns::Columns;
use asperity_formats::{Asset, Coupling};
use asperity_runtime::{
    Config, ConfigError, Counters, Fixed, Float, HostCapacities, LoadError, Output,
    RenderArithmetic, Renderer, Sample, State, Texture, arithmetic::Scalar as _,
};

/// A servo loop without its device, whatever it computes with.
pub(crate) trait Servo: Send + Sync {
    /// One tick.
    fn tick(&mut self, sample: &Sample) -> Output;

    /// A tick for each position; `elapsed_ticks` are as many, or all 1.
    fn render(&mut self, positions_m: &[[f32; 3]], elapsed_ticks: Option<&[u32]>) -> Columns;

    /// A state at rest.
    fn reset(&mut self, seed: u64);

    /// Counts since the last reset.
    fn counters(&self) -> Counters;

    /// Stiffness, N/m, and damping, N·s/m, of the wall that is rendered.
    fn wall(&self) -> [f32; 2];
}

/// Why there is no loop.
#[derive(Debug)]
pub(crate) enum ServoError {
    Config(ConfigError),
    Load(LoadError),
}

/// A loop over one texture.
pub(crate) fn servo(
    asset: &Asset<'_>,
    config: &Config,
    seed: u64,
    fixed_point: bool,
) -> Result<Box<dyn Servo>, ServoError> {
    if fixed_point {
        Ok(Box::new(Loop::<Fixed>::new(asset, config, seed)?))
    } else {
        Ok(Box::new(Loop::<Float>::new(asset, config, seed)?))
    }
}

struct Loop<A: RenderArithmetic> {
    renderer: Renderer<A>,
    texture: Box<Texture<HostCapacities, A>>,
    coupling: Coupling,
    state: State<A>,
}

impl<A: RenderArithmetic> Loop<A> {
    fn new(asset: &Asset<'_>, config: &Config, seed: u64) -> Result<Self, ServoError> {
        let renderer = Renderer::prepare(config).map_err(ServoError::Config)?;
        let mut texture = Box::new(Texture::new());
        texture
            .load(asset, config.servo_rate_hz)
            .map_err(ServoError::Load)?;
        Ok(Self {
            renderer,
            texture,
            coupling: *asset.coupling(),
            state: State::new(seed),
        })
    }

    #[inline]
    fn step(&mut self, sample: &Sample) -> Output {
        let sample = Sample::<A>::of(sample);
        let felt = self.renderer.tick(&self.texture, &mut self.state, &sample);
        Output {
            force_n: felt.force_n.map(|force| force.value()),
            depth_m: felt.depth_m.value(),
            speed_mm_s: felt.speed_mm_s.value(),
            normal_force_n: felt.normal_force_n.value(),
            vib_m_s2: felt.vib_m_s2.value(),
            tap_n: felt.tap_n.value(),
            friction_n: felt.friction_n.value(),
            flags: felt.flags,
        }
    }
}

impl<A: RenderArithmetic> Servo for Loop<A>
where
    Self: Send + Sync,
{
    fn tick(&mut self, sample: &Sample) -> Output {
        self.step(sample)
    }

    fn render(&mut self, positions_m: &[[f32; 3]], elapsed_ticks: Option<&[u32]>) -> Columns {
        let mut columns = Columns::zeros(positions_m.len());
        for (tick, &position_m) in positions_m.iter().enumerate() {
            let elapsed_ticks = elapsed_ticks.map_or(1, |elapsed_ticks| elapsed_ticks[tick]);
            let sample = Sample {
                position_m,
                elapsed_ticks,
            };
            columns.set(tick, &self.step(&sample));
        }
        columns
    }

    fn reset(&mut self, seed: u64) {
        self.state = State::new(seed);
    }

    fn counters(&self) -> Counters {
        *self.state.counters()
    }

    fn wall(&self) -> [f32; 2] {
        let wall = self.renderer.wall(&self.coupling);
        [wall.stiffness.value(), wall.damping.value()]
    }
}
