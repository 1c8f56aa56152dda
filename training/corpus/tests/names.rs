//! The tables of the prompt reader are those of the committed corpus.

use asperity_corpus::reference::names;

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
