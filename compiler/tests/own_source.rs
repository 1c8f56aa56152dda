//! A source that the crate does not know goes the way of every other: compiled, named by a manifest,
//! mixed there, exported. It is a sine grating under a tip: a line at v/λ, narrow, at every force.

use asperity::{
    driver::{self, Failure},
    emit::raise::raise,
    interchange::{self, ClipFormat, session},
    learned::{edges, inference::Backend},
    library::{Build, Manifest, Request as BuildRequest},
    model::{GridVertex, ModelGrid, Numerator, TextureModel, VertexKind, triangulate},
    passes::reduce::Fidelity,
    pipeline::{Pass, Pipeline, Request},
    scene::{self, Budget, Description},
    signal::{lsf, spectrum::ArmaModel},
    sources::{
        ManifestSource, Operand, Registry, Source, SourceKind, SourceOutput, Tools, builtin,
        key::Parts, prompt::PromptCompiler,
    },
};
use asperity_formats::{Asset, Library};
use asperity_io::{diagnostic::Diagnostic, input::Reach};
use std::{f64::consts::TAU, path::Path, sync::Arc};

/// A grating of a period, mm.
#[derive(Debug)]
struct Grating(f64);

#[derive(Debug, thiserror::Error)]
#[error("{0:?} is no period in mm")]
struct NoPeriod(String);

impl Diagnostic for NoPeriod {
    fn remedy(&self) -> String {
        "give a number above zero".into()
    }
}

const KIND: SourceKind = SourceKind {
    key: "grating",
    operand: Operand::Text,
    open: |stated| {
        let period_mm = stated.text.parse().ok().filter(|mm: &f64| *mm > 0.0);
        let period_mm = period_mm.ok_or_else(|| NoPeriod(stated.text.to_owned()))?;
        Ok(Arc::new(Grating(period_mm)))
    },
    options: &[],
    refuses: &["texture", "seed"],
    fidelity: Fidelity::Full,
    preview: false,
};

impl Source for Grating {
    fn model(
        &self,
        _: &Request,
        _: &Tools<'_>,
        pipeline: &mut Pipeline,
    ) -> Result<SourceOutput, Failure> {
        Ok(SourceOutput::new(
            pipeline.run(Pass::Generate, || self.texture()),
        ))
    }
}

impl ManifestSource for Grating {
    fn key(&self, parts: Parts, _: &Tools<'_>) -> Result<Parts, Failure> {
        Ok(parts.number(self.0))
    }
}

impl Grating {
    fn texture(&self) -> TextureModel {
        let speeds = [40.0, 80.0, 120.0, 160.0, 200.0];
        let at = |speed_mm_s: f64, force_n: f64| {
            let (radius, angle) = (0.97, TAU * speed_mm_s / self.0 / 1000.0);
            let a = [1.0, -2.0 * radius * angle.cos(), radius * radius];
            GridVertex {
                speed_mm_s,
                force_n,
                kind: VertexKind::Interior,
                lsf_rad: lsf::from_polynomial(&a).unwrap(),
                ma_lsf_rad: None,
                gain: 1.0,
                sigma_m_s2: 0.002 * speed_mm_s * force_n.sqrt(),
            }
        };
        let interior = [0.5, 1.5, 2.5].map(|force_n| speeds.map(|speed| at(speed, force_n)));
        let vertices = edges::close(interior.concat(), 240.0, 3.2);
        TextureModel {
            name: format!("grating of {} mm", self.0),
            grid: ModelGrid {
                sample_rate_hz: 1000.0,
                order: 2,
                numerator: Numerator::None,
                triangles: triangulate::delaunay(&vertices),
                vertices,
            },
            ..builtin::texture()
        }
    }
}

/// The loudest frequency of an asset at a vertex, Hz.
fn line_hz(bytes: &[u8], speed_mm_s: f64) -> f64 {
    let grid = raise(&Asset::parse(bytes).unwrap()).grid;
    let at = |v: &&GridVertex| v.speed_mm_s == speed_mm_s && v.kind == VertexKind::Interior;
    let vertex = grid.vertices.iter().find(at).unwrap();
    let model = ArmaModel::at_vertex(&grid, vertex);
    let power = |tenth: &u32| model.power(f64::from(*tenth) / 10.0);
    let loudest = (1..5000).max_by(|a, b| power(a).total_cmp(&power(b)));
    f64::from(loudest.unwrap()) / 10.0
}

#[test]
fn it_is_compiled_and_exported() {
    let compiled = driver::compile(&Grating(2.0), &Request::default(), &Tools::default()).unwrap();
    let bytes = &compiled.lowered.bytes;
    for speed_mm_s in [80.0, 160.0] {
        let off_hz = line_hz(bytes, speed_mm_s) - speed_mm_s / 2.0;
        assert!(off_hz.abs() < 2.0, "{off_hz} Hz at {speed_mm_s} mm/s");
    }
    let options = interchange::Options {
        session: session(Some(100.0), Some(1.0), Some(0.5), false),
        rate_hz: None,
        seed: 0,
        full_scale_m_s2: None,
        tap_full_scale_m_s2: None,
        size_px: 64,
    };
    let asset = Asset::parse(bytes).unwrap();
    let exported = interchange::export(&asset, ClipFormat::Hjif, &options).unwrap();
    assert!(exported.bytes.starts_with(b"{"));
}

fn open() -> Result<PromptCompiler, Vec<Box<dyn Diagnostic>>> {
    Ok(PromptCompiler::embedded(&Backend::Portable).unwrap())
}

/// Builds a manifest that may name gratings.
fn built(text: &str) -> Result<Vec<u8>, String> {
    let registry = Registry::default().with(KIND);
    built_with(Path::new("gratings.toml"), text, &registry)
}

/// Builds a manifest that may name sources of a registry.
pub(crate) fn built_with(file: &Path, text: &str, registry: &Registry) -> Result<Vec<u8>, String> {
    let told = |failures: Vec<Box<dyn Diagnostic>>| {
        let first = &failures[0];
        format!("{first}; {}", first.remedy())
    };
    let manifest = Manifest::within(file, text, Reach::Anywhere, registry)
        .map_err(|errors| format!("{}; {}", errors[0], errors[0].remedy))?;
    let request = BuildRequest::default();
    let build = Build::new(&manifest, &request).map_err(told)?;
    let built = build.run(&open, &|| ()).map_err(told)?;
    let mut bytes = Vec::new();
    built.library.write(&mut bytes).unwrap();
    Ok(bytes)
}

#[test]
fn a_manifest_names_it_beside_the_others_and_mixes_it() {
    let bytes = built(
        r#"
        [[texture]]
        name = "fine"
        grating = "0.8"
        [[texture]]
        name = "coarse"
        grating = "3"
        [[texture]]
        name = "cork"
        prompt = "cork"
        [[texture]]
        name = "between"
        blend = { a = "coarse", b = "cork", t = 0.5 }
        "#,
    );
    let bytes = bytes.unwrap();
    let library = Library::parse(&bytes).unwrap();
    let asset = |name: &str| {
        let place = library.index().find(name).unwrap();
        library.bytes(place).unwrap().to_vec()
    };
    assert!((line_hz(&asset("coarse"), 120.0) - 40.0).abs() < 2.0);
    assert!((line_hz(&asset("fine"), 80.0) - 100.0).abs() < 2.0);
    let between = asset("between");
    assert!(Asset::parse(&between).unwrap().latents().is_some());
}

#[test]
fn a_scene_wears_it() {
    let registry = Registry::default().with(KIND);
    let text = "servo_rate_hz = 3000\n[[texture]]\nname = \"coarse\"\ngrating = \"3\"\n\
                [[surface]]\ntexture = \"coarse\"\nsphere = { center_m = [0, 0, 0], radius_m = 0.1 }\n";
    let file = Path::new("desk.toml");
    let scene = Description::within(file, text, Reach::Anywhere, &registry).unwrap();
    let built = scene::build(
        &scene,
        &Budget::default(),
        &BuildRequest::default(),
        &open,
        &|| (),
    )
    .unwrap();
    let library = Library::parse(&built.bytes).unwrap();
    assert_eq!(library.scene().unwrap().surfaces().len(), 1);
    assert!((line_hz(library.bytes(0).unwrap(), 120.0) - 40.0).abs() < 2.0);
}

#[test]
fn its_faults_are_told_like_those_of_every_source() {
    let one = |entry: &str| built(&format!("[[texture]]\nname = \"x\"\n{entry}")).unwrap_err();
    let period = one("grating = \"wide\"");
    assert!(
        period.contains("gratings.toml:3: grating: \"wide\" is no period"),
        "{period}"
    );
    let seed = one("grating = \"2\"\nseed = 1");
    assert!(
        seed.contains("seed: cannot be combined with grating"),
        "{seed}"
    );
    let nothing = one("fidelity = \"full\"");
    assert!(
        nothing.contains("no source; a texture has one of")
            && nothing.contains("asset, grating, of, blend and compose"),
        "{nothing}"
    );
}
