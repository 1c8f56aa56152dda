//! The report of a compiled prompt, as text and as JSON.

use super::{
    CompiledPrompt,
    reading::{Correction, MOST_WORDS},
    understood::excerpt,
};
use crate::{
    compiled::{Compiled, Findings},
    learned::Certainty,
};
use serde_json::{Value, json};
use std::fmt::Write as _;

impl CompiledPrompt {
    /// What a user should be told apart from the result, one line each.
    #[must_use]
    pub fn warnings(&self) -> Vec<String> {
        let mut warnings = Vec::new();
        warnings.extend(self.understood.warning());
        if let Some(Correction { said, taken }) = &self.reading.correction {
            warnings.push(format!("“{said}” is read as “{taken}”"));
        }
        if let Some([first, last]) = self.reading.conflict {
            warnings.push(format!(
                "{first} and {last} cannot both hold: {last} is taken"
            ));
        }
        let (read, cut) = self.tokens;
        if self.reading.cut > 0 {
            warnings.push(format!(
                "the prompt is too long: {} words after the first {MOST_WORDS} were not read",
                self.reading.cut
            ));
        } else if cut > 0 {
            warnings.push(format!(
                "the prompt is too long for its encoder: {cut} tokens after the first {read} were not read"
            ));
        }
        if self.certainty == Certainty::Guess {
            warnings.push(match self.reading.says {
                true => "a guess: the prompt is far from everything the model knows".into(),
                false => {
                    "a guess: nothing in the prompt names something, or says how it feels".into()
                }
            });
        }
        warnings
    }
}

impl Findings for CompiledPrompt {
    fn text(&self, compiled: &Compiled) -> String {
        let mut text = String::new();
        let mut line = |what: &str, value: String| {
            // Writing to a string cannot fail.
            let _ = writeln!(text, "  {what:<12} {value}");
        };
        line("taken as", excerpt(self.reading.text()));
        if !self.reading.ignored.is_empty() {
            line("left out", excerpt(self.reading.ignored.join(", ")));
        }
        let nearest: Vec<String> = self
            .nearest
            .iter()
            // What rounds to nothing says nothing.
            .filter(|near| near.weight >= 0.005)
            .map(|near| format!("{} {:.0} %", near.name, 100.0 * near.weight))
            .collect();
        line("nearest", nearest.join(", "));
        let a = compiled.attributes();
        let number = |value: Option<f64>, unit: &str| {
            value.map_or("none".into(), |value| format!("{value:.1} {unit}"))
        };
        line(
            "attributes",
            format!(
                "rough {}, sharp {}, hard {}, μ {:.3}",
                number(a.rough_db, "dB"),
                number(a.sharp_hz, "Hz"),
                number(a.hard_hz, "Hz"),
                a.mu
            ),
        );
        line(
            "certainty",
            format!(
                "{}: {:.0} % of comparisons with such prompts came out right",
                self.certainty,
                100.0 * self.certainty.share()
            ),
        );
        let texture = &compiled.texture;
        line(
            "gains",
            format!(
                "vibration {:.5} s²/m of {:.2} N, effective mass {:.3} kg, wall {:.0} N/m",
                texture.gains.vib_s2_m,
                texture.gains.f_max_n,
                texture.gains.effective_mass_kg,
                texture.wall.stiffness_n_m
            ),
        );
        line(
            "model",
            format!(
                "AR order {}, {} vertices, {:.0} Hz",
                texture.grid.order,
                texture.grid.vertices.len(),
                texture.grid.sample_rate_hz
            ),
        );
        line("kept", compiled.reduction.to_string());
        let preview = compiled.preview.as_ref().map_or(0, Vec::len);
        line(
            "bytes",
            format!(
                "{} haptic, {preview} preview, {} in all",
                compiled.lowered.haptic_bytes,
                compiled.lowered.bytes.len()
            ),
        );
        if let Some(verified) = &compiled.verified {
            line(
                "verified",
                format!(
                    "stable at {} queries, {} ticks, peak force {:.2} N",
                    verified.queries, verified.ticks, verified.peak_force_n
                ),
            );
        }
        let passes: Vec<String> = compiled
            .timings
            .iter()
            .map(|(pass, took)| format!("{} {:.1}", pass.name(), 1e3 * took.as_secs_f64()))
            .collect();
        line("ms", passes.join(", "));
        text
    }

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
            "low_certainty": self.certainty == Certainty::Guess,
            "tokens": { "read": read, "cut": cut },
            "taken_as": self.reading.text(),
            "named": self.reading.names,
            "left_out": self.reading.ignored,
            "corrected": self.reading.correction.as_ref().map(|c| json!({ "said": c.said, "taken": c.taken })),
            "understood": self.understood.read,
            "not_understood": self.understood.unread,
            "gains": compiled.texture.gains,
            "wall": compiled.texture.wall,
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
