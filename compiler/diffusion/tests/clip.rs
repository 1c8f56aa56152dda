//! CLIP's own merges give CLIP's own ids.

use asperity_diffusion::{CONTEXT, Tokens};
use asperity_model::CLIP_MERGES;

/// `vocab.json` as CLIP's tokenizer has it: bytes, bytes at the end of a word, merges, marks.
fn vocabulary() -> String {
    let printed = ('!'..='~').chain('¡'..='¬').chain('®'..='ÿ');
    let letters: Vec<String> = printed
        .chain('\u{100}'..='\u{143}')
        .map(String::from)
        .collect();
    let ends = letters.iter().map(|letter| format!("{letter}</w>"));
    let merged = CLIP_MERGES
        .lines()
        .skip(1)
        .map(|line| line.replace(' ', ""));
    let marks = ["<|startoftext|>", "<|endoftext|>"].map(str::to_owned);
    let tokens = letters
        .iter()
        .cloned()
        .chain(ends)
        .chain(merged)
        .chain(marks);
    let entries: Vec<String> = tokens
        .enumerate()
        .map(|(id, token)| format!("{}:{id}", serde_json::Value::from(token)))
        .collect();
    format!("{{{}}}", entries.join(","))
}

#[test]
fn the_ids_are_those_of_clip() {
    let settings = r#"{"pad_token": "!", "model_max_length": 77}"#;
    let tokens = Tokens::parse(&vocabulary(), CLIP_MERGES, Some(settings)).expect("CLIP");
    // Ids that OpenAI's tokenizer gives.
    for (text, ids) in [
        ("a photo of a cat", &[320, 1125, 539, 320, 2368][..]),
        ("Hi there", &[1883, 997]),
        ("", &[]),
    ] {
        let encoded = tokens.encode(text).ids;
        let mut expected = vec![49_406];
        expected.extend(ids);
        expected.push(49_407);
        // Stable Diffusion 2 pads with "!", the first token.
        expected.resize(CONTEXT, 0);
        assert_eq!(encoded, expected, "{text}");
    }
}

/// A word of a megabyte is read as far as it can count.
#[test]
fn endless_texts_are_cut() {
    let tokens = Tokens::parse(&vocabulary(), CLIP_MERGES, None).expect("CLIP");
    let encoded = tokens.encode(&"é".repeat(1_000_000));
    assert_eq!(encoded.ids.len(), CONTEXT);
    assert!(encoded.cut > 0);
}
