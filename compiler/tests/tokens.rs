//! The tokens of a prompt are those that an independent WordPiece gives.

use asperity::learned::{
    embedded,
    inference::Backend,
    text::{
        WithWords,
        minilm::{MAX_TOKENS, MiniLm},
    },
};
use proptest::prelude::*;
use rten_text::{
    models::{Model as _, WordPiece, WordPieceOptions},
    normalizers::{Bert, BertOptions, Normalizer as _},
    pre_tokenizers::{self, PreTokenizer as _},
};
use std::{path::Path, sync::LazyLock};

static OURS: LazyLock<WithWords<MiniLm>> =
    LazyLock::new(|| embedded::text_encoder(&Backend::Portable).expect("the embedded encoder"));
static PIECES: LazyLock<Vec<(&str, u32)>> = LazyLock::new(|| {
    let lines = asperity_model::VOCABULARY.lines();
    let parts = lines.map(|line| line.split_once('\t').expect("piece TAB id"));
    parts
        .map(|(piece, id)| (piece, id.parse().expect("an id")))
        .collect()
});
static THEIRS: LazyLock<WordPiece> = LazyLock::new(|| {
    let pieces = PIECES.iter().map(|(piece, id)| ((*piece).to_owned(), *id));
    WordPiece::from_vocab(pieces.collect(), WordPieceOptions::default())
});

/// Ids of a text and how many are cut off, by the other implementation.
fn expected(text: &str) -> (Vec<i64>, usize) {
    let normaliser = Bert::new(BertOptions {
        lowercase: true,
        strip_accents: true,
    });
    let (normal, _) = normaliser.normalize(text).expect("no expression to fail");
    let words = pre_tokenizers::Bert::new().pre_tokenize(&normal);
    let mut ids = vec![101];
    for word in words.expect("no expression to fail") {
        let mut push = |_, id| ids.push(i64::from(id));
        let encoded = THEIRS.encode_with_offsets(word, &mut push);
        encoded.expect("the unknown is in the vocabulary");
    }
    let cut = (ids.len() + 1).saturating_sub(MAX_TOKENS);
    ids.truncate(MAX_TOKENS - 1);
    ids.push(102);
    (ids, cut)
}

fn assert_same(text: &str) {
    let found = OURS.sentence().tokens(text).expect("a whole vocabulary");
    assert_eq!(found, expected(text), "{text:?}");
}

/// Each piece once, with the ids 0, 1, 2, …, in the order that the search relies on.
#[test]
fn the_vocabulary_is_sorted_and_whole() {
    assert!(PIECES.is_sorted_by(|(a, _), (b, _)| a < b));
    let mut ids: Vec<u32> = PIECES.iter().map(|(_, id)| *id).collect();
    ids.sort_unstable();
    assert!(ids.into_iter().eq(0..30_522));
}

#[test]
fn every_piece_of_the_vocabulary_is_found() {
    for pieces in PIECES.chunks(20) {
        for separator in [" ", ""] {
            let pieces: Vec<&str> = pieces.iter().map(|(piece, _)| *piece).collect();
            assert_same(&pieces.join(separator));
        }
    }
}

#[test]
fn every_character_alone_and_in_words() {
    let characters: Vec<char> = ('\0'..=char::MAX).collect();
    for few in characters.chunks(24) {
        let words: Vec<String> = few.iter().map(|c| format!("{c}wet{c}ness")).collect();
        assert_same(&words.join(" "));
    }
}

#[test]
fn the_corpus_and_the_documents() {
    let root = Path::new(env!("CARGO_MANIFEST_DIR"));
    let corpora = std::fs::read_dir(root.join("../training/corpora")).expect("the corpora");
    let files = corpora.map(|entry| entry.expect("an entry").path());
    let files = files.filter(|path| path.is_file());
    let mut lines = 0;
    for file in files.chain([root.join("../README.md")]) {
        for line in std::fs::read_to_string(file).expect("text").lines() {
            assert_same(line);
            lines += 1;
        }
    }
    assert!(lines > 1000, "{lines}");
}

#[test]
fn long_words_and_long_texts() {
    for length in [99, 100, 101, 400] {
        assert_same(&"a".repeat(length));
        assert_same(&"É".repeat(length));
        assert_same(&format!("x{}", "\u{301}".repeat(length)));
        assert_same(&"gritty ".repeat(length));
    }
    assert_same("");
    assert_same(" \t\n\u{a0}\u{3000}");
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(4000))]

    #[test]
    fn any_text(text in ".{0,60}") {
        assert_same(&text);
    }

    /// Marks, ligatures, wide forms and Hangul beside letters, which decompose or change their case.
    #[test]
    fn any_text_of_letters_and_marks(text in "[a-zA-ZÀ-ɏ\u{300}-\u{36f}İßǅΣﬁＡ-Ｚ가-힣'#\\[\\]. -]{0,60}") {
        assert_same(&text);
    }
}
