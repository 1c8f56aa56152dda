//! Lists of textures as people and spreadsheets write them: what is read is all of it, and what
//! would lose a row, a cell or a key is refused at its line.

mod lists;

use asperity::{
    library::{Lock, Manifest, manifest::Origin},
    scene::Description,
    sources::Registry,
};
use asperity_io::{diagnostic::Fault, diagnostic::report, input::Reach};
use asperity_tests::draw::Draw;
use lists::{csv, json_lines, toml};
use std::{collections::BTreeMap, fmt::Write as _, fs, path::Path};

const LISTS: usize = 150;

fn told(errors: &[Fault]) -> String {
    errors.iter().map(|error| report(error) + "\n").collect()
}

/// Names and prompts of a manifest.
fn prompts(manifest: &Manifest) -> BTreeMap<String, String> {
    let entries = manifest.entries.iter();
    entries
        .map(|entry| match &entry.origin {
            Origin::Source { source, .. } => {
                let prompt = source.prompt().expect("a prompt");
                (entry.name.clone(), prompt.to_owned())
            }
            other => panic!("{other:?}"),
        })
        .collect()
}

/// A list gives all of its textures, or an error with its file and line; never some of them.
#[test]
fn no_row_of_a_list_is_lost_without_a_word() {
    let folder = tempfile::tempdir().expect("a folder");
    let mut damaged = BTreeMap::new();
    for seed in 0..LISTS {
        let mut draw = Draw::new(seed as u64);
        let list = match draw.below(5) {
            0 => json_lines(&mut draw),
            1 => toml(&mut draw),
            _ => csv(&mut draw),
        };
        let file = folder.path().join(list.file);
        fs::write(&file, &list.text).expect("a list");
        let shown = format!("list {seed}, {}: {:?}", list.file, list.text);
        match (Manifest::read(&file), list.damage) {
            (Ok(manifest), None) => assert_eq!(prompts(&manifest), list.wanted, "{shown}"),
            (Err(errors), None) => panic!("{shown}: {}", told(&errors)),
            (Ok(_), Some(damage)) => panic!("{damage} is taken: {shown}"),
            (Err(errors), Some(damage)) => {
                *damaged.entry(damage).or_insert(0) += 1;
                assert!(errors.iter().all(|error| error.line.is_some()), "{shown}");
            }
        }
    }
    let mut counts = String::new();
    for (damage, count) in &damaged {
        let _ = write!(counts, "{damage} {count}, ");
    }
    println!("{LISTS} lists, damaged: {counts}");
    assert!(damaged.len() >= 12, "{counts}");
}

/// Whoever includes a file reads nothing of it in the error, be it a list or not.
#[test]
fn an_include_that_is_no_manifest_is_not_repeated() {
    let folder = tempfile::tempdir().expect("a folder");
    let lines = [
        "root:x:0:0:root,secret:/root:/bin/bash\n",
        "password = secret\n",
        "[secret\n",
        "{\"secret\n",
        "user,secret\n",
        "secret\n",
    ];
    for (extension, line) in [".toml", ".csv", ".jsonl", ".conf", ""]
        .into_iter()
        .flat_map(|extension| lines.map(|line| (extension, line)))
    {
        let name = format!("other{extension}");
        fs::write(folder.path().join(&name), line).expect("a file");
        let manifest = folder.path().join("list.toml");
        fs::write(&manifest, format!("include = [{name:?}]\n")).expect("a manifest");
        let errors = Manifest::read(&manifest).expect_err("no manifest");
        let told = told(&errors);
        assert!(told.contains(&name), "{told}");
        assert!(!told.contains("secret"), "{name}, {line:?}: {told}");
    }
}

#[test]
fn a_scene_in_single_brackets_says_which() {
    for key in ["texture", "surface"] {
        let text = format!("servo_rate_hz = 1000\n[{key}]\ntexture = \"oak\"\n");
        let told = scene(Path::new("desk.toml"), &text, Reach::Anywhere).expect_err("one table");
        assert!(told.contains("one table in single brackets"), "{told}");
        assert!(told.contains(&format!("write [[{key}]]")), "{told}");
    }
}

/// A scene, or all its faults.
fn scene(file: &Path, text: &str, reach: Reach) -> Result<Description, String> {
    Description::within(file, text, reach, &Registry::default()).map_err(|failures| {
        let told = failures.iter().map(|failure| report(&**failure));
        told.collect::<Vec<_>>().join("\n")
    })
}

/// Every kind of path that a list or a scene may state, out of its folder and within it.
#[cfg(unix)]
#[test]
fn a_confined_list_names_only_files_in_its_own_folder() {
    let outer = tempfile::tempdir().expect("a folder");
    let folder = outer.path().join("lists");
    fs::create_dir_all(folder.join("own/model")).expect("folders");
    fs::create_dir(outer.path().join("model")).expect("a folder");
    for place in ["", "lists/own/"] {
        for file in ["a.xml", "a.json", "a.asp", "model/model.json"] {
            fs::write(outer.path().join(format!("{place}{file}")), "{}").expect("a file");
        }
        let more = outer.path().join(format!("{place}more.jsonl"));
        fs::write(more, "{\"prompt\": \"cork\"}\n").expect("a manifest");
    }
    std::os::unix::fs::symlink(outer.path(), folder.join("link")).expect("a link");
    let list = folder.join("list.toml");
    let kinds = |path: &str| {
        [
            ("include", format!("include = [\"{path}/more.jsonl\"]\n")),
            (
                "defaults.model",
                format!("[defaults]\nmodel = \"{path}/model\"\n"),
            ),
            (
                "defaults.text_encoder",
                format!("[defaults]\ntext_encoder = \"clip:{path}/model\"\n"),
            ),
            (
                "import",
                format!("[[texture]]\nname = \"a\"\nimport = \"{path}/a.xml\"\n"),
            ),
            (
                "import",
                format!("[[texture]]\nname = \"a\"\nimport = \"{path}/a.json\"\n"),
            ),
            (
                "asset",
                format!("[[texture]]\nname = \"a\"\nasset = \"{path}/a.asp\"\n"),
            ),
        ]
    };
    let some = "[[texture]]\nname = \"ice\"\nprompt = \"wet ice\"\n";
    let reach = Reach::beside(&list).expect("the folder is there");
    let absolute = outer.path().to_str().expect("a path in UTF-8").to_owned();
    for (path, how) in [
        ("..", Some("a path with `..`")),
        ("link", Some("a link that leaves the folder")),
        (&absolute, Some("an absolute path")),
        ("own", None),
    ] {
        for (key, text) in kinds(path) {
            let text = format!("{text}{some}");
            let read = Manifest::within(&list, &text, reach.clone(), &Registry::default());
            let free = Manifest::of_text(&list, &text);
            assert!(free.is_ok(), "{text}: {}", told(&free.unwrap_err()));
            match (read, how) {
                (Ok(_), None) => {}
                (Err(errors), Some(how)) => {
                    let told = told(&errors);
                    assert!(told.contains(&format!("{key}: ")), "{text}: {told}");
                    assert!(told.contains(how) && told.contains("--confined"), "{told}");
                }
                (Ok(_), Some(_)) => panic!("{text} is within reach"),
                (Err(errors), None) => panic!("{text}: {}", told(&errors)),
            }
        }
        for (key, file) in [("import", "a.xml"), ("asset", "a.asp")] {
            let text = format!(
                "[[texture]]\nname = \"a\"\n{key} = \"{path}/{file}\"\n\
                 [[surface]]\ntexture = \"a\"\nsphere = {{ center_m = [0, 0, 0], radius_m = 1 }}\n"
            );
            assert!(scene(&list, &text, Reach::Anywhere).is_ok(), "{text}");
            match (scene(&list, &text, reach.clone()), how) {
                (Ok(_), None) => {}
                (Err(told), Some(how)) => {
                    assert!(told.contains(&format!("{key}: ")), "{told}");
                    assert!(told.contains(how) && told.contains("--confined"), "{told}");
                }
                (read, _) => panic!("{text}: {read:?}"),
            }
        }
    }
    // Its lock is written, so a link in its place is none of its own.
    let lock = folder.join("list.toml.lock");
    assert!(Lock::within(&list, &reach).is_ok());
    std::os::unix::fs::symlink(outer.path().join("other"), lock).expect("a link");
    let error = Lock::within(&list, &reach).expect_err("a link");
    assert!(report(&error).contains("list.toml.lock: a link that leaves the folder"));
}

/// Whatever wrote a list: a whole number is one, a cell without a value is none, and a head has any case.
#[test]
fn values_are_read_as_other_writers_write_them() {
    let seed = |file: &str, text: &str| -> Result<u64, String> {
        let manifest = Manifest::of_text(Path::new(file), text).map_err(|errors| told(&errors))?;
        let Origin::Source { source, .. } = &manifest.entries[0].origin else {
            panic!("a source")
        };
        let shown = format!("{source:?}");
        let seed = shown.split_once("seed: ").expect("a seed").1;
        let digits = seed.split(|c: char| !c.is_ascii_digit()).next();
        Ok(digits.expect("digits").parse().expect("a seed"))
    };
    let written = |value: &str| {
        [
            seed(
                "a.toml",
                &format!("[[texture]]\nprompt = 'oak'\nseed = {value}\n"),
            ),
            seed("a.csv", &format!("Prompt;Seed\noak;{value}\n")),
            seed(
                "a.jsonl",
                &format!("{{\"prompt\": \"oak\", \"seed\": {value}}}\n"),
            ),
        ]
    };
    for (value, whole) in [
        ("3", 3),
        ("3.0", 3),
        ("12.00", 12),
        ("1.000", 1),
        ("1E+05", 100_000),
        ("1.5e1", 15),
        ("-0", 0),
        ("-0.0", 0),
        ("9007199254740993", 9_007_199_254_740_993),
    ] {
        for (n, found) in written(value).into_iter().enumerate() {
            match found {
                Ok(found) => assert_eq!(found, whole, "{value}: {n}"),
                // In a table it may be a thousand.
                Err(error) => assert!(
                    value == "1.000" && n == 1 && error.contains(value),
                    "{error}"
                ),
            }
        }
    }
    for (value, shown) in [
        ("3.5", "3.5"),
        ("-2", "-2"),
        ("1e300", "1"),
        ("-1E+05", "-100000"),
    ] {
        for (n, found) in written(value).into_iter().enumerate() {
            let error = found.unwrap_err();
            let shown = if n == 1 { value } else { shown };
            assert!(error.contains(&format!("\"{shown}")), "{value}: {error}");
            assert!(
                error.contains("a whole number, 0 or more"),
                "{value}: {error}"
            );
        }
    }
    for value in [
        "1,000",
        "1 000",
        "1'000",
        "12.500.000",
        "1.000",
        "three",
        "1.23457E+11",
        "0x10",
        "NaN",
    ] {
        let error = seed("a.csv", &format!("prompt;seed\noak;{value}\n")).unwrap_err();
        assert!(
            error.contains(value) && error.contains("such as 1000"),
            "{error}"
        );
    }
    let none = [
        "NA",
        "N/A",
        "nan",
        "#N/A",
        "#REF!",
        "#BEZUG!",
        "#DIV/0!",
        "#¿NOMBRE?",
        "#NULL!",
        "Err:502",
        "<NA>",
        "None",
        "NULL",
        "—",
        "--",
        "?",
        "…",
        "###",
        "-NaN",
        "1.#QNAN",
        "#N/A N/A",
        "(none)",
        "[null]",
        "(blank)",
        "n.a.",
        "N/D",
        "#N/D",
        "#Н/Д",
        "#YOK",
        "#HIÁNYZIK",
        "#GETTING_DATA",
        "#NOM ?",
        "Fehler:502",
        "•",
        "ー",
        "＃N/A",
    ];
    for word in none {
        let json = format!("{{\"name\": \"a\", \"prompt\": \"{word}\"}}");
        for (file, text) in [
            ("a.csv", format!("name,prompt\na,oak\nb, {word} \n")),
            ("a.jsonl", format!("\n{json}\n")),
            ("a.toml", format!("[[texture]]\nprompt = \"{word}\"\n")),
        ] {
            let errors = Manifest::of_text(Path::new(file), &text).unwrap_err();
            let told = told(&errors);
            assert_eq!(errors.len(), 1, "{told}");
            assert!(
                told.contains("is no prompt") && told.contains(word),
                "{told}"
            );
            assert_eq!(
                errors[0].line,
                Some(if file == "a.csv" { 3 } else { 2 }),
                "{told}"
            );
        }
    }
    for prompt in [
        "nan bread",
        "none too rough",
        "#1 sandpaper!",
        "木",
        "🔥",
        "n/a finish",
        "blank",
        "#wood",
        "err: 5 oak",
        "3",
    ] {
        let text = format!("name,prompt\nNA,{prompt}\n");
        assert!(
            Manifest::of_text(Path::new("a.csv"), &text).is_ok(),
            "{prompt}"
        );
    }
    for (name, file) in [("#REF!", "a.csv"), ("#N/A", "a.csv"), ("NaN", "a.csv")] {
        let errors =
            Manifest::of_text(Path::new(file), &format!("name,prompt\n{name},oak\n")).unwrap_err();
        assert!(told(&errors).contains("is no name"), "{}", told(&errors));
    }
    // A null is a key that is not there.
    let text = "{\"name\": null, \"prompt\": \"oak\", \"seed\": null, \"edit\": {\"rougher\": 1, \"harder\": null}}";
    assert_eq!(seed("a.jsonl", text), Ok(0));
    let error = seed("a.jsonl", "{\"prompt\": null}").unwrap_err();
    assert!(error.contains("no source"), "{error}");
}
