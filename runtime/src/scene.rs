//! Several surfaces with textures of their own; only the one that is touched is rendered.
//!
//! The surface with the smallest signed distance is touched: the nearest one, or the one in which
//! the stylus is deepest. A surface in contact stays the touched one until another is deeper by
//! [`HYSTERESIS_M`], or until the stylus is as far outside its region, so that noise at a border
//! changes nothing. From one texture to the next, wall, gains and friction follow within the time
//! constant of the parameters; the old vibration goes on until the new model is made, then its last
//! output fades. The limiter bounds any step that remains.
//!
//! A tick computes the distance from every surface, and renders one surface.

use crate::{
    arithmetic::Float,
    capacity::{Capacity, HostCapacities},
    config::{Config, ConfigError},
    load_error::LoadError,
    quantity::{Quantity, Vector, unit::Metre},
    render_arithmetic::RenderArithmetic,
    renderer::Renderer,
    sample::{Output, Sample},
    stage::contact::DistanceField,
    state::State,
    texture::Texture,
    texture_change::TextureChange,
};
use asperity_formats::{Library, SceneSurface};
use core::mem::MaybeUninit;
use heapless::Vec;
use thiserror::Error;

/// Hysteresis of the contact, m: extra depth at which another surface takes over, and the margin
/// outside its region in which a surface keeps the contact. Two counts of a Touch.
pub const HYSTERESIS_M: f32 = 0.12e-3;

/// The index that stands for no surface.
const NONE: usize = usize::MAX;
/// A plane that no usable sample reaches.
fn nowhere<A: RenderArithmetic>() -> DistanceField<A> {
    DistanceField::Plane {
        point: Vector::of([0.0, 0.0, -A::OUT_OF_REACH_M]),
        normal: Vector::whole([0, 0, 1]),
    }
}

/// A solid, the region where it can be touched, and its texture.
#[derive(Debug, Clone, Copy)]
struct Placed<A: RenderArithmetic> {
    field: DistanceField<A>,
    from: [Quantity<A, Metre>; 3],
    to: [Quantity<A, Metre>; 3],
    texture: usize,
}

impl<A: RenderArithmetic> Placed<A> {
    fn new(surface: SceneSurface) -> Self {
        Self {
            field: DistanceField::new(&surface.solid),
            from: surface.from_m.map(Quantity::of),
            to: surface.to_m.map(Quantity::of),
            texture: usize::from(surface.texture),
        }
    }

    /// Signed distance, m, or the farthest one outside the region, which is widened by a margin, m.
    #[inline]
    fn distance(
        &self,
        position: Vector<A, Metre>,
        margin: Quantity<A, Metre>,
    ) -> Quantity<A, Metre> {
        let at = position.components();
        let within = |axis: usize| {
            (at[axis] >= self.from[axis].saturating_add(-margin))
                & (at[axis] <= self.to[axis].saturating_add(margin))
        };
        let contact = self.field.step(position);
        if within(0) & within(1) & within(2) {
            contact.distance
        } else {
            Quantity::FARTHEST
        }
    }
}

/// A scene with room for `N` surfaces, on textures in caller-provided slots of the capacities of
/// [`Texture`]. One scene drives any number of [`SceneState`]s.
#[derive(Debug, Clone)]
pub struct Scene<'a, const N: usize, S: Capacity = HostCapacities, A: RenderArithmetic = Float> {
    placed: Vec<Placed<A>, N>,
    first: &'a Texture<S, A>,
    others: &'a [Texture<S, A>],
}

/// The first texture, and the others.
type Loaded<'a, S, A> = (&'a Texture<S, A>, &'a [Texture<S, A>]);

/// Room for every surface that a library can hold, on [`HostTexture`](crate::HostTexture)s.
pub type HostScene<'a> = Scene<'a, 64, HostCapacities>;

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
        /// Name of the capacity.
        field: &'static str,
        /// Required by the scene.
        found: usize,
        /// Capacity available.
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

impl<'a, const N: usize, S: Capacity, A: RenderArithmetic> Scene<'a, N, S, A> {
    /// Prepares every surface of a library, and every texture in a slot of its own; allocates
    /// nothing.
    ///
    /// # Errors
    /// [`SceneError`].
    pub fn load(
        library: &Library<'_>,
        config: &Config,
        slots: &'a mut [Texture<S, A>],
    ) -> Result<Self, SceneError> {
        let mut scene = Self::on(Self::prepare(library, config, slots)?);
        scene.place(library);
        Ok(scene)
    }

    /// [`Scene::load`] in memory of the caller's: a scene with room for many surfaces does not pass
    /// through the stack.
    ///
    /// # Errors
    /// [`SceneError`].
    pub fn load_in<'m>(
        memory: &'m mut MaybeUninit<Self>,
        library: &Library<'_>,
        config: &Config,
        slots: &'a mut [Texture<S, A>],
    ) -> Result<&'m mut Self, SceneError> {
        let textures = Self::prepare(library, config, slots)?;
        let scene = memory.write(Self::on(textures));
        scene.place(library);
        Ok(scene)
    }

    /// A scene on textures that [`Texture::load`] or [`Scene::load`] prepared before: for a caller that keeps the
    /// textures and the surfaces of a library, and borrows them for as long as it renders.
    ///
    /// # Errors
    /// [`SceneError::Capacity`] for more surfaces than there is room for, and for a texture that is not there;
    /// [`SceneError::Surface`].
    pub fn on_loaded(
        surfaces: &[SceneSurface],
        textures: &'a [Texture<S, A>],
    ) -> Result<Self, SceneError> {
        let room = |field, found, capacity| SceneError::Capacity {
            field,
            found,
            capacity,
        };
        let named = surfaces
            .iter()
            .map(|surface| usize::from(surface.texture) + 1);
        let named = named.max().ok_or(SceneError::NoScene)?;
        let loaded = textures.get(..named).and_then(|_| textures.split_first());
        let mut scene = Self::on(loaded.ok_or(room("textures", named, textures.len()))?);
        for (index, surface) in surfaces.iter().enumerate() {
            A::check_solid(&surface.solid).map_err(|cause| SceneError::Surface { index, cause })?;
            let placed = scene.placed.push(Placed::new(*surface));
            placed.map_err(|_| room("surfaces", surfaces.len(), N))?;
        }
        Ok(scene)
    }

    /// Loads every texture, checks every surface, and gives the textures.
    fn prepare(
        library: &Library<'_>,
        config: &Config,
        slots: &'a mut [Texture<S, A>],
    ) -> Result<Loaded<'a, S, A>, SceneError> {
        Self::check_surfaces(library)?;
        let (textures, room) = (library.index().len(), slots.len());
        for (index, slot) in slots.iter_mut().enumerate().take(textures) {
            slot.load_with(|| library.asset(index), config.servo_rate_hz)
                .map_err(|cause| SceneError::Texture { index, cause })?;
        }
        // A scene has at least one surface, and every surface has a texture.
        let loaded = slots.get(..textures).and_then(<[_]>::split_first);
        loaded.ok_or(SceneError::Capacity {
            field: "textures",
            found: textures,
            capacity: room,
        })
    }

    /// A function of its own, so that loading textures needs no stack for surfaces.
    #[inline(never)]
    fn check_surfaces(library: &Library<'_>) -> Result<(), SceneError> {
        let scene = library.scene().ok_or(SceneError::NoScene)?;
        let surfaces = scene.surfaces().len();
        if surfaces > N {
            return Err(SceneError::Capacity {
                field: "surfaces",
                found: surfaces,
                capacity: N,
            });
        }
        for (index, surface) in scene.surfaces().enumerate() {
            A::check_solid(&surface.solid).map_err(|cause| SceneError::Surface { index, cause })?;
        }
        Ok(())
    }

    /// No surfaces yet.
    #[inline(always)]
    const fn on((first, others): Loaded<'a, S, A>) -> Self {
        Self {
            placed: Vec::new(),
            first,
            others,
        }
    }

    #[inline(never)]
    fn place(&mut self, library: &Library<'_>) {
        let surfaces = library
            .scene()
            .into_iter()
            .flat_map(|scene| scene.surfaces());
        self.placed.extend(surfaces.take(N).map(Placed::new));
    }

    /// The surface that is touched at a position, or [`NONE`], where surface `at` was touched
    /// before.
    #[inline]
    fn touched(&self, at: usize, position: Vector<A, Metre>) -> usize {
        let hysteresis = Quantity::of(HYSTERESIS_M);
        let kept = self.placed.get(at).map_or(Quantity::FARTHEST, |placed| {
            let distance = placed.distance(position, hysteresis);
            if distance < Quantity::ZERO {
                distance - hysteresis
            } else {
                distance
            }
        });
        let (mut nearest, mut least) = if kept < Quantity::FARTHEST {
            (at, kept)
        } else {
            (NONE, Quantity::FARTHEST)
        };
        for (index, placed) in self.placed.iter().enumerate() {
            let distance = placed.distance(position, Quantity::ZERO);
            let closer = distance < least;
            nearest = if closer { index } else { nearest };
            least = if closer { distance } else { least };
        }
        nearest
    }

    fn texture(&self, index: usize) -> &Texture<S, A> {
        let other = index
            .checked_sub(1)
            .and_then(|other| self.others.get(other));
        other.unwrap_or(self.first)
    }
}

/// Everything that changes from tick to tick in a scene.
#[derive(Debug, Clone, PartialEq)]
pub struct SceneState<A: RenderArithmetic = Float> {
    state: State<A>,
    /// Surface last touched or nearest, or [`NONE`].
    at: usize,
    texture: usize,
    field: DistanceField<A>,
    crossing: TextureChange<A>,
}

impl<A: RenderArithmetic> SceneState<A> {
    /// A state at rest, without force. `seed` seeds the excitation.
    #[must_use]
    pub fn new(seed: u64) -> Self {
        Self {
            state: State::new(seed),
            at: NONE,
            texture: 0,
            field: nowhere(),
            crossing: TextureChange::START,
        }
    }

    /// [`SceneState::new`] in memory of the caller's, which takes less stack.
    #[inline(never)]
    pub fn init(memory: &mut MaybeUninit<Self>, seed: u64) -> &mut Self {
        memory.write(Self::new(seed))
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
        self.field = match surfaces.get(at) {
            Some(placed) => {
                self.texture = placed.texture;
                placed.field
            }
            None => nowhere(),
        };
        self.state.cross(&self.field);
        self.crossing.forces.begin();
    }

    /// Index of the surface in contact after the last tick.
    #[must_use]
    pub fn touched(&self) -> Option<usize> {
        self.crossing.touching.then_some(self.at)
    }
}

impl<A: RenderArithmetic> Renderer<A> {
    /// Renders one servo period in a scene: [`Renderer::tick`] on the touched surface instead of
    /// the configured one. Infallible.
    pub fn tick_scene<const N: usize, S: Capacity>(
        &self,
        scene: &Scene<'_, N, S, A>,
        state: &mut SceneState<A>,
        sample: &Sample<A>,
    ) -> Output<A> {
        if self.gate.is_usable(sample) {
            let at = scene.touched(state.at, Vector::load(sample.position_m));
            if at != state.at {
                state.move_to(at, &scene.placed);
            }
        }
        let texture = scene.texture(state.texture);
        self.tick_crossing(
            &state.field,
            texture,
            &mut state.crossing,
            &mut state.state,
            sample,
        )
    }
}
