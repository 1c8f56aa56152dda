//! Manifest faults are reported by file, line and key, all at once, each once.

use super::*;

/// Claim: a column that is misspelt is one error, whatever the rows, and says what may have been meant;
/// so does the name of a texture that is not there.
#[test]
fn what_is_misspelt_is_reported_once_with_what_may_have_been_meant() {
    let folder = tempfile::tempdir().expect("a folder");
    let folder = folder.path();
    fs::write(
        folder.join("a.csv"),
        "name,prompts\nx,cork\ny,oak\nz,silk\n",
    )
    .expect("a manifest");
    fs::write(
        folder.join("b.jsonl"),
        "{\"name\":\"x\",\"Prompts\":\"cork\"}\n",
    )
    .expect("a manifest");
    fs::write(
        folder.join("c.toml"),
        "[[texture]]\nname = \"cork\"\nprompt = \"cork\"\n[[texture]]\nname = \"half\"\nblend = { a = \"cork\", b = \"crok\" }\n",
    )
    .expect("a manifest");
    for (manifest, words) in [
        (
            "a.csv",
            &["a.csv:2: prompts: no such key", "did you mean \"prompt\"?"][..],
        ),
        (
            "b.jsonl",
            &[
                "b.jsonl:1: Prompts: no such key",
                "did you mean \"prompt\"?",
            ],
        ),
        (
            "c.toml",
            &[
                "no texture \"crok\" in this manifest",
                "did you mean \"cork\"?",
            ],
        ),
    ] {
        let output = asperity(folder, &["build", manifest, "--check"]);
        let error = text(&output.stderr);
        assert_eq!(error.matches("error: ").count(), 1, "{error}");
        assert!(words.iter().all(|words| error.contains(words)), "{error}");
    }
    fs::write(
        folder.join("d.toml"),
        "[[texture]]\nname = \"oak board\"\nprompt = \"oak\"\n",
    )
    .expect("a manifest");
    let built = asperity(folder, &["build", "d.toml", "-o", "d.aspl", "--no-cache"]);
    assert!(built.status.success(), "{}", text(&built.stderr));
    for command in [
        &["extract", "d.aspl", "oak_bord", "-o", "x.asp"][..],
        &["inspect", "d.aspl", "--texture", "Oak Boards"],
        &["rename", "d.aspl", "oakboard", "x", "-o", "x.aspl"],
    ] {
        let output = asperity(folder, command);
        let error = text(&output.stderr);
        assert_eq!(output.status.code(), Some(1), "{command:?}: {error}");
        assert!(error.contains("did you mean \"oak board\"?"), "{error}");
    }
}

#[test]
fn every_fault_of_a_manifest_is_told_at_once_with_file_line_and_key() {
    let inputs = inputs();
    let folder = inputs.path();
    fs::write(
        folder.join("bad.toml"),
        "include = [\"bad.csv\", \"none.toml\", \"bad.toml\"]\n[defaults]\nseeds = 1\n\
         [[texture]]\nname = \"a\\u0007b\"\nprompt = \"x\"\n\
         [[texture]]\nname = \"two\"\nprompt = \"x\"\nasset = \"good.asp\"\n\
         [[texture]]\nname = \"gone\"\nimport = \"gone.xml\"\n\
         [[texture]]\nname = \"same\"\nprompt = \"x\"\nfidelity = 99\n\
         [[texture]]\nname = \"blend\"\nblend = { a = \"p\", t = 2 }\n\
         [[texture]]\nname = \"nothing\"\n\
         [[texture]]\nname = \"kept\"\nasset = \"good.asp\"\nseed = 4\n\
         [[texture]]\nname = \"other\"\nof = \"kept\"\n\
         edit = { prompt = \"nice\", rougher = 3, softer = 1 }\n",
    )
    .expect("a manifest");
    fs::write(
        folder.join("bad.csv"),
        "name,prompt,seed\nx,,1\ny,stone,many\nsame,cork,1\n",
    )
    .expect("a manifest");
    let output = asperity(folder, &["build", "bad.toml", "--check"]);
    let error = text(&output.stderr);
    assert_eq!(output.status.code(), Some(1), "{error}");
    for fault in [
        "bad.toml:1: include: none.toml: cannot read it",
        "bad.toml:1: include: the manifest includes itself: bad.toml → bad.toml",
        "bad.toml:3: defaults.seeds: no such key",
        "bad.toml:5: name: ",
        "bad.toml:10: prompt and asset",
        "bad.toml:13: import: gone.xml: cannot read it",
        "bad.toml:17: fidelity: ",
        "bad.toml:20: blend.b: must be the name of a texture, but is missing",
        "bad.toml:20: blend.t: \"2\" must be a number from 0 to 1",
        "bad.toml:21: no source",
        "bad.toml:26: seed: cannot be combined with asset",
        "bad.toml:30: edit.prompt: \"nice\" names neither a quality to change",
        "bad.toml:30: edit.rougher: cannot be combined with edit.prompt",
        "bad.toml:30: edit.softer: no such key",
        "bad.csv:2: no source",
        "bad.csv:3: seed: \"many\"",
        // Its namesake has another fault.
        "bad.csv:4: name: \"same\" is also",
    ] {
        assert!(error.contains(fault), "{fault:?} not in {error}");
    }
    assert!(!error.contains('\u{7}'));
    assert_eq!(error.matches("error: ").count(), 17, "{error}");
    // Faults that show only in all of it together.
    fs::write(
        folder.join("bad.toml"),
        "[[texture]]\nname = \"a\"\nblend = { a = \"b\", b = \"cork\" }\n\
         [[texture]]\nname = \"b\"\nblend = { a = \"a\", b = \"cork\" }\n\
         [[texture]]\nname = \"cork\"\nprompt = \"cork\"\n",
    )
    .expect("a manifest");
    refused(
        folder,
        &["build", "bad.toml", "--check"],
        &["bad.toml:1", "depends on itself", "\"a\" → \"b\""],
    );
    fs::write(
        folder.join("bad.toml"),
        "[[texture]]\nname = \"a\"\nprompt = \"x\"\n[[texture]]\nname = \"a\"\nprompt = \"y\"\n\
         [[texture]]\nname = \"b\"\nblend = { a = \"a\", b = \"c\" }\n",
    )
    .expect("a manifest");
    let named = [
        "bad.toml:4: name: \"a\" is also",
        "bad.toml:1",
        "bad.toml:9: blend.b: no texture \"c\"",
    ];
    refused(folder, &["build", "bad.toml", "-o", "out.aspl"], &named);
}
