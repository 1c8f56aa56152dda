//! Writes what the tagger of the prompt reader is fitted to: states, flags and roles of the words of marked texts, for
//! `compiler/model/tools/export_roles.py`.
//!
//! `cargo run --release -p asperity-corpus --example roles -- OUTPUT`

use asperity::learned::embedded;
use asperity_corpus::sentences::{self, Span, Words};
use asperity_language::{
    roles::{self, Role},
    words::Token,
};
use rand_xoshiro::{Xoshiro256PlusPlus, rand_core::SeedableRng as _};
use rayon::prelude::*;
use std::{error::Error, fs::File, io::Write as _};

/// Fills of a written text, fills of a frame, and bare phrases.
const FILLS: usize = 4;
const FRAME_FILLS: usize = 24;
const PHRASES: usize = 3000;

/// A text with the name of its file; not filled as it was written.
struct Text {
    file: String,
    filled: bool,
    tokens: Vec<(Token, Role)>,
}

fn main() -> Result<(), Box<dyn Error>> {
    let output = std::env::args().nth(1).ok_or("usage: roles OUTPUT")?;
    let texts = texts()?;
    let states = embedded::word_states();
    let table = embedded::word_table()?;
    let records: Result<Vec<Vec<u8>>, _> = texts
        .par_iter()
        .map(|text| {
            let (tokens, roles): (Vec<_>, Vec<_>) = text.tokens.iter().cloned().unzip();
            let flags = roles::flags(&tokens, &table);
            let states = states.try_states(&tokens)?;
            // Name, whether it is filled, number of tokens; of each its role, state and flags.
            let mut record = vec![text.file.len() as u8];
            record.extend(text.file.bytes());
            record.push(u8::from(text.filled));
            record.extend((states.len() as u16).to_le_bytes());
            for ((state, flags), role) in states.iter().zip(&flags).zip(&roles) {
                record.push(*role as u8);
                record.extend(state.iter().chain(flags).flat_map(|x| x.to_le_bytes()));
            }
            Ok::<_, asperity_io::diagnostic::Fault>(record)
        })
        .collect();
    let mut file = File::create(output)?;
    for record in records? {
        file.write_all(&record)?;
    }
    eprintln!("{} texts", texts.len());
    Ok(())
}

fn texts() -> Result<Vec<Text>, Box<dyn Error>> {
    let words = Words::read()?;
    let mut random = Xoshiro256PlusPlus::seed_from_u64(1);
    let mut texts = Vec::new();
    let mut add = |file: &str, filled: bool, spans: &[Span]| {
        let tokens = sentences::tokens(spans);
        // Where a filled name joins what stands beside it, the text is left out.
        texts.extend(tokens.map(|tokens| Text {
            file: file.to_owned(),
            filled,
            tokens,
        }));
    };
    for _ in 0..PHRASES {
        add("phrases", true, &words.phrase(&mut random));
    }
    let frames = sentences::frames()?;
    let frames = frames.iter().map(|frame| ("frames", frame, FRAME_FILLS));
    let written = sentences::texts()?;
    let written = written
        .iter()
        .map(|(file, line)| (file.as_str(), line, FILLS));
    for (file, line, fills) in frames.chain(written) {
        let spans = sentences::spans(line).ok_or_else(|| format!("{file}: a mark in {line}"))?;
        if file != "frames" {
            add(file, false, &spans);
        }
        for _ in 0..fills {
            let new = sentences::filled(&spans, &words, &mut random);
            if new == spans {
                break;
            }
            add(file, true, &new);
        }
    }
    Ok(texts)
}
