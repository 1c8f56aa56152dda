//! The report of a compiled prompt, as text and as JSON.

use super::Authored;
use serde_json::{Value, json};
use std::fmt::Write as _;

impl Authored {
    /// Whether the prompt is far from anything the model was trained on.
    #[must_use]
    pub fn is_uncertain(&self) -> bool {
        self.unfamiliar
    }

    /// The certainty in a word: `sure` where at least two of three phrases as familiar came out
    /// right, `a guess` where the prompt is unfamiliar, `roughly` between them.
    #[must_use]
    pub fn sureness(&self) -> &'static str {
        if self.unfamiliar {
            "a guess"
        } else if self.certainty < 2.0 / 3.0 {
            "roughly"
        } else {
            "sure"
        }
    }

    /// What a user should be told apart from the result, one line each.
    #[must_use]
    pub fn warnings(&self) -> Vec<String> {
        let mut warnings = Vec::new();
        warnings.extend(self.understood.warning());
        let (read, cut) = self.tokens;
        if cut > 0 {
            warnings.push(format!(
                "the prompt is too long for its encoder: {cut} tokens after the first {read} were not read"
            ));
        }
        if self.is_uncertain() {
            warnings.push(format!(
                "a guess ({:.0} %): the prompt is far from everything the model knows",
                100.0 * self.certainty
            ));
        }
        if self.stabilised > 0.0 {
            warnings.push(format!(
                "the decoded models rang in motion and were moved {:.0} % of the way to white noise",
                100.0 * self.stabilised
            ));
        }
        warnings
    }

    /// The report as text.
    #[must_use]
    pub fn text(&self) -> String {
        let mut text = String::new();
        let mut line = |what: &str, value: String| {
            // Writing to a string cannot fail.
            let _ = writeln!(text, "  {what:<12} {value}");
        };
        let nearest: Vec<String> = self
            .nearest
            .iter()
            .map(|near| format!("{} {:.0} %", near.name, 100.0 * near.weight))
            .collect();
        line("nearest", nearest.join(", "));
        let a = &self.attributes;
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
                "{}: {:.0} % of phrases as familiar came out right",
                self.sureness(),
                100.0 * self.certainty
            ),
        );
        let texture = &self.texture;
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
        line("kept", self.reduction.to_string());
        let preview = self.preview.as_ref().map_or(0, Vec::len);
        line(
            "bytes",
            format!(
                "{} haptic, {preview} preview, {} in all",
                self.lowered.haptic_bytes,
                self.lowered.bytes.len()
            ),
        );
        line(
            "verified",
            format!(
                "stable at {} queries, {} ticks, peak force {:.2} N",
                self.verified.queries, self.verified.ticks, self.verified.peak_force_n
            ),
        );
        let passes: Vec<String> = self
            .timings
            .iter()
            .map(|(pass, took)| format!("{} {:.1}", pass.name(), 1e3 * took.as_secs_f64()))
            .collect();
        line("ms", passes.join(", "));
        text
    }

    /// The report for machines.
    #[must_use]
    pub fn json(&self) -> Value {
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
            "name": self.texture.name,
            "prompt": self.texture.provenance.prompt,
            "seed": self.texture.provenance.seed,
            "nearest": nearest,
            "attributes": self.attributes,
            "certainty": self.certainty,
            "similarity": self.similarity,
            "low_certainty": self.is_uncertain(),
            "tokens": { "read": read, "cut": cut },
            "understood": self.understood.read,
            "not_understood": self.understood.unread,
            "gains": self.texture.gains,
            "wall": self.texture.wall,
            "order": self.texture.grid.order,
            "reduction": self.reduction,
            "z": self.z.to_vec(),
            "bytes": {
                "haptic": self.lowered.haptic_bytes,
                "preview": self.preview.as_ref().map_or(0, Vec::len),
                "total": self.lowered.bytes.len(),
            },
            "verified": {
                "queries": self.verified.queries,
                "ticks": self.verified.ticks,
                "max_db": self.verified.max_db,
                "max_reflection": self.verified.max_reflection,
                "peak_force_n": self.verified.peak_force_n,
            },
            "stages_ms": self.timings.json(),
            "warnings": self.warnings(),
        })
    }
}
