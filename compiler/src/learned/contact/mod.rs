//! Contact laws of named materials, or from the neighbours of a latent, as friction has them, moved by the words of a
//! prompt.

mod mix;
mod names;
mod table;
mod words;

use mix::ALONE;
pub use mix::{Share, mixed};
pub use table::{Material, materials};
pub use words::is_said;

use super::{
    description::{Anchor, ModelDescription},
    friction,
};
use asperity_language::reading::{Reading, normalise};
use asperity_model::CONTACT_LAWS;
use asperity_texture::model::{ContactLaw, FrictionAnchor, TextureModel};

/// Least distance of a neighbour, 1 − cosine: what is nearer is the material itself.
const NEAREST: f64 = 1e-9;
/// Cosine from which a latent is close to a material: those of a boiled sweet and of slime are further apart.
pub(super) const CLOSE: f64 = 0.75;
/// Part of μ by which a film changes it at least.
const LEAST_SLIDE: f64 = 1e-3;

/// The weights of friction over the distance 1 − cosine: the latent of a material has its law alone.
pub(super) fn shares<'a>(z: &[f32], description: &'a ModelDescription) -> Vec<(f64, &'a Anchor)> {
    let near = friction::neighbours(z, &description.anchors, description.friction);
    let weight = |near: &friction::Neighbour| near.weight / (1.0 - near.cosine).max(NEAREST);
    let sum: f64 = near.iter().map(weight).sum();
    let anchors = near.iter();
    anchors
        .map(|near| (weight(near) / sum, &description.anchors[near.index]))
        .collect()
}

/// The contact law at a latent; `None` where most of its neighbours, by weight, do not give way, and far from all that do.
#[must_use]
pub fn at(z: &[f32], description: &ModelDescription) -> Option<ContactLaw> {
    let shares = shares(z, description);
    let close = |(_, anchor): &(f64, &Anchor)| {
        table::material(&anchor.name).is_some() && friction::cosine(z, &anchor.z) >= CLOSE
    };
    if !shares.iter().any(close) {
        return None;
    }
    let share = |&(weight, anchor): &(f64, &Anchor)| Share {
        weight,
        law: table::material(&anchor.name).map(|material| &material.law),
        stiffness_n_m: anchor.stiffness_n_m,
    };
    mixed(&shares.iter().map(share).collect::<Vec<_>>())
}

/// The contact law of a text, and the material that it names.
#[derive(Debug, Clone, PartialEq)]
pub struct Choice {
    /// The law.
    pub law: ContactLaw,
    /// Whose law it is, by name; `None` for a mixture of those near a latent.
    pub named: Option<&'static Material>,
}

impl From<ContactLaw> for Choice {
    fn from(law: ContactLaw) -> Self {
        Self { law, named: None }
    }
}

/// The contact law of a text: that of the material that it names, or else that of the latent's neighbours, as its words
/// move it. A latent at another material is surer than the last words of a longer name. `text` is what the reading names,
/// with some of its words.
#[must_use]
pub fn of(
    z: &[f32],
    description: &ModelDescription,
    text: &str,
    reading: &Reading,
) -> Option<Choice> {
    let shares = shares(z, description);
    let at = shares.iter().find(|(weight, _)| *weight > ALONE);
    let other = |material: &Material| at.is_some_and(|(_, anchor)| anchor.name != material.name);
    let named = names::named(text);
    if named.as_ref().is_some_and(|named| !named.gives_way()) {
        return None;
    }
    let sure = named.filter(|named| named.alone || !other(named.material));
    let Some(named) = sure else {
        let law = self::at(z, description)?;
        let words = reading.words.iter();
        // A name says nothing about itself.
        let words = words.map(|word| {
            if reading.names.contains(word) {
                ""
            } else {
                word
            }
        });
        return Some(words::worded(law, &words.collect::<Vec<_>>()).into());
    };
    Some(Choice {
        law: words::worded(named.material.law.clone(), &named.others),
        named: Some(named.material),
    })
}

/// A law as the words of an edit move it, "stickier, less springy"; `None` where they leave it as it is.
#[must_use]
pub fn edited(law: &ContactLaw, text: &str) -> Option<ContactLaw> {
    let tokens = normalise(text);
    let words = tokens.iter().map(|token| token.word().unwrap_or_default());
    let edited = words::worded(law.clone(), &words.collect::<Vec<_>>());
    (edited != *law).then_some(edited)
}

/// Takes the film that carries a load, that of what is named or those of the neighbours, into μ and its anchors.
fn slide(
    texture: &mut TextureModel,
    named: Option<&Material>,
    z: &[f32],
    description: &ModelDescription,
) {
    let near = shares(z, description);
    let film = |name: &str| table::material(name).and_then(|material| material.mu);
    let anchors = near.iter().map(|(weight, anchor)| FrictionAnchor {
        name: anchor.name.clone(),
        mu: film(&anchor.name).unwrap_or(anchor.mu),
        weight: *weight,
    });
    let anchors: Vec<FrictionAnchor> = match named.and_then(|named| Some((named, named.mu?))) {
        Some((named, mu)) => vec![FrictionAnchor {
            name: named.name.clone(),
            mu,
            weight: 1.0,
        }],
        None => anchors.collect(),
    };
    let own: f64 = near.iter().map(|(weight, anchor)| weight * anchor.mu).sum();
    let slid: f64 = anchors.iter().map(|anchor| anchor.weight * anchor.mu).sum();
    if own > 0.0 && (slid / own - 1.0).abs() > LEAST_SLIDE {
        texture.friction.mu *= slid / own;
        texture.friction.anchors = anchors;
    }
}

/// Gives a texture a law, and the wall and the friction that go with it. `friction` is the latent of its μ.
pub fn give(
    texture: &mut TextureModel,
    choice: Option<Choice>,
    friction: &[f32],
    description: &ModelDescription,
) {
    if let Some(choice) = &choice {
        slide(texture, choice.named, friction, description);
    }
    set(texture, choice.map(|choice| choice.law));
}

/// Gives a texture a law, and the wall that goes with it.
pub fn set(texture: &mut TextureModel, law: Option<ContactLaw>) {
    if let Some(law) = &law {
        let slope = law.stiffness_n_m();
        texture.wall.stiffness_n_m = slope.unwrap_or(texture.wall.stiffness_n_m);
        if law.damping_s_m > 0.0 {
            texture.wall.damping_n_s_m = 0.0;
        }
    }
    texture.contact = law;
}

/// The tables, which decide textures as the model does.
pub static TABLES: [&str; 2] = [CONTACT_LAWS, words::TABLE];
