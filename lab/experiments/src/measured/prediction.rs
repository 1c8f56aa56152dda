//! Predictions of a measured material: its prompt, and baselines that know other materials.

use super::{
    material::Material,
    ridge,
    signature::{BANDS, STROKES, Signature},
};
use asperity::model::attributes::Attributes;

/// A way to predict a measured material.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Method {
    /// The texture of its name.
    Prompt,
    /// The generator of the texture of the material that the name means, with the constants of the reference corpus.
    Generator,
    /// The same, its constants fitted on materials of other names.
    GeneratorLeftOut,
    /// The same, from physics and open data alone.
    GeneratorOpen,
    /// The mean of all materials of other names.
    MeanOfOthers,
    /// Ridge regression on the attributes of the textures of names, fitted on all materials of other names.
    Attributes,
    /// The mean of the other specimens of the same name: the ceiling of a name.
    OtherSpecimen,
}

impl Method {
    /// Every method.
    pub const ALL: [Self; 7] = [
        Self::Prompt,
        Self::Generator,
        Self::GeneratorLeftOut,
        Self::GeneratorOpen,
        Self::MeanOfOthers,
        Self::Attributes,
        Self::OtherSpecimen,
    ];

    /// Its name in tables.
    #[must_use]
    pub const fn name(self) -> &'static str {
        match self {
            Self::Prompt => "the prompt",
            Self::Generator => "the generator of the reference corpus",
            Self::GeneratorLeftOut => "the generator, names left out",
            Self::GeneratorOpen => "the generator, from physics and open data alone",
            Self::MeanOfOthers => "the mean of the other materials",
            Self::Attributes => "ridge on four attributes of our textures, names left out",
            Self::OtherSpecimen => "the mean of the other specimens of the same name",
        }
    }

    /// The prediction of each material; `None` where the method has none.
    #[must_use]
    pub fn predict(self, materials: &[Material]) -> Vec<Option<Signature>> {
        let predict = |at: usize| {
            let of = &materials[at];
            let others = || materials.iter().filter(|m| m.prompt != of.prompt);
            match self {
                Self::Prompt => Some(of.compiled.signature.clone()),
                Self::Generator => Some(of.generated.as_ref()?.shipped.signature.clone()),
                Self::GeneratorLeftOut => {
                    Some(of.generated.as_ref()?.left_out.as_ref()?.signature.clone())
                }
                Self::GeneratorOpen => Some(of.generated.as_ref()?.open.signature.clone()),
                Self::MeanOfOthers => Signature::mean(others().map(|m| &m.measured.signature)),
                Self::Attributes => {
                    let known = others().map(|m| (features(&m.attributes), cells(m)));
                    let predicted =
                        ridge::predict(&known.collect::<Vec<_>>(), features(&of.attributes))?;
                    Some(from_cells(&predicted))
                }
                Self::OtherSpecimen => {
                    let same = (materials.iter().enumerate())
                        .filter(|(n, m)| *n != at && m.prompt == of.prompt);
                    Signature::mean(same.map(|(_, m)| &m.measured.signature))
                }
            }
        };
        (0..materials.len()).map(predict).collect()
    }
}

/// Roughness, dB; ln of sharpness and of hardness, Hz; friction. What a texture lacks is 0 or ln 1.
fn features(attributes: &Attributes) -> [f64; 4] {
    let ln = |hz: Option<f64>| libm::log(hz.unwrap_or(1.0));
    [
        attributes.rough_db.unwrap_or_default(),
        ln(attributes.sharp_hz),
        ln(attributes.hard_hz),
        attributes.mu,
    ]
}

fn cells(material: &Material) -> Vec<f64> {
    material.measured.signature.0.as_flattened().to_vec()
}

fn from_cells(cells: &[f64]) -> Signature {
    let mut levels = [[0.0; BANDS]; STROKES];
    levels.as_flattened_mut().copy_from_slice(cells);
    Signature(levels)
}
