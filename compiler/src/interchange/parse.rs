//! Reading effects of strangers: JSON by its path, and numbers within their ranges.

use super::playback::Track;
use crate::json::parsed;
use asperity_io::{diagnostic::Fault, input};
use serde::de::DeserializeOwned;

/// The latest time of an effect, s.
pub(super) const MAX_S: f64 = 600.0;
/// All tones and curves together, s.
const MAX_PLAYED_S: f64 = 1200.0;
/// Most transients.
const MAX_TRANSIENTS: usize = 4096;
/// Remedy for what is not JSON, or a field that is missing or of another type.
pub(super) const WRONG_JSON: &str =
    "correct this place of the file, or export it again from its tool";

/// JSON as a type, or the path of what is not of it. A comma behind the last entry of a list or an object is
/// let pass, because Apple's own samples have some.
pub(super) fn json<T: DeserializeOwned>(text: &str) -> Result<T, Fault> {
    parsed(&input::lenient_json(text), WRONG_JSON)
}

/// A number within a range.
pub(super) fn within(
    field: impl FnOnce() -> String,
    value: f64,
    low: f64,
    high: f64,
) -> Result<f64, Fault> {
    if (low..=high).contains(&value) {
        return Ok(value);
    }
    let what = format!("{value}, must be {low} to {high}");
    Err(Fault::new(what, "correct the value").field(field()))
}

/// A time, s, not before the one before it.
pub(super) fn time(field: impl Fn() -> String, value: f64, previous: f64) -> Result<f64, Fault> {
    let value = within(&field, value, 0.0, MAX_S)?;
    if value < previous {
        let what = format!("{value} s lies before {previous} s, the time of the point before it");
        return Err(Fault::new(what, "correct the value").field(field()));
    }
    Ok(value)
}

/// Returns the fault of a file that holds more of something than is read.
pub(super) fn too_many(what: &str, found: f64, limit: f64) -> Fault {
    let what = format!("{found} {what}, at most {limit} are read");
    Fault::new(what, "cut the file into shorter effects")
}

/// A track that is played in bounded time, with its transients in order.
pub(super) fn bounded(mut track: Track) -> Result<Track, Fault> {
    let spans = |first: Option<f64>, last: Option<f64>| last.unwrap_or(0.0) - first.unwrap_or(0.0);
    let tones = track.tones.iter();
    let tones = tones.map(|t| spans(t.first().map(|p| p.t_s), t.last().map(|p| p.t_s)));
    let curves = track.curves.iter();
    let curves = curves.map(|c| spans(c.first().map(|p| p.t_s), c.last().map(|p| p.t_s)));
    let played_s: f64 = tones.chain(curves).sum();
    if played_s > MAX_PLAYED_S {
        let what = "seconds of continuous effects in all";
        return Err(too_many(what, played_s, MAX_PLAYED_S));
    }
    let count = track.transients.len();
    if count > MAX_TRANSIENTS {
        let limit = MAX_TRANSIENTS as f64;
        return Err(too_many("transients", count as f64, limit));
    }
    track.transients.sort_by(|a, b| a.t_s.total_cmp(&b.t_s));
    Ok(track)
}

#[cfg(test)]
mod tests {
    use super::*;
    use serde_json::Value;

    #[test]
    fn a_comma_behind_the_last_entry_passes_and_every_other_does_not() {
        for (text, plain) in [
            ("[1,]", "[1 ]"),
            ("{\"a\": [1, 2 , \n ] , }", "{\"a\": [1, 2   \n ]   }"),
            ("[\"a,]\", \"\\\"\",]", "[\"a,]\", \"\\\"\" ]"),
            ("[\"\\\\\",]", "[\"\\\\\" ]"),
            ("[\"é\",]", "[\"é\" ]"),
        ] {
            assert_eq!(input::lenient_json(text), plain);
            let read: Value = json(text).unwrap();
            assert_eq!(read, serde_json::from_str::<Value>(plain).unwrap());
        }
        for text in ["[,]", "{,}", "[1,,]", "[1,,2]", "{\"a\":,}", "[1],", "[,1]"] {
            assert!(json::<Value>(text).is_err(), "{text}");
        }
    }

    #[test]
    fn a_fault_behind_a_comma_is_at_its_own_place_and_in_its_object() {
        let text = "{\"a\": [1,],\n\"b\": {\"c\": {\"d\": 1 \"e\": 2}}}";
        let fault = json::<Value>(text).unwrap_err();
        assert_eq!(fault.field, "b.c");
        assert!(fault.what.ends_with("line 2 column 20"), "{fault}");
    }
}
