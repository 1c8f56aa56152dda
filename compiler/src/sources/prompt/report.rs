//! The report of a compiled prompt, as text and as JSON.

use super::{CompiledPrompt, readable::excerpt, reading::Correction};
use crate::{
    compiled::{Compiled, Findings},
    edit_memory::Axis,
    learned::Certainty,
    sources::latents::Scale,
};
use asperity_io::shown::{rounded, size};
use serde_json::{Value, json};
use std::fmt::Write as _;

impl CompiledPrompt {
    /// Returns the warnings for the user, one line each.
    #[must_use]
    pub fn warnings(&self) -> Vec<String> {
        let mut warnings = Vec::new();
        warnings.extend(self.understood.warning());
        if let Some(Correction {
            said, corrected, ..
        }) = &self.reading.correction
        {
            warnings.push(format!("“{said}” is read as “{corrected}”"));
        }
        if let Some(bearing) = self.bearing.filter(|_| self.direction.is_none()) {
            warnings.push(format!(
                "“{}” feels the same in every direction: {bearing} changes nothing",
                self.reading.text()
            ));
        }
        warnings.extend(self.reading.numbers.iter().cloned());
        if let Some([first, last]) = self.reading.conflict {
            warnings.push(format!(
                "{first} and {last} cannot both hold: {last} is taken"
            ));
        }
        let (read, cut) = self.tokens;
        if self.reading.cut > 0 {
            warnings.push(format!(
                "the prompt is too long: its last {} words were not read",
                self.reading.cut
            ));
        } else if cut > 0 {
            warnings.push(format!(
                "the prompt is too long for its encoder: {cut} tokens after the first {read} were not read"
            ));
        }
        if self.certainty == Certainty::NoContact {
            warnings.push(
                "nothing in the prompt is touched: what its words lie near to is compiled".into(),
            );
        }
        if self.certainty == Certainty::Guess {
            let doubtful = self.reading.correction.as_ref().filter(|c| c.doubtful);
            warnings.push(match doubtful {
                Some(Correction { said, .. }) => {
                    format!(
                        "a guess: “{said}” may be another word; describe the surface in English"
                    )
                }
                None if self.reading.says => {
                    "a guess: the prompt is far from everything the model knows".into()
                }
                None => {
                    "a guess: nothing in the prompt names something, or says how it feels".into()
                }
            });
        }
        warnings
    }
}

/// The longest list of nearest materials for people.
const NAMED: usize = 3;

impl CompiledPrompt {
    /// Summarises a texture for a designer: the interpretation of the words, the feel on the scales of the sliders, the
    /// certainty.
    #[must_use]
    pub fn summary(&self, compiled: &Compiled, scale: &Scale) -> String {
        let mut lines = Lines::default();
        lines.add("taken as", excerpt(self.reading.text()));
        if let Some(bearing) = self.bearing.filter(|_| self.direction.is_some()) {
            lines.add("stroked", bearing.to_string());
        } else if let Some(direction) = &compiled.texture.direction {
            lines.add("direction", direction.to_string());
        }
        if !self.reading.ignored.is_empty() {
            lines.add("left out", excerpt(self.reading.ignored.join(", ")));
        }
        lines.add("feels like", self.materials());
        let attributes = compiled.attributes();
        for axis in [Axis::Rough, Axis::Slippery, Axis::Hard] {
            let place = scale.place(axis, &attributes);
            lines.add(axis.name(), place.map_or("undefined".into(), on_slider));
        }
        lines.add(
            "certainty",
            format!(
                "{} ({:.0} % of sentences at this level feel like what they say is touched)",
                self.certainty,
                100.0 * self.certainty.share()
            ),
        );
        let haptic = size(compiled.lowered.haptic_bytes as u64);
        let all = size(compiled.lowered.bytes.len() as u64);
        lines.add(
            "size",
            match &compiled.preview {
                Some(_) => format!("{haptic} haptic, {all} with the preview"),
                None => format!("{haptic} haptic, {all} in total"),
            },
        );
        lines.0
    }

    /// The nearest materials with their weights; what rounds to nothing says nothing.
    fn materials(&self) -> String {
        let nearest = self.nearest.iter().filter(|near| near.weight >= 0.005);
        let nearest: Vec<String> = nearest
            .take(NAMED)
            .map(|near| format!("{} {:.0} %", near.name, 100.0 * near.weight))
            .collect();
        nearest.join(", ")
    }
}

/// A place on a slider, which ends at 0 and 100 where materials go further.
fn on_slider(place: f64) -> String {
    let place = rounded(place, 0);
    let beyond = if (0.0..=100.0).contains(&place) {
        ""
    } else {
        ", beyond the slider"
    };
    format!("{place:>3} of 100{beyond}")
}

/// Lines of a report, each with its name.
#[derive(Default)]
struct Lines(String);

impl Lines {
    fn add(&mut self, what: &str, value: String) {
        // Writing to a string cannot fail.
        let _ = writeln!(self.0, "  {what:<12} {value}");
    }
}

impl Findings for CompiledPrompt {
    fn json(&self, compiled: &Compiled) -> Value {
        let nearest: Vec<Value> = self
            .nearest
            .iter()
            .map(|near| {
                json!({
                    "name": near.name,
                    "family": near.family,
                    "mu": near.mu,
                    "weight": near.weight,
                })
            })
            .collect();
        let (read, cut) = self.tokens;
        json!({
            "name": compiled.texture.name,
            "prompt": compiled.texture.provenance.prompt,
            "seed": compiled.texture.provenance.seed,
            "nearest": nearest,
            "attributes": compiled.attributes(),
            "certainty": self.certainty.share(),
            "certainty_level": self.certainty,
            "similarity": self.similarity,
            "low_certainty": self.certainty <= Certainty::Guess,
            "tokens": { "read": read, "cut": cut },
            "taken_as": self.reading.text(),
            "named": self.reading.names,
            "left_out": self.reading.ignored,
            "corrected": self.reading.correction.as_ref().map(|c| json!({ "said": c.said, "taken": c.corrected })),
            "understood": self.understood.read,
            "not_understood": self.understood.unread,
            "gains": compiled.texture.gains,
            "wall": compiled.texture.wall,
            "stroked": self.bearing.filter(|_| self.direction.is_some()).map(|bearing| bearing.to_string()),
            "direction": compiled.texture.direction,
            "order": compiled.texture.grid.order,
            "reduction": compiled.reduction,
            "z": self.z.to_vec(),
            "bytes": {
                "haptic": compiled.lowered.haptic_bytes,
                "preview": compiled.preview.as_ref().map_or(0, Vec::len),
                "total": compiled.lowered.bytes.len(),
            },
            "verified": compiled.verified,
            "stages_ms": compiled.timings.json(),
            "warnings": compiled.warnings,
        })
    }
}

#[cfg(test)]
mod tests {
    use super::on_slider;

    #[test]
    fn a_place_beyond_the_slider_is_explained() {
        assert_eq!(on_slider(-0.3), "  0 of 100");
        assert_eq!(on_slider(94.6), " 95 of 100");
        assert_eq!(on_slider(100.4), "100 of 100");
        assert_eq!(on_slider(130.7), "131 of 100, beyond the slider");
        assert_eq!(on_slider(-7.0), " -7 of 100, beyond the slider");
    }
}
