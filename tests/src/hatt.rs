//! Finds and reads the HaTT materials where a copy is present. They are used by tests only,
//! and no part of them is kept in this repository.

use std::path::{Path, PathBuf};

/// The sorted XML files of the materials, from the folder that `build.rs` found. A test that asks for them
/// carries `#[cfg_attr(not(hatt), ignore = "…")]`.
///
/// # Panics
///
/// If there are none: a test over no material would pass.
#[must_use]
pub fn materials() -> Vec<PathBuf> {
    let folder = option_env!("HATT_FOLDER").unwrap_or_default();
    let mut files: Vec<_> = std::fs::read_dir(folder)
        .into_iter()
        .flatten()
        .filter_map(|entry| Some(entry.ok()?.path()))
        .filter(|path| {
            path.extension()
                .is_some_and(|ext| ext.eq_ignore_ascii_case("xml"))
        })
        .collect();
    files.sort();
    assert!(
        !files.is_empty(),
        "no HaTT materials, folder `{folder}`; set ASPERITY_HATT to their folder"
    );
    files
}

/// Materials of the HaTT that published figures are over, of its 100. Another copy gives other figures.
pub const PUBLISHED: usize = 75;

/// Every `stride`th of [`materials`].
#[must_use]
pub fn some_materials(stride: usize) -> Vec<PathBuf> {
    materials().into_iter().step_by(stride).collect()
}

/// The contents of a material's file, found by searching its text.
#[derive(Debug)]
pub struct Source {
    /// Name.
    pub name: String,
    /// μ.
    pub mu: f64,
    /// Models in file order.
    pub models: Vec<SourceModel>,
    /// Triangles of models, from 0.
    pub triangles: Vec<[usize; 3]>,
}

/// An ARMA model of a material.
#[derive(Debug)]
pub struct SourceModel {
    /// a_1.. of A(z) = 1 + Σ a_k z⁻ᵏ.
    pub a: Vec<f64>,
    /// b_1.. of B(z).
    pub b: Vec<f64>,
    /// gain·√var.
    pub level_m_s2: f64,
    /// Speed, mm/s.
    pub speed_mm_s: f64,
    /// Force, N.
    pub force_n: f64,
}

fn element<'a>(text: &'a str, tag: &str) -> Option<&'a str> {
    let at = text
        .find(&format!("<{tag}>"))
        .or_else(|| text.find(&format!("<{tag} ")))?;
    let start = at + text[at..].find('>')? + 1;
    let end = start + text[start..].find(&format!("</{tag}>"))?;
    Some(text[start..end].trim())
}

fn number(text: &str, tag: &str) -> Option<f64> {
    element(text, tag)?.parse().ok()
}

fn list(text: &str, tag: &str) -> Option<Vec<f64>> {
    element(text, tag)?
        .split("<value>")
        .skip(1)
        .map(|rest| rest.split('<').next()?.trim().parse().ok())
        .collect()
}

/// Reads a material. `None` if the file is not in the form of the HaTT.
#[must_use]
pub fn read(path: &Path) -> Option<Source> {
    let text = std::fs::read_to_string(path).ok()?;
    let models = text
        .split("<model>")
        .skip(1)
        .map(|model| {
            let mut a = list(model, "ARcoeff")?;
            let mut b = list(model, "MAcoeff")?;
            // Both lists begin with the leading coefficient 1.
            (a.remove(0) == 1.0 && b.remove(0) == 1.0).then_some(())?;
            Some(SourceModel {
                a,
                b,
                level_m_s2: number(model, "gain")? * number(model, "var")?.sqrt(),
                speed_mm_s: number(model, "speedMod")?,
                force_n: number(model, "forceMod")?,
            })
        })
        .collect::<Option<Vec<_>>>()?;
    let triangles = text
        .split("<tri ")
        .skip(1)
        .map(|triangle| {
            let corners: Option<Vec<f64>> = triangle
                .split("</tri>")
                .next()?
                .split("<value>")
                .skip(1)
                .map(|rest| rest.split('<').next()?.trim().parse().ok())
                .collect();
            let corners = corners?;
            Some(std::array::from_fn(|i| corners[i] as usize - 1))
        })
        .collect::<Option<Vec<_>>>()?;
    Some(Source {
        name: element(&text, "material")?.to_owned(),
        mu: number(&text, "mu")?,
        models,
        triangles,
    })
}
