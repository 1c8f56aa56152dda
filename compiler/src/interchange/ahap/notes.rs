//! Deviations from a file in reading it, a line per kind: the first place, and the count.

use std::collections::BTreeMap;

/// Kinds of one list that are named; there may be as many as a stranger thinks of.
const NAMED: usize = 6;
/// Characters of a stranger's text that are repeated.
const QUOTED: usize = 40;

/// Kind of deviation.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub(super) enum Note {
    Version,
    NoContent,
    NoTime,
    NoLevel,
    Clamped,
    Endless,
    TooLong,
    FromTheBeginning,
    Unsorted,
}

impl Note {
    const fn words(self) -> &'static str {
        match self {
            Self::Version => "a version other than 1: read as version 1",
            Self::NoContent => "neither Event, Parameter nor ParameterCurve: left out",
            Self::NoTime => "no Time: read as 0 s",
            Self::NoLevel => {
                "no HapticIntensity or no HapticSharpness, for which Apple states no default: read as 0.5"
            }
            Self::Clamped => "outside its range: clamped, as Core Haptics does",
            Self::Endless => {
                "no EventDuration, so that Core Haptics plays it without an end: read as 30 s"
            }
            Self::TooLong => "more than 30 s, the most of a continuous event: cut there",
            Self::FromTheBeginning => {
                "its first point has the time of the curve: times are counted from the beginning of \
                 the pattern, as haptic2ahap writes them"
            }
            Self::Unsorted => "points out of order: sorted by time",
        }
    }
}

/// Places of one kind.
#[derive(Debug)]
struct Places {
    first: String,
    count: usize,
}

/// All that is read otherwise.
#[derive(Debug, Default)]
pub(super) struct Notes {
    notes: BTreeMap<Note, Places>,
    events: BTreeMap<String, Places>,
    envelopes: BTreeMap<String, Places>,
    parameters: BTreeMap<String, Places>,
    controls: BTreeMap<String, Places>,
    /// Parameters and curves whose end another one cuts.
    pub(super) cut: usize,
}

impl Notes {
    /// Notes one place.
    pub(super) fn add(&mut self, note: Note, place: impl FnOnce() -> String) {
        count(&mut self.notes, note, place);
    }

    /// An event of a type that is left out.
    pub(super) fn event(&mut self, kind: &str, place: impl FnOnce() -> String) {
        count(&mut self.events, shortened(kind), place);
    }

    /// A parameter of an event's envelope.
    pub(super) fn envelope(&mut self, id: &str, place: impl FnOnce() -> String) {
        count(&mut self.envelopes, id.to_owned(), place);
    }

    /// Another parameter of an event that has no effect.
    pub(super) fn parameter(&mut self, id: &str, place: impl FnOnce() -> String) {
        count(&mut self.parameters, shortened(id), place);
    }

    /// A control that has no effect.
    pub(super) fn control(&mut self, id: &str, place: impl FnOnce() -> String) {
        count(&mut self.controls, shortened(id), place);
    }

    /// The lines.
    pub(super) fn lines(self) -> Vec<String> {
        let mut lines = Vec::new();
        let lists = [
            (
                &self.events,
                "events left out, which are neither HapticContinuous nor HapticTransient",
            ),
            (
                &self.envelopes,
                "envelopes are not honoured, because Apple states no times for them; events sound at full level \
                 from beginning to end",
            ),
            (&self.parameters, "event parameters that are not honoured"),
            (&self.controls, "controls that are not honoured"),
        ];
        for (list, words) in lists {
            if !list.is_empty() {
                lines.push(format!("{words}: {}", listed(list)));
            }
        }
        for (note, places) in &self.notes {
            let more = match places.count {
                1 => String::new(),
                count => format!(" (and {} more places)", count - 1),
            };
            lines.push(format!("{}{more}: {}", places.first, note.words()));
        }
        if self.cut > 0 {
            lines.push(format!(
                "{} curves are cut where a later parameter or curve of the same control begins",
                self.cut
            ));
        }
        lines
    }
}

fn count<K: Ord>(list: &mut BTreeMap<K, Places>, key: K, place: impl FnOnce() -> String) {
    if let Some(places) = list.get_mut(&key) {
        places.count += 1;
    } else {
        let first = place();
        list.insert(key, Places { first, count: 1 });
    }
}

/// "1 AudioCustom (Pattern[0].Event), 2 …".
fn listed(list: &BTreeMap<String, Places>) -> String {
    let named = list.iter().take(NAMED).map(|(name, places)| {
        let name = if name.is_empty() {
            "without a name"
        } else {
            name
        };
        format!("{} {name} ({})", places.count, places.first)
    });
    let mut text = named.collect::<Vec<_>>().join(", ");
    if list.len() > NAMED {
        text.push_str(&format!(" and {} other names", list.len() - NAMED));
    }
    text
}

/// A stranger's text, short and without control characters.
fn shortened(text: &str) -> String {
    let plain = text
        .chars()
        .map(|c| if c.is_control() { '\u{fffd}' } else { c });
    let mut short: String = plain.take(QUOTED).collect();
    if text.chars().nth(QUOTED).is_some() {
        short.push('…');
    }
    short
}

/// A stranger's text in quotation marks.
pub(super) fn quoted(text: &str) -> String {
    format!("{:?}", shortened(text))
}
