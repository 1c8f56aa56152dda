//! Accepted inputs, refused inputs, and the time that a refusal may take.

use super::*;
use std::{
    fs::{self, File},
    io::Read as _,
    path::Path,
};

#[test]
fn a_file_is_read_up_to_its_limit_and_no_further() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("file");
    for kind in InputKind::ALL {
        // No bytes on the disk.
        let limit = kind.max_bytes();
        File::create(&path).unwrap().set_len(limit + 1).unwrap();
        let problem = read(&path, kind).unwrap_err();
        let text = problem.to_string();
        assert!(
            matches!(problem, InputProblem::TooLarge { .. }) && text.contains(&limit.to_string()),
            "{kind}: {text}"
        );
        assert!(problem.remedy().contains("docs/limits.md"), "{kind}");
    }
    File::create(&path)
        .unwrap()
        .set_len(InputKind::Scene.max_bytes())
        .unwrap();
    let bytes = read(&path, InputKind::Scene).unwrap();
    assert_eq!(bytes.len() as u64, InputKind::Scene.max_bytes());
    let endless = to_end(std::io::repeat(b'#'), InputKind::Scene).unwrap_err();
    assert!(
        matches!(endless, InputProblem::TooLarge { .. }),
        "{endless}"
    );
}

#[test]
fn a_pointer_is_refused_for_every_kind_and_words_are_no_format() {
    let pointer = b"version https://git-lfs.github.com/spec/v1\noid sha256:0\nsize 1\n";
    let words = br#"{"Pattern": 1, "perceptions": 2, "signals": 3}"#;
    for kind in InputKind::ALL {
        let problem = to_end(&pointer[..], kind).unwrap_err();
        assert!(
            matches!(problem, InputProblem::LfsPointer),
            "{kind}: {problem}"
        );
        assert!(problem.remedy().contains("git lfs pull"), "{kind}");
    }
    for kind in [
        InputKind::Vocabulary,
        InputKind::DiffusionConfig,
        InputKind::Description,
    ] {
        assert!(to_end(&words[..], kind).is_ok(), "{kind}");
    }
    let scene = to_end(&words[..], InputKind::Scene).unwrap_err();
    assert_eq!(
        scene.to_string(),
        "an AHAP (Apple Haptic and Audio Pattern), not a scene"
    );
}

#[test]
fn a_format_is_told_by_what_is_in_a_file_also_where_it_is_cut_or_damaged() {
    for (bytes, format) in [
        (
            &b"\xef\xbb\xbf {\"Pattern\": [{\"Event\""[..],
            Some(Format::Ahap),
        ),
        (b"{\"Version\": 1,\n\"Pattern\": [1 2]}", Some(Format::Ahap)),
        (b"{\"signals\": {\"a\": \"\xc3", Some(Format::Haptic)),
        (b"{\"format\": \"asperity-model\"}", Some(Format::Model)),
        (b"{\"project\": \"signals\"}", None),
        (b"<?xml version='1.0'?><modelSet>", Some(Format::Hatt)),
        (b"<modelset>", None),
        (b"[\"Pattern\"]", None),
        (b"", None),
        (&[0; 4096], None),
    ] {
        assert_eq!(
            Format::of(bytes),
            format,
            "{}",
            String::from_utf8_lossy(bytes)
        );
    }
}

#[test]
fn what_nothing_reads_is_named_and_what_is_read_is_not_taken_for_it() {
    for (bytes, name) in [
        (&b"{\"version\": 0, \"tracks\": []}"[..], "version 0"),
        (b"{\"asset\": {\"version\": \"2.0\",},}", "glTF"),
        (
            b"<?xml version='1.0'?>\n<!-- a <b> -->\n<vibration-effect>",
            "Android vibration (XML)",
        ),
        (
            b"<vibration-select><vibration-effect/></vibration-select>",
            "Android vibration (XML)",
        ),
        (
            b"{\"amplitudes\": [0, 255], \"timings\": [1, 2], \"repeat\": -1}",
            "waveform",
        ),
        (
            b"{\"actions\": [{\"at\": 0, \"pos\": 1}, {\"at\": 1}]}",
            "funscript",
        ),
        (
            b"{\"actions\": [{\"name\": \"/actions/a\"}], \"action_sets\": []}",
            "SteamVR",
        ),
        (b"bplist00\xd2", "property list"),
        (
            b"<!DOCTYPE plist PUBLIC \"-//Apple\" \"http://x\">\n<plist version=\"1.0\">",
            "property list",
        ),
        (
            b"%YAML 1.1\n%TAG !u! tag:unity3d.com,2011:\n--- !u!114",
            "Unity asset",
        ),
        (b"fileFormatVersion: 2\nguid: 0", "Unity .meta"),
        (b"404: Not Found", "server's message"),
        (b"403 Forbidden\n", "server's message"),
        (b"HTTP/1.1 502 Bad Gateway\r\n", "server's message"),
        (
            b"{\"message\":\"Not Found\",\"documentation_url\":\"x\",\"status\":\"404\"}",
            "server's message",
        ),
        (
            b"<?xml version=\"1.0\"?><Error><Code>NoSuchKey</Code></Error>",
            "server's message",
        ),
        (b"\n<!-- x --><!DOCTYPE html>", "web page"),
        (b"<HTML><body>", "web page"),
        (b"<svg xmlns=\"x\"></svg>", "an XML document"),
        (b"<?xml version=\"1.0\"?><song/>", "an XML document"),
        (b"\"{\\n \\\"Version\\\": 1.0}\"", "encoded twice"),
        (b"[\n {'Version': 1.0", "Python"),
        (b"MThd\0\0\0\x06", "MIDI"),
        (b"RIFF\0\0\0\0WEBP", "WebP"),
        (b"\0\0\0\x20ftypisom", "MP4"),
        (b"BZh91AY&SY", "bzip2"),
        (b"\x28\xb5\x2f\xfd", "zstd"),
    ] {
        let text = String::from_utf8_lossy(bytes);
        let found = Format::of(bytes).unwrap_or_else(|| panic!("{text}"));
        assert!(found.name().contains(name), "{text}: {}", found.name());
        assert!(!found.remedy().is_empty(), "{text}");
        let holds_data = ["bzip2", "zstd"].contains(&name);
        assert_eq!(found.holds_data(), holds_data, "{text}");
        for kind in [
            InputKind::Asset,
            InputKind::Model,
            InputKind::Scene,
            InputKind::Manifest,
        ] {
            assert!(admit(bytes, kind).is_err(), "{kind}: {text}");
        }
    }
    for text in [
        "['a key']\nb = 1\n",
        "\"name\",\"prompt\"\n",
        "\"[x]\",\"{y}\"\n1,2\n",
        "<DATE>\t<TIME>\n1\t2\n",
        "404,1,2\n",
        "500 Hz, 3\n",
        "PAR1,PAR2\n1,2\n",
        "ID3,x\n",
        "BZh,x\n",
        "{\"actions\": [1, 2]}",
        "{\"message\": \"x\"}",
    ] {
        assert_eq!(Format::of(text.as_bytes()), None, "{text}");
    }
}

#[test]
fn nothing_is_no_asset_and_no_effect() {
    for bytes in [&b""[..], b"\n \t", &[0; 512]] {
        for kind in [
            InputKind::Asset,
            InputKind::Hatt,
            InputKind::Model,
            InputKind::Effects,
        ] {
            let problem = admit(bytes, kind).unwrap_err();
            assert!(matches!(problem, InputProblem::Empty), "{kind}: {problem}");
        }
        assert!(admit(bytes, InputKind::Manifest).is_ok());
    }
}

#[test]
fn a_fault_of_json_says_what_other_languages_write() {
    let value = |text: &str| serde_json::from_str::<serde_json::Value>(text);
    for (text, what) in [
        ("{\"a\": NaN}", "NaN at line 1 column 7: JSON has no NaN"),
        ("{\n\"a\": nan,\n\"b\": 1}", "nan at line 2"),
        ("[1, Infinity]", "Infinity at line 1"),
        ("[-Infinity]", "-Infinity at line 1"),
        ("[1, -inf]", "no infinity"),
        ("{\"a\": None}", "None at line 1"),
        ("{\"a\": True, \"b\": 1}", "small letters"),
        ("[undefined]", "small letters"),
        ("{\"a\": 'b'}", "double quotes"),
        ("{\n// a\n\"a\": 1}", "no comments"),
        ("{\"a\": 1 # b\n}", "no comments"),
        ("{\"a\": 1 \"b\": 2}", "expected `,` or `}`"),
        ("{\"a\": yes}", "expected value"),
        ("[1.]", "invalid number"),
        ("{\"ä\": x}", "expected value"),
    ] {
        let fault = json_fault(text, &value(text).unwrap_err());
        assert!(fault.contains(what), "{text}: {fault}");
    }
    let whole =
        "{\"a\": 1.0, \"b\": [2.00,], \"c\": 1.05, \"d\": \"1.0,]\", \"e\": 1.0e3, \"f\": -0.0}";
    let plain =
        "{\"a\": 1  , \"b\": [2    ], \"c\": 1.05, \"d\": \"1.0,]\", \"e\": 1.0e3, \"f\": -0  }";
    assert_eq!(lenient_json(whole), plain);
    assert_eq!(lenient_json("[1., .0]"), "[1., .0]");
}

#[test]
fn text_is_utf_8_with_or_without_a_mark() {
    for (bytes, expected) in [
        (b"a = 1".as_slice(), "a = 1"),
        (b"\xef\xbb\xbfa = 1", "a = 1"),
        (b"", ""),
    ] {
        assert_eq!(text(bytes).unwrap(), expected);
    }
    let problem = text(b"ab\xff").unwrap_err();
    assert_eq!(problem.to_string(), "byte 2 is not UTF-8");
    for wide in [
        b"\xff\xfea\0".as_slice(),
        b"\xfe\xff\0a",
        b"n\0a\0",
        b"\0{\0\"",
    ] {
        assert!(matches!(text(wide), Err(InputProblem::Utf16)), "{wide:?}");
    }
    assert!(text(b"\0\0\0\0").is_ok() && text(b"a\0b").is_ok());
}

#[test]
fn what_is_no_file_is_refused_before_it_is_opened() {
    let folder = tempfile::tempdir().unwrap();
    let problem = |path: &Path| read(path, InputKind::Scene).unwrap_err();
    assert!(matches!(problem(folder.path()), InputProblem::Folder));
    let missing = folder.path().join("missing");
    assert!(matches!(problem(&missing), InputProblem::Unreadable(_)));
}

#[test]
fn a_problem_goes_through_an_io_error_unchanged() {
    let there: std::io::Error = InputProblem::Silent.into();
    assert!(matches!(InputProblem::from(there), InputProblem::Silent));
    let other = std::io::Error::from(std::io::ErrorKind::NotFound);
    assert!(matches!(other.into(), InputProblem::Unreadable(_)));
}

#[cfg(unix)]
mod unix {
    use super::*;
    use std::{
        os::unix::net::UnixListener, path::PathBuf, process::Command, thread, time::Instant,
    };

    fn pipe(folder: &Path) -> PathBuf {
        let path = folder.join("pipe");
        let made = Command::new("mkfifo").arg(&path).status().unwrap();
        assert!(made.success());
        path
    }

    #[test]
    fn devices_sockets_and_circles_of_links_are_refused() {
        let folder = tempfile::tempdir().unwrap();
        let (socket, link) = (folder.path().join("socket"), folder.path().join("link"));
        let _listener = UnixListener::bind(&socket).unwrap();
        for path in [Path::new("/dev/zero"), Path::new("/dev/null"), &socket] {
            let problem = read(path, InputKind::Scene).unwrap_err();
            assert!(matches!(problem, InputProblem::Device), "{problem}");
        }
        std::os::unix::fs::symlink(&link, &link).unwrap();
        let problem = read(&link, InputKind::Scene).unwrap_err();
        assert!(matches!(problem, InputProblem::Unreadable(_)), "{problem}");
    }

    #[test]
    fn a_pipe_is_read_to_its_end() {
        let folder = tempfile::tempdir().unwrap();
        let path = pipe(folder.path());
        let sent: Vec<u8> = (0..300_000_u32).map(|n| n as u8).collect();
        let (writer, bytes) = (path.clone(), sent.clone());
        let write = thread::spawn(move || fs::write(writer, bytes));
        assert_eq!(read(&path, InputKind::Asset).unwrap(), sent);
        write.join().unwrap().unwrap();
    }

    #[test]
    fn a_pipe_without_an_end_stops_at_the_limit() {
        let folder = tempfile::tempdir().unwrap();
        let path = pipe(folder.path());
        let writer = path.clone();
        // Ends when nobody reads any more.
        let write = thread::spawn(move || {
            let mut file = File::options().write(true).open(writer)?;
            std::io::copy(&mut std::io::repeat(b'#'), &mut file)
        });
        let problem = read(&path, InputKind::Scene).unwrap_err();
        assert!(
            matches!(problem, InputProblem::TooLarge { .. }),
            "{problem}"
        );
        assert!(write.join().unwrap().is_err());
    }

    #[test]
    fn a_pipe_that_gives_nothing_is_given_up() {
        let folder = tempfile::tempdir().unwrap();
        let path = pipe(folder.path());
        let from = Instant::now();
        let problem = read(&path, InputKind::Scene).unwrap_err();
        assert!(matches!(problem, InputProblem::Silent), "{problem}");
        assert!(from.elapsed() >= MAX_SILENCE);
        // A writer that opens and waits is given up as well.
        let _writer = File::options().read(true).write(true).open(&path).unwrap();
        let mut opened = open(&path).unwrap();
        let error = opened.read(&mut [0; 16]).unwrap_err();
        assert!(matches!(error.into(), InputProblem::Silent));
    }
}

fn nesting(text: &str) -> Option<(u32, NestingProblem)> {
    check_nesting(text).err().map(|e| (e.line, e.problem))
}

fn attributes(count: usize) -> String {
    (0..count).map(|n| format!(" a{n} = '>'")).collect()
}

#[test]
fn attributes_depth_and_namespaces_of_xml_are_bounded() {
    let at_most = format!("<r>\n<e{}/>\n</r>", attributes(MAX_ATTRIBUTES));
    assert_eq!(nesting(&at_most), None);
    let more = format!("<r>\n<e{}/>\n</r>", attributes(MAX_ATTRIBUTES + 1));
    assert_eq!(nesting(&more), Some((2, NestingProblem::Attributes)));
    let deep = |depth: usize| "<e>".repeat(depth) + &"</e>".repeat(depth);
    assert_eq!(nesting(&deep(MAX_DEPTH)), None);
    assert_eq!(
        nesting(&deep(MAX_DEPTH + 1)),
        Some((1, NestingProblem::Depth))
    );
    let wide = format!("<r>{}</r>", "<e/><e></e>".repeat(10_000));
    assert_eq!(nesting(&wide), None);
    let declared = |count: usize| "<e xmlns:p = 'u'/>\n".repeat(count);
    assert_eq!(nesting(&declared(MAX_NAMESPACES)), None);
    let (line, problem) = nesting(&declared(MAX_NAMESPACES + 1)).unwrap();
    assert_eq!(problem, NestingProblem::Namespaces);
    assert_eq!(line as usize, MAX_NAMESPACES + 1);
}

#[test]
fn what_is_no_element_hides_none() {
    let many = attributes(MAX_ATTRIBUTES + 1);
    for hidden in [
        format!("<!-- <e{many}> --><r/>"),
        format!("<r><![CDATA[<e{many}>]]></r>"),
        format!("<?e {many}?><r/>"),
    ] {
        assert_eq!(nesting(&hidden), None, "{hidden}");
    }
    for shown in [
        format!("<!-- --><e{many}/>"),
        format!("<r><![CDATA[ > ]]><e{many}/></r>"),
        format!("<?xml version='1.0'?><r a='<!--'/><e{many}/>"),
        format!("<r>'</r><e{many}/>"),
        format!("<r>=\"</r><e{many}/>"),
    ] {
        assert!(nesting(&shown).is_some(), "{shown}");
    }
    for cut in ["<", "<e", "<e a='", "<!--", "<![CDATA[", "<?", "<!", "</"] {
        assert_eq!(nesting(cut), None, "{cut}");
    }
}
