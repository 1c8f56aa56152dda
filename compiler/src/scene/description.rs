//! `scene.toml`: surfaces, and the textures they wear.

use super::error::{SceneError, SceneProblem};
use crate::passes::rerate;
use asperity_formats::{
    Solid,
    limits::{MAX_NAME_BYTES, MAX_POSITION_M, MAX_SURFACES, MIN_SOLID_M},
};
use asperity_io::{
    input::{self, Kind, Reach},
    toml_error::TomlError,
};
use serde::Deserialize;
use std::path::{Path, PathBuf};
use toml::de::{DeTable, DeValue};

/// Textures that a scene may list, worn or not. Each name is compared with all before it.
const MAX_LISTED_TEXTURES: usize = 1024;

/// A checked scene.
#[derive(Debug, Clone, PartialEq)]
pub struct Description {
    /// The file, for errors.
    pub file: PathBuf,
    /// Rate of the servo loop, Hz.
    pub servo_rate_hz: f64,
    /// Textures that a surface wears, in the order of the file.
    pub textures: Vec<TextureEntry>,
    /// Textures that no surface wears.
    pub unused: Vec<String>,
    /// The surfaces, at least one.
    pub surfaces: Vec<SurfaceEntry>,
    /// Every file that it names, also for textures that no surface wears.
    pub sources: Vec<PathBuf>,
}

/// A texture and where it comes from.
#[derive(Debug, Clone, PartialEq)]
pub struct TextureEntry {
    /// Its name, unique in the scene.
    pub name: String,
    /// Where it comes from.
    pub origin: Origin,
    /// Index in the file, for errors.
    pub index: usize,
}

/// Where a texture comes from. Paths are such that they can be opened.
#[derive(Debug, Clone, PartialEq)]
pub enum Origin {
    /// A prompt and a seed.
    Prompt(String, u64),
    /// A material of the HaTT.
    Import(PathBuf),
    /// An asset.
    Asset(PathBuf),
}

/// A solid, its region and its texture.
#[derive(Debug, Clone, PartialEq)]
pub struct SurfaceEntry {
    /// The solid.
    pub solid: Solid,
    /// Lower corner of the region, m.
    pub from_m: [f32; 3],
    /// Upper corner of the region, m.
    pub to_m: [f32; 3],
    /// Name of its texture.
    pub texture: String,
}

#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
struct RawScene {
    #[serde(default = "default_rate")]
    servo_rate_hz: f64,
    #[serde(default)]
    texture: Vec<RawTexture>,
    #[serde(default)]
    surface: Vec<RawSurface>,
}

fn default_rate() -> f64 {
    1000.0
}

#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
struct RawTexture {
    name: String,
    prompt: Option<String>,
    import: Option<PathBuf>,
    asset: Option<PathBuf>,
    seed: Option<u64>,
}

#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
struct RawSurface {
    texture: String,
    plane: Option<RawPlane>,
    sphere: Option<RawSphere>,
    #[serde(rename = "box")]
    cuboid: Option<RawBox>,
    from_m: Option<[f64; 3]>,
    to_m: Option<[f64; 3]>,
}

#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
struct RawPlane {
    point_m: [f64; 3],
    normal: [f64; 3],
}

#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
struct RawSphere {
    center_m: [f64; 3],
    radius_m: f64,
}

#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
struct RawBox {
    center_m: [f64; 3],
    half_extents_m: [f64; 3],
}

impl Description {
    /// Reads and checks a file; paths in it are relative to its folder.
    ///
    /// # Errors
    /// [`SceneError`] with the file and the field.
    pub fn read(file: &Path) -> Result<Self, SceneError> {
        let text = input::read_text(file, Kind::Scene).map_err(|e| SceneError {
            file: file.to_owned(),
            field: String::new(),
            problem: e.into(),
        })?;
        Self::of_text(file, &text)
    }

    /// Checks the text of a file, which may name any other.
    ///
    /// # Errors
    /// As [`read`](Self::read).
    pub fn of_text(file: &Path, text: &str) -> Result<Self, SceneError> {
        Self::within(file, text, &Reach::Anywhere)
    }

    /// Checks the text of a scene that may name only files within reach.
    ///
    /// # Errors
    /// As [`read`](Self::read), and for a path that leads elsewhere.
    pub fn within(file: &Path, text: &str, reach: &Reach) -> Result<Self, SceneError> {
        let fail = |field: String, problem| SceneError {
            file: file.to_owned(),
            field,
            problem,
        };
        let raw: RawScene = toml::from_str(text).map_err(|e| {
            if let Some(key) = single(text) {
                return fail(key.to_owned(), SceneProblem::Single(key));
            }
            fail(
                String::new(),
                SceneProblem::Syntax(TomlError::new(text, &e)),
            )
        })?;
        let folder = file.parent().unwrap_or(Path::new(""));
        raw.check(file, folder, reach)
            .map_err(|(field, problem)| fail(field, problem))
    }
}

/// The list that a text has one table of, in single brackets.
fn single(text: &str) -> Option<&'static str> {
    let top = DeTable::parse(text).ok()?;
    let is_table = |key: &&str| {
        matches!(
            top.get_ref().get(*key).map(|v| v.get_ref()),
            Some(DeValue::Table(_))
        )
    };
    ["texture", "surface"].into_iter().find(is_table)
}

/// A field and what is wrong with it.
type Wrong = (String, SceneProblem);

impl RawScene {
    fn check(self, file: &Path, folder: &Path, reach: &Reach) -> Result<Description, Wrong> {
        let (low, _) = rerate::RATE_RANGE_HZ;
        // Loops faster than a texture can be converted to are multiples of its rate.
        in_range("servo_rate_hz", self.servo_rate_hz, (low, 20_000.0))?;
        if self.surface.is_empty() {
            return Err(("surface".into(), SceneProblem::NoSurface));
        }
        if self.surface.len() > MAX_SURFACES {
            let count = self.surface.len();
            return Err(("surface".into(), SceneProblem::TooMany(count)));
        }
        if self.texture.len() > MAX_LISTED_TEXTURES {
            let problem = SceneProblem::TooManyTextures {
                found: self.texture.len(),
                limit: MAX_LISTED_TEXTURES,
            };
            return Err(("texture".into(), problem));
        }
        let mut textures: Vec<TextureEntry> = Vec::new();
        for (index, raw) in self.texture.into_iter().enumerate() {
            let entry = raw.check(index, folder, reach)?;
            if textures.iter().any(|other| other.name == entry.name) {
                let field = format!("texture[{index}].name");
                return Err((field, SceneProblem::SameName(entry.name)));
            }
            textures.push(entry);
        }
        let mut surfaces = Vec::new();
        for (index, raw) in self.surface.into_iter().enumerate() {
            if !textures.iter().any(|texture| texture.name == raw.texture) {
                let known = textures.into_iter().map(|texture| texture.name).collect();
                let field = format!("surface[{index}].texture");
                let wanted = raw.texture;
                return Err((field, SceneProblem::UnknownTexture { wanted, known }));
            }
            surfaces.push(raw.check(index)?);
        }
        let worn = |texture: &TextureEntry| {
            let wears = |surface: &SurfaceEntry| surface.texture == texture.name;
            surfaces.iter().any(wears)
        };
        let sources = textures.iter().filter_map(|texture| match &texture.origin {
            Origin::Import(file) | Origin::Asset(file) => Some(file.clone()),
            Origin::Prompt(..) => None,
        });
        let sources = sources.collect();
        let (textures, unused): (Vec<_>, Vec<_>) = textures.into_iter().partition(worn);
        Ok(Description {
            file: file.to_owned(),
            servo_rate_hz: self.servo_rate_hz,
            textures,
            unused: unused.into_iter().map(|texture| texture.name).collect(),
            surfaces,
            sources,
        })
    }
}

impl RawTexture {
    fn check(self, index: usize, folder: &Path, reach: &Reach) -> Result<TextureEntry, Wrong> {
        let field = |name: &str| format!("texture[{index}].{name}");
        let name = self.name;
        if name.is_empty() || name.len() > MAX_NAME_BYTES || name.chars().any(char::is_control) {
            return Err((field("name"), SceneProblem::Name(name)));
        }
        for (key, stated) in [("import", &self.import), ("asset", &self.asset)] {
            let Some(stated) = stated else {
                continue;
            };
            if let Err(outside) = reach.check(stated, &folder.join(stated)) {
                let stated = stated.clone();
                return Err((field(key), SceneProblem::Outside { stated, outside }));
            }
        }
        let origin = match (self.prompt, self.import, self.asset) {
            (Some(prompt), None, None) => Origin::Prompt(prompt, self.seed.unwrap_or(0)),
            (None, Some(path), None) => Origin::Import(folder.join(path)),
            (None, None, Some(path)) => Origin::Asset(folder.join(path)),
            _ => return Err((format!("texture[{index}]"), SceneProblem::Origin(name))),
        };
        if self.seed.is_some() && !matches!(origin, Origin::Prompt(..)) {
            return Err((field("seed"), SceneProblem::SeedWithoutPrompt));
        }
        Ok(TextureEntry {
            name,
            origin,
            index,
        })
    }
}

impl RawSurface {
    fn check(self, index: usize) -> Result<SurfaceEntry, Wrong> {
        let field = |name: &str| format!("surface[{index}].{name}");
        let place = |name: &str, v: [f64; 3]| vector(&field(name), v, -f64::from(MAX_POSITION_M));
        let size = |name: &str, v: [f64; 3]| vector(&field(name), v, f64::from(MIN_SOLID_M));
        let solid = match (self.plane, self.sphere, self.cuboid) {
            (Some(plane), None, None) => {
                let normal = place("plane.normal", plane.normal)?;
                let longest = normal.into_iter().map(f32::abs).fold(0.0, f32::max);
                size("plane.normal length", [f64::from(longest); 3])?;
                Solid::Plane {
                    point_m: place("plane.point_m", plane.point_m)?,
                    normal,
                }
            }
            (None, Some(sphere), None) => Solid::Sphere {
                center_m: place("sphere.center_m", sphere.center_m)?,
                radius_m: size("sphere.radius_m", [sphere.radius_m; 3])?[0],
            },
            (None, None, Some(cuboid)) => Solid::Box {
                center_m: place("box.center_m", cuboid.center_m)?,
                half_extents_m: size("box.half_extents_m", cuboid.half_extents_m)?,
            },
            _ => return Err((format!("surface[{index}]"), SceneProblem::Solid)),
        };
        let far = f64::from(MAX_POSITION_M);
        let from_m = place("from_m", self.from_m.unwrap_or([-far; 3]))?;
        let to_m = place("to_m", self.to_m.unwrap_or([far; 3]))?;
        for (from, to) in from_m.into_iter().zip(to_m) {
            if from >= to {
                return Err((field("to_m"), SceneProblem::Region { from, to }));
            }
        }
        Ok(SurfaceEntry {
            solid,
            from_m,
            to_m,
            texture: self.texture,
        })
    }
}

fn vector(field: &str, v: [f64; 3], low: f64) -> Result<[f32; 3], Wrong> {
    for x in v {
        in_range(field, x, (low, f64::from(MAX_POSITION_M)))?;
    }
    Ok(v.map(|x| x as f32))
}

fn in_range(field: &str, value: f64, (low, high): (f64, f64)) -> Result<(), Wrong> {
    // A NaN is in no range.
    if (low..=high).contains(&value) {
        Ok(())
    } else {
        Err((field.into(), SceneProblem::Value { value, low, high }))
    }
}
