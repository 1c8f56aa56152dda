//! Several surfaces with textures of their own; only the one that is touched is rendered.
//!
//! Of all surfaces the one with the smallest signed distance is touched: the nearest, or
//! that in which the stylus is deepest. A surface in contact keeps it until another is
//! deeper by [`HYSTERESIS_M`], or its region is left by as much, so that noise at a border
//! changes nothing. From one texture to the next wall, gains and friction follow within the
//! time constant of the parameters; the old vibration goes on until the new model is made,
//! then its last output fades; the limiter bounds what is left of a step.
//!
//! The work is one distance a surface, and a tick.

use crate::{
    Config, Flags, LoadError, Output, Renderer, Sample, State, Surface, Texture,
    crossing::Crossing,
    lanes::F4,
    math::{Vec3, exp},
    safety::REACH_M,
    tick::Felt,
    vibration::Vibration,
};
use asperity_formats::{Library, Shape};
use thiserror::Error;

/// How much deeper another surface must be to take over a contact, and how far behind its
/// border a region keeps one, m: two counts of a Touch.
pub const HYSTERESIS_M: f32 = 0.12e-3;

/// A solid, where it can be touched, and its texture.
#[derive(Debug, Clone, Copy)]
struct Placed {
    solid: Surface,
    from_m: Vec3,
    to_m: Vec3,
    texture: usize,
}

impl Placed {
    /// Out of reach of every usable sample.
    const NOWHERE: Self = Self {
        solid: Surface::Plane {
            point_m: [0.0, 0.0, -10.0 * REACH_M],
            normal: [0.0, 0.0, 1.0],
        },
        from_m: [-REACH_M; 3],
        to_m: [REACH_M; 3],
        texture: 0,
    };

    /// Signed distance, m; infinite outside the region widened by `margin_m`.
    #[inline]
    fn distance_m(&self, position_m: Vec3, margin_m: f32) -> f32 {
        let within = |axis: usize| {
            (position_m[axis] >= self.from_m[axis] - margin_m)
                & (position_m[axis] <= self.to_m[axis] + margin_m)
        };
        let distance_m = self.solid.contact(position_m).distance_m;
        if within(0) & within(1) & within(2) {
            distance_m
        } else {
            f32::INFINITY
        }
    }
}

/// Surfaces and textures of a scene in caller-provided memory: room for `N` surfaces and `M`
/// textures of the capacities of [`Texture`]. One scene drives any number of [`SceneState`]s.
#[derive(Debug, Clone)]
pub struct Scene<
    const N: usize,
    const M: usize,
    const V: usize,
    const T: usize,
    const P: usize,
    const Q: usize,
    const K: usize,
> {
    placed: [Placed; N],
    count: usize,
    textures: [Texture<V, T, P, Q, K>; M],
    /// Share of the way that wall, gains and friction go in a tick.
    follow_share: f32,
}

/// Room for every surface that a library can hold and for 16 of the largest textures: 0.5 MB,
/// better boxed or static than on a stack.
pub type HostScene = Scene<64, 16, 64, 128, 24, 24, 4096>;

/// Why a library cannot be rendered as a scene.
#[derive(Debug, Clone, Copy, PartialEq, Error)]
#[non_exhaustive]
pub enum SceneError {
    /// The library has textures but no surfaces.
    #[error("the library holds no scene: build one with `asperity build`")]
    NoScene,
    /// More of something than there is room for.
    #[error("{field}: the scene has {found}, there is room for {capacity}")]
    Capacity {
        /// Which capacity.
        field: &'static str,
        /// What the scene needs.
        found: usize,
        /// What there is room for.
        capacity: usize,
    },
    /// A texture does not fit its slot.
    #[error("texture {index}: {cause}")]
    Texture {
        /// Index in the library.
        index: usize,
        /// Why.
        cause: LoadError,
    },
}

impl<
    const N: usize,
    const M: usize,
    const V: usize,
    const T: usize,
    const P: usize,
    const Q: usize,
    const K: usize,
> Default for Scene<N, M, V, T, P, Q, K>
{
    fn default() -> Self {
        Self::new()
    }
}

impl<
    const N: usize,
    const M: usize,
    const V: usize,
    const T: usize,
    const P: usize,
    const Q: usize,
    const K: usize,
> Scene<N, M, V, T, P, Q, K>
{
    /// Nothing to touch.
    #[must_use]
    pub const fn new() -> Self {
        const { assert!(M > 0, "a scene needs room for a texture") }
        Self {
            placed: [Placed::NOWHERE; N],
            count: 0,
            textures: [const { Texture::new() }; M],
            follow_share: 1.0,
        }
    }

    /// Prepares every surface and texture of a library; allocates nothing. After a refusal
    /// there is nothing to touch.
    ///
    /// # Errors
    /// [`SceneError`].
    pub fn load(&mut self, library: &Library<'_>, config: &Config) -> Result<(), SceneError> {
        self.count = 0;
        let scene = library.scene().ok_or(SceneError::NoScene)?;
        for (field, found, capacity) in [
            ("surfaces", scene.len(), N),
            ("textures", library.index().len(), M),
        ] {
            if found > capacity {
                return Err(SceneError::Capacity {
                    field,
                    found,
                    capacity,
                });
            }
        }
        for (index, slot) in self.textures.iter_mut().enumerate() {
            if index < library.index().len() {
                let load = |asset| slot.load(&asset, config.servo_rate_hz);
                let loaded = library.asset(index).map_err(LoadError::from).and_then(load);
                loaded.map_err(|cause| SceneError::Texture { index, cause })?;
            }
        }
        for (place, surface) in self.placed.iter_mut().zip(scene.surfaces()) {
            *place = Placed {
                solid: solid(surface.shape).normalised(),
                from_m: surface.from_m,
                to_m: surface.to_m,
                texture: usize::from(surface.texture),
            };
        }
        let ticks = config.parameter_time_constant_s * config.servo_rate_hz;
        self.follow_share = if ticks > 0.1 {
            1.0 - exp(-1.0 / ticks)
        } else {
            1.0
        };
        self.count = scene.len();
        Ok(())
    }

    /// Number of surfaces.
    #[must_use]
    pub const fn len(&self) -> usize {
        self.count
    }

    /// Whether there is nothing to touch.
    #[must_use]
    pub const fn is_empty(&self) -> bool {
        self.count == 0
    }

    /// The surface to touch at a position, `count` for none, when it was `at` before.
    #[inline]
    fn touched(&self, at: usize, position_m: Vec3) -> usize {
        let surfaces = self.placed.get(..self.count).unwrap_or_default();
        let kept = surfaces.get(at).map_or(f32::INFINITY, |placed| {
            let distance_m = placed.distance_m(position_m, HYSTERESIS_M);
            distance_m - if distance_m < 0.0 { HYSTERESIS_M } else { 0.0 }
        });
        let (mut nearest, mut least_m) = if kept < f32::INFINITY {
            (at, kept)
        } else {
            (self.count, f32::INFINITY)
        };
        for (index, placed) in surfaces.iter().enumerate() {
            let distance_m = placed.distance_m(position_m, 0.0);
            let closer = distance_m < least_m;
            nearest = if closer { index } else { nearest };
            least_m = if closer { distance_m } else { least_m };
        }
        nearest
    }

    fn texture(&self, index: usize) -> &Texture<V, T, P, Q, K> {
        // An index of a loaded scene is in range, and there is at least one slot.
        self.textures.get(index).unwrap_or(&self.textures[0])
    }
}

fn solid(shape: Shape) -> Surface {
    match shape {
        Shape::Plane { point_m, normal } => Surface::Plane { point_m, normal },
        Shape::Sphere { center_m, radius_m } => Surface::Sphere { center_m, radius_m },
        Shape::Box {
            center_m,
            half_extents_m,
        } => Surface::Box {
            center_m,
            half_extents_m,
        },
    }
}

/// Everything that changes from tick to tick in a scene.
#[derive(Debug, Clone, PartialEq)]
pub struct SceneState {
    state: State,
    /// Surface last touched or nearest; the count of surfaces or more for none.
    at: usize,
    texture: usize,
    solid: Surface,
    crossing: Crossing,
    /// In contact in the tick before.
    touching: bool,
}

impl SceneState {
    /// At rest, without force; the seed is that of the excitation.
    #[must_use]
    pub fn new(seed: u64) -> Self {
        Self {
            state: State::new(seed),
            at: usize::MAX,
            texture: 0,
            solid: Placed::NOWHERE.solid,
            crossing: Crossing::START,
            touching: false,
        }
    }

    /// The state of the tick.
    #[must_use]
    pub const fn state(&self) -> &State {
        &self.state
    }

    /// Another surface is touched from here on; one beyond all is none.
    #[cold]
    fn move_to(&mut self, at: usize, surfaces: &[Placed]) {
        self.at = at;
        self.solid = match surfaces.get(at) {
            Some(placed) => {
                self.texture = placed.texture;
                placed.solid
            }
            None => Placed::NOWHERE.solid,
        };
        self.state.cross(&self.solid);
    }

    /// Index of the surface in contact after the last tick.
    #[must_use]
    pub fn touched(&self) -> Option<usize> {
        self.touching.then_some(self.at)
    }
}

impl Renderer {
    /// One servo period in a scene: [`Renderer::tick`] on the surface that is touched, in place
    /// of the one in the configuration. Infallible.
    pub fn tick_scene<
        const N: usize,
        const M: usize,
        const V: usize,
        const T: usize,
        const P: usize,
        const Q: usize,
        const K: usize,
    >(
        &self,
        scene: &Scene<N, M, V, T, P, Q, K>,
        state: &mut SceneState,
        sample: &Sample,
    ) -> Output {
        if is_usable(sample) {
            let at = scene.touched(state.at, sample.position_m);
            if at != state.at {
                state.move_to(at, scene.placed.get(..scene.count).unwrap_or_default());
            }
        }
        let texture = scene.texture(state.texture);
        let share = if state.touching {
            scene.follow_share
        } else {
            1.0
        };
        let crossing = &mut state.crossing;
        crossing.follow(&texture.surface, texture.mu, share);
        let (surface, mu) = (crossing.surface, crossing.mu);
        let felt = Felt {
            solid: &state.solid,
            surface: &surface,
            mu,
        };
        let sound = |vibration: &mut Vibration, speed_mm_s, force_n, share, sounding| {
            crossing.sound(vibration, texture, (speed_mm_s, force_n), share, sounding)
        };
        let output = self.tick_on(felt, texture, &mut state.state, sample, sound);
        state.touching = output.flags.contains(Flags::CONTACT);
        output
    }
}

/// Whether the gate will take a sample for a position.
#[inline]
fn is_usable(sample: &Sample) -> bool {
    F4::vec3(sample.position_m).is_within(REACH_M) & (sample.elapsed_ticks > 0)
}
