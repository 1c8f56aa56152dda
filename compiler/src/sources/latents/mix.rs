//! Whatever mixes or edits textures: their latents, how the result is compiled, and what to report of it.

use super::{
    Edit, LatentEditor, Part, Sliders, attributes_line, encode::encode, fault::nothing_asked,
    source::FromLatents,
};
use crate::{
    compiled::Compiled,
    edit_memory::{AXES, Axis},
    emit::raise::raise,
    passes::reduce::Fidelity,
    pipeline::Request,
    views::preview,
};
use asperity_formats::{Asset, limits::MAX_NAME_BYTES};
use asperity_io::{
    diagnostic::Fault,
    shown::{rounded, shortened},
};
use asperity_texture::model::{
    Provenance,
    attributes::{self, Attributes},
};
use serde_json::{Map, Value, json};

/// Steps by which an attribute may miss its target before the user is warned.
const NEAR: f64 = 3.0;

/// Options of a mixture besides its ingredients.
#[derive(Debug, Clone, PartialEq, Eq, Default)]
pub struct MixOptions {
    /// Its name; one that names the ingredients if `None`.
    pub name: Option<String>,
    /// Its preview.
    pub preview: MixPreview,
}

/// The preview of a mixture.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum MixPreview {
    /// As large as that of the texture that is kept.
    #[default]
    Kept,
    /// None.
    None,
    /// This many pixels wide and high.
    Size(u32),
}

/// A mixture before it is compiled. The [driver](crate::driver) takes its source with its request.
#[derive(Debug, Clone)]
pub struct Mix {
    /// The latents.
    pub source: FromLatents,
    /// As the texture that is kept was compiled.
    pub request: Request,
    /// Additional lines of the report.
    lines: Vec<(&'static str, String)>,
    more: Value,
    edited: Option<Edited>,
}

/// Reference for the result of an edit.
#[derive(Debug, Clone)]
struct Edited {
    before: Attributes,
    asked: Option<Sliders>,
}

/// Report on a mixture.
#[derive(Debug, Clone)]
pub struct MixReport {
    /// For machines.
    pub json: Value,
    /// For people: a name and its value in each.
    pub lines: Vec<(&'static str, String)>,
    /// Warnings for the user besides those of the texture.
    pub warnings: Vec<String>,
}

impl MixPreview {
    /// The size, where the kept texture has this one.
    fn px(self, kept: Option<u32>) -> Option<u32> {
        match self {
            Self::Kept => kept,
            Self::None => None,
            Self::Size(px) => Some(px),
        }
    }
}

impl MixOptions {
    /// The name that a user gave, or else this one, shortened to what an asset can hold.
    fn name(&self, otherwise: &str) -> String {
        let name = self.name.as_deref().unwrap_or(otherwise);
        shortened(name, MAX_NAME_BYTES).trim_end().to_owned()
    }

    /// As the texture was compiled that is kept, with a preview unless it is unwanted.
    fn request(&self, editor: &LatentEditor<'_>, kept: &Asset<'_>) -> Request {
        let request = editor.request(kept);
        Request {
            preview_px: self.preview.px(request.preview_px.or(Some(preview::SIZE))),
            ..request
        }
    }
}

impl LatentEditor<'_> {
    /// A texture between two others, `a` at t = 0 and `b` at t = 1, with the fidelity and the rate of `a`.
    ///
    /// # Errors
    /// As [`remembered`](Self::remembered).
    pub fn blend(
        &self,
        a: &Asset<'_>,
        b: &Asset<'_>,
        t: f64,
        options: &MixOptions,
    ) -> Result<Mix, Fault> {
        let (from, to) = (self.remembered(a)?, self.remembered(b)?);
        let provenance = self.prompt_compiler.model().provenance("blend");
        let mut source = FromLatents::between(&from, &to, t, provenance);
        source.name = options.name(&format!("{} – {}", from.name, to.name));
        let line = format!("{:?} and {:?} at t = {t}", from.name, to.name);
        Ok(Mix {
            source,
            request: options.request(self, a),
            lines: vec![("between", line)],
            more: json!({ "blend": { "a": from.name, "b": to.name, "t": t } }),
            edited: None,
        })
    }

    /// A texture that taps, slides and rubs like others, with the fidelity and the rate of `slide`, which gives the
    /// friction if no other does.
    ///
    /// # Errors
    /// As [`remembered`](Self::remembered).
    pub fn compose(
        &self,
        tap: &Asset<'_>,
        slide: &Asset<'_>,
        friction: Option<&Asset<'_>>,
        options: &MixOptions,
    ) -> Result<Mix, Fault> {
        let request = options.request(self, slide);
        let friction = self.remembered(friction.unwrap_or(slide))?;
        let (tap, slide) = (self.remembered(tap)?, self.remembered(slide)?);
        let provenance = self.prompt_compiler.model().provenance("compose");
        let mut source = FromLatents::composed(&tap, &slide, &friction, provenance);
        source.name = options.name(&format!("{} tapped, {} slid", tap.name, slide.name));
        let line = format!(
            "taps of {:?}, slides of {:?}, friction of {:?}",
            tap.name, slide.name, friction.name
        );
        let names = json!({ "tap": tap.name, "slide": slide.name, "friction": friction.name });
        Ok(Mix {
            source,
            request,
            lines: vec![("parts", line)],
            more: json!({ "compose": names }),
            edited: None,
        })
    }

    /// A texture after an edit, or with its last edit taken back where there is none.
    ///
    /// # Errors
    /// As [`edit`](Self::edit) and [`FromLatents::undo`]; a usage error for an edit that moves nothing.
    pub fn change(
        &self,
        asset: &Asset<'_>,
        edit: Option<&Edit>,
        options: &MixOptions,
    ) -> Result<Mix, Fault> {
        if edit.is_some_and(Edit::is_still) {
            return Err(nothing_asked());
        }
        let mut source = self.remembered(asset)?;
        // In the way that the asset was, with its name and provenance.
        let request = self.request(asset);
        let request = Request {
            preview_px: options.preview.px(request.preview_px),
            ..request
        };
        let (mut asked, mut towards) = (None, None);
        match edit {
            None => source.undo()?,
            Some(edit) => {
                let done = source.edit(self, edit, &request)?;
                // A blend towards a material moves every attribute: no target is compared.
                asked = done.towards.is_none().then_some(done.sliders);
                towards = done.towards;
            }
        }
        source.name = options.name(asset.name());
        let request = Request {
            loudness_db: source.history.loudness_db,
            ..request
        };
        let line = towards.map(|towards| {
            let share = 100.0 * towards.share;
            let line = format!("{share:.0} % of the way to {:?}", towards.thing);
            ("towards", line)
        });
        let prompt = match edit {
            Some(Edit::Words(words)) => Some(words),
            _ => None,
        };
        Ok(Mix {
            source,
            request,
            lines: line.into_iter().collect(),
            more: json!({ "undone": edit.is_none(), "prompt": prompt }),
            edited: Some(Edited {
                before: attributes::of(&raise(asset)),
                asked,
            }),
        })
    }

    /// A texture decoded from the latent of a recording, or of a part of it: by default of what was recorded.
    ///
    /// # Errors
    /// As [`encode`].
    pub fn encoded(
        &self,
        asset: &Asset<'_>,
        part: Option<Part>,
        options: &MixOptions,
    ) -> Result<Mix, Fault> {
        let texture = raise(asset);
        let part = part.unwrap_or_else(|| Part::recorded(&texture));
        let encoded = encode(self, &texture, part)?;
        // A recording is kept in full; what is decoded is as compact as a prompt's texture.
        let request = Request {
            fidelity: Fidelity::Auto,
            ..options.request(self, asset)
        };
        let provenance = Provenance {
            prompt: texture.provenance.prompt.clone(),
            ..self.prompt_compiler.model().provenance("encode")
        };
        let mut distance = match encoded.distance_db {
            Some((p95, worst)) => {
                format!("{p95:.1} dB at 95 % of the grid, {worst:.1} dB at worst")
            }
            None => "not measured".into(),
        };
        let silent = encoded.silent_places;
        if silent > 0 {
            distance += &format!("; at {silent} more only one of the two sounds");
        }
        let more = json!({
            "part": part.name(),
            "z": encoded.latents.slide.to_vec(),
            "distance_db": encoded.distance_db.map(|(p95, worst)| [p95, worst]),
            "silent_places": silent,
        });
        let mut source = FromLatents::encoded(texture, encoded.latents, part, provenance);
        source.name = options.name(asset.name());
        let part = part.name().to_owned();
        Ok(Mix {
            source,
            request,
            lines: vec![("encoded", part), ("distance", distance)],
            more,
            edited: None,
        })
    }
}

impl Mix {
    /// Returns the report once it is compiled.
    #[must_use]
    pub fn report(mut self, editor: &LatentEditor<'_>, compiled: &Compiled) -> MixReport {
        let attributes = compiled.attributes();
        let mut warnings = Vec::new();
        if let Some(edited) = &self.edited {
            let moved = AXES.map(|axis| (axis, edited.moved(editor, axis, &attributes)));
            warnings = edited.missed(&moved);
            let before = attributes_line(&edited.before, editor.scale());
            let line = moved.map(|(axis, by)| format!("{} {:+.1}", axis.name(), rounded(by, 1)));
            self.lines.push(("before", before));
            self.lines.push(("moved", line.join(", ")));
            let by: Map<String, Value> = moved
                .into_iter()
                .map(|(axis, by)| (axis.name().to_owned(), json!(by)))
                .collect();
            self.more["moved"] = Value::Object(by);
        }
        let place = |axis: Axis| {
            let place = editor.scale().place(axis, &attributes);
            (axis.name().to_owned(), json!(place))
        };
        let bytes = (compiled.lowered.haptic_bytes, compiled.lowered.bytes.len());
        let all: Vec<&String> = compiled.warnings.iter().chain(&warnings).collect();
        let mut json = json!({
            "name": compiled.texture.name,
            "attributes": attributes,
            "sliders": AXES.into_iter().map(place).collect::<Map<_, _>>(),
            "gains": compiled.texture.gains,
            "bytes": { "haptic": bytes.0, "total": bytes.1 },
            "stages_ms": compiled.timings.json(),
            "warnings": all,
        });
        if let (Value::Object(json), Value::Object(more)) = (&mut json, self.more) {
            json.extend(more);
        }
        let sliders = attributes_line(&attributes, editor.scale());
        self.lines.push(("sliders", sliders));
        MixReport {
            json,
            lines: self.lines,
            warnings,
        }
    }
}

impl Edited {
    /// Steps that an attribute moved.
    fn moved(&self, editor: &LatentEditor<'_>, axis: Axis, after: &Attributes) -> f64 {
        let place = |attributes| editor.scale().place(axis, attributes).unwrap_or(0.0);
        place(after) - place(&self.before)
    }

    /// A warning for each attribute that ended far from where it was asked to.
    fn missed(&self, moved: &[(Axis, f64); 4]) -> Vec<String> {
        let Some(asked) = &self.asked else {
            return Vec::new();
        };
        let far = moved.iter().filter_map(|&(axis, by)| {
            let (name, asked) = (axis.name(), asked.along(axis));
            ((by - asked).abs() > NEAR).then(|| {
                format!(
                    "{name} moved by {by:+.0} of {asked:+.0} steps, the nearest that was found from here"
                )
            })
        });
        far.collect()
    }
}
