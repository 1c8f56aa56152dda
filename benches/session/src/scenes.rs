//! Scenes whose costliest ticks the cost model of `asperity build` is fitted to.
//!
//! A plane with the measured texture lies under the whole session; a strip of it is raised and
//! wears another texture, so that the session crosses borders. Further surfaces lie apart:
//! they are never touched, but their distances are taken.

use crate::{Phase, SEED};
use asperity_formats::{
    EncodeError, FormatError, Library, SceneSurface, Solid, library::encode_scene,
};
use asperity_runtime::{
    Capacities, Config, Output, Renderer, Sample, Scene, SceneError, SceneState, Texture,
};

/// The textures; `cortex-m library` writes it.
static TEXTURES: &[u8] = include_bytes!("../costs.aspl");
/// Texture of the raised strip.
const OTHER: &str = "other";
/// Surfaces that are touched: the plane and the strip.
pub const TOUCHED: u32 = 2;
/// Room for the bytes of a scene.
pub const SCENE_BYTES: usize = 32 * 1024;

/// Room for every case.
pub type CostScene<'a> = Scene<'a, 10, Capacities<64, 128, 24, 24, 520>>;
/// A slot for its texture, or the strip's.
pub type CostSlot = Texture<Capacities<64, 128, 24, 24, 520>>;

/// A measured scene.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct SceneCase {
    /// Name of its texture.
    pub texture: &'static str,
    /// Poles of the texture.
    pub poles: u32,
    /// Zeros that are mixed and converted.
    pub zeros: u32,
    /// Triangles of its grid.
    pub triangles: u32,
    /// Laws of friction of its texture: 0 or 1.
    pub laws: u32,
    /// Contact laws of its texture, with every part: 0 or 1.
    pub contacts: u32,
    /// Directions of its texture: 0 or 1.
    pub axes: u32,
    /// Planes, spheres and boxes beside what is touched.
    pub apart: [u32; 3],
}

const fn case(texture: &'static str, poles: u32, zeros: u32) -> SceneCase {
    SceneCase {
        texture,
        poles,
        zeros,
        triangles: 56,
        laws: 0,
        contacts: 0,
        axes: 0,
        apart: [0; 3],
    }
}

const fn on(triangles: u32, case: SceneCase) -> SceneCase {
    SceneCase { triangles, ..case }
}

const fn beside(apart: [u32; 3]) -> SceneCase {
    SceneCase {
        apart,
        ..case("10 nyquist", 10, 0)
    }
}

/// Every case.
pub const SCENE_CASES: [SceneCase; 19] = [
    case("4 nyquist", 4, 0),
    case("10 nyquist", 10, 0),
    case("20 nyquist", 20, 0),
    case("4+2", 4, 2),
    case("10+8", 10, 8),
    case("20+18", 20, 18),
    case("7 nyquist", 7, 0),
    case("16 nyquist", 16, 0),
    case("24 nyquist", 24, 0),
    case("15+13", 15, 13),
    on(12, case("10 nyquist, 12", 10, 0)),
    on(98, case("10 nyquist, 98", 10, 0)),
    SceneCase {
        laws: 1,
        ..case("10 nyquist, law", 10, 0)
    },
    SceneCase {
        contacts: 1,
        ..case("10 nyquist, contact", 10, 0)
    },
    SceneCase {
        axes: 1,
        ..case("10 nyquist, ribs", 10, 0)
    },
    beside([8, 0, 0]),
    beside([0, 8, 0]),
    beside([0, 0, 8]),
    beside([2, 2, 2]),
];

/// Why a case cannot be run: never, while `costs.aspl` is whole.
#[derive(Debug)]
pub enum CaseError {
    /// The textures.
    Textures(FormatError),
    /// The scene cannot be written.
    Encode(EncodeError),
    /// The scene cannot be loaded.
    Load(SceneError),
}

impl SceneCase {
    /// Writes the scene to `bytes`, at least [`SCENE_BYTES`], and loads it.
    ///
    /// # Errors
    /// [`CaseError`].
    pub fn load<'a>(
        &self,
        bytes: &mut [u8],
        slots: &'a mut [CostSlot; 2],
    ) -> Result<CostScene<'a>, CaseError> {
        let library = Library::parse(TEXTURES).map_err(CaseError::Textures)?;
        let asset = |name: &str| {
            let index = library.index().find(name).unwrap_or(usize::MAX);
            library.bytes(index).map_err(CaseError::Textures)
        };
        let textures = [(self.texture, asset(self.texture)?), (OTHER, asset(OTHER)?)];
        let under = SceneSurface {
            texture: 0,
            ..surface(ground(0.0))
        };
        let mut surfaces = [under; 10];
        let apart = APART.into_iter().zip(self.apart);
        let apart = apart.flat_map(|(shape, count)| (0..count).map(move |_| surface(shape)));
        let mut len = 1;
        for (place, above) in surfaces
            .iter_mut()
            .skip(1)
            .zip([strip()].into_iter().chain(apart))
        {
            *place = above;
            len += 1;
        }
        let surfaces = surfaces.get(..len).unwrap_or_default();
        let len = encode_scene(&textures, surfaces, bytes).map_err(CaseError::Encode)?;
        let written = bytes.get(..len).unwrap_or_default();
        let library = Library::parse(written).map_err(CaseError::Textures)?;
        Scene::load(&library, &Config::default(), slots).map_err(CaseError::Load)
    }
}

/// A plane, a sphere and a box out of the session's reach.
const APART: [Solid; 3] = [
    Solid::Plane {
        point_m: [0.0, 0.0, -1.0],
        normal: [0.0, 0.0, 1.0],
    },
    Solid::Sphere {
        center_m: [0.1, 0.2, 1.0],
        radius_m: 0.1,
    },
    Solid::Box {
        center_m: [0.1, 0.2, 1.0],
        half_extents_m: [0.1; 3],
    },
];

fn surface(solid: Solid) -> SceneSurface {
    SceneSurface {
        solid,
        from_m: [-1.0e3; 3],
        to_m: [1.0e3; 3],
        texture: 1,
    }
}

/// The strip: raised by 1 mm, 10 mm wide, across the way of every motion.
fn strip() -> SceneSurface {
    SceneSurface {
        from_m: [0.02, -1.0e3, -1.0e3],
        to_m: [0.03, 1.0e3, 1.0e3],
        ..surface(ground(1.0e-3))
    }
}

fn ground(height_m: f32) -> Solid {
    Solid::Plane {
        point_m: [0.0, 0.0, height_m],
        normal: [0.0, 0.0, 1.0],
    }
}

/// Runs the session on a scene through `tick`.
pub fn run_scene(
    scene: &CostScene<'_>,
    renderer: &Renderer,
    mut tick: impl FnMut(&Renderer, &CostScene<'_>, &mut SceneState, &Sample) -> Output,
) {
    let mut state = SceneState::new(SEED);
    for phase in Phase::ALL {
        for n in 0..crate::PHASE_TICKS {
            tick(renderer, scene, &mut state, &phase.sample(n));
        }
    }
}
