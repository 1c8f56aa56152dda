//! A renderer with its texture or scene and a state, in one arithmetic.

use crate::columns::Columns;
use asperity_formats::{Asset, Coupling, Library, SceneSurface, limits::MAX_SURFACES};
use asperity_runtime::{
    Config, ConfigError, Counters, Fixed, Flags, Float, HostCapacities, LoadError, Output,
    RenderArithmetic, Renderer, Sample, Scene, SceneError, SceneState, State, Texture,
    arithmetic::Scalar as _,
};
use std::ops::Range;

/// A servo loop without its device, whatever it computes with.
pub(crate) trait Servo: Send + Sync {
    /// A tick for each of these positions; `elapsed_ticks` are as many as all positions, or all 1.
    fn render(
        &mut self,
        ticks: Range<usize>,
        positions_m: &[[f32; 3]],
        elapsed_ticks: Option<&[u32]>,
        columns: &mut Columns,
    );

    /// Renders a tick; also returns the touched surface of a scene.
    fn tick(&mut self, sample: &Sample) -> (Output, Option<usize>);

    /// A state at rest.
    fn reset(&mut self, seed: u64);

    /// Counts since the last reset.
    fn counters(&self) -> Counters;

    /// Stiffness, N/m, and damping, N·s/m, of the wall that is rendered; a scene has several.
    fn wall(&self) -> Option<[f32; 2]>;
}

/// Why there is no loop.
#[derive(Debug)]
pub(crate) enum ServoError {
    Config(ConfigError),
    Load(LoadError),
    Scene(SceneError),
}

/// A loop over one texture, on the solid of the configuration.
pub(crate) fn on_texture(
    asset: &Asset<'_>,
    config: &Config,
    seed: u64,
    fixed_point: bool,
) -> Result<Box<dyn Servo>, ServoError> {
    if fixed_point {
        Ok(Box::new(OnTexture::<Fixed>::new(asset, config, seed)?))
    } else {
        Ok(Box::new(OnTexture::<Float>::new(asset, config, seed)?))
    }
}

/// A loop over the scene of a library.
pub(crate) fn on_scene(
    library: &Library<'_>,
    config: &Config,
    seed: u64,
    fixed_point: bool,
) -> Result<Box<dyn Servo>, ServoError> {
    if fixed_point {
        Ok(Box::new(OnScene::<Fixed>::new(library, config, seed)?))
    } else {
        Ok(Box::new(OnScene::<Float>::new(library, config, seed)?))
    }
}

struct OnTexture<A: RenderArithmetic> {
    renderer: Renderer<A>,
    texture: Box<Texture<HostCapacities, A>>,
    coupling: Coupling,
    state: State<A>,
}

impl<A: RenderArithmetic> OnTexture<A> {
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
        in_floats(self.renderer.tick(&self.texture, &mut self.state, &sample))
    }
}

impl<A: RenderArithmetic> Servo for OnTexture<A>
where
    Self: Send + Sync,
{
    fn render(
        &mut self,
        ticks: Range<usize>,
        positions_m: &[[f32; 3]],
        elapsed_ticks: Option<&[u32]>,
        columns: &mut Columns,
    ) {
        for tick in ticks {
            let output = self.step(&sample(tick, positions_m, elapsed_ticks));
            columns.set(tick, &output);
        }
    }

    fn tick(&mut self, sample: &Sample) -> (Output, Option<usize>) {
        (self.step(sample), None)
    }

    fn reset(&mut self, seed: u64) {
        self.state = State::new(seed);
    }

    fn counters(&self) -> Counters {
        *self.state.counters()
    }

    fn wall(&self) -> Option<[f32; 2]> {
        let wall = self.renderer.wall(&self.coupling);
        Some([wall.stiffness.value(), wall.damping.value()])
    }
}

/// As many surfaces as a library can hold.
type Surfaces<'a, A> = Scene<'a, MAX_SURFACES, HostCapacities, A>;

struct OnScene<A: RenderArithmetic> {
    renderer: Renderer<A>,
    textures: Vec<Texture<HostCapacities, A>>,
    surfaces: Vec<SceneSurface>,
    state: SceneState<A>,
}

impl<A: RenderArithmetic> OnScene<A> {
    fn new(library: &Library<'_>, config: &Config, seed: u64) -> Result<Self, ServoError> {
        let renderer = Renderer::prepare(config).map_err(ServoError::Config)?;
        let mut textures = vec![Texture::new(); library.index().len()];
        // Everything is checked here, so that a tick cannot fail.
        Surfaces::load(library, config, &mut textures).map_err(ServoError::Scene)?;
        let scene = library.scene();
        Ok(Self {
            renderer,
            textures,
            surfaces: scene.map_or_else(Vec::new, |scene| scene.surfaces().collect()),
            state: SceneState::new(seed),
        })
    }

    /// Renders ticks. A scene borrows its textures, so it lasts for one call.
    fn steps(
        &mut self,
        samples: impl Iterator<Item = Sample>,
        mut each: impl FnMut(&Output, Option<usize>),
    ) {
        let Ok(scene) = Surfaces::on_loaded(&self.surfaces, &self.textures) else {
            return;
        };
        for sample in samples {
            let sample = Sample::<A>::of(&sample);
            let output = self.renderer.tick_scene(&scene, &mut self.state, &sample);
            each(&in_floats(output), self.state.touched());
        }
    }
}

impl<A: RenderArithmetic> Servo for OnScene<A>
where
    Self: Send + Sync,
{
    fn render(
        &mut self,
        ticks: Range<usize>,
        positions_m: &[[f32; 3]],
        elapsed_ticks: Option<&[u32]>,
        columns: &mut Columns,
    ) {
        let mut tick = ticks.start;
        let samples = ticks.map(|tick| sample(tick, positions_m, elapsed_ticks));
        self.steps(samples, |output, surface| {
            columns.set(tick, output);
            columns.touch(tick, surface);
            tick += 1;
        });
    }

    fn tick(&mut self, sample: &Sample) -> (Output, Option<usize>) {
        let mut felt = None;
        self.steps(std::iter::once(*sample), |output, surface| {
            felt = Some((*output, surface));
        });
        felt.unwrap_or((AT_REST, None))
    }

    fn reset(&mut self, seed: u64) {
        self.state = SceneState::new(seed);
    }

    fn counters(&self) -> Counters {
        *self.state.state().counters()
    }

    fn wall(&self) -> Option<[f32; 2]> {
        None
    }
}

/// Output in place of a scene that could not be borrowed.
const AT_REST: Output = Output {
    force_n: [0.0; 3],
    depth_m: 0.0,
    speed_mm_s: 0.0,
    normal_force_n: 0.0,
    vib_m_s2: 0.0,
    tap_n: 0.0,
    friction_n: 0.0,
    flags: Flags::SAFE_STATE,
};

#[inline]
fn sample(tick: usize, positions_m: &[[f32; 3]], elapsed_ticks: Option<&[u32]>) -> Sample {
    Sample {
        position_m: positions_m[tick],
        elapsed_ticks: elapsed_ticks.map_or(1, |elapsed_ticks| elapsed_ticks[tick]),
    }
}

#[inline]
fn in_floats<A: RenderArithmetic>(felt: Output<A>) -> Output {
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
