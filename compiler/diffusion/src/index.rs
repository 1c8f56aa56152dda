//! `model_index.json`: which pipeline the parts make, and its name.

use crate::{error::Problem, json};
use serde::Deserialize;

/// Bytes of a name that are kept.
const NAME_BYTES: usize = 100;

#[derive(Deserialize)]
struct Index {
    #[serde(rename = "_class_name")]
    class: String,
    #[serde(rename = "_name_or_path")]
    name: Option<String>,
}

/// The name of the model, without the folders of whoever exported it.
///
/// # Errors
/// [`Problem::Field`] for another pipeline than Stable Diffusion 1 or 2.
pub(crate) fn name(text: &str) -> Result<String, Problem> {
    let index: Index = json::parse(text)?;
    // `StableDiffusionPipeline`, with a prefix of the exporter: `Onnx`, `ORT`.
    if !index.class.ends_with("StableDiffusionPipeline") {
        return Err(Problem::Field {
            field: "_class_name",
            found: format!("`{}`", index.class),
            expected: "`StableDiffusionPipeline`".into(),
        });
    }
    let mut name = index.name.unwrap_or_default();
    name.retain(|letter| !letter.is_control());
    let is_local = name.starts_with(['/', '.', '~']) || name.contains(['\\', ':']);
    let parts: Vec<&str> = name.split(['/', '\\']).filter(|p| !p.is_empty()).collect();
    let kept = match parts[..] {
        [] => "Stable Diffusion".to_owned(),
        // `publisher/model`
        [_, _] if !is_local => name,
        [.., last] => last.to_owned(),
    };
    let mut end = kept.len().min(NAME_BYTES);
    while !kept.is_char_boundary(end) {
        end -= 1;
    }
    Ok(kept[..end].to_owned())
}

#[cfg(test)]
mod tests {
    use super::*;

    fn of(class: &str, path: &str) -> Result<String, Problem> {
        name(&format!(
            r#"{{"_class_name": "{class}", "_name_or_path": "{path}"}}"#
        ))
    }

    #[test]
    fn a_name_holds_no_folder() {
        for (path, expected) in [
            (
                "stabilityai/stable-diffusion-2-base",
                "stabilityai/stable-diffusion-2-base",
            ),
            ("/home/ann/models/sd2", "sd2"),
            ("./sd2/", "sd2"),
            ("a\\u001b[31m/b", "a[31m/b"),
            ("C:\\\\models\\\\sd2", "sd2"),
            ("", "Stable Diffusion"),
        ] {
            assert_eq!(of("OnnxStableDiffusionPipeline", path).unwrap(), expected);
        }
        assert_eq!(
            of("StableDiffusionPipeline", &"é".repeat(99))
                .unwrap()
                .len(),
            100
        );
    }

    #[test]
    fn other_pipelines_are_refused() {
        let error = of("StableDiffusionXLPipeline", "x")
            .unwrap_err()
            .to_string();
        assert!(
            error.contains("_class_name") && error.contains("XL"),
            "{error}"
        );
        assert!(matches!(name("{}"), Err(Problem::Json(_))));
    }
}
