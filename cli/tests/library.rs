//! Libraries as a user builds them: the same bytes whatever the way, work that is not lost.

use super::*;
use asperity_formats::Asset;
use serde_json::Value;

const MANIFEST: &str = "include = [\"more.csv\", \"lines.jsonl\"]\n\
    [defaults]\npreview = false\n\
    [[texture]]\nname = \"sheet\"\nprompt = \"rough abrasive sheet\"\n\
    [[texture]]\nname = \"cork\"\nprompt = \"cork\"\nseed = 3\nfidelity = 8\n\
    [[texture]]\nname = \"wood\"\nimport = \"wood.xml\"\nfidelity = \"auto\"\n\
    [[texture]]\nname = \"grit\"\nasset = \"good.asp\"\n\
    [[texture]]\nname = \"between\"\nblend = { a = \"sheet\", b = \"cork\", t = 0.25 }\n\
    [[texture]]\nname = \"of wood\"\nblend = { a = \"wood\", b = \"grit\" }\n\
    [[texture]]\nname = \"mixed\"\ncompose = { tap = \"cork\", slide = \"between\" }\n\
    edit = { rougher = 10 }\n\
    [[texture]]\nname = \"softer\"\nof = \"mixed\"\n\
    edit = { prompt = \"a bit softer, more like leather\" }\n";

/// A manifest of every kind of entry, with all that it names.
pub(crate) fn manifest() -> TempDir {
    let inputs = inputs();
    let write = |name: &str, content: &str| {
        fs::write(inputs.path().join(name), content).expect("an input");
    };
    write("library.toml", MANIFEST);
    write(
        "more.csv",
        "name,prompt,seed\nice,wet ice,\nfelt,soft felt,2\n",
    );
    write(
        "lines.jsonl",
        "{\"prompt\": \"brushed steel\", \"loudness\": -30}\n",
    );
    inputs
}

#[test]
fn order_threads_cache_and_parts_do_not_change_a_byte() {
    let inputs = manifest();
    let folder = inputs.path();
    let build = ["build", "library.toml", "--cache", "cache", "-o"];
    let said = good(folder, &[&build[..], &["one.aspl"]].concat());
    assert!(
        said.contains("11 textures, 11 compiled, 0 from the cache"),
        "{said}"
    );
    let one = bytes(folder, "one.aspl");
    // Again: all of it from the cache.
    let said = good(folder, &[&build[..], &["again.aspl"]].concat());
    assert!(said.contains("0 compiled, 11 from the cache"), "{said}");
    assert!(bytes(folder, "again.aspl") == one);
    // Another order of the same textures, on one thread, without a cache.
    let (head, tail) = MANIFEST.split_at(MANIFEST.find("[[texture]]").expect("textures"));
    let mut textures: Vec<&str> = tail.split("[[texture]]\n").skip(1).collect();
    textures.reverse();
    let other = format!("{head}[[texture]]\n{}", textures.join("[[texture]]\n"));
    fs::write(folder.join("other.toml"), other).expect("a manifest");
    let output = Command::new(env!("CARGO_BIN_EXE_asperity"))
        .args(["build", "other.toml", "--no-cache", "-o", "other.aspl"])
        .env("RAYON_NUM_THREADS", "1")
        .current_dir(folder)
        .output()
        .expect("it runs");
    assert!(output.status.success(), "{}", text(&output.stderr));
    assert!(bytes(folder, "other.aspl") == one);
    // Parts, each with a cache of its own, joined in another order.
    for part in ["1/3", "2/3", "3/3"] {
        let (cache, file) = (format!("c{}", &part[..1]), format!("p{}.aspl", &part[..1]));
        let shard = ["build", "library.toml", "--shard", part];
        good(
            folder,
            &[&shard[..], &["--cache", &cache, "-o", &file]].concat(),
        );
    }
    good(
        folder,
        &[
            "merge",
            "p3.aspl",
            "p1.aspl",
            "p2.aspl",
            "-o",
            "merged.aspl",
        ],
    );
    assert!(bytes(folder, "merged.aspl") == one);
    // Split and merged.
    good(folder, &["split", "one.aspl", "-o", "assets"]);
    assert!(entries(&folder.join("assets")).contains(&"of wood.asp".to_owned()));
    good(folder, &["split", "one.aspl", "-o", "parts", "--into", "4"]);
    let parts: Vec<String> = (1..=4).map(|n| format!("parts/part-{n}.aspl")).collect();
    let parts: Vec<&str> = parts.iter().map(String::as_str).collect();
    good(
        folder,
        &[&["merge"], &parts[..], &["-o", "whole.aspl"]].concat(),
    );
    assert!(bytes(folder, "whole.aspl") == one);
}

#[test]
fn a_prompt_of_a_library_is_the_texture_that_compile_makes() {
    let folder = tempfile::tempdir().expect("a folder");
    let folder = folder.path();
    fs::write(folder.join("p.csv"), "prompt,preview\ncork,false\n").expect("a manifest");
    good(folder, &["build", "p.csv", "--no-cache", "-o", "p.aspl"]);
    good(folder, &["extract", "p.aspl", "cork", "-o", "cork.asp"]);
    good(
        folder,
        &["compile", "cork", "--no-preview", "-o", "own.asp"],
    );
    assert!(bytes(folder, "cork.asp") == bytes(folder, "own.asp"));
    let listed = good(folder, &["list", "p.aspl", "--json"]);
    let listed: serde_json::Value = serde_json::from_str(&listed).expect("JSON");
    assert_eq!(listed["textures"][0]["prompt"], "cork");
    assert_eq!(listed["textures"][0]["has_latent"], true);
}

#[test]
fn an_edit_of_a_library_is_that_of_the_command() {
    let folder = tempfile::tempdir().expect("a folder");
    let folder = folder.path();
    fs::write(
        folder.join("e.csv"),
        "name,prompt,of,edit.prompt,edit.rougher,preview\n\
         towel,terry towel,,,,false\n\
         rough,,towel,,10,false\n\
         edited,,rough,\"less gritty, more like silk\",,false\n",
    )
    .expect("a manifest");
    good(folder, &["build", "e.csv", "--no-cache", "-o", "e.aspl"]);
    let edit = |from: &str, how: &[&str], to: &str, name: &str| {
        let to = ["--no-preview", "--name", name, "-o", to];
        good(folder, &[&["edit", from], how, &to[..]].concat());
    };
    edit("e.aspl#towel", &["--rougher", "10"], "rough.asp", "rough");
    let words = ["--prompt", "less gritty, more like silk"];
    edit("rough.asp", &words, "edited.asp", "edited");
    for name in ["rough", "edited"] {
        let (built, own) = (format!("{name}-built.asp"), format!("{name}.asp"));
        good(folder, &["extract", "e.aspl", name, "-o", &built]);
        assert!(bytes(folder, &built) == bytes(folder, &own), "{name}");
    }
    good(
        folder,
        &[
            "edit",
            "edited-built.asp",
            "--undo",
            "-o",
            "back.asp",
            "--name",
            "rough",
        ],
    );
    assert!(bytes(folder, "back.asp") == bytes(folder, "rough.asp"));
}

#[test]
fn one_bad_entry_fails_with_its_line_and_the_others_are_kept() {
    let inputs = inputs();
    let folder = inputs.path();
    fs::write(
        folder.join("mixed.toml"),
        "[[texture]]\nname = \"good\"\nimport = \"mixed/a.xml\"\n\
         [[texture]]\nname = \"bad\"\nimport = \"mixed/b.xml\"\n",
    )
    .expect("a manifest");
    let build = ["build", "mixed.toml", "--cache", "cache", "-o", "out.aspl"];
    let output = asperity(folder, &build);
    let error = text(&output.stderr);
    assert_eq!(output.status.code(), Some(1), "{error}");
    assert!(error.contains("mixed.toml:4: \"bad\": import: "), "{error}");
    assert!(
        error.contains("1 of 2 textures failed, the others are in the cache"),
        "{error}"
    );
    assert!(!folder.join("out.aspl").exists());
    fs::write(folder.join("mixed/b.xml"), material("B")).expect("a material");
    let said = good(folder, &build);
    assert!(said.contains("1 compiled, 1 from the cache"), "{said}");
}

#[test]
fn a_tampered_entry_is_made_again() {
    let inputs = inputs();
    let folder = inputs.path();
    fs::write(
        folder.join("one.toml"),
        "[[texture]]\nname = \"w\"\nimport = \"wood.xml\"\n",
    )
    .expect("a manifest");
    let build = ["build", "one.toml", "--cache", "cache", "-o", "out.aspl"];
    good(folder, &build);
    let first = bytes(folder, "out.aspl");
    let shelf = fs::read_dir(folder.join("cache")).expect("a cache").next();
    let shelf = shelf.expect("a shelf").expect("it").path();
    let entry = fs::read_dir(shelf).expect("a shelf").next();
    let entry = entry.expect("an entry").expect("it").path();
    let mut content = fs::read(&entry).expect("it");
    let last = content.len() - 100;
    content[last] ^= 1;
    fs::write(&entry, content).expect("it");
    let said = good(folder, &build);
    assert!(said.contains("1 compiled, 0 from the cache"), "{said}");
    assert!(bytes(folder, "out.aspl") == first);
    // What decides the bytes decides the key.
    let other = material("Wood").replace("<mu>0.4</mu>", "<mu>0.5</mu>");
    fs::write(folder.join("wood.xml"), other).expect("a material");
    let said = good(folder, &build);
    assert!(said.contains("1 compiled"), "{said}");
    assert!(bytes(folder, "out.aspl") != first);
}

#[test]
fn a_lock_pins_the_model_and_refuses_another() {
    let inputs = inputs();
    let folder = inputs.path();
    fs::write(
        folder.join("l.toml"),
        "[[texture]]\nname = \"w\"\nimport = \"wood.xml\"\n",
    )
    .expect("a manifest");
    let build = ["build", "l.toml", "--no-cache", "-o", "out.aspl"];
    let locked = [&build[..], &["--locked"]].concat();
    refused(folder, &locked, &["l.toml.lock", "no lock file"]);
    good(folder, &build);
    good(folder, &locked);
    let lock = fs::read_to_string(folder.join("l.toml.lock")).expect("a lock");
    let at = lock.find("model_crc32 = \"").expect("a CRC") + 15;
    let other = format!("{}00000000{}", &lock[..at], &lock[at + 8..]);
    fs::write(folder.join("l.toml.lock"), other).expect("a lock");
    refused(
        folder,
        &locked,
        &["l.toml.lock", "model_crc32 was 00000000"],
    );
    let output = asperity(folder, &build);
    assert!(text(&output.stderr).contains("pins that now"));
    assert_eq!(
        fs::read_to_string(folder.join("l.toml.lock")).expect("a lock"),
        lock
    );
}

/// A cache that others can write to is neither read nor written, and the build says so.
#[cfg(unix)]
#[test]
fn a_cache_that_is_open_to_all_is_not_used() {
    use std::os::unix::fs::PermissionsExt as _;
    let folder = inputs();
    let folder = folder.path();
    fs::write(folder.join("l.csv"), "name,asset\ngrit,good.asp\n").expect("a manifest");
    let build = ["build", "l.csv", "--cache", "cache", "-o", "l.aspl"];
    good(folder, &build);
    let said = good(folder, &build);
    assert!(said.contains("1 from the cache"), "{said}");
    let open = fs::Permissions::from_mode(0o777);
    fs::set_permissions(folder.join("cache"), open).expect("permissions");
    let output = asperity(folder, &build);
    let (said, told) = (text(&output.stdout), text(&output.stderr));
    assert!(
        output.status.success() && said.contains("0 from the cache"),
        "{said}{told}"
    );
    assert!(
        told.contains("every user may write to the folder"),
        "{told}"
    );
}

/// `import` tells the kind of a file, a recording is a folder, and `#` names a texture of a library.
#[test]
fn a_manifest_takes_every_kind_of_source() {
    let folder = tempfile::tempdir().unwrap();
    let folder = folder.path();
    good(
        folder,
        &["builtin", "-o", "grit.asp", "--emit-model", "grit.json"],
    );
    good(
        folder,
        &["export", "grit.asp", "--to", "ahap", "-o", "grit.ahap"],
    );
    good(
        folder,
        &["export", "grit.asp", "--to", "hjif", "-o", "grit.hjif"],
    );
    fs::copy(
        folder.join("grit.ahap"),
        folder.join("named-otherwise.json"),
    )
    .unwrap();
    let sources = [
        ("model", "import = \"grit.json\""),
        ("ahap", "import = \"grit.ahap\""),
        ("hjif", "import = \"grit.hjif\""),
        ("told", "import = \"named-otherwise.json\""),
        ("asset", "asset = \"grit.asp\""),
    ];
    let list: String = sources
        .iter()
        .map(|(name, source)| format!("[[texture]]\nname = \"{name}\"\n{source}\n"))
        .collect();
    fs::write(folder.join("list.toml"), list).unwrap();
    good(
        folder,
        &["build", "list.toml", "-o", "all.aspl", "--no-cache"],
    );
    fs::write(
        folder.join("one.toml"),
        "[[texture]]\nname = \"one\"\nasset = \"all.aspl#told\"\n",
    )
    .unwrap();
    good(
        folder,
        &["build", "one.toml", "-o", "one.aspl", "--no-cache"],
    );
    // As the command imports it, under another name and without a preview.
    let as_command = [
        "import",
        "ahap",
        "grit.ahap",
        "-o",
        "ahap.asp",
        "--fidelity",
        "full",
        "--no-preview",
    ];
    good(folder, &as_command);
    good(folder, &["extract", "all.aspl", "ahap", "-o", "built.asp"]);
    let haptic = |file: &str| {
        let bytes = fs::read(folder.join(file)).unwrap();
        let asset = Asset::parse(&bytes).unwrap();
        let haptic = asset
            .sections()
            .filter(|s| s.is_haptic() && s.tag != *b"NAME");
        haptic
            .map(|s| asset.section(&s).unwrap().to_vec())
            .collect::<Vec<_>>()
    };
    assert_eq!(haptic("ahap.asp"), haptic("built.asp"));
    // What is no folder is no recording, and a folder is no import.
    for (entry, told) in [
        ("recording = \"grit.asp\"", "a folder"),
        ("recording = \"nowhere\"", "nowhere"),
        ("import = \"grit.asp\"", "an asset"),
        ("asset = \"all.aspl#nothing\"", "nothing"),
    ] {
        fs::write(
            folder.join("bad.toml"),
            format!("[[texture]]\nname = \"x\"\n{entry}\n"),
        )
        .unwrap();
        refused(folder, &["build", "bad.toml", "-o", "bad.aspl"], &[told]);
    }
}

#[test]
fn certainty_is_told_and_can_be_asked_for() {
    let inputs = inputs();
    let folder = inputs.path();
    let list = "name,prompt\na,oak\nb,yellow\nc,bamboo mat\nd,xyzzy plugh\n";
    fs::write(folder.join("list.csv"), list).expect("a manifest");
    let build = [
        "build",
        "list.csv",
        "--no-preview",
        "--cache",
        "cache",
        "-o",
    ];
    let said = good(folder, &[&build[..], &["all.aspl"]].concat());
    assert!(said.contains("2 are guesses"), "{said}");
    let listed: Value =
        serde_json::from_str(&good(folder, &["list", "all.aspl", "--json"])).expect("JSON");
    let levels = listed["textures"].as_array().expect("textures").iter();
    let levels: Vec<&Value> = levels.map(|texture| &texture["certainty_level"]).collect();
    assert_eq!(levels, ["known", "guess", "close", "guess"]);
    // All are in the cache by now, which keeps what it knows of them.
    let least = |level| [&build[..], &["some.aspl", "--min-certainty", level]].concat();
    let refused = asperity(folder, &least("close"));
    let said = text(&refused.stderr);
    assert_eq!(refused.status.code(), Some(1), "{said}");
    assert!(
        said.contains("list.csv:3: \"b\"") && said.contains("list.csv:5: \"d\""),
        "{said}"
    );
    assert!(
        !said.contains("list.csv:2") && !said.contains("list.csv:4"),
        "{said}"
    );
    assert!(!folder.join("some.aspl").exists());
    assert_eq!(asperity(folder, &least("sure")).status.code(), Some(2));
    // "yellow" names nothing that is touched.
    let refused = asperity(folder, &least("guess"));
    let said = text(&refused.stderr);
    assert!(
        said.contains("no_contact") && said.contains("list.csv:3") && !said.contains("list.csv:5"),
        "{said}"
    );
    good(folder, &least("no_contact"));
    assert_eq!(bytes(folder, "some.aspl"), bytes(folder, "all.aspl"));
}
