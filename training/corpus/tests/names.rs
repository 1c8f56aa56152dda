//! The tables of the prompt reader are those of the committed corpus.

use asperity_corpus::reference::names;
use asperity_language::reading::key;

const REMEDY: &str = "run `cargo run --release -p asperity-corpus --example names`";

#[test]
fn the_tables_of_the_reader_are_those_of_the_corpus() {
    let file = |name: &str| {
        let folder = concat!(
            env!("CARGO_MANIFEST_DIR"),
            "/../../compiler/language/src/lexicon/"
        );
        std::fs::read_to_string(format!("{folder}{name}")).expect(name)
    };
    assert!(file("names.tsv") == names::table(), "{REMEDY}");
    assert!(file("qualities.txt") == names::qualities(), "{REMEDY}");
}

/// Claim: a trade name is read as the name of what it stands for, and stands for no other name that is known.
#[test]
fn trade_names_are_read_as_what_they_stand_for() {
    let table = names::table();
    let name_of = |text: &str| {
        let key = key(text).expect(text);
        let mut lines = table
            .lines()
            .map(|line| line.split_once('\t').unwrap_or((line, line)));
        lines.find(|(known, _)| *known == key).map(|(_, name)| name)
    };
    let all = names::trade_names();
    assert!(all.len() > 400);
    for (said, meaning) in all {
        assert_eq!(name_of(&said), name_of(&meaning), "{said}");
    }
}
