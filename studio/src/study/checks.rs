//! The faults of a study's file that TOML itself does not see.

use super::{
    design::{Design, Simulate, TextureEntry},
    text::Text,
};
use asperity_io::{diagnostic::Fault, shown::suggestion};
use std::fmt::Display;
use toml::Spanned;

/// Ratings of one participant: a day of work.
const MOST_RATINGS: usize = 2000;

/// The faults that were found.
struct Checks<'t> {
    text: &'t Text,
    faults: Vec<Fault>,
}

impl Checks<'_> {
    /// A fault of what stands at a place.
    fn at<T>(&mut self, at: &Spanned<T>, field: &str, what: impl Display, remedy: &str) {
        let fault = self
            .text
            .fault(at, field.to_owned(), what.to_string(), remedy);
        self.faults.push(fault);
    }

    /// A fault of the file as a whole, or of a field whose line is not known.
    fn of(&mut self, field: &str, what: impl Display, remedy: impl Into<Box<str>>) {
        let fault = Fault::new(what, remedy).at(&self.text.path);
        self.faults.push(fault.field(field));
    }

    /// A number within bounds.
    fn within<N: PartialOrd + Display>(&mut self, field: &str, number: N, [least, most]: [N; 2]) {
        if !(least <= number && number <= most) {
            self.of(field, number, format!("give {least} to {most}"));
        }
    }

    /// Names that become names of files or columns, each of them once.
    fn names<'a, T: 'a>(
        &mut self,
        kind: &str,
        entries: impl Iterator<Item = (&'a Spanned<T>, &'a str)>,
    ) {
        let mut seen: Vec<&str> = Vec::new();
        for (at, (entry, name)) in entries.enumerate() {
            let field = format!("{kind}[{at}].name");
            if !is_name(name) {
                let what = format!("`{name}` cannot be a name here");
                self.at(entry, &field, what, "give 1 to 40 letters, digits, - and _");
            } else if seen.iter().any(|other| other.eq_ignore_ascii_case(name)) {
                let what = format!("two {kind}s are named `{name}`");
                self.at(entry, &field, what, "name one of them otherwise");
            }
            seen.push(name);
        }
    }
}

/// All faults of a design.
pub(super) fn faults(design: &Design, text: &Text) -> Vec<Fault> {
    let faults = Vec::new();
    let mut checks = Checks { text, faults };
    let (name, consent) = (&design.name, &design.consent);
    let is_word = name.get_ref().bytes().all(|b| b.is_ascii_alphanumeric());
    if !is_word || !(1..=40).contains(&name.get_ref().len()) {
        let what = format!("`{}` cannot be in the name of a file", name.get_ref());
        let remedy = "give 1 to 40 letters and digits without spaces";
        checks.at(name, "name", what, remedy);
    }
    if consent.get_ref().trim().is_empty() {
        let remedy = "say who asks, what is recorded, how long it takes, and that one may stop";
        checks.at(consent, "consent", "nothing to agree to", remedy);
    }
    if design.textures.is_empty() && design.prompts.is_none() {
        let remedy = "add a [[texture]] with a name and a prompt or a file, or [prompts]";
        checks.of("", "a study without textures", remedy);
    }
    if !design.textures.is_empty() && design.attributes.is_empty() {
        let remedy = "add an [[attribute]] with name, question, low and high";
        checks.of("", "textures without an attribute to rate", remedy);
    }
    numbers(design, &mut checks);
    textures(design, &mut checks);
    let attributes = design.attributes.iter();
    checks.names("attribute", attributes.map(|it| (it, &*it.get_ref().name)));
    let forms = design.forms.iter();
    checks.names("form", forms.map(|it| (it, &*it.get_ref().name)));
    checks.faults
}

fn numbers(design: &Design, checks: &mut Checks<'_>) {
    let (ratings, prompts) = (&design.ratings, design.prompts.as_ref());
    checks.within("participants", design.participants, [1, 9999]);
    checks.within("ratings.repeats", ratings.repeats, [1, 100]);
    checks.within("ratings.practice", ratings.practice, [0, 100]);
    checks.within("ratings.catch", ratings.catch_trials, [0, 100]);
    checks.within("prompts.count", prompts.map_or(1, |it| it.count), [1, 100]);
    let refinements = prompts.map_or(0, |it| it.refinements);
    checks.within("prompts.refinements", refinements, [0, 10]);
    checks.within("volume_db", design.volume_db, [-60.0, 0.0]);
    checks.within("explore.seconds", design.explore.seconds, [0.0, 600.0]);
    checks.within("explore.strokes", design.explore.strokes, [0, 100]);
    checks.within("explore.taps", design.explore.taps, [0, 100]);
    checks.within("ratings.break_s", ratings.break_s, [0.0, 3600.0]);
    let Simulate { noise, bias, .. } = design.simulate;
    checks.within("simulate.noise", noise, [0.0, 100.0]);
    checks.within("simulate.bias", bias, [0.0, 100.0]);
    checks.within("simulate.dominance", design.simulate.dominance, [-0.5, 0.5]);
    checks.within("simulate.spread", design.simulate.spread, [0.0, 1.0]);
}

fn textures(design: &Design, checks: &mut Checks<'_>) {
    let names = || design.textures.iter().map(|it| &*it.get_ref().name);
    checks.names("texture", design.textures.iter().zip(names()));
    for (at, entry) in design.textures.iter().enumerate() {
        let field = format!("texture[{at}]");
        let TextureEntry {
            prompt,
            file,
            between,
            t,
            ..
        } = entry.get_ref();
        let sources = [prompt.is_some(), file.is_some(), between.is_some()];
        if sources.into_iter().filter(|is| *is).count() != 1 {
            let remedy = "give one of prompt, file and between";
            checks.at(entry, &field, "not one source of this texture", remedy);
        }
        if !(0.0..=1.0).contains(t) {
            let what = format!("{t} between two textures");
            checks.at(entry, &format!("{field}.t"), what, "give 0 to 1");
        }
        for other in between.iter().flatten() {
            if !names().take(at).any(|name| name == other) {
                let what = format!("no texture `{other}` stands before this one");
                let remedy = "name two textures that stand above it in the file";
                let field = format!("{field}.between");
                let fault = checks.text.fault(entry, field, what, remedy);
                checks
                    .faults
                    .push(fault.suggest(suggestion(other, names())));
            }
        }
    }
    let anchors = design
        .textures
        .iter()
        .filter(|it| it.get_ref().anchor)
        .count();
    if design.midpoints && anchors < 2 {
        let what = format!("midpoints of {anchors} anchors");
        checks.of(
            "midpoints",
            what,
            "set anchor = true for two textures or more",
        );
    }
    let pairs = if design.midpoints {
        anchors * anchors.saturating_sub(1) / 2
    } else {
        0
    };
    let rated = design.textures.len() + pairs;
    let ratings = &design.ratings;
    let all = rated * ratings.repeats.min(1000) + ratings.practice.min(1000);
    if all > MOST_RATINGS {
        let what = format!("{all} ratings a participant");
        checks.of("ratings", what, format!("ask for at most {MOST_RATINGS}"));
    }
    if ratings.catch_trials > rated {
        let what = format!("{} ratings to repeat of {rated}", ratings.catch_trials);
        checks.of("ratings.catch", what, "repeat fewer");
    }
}

fn is_name(name: &str) -> bool {
    let letter = |b: u8| b.is_ascii_alphanumeric() || b == b'-' || b == b'_';
    (1..=40).contains(&name.len()) && name.bytes().all(letter)
}
