//! Recipes and their commands.

use super::{MOST, Opened, Operation, Recipe};
use asperity::sources::latents::{Edit, Sliders};

fn compiled(id: &str, prompt: &str, seed: u64) -> Recipe {
    let prompt = prompt.to_owned();
    Recipe::new([], id, &prompt.clone(), Operation::Compile { prompt, seed }).unwrap()
}

fn edited(of: &Recipe, from: &str, id: &str, name: &str, edit: Edit) -> Option<Recipe> {
    let texture = from.to_owned();
    Recipe::new(
        [Some(of)],
        id,
        name,
        Operation::Edit {
            texture,
            edit,
            draft: false,
        },
    )
}

fn file(id: &str, path: &str) -> Recipe {
    let (path, id) = (path.to_owned(), id.to_owned());
    let opened = Opened { path, id };
    Recipe::new([], &opened.id.clone(), "any", Operation::File(opened)).unwrap()
}

fn softer(steps: f64) -> Edit {
    Edit::Steps(Sliders {
        harder: -steps,
        slipperier: 2.5,
        ..Sliders::default()
    })
}

#[test]
fn a_prompt_is_one_word_of_a_shell() {
    let cases = [
        ("cork", 0, "asperity compile 'cork' -o cork.asp"),
        (
            "wet ice",
            7,
            "asperity compile 'wet ice' -o 'wet ice.asp' --seed 7",
        ),
        ("-x", 1, "asperity compile -o _-x.asp --seed 1 -- '-x'"),
        ("a'b", 0, r"asperity compile 'a'\''b' -o 'a'\''b.asp'"),
        ("$(id)", 0, "asperity compile '$(id)' -o '$(id).asp'"),
    ];
    for (prompt, seed, command) in cases {
        let recipe = compiled("1", prompt, seed);
        assert_eq!(recipe.command().as_deref(), Some(command));
    }
    let operation = Operation::Compile {
        prompt: "a\0b".into(),
        seed: 0,
    };
    assert!(Recipe::new([], "1", "a b", operation).is_none());
}

#[test]
fn each_line_writes_a_file_of_its_own_and_reads_those_before() {
    let cork = compiled("c", "cork", 0);
    let edited = edited(&cork, "c", "e", "cork", softer(20.0)).unwrap();
    let dropped = file("f", "-cork (2).asp");
    let operation = Operation::Blend {
        a: "e".into(),
        b: "f".into(),
        t: 0.25,
        draft: false,
    };
    let blend = Recipe::new(
        [Some(&edited), Some(&dropped)],
        "b",
        "cork – any",
        operation,
    )
    .unwrap();
    let operation = Operation::Compose {
        tap: "b".into(),
        slide: "c".into(),
        friction: "e".into(),
    };
    let all = [&blend, &cork, &edited].map(Some);
    let composed = Recipe::new(all, "x", "cork", operation).unwrap();
    assert_eq!(
        composed.command().unwrap(),
        "asperity compile 'cork' -o cork.asp\n\
         asperity edit cork.asp --softer 20 --slipperier 2.5 -o 'cork (2).asp'\n\
         asperity blend 'cork (2).asp' './-cork (2).asp' -t 0.25 -o 'cork – any.asp'\n\
         asperity compose --tap 'cork – any.asp' --slide cork.asp --friction 'cork (2).asp' -o 'cork (3).asp'"
    );
    assert_eq!(composed.file().as_deref(), Some("cork (3).asp"));
}

#[test]
fn no_line_overwrites_a_file_that_was_opened() {
    let dropped = file("f", "cork.asp");
    assert_eq!(dropped.command(), None);
    assert_eq!(dropped.file().as_deref(), Some("cork.asp"));
    let words = Edit::Words("-a bit softer".into());
    let edited = edited(&dropped, "f", "e", "cork", words).unwrap();
    assert_eq!(
        edited.command().unwrap(),
        "asperity edit cork.asp --prompt='-a bit softer' -o 'cork (2).asp'"
    );
    let operation = Operation::Blend {
        a: "f".into(),
        b: "g".into(),
        t: 0.5,
        draft: false,
    };
    let other = file("g", "cork.asp");
    let blend = Recipe::new([Some(&dropped), Some(&other)], "b", "two", operation).unwrap();
    assert_eq!(blend.command(), None, "two files of one path");
}

#[test]
fn other_files_are_imported_and_textures_of_libraries_extracted() {
    let opened = |path: &str| Opened {
        path: path.into(),
        id: "o".into(),
    };
    let (kind, file) = ("hatt", opened("Models_Oak.xml"));
    let oak = Recipe::new(
        [],
        "1",
        "Oak",
        Operation::Import {
            kind: kind.into(),
            file,
            options: String::new(),
        },
    )
    .unwrap();
    let command = "asperity import hatt Models_Oak.xml -o Oak.asp";
    assert_eq!(oak.command().as_deref(), Some(command));
    for (texture, command) in [
        ("wet ice", "asperity extract my.aspl 'wet ice' -o any.asp"),
        ("-x", "asperity extract -o any.asp -- my.aspl -x"),
    ] {
        let (library, texture) = (opened("my.aspl"), texture.to_owned());
        let operation = Operation::Extract { library, texture };
        let recipe = Recipe::new([], "2", "any", operation).unwrap();
        assert_eq!(recipe.command().as_deref(), Some(command));
    }
}

#[test]
fn what_no_one_can_type_has_no_recipe() {
    let cork = compiled("0", "cork", 0);
    let words = Edit::Words("softer\0".into());
    assert!(edited(&cork, "0", "1", "cork", words).is_none());
    let mut last = cork;
    for n in 1..MOST {
        let (from, id) = ((n - 1).to_string(), n.to_string());
        last = edited(&last, &from, &id, "cork", softer(1.0)).unwrap();
    }
    assert_eq!(last.command().unwrap().lines().count(), MOST);
    let from = (MOST - 1).to_string();
    assert!(edited(&last, &from, "more", "cork", softer(1.0)).is_none());
}

#[test]
fn a_list_of_which_two_textures_come_is_built_once() {
    let built = |id: &str, name: &str| {
        let list = Opened {
            path: "my rooms.csv".into(),
            id: "l".into(),
        };
        let texture = name.into();
        Recipe::new([], id, name, Operation::Build { list, texture }).unwrap()
    };
    let (wall, floor) = (built("w", "wall"), built("f", "-floor"));
    let operation = Operation::Blend {
        a: "w".into(),
        b: "f".into(),
        t: 0.5,
        draft: false,
    };
    let both = Recipe::new([Some(&wall), Some(&floor)], "b", "both", operation).unwrap();
    let lines = [
        "asperity build 'my rooms.csv' -o 'my rooms.aspl'",
        "asperity extract 'my rooms.aspl' wall -o wall.asp",
        "asperity extract -o _-floor.asp -- 'my rooms.aspl' -floor",
        "asperity blend wall.asp _-floor.asp -t 0.5 -o both.asp",
    ];
    assert_eq!(both.command().unwrap().lines().collect::<Vec<_>>(), lines);
    assert!(both.link().is_none());
}
