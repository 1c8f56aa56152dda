//! Measured materials beside the textures that their names are compiled into.

use super::signature::Signature;
use asperity::{
    model::{
        TextureModel,
        attributes::{self, Attributes},
    },
    sources::prompt::{Options, PromptCompiler},
};
use asperity_corpus::{CorpusError, generator::Physical, hatt};
use rayon::prelude::*;

/// A measured material beside the texture of its name.
#[derive(Debug, Clone)]
pub struct Material {
    /// Name as its file writes it: `Brick 2`.
    pub name: String,
    /// The name as a prompt, `brick`; specimens of one material share it.
    pub prompt: String,
    /// The measured models.
    pub measured: Vibration,
    /// The texture of the prompt, as `asperity compile` reduces it.
    pub compiled: Vibration,
    /// Objective attributes of that texture.
    pub attributes: Attributes,
    /// Parameters of the material of the reference corpus that the name means.
    pub physical: Option<Physical>,
    /// The generator's predictions.
    pub generated: Option<Generated>,
}

/// Vibration and friction of a texture.
#[derive(Debug, Clone)]
pub struct Vibration {
    /// Band levels before device gain.
    pub signature: Signature,
    /// Coefficient of kinetic friction.
    pub mu: f64,
}

impl Vibration {
    fn of(texture: &TextureModel) -> Self {
        Self {
            signature: Signature::of(&texture.grid),
            mu: texture.friction.mu,
        }
    }
}

/// The generator's predictions for a material.
#[derive(Debug, Clone)]
pub struct Generated {
    /// With the constants of the reference corpus.
    pub shipped: Vibration,
    /// With constants fitted on the materials of other names; `None` where no fit was made.
    pub left_out: Option<Vibration>,
    /// With constants from physics and open data alone.
    pub open: Vibration,
}

/// Materials that can be judged, in order of their models, and those that cannot, each with its reason.
#[derive(Debug, Clone, Default)]
pub struct Materials {
    /// Both sides of each material.
    pub compared: Vec<Material>,
    /// Name and reason.
    pub left_out: Vec<(String, String)>,
}

/// Compiles each measured model by name. `step` is called once a model.
///
/// # Errors
/// [`CorpusError`] of the committed names.
pub fn compile_by_name(
    models: &[TextureModel],
    prompt_compiler: &PromptCompiler,
    step: impl Fn() + Sync,
) -> Result<Materials, CorpusError> {
    let physical = hatt::physical_by_name()?;
    let compile = |model: &TextureModel| {
        let physical = physical.get(&model.name).copied();
        let compiled = material(model, physical, prompt_compiler);
        step();
        compiled.map_err(|reason| (model.name.clone(), reason))
    };
    let (compared, left_out) = (models.par_iter().map(compile)).partition_map(|one| match one {
        Ok(material) => rayon::iter::Either::Left(material),
        Err(reason) => rayon::iter::Either::Right(reason),
    });
    Ok(Materials { compared, left_out })
}

fn material(
    model: &TextureModel,
    physical: Option<Physical>,
    prompt_compiler: &PromptCompiler,
) -> Result<Material, String> {
    let prompt = prompt(&model.name).ok_or("its name holds no word to compile")?;
    let texture = prompt_compiler
        .compile(&prompt, &Options::default().without_preview())
        .map_err(|error| format!("{error}; {}", error.remedy()))?
        .texture;
    Ok(Material {
        name: model.name.clone(),
        prompt,
        measured: Vibration::of(model),
        compiled: Vibration::of(&texture),
        attributes: attributes::of(&texture),
        physical,
        generated: None,
    })
}

/// A name as a prompt: lower case, without its words of digits. `None` where no letter is left.
fn prompt(name: &str) -> Option<String> {
    let is_word = |word: &&str| !word.chars().all(|c| c.is_ascii_digit());
    let words: Vec<&str> = name.split_whitespace().filter(is_word).collect();
    let prompt = words.join(" ").to_lowercase();
    prompt.contains(char::is_alphabetic).then_some(prompt)
}

#[cfg(test)]
mod tests {
    #[test]
    fn a_specimen_is_prompted_by_its_name_without_its_number() {
        for (name, prompt) in [
            ("Brick 2", Some("brick")),
            ("Leather 1 Front", Some("leather front")),
            ("ABS Plastic", Some("abs plastic")),
            ("42", None),
        ] {
            assert_eq!(super::prompt(name).as_deref(), prompt);
        }
    }
}
