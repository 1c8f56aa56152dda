//! `preview` and `listen`: what they write, and what they refuse.

use super::*;
use asperity::views::preview::stored;

/// A folder with the built-in texture, and with a model that holds a picture.
fn folder() -> TempDir {
    let folder = tempfile::tempdir().expect("a folder");
    let emit = ["builtin", "-o", "plain.asp", "--emit-model", "cork.json"];
    assert!(asperity(folder.path(), &emit).status.success());
    let import = [
        "import",
        "model",
        "cork.json",
        "-o",
        "cork.asp",
        "--preview-size",
        "128",
    ];
    let output = asperity(folder.path(), &import);
    assert!(output.status.success(), "{}", text(&output.stderr));
    folder
}

fn read(folder: &Path, name: &str) -> Vec<u8> {
    fs::read(folder.join(name)).expect("a file")
}

#[test]
fn a_preview_is_extracted_as_it_is_and_drawn_anew_where_there_is_none() {
    let folder = folder();
    let folder = folder.path();
    let output = asperity(folder, &["preview", "cork.asp", "-o", "kept.png"]);
    assert!(
        text(&output.stdout).contains("as stored in the asset"),
        "{output:?}"
    );
    let bytes = read(folder, "cork.asp");
    let asset = asperity_formats::Asset::parse(&bytes).expect("an asset");
    assert_eq!(
        asset.preview_png(),
        Some(read(folder, "kept.png").as_slice())
    );
    assert_eq!(
        stored(&read(folder, "kept.png")).expect("a picture").width,
        128
    );

    let output = asperity(folder, &["preview", "plain.asp", "-o", "drawn.png"]);
    assert!(
        text(&output.stdout).contains("the asset has no picture"),
        "{output:?}"
    );
    assert_eq!(
        stored(&read(folder, "drawn.png")).expect("a picture").width,
        256
    );
    // Extracted, or drawn anew at its size: the same picture but for the palette.
    let again = [
        "preview",
        "cork.asp",
        "--redraw",
        "--size",
        "128",
        "-o",
        "again.png",
    ];
    assert!(asperity(folder, &again).status.success());
    let (kept, again) = (
        stored(&read(folder, "kept.png")),
        stored(&read(folder, "again.png")),
    );
    let (kept, again) = (kept.expect("a picture").rgb, again.expect("a picture").rgb);
    let error: u64 = kept
        .iter()
        .zip(&again)
        .map(|(a, b)| u64::from(a.abs_diff(*b)))
        .sum();
    assert!(
        error < 12 * kept.len() as u64,
        "{} a channel",
        error / kept.len() as u64
    );
}

#[test]
fn maps_come_with_the_picture_and_standard_output_takes_it() {
    let folder = folder();
    let folder = folder.path();
    let maps = [
        "preview", "cork.asp", "-o", "-", "--size", "64", "--height", "h.png", "--normal", "n.png",
    ];
    let output = asperity(folder, &maps);
    assert!(output.status.success(), "{}", text(&output.stderr));
    assert!(
        text(&output.stderr).contains("newly drawn"),
        "the report goes to standard error"
    );
    assert_eq!(stored(&output.stdout).expect("a picture").width, 64);
    let normals = stored(&read(folder, "n.png")).expect("a map");
    // All of them face the eye, and most of them nearly.
    assert!(normals.rgb.chunks(3).all(|normal| normal[2] > 127));
    let decoder = png::Decoder::new(std::io::Cursor::new(read(folder, "h.png")));
    let reader = decoder.read_info().expect("a map");
    assert_eq!(
        reader.output_color_type(),
        (png::ColorType::Grayscale, png::BitDepth::Sixteen)
    );
}

#[test]
fn a_sound_is_the_same_each_time_and_says_its_gains() {
    let folder = folder();
    let folder = folder.path();
    for name in ["a.wav", "b.wav"] {
        let output = asperity(folder, &["listen", "plain.asp", "-o", name]);
        assert!(output.status.success(), "{}", text(&output.stderr));
        let report = text(&output.stdout);
        for said in [
            "44.1 kHz",
            "6 strokes",
            "3 taps",
            "dB re full scale per m/s²",
        ] {
            assert!(report.contains(said), "{report}");
        }
    }
    assert_eq!(read(folder, "a.wav"), read(folder, "b.wav"));
    assert_eq!(&read(folder, "a.wav")[..4], b"RIFF");
    let one = [
        "listen",
        "plain.asp",
        "-o",
        "-",
        "--speed",
        "80",
        "--force",
        "0.5",
    ];
    let output = asperity(folder, &one);
    assert_eq!(&output.stdout[..4], b"RIFF");
    assert!(
        text(&output.stderr).contains("1 stroke,"),
        "{}",
        text(&output.stderr)
    );
    assert!(!text(&output.stderr).contains(" tap"));
}

#[test]
fn wrong_numbers_and_files_are_refused_with_the_range_and_nothing_is_written() {
    let folder = folder();
    let folder = folder.path();
    fs::write(folder.join("no.asp"), "ASPT and no more").expect("a file");
    let before = entries(folder);
    let cases: [(&[&str], i32, &str); 9] = [
        (
            &["preview", "cork.asp", "-o", "x.png", "--size", "63"],
            2,
            "64 to 1024",
        ),
        (
            &["preview", "cork.asp", "-o", "x.png", "--size", "wide"],
            2,
            "64 to 1024",
        ),
        (
            &["preview", "cork.asp", "-o", "x.png", "--height", "x.png"],
            2,
            "x.png",
        ),
        (&["preview", "cork.asp", "-o", "cork.asp"], 2, "an input"),
        (&["preview", "no.asp", "-o", "x.png"], 1, "no.asp"),
        (
            &["preview", "cork.asp", "--name", "oak", "-o", "x.png"],
            1,
            "oak",
        ),
        (
            &["listen", "cork.asp", "-o", "x.wav", "--speed", "0"],
            2,
            "1 to 1000",
        ),
        (
            &["listen", "cork.asp", "-o", "x.wav", "--force", "NaN"],
            2,
            "0.05 to 20",
        ),
        (
            &["listen", "cork.asp", "-o", "x.wav", "--rate", "1234.5"],
            1,
            "--rate",
        ),
    ];
    for (arguments, status, says) in cases {
        let output = asperity(folder, arguments);
        let error = text(&output.stderr);
        assert_eq!(output.status.code(), Some(status), "{arguments:?}: {error}");
        assert!(error.contains(says), "{arguments:?}: {error}");
        assert_eq!(entries(folder), before, "{arguments:?}");
    }
}
