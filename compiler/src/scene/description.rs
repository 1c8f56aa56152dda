//! A scene: a manifest with a servo rate, and surfaces that wear its textures.

use crate::{library::Manifest, passes::rerate, pipeline::serves, sources::Registry};
use asperity_formats::{
    Solid,
    limits::{MAX_POSITION_M, MAX_SURFACES, MIN_SOLID_M},
};
use asperity_io::{
    diagnostic::{Failures, Fault, all, one},
    input::{self, InputKind, Reach},
    shown::suggestion,
    toml_error::TomlError,
};
use serde::Deserialize;
use std::path::Path;
use toml::de::{DeTable, DeValue};

/// A checked scene.
#[derive(Debug, Clone)]
pub struct Description {
    /// Its textures, worn or not. Each is asked to serve the loop.
    pub manifest: Manifest,
    /// Rate of the servo loop, Hz.
    pub servo_rate_hz: f64,
    /// The surfaces, at least one.
    pub surfaces: Vec<SurfaceEntry>,
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
    /// Index of its texture in the manifest.
    pub texture: usize,
}

/// Keys of a scene besides its textures. Unknown keys are faults of the manifest.
#[derive(Debug, Deserialize)]
struct RawScene {
    #[serde(default = "default_rate")]
    servo_rate_hz: f64,
    #[serde(default)]
    surface: Vec<RawSurface>,
}

fn default_rate() -> f64 {
    1000.0
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
    /// Every fault of its textures, and the first of its surfaces.
    pub fn read(file: &Path) -> Result<Self, Failures> {
        let text = input::read_text(file, InputKind::Scene);
        let text = text.map_err(|problem| one(Fault::from(problem).at(file)))?;
        Self::within(file, &text, Reach::Anywhere, &Registry::default())
    }

    /// Checks the text of a scene that may name only files within reach, and sources of a registry.
    ///
    /// # Errors
    /// As [`read`](Self::read), and every path that leads elsewhere.
    pub fn within(
        file: &Path,
        text: &str,
        reach: Reach,
        registry: &Registry,
    ) -> Result<Self, Failures> {
        let told = |fault: Fault| one(fault.at(file));
        let scene = RawScene::read(text).map_err(told);
        match Manifest::of_scene(file, text, reach, registry) {
            Ok(manifest) => scene?.wearing(manifest).map_err(told),
            Err(faults) => {
                let mut failures = all(faults);
                // What is no TOML is said once.
                if DeTable::parse(text).is_ok() {
                    failures.extend(scene.err().into_iter().flatten());
                }
                Err(failures)
            }
        }
    }

    /// The textures that a surface wears, each once, in order of name.
    #[must_use]
    pub fn worn(&self) -> Vec<usize> {
        let worn = |index: &usize| self.surfaces.iter().any(|s| s.texture == *index);
        (0..self.manifest.entries.len()).filter(worn).collect()
    }

    /// Names of the textures that no surface wears and none is made of.
    #[must_use]
    pub fn unused(&self) -> Vec<String> {
        let entries = &self.manifest.entries;
        let mut used = vec![false; entries.len()];
        let mut open = self.worn();
        while let Some(index) = open.pop() {
            if !std::mem::replace(&mut used[index], true) {
                open.extend(entries[index].origin.parts());
            }
        }
        let all = entries.iter().zip(used);
        all.filter(|(_, used)| !used)
            .map(|(entry, _)| entry.name.clone())
            .collect()
    }
}

/// A surface that was checked, and the name of its texture.
type Surface = (SurfaceEntry, String);

/// A scene whose textures are names yet.
struct Furnished {
    servo_rate_hz: f64,
    surfaces: Vec<Surface>,
}

impl RawScene {
    fn read(text: &str) -> Result<Furnished, Fault> {
        let raw: Self = toml::from_str(text).map_err(|error| {
            if is_single(text) {
                let what = "one table in single brackets, but a list of tables is expected";
                let remedy = "write [[surface]], in double brackets, above each of them";
                Fault::new(what, remedy).field("surface")
            } else {
                let error = TomlError::new(text, &error);
                Fault::new(error, "see the example in docs/scenes.md")
            }
        })?;
        let (low, _) = rerate::RATE_RANGE_HZ;
        // Loops faster than a texture can be converted to are multiples of its rate.
        in_range("servo_rate_hz", raw.servo_rate_hz, (low, 20_000.0))?;
        if raw.surface.is_empty() {
            let remedy = "add a [[surface]] with a texture and a plane, sphere or box";
            return Err(Fault::new("the scene has no surface", remedy).field("surface"));
        }
        if raw.surface.len() > MAX_SURFACES {
            let count = raw.surface.len();
            let what = format!("{count} surfaces, but a scene has at most 64");
            return Err(Fault::new(what, "split the scene").field("surface"));
        }
        let surfaces = raw.surface.into_iter().enumerate();
        let surfaces = surfaces.map(|(index, raw)| raw.check(index));
        Ok(Furnished {
            servo_rate_hz: raw.servo_rate_hz,
            surfaces: surfaces.collect::<Result<_, _>>()?,
        })
    }
}

impl Furnished {
    fn wearing(self, mut manifest: Manifest) -> Result<Description, Fault> {
        let servo_hz = self.servo_rate_hz;
        for entry in &mut manifest.entries {
            let request = &mut entry.options.request;
            request.servo_rate_hz = Some(servo_hz);
            if let Some(rate_hz) = request
                .rate_hz
                .filter(|rate_hz| !serves(servo_hz, *rate_hz))
            {
                let what = format!("{rate_hz} Hz does not divide the servo_rate_hz of {servo_hz}");
                let remedy = "leave the rate out, or state one that divides servo_rate_hz";
                let field = format!("texture {:?}: rate", entry.name);
                return Err(Fault::new(what, remedy).field(field));
            }
        }
        let mut surfaces = Vec::with_capacity(self.surfaces.len());
        for (index, (surface, wanted)) in self.surfaces.into_iter().enumerate() {
            let names = || manifest.entries.iter().map(|entry| entry.name.as_str());
            let Some(texture) = names().position(|name| name == wanted) else {
                let known: Vec<&str> = names().collect();
                let what = format!("no texture {wanted:?}; the scene has {known:?}");
                let remedy =
                    format!("add a [[texture]] with name = {wanted:?}, or correct the name");
                let fault = Fault::new(what, remedy).suggest(suggestion(&wanted, known));
                return Err(fault.field(format!("surface[{index}].texture")));
            };
            surfaces.push(SurfaceEntry { texture, ..surface });
        }
        Ok(Description {
            manifest,
            servo_rate_hz: servo_hz,
            surfaces,
        })
    }
}

/// Returns true if the list of surfaces is a single table, in single brackets.
fn is_single(text: &str) -> bool {
    let Ok(top) = DeTable::parse(text) else {
        return false;
    };
    let surface = top.get_ref().get("surface").map(|value| value.get_ref());
    matches!(surface, Some(DeValue::Table(_)))
}

impl RawSurface {
    fn check(self, index: usize) -> Result<Surface, Fault> {
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
            _ => {
                let what = "a surface must have exactly one of `plane`, `sphere` and `box`";
                let remedy =
                    "give one, such as plane = { point_m = [0, 0, 0], normal = [0, 0, 1] }";
                return Err(Fault::new(what, remedy).field(format!("surface[{index}]")));
            }
        };
        let far = f64::from(MAX_POSITION_M);
        let from_m = place("from_m", self.from_m.unwrap_or([-far; 3]))?;
        let to_m = place("to_m", self.to_m.unwrap_or([far; 3]))?;
        for (from, to) in from_m.into_iter().zip(to_m) {
            if from >= to {
                let what = format!("{to} m is not above {from} m of from_m");
                let remedy = "swap the corners: from_m is the lower one on every axis";
                return Err(Fault::new(what, remedy).field(field("to_m")));
            }
        }
        let surface = SurfaceEntry {
            solid,
            from_m,
            to_m,
            texture: 0,
        };
        Ok((surface, self.texture))
    }
}

fn vector(field: &str, v: [f64; 3], low: f64) -> Result<[f32; 3], Fault> {
    for x in v {
        in_range(field, x, (low, f64::from(MAX_POSITION_M)))?;
    }
    Ok(v.map(|x| x as f32))
}

fn in_range(field: &str, value: f64, (low, high): (f64, f64)) -> Result<(), Fault> {
    // A NaN is in no range.
    if (low..=high).contains(&value) {
        Ok(())
    } else {
        let what = format!("{value} is not from {low} to {high}");
        let remedy = "give a number in that range; lengths are in metres";
        Err(Fault::new(what, remedy).field(field))
    }
}
