//! Valid inputs of every kind, which attacks start from.

use super::{
    programs::{Program, Programs},
    recording,
    run::run,
};
use crate::support::builtin;
use asperity::{
    interchange::{ClipFormat, Options, export, session},
    views::preview,
};
use asperity_diffusion::tiny;
use asperity_formats::{SceneSurface, Solid, library};
use asperity_tests::draw::Draw;
use asperity_tests::texture::{TextureKind, random, random_law};
use std::{ffi::OsString, fmt::Write as _, fs, os::unix::fs::symlink, path::Path};
use tempfile::TempDir;

/// A kind of input.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Seed {
    Asset,
    /// An asset that remembers its prompt, so that it can be edited.
    Prompted,
    Library,
    Scene,
    Trajectory,
    Material,
    Model,
    Haptic,
    Ahap,
    Hjif,
    Heights,
    Normals,
    Description,
    Manifest,
    Rows,
    /// A study with people.
    Study,
    ModelFolder,
    Projection,
    TapDecoder,
    Device,
    Grip,
    Counts,
    Recording,
    RecordedWave,
    RecordedArray,
    RecordedTable,
    Measurement,
    Profile,
    Ids,
    /// A recording of a servo loop.
    Session,
    /// The intervals of a measured loop.
    Intervals,
    CacheEntry,
    /// A part of a diffusion folder, by its path in it.
    Diffusion(&'static str),
}

impl Seed {
    /// Returns true if the input is lines of text.
    pub(crate) fn is_text(self) -> bool {
        if let Self::Diffusion(part) = self {
            return !part.ends_with(".onnx");
        }
        !matches!(
            self,
            Self::Asset
                | Self::Prompted
                | Self::Library
                | Self::Scene
                | Self::Heights
                | Self::Normals
                | Self::Projection
                | Self::TapDecoder
                | Self::RecordedWave
                | Self::RecordedArray
                | Self::Session
                | Self::CacheEntry
        )
    }
}

/// A valid input of every kind.
pub(crate) struct Seeds {
    asset: Vec<u8>,
    prompted: Vec<u8>,
    library: Vec<u8>,
    scene: Vec<u8>,
    model: Vec<u8>,
    /// Exports of the built-in texture: `.haptic`, AHAP, HJIF.
    effects: [Vec<u8>; 3],
    /// Pictures of the heights and the normals of the built-in texture.
    pictures: [Vec<u8>; 2],
    /// The shipped model as a folder.
    shipped: TempDir,
    trajectory: String,
    material: String,
    wave: Vec<u8>,
    array: Vec<u8>,
    table: String,
    measurement: String,
    /// A tiny diffusion folder.
    diffusion: Vec<(&'static str, Vec<u8>)>,
    session: Vec<u8>,
    intervals: Vec<u8>,
    /// The only entry of a build's cache, and its path in it.
    cached: (String, Vec<u8>),
}

/// As a target: the entry of the build's cache, whatever its name.
pub(crate) const ENTRY: &str = "cache/ENTRY";
/// A build of one entry.
const CACHED: &str =
    "[defaults]\npreview = false\n[[texture]]\nname = \"cork\"\nprompt = \"cork\"\n";

const DESCRIPTION: &str = "servo_rate_hz = 1000
[[texture]]
name = \"good\"
asset = \"good.asp\"
[[texture]]
name = \"wood\"
import = \"wood.xml\"
[[surface]]
texture = \"good\"
plane = { point_m = [0, 0, 0], normal = [0, 0, 1] }
to_m = [0, 1, 1]
[[surface]]
texture = \"wood\"
box = { center_m = [0, 0, 0], half_extents_m = [0.1, 0.1, 0.1] }
[[surface]]
texture = \"good\"
sphere = { center_m = [0, 0, 0.2], radius_m = 0.1 }
";
/// A library of every kind of entry.
const MANIFEST: &str = "\
[defaults]
preview = false
[[texture]]
name = \"cork\"
prompt = \"cork\"
seed = 3
[[texture]]
name = \"wood\"
import = \"wood.xml\"
fidelity = 8
[[texture]]
name = \"grit\"
asset = \"good.asp\"
[[texture]]
name = \"between\"
blend = { a = \"cork\", b = \"grit\", t = 0.25 }
[[texture]]
name = \"mixed\"
compose = { tap = \"cork\", slide = \"between\" }
edit = { rougher = 10 }
[[texture]]
name = \"softer\"
of = \"mixed\"
edit = { prompt = \"a bit softer, more like leather\" }
";
const ROWS: &str =
    "name,prompt,of,seed,edit.prompt\ncork,cork,,3,\nsofter,,cork,,\"softer, rougher\"\n";
/// A study with every kind of texture, form and step.
const STUDY: &str = "\
name = \"grit\"
title = \"Grit\"
consent = \"\"\"Agree.\"\"\"
midpoints = true
[explore]
seconds = 2.5
[ratings]
catch = 1
[[texture]]
name = \"cork\"
prompt = \"cork\"
anchor = true
[[texture]]
name = \"wood\"
file = \"wood.xml\"
anchor = true
[[texture]]
name = \"between\"
between = [\"cork\", \"wood\"]
t = 0.25
[[attribute]]
name = \"rough\"
question = \"How rough?\"
low = \"smooth\"
high = \"rough\"
[[form]]
name = \"tlx\"
[[form]]
name = \"own\"
after = \"prompts\"
[[form.item]]
name = \"liked\"
question = \"Did you like it?\"
[prompts]
text = \"Type.\"
count = 1
";
const COUNTS: &str = "factor,name,instructions\norder,ar 20,2100\narithmetic,fixed,1900.5\n";
const DEVICE: &str = include_str!("../../../device-sim/devices/touch.toml");
const GRIP: &str = include_str!("../../../device-sim/grips/light.toml");
const IDS: &str = include_str!("../../../host/src/device/usb/ids.toml");
/// A device's profile, with a filter.
const PROFILE: &str = concat!(
    include_str!("../../../host/devices/touch.toml"),
    "\n[compensation]\nrate_hz = 1000.0\ntaps = [1.25, -0.3, 0.05]\n"
);

impl Seeds {
    pub(crate) fn new(programs: &Programs) -> Self {
        let made = tempfile::tempdir().expect("a folder");
        fs::write(made.path().join("cached.toml"), CACHED).expect("a manifest");
        const SERVO: &str =
            "servo --device sim:?time=stepped --record s.aspr --seconds 3 --policy other --no-lock";
        for (program, line) in [
            (Program::Lab, SERVO),
            (
                Program::Lab,
                "jitter --out j --seconds 0.3 --policy other --no-lock",
            ),
            (
                Program::Compiler,
                "build cached.toml -o c.aspl --cache cache",
            ),
            (Program::Compiler, "extract c.aspl cork -o cork.asp"),
        ] {
            let arguments: Vec<OsString> = line.split(' ').map(OsString::from).collect();
            let run = run(programs.path(program), &arguments, made.path());
            assert!(run.status.success(), "{line}: {}", run.stderr);
        }
        let read = |name: &str| fs::read(made.path().join(name)).expect("what was made");
        let only = |folder: &Path| {
            let mut entries = fs::read_dir(folder).expect("a cache").flatten();
            entries.next().expect("an entry").path()
        };
        let cache = made.path().join("cache");
        let entry = only(&only(&cache));
        let entry = entry.strip_prefix(&cache).expect("in the cache");
        let entry = entry.to_str().expect("a name of letters").to_owned();
        let asset = builtin();
        let mut other = random(1, TextureKind::nyquist(4));
        other.law = random_law(&mut Draw::new(1), 200.0, 2.0);
        let other = other.encode();
        let named = [("a", &asset[..]), ("b", &other[..])];
        let shipped = tempfile::tempdir().expect("a folder");
        for (name, bytes) in asperity_model::folder() {
            fs::write(shipped.path().join(name), bytes).expect("the shipped model");
        }
        Self {
            library: encoded(&named, &[]),
            scene: encoded(&named, &[surface(0), surface(1)]),
            model: asperity::sources::model_file::to_json(&asperity::sources::builtin::texture()),
            effects: [ClipFormat::Haptic, ClipFormat::Ahap, ClipFormat::Hjif].map(effects),
            pictures: pictures(),
            shipped,
            asset,
            prompted: read("cork.asp"),
            trajectory: trajectory(),
            material: material(),
            wave: recording::wave(),
            array: recording::array(),
            table: recording::table(),
            measurement: measurement(),
            diffusion: tiny::folder(&tiny::Options::default()),
            session: read("s.aspr"),
            intervals: read("j/run.hlog"),
            cached: (entry.clone(), read(&format!("cache/{entry}"))),
        }
    }

    /// The valid input of a kind.
    pub(crate) fn bytes(&self, seed: Seed) -> &[u8] {
        match seed {
            Seed::Asset => &self.asset,
            Seed::Prompted => &self.prompted,
            Seed::Library => &self.library,
            Seed::Scene => &self.scene,
            Seed::Trajectory => self.trajectory.as_bytes(),
            Seed::Material => self.material.as_bytes(),
            Seed::Model => &self.model,
            Seed::Haptic => &self.effects[0],
            Seed::Ahap => &self.effects[1],
            Seed::Hjif => &self.effects[2],
            Seed::Heights => &self.pictures[0],
            Seed::Normals => &self.pictures[1],
            Seed::Description => DESCRIPTION.as_bytes(),
            Seed::Manifest => MANIFEST.as_bytes(),
            Seed::Rows => ROWS.as_bytes(),
            Seed::Study => STUDY.as_bytes(),
            Seed::ModelFolder => asperity_model::DESCRIPTION.as_bytes(),
            Seed::Projection => asperity_model::TEXT_PROJECTION,
            Seed::TapDecoder => asperity_model::TAP_DECODER,
            Seed::Device => DEVICE.as_bytes(),
            Seed::Grip => GRIP.as_bytes(),
            Seed::Counts => COUNTS.as_bytes(),
            Seed::Recording => recording::DESCRIPTION.as_bytes(),
            Seed::RecordedWave => &self.wave,
            Seed::RecordedArray => &self.array,
            Seed::RecordedTable => self.table.as_bytes(),
            Seed::Measurement => self.measurement.as_bytes(),
            Seed::Profile => PROFILE.as_bytes(),
            Seed::Ids => IDS.as_bytes(),
            Seed::Session => &self.session,
            Seed::Intervals => &self.intervals,
            Seed::CacheEntry => &self.cached.1,
            Seed::Diffusion(part) => {
                let found = self.diffusion.iter().find(|(name, _)| *name == part);
                &found.expect("a part of the tiny folder").1
            }
        }
    }

    /// The path of the entry in the build's cache.
    pub(crate) fn entry(&self) -> &str {
        &self.cached.0
    }

    /// Writes the valid files that the commands read besides the attacked one.
    pub(crate) fn write(&self, folder: &Path) {
        for name in ["", "materials", "model", "clip", "oak", "cache"] {
            fs::create_dir_all(folder.join(name)).expect("a folder");
        }
        let entry = Path::new(self.entry())
            .parent()
            .expect("a folder of the cache");
        fs::create_dir_all(folder.join("cache").join(entry)).expect("a folder");
        fs::write(folder.join("cached.toml"), CACHED).expect("a valid input");
        for (name, seed) in [
            ("good.asp", Seed::Asset),
            ("cork.asp", Seed::Prompted),
            ("scene.aspl", Seed::Scene),
            ("stroke.csv", Seed::Trajectory),
            ("wood.xml", Seed::Material),
            ("scene.toml", Seed::Description),
            ("oak/recording.toml", Seed::Recording),
            ("oak/accel.wav", Seed::RecordedWave),
            ("oak/force.npy", Seed::RecordedArray),
            ("oak/position.csv", Seed::RecordedTable),
            ("sweep.csv", Seed::Measurement),
            ("good.hlog", Seed::Intervals),
        ] {
            fs::write(folder.join(name), self.bytes(seed)).expect("a valid input");
        }
        for (part, bytes) in &self.diffusion {
            let file = folder.join("sd").join(part);
            fs::create_dir_all(file.parent().expect("the folder of a part")).expect("a folder");
            fs::write(file, bytes).expect("a valid input");
        }
        let other = self.material.replace("<material>Wood", "<material>Test");
        fs::write(folder.join("materials/other.xml"), other).expect("a valid input");
        for (name, _) in asperity_model::folder() {
            let file = self.shipped.path().join(name);
            symlink(file, folder.join("model").join(name)).expect("a link");
        }
    }
}

/// The heights and the normals of the built-in texture's preview.
fn pictures() -> [Vec<u8>; 2] {
    let drawn = preview::draw(&asperity::sources::builtin::texture(), 64).expect("a picture");
    [drawn.height_png(), drawn.normal_png()].map(|png| png.expect("an encoded picture"))
}

/// A short stroke and taps of the built-in texture in a format.
fn effects(format: ClipFormat) -> Vec<u8> {
    let bytes = builtin();
    let asset = asperity_formats::Asset::parse(&bytes).expect("the built-in texture");
    let options = Options {
        session: session(None, None, Some(0.3), true),
        rate_hz: None,
        seed: 0,
        full_scale_m_s2: None,
        tap_full_scale_m_s2: None,
        size_px: 64,
    };
    let exported = export(&asset, format, &options);
    exported.expect("an export of the built-in texture").bytes
}

fn surface(texture: u16) -> SceneSurface {
    let solid = Solid::Plane {
        point_m: [0.0, 0.0, -0.001 * f32::from(texture)],
        normal: [0.0, 0.0, 1.0],
    };
    SceneSurface {
        solid,
        from_m: [-1.0; 3],
        to_m: [1.0; 3],
        texture,
    }
}

/// A library, with a scene if it has surfaces.
pub(crate) fn encoded(named: &[(&str, &[u8])], surfaces: &[SceneSurface]) -> Vec<u8> {
    let scene_len = asperity_formats::scene::encoded_len(surfaces.len());
    let mut bytes = vec![0; library::encoded_len(named) + scene_len];
    let len = if surfaces.is_empty() {
        library::encode_library(named, &mut bytes)
    } else {
        library::encode_scene(named, surfaces, &mut bytes)
    };
    bytes.truncate(len.expect("a valid library"));
    bytes
}

/// A tap and a stroke of 300 ticks at 1 kHz.
fn trajectory() -> String {
    (0..300).fold("t_s,x_mm,y_mm,z_mm\n".to_owned(), |mut csv, n| {
        let t_s = f64::from(n) / 1000.0;
        let z_mm = (2.0 - 0.05 * f64::from(n)).max(-1.0);
        // Writing to a string cannot fail.
        let _ = writeln!(csv, "{t_s},{},{},{z_mm}", 100.0 * t_s, -0.01 * f64::from(n));
        csv
    })
}

/// A force of noise on a mass of 45 g, 4 s at 1 kHz.
fn measurement() -> String {
    let mut seed = 1_u64;
    (0..4000).fold("t_s,force_n,accel_m_s2\n".to_owned(), |mut csv, n| {
        seed = seed.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1);
        let force_n = (seed >> 40) as f64 / f64::from(1 << 23) - 1.0;
        let (t_s, accel_m_s2) = (f64::from(n) / 1000.0, force_n / 0.045);
        // Writing to a string cannot fail.
        let _ = writeln!(csv, "{t_s},{force_n},{accel_m_s2}");
        csv
    })
}

/// A material of four corners and a centre, order 2, one zero.
fn material() -> String {
    let (low, high) = (0.8_f64, 2.0_f64);
    let (a1, a2) = (-low.cos() - high.cos(), 1.0 - low.cos() + high.cos());
    let list = |tag: &str, values: &[f64]| {
        let values: String = values
            .iter()
            .map(|v| format!("<value>{v}</value>"))
            .collect();
        format!("<{tag} type=\"array\">{values}</{tag}>\n")
    };
    let places = [
        (0.0, 0.0),
        (200.0, 0.0),
        (200.0, 4.0),
        (0.0, 4.0),
        (80.0, 1.5),
    ];
    let mut xml = "<?xml version=\"1.0\" encoding=\"utf-8\"?>\n<modelSet texture=\"0\">\n\
         <material>Wood</material>\n<AccelUnits>m/s^2</AccelUnits>\n<SpeedUnits>mm/s</SpeedUnits>\n\
         <ForceUnits>N</ForceUnits>\n<SampleRate>1000</SampleRate>\n<mu>0.4</mu>\n\
         <numMod>5</numMod>\n<numTri>4</numTri>\n<maxSpeed>200</maxSpeed>\n<maxForce>4</maxForce>\n"
        .to_owned();
    xml += &list("speedList", &places.map(|p| p.0));
    xml += &list("forceList", &places.map(|p| p.1));
    for triangle in [
        [1.0, 2.0, 5.0],
        [2.0, 3.0, 5.0],
        [3.0, 4.0, 5.0],
        [4.0, 1.0, 5.0],
    ] {
        xml += &list("tri", &triangle);
    }
    xml += "<numARCoeff>2</numARCoeff>\n<numMACoeff>1</numMACoeff>\n";
    for (index, (speed, force)) in places.into_iter().enumerate() {
        let variance = if speed * force == 0.0 { 0.0 } else { 0.01 };
        let _ = writeln!(xml, "<model>\n<modNum>{}</modNum>", index + 1);
        xml += &list("ARcoeff", &[1.0, a1, a2]);
        xml += &list("ARlsf", &[low, high]);
        // One LSF ω: B(z) = 1 − cos ω z⁻¹.
        xml += &list("MAcoeff", &[1.0, -1.5_f64.cos()]);
        xml += &list("MAlsf", &[1.5]);
        let _ = writeln!(
            xml,
            "<var>{variance}</var>\n<gain>2</gain>\n<speedMod>{speed}</speedMod>\n\
             <forceMod>{force}</forceMod>\n</model>"
        );
    }
    xml + "</modelSet>\n"
}
