//! Latents as a source: a blend, a composition, an edit, a recording that was encoded.

use super::{Edit, EditResult, LatentEditor, Part};
use crate::{
    edit_memory::{History, Ingredient, Latents, Memory, Origin, Step, damaged},
    learned::{Decoded, Latent, LearnedModel, contact, direction, friction, texture},
    pipeline::{Pass, Pipeline, Request, Ringing},
    sources::{
        Source, SourceOutput, Tools,
        prompt::{PromptCompiler, contact_law, split_stroke},
    },
};
use asperity_io::diagnostic::{Failure, Fault};
use asperity_language::phrase::relative;
use asperity_texture::model::{
    ContactLaw, Direction, FrictionLaw, Provenance, TextureModel, shift::adjust,
};

/// A texture that is decoded from latents.
#[derive(Debug, Clone)]
pub struct FromLatents {
    /// The latents.
    pub latents: Latents,
    /// Name of the texture.
    pub name: String,
    /// Where it comes from.
    pub provenance: Provenance,
    /// Creation and edit history.
    pub history: History,
    /// Speed dependence of the friction, which latents do not encode: its factors multiply their μ.
    pub law: Option<FrictionLaw>,
    /// Contact law that it came with: its words and its parts moved it from that of the latents.
    pub contact: Option<OwnContact>,
    /// Direction that it came with.
    pub direction: Option<Direction>,
    /// Warnings for the user.
    pub warnings: Vec<String>,
}

/// A contact law that a texture came with, or that it came without one. It holds while the texture taps as it did.
#[derive(Debug, Clone, PartialEq)]
pub struct OwnContact {
    /// The law.
    pub law: Option<ContactLaw>,
    /// Stiffness of the wall, N/m.
    pub stiffness_n_m: f64,
    /// Latent of the taps.
    pub tap: Latent,
}

impl FromLatents {
    /// Latents of which nothing else is known.
    #[must_use]
    pub fn new(latents: Latents, name: String, provenance: Provenance, history: History) -> Self {
        Self {
            latents,
            name,
            provenance,
            history,
            law: None,
            contact: None,
            direction: None,
            warnings: Vec::new(),
        }
    }

    /// A texture that remembers its latents.
    #[must_use]
    pub fn remembered(texture: TextureModel, memory: Memory) -> Self {
        Self {
            contact: Some(OwnContact {
                law: texture.contact,
                stiffness_n_m: texture.wall.stiffness_n_m,
                tap: memory.latents.tap,
            }),
            law: texture.friction.law,
            direction: texture.direction,
            ..Self::new(
                memory.latents,
                texture.name,
                texture.provenance,
                memory.history,
            )
        }
    }

    /// A texture that the model encoded, of this part.
    #[must_use]
    pub fn encoded(
        texture: TextureModel,
        latents: Latents,
        part: Part,
        provenance: Provenance,
    ) -> Self {
        let history = History::of(Origin::Encode {
            name: texture.name.clone(),
            part: part.name().to_owned(),
        });
        // A law of its own is kept; without one, it has that of the latent.
        let own = texture.contact.map(|law| OwnContact {
            law: Some(law),
            stiffness_n_m: texture.wall.stiffness_n_m,
            tap: latents.tap,
        });
        Self {
            contact: own,
            law: texture.friction.law,
            direction: texture.direction,
            ..Self::new(latents, texture.name, provenance, history)
        }
    }

    /// A texture between two others, `a` at t = 0 and `b` at t = 1. It has no name yet.
    #[must_use]
    pub fn between(a: &Self, b: &Self, t: f64, provenance: Provenance) -> Self {
        let latents = Latents::between(&a.latents, &b.latents, t);
        let history = History::of(Origin::Blend {
            a: a.ingredient(),
            b: b.ingredient(),
            t,
        });
        Self {
            contact: OwnContact::between(a.own_contact(), b.own_contact(), t, &latents),
            law: FrictionLaw::between(a.law.as_ref(), b.law.as_ref(), t),
            direction: direction_between(a.direction, b.direction, t),
            ..Self::new(latents, String::new(), provenance, history)
        }
    }

    /// A texture that taps, slides and rubs like others. It has no name yet.
    #[must_use]
    pub fn composed(tap: &Self, slide: &Self, friction: &Self, provenance: Provenance) -> Self {
        let latents = Latents::composed(&tap.latents, &slide.latents, &friction.latents);
        let history = History::of(Origin::Compose {
            tap: tap.ingredient(),
            slide: slide.ingredient(),
            friction: friction.ingredient(),
        });
        Self {
            contact: tap.contact.clone(),
            law: friction.law.clone(),
            direction: slide.direction,
            ..Self::new(latents, String::new(), provenance, history)
        }
    }

    /// The contact law that it came with, unless an edit changed its taps.
    fn own_contact(&self) -> Option<&OwnContact> {
        let own = self.contact.as_ref();
        own.filter(|own| own.tap == self.latents.tap)
    }

    /// Its contact law: that which it came with, or else that of its latents as the words of its prompt move it.
    fn contact_law(
        &self,
        model: &LearnedModel,
        prompt_compiler: Option<&PromptCompiler>,
    ) -> Option<contact::Choice> {
        let prompt = prompt_compiler.zip(self.provenance.prompt.as_deref());
        let reading = prompt.map(|(compiler, prompt)| compiler.read(prompt));
        let reading = reading.unwrap_or_default();
        let choice = contact_law(&self.latents.tap, model.description(), &reading);
        let Some(own) = self.own_contact() else {
            return choice;
        };
        let named = choice.and_then(|choice| choice.named);
        let law = own.law.clone()?;
        Some(contact::Choice { law, named })
    }

    fn ingredient(&self) -> Ingredient {
        Ingredient::new(&self.name, self.provenance.prompt.as_deref(), &self.latents)
    }

    /// Edits it. Sliders are solved on what an asset of the request keeps.
    ///
    /// # Errors
    /// As [`LatentEditor::edit`].
    pub fn edit(
        &mut self,
        editor: &LatentEditor<'_>,
        edit: &Edit,
        request: &Request,
    ) -> Result<EditResult, Fault> {
        let law = self.moved_law(editor, edit);
        let of_contact_alone = matches!(edit, Edit::Words(text) if relative(text).is_nothing());
        let mut done = if law.is_some() && of_contact_alone {
            EditResult::still(&self.latents)
        } else {
            editor.edit(&self.latents, edit, request)?
        };
        let mut step = Step::new(done.sliders, &self.latents);
        if let Edit::Words(text) = edit {
            step = step.worded(text);
        }
        self.latents = done.latents;
        if let Some([before, after]) = law {
            done.unread.retain(|word| !contact::is_said(word));
            step.contact = Some(before);
            self.contact = Some(self.own(after));
        }
        self.history.steps.push(step);
        if !done.unread.is_empty() {
            let unread = done.unread.join(", ");
            self.warnings.push(format!("not understood: {unread}"));
        }
        Ok(done)
    }

    /// The contact law before and after an edit whose words move it.
    fn moved_law(&self, editor: &LatentEditor<'_>, edit: &Edit) -> Option<[ContactLaw; 2]> {
        let Edit::Words(text) = edit else {
            return None;
        };
        // The words of a likeness say what it becomes like.
        if relative(text).towards.is_some() {
            return None;
        }
        let compiler = editor.prompt_compiler;
        let law = self.contact_law(compiler.model(), Some(compiler))?.law;
        let moved = contact::edited(&law, text)?;
        Some([law, moved])
    }

    /// A law of its own, at its latents.
    fn own(&self, law: ContactLaw) -> OwnContact {
        let before = self.contact.as_ref().map_or(0.0, |own| own.stiffness_n_m);
        OwnContact {
            stiffness_n_m: law.stiffness_n_m().unwrap_or(before),
            law: Some(law),
            tap: self.latents.tap,
        }
    }

    /// Takes the last edit back.
    ///
    /// # Errors
    /// [`Fault`] where there is no edit, or its latents are damaged.
    pub fn undo(&mut self) -> Result<(), Fault> {
        let Some(last) = self.history.steps.pop() else {
            let what = format!("{:?} has no edit to undo", self.name);
            return Err(Fault::new(what, "leave --undo out"));
        };
        let before = last.before();
        self.latents = before
            .ok_or_else(|| damaged(&self.name, "the latents before the last edit are damaged"))?;
        if let Some(law) = last.contact {
            self.contact = Some(self.own(law));
        }
        Ok(())
    }
}

impl Source for FromLatents {
    fn model(
        &self,
        _: &Request,
        tools: &Tools<'_>,
        pipeline: &mut Pipeline,
    ) -> Result<SourceOutput, Failure> {
        let model = tools.model()?;
        let mut texture = pipeline.run(Pass::Decode, || {
            plain(model, &self.latents, &self.name, self.provenance.clone())
        })?;
        let contact = self.contact_law(model, tools.prompt_compiler);
        contact::give(
            &mut texture,
            contact,
            &self.latents.friction,
            model.description(),
        );
        let mu = texture.friction.mu;
        texture.friction.law = self.law.clone().map(|law| law.beside(mu));
        let prompt = self.provenance.prompt.as_deref();
        texture.direction = self.direction;
        let stroke = prompt.and_then(|prompt| split_stroke(prompt).1);
        if let Some(stroke) = stroke.filter(|_| self.direction.is_none()) {
            // What was compiled along the ribs is the same in every direction.
            let (z, description) = (&self.latents.slide, model.description());
            texture.direction = direction::said(z, description, &stroke);
            texture = texture.stroked(stroke.bearing);
        }
        Ok(SourceOutput {
            ringing: Ringing::Stabilised,
            memory: Some(Memory {
                model_crc32: model.crc32(),
                latents: self.latents,
                history: self.history.clone(),
            }),
            certainty: self.history.certainty,
            warnings: self.warnings.clone(),
            ..SourceOutput::new(texture)
        })
    }
}

/// The direction between those of two textures, of which either may have none.
fn direction_between(a: Option<Direction>, b: Option<Direction>, t: f64) -> Option<Direction> {
    if t <= 0.0 || t >= 1.0 {
        return if t <= 0.0 { a } else { b };
    }
    let axis = a.or(b)?.axis;
    let [a, b] = [a, b].map(|direction| direction.unwrap_or(Direction::NONE));
    let between = Direction::mixed([(1.0 - t, &a), (t, &b)].into_iter());
    Some(Direction { axis, ..between })
}

impl OwnContact {
    fn share(&self, weight: f64) -> contact::Share<'_> {
        contact::Share {
            weight,
            law: self.law.as_ref(),
            stiffness_n_m: self.stiffness_n_m,
        }
    }

    /// The law between those of two textures, at these latents; `None` where one is not known.
    fn between(a: Option<&Self>, b: Option<&Self>, t: f64, latents: &Latents) -> Option<Self> {
        let (a, b) = (a?, b?);
        Some(Self {
            law: contact::mixed(&[a.share(1.0 - t), b.share(t)]),
            stiffness_n_m: (1.0 - t) * a.stiffness_n_m + t * b.stiffness_n_m,
            tap: latents.tap,
        })
    }
}

/// The texture of these latents before it is reduced.
///
/// # Errors
/// [`Fault`] when a network fails.
pub fn decode(
    model: &LearnedModel,
    latents: &Latents,
    name: &str,
    provenance: Provenance,
) -> Result<TextureModel, Fault> {
    let mut texture = plain(model, latents, name, provenance)?;
    let description = model.description();
    let law = contact::at(&latents.tap, description);
    contact::give(
        &mut texture,
        law.map(Into::into),
        &latents.friction,
        description,
    );
    texture.direction = direction::at(&latents.slide, description);
    Ok(texture)
}

/// The same without a contact law and a direction.
fn plain(
    model: &LearnedModel,
    latents: &Latents,
    name: &str,
    provenance: Provenance,
) -> Result<TextureModel, Fault> {
    let description = model.description();
    let decoded = Decoded {
        grid: model.decode_grid(&latents.slide)?,
        taps_m_s2: model.decode_taps(&latents.tap)?,
    };
    let name = name.to_owned();
    let (mut texture, _) =
        texture::build(description, &decoded, &latents.friction, name, provenance);
    if latents.tap != latents.friction {
        let near = friction::neighbours(&latents.tap, &description.anchors, description.friction);
        texture.wall.stiffness_n_m = friction::stiffness_n_m(&near, &description.anchors);
    }
    adjust(&mut texture, &latents.shift);
    Ok(texture)
}
