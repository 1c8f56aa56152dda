//! Readings of prompts, a few for each kind of rule.

use super::PROMPTS;
use asperity::sources::prompt::reading::{Reading, Role};

fn read(prompt: &str) -> Reading {
    PROMPTS.read(prompt)
}

fn texts(cases: &[(&str, &str)]) {
    for (prompt, expected) in cases {
        assert_eq!(read(prompt).text(), *expected, "{prompt:?}");
    }
}

#[test]
fn a_name_is_found_in_what_asks_for_it() {
    for prompt in [
        "Gravel.",
        "make me gravel",
        "running a finger over gravel",
        "what does gravel feel like",
        "blue gravel",
        "emerald green gravel",
        "high quality gravel",
        "my grandmother's gravel",
        "gravel from the corner shop",
        "the gravel that John brought from Spain",
        "drawing with a pen on gravel",
        "gravel, thanks!",
        "gr\u{200b}avel",
    ] {
        let reading = read(prompt);
        assert_eq!(reading.text(), "gravel", "{prompt:?}");
        assert_eq!((reading.names.len(), reading.words.len()), (1, 1));
    }
}

#[test]
fn what_says_how_it_feels_stays() {
    texts(&[
        ("please, some very rough gravel", "very rough gravel"),
        (
            "cheap leather that is not rough at all",
            "not rough at all leather",
        ),
        ("steel without its grit", "steel without grit"),
        ("my favourite wool, but softer", "softer wool"),
        ("bread soaked in milk", "bread soaked in milk"),
        ("an awfully rough brick", "awfully rough brick"),
    ]);
}

/// Claim: a sentence is read as a contact: what is touched, and what else it says in which role.
#[test]
fn a_sentence_is_read_as_a_contact() {
    for (prompt, expected, role, word) in [
        ("This is not wood but steel.", "steel", Role::Denied, "wood"),
        (
            "The knife slides along the cheese.",
            "cheese",
            Role::Tool,
            "knife",
        ),
        (
            "He sat down at a table made of oak.",
            "oak",
            Role::Object,
            "table",
        ),
    ] {
        let reading = read(prompt);
        assert_eq!(reading.text(), expected, "{prompt}");
        let said = (role, word.to_owned());
        assert!(
            reading.others.contains(&said),
            "{prompt}: {:?}",
            reading.others
        );
    }
    for prompt in ["She has nerves of steel.", "I felt sad after the film."] {
        assert!(!read(prompt).contact, "{prompt}");
    }
}

#[test]
fn the_longest_name_wins_and_its_words_change_nothing() {
    texts(&[
        ("steel wool", "steel wool"),
        ("KNURLED  brass", "knurled brass"),
    ]);
    let reading = read("oiled knurled brass");
    assert_eq!(reading.words, ["oiled", "knurled brass"]);
    // A degree before it makes its quality one that is said.
    assert_eq!(
        read("extremely rough concrete").words,
        ["extremely", "rough", "concrete"]
    );
}

#[test]
fn what_is_left_out_is_told() {
    let reading = read("imported gravel from my grandmother");
    assert_eq!(reading.names, ["gravel"]);
    assert_eq!(reading.ignored, ["grandmother"]);
}

#[test]
fn descriptions_and_things_of_no_list_are_encoded_whole() {
    texts(&[
        ("a rough zorble", "rough zorble"),
        ("please make me a rough zorble", "rough zorble"),
        (
            "the untidy welds on a farm gate",
            "the untidy welds on a farm gate",
        ),
        ("a manhole lid in a downpour", "a manhole lid in a downpour"),
        ("the tray of a tea trolley", "tray of tea trolley"),
        ("?!", "?!"),
    ]);
}

#[test]
fn numbers_are_read_and_parts_are_taken_for_what_they_are() {
    texts(&[
        ("a sheet of sandpaper, grit 80", "80 grit sandpaper"),
        ("sandpaper no. 220", "220 grit sandpaper"),
        ("please make me rubber of Shore A 60", "Shore A 60 rubber"),
        ("the handle of a toothbrush", "handle"),
        ("a toothbrush's handle", "handle"),
        ("handle of a wooden spoon", "handle of wood"),
        ("the ends of a rope", "rope"),
        ("a hammer's head", "hammer"),
        ("rusty hinge", "rusty hinge"),
        (
            "the cutting edge of a guillotine",
            "the cutting edge of a guillotine",
        ),
    ]);
    let reading = read("P80 P400 sandpaper");
    assert_eq!(
        reading
            .conflict
            .map(|pair| pair.map(|grade| grade.to_string())),
        Some(["P80".into(), "P400".into()])
    );
    assert_eq!(read("between P80 and P400 sandpaper").conflict, None);
}

#[test]
fn a_misspelling_is_put_right_and_said() {
    for (prompt, expected) in [
        ("velvit", "velvet"),
        ("make me some velvit", "velvet"),
        ("patnt leather", "patent leather"),
        ("bees wax", "beeswax"),
        ("gravel idk", "gravel"),
        ("a fork", "fork"),
    ] {
        assert_eq!(read(prompt).text(), expected, "{prompt:?}");
    }
    // Only the space between two words is missing.
    for (prompt, expected) in [
        ("brickwall", "brick wall"),
        ("aluminumfoil", "aluminium foil"),
        ("a polished woodfloor", "polished wood floor"),
        ("baumwolle", "baumwolle"),
    ] {
        let reading = read(prompt);
        assert_eq!(reading.text(), expected, "{prompt}");
        assert_eq!(reading.correction, None, "{prompt}");
    }
    // An unknown word beside it is rather of another language, accents or none.
    for prompt in ["grava áspera", "sameto macio"] {
        assert_eq!(read(prompt).correction, None, "{prompt}");
    }
    let correction = read("velvit").correction.expect("a correction");
    assert_eq!(
        (correction.said.as_str(), correction.corrected.as_str()),
        ("velvit", "velvet")
    );
    assert_eq!(read("velvet").correction, None);
    for (typed, doubtful) in [
        ("velvit", false),
        ("slik", false),
        ("leahter", false),
        ("kies", true),
        ("samt", true),
        ("kork", true),
    ] {
        let correction = read(typed).correction.expect(typed);
        assert_eq!(correction.doubtful, doubtful, "{typed}");
    }
}

#[test]
fn what_no_list_of_english_holds_says_nothing() {
    for prompt in [
        "gravier rugueux",
        "schleifpapier",
        "żwir",
        "sжndpaper",
        "wug blicket dax",
        "a rough zorble",
    ] {
        assert!(!read(prompt).says, "{prompt}");
    }
    for prompt in ["a manhole lid in a downpour", "velvety", "vеlvet"] {
        assert!(read(prompt).says, "{prompt}");
    }
}

#[test]
fn words_of_pictures_say_nothing_about_touch() {
    for prompt in [
        "seamless tileable gravel, 8k, PBR",
        "gravel normal map",
        "gravel heightmap, 2048x2048",
        "gravel, roughness: 0.8, metallic 1",
        "PBR gravel, albedo, normal, roughness, AO, seamless",
        "gravel, sharp focus, soft light",
        "gravel, soft light and hard shadows",
        "gravel, warm and soft natural light",
        "gravel, soft cinematic lighting",
        "gravel, uv mapped, light map, shadow pass",
        "sharp focus gravel",
        "gravel, smooth gradient background",
        "gravel, unreal engine, ray tracing, glossy reflections",
        "gravel --ar 16:9 --no rough",
        "gravel <lora:skin_detail:0.8>",
        "gravel. Negative prompt: smooth, shiny plastic",
        "Prompt: gravel. Negative prompt: smooth silk",
        "Negative prompt: smooth silk. Prompt: gravel",
        "gravel\nSteps: 20, Sampler: Euler a, CFG scale: 7",
    ] {
        assert_eq!(read(prompt).text(), "gravel", "{prompt}");
    }
}

#[test]
fn the_same_words_about_a_thing_stay() {
    for (prompt, expected) in [
        ("soft light leather", "soft leather"),
        ("smooth leather", "smooth leather"),
        ("3d printed plastic", "3d-printed plastic"),
        ("2k grit sandpaper", "2000 grit sandpaper"),
        ("a traffic light", "traffic light"),
        ("steel with a roughness of 0.8 µm", "steel with Ra 0.8 µm"),
        ("wet stone steps, smooth", "smooth wet stone step"),
        ("brick --rough", "rough brick"),
        ("smooth lether background", "smooth leather"),
        (
            "gravel, smoothness, metallic",
            "metallic gravel with smoothness",
        ),
        ("wooden photo frame", "wooden photo frame"),
    ] {
        assert_eq!(read(prompt).text(), expected, "{prompt}");
    }
}
