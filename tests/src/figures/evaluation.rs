//! Figures that pages quote from the report of `asperity-train evaluate`.

use super::Set;
use serde_json::Value;
use std::{
    error::Error,
    path::{Path, PathBuf},
};

/// The command that writes the report.
const COMMAND: &str = "asperity-train evaluate --model target/model --parts 2,7 -o report, then cargo run -p \
                       asperity-tests --bin figures -- --report report/report.json";
/// Inputs that decide the figures: the corpus, the recipe, the shipped weights.
const PATHS: [&str; 4] = [
    "training/corpora",
    "training/train/src/evaluate",
    "compiler/model",
    "compiler/src/learned",
];

/// Captions and synonyms that find their material, in per cent.
///
/// # Errors
/// For a report without these parts.
pub fn set(report: &str, root: &Path) -> Result<Set, Box<dyn Error>> {
    let report: Value = serde_json::from_str(report)?;
    let percent = |pointers: &[&str]| -> Result<String, Box<dyn Error>> {
        let shares = pointers.iter().map(|pointer| {
            let share = report.pointer(pointer).and_then(Value::as_f64);
            share.ok_or_else(|| format!("the report has no {pointer}"))
        });
        let shares = shares.collect::<Result<Vec<f64>, _>>()?;
        Ok(format!(
            "{:.0}",
            100.0 * shares.into_iter().fold(0.0, f64::max)
        ))
    };
    let captions = |by: &str, share: &str| percent(&[&format!("/retrieval/{by}/{share}/share")]);
    let synonyms = |by: &str| percent(&[&format!("/names/left_out/{by}/top_5/share")]);
    // Of the two kinds of TF-IDF the better one.
    let tf_idf = |part: &str, share: &str| {
        let [first, second] = [0, 1].map(|kind| format!("/{part}/tfidf/{kind}/{share}/share"));
        percent(&[&first, &second])
    };
    let set = Set::new(
        COMMAND,
        [
            ("first", captions("latent", "top_1")?),
            ("first_cosine", captions("similarity", "top_1")?),
            ("first_tf_idf", tf_idf("retrieval", "top_1")?),
            ("five", captions("latent", "top_5")?),
            ("five_cosine", captions("similarity", "top_5")?),
            ("five_tf_idf", tf_idf("retrieval", "top_5")?),
            ("synonyms", synonyms("latent")?),
            ("synonyms_cosine", synonyms("similarity")?),
            ("synonyms_tf_idf", tf_idf("names/left_out", "top_5")?),
        ],
    );
    Ok(set.of_now(root, PATHS.map(PathBuf::from).to_vec())?)
}

#[cfg(test)]
mod tests {
    #[test]
    fn a_report_without_a_part_names_what_it_lacks() {
        let error = super::set(r#"{"retrieval": {}}"#, std::path::Path::new(".")).unwrap_err();
        assert!(error.to_string().contains("/retrieval/latent/top_1/share"));
    }
}
