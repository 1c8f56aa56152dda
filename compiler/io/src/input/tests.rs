//! What is read, what is refused, and how long a refusal may take.

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
    for kind in Kind::ALL {
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
        .set_len(Kind::Scene.max_bytes())
        .unwrap();
    let bytes = read(&path, Kind::Scene).unwrap();
    assert_eq!(bytes.len() as u64, Kind::Scene.max_bytes());
    let endless = to_end(std::io::repeat(b'#'), Kind::Scene).unwrap_err();
    assert!(
        matches!(endless, InputProblem::TooLarge { .. }),
        "{endless}"
    );
}

#[test]
fn a_pointer_is_refused_for_every_kind_and_words_are_no_format() {
    let pointer = b"version https://git-lfs.github.com/spec/v1\noid sha256:0\nsize 1\n";
    let words = br#"{"Pattern": 1, "perceptions": 2, "signals": 3}"#;
    for kind in Kind::ALL {
        let problem = to_end(&pointer[..], kind).unwrap_err();
        assert!(
            matches!(problem, InputProblem::LfsPointer),
            "{kind}: {problem}"
        );
        assert!(problem.remedy().contains("git lfs pull"), "{kind}");
    }
    for kind in [Kind::Vocabulary, Kind::DiffusionConfig, Kind::Description] {
        assert!(to_end(&words[..], kind).is_ok(), "{kind}");
    }
    let scene = to_end(&words[..], Kind::Scene).unwrap_err();
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
        (b"{\"version\": 0, \"tracks\": []}", Some(Format::Vij)),
        (b"{\"format\": \"asperity-model\"}", Some(Format::Model)),
        (b"{\"project\": \"signals\"}", None),
        (b"{\"asset\": {\"version\": \"2.0\",},}", Some(Format::Gltf)),
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
}

#[test]
fn what_is_no_file_is_refused_before_it_is_opened() {
    let folder = tempfile::tempdir().unwrap();
    let problem = |path: &Path| read(path, Kind::Scene).unwrap_err();
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
            let problem = read(path, Kind::Scene).unwrap_err();
            assert!(matches!(problem, InputProblem::Device), "{problem}");
        }
        std::os::unix::fs::symlink(&link, &link).unwrap();
        let problem = read(&link, Kind::Scene).unwrap_err();
        assert!(matches!(problem, InputProblem::Unreadable(_)), "{problem}");
    }

    #[test]
    fn a_pipe_is_read_to_its_end() {
        let folder = tempfile::tempdir().unwrap();
        let path = pipe(folder.path());
        let sent: Vec<u8> = (0..300_000_u32).map(|n| n as u8).collect();
        let (writer, bytes) = (path.clone(), sent.clone());
        let write = thread::spawn(move || fs::write(writer, bytes));
        assert_eq!(read(&path, Kind::Asset).unwrap(), sent);
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
        let problem = read(&path, Kind::Scene).unwrap_err();
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
        let problem = read(&path, Kind::Scene).unwrap_err();
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
