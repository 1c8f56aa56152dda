//! Texts with the roles of their words, for the tagger of the prompt reader.
//!
//! `training/corpora/sentences/` holds what was written, a text a line, with marks: `{s …}` what is touched, `{o …}` the
//! object that carries it, `{d …}` what is denied, `{t …}` a tool. [`filled`] puts other names and qualities in
//! their places.

use asperity_language::{
    lexicon, phrase,
    roles::Role,
    words::{Token, normalise},
};
use rand_core::Rng;
use rand_xoshiro::Xoshiro256PlusPlus;
use std::{
    fs, io,
    path::{Path, PathBuf},
};

/// A part of a text, and what it does there.
pub type Span = (Role, String);

fn folder() -> PathBuf {
    PathBuf::from(env!("CARGO_MANIFEST_DIR")).join("../corpora/sentences")
}

fn lines(file: &Path) -> io::Result<Vec<String>> {
    Ok(fs::read_to_string(file)?
        .lines()
        .map(str::to_owned)
        .collect())
}

/// Every written text, with the name of its file, in the order of the files' names.
///
/// # Errors
/// When the folder cannot be read.
pub fn texts() -> io::Result<Vec<(String, String)>> {
    let entries = fs::read_dir(folder())?.map(|entry| Ok(entry?.path()));
    let mut files: Vec<PathBuf> = entries.collect::<io::Result<_>>()?;
    files.retain(|file| file.is_file());
    files.sort();
    let mut all = Vec::new();
    for file in files {
        let name = file.file_stem().unwrap_or_default().to_string_lossy();
        all.extend(
            lines(&file)?
                .into_iter()
                .map(|line| (name.to_string(), line)),
        );
    }
    Ok(all)
}

/// Short constructions with slots.
///
/// # Errors
/// When the file cannot be read.
pub fn frames() -> io::Result<Vec<String>> {
    lines(&folder().join("slots/frames.txt"))
}

/// The spans of a marked text; `None` where a mark is not closed, or of no role.
#[must_use]
pub fn spans(line: &str) -> Option<Vec<Span>> {
    let mut spans = Vec::new();
    let mut rest = line;
    while let Some(start) = rest.find('{') {
        let (before, marked) = rest.split_at(start);
        let end = marked.find('}')?;
        let (mark, text) = marked[1..end].split_once(' ')?;
        let role = match mark {
            "s" => Role::Surface,
            "o" => Role::Object,
            "d" => Role::Denied,
            "t" => Role::Tool,
            _ => return None,
        };
        // "{s iron}'s": what ends a word belongs to it.
        let after = &marked[end + 1..];
        let of_word = |c: char| c.is_alphanumeric() || c == '\'' || c == '’';
        let tail = after.find(|c| !of_word(c)).unwrap_or(after.len());
        spans.push((Role::Context, before.to_owned()));
        spans.push((role, format!("{text}{}", &after[..tail])));
        rest = &after[tail..];
    }
    (!rest.contains('}')).then(|| {
        spans.push((Role::Context, rest.to_owned()));
        spans
    })
}

/// The text of spans.
#[must_use]
pub fn text(spans: &[Span]) -> String {
    spans.iter().map(|(_, text)| text.as_str()).collect()
}

/// The tokens of spans with their roles; `None` where a mark divides a word.
#[must_use]
pub fn tokens(spans: &[Span]) -> Option<Vec<(Token, Role)>> {
    let mut words = spans.iter().flat_map(|(role, text)| {
        let words = normalise(text).into_iter();
        let words = words.filter(|token| token.word().is_some());
        words.map(|word| (word, *role)).collect::<Vec<_>>()
    });
    let all = normalise(&text(spans)).into_iter().map(|token| {
        if token.word().is_none() {
            return Some((token, Role::Context));
        }
        words.next().filter(|(word, _)| *word == token)
    });
    let all: Option<Vec<_>> = all.collect();
    all.filter(|_| words.next().is_none())
}

/// A text with other names and qualities where it has some by themselves, and with others in its slots: `QUALITY`, `NAME`,
/// `OTHER` and `OBJECT` for names, `TOOL`, and `DULL` for what says nothing of touch.
#[must_use]
pub fn filled(spans: &[Span], words: &Words, random: &mut Xoshiro256PlusPlus) -> Vec<Span> {
    let mut new = Vec::new();
    for (role, text) in spans {
        let text = words.slots(text, random);
        match role {
            Role::Object if is_name(&text) => new.push((*role, words.name(random).to_owned())),
            Role::Surface | Role::Denied => match words.like(&text, random) {
                Some(like) => new.extend(like.into_iter().map(|(felt, text)| {
                    let role = if felt { *role } else { Role::Context };
                    (role, text)
                })),
                None => new.push((*role, text)),
            },
            _ => new.push((*role, text)),
        }
    }
    new
}

fn is_name(text: &str) -> bool {
    lexicon::is_name(&text.to_lowercase())
}

fn is_quality(word: &str) -> bool {
    phrase::is_quality(word) || lexicon::qualities().any(|quality| quality == word)
}

/// Words that fill the texts.
pub struct Words {
    names: Vec<&'static str>,
    qualities: Vec<&'static str>,
    dull: Vec<String>,
}

/// Parts of a filled span: whether they are felt, and their words.
type Parts = Vec<(bool, String)>;

impl Words {
    /// The words of the lexicon, and those that say nothing of touch.
    ///
    /// # Errors
    /// When the file of the latter cannot be read.
    pub fn read() -> io::Result<Self> {
        let mut qualities: Vec<_> = phrase::quality_words()
            .chain(lexicon::qualities())
            .collect();
        qualities.sort_unstable();
        qualities.dedup();
        Ok(Self {
            names: lexicon::names().collect(),
            qualities,
            dull: lines(&folder().join("slots/dull.txt"))?,
        })
    }

    /// A bare phrase: a name, or one with its qualities.
    #[must_use]
    pub fn phrase(&self, random: &mut Xoshiro256PlusPlus) -> Vec<Span> {
        let parts = if random.next_u32().is_multiple_of(5) {
            vec![(true, self.name(random).to_owned())]
        } else {
            self.with_quality(random)
        };
        let role = |felt| if felt { Role::Surface } else { Role::Context };
        parts
            .into_iter()
            .map(|(felt, text)| (role(felt), text))
            .collect()
    }

    fn name(&self, random: &mut Xoshiro256PlusPlus) -> &str {
        pick(&self.names, random)
    }

    /// A word of the lexicon, or one of those that say nothing of touch, for each slot.
    fn slots(&self, text: &str, random: &mut Xoshiro256PlusPlus) -> String {
        const TOOLS: [&str; 8] = [
            "pen", "stylus", "brush", "stick", "cloth", "needle", "blade", "wheel",
        ];
        let mut words: Vec<String> = Vec::new();
        for word in text.split(' ') {
            let bare = word.trim_matches(|c: char| !c.is_alphanumeric());
            let new = match bare {
                "NAME" | "OTHER" | "OBJECT" => self.name(random).to_owned(),
                "TOOL" => pick(&TOOLS, random).to_owned(),
                "DULL" => self.dull[random.next_u32() as usize % self.dull.len()].clone(),
                "QUALITY" => pick(&self.qualities, random).to_owned(),
                _ => {
                    words.push(word.to_owned());
                    continue;
                }
            };
            words.push(word.replace(bare, &new));
        }
        words.join(" ")
    }

    fn quality(&self, random: &mut Xoshiro256PlusPlus) -> String {
        const DEGREES: [&str; 8] = [
            "very",
            "slightly",
            "quite",
            "really",
            "rather",
            "extremely",
            "a bit",
            "fairly",
        ];
        let one = pick(&self.qualities, random);
        match random.next_u32() % 8 {
            0 => format!("{} {one}", pick(&DEGREES, random)),
            1 => format!("{one}, {}", pick(&self.qualities, random)),
            2 => format!("{one} and {}", pick(&self.qualities, random)),
            _ => one.to_owned(),
        }
    }

    /// A quality and a name, and before either of them perhaps what says nothing of touch.
    fn with_quality(&self, random: &mut Xoshiro256PlusPlus) -> Parts {
        let dull = |random: &mut Xoshiro256PlusPlus| self.slots(" DULL ", random);
        let (quality, name) = (self.quality(random), self.name(random));
        match random.next_u32() % 8 {
            0..=2 => vec![
                (true, quality),
                (false, dull(random)),
                (true, name.to_owned()),
            ],
            3 => vec![(false, dull(random)), (true, format!("{quality} {name}"))],
            4 => vec![
                (true, quality),
                (false, dull(random) + self.slots("DULL ", random).as_str()),
                (true, name.to_owned()),
            ],
            _ => vec![(true, format!("{quality} {name}"))],
        }
    }

    /// Another phrase of the same kind: a name, qualities, or qualities and a name.
    fn like(&self, text: &str, random: &mut Xoshiro256PlusPlus) -> Option<Parts> {
        let lower = text.to_lowercase();
        let words: Vec<&str> = lower.split(' ').collect();
        if is_name(&lower) {
            return Some(vec![(true, self.name(random).to_owned())]);
        }
        let says = |word: &&str| {
            let bare = word.trim_matches(',');
            is_quality(bare) || phrase::is_degree(bare) || ["and", "a"].contains(&bare)
        };
        let before = words.iter().take_while(|word| says(word)).count();
        if before == words.len() && before > 0 {
            return Some(vec![(true, self.quality(random))]);
        }
        let rest = words[before..].join(" ");
        (before > 0 && is_name(&rest)).then(|| self.with_quality(random))
    }
}

fn pick<T: Copy>(all: &[T], random: &mut Xoshiro256PlusPlus) -> T {
    all[random.next_u32() as usize % all.len()]
}
