//! A model that is emitted and imported gives the bytes that its own source gives, except for
//! the provenance; the example of `docs/model.md` is one.

use crate::support;
use asperity::{
    driver,
    emit::raise::raise,
    learned::{embedded, inference::Backend},
    model::{Provenance, TextureModel},
    passes::reduce::Fidelity,
    pipeline::{Request, Ringing},
    sources::{
        SourceOutput, Tools,
        latents::remembered,
        model_file::{self, ModelFile},
        prompt::{self, PromptCompiler},
    },
};
use asperity_formats::Asset;
use std::{fs, path::Path};

/// The model in a file, as bytes that say what `direct` says of where they come from.
fn through_a_file(whole: &TextureModel, request: &Request, direct: &[u8]) -> Vec<u8> {
    let read = model_file::from_json(&model_file::to_json(whole)).expect("an emitted model");
    let direct = Asset::parse(direct).expect("an asset");
    // What it remembers is no part of the model.
    let source = SourceOutput {
        memory: remembered(&direct).expect("a memory"),
        ..SourceOutput::new(read)
    };
    support::compiled(&source, request).lowered.bytes
}

/// Returns the content of an asset without its provenance.
fn content(bytes: &[u8]) -> TextureModel {
    TextureModel {
        provenance: Provenance::default(),
        ..raise(&Asset::parse(bytes).expect("an asset"))
    }
}

/// Imports a model as a user does.
fn imported(folder: &Path, whole: &TextureModel, request: &Request) -> Vec<u8> {
    let file = folder.join("model.json");
    fs::write(&file, model_file::to_json(whole)).expect("a file");
    support::compiled(&ModelFile { file }, request)
        .lowered
        .bytes
}

#[test]
fn a_prompt_gives_the_same_bytes_through_a_file() {
    let folder = tempfile::tempdir().expect("a folder");
    let prompt_compiler = PromptCompiler::embedded(&Backend::Portable).expect("the shipped model");
    for (prompt, seed, fidelity, rate_hz) in [
        ("wet ice", 0, Fidelity::Auto, None),
        ("coarse sandpaper", 3, Fidelity::Full, None),
        ("cork", 0, Fidelity::Order(8), Some(1500.0)),
    ] {
        let request = Request {
            fidelity,
            rate_hz,
            preview_px: None,
            ..Request::default()
        };
        let options = prompt::Options {
            seed,
            request: request.clone(),
        };
        let compiled = prompt_compiler
            .compile(prompt, &options)
            .expect("a texture");
        let again = through_a_file(&compiled.whole, &request, &compiled.lowered.bytes);
        assert_eq!(again, compiled.lowered.bytes, "{prompt}");
        let imported = imported(folder.path(), &compiled.whole, &request);
        assert_eq!(content(&imported), content(&compiled.lowered.bytes));
        let asset = Asset::parse(&imported).expect("an asset");
        let provenance = asset.provenance().expect("provenance");
        assert_eq!(provenance.prompt, Some(prompt));
        assert_eq!((provenance.seed, provenance.source), (seed, "model.json"));
        assert!(provenance.generator.ends_with("import model"));
    }
}

/// The latent is far outside the prior, so that the decoded models ring until they are moved
/// towards white noise: the file holds them as they were verified.
#[test]
fn a_stabilised_texture_is_emitted_as_it_was_verified() {
    let text = Box::new(embedded::text_encoder(&Backend::Portable).expect("the encoder"));
    let model = asperity::learned::LearnedModel::load(embedded::model(), &Backend::Portable);
    let prompt_compiler =
        PromptCompiler::new(text, model.expect("the shipped model")).expect("they fit");
    let model = prompt_compiler.model();
    let request = Request::default();
    let found = (0..4000_u32).find_map(|number| {
        let z = std::array::from_fn(|k| {
            let mixed = (number * 31 + k as u32).wrapping_mul(2_654_435_761);
            2000.0 * (mixed as f32 / u32::MAX as f32 - 0.5)
        });
        let decoded = model.decode(&z).expect("a texture");
        let (texture, _) = asperity::learned::texture::build(
            model.description(),
            &decoded,
            &z,
            "far".into(),
            Provenance::default(),
        );
        let source = SourceOutput {
            ringing: Ringing::Stabilised,
            ..SourceOutput::new(texture)
        };
        let compiled = driver::compile(&source, &request, &Tools::default());
        compiled.ok().filter(|compiled| compiled.stabilised > 0.0)
    });
    let compiled = found.expect("a latent that rings");
    let again = through_a_file(&compiled.whole, &request, &compiled.lowered.bytes);
    assert_eq!(again, compiled.lowered.bytes);
}

#[test]
#[cfg_attr(
    not(hatt),
    ignore = "no HaTT materials; set ASPERITY_HATT to their folder"
)]
fn a_material_gives_the_same_bytes_through_a_file() {
    let folder = tempfile::tempdir().expect("a folder");
    for file in asperity_tests::hatt::materials().into_iter().take(5) {
        for fidelity in [Fidelity::Full, Fidelity::Order(7)] {
            let direct = support::material(&file, fidelity);
            let request = Request {
                fidelity,
                ..Request::default()
            };
            let again = through_a_file(&direct.whole, &request, &direct.lowered.bytes);
            assert_eq!(again, direct.lowered.bytes, "{}", file.display());
            let imported = imported(folder.path(), &direct.whole, &request);
            assert_eq!(content(&imported), content(&direct.lowered.bytes));
        }
    }
}

#[test]
fn the_example_of_the_documentation_compiles() {
    let file = concat!(env!("CARGO_MANIFEST_DIR"), "/../docs/data/corduroy.json");
    for (fidelity, preview) in [(Fidelity::Full, true), (Fidelity::Auto, false)] {
        let request = Request {
            fidelity,
            rate_hz: None,
            preview_px: preview.then_some(asperity::views::preview::SIZE),
            ..Request::default()
        };
        let example = ModelFile { file: file.into() };
        let imported = support::compiled(&example, &request);
        let limit_db = if fidelity == Fidelity::Full { 0.1 } else { 1.0 };
        let error = imported.compared.expect("a source").error;
        assert!(error.max_db < limit_db, "{}", imported.text());
        let asset = Asset::parse(&imported.lowered.bytes).expect("an asset");
        assert_eq!(asset.name(), "Corduroy by hand");
        assert_eq!(asset.preview_png().is_some(), preview);
    }
}
