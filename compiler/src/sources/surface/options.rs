//! What no map says of its surface.

use crate::sources::prompt;
use asperity_io::diagnostic::{Failure, Fault};
use asperity_surface::{
    contact::Tip,
    map::{Convention, Size},
};

/// Keys of a manifest.
pub const KEYS: [&str; 5] = ["width_mm", "depth_mm", "normal", "like", "tip"];

/// What a map does not say of its surface.
#[derive(Debug, Clone, PartialEq)]
pub struct Options {
    /// Its size.
    pub size: Size,
    /// Words for its material, which say how hard and slippery it is and how it sounds when it is tapped.
    pub like: Option<String>,
    /// The tip that strokes it.
    pub tip: Tip,
    /// Where green points to in its normals; guessed if `None`.
    pub convention: Option<Convention>,
}

impl Options {
    /// Those of a manifest, as texts by [`KEYS`].
    ///
    /// # Errors
    /// For a value that is none of its key.
    pub fn stated(stated: &[(&str, String)]) -> Result<Self, Failure> {
        let text = |key: &str| {
            let (_, text) = stated.iter().find(|(stated, _)| *stated == key)?;
            Some(text.as_str()).filter(|text| !text.is_empty())
        };
        let wrong = |key: &str, found: &str, wanted: &str| {
            Fault::new(format!("{found:?} must be {wanted}"), "correct the value").field(key)
        };
        let number = |key: &str| {
            let parsed = |text: &str| text.parse().map_err(|_| wrong(key, text, "a number of mm"));
            text(key).map(parsed).transpose()
        };
        let like = text("like").map(str::to_owned);
        if let Some(like) = &like {
            prompt::check(like).map_err(|error| Fault::of(&error).field("like"))?;
        }
        let tip = |name: &str| {
            name.parse()
                .map_err(|wanted: String| wrong("tip", name, &wanted))
        };
        let convention = |name: &str| {
            name.parse()
                .map_err(|wanted: String| wrong("normal", name, &wanted))
        };
        let size = Size {
            width_mm: number("width_mm")?,
            depth_mm: number("depth_mm")?,
        };
        size.check()?;
        Ok(Self {
            size,
            like,
            tip: text("tip").map_or(Ok(Tip::STYLUS), tip)?,
            convention: text("normal").map(convention).transpose()?,
        })
    }
}
