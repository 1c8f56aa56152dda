//! `--diffusion`: pictures of a tiny model, folders that do not fit, and nothing left over.

use super::*;
use asperity::views::preview::stored;
use asperity_diffusion::tiny;
use asperity_formats::Asset;
use std::{process::Stdio, thread::sleep, time::Duration};

/// A folder with a texture, and a tiny model in `sd/`.
fn folder() -> TempDir {
    let folder = tempfile::tempdir().expect("a folder");
    write_tiny(&folder.path().join("sd"), &tiny::Options::default());
    let builtin = asperity(folder.path(), &["builtin", "-o", "grit.asp"]);
    assert!(builtin.status.success());
    folder
}

fn write_tiny(folder: &Path, options: &tiny::Options) {
    for (part, bytes) in tiny::folder(options) {
        let file = folder.join(part);
        fs::create_dir_all(file.parent().expect("its folder")).expect("a folder");
        fs::write(file, bytes).expect("a part");
    }
}

/// `preview grit.asp -o x.png` on the portable engine, with more arguments.
fn preview(folder: &Path, more: &[&str]) -> Output {
    let mut arguments = vec!["preview", "grit.asp", "-o", "x.png", "--diffusion", "sd"];
    if !more.contains(&"--diffusion-backend") {
        arguments.extend(["--diffusion-backend", "portable"]);
    }
    arguments.extend(more);
    asperity(folder, &arguments)
}

/// The texts that a PNG holds, by their keys.
fn texts(bytes: &[u8]) -> Vec<(String, String)> {
    let decoder = png::Decoder::new(std::io::Cursor::new(bytes));
    let reader = decoder.read_info().expect("a picture");
    let chunks = reader.info().utf8_text.iter();
    chunks
        .map(|chunk| (chunk.keyword.clone(), chunk.get_text().expect("text")))
        .collect()
}

#[test]
fn a_picture_of_diffusion_says_what_made_it_and_repeats_to_the_byte() {
    let folder = folder();
    let folder = folder.path();
    let more = [
        "--prompt",
        "corkwood\u{e9}",
        "--negative",
        "grass",
        "--seed",
        "5",
        "--scheduler",
        "euler",
        "--steps",
        "4",
        "--tile",
    ];
    let output = preview(folder, &more);
    assert!(output.status.success(), "{}", text(&output.stderr));
    let made = "by diffusion: asperity/tiny, euler, 4 steps, guidance 7.5, seed 5, repeats";
    assert!(
        text(&output.stdout).contains(made),
        "{}",
        text(&output.stdout)
    );
    let first = fs::read(folder.join("x.png")).expect("a picture");
    assert_eq!(stored(&first).expect("a picture").width, 128);
    let said = texts(&first);
    for expected in [
        ("Description", "corkwood\u{e9}"),
        ("Comment", made),
        ("Comment", "not: grass"),
    ] {
        let expected = (expected.0.to_owned(), expected.1.to_owned());
        assert!(said.contains(&expected), "{said:?}");
    }
    assert!(preview(folder, &more).status.success());
    assert_eq!(fs::read(folder.join("x.png")).expect("a picture"), first);
    let larger = preview(folder, &["--size", "200"]);
    assert!(larger.status.success());
    let larger = fs::read(folder.join("x.png")).expect("a picture");
    assert_eq!(stored(&larger).expect("a picture").width, 200);
    // Without a prompt in the asset, its name is what is shown.
    let said = texts(&larger);
    let shown = said.iter().find(|(key, _)| key == "Description");
    let shown = &shown.expect("a prompt").1;
    assert!(shown.ends_with(", texture, top view, seamless"), "{shown}");
}

#[test]
#[ignore = "needs ONNX Runtime"]
fn compile_embeds_the_picture_and_says_so_in_the_notes() {
    let folder = folder();
    let folder = folder.path();
    let plain = ["compile", "cork", "-o", "plain.asp"];
    assert!(asperity(folder, &plain).status.success());
    let with = ["compile", "cork", "-o", "with.asp", "--diffusion", "sd"];
    let output = asperity(folder, &with);
    assert!(output.status.success(), "{}", text(&output.stderr));
    let read = |name: &str| fs::read(folder.join(name)).expect("an asset");
    let (plain, with) = (read("plain.asp"), read("with.asp"));
    let (plain, with) = (
        Asset::parse(&plain).expect("an asset"),
        Asset::parse(&with).expect("an asset"),
    );
    let made = "by diffusion: asperity/tiny, ddim, 30 steps, guidance 7.5, seed 0";
    assert!(text(&output.stdout).contains(made));
    let notes = asperity::emit::raise::raise(&with).provenance.notes;
    assert!(notes.ends_with(&format!("Preview {made}.")), "{notes}");
    let picture = with.preview_png().expect("a picture");
    assert!(picture.len() <= 25_000, "{} bytes", picture.len());
    assert_eq!(stored(picture).expect("a picture").width, 256);
    assert_eq!(texts(picture), [("Comment".to_owned(), made.to_owned())]);
    // What is felt is the same.
    let haptic = |asset: &Asset<'_>| -> Vec<Vec<u8>> {
        let sections = asset.sections().filter(|section| section.is_haptic());
        sections
            .map(|section| asset.section(&section).expect("its bytes").to_vec())
            .collect()
    };
    assert_eq!(haptic(&plain), haptic(&with));
}

#[test]
fn a_missing_part_is_named_and_nothing_is_written() {
    for part in [
        "model_index.json",
        "scheduler/scheduler_config.json",
        "tokenizer/vocab.json",
        "tokenizer/merges.txt",
        "text_encoder/model.onnx",
        "unet/model.onnx",
        "vae_decoder/model.onnx",
    ] {
        let folder = folder();
        let folder = folder.path();
        fs::remove_file(folder.join("sd").join(part)).expect("a part");
        let before = entries(folder);
        let output = preview(folder, &[]);
        let error = text(&output.stderr);
        assert_eq!(output.status.code(), Some(1), "{part}: {error}");
        assert!(
            error.contains(part) && error.contains("optimum-cli"),
            "{error}"
        );
        assert_eq!(entries(folder), before);
    }
    // These have defaults.
    for part in ["tokenizer/tokenizer_config.json", "vae_decoder/config.json"] {
        let folder = folder();
        fs::remove_file(folder.path().join("sd").join(part)).expect("a part");
        assert!(preview(folder.path(), &[]).status.success(), "{part}");
    }
}

#[test]
fn a_part_that_does_not_fit_is_named_with_what_to_do() {
    let wider = tiny::Options {
        unet_text_width: 1024,
        ..tiny::Options::default()
    };
    let broken = tiny::Options {
        is_broken: true,
        ..tiny::Options::default()
    };
    let part = |options: &tiny::Options, part: &str| {
        let found = tiny::folder(options)
            .into_iter()
            .find(|(name, _)| *name == part);
        found.expect("a part").1
    };
    let plain = tiny::Options::default();
    for (name, bytes, says) in [
        (
            "unet/model.onnx",
            part(&wider, "unet/model.onnx"),
            "1024, and text_encoder/model.onnx gives 12",
        ),
        (
            "unet/model.onnx",
            part(&broken, "unet/model.onnx"),
            "NaN at step 1 of 30",
        ),
        (
            "unet/model.onnx",
            part(&plain, "vae_decoder/model.onnx"),
            "no input `sample`",
        ),
        (
            "unet/model.onnx",
            b"no network".to_vec(),
            "not an ONNX file",
        ),
        (
            "tokenizer/merges.txt",
            b"#version: 0.2\n".to_vec(),
            "0 merges",
        ),
        ("tokenizer/vocab.json", b"{\"a\": -1}".to_vec(), "`a`"),
        (
            "scheduler/scheduler_config.json",
            b"{\"prediction_type\": \"sample\"}".to_vec(),
            "prediction_type",
        ),
        (
            "model_index.json",
            b"{\"_class_name\": \"FluxPipeline\"}".to_vec(),
            "FluxPipeline",
        ),
        ("unet/config.json", vec![b' '; 2 << 20], "1048576 bytes"),
    ] {
        let folder = folder();
        let folder = folder.path();
        fs::write(folder.join("sd").join(name), bytes).expect("a part");
        let before = entries(folder);
        let output = preview(folder, &[]);
        let error = text(&output.stderr);
        assert_eq!(output.status.code(), Some(1), "{name}: {error}");
        assert!(
            error.contains(says) && error.contains("help:"),
            "{says}: {error}"
        );
        assert_eq!(entries(folder), before);
    }
}

#[test]
fn wrong_usage_is_refused_before_anything_is_read() {
    let folder = folder();
    let folder = folder.path();
    let before = entries(folder);
    for (more, says) in [
        (&["--steps", "0"][..], "1..=1000"),
        (&["--guidance", "NaN"], "1 to 30"),
        (&["--scheduler", "pndm"], "`ddim` or `euler`"),
        (&["--size", "32"], "64 to 1024"),
        (&["--redraw"], "--redraw"),
        (&["--normal", "n.png"], "--normal"),
        (&["--diffusion-backend", "gpu"], "onnxruntime"),
    ] {
        let output = preview(folder, more);
        let error = text(&output.stderr);
        assert_eq!(output.status.code(), Some(2), "{more:?}: {error}");
        assert!(error.contains(says), "{more:?}: {error}");
    }
    for alone in [
        "--tile",
        "--prompt=x",
        "--seed=1",
        "--steps=3",
        "--negative=x",
    ] {
        let output = asperity(folder, &["preview", "grit.asp", "-o", "x.png", alone]);
        assert_eq!(output.status.code(), Some(2), "{alone}");
        assert!(text(&output.stderr).contains("--diffusion"), "{alone}");
    }
    let into = [
        "preview",
        "grit.asp",
        "-o",
        "sd/unet/model.onnx",
        "--diffusion",
        "sd",
    ];
    let output = asperity(folder, &into);
    assert_eq!(output.status.code(), Some(2));
    assert!(text(&output.stderr).contains("an input"));
    assert_eq!(entries(folder), before);
}

#[test]
fn without_onnx_runtime_the_error_says_how_to_get_it() {
    let folder = folder();
    let output = Command::new(env!("CARGO_BIN_EXE_asperity"))
        .args(["preview", "grit.asp", "-o", "x.png", "--diffusion", "sd"])
        .env("ASPERITY_ONNXRUNTIME", "/nowhere")
        .current_dir(folder.path())
        .output()
        .expect("the command runs");
    let error = text(&output.stderr);
    assert_eq!(output.status.code(), Some(1));
    assert!(error.contains("pip install onnxruntime"), "{error}");
    assert_eq!(error.matches("/nowhere").count(), 1, "{error}");
    assert_eq!(entries(folder.path()), ["grit.asp", "sd"]);
}

/// Claim: both engines give the same picture, but for roundings of one level.
#[test]
#[ignore = "needs ONNX Runtime"]
fn onnx_runtime_gives_the_picture_of_the_portable_engine() {
    let folder = folder();
    let folder = folder.path();
    for more in [
        &["--scheduler", "ddim", "--tile"][..],
        &["--scheduler", "euler"],
    ] {
        let pixels = |backend: &str| {
            let output = preview(folder, &[more, &["--diffusion-backend", backend]].concat());
            assert!(output.status.success(), "{}", text(&output.stderr));
            let bytes = fs::read(folder.join("x.png")).expect("a picture");
            stored(&bytes).expect("a picture").rgb
        };
        let (portable, runtime) = (pixels("portable"), pixels("onnxruntime"));
        let pairs = portable.iter().zip(&runtime);
        let largest = pairs.map(|(a, b)| a.abs_diff(*b)).max();
        assert!(
            portable.len() == runtime.len() && largest <= Some(1),
            "{largest:?}"
        );
    }
}

/// Claim: whenever it comes, an interrupt leaves the whole picture or none.
#[cfg(unix)]
#[test]
fn an_interrupt_leaves_nothing_behind() {
    let folder = folder();
    let folder = folder.path();
    for wait_ms in [20, 60, 150, 400] {
        let mut child = Command::new(env!("CARGO_BIN_EXE_asperity"))
            .args(["preview", "grit.asp", "-o", "x.png", "--diffusion", "sd"])
            .args([
                "--diffusion-backend",
                "portable",
                "--steps",
                "900",
                "--tile",
            ])
            .current_dir(folder)
            .stdout(Stdio::null())
            .stderr(Stdio::null())
            .spawn()
            .expect("it starts");
        sleep(Duration::from_millis(wait_ms));
        let id = child.id().to_string();
        let _ = Command::new("kill").args(["-INT", &id]).status();
        let status = child.wait().expect("it ends");
        if status.success() {
            let bytes = fs::read(folder.join("x.png")).expect("a picture");
            assert!(stored(&bytes).is_ok());
            fs::remove_file(folder.join("x.png")).expect("a picture");
        }
        assert_eq!(entries(folder), ["grit.asp", "sd"], "after {wait_ms} ms");
    }
}
