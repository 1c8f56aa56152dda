//! Words about pictures and about materials of computer graphics, as prompts for those have them: "seamless",
//! "roughness map", "soft light", "--ar 16:9". They say nothing about touch, even where one of them does by itself.

use crate::lexicon::closed_class::{is_colour, is_function};
use crate::{
    Vocabulary, lexicon, phrase,
    words::{
        Token,
        grade::{self, Context},
        singular,
    },
};
use std::borrow::Cow;

/// Lines `WORDS TAB ROLE`, sorted by the bytes of the words, which are normalised and in the singular. Without a role they
/// say nothing by themselves. `of`: qualities before it are its own ("soft lighting"). `last`: the same, where nothing
/// follows that it would be a quality of ("soft light", but "soft light wood"). `map`: only what a map, or a number from
/// 0 to 1, is of. Any may have a map: "light map".
const GRAPHICS: &str = include_str!("graphics.tsv");
/// Words of a line at most.
const LONGEST: usize = 4;
/// Words for a map.
const MAPS: &[&str] = &[
    "map", "maps", "mapping", "channel", "channels", "pass", "passes", "slot", "mapped",
];
/// Least clauses of a list of what maps are of: "metallic, glossy" are qualities.
const LISTED: usize = 3;
/// Parameters that end a prompt for Midjourney.
const PARAMETERS: &[&str] = &[
    "ar", "aspect", "c", "chaos", "cref", "cw", "draft", "exp", "fast", "hd", "iw", "motion",
    "niji", "no", "oref", "ow", "p", "profile", "q", "quality", "raw", "relax", "repeat", "s",
    "seed", "sref", "stop", "style", "stylize", "sv", "sw", "test", "testp", "tile", "turbo",
    "uplight", "v", "version", "video", "w", "weird",
];

/// A prompt without the networks that it names ("<lora:NAME:0.8>") and without its last parameters ("--ar 16:9"); and
/// what went.
pub(super) fn described(prompt: &str) -> (Cow<'_, str>, Vec<String>) {
    let mut gone = Vec::new();
    let mut prompt = Cow::Borrowed(prompt);
    let is_parameter = |at: usize| {
        let apart = prompt[..at]
            .chars()
            .next_back()
            .is_none_or(char::is_whitespace);
        let name = prompt[at + 2..]
            .split(|c: char| !c.is_alphanumeric())
            .next();
        apart && name.is_some_and(|name| PARAMETERS.contains(&name.to_lowercase().as_str()))
    };
    let end = prompt
        .match_indices("--")
        .map(|(at, _)| at)
        .find(|at| is_parameter(*at));
    if let Some(end) = end {
        gone.push(prompt[end..].trim().to_owned());
        prompt = prompt[..end].to_owned().into();
    }
    while let Some((start, end)) = network(&prompt) {
        gone.push(prompt[start..end].to_owned());
        prompt.to_mut().replace_range(start..end, " ");
    }
    (prompt, gone)
}

/// Where "<lora:NAME:0.8>" begins and ends.
fn network(prompt: &str) -> Option<(usize, usize)> {
    prompt.match_indices('<').find_map(|(start, _)| {
        let inside = &prompt[start + 1..];
        let inside = &inside[..inside.find(['<', '>'])?];
        let named = inside.split_once(':')?.0.chars().all(char::is_alphanumeric);
        let closed = prompt[start + 1 + inside.len()..].starts_with('>');
        (named && closed).then_some((start, start + inside.len() + 2))
    })
}

/// Takes words of graphics from a prompt, and adds them to those that are `gone`. `is_known` tells whether a word is
/// English, and no misspelt name.
pub(super) fn divide(
    tokens: &mut Vec<Token>,
    gone: &mut Vec<String>,
    is_known: impl Fn(&str) -> bool,
) {
    unwanted(tokens, gone);
    listed(tokens, gone);
    let context = grade::may_be_in(tokens).then(|| Context::of(tokens));
    let mut at = 0;
    while at < tokens.len() {
        // "2k grit"
        let graded = context.and_then(|about| grade::read(&tokens[at..], about));
        let term = longest(&tokens[at..]);
        let least = term.map_or(0, |(count, _)| count);
        // "3d printed plastic", "tail light"
        let named = || named(&tokens[at..]).filter(|count| *count >= least);
        if let Some(count) = graded.map(|(count, _)| count).or_else(named) {
            at += count;
            continue;
        }
        let Some((count, role)) = term else {
            at += 1;
            continue;
        };
        let own = match role {
            "of" => true,
            "last" if ends(&tokens[at + count..]) => true,
            "last" => {
                at += count;
                continue;
            }
            _ => false,
        };
        let from = if own {
            qualities(&tokens[..at], &is_known)
        } else {
            at
        };
        gone.push(said(&tokens[from..at + count]));
        tokens.drain(from..at + count);
        at = from;
    }
}

/// Takes lists of what maps are of: "brick, albedo, normal, roughness".
fn listed(tokens: &mut Vec<Token>, gone: &mut Vec<String>) {
    let clauses: Vec<&[Token]> = tokens
        .split(|token| token.word().is_none())
        .filter(|clause| !clause.is_empty())
        .collect();
    let is_map = |clause: &[Token]| is_map(&said(clause));
    let (lists, rest): (Vec<_>, Vec<_>) = clauses
        .chunk_by(|a, b| is_map(a) && is_map(b))
        .partition(|run| run.len() >= LISTED);
    if lists.is_empty() {
        return;
    }
    gone.extend(lists.concat().into_iter().map(said));
    *tokens = rest.concat().join(&Token::Break(','));
}

/// The words of tokens.
fn said(tokens: &[Token]) -> String {
    let words = tokens.iter().filter_map(|token| word(Some(token)));
    words.collect::<Vec<_>>().join(" ")
}

/// The role of words of graphics.
fn role(words: &str) -> Option<&'static str> {
    let line = Vocabulary::new(GRAPHICS).line("", words)?;
    Some(line.split_once('\t').map_or("", |(_, role)| role))
}

fn is_map(words: &str) -> bool {
    role(words) == Some("map")
}

/// Number of tokens in the longest name at the start.
fn named(tokens: &[Token]) -> Option<usize> {
    let words = tokens.iter().map_while(|token| word(Some(token)));
    let words: Vec<&str> = words.take(lexicon::LONGEST).collect();
    lexicon::longest(&words, |_, _| true).map(|(count, _)| count)
}

fn word(token: Option<&Token>) -> Option<&str> {
    token?.word()
}

fn is_break(token: Option<&Token>) -> bool {
    token.is_some_and(|token| token.word().is_none())
}

/// Takes what a prompt does not want, up to what it wants again, and settings of a sampler.
fn unwanted(tokens: &mut Vec<Token>, gone: &mut Vec<String>) {
    let is =
        |at: usize, words: &[&str]| word(tokens.get(at)).is_some_and(|word| words.contains(&word));
    let prompt = &["prompt", "prompts"];
    let negative = |at: usize| is(at, &["negative", "neg", "undesired"]) && is(at + 1, prompt);
    let number = |at: usize| word(tokens.get(at)).is_some_and(|word| word.parse::<u32>().is_ok());
    let settings =
        |at: usize| is(at, &["steps"]) && number(at + 2) && is(at + 4, &["sampler", "cfg", "seed"]);
    let Some(start) = (0..tokens.len()).find(|at| negative(*at) || settings(*at)) else {
        return;
    };
    let wanted = |at: &usize| {
        let begins = tokens[at - 1].word().is_none() || is(at - 1, &["positive"]);
        begins && is(*at, prompt) && is_break(tokens.get(at + 1))
    };
    let end = (start + 2..tokens.len())
        .find(wanted)
        .filter(|_| negative(start));
    let end = end.unwrap_or(tokens.len());
    gone.push(said(&tokens[start..end]));
    tokens.drain(start..end);
}

/// Finds the longest graphics term at the start: its number of tokens and its role.
fn longest(tokens: &[Token]) -> Option<(usize, &'static str)> {
    let words: Vec<&str> = tokens
        .iter()
        .map_while(|token| word(Some(token)))
        .take(LONGEST)
        .collect();
    let first = words.first()?;
    // "512x512", "normalmaps"
    let kind = singular(first);
    if is_resolution(first) || kind.strip_suffix("map").is_some_and(is_map) {
        return Some((1, ""));
    }
    (1..=words.len()).rev().find_map(|count| {
        let said = words[..count].join(" ");
        let role = role(&said).or_else(|| role(&singular(&said)))?;
        if words.get(count).is_some_and(|next| MAPS.contains(next)) {
            return Some((count + 1, ""));
        }
        if role != "map" {
            return Some((count, role));
        }
        // "roughness: 0.8", but "roughness 0.8 µm"
        let colon = usize::from(is_break(tokens.get(count)));
        let value = word(tokens.get(count + colon))?.parse::<f64>().ok()?;
        (0.0..=1.0)
            .contains(&value)
            .then_some((count + colon + 1, role))
    })
}

/// "4k", "1080p", "512x512".
fn is_resolution(word: &str) -> bool {
    let number =
        |digits: &str| !digits.is_empty() && digits.bytes().all(|byte| byte.is_ascii_digit());
    let sides = word.split_once('x');
    word.strip_suffix('k')
        .is_some_and(|digits| digits.len() < 3 && number(digits))
        || word
            .strip_suffix('p')
            .is_some_and(|digits| digits.len() > 2 && number(digits))
        || sides.is_some_and(|(a, b)| a.len() > 2 && b.len() > 2 && number(a) && number(b))
}

/// Returns true if nothing follows that a preceding quality could describe.
fn ends(after: &[Token]) -> bool {
    let clause = after
        .iter()
        .take_while(|token| token.word().is_some())
        .count();
    let more = || (1..clause).any(|at| longest(&after[at..clause]).is_some());
    match word(after.first()) {
        None => true,
        // "soft light and hard shadows", but "soft light and airy wool"
        Some("and" | "or" | "but") => more(),
        Some(next) => longest(after).is_some() || is_function(next),
    }
}

/// Where the qualities begin that stand at the end of tokens, with their degrees and what joins them. Among them may
/// stand words that say nothing: "soft cinematic lighting".
fn qualities(tokens: &[Token], is_known: impl Fn(&str) -> bool) -> usize {
    let is_quality = |word: &str| {
        phrase::is_quality(word)
            || phrase::is_degree(word)
            || lexicon::is_quality(word)
            || is_colour(word)
    };
    let says_nothing = |word: &str| {
        word == "and" || (!is_function(word) && lexicon::name(&[word]).is_none() && is_known(word))
    };
    let (mut from, mut passed) = (tokens.len(), false);
    for (at, token) in tokens.iter().enumerate().rev() {
        match word(Some(token)) {
            Some(word) if is_quality(word) => (from, passed) = (at, false),
            Some(word) if !passed && says_nothing(word) => passed = true,
            _ => break,
        }
    }
    from
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::words::normalise;

    #[test]
    fn terms_are_sorted_normalised_and_have_a_known_role() {
        let words: Vec<&str> = GRAPHICS
            .lines()
            .map(|line| line.split('\t').next().unwrap_or_default())
            .collect();
        assert!(words.windows(2).all(|pair| pair[0] < pair[1]), "sorted");
        for line in GRAPHICS.lines() {
            let (words, role) = line.split_once('\t').unwrap_or((line, ""));
            assert!(["", "of", "last", "map"].contains(&role), "{line}");
            let tokens = normalise(words);
            let again: Vec<&str> = tokens
                .iter()
                .filter_map(|token| word(Some(token)))
                .collect();
            assert_eq!(again.join(" "), words);
            assert!(again.len() <= LONGEST, "{line}");
        }
    }
}
