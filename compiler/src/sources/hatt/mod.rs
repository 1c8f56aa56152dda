//! Materials of the Penn Haptic Texture Toolkit (HaTT) as a source.
//!
//! [`parse`] reads the XML of a material and checks every statement in it; [`to_model`] turns it into a texture;
//! [`Hatt`] wraps a file for the [driver](crate::driver). The whole ARMA model is kept, with every vertex and every
//! triangle in source order. What HaTT does not hold is synthesised or set to a default, and the provenance says so.
//!
//! ```
//! use asperity::sources::hatt;
//! use std::path::Path;
//!
//! # let list = |tag: &str, values: &[f64]| {
//! #     let values: String = values.iter().map(|x| format!("<value>{x}</value>")).collect();
//! #     format!("<{tag}>{values}</{tag}>")
//! # };
//! # let (speeds, forces) = ([0.0, 200.0, 200.0, 0.0], [0.0, 0.0, 4.0, 4.0]);
//! # let mut xml = String::from(
//! #     "<modelSet><material>Board</material><AccelUnits>m/s^2</AccelUnits><SpeedUnits>mm/s</SpeedUnits>\
//! #      <ForceUnits>N</ForceUnits><SampleRate>1000</SampleRate><mu>0.4</mu><numMod>4</numMod><numTri>2</numTri>\
//! #      <maxSpeed>200</maxSpeed><maxForce>4</maxForce><numARCoeff>1</numARCoeff><numMACoeff>0</numMACoeff>",
//! # );
//! # xml += &list("speedList", &speeds);
//! # xml += &list("forceList", &forces);
//! # xml += &list("tri", &[1.0, 2.0, 3.0]);
//! # xml += &list("tri", &[1.0, 3.0, 4.0]);
//! # for n in 0..4 {
//! #     xml += &format!("<model><modNum>{}</modNum>", n + 1);
//! #     xml += &list("ARcoeff", &[1.0, 0.0]);
//! #     xml += &list("ARlsf", &[std::f64::consts::FRAC_PI_2]);
//! #     xml += &list("MAcoeff", &[1.0]);
//! #     xml += &list("MAlsf", &[]);
//! #     xml += &format!("<var>0.01</var><gain>1</gain><speedMod>{}</speedMod>", speeds[n]);
//! #     xml += &format!("<forceMod>{}</forceMod></model>", forces[n]);
//! # }
//! # xml += "</modelSet>";
//! // `xml` is the text of a file with four models at the corners of the grid.
//! let material = hatt::parse(Path::new("board.xml"), xml.as_bytes())?;
//! assert_eq!((material.name.as_str(), material.models.len()), ("Board", 4));
//!
//! let texture = hatt::to_model(&material, "board.xml", 0);
//! assert_eq!(texture.grid.triangles, material.triangles);
//! assert!(texture.provenance.taps_synthetic); // HaTT models strokes, not taps
//! # Ok::<(), asperity_io::diagnostic::Fault>(())
//! ```

mod filter;
mod material;
mod source;
#[cfg(test)]
mod tests;
mod texture;
mod xml;

pub use filter::Filter;
pub use material::{Material, SourceModel, parse};
pub use source::{BUDGET_DB, Hatt, Recomputed, bytes, files, refuse_namesakes};
pub use texture::to_model;
