//! The textures that rows run on: the built-in one and, if a folder is given, HaTT materials.

use std::path::Path;

use asperity::{
    driver,
    model::{ContactLaw, GridVertex, TextureModel, VertexKind},
    pipeline::Request,
    sources::{Tools, hatt::Hatt},
};
use asperity_formats::Asset;
use asperity_runtime::HostTexture;

use super::error::StabilityError;

/// Materials whose mixtures of coefficients are known to fail, and similar ones. Rows name them
/// one by one.
pub const HARD: [&str; 5] = [
    "Stone Tile 1",
    "Textured Rubber",
    "Painted Brick",
    "Polyethylene Foam",
    "Bubble Envelope",
];

/// A texture, as a model and in a slot.
#[derive(Debug)]
pub struct Material {
    /// Its name.
    pub name: String,
    /// The model.
    pub model: TextureModel,
    /// The runtime's slot with the texture.
    pub slot: Box<HostTexture>,
}

impl Material {
    /// Lowers and loads a model.
    ///
    /// # Errors
    /// [`StabilityError::Lower`].
    pub fn new(model: TextureModel) -> Result<Self, StabilityError> {
        Ok(Self::from_bytes(
            &asperity::emit::lower::lower(&model, None)?.bytes,
        ))
    }

    /// A texture that has one vertex's model at every speed and force.
    ///
    /// # Errors
    /// [`StabilityError::Lower`].
    pub fn constant(like: &TextureModel, vertex: &GridVertex) -> Result<Self, StabilityError> {
        let corner = |speed_mm_s: f64, force_n: f64| GridVertex {
            speed_mm_s,
            force_n,
            kind: VertexKind::Edge,
            ..vertex.clone()
        };
        let mut model = like.clone();
        model.taps.traces.clear();
        model.grid.order = vertex.lsf_rad.len();
        model.grid.vertices = vec![
            corner(0.0, 0.0),
            corner(200.0, 0.0),
            corner(0.0, 3.0),
            corner(200.0, 3.0),
        ];
        model.grid.triangles = vec![[0, 1, 2], [1, 3, 2]];
        Self::new(model)
    }

    /// Loads the bytes of an asset.
    ///
    /// # Panics
    /// If the runtime refuses what the compiler wrote.
    fn from_bytes(bytes: &[u8]) -> Self {
        let asset = Asset::parse(bytes).expect("the compiler's own bytes");
        let model = asperity::emit::raise::raise(&asset);
        let mut slot = Box::new(HostTexture::new());
        slot.load(&asset, model.grid.sample_rate_hz as f32)
            .expect("a slot of full size");
        Self {
            name: model.name.clone(),
            model,
            slot,
        }
    }

    /// The built-in texture.
    ///
    /// # Errors
    /// [`StabilityError::Lower`].
    pub fn built_in() -> Result<Self, StabilityError> {
        Self::new(asperity::sources::builtin::texture())
    }

    /// The coefficients [1, a_1, …] that the runtime renders with at a speed and a force.
    #[must_use]
    pub fn monic(&self, speed_mm_s: f64, force_n: f64) -> Vec<f64> {
        let filter = self.slot.filter_at(speed_mm_s as f32, force_n as f32);
        let order = self.model.grid.order;
        std::iter::once(1.0)
            .chain(filter.a[..order].iter().map(|&a| f64::from(a)))
            .collect()
    }

    /// The built-in texture's wall and friction without vibration and taps.
    ///
    /// Vibration and taps give off energy by design. Without them, all energy comes from the
    /// contact.
    ///
    /// # Errors
    /// [`StabilityError::Lower`].
    pub fn silent(stiffness_n_m: f64, damping_n_s_m: f64) -> Result<Self, StabilityError> {
        Self::giving_way((stiffness_n_m, damping_n_s_m), None)
    }

    /// [`Material::silent`] with a contact law.
    ///
    /// # Errors
    /// [`StabilityError::Lower`].
    pub fn giving_way(
        (stiffness_n_m, damping_n_s_m): (f64, f64),
        contact: Option<ContactLaw>,
    ) -> Result<Self, StabilityError> {
        let mut model = asperity::sources::builtin::texture().silent();
        model.wall.stiffness_n_m = stiffness_n_m;
        model.wall.damping_n_s_m = damping_n_s_m;
        model.contact = contact;
        Self::new(model)
    }
}

/// The built-in texture, and those of the [`HARD`] materials that a HaTT folder holds.
///
/// # Errors
/// [`StabilityError::Hatt`] or [`StabilityError::Import`] for a folder or a file that cannot be read.
pub fn all(hatt: Option<&Path>) -> Result<Vec<Material>, StabilityError> {
    let mut materials = vec![Material::built_in()?];
    let Some(folder) = hatt else {
        return Ok(materials);
    };
    for file in asperity::sources::hatt::files(folder)? {
        let stem = file.file_stem().unwrap_or_default().to_string_lossy();
        let name = stem.trim_start_matches("Models_");
        if !HARD.contains(&name) {
            continue;
        }
        let material = Hatt::new(file);
        let compiled = driver::compile(&material, &Request::default(), &Tools::default());
        let compiled = compiled.map_err(StabilityError::Import)?;
        materials.push(Material::from_bytes(&compiled.lowered.bytes));
    }
    Ok(materials)
}
