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
    Config, ConfigError, LoadError, Output, Renderer, Sample, State, Surface, Texture,
    arithmetic::{Arithmetic, Float, Four, Number, Scalar as _, units::Metre},
    contact::Solid,
    crossing::Crossing,
    safety::is_usable,
};
use asperity_formats::{Library, SceneSurface, Shape};
use heapless::Vec;
use thiserror::Error;

/// How much deeper another surface must be to take over a contact, and how far behind its
/// border a region keeps one, m: two counts of a Touch.
pub const HYSTERESIS_M: f32 = 0.12e-3;

/// Index of no surface.
const NONE: usize = usize::MAX;
/// Out of reach of every usable sample.
fn nowhere<A: Arithmetic>() -> Solid<A> {
    Solid::Plane {
        point_m: Four::of([0.0, 0.0, -A::OUT_OF_REACH_M, 0.0]),
        normal: Four::of([0.0, 0.0, 1.0, 0.0]),
    }
}

/// A solid, where it can be touched, and its texture.
#[derive(Debug, Clone, Copy)]
struct Placed<A: Arithmetic> {
    /// Prepared here: a plane's normal is made of unit length in f64, which a tick has no time for.
    solid: Solid<A>,
    from_m: [A::Scalar<Metre>; 3],
    to_m: [A::Scalar<Metre>; 3],
    texture: usize,
}

impl<A: Arithmetic> Placed<A> {
    fn new(surface: SceneSurface) -> Self {
        Self {
            solid: Solid::new(&solid(surface.shape).normalised()),
            from_m: surface.from_m.map(A::Scalar::of),
            to_m: surface.to_m.map(A::Scalar::of),
            texture: usize::from(surface.texture),
        }
    }

    /// Signed distance, m; infinite outside the region widened by `margin_m`.
    #[inline]
    fn distance_m(
        &self,
        position_m: [A::Scalar<Metre>; 3],
        margin_m: Number<A, Metre>,
    ) -> Number<A, Metre> {
        let margin_m = margin_m.0;
        let within = |axis: usize| {
            (position_m[axis] >= A::plus_within(self.from_m[axis], -margin_m))
                & (position_m[axis] <= A::plus_within(self.to_m[axis], margin_m))
        };
        let (distance_m, _) = self.solid.touch(Four::vec3(position_m));
        if within(0) & within(1) & within(2) {
            distance_m
        } else {
            Number::FARTHEST
        }
    }
}

/// A scene with room for `N` surfaces, on textures in caller-provided slots of the capacities of
/// [`Texture`]. One scene drives any number of [`SceneState`]s.
#[derive(Debug, Clone)]
pub struct Scene<
    'a,
    const N: usize,
    const V: usize,
    const T: usize,
    const P: usize,
    const Q: usize,
    const K: usize,
    A: Arithmetic = Float,
> {
    placed: Vec<Placed<A>, N>,
    first: &'a Texture<V, T, P, Q, K, A>,
    others: &'a [Texture<V, T, P, Q, K, A>],
}

/// Room for every surface that a library can hold, on [`HostTexture`](crate::HostTexture)s.
pub type HostScene<'a> = Scene<'a, 64, 64, 128, 24, 24, 4096>;

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
    /// A surface lies out of the range of the arithmetic.
    #[error("surface {index}: {cause}")]
    Surface {
        /// Index in the scene.
        index: usize,
        /// Why.
        cause: ConfigError,
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
    'a,
    const N: usize,
    const V: usize,
    const T: usize,
    const P: usize,
    const Q: usize,
    const K: usize,
    A: Arithmetic,
> Scene<'a, N, V, T, P, Q, K, A>
{
    /// Prepares every surface of a library, and every texture in a slot of its own; allocates
    /// nothing.
    ///
    /// # Errors
    /// [`SceneError`].
    pub fn load(
        library: &Library<'_>,
        config: &Config,
        slots: &'a mut [Texture<V, T, P, Q, K, A>],
    ) -> Result<Self, SceneError> {
        let scene = library.scene().ok_or(SceneError::NoScene)?;
        let textures = library.index().len();
        let capacity = |field, found, capacity| SceneError::Capacity {
            field,
            found,
            capacity,
        };
        if scene.len() > N {
            return Err(capacity("surfaces", scene.len(), N));
        }
        for (index, surface) in scene.surfaces().enumerate() {
            A::check_surface(&solid(surface.shape))
                .map_err(|cause| SceneError::Surface { index, cause })?;
        }
        let room = slots.len();
        for (index, slot) in slots.iter_mut().enumerate().take(textures) {
            let load = |asset| slot.load(&asset, config.servo_rate_hz);
            let loaded = library.asset(index).map_err(LoadError::from).and_then(load);
            loaded.map_err(|cause| SceneError::Texture { index, cause })?;
        }
        // A scene has a surface, and that a texture.
        let loaded = slots.get(..textures).and_then(<[_]>::split_first);
        let (first, others) = loaded.ok_or(capacity("textures", textures, room))?;
        Ok(Self {
            placed: scene.surfaces().take(N).map(Placed::new).collect(),
            first,
            others,
        })
    }

    /// The surface to touch at a position, [`NONE`] for none, when it was `at` before.
    #[inline]
    fn touched(&self, at: usize, position_m: [A::Scalar<Metre>; 3]) -> usize {
        let hysteresis_m = Number::of(HYSTERESIS_M);
        let kept = self.placed.get(at).map_or(Number::FARTHEST, |placed| {
            let distance_m = placed.distance_m(position_m, hysteresis_m);
            if distance_m < Number::ZERO {
                distance_m - hysteresis_m
            } else {
                distance_m
            }
        });
        let (mut nearest, mut least_m) = if kept < Number::FARTHEST {
            (at, kept)
        } else {
            (NONE, Number::FARTHEST)
        };
        for (index, placed) in self.placed.iter().enumerate() {
            let distance_m = placed.distance_m(position_m, Number::ZERO);
            let closer = distance_m < least_m;
            nearest = if closer { index } else { nearest };
            least_m = if closer { distance_m } else { least_m };
        }
        nearest
    }

    fn texture(&self, index: usize) -> &Texture<V, T, P, Q, K, A> {
        let other = index
            .checked_sub(1)
            .and_then(|other| self.others.get(other));
        other.unwrap_or(self.first)
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
pub struct SceneState<A: Arithmetic = Float> {
    state: State<A>,
    /// Surface last touched or nearest, or [`NONE`].
    at: usize,
    texture: usize,
    solid: Solid<A>,
    crossing: Crossing<A>,
}

impl<A: Arithmetic> SceneState<A> {
    /// At rest, without force; the seed is that of the excitation.
    #[must_use]
    pub fn new(seed: u64) -> Self {
        Self {
            state: State::new(seed),
            at: NONE,
            texture: 0,
            solid: nowhere(),
            crossing: Crossing::START,
        }
    }

    /// The state of the tick.
    #[must_use]
    pub const fn state(&self) -> &State<A> {
        &self.state
    }

    /// Another surface is touched from here on, or none.
    #[cold]
    fn move_to(&mut self, at: usize, surfaces: &[Placed<A>]) {
        self.at = at;
        self.solid = match surfaces.get(at) {
            Some(placed) => {
                self.texture = placed.texture;
                placed.solid
            }
            None => nowhere(),
        };
        self.state.cross(&self.solid);
    }

    /// Index of the surface in contact after the last tick.
    #[must_use]
    pub fn touched(&self) -> Option<usize> {
        self.crossing.touching.then_some(self.at)
    }
}

impl<A: Arithmetic> Renderer<A> {
    /// One servo period in a scene: [`Renderer::tick`] on the surface that is touched, in place
    /// of the one in the configuration. Infallible.
    pub fn tick_scene<
        const N: usize,
        const V: usize,
        const T: usize,
        const P: usize,
        const Q: usize,
        const K: usize,
    >(
        &self,
        scene: &Scene<'_, N, V, T, P, Q, K, A>,
        state: &mut SceneState<A>,
        sample: &Sample<A>,
    ) -> Output<A> {
        if is_usable(sample) {
            let at = scene.touched(state.at, sample.position_m);
            if at != state.at {
                state.move_to(at, &scene.placed);
            }
        }
        let texture = scene.texture(state.texture);
        self.tick_crossing(
            &state.solid,
            texture,
            &mut state.crossing,
            &mut state.state,
            sample,
        )
    }
}
