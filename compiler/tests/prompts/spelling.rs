//! Misspelt names are put right, and said; words of their own are not.

use super::PROMPTS;
use asperity_tests::{figures, size::sized};
use rand_core::{Rng as _, SeedableRng as _};
use rand_xoshiro::Xoshiro256PlusPlus;

const ERRORS: usize = 300;
/// Least share of misspelt names that are read as their material, or said to be read as another.
const LEAST_RIGHT: f64 = 0.95;

/// A name with one letter lost, doubled, changed or swapped with the next.
fn misspelt(name: &str, random: &mut Xoshiro256PlusPlus) -> String {
    let mut draw = |below: usize| (random.next_u64() % below as u64) as usize;
    let mut letters: Vec<char> = name.chars().collect();
    let places: Vec<usize> = (0..letters.len())
        .filter(|&n| letters[n].is_ascii_alphabetic())
        .collect();
    let at = places[draw(places.len())];
    let letter = char::from(b'a' + draw(26) as u8);
    match draw(4) {
        0 => drop(letters.remove(at)),
        1 => letters.insert(at, letter),
        2 => letters[at] = letter,
        _ if at + 1 < letters.len() => letters.swap(at, at + 1),
        _ => letters.swap(at - 1, at),
    }
    letters.into_iter().collect()
}

#[test]
fn a_misspelt_name_is_its_material_or_is_said() {
    let mut random = Xoshiro256PlusPlus::seed_from_u64(37);
    let anchors = &PROMPTS.model().description().anchors;
    let count = sized("misspelt names", 100, ERRORS);
    let mut right = 0;
    for _ in 0..count {
        let draw = (random.next_u64() % anchors.len() as u64) as usize;
        let name = &anchors[draw].name;
        let typed = misspelt(name, &mut random);
        let (read, bare) = (PROMPTS.read(&typed), PROMPTS.read(name));
        if read.words == bare.words || read.correction.is_some() {
            right += 1;
        } else {
            println!("{typed:?} for {name:?}: {:?}", read.text());
        }
    }
    println!("{right} of {count} misspelt names");
    assert!(
        right as f64 >= LEAST_RIGHT * count as f64,
        "{right} of {count}"
    );
    figures::hold_at_full(
        "misspellings",
        "-p asperity --test it misspelt",
        [("right", right.to_string()), ("of", count.to_string())],
    );
}

#[test]
fn a_word_of_its_own_is_no_misspelling() {
    let file = concat!(
        env!("CARGO_MANIFEST_DIR"),
        "/../training/corpora/evaluation/near_words.txt"
    );
    let text = std::fs::read_to_string(file).expect(file);
    let corrected: Vec<_> = text
        .lines()
        .filter_map(|word| PROMPTS.read(word).correction)
        .collect();
    assert!(corrected.is_empty(), "{corrected:?}");
}
