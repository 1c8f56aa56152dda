//! Section 2.

use super::{percent, row, table};
use crate::evaluate::retrieval::{Retrieval, RetrievalRanks};

pub(super) fn section(part: &Retrieval) -> String {
    let mut text = format!(
        "## 2. Does a caption never trained on find its material?\n\n\
         {} held-out captions, each ranking {} materials: by the cosine of its latent with the \
         anchors, by the cosine of its text vector with the materials' mean captions, and by TF-IDF \
         over the same training captions, a document a material. Equal scores share a rank.\n\n",
        part.captions, part.materials
    );
    text += &table(&["by", "first", "among five", "MRR", "median rank"]);
    let [all, content] = &part.tfidf;
    for found in [&part.latent, &part.similarity, all, content] {
        text += &line(found);
    }
    let chance = 1.0 / part.materials.max(1) as f64;
    text += &row(&[
        "chance".into(),
        format!("{:.1} %", 100.0 * chance),
        format!("{:.1} %", (500.0 * chance).min(100.0)),
        String::new(),
        format!("{:.0}", 0.5 * (part.materials as f64 + 1.0)),
    ]);
    let (latent, baseline) = (&part.latent, part.baseline());
    let (verdict, how_far) = if latent.top_1.low > baseline.top_1.high {
        ("more often than", ", beyond both intervals")
    } else if latent.top_1.hits > baseline.top_1.hits {
        ("more often than", ", within the intervals")
    } else {
        ("no more often than", "")
    };
    text += &format!(
        "\n**Answer.** The latent puts the right material first {verdict} the better TF-IDF \
         ({:.1} % against {:.1} %{how_far}), and among five in {:.1} % against {:.1} %. The cosine of \
         the texts alone finds it first in {:.1} %, and among five in {:.1} %.\n",
        100.0 * latent.top_1.share,
        100.0 * baseline.top_1.share,
        100.0 * latent.top_5.share,
        100.0 * baseline.top_5.share,
        100.0 * part.similarity.top_1.share,
        100.0 * part.similarity.top_5.share
    );
    text
}

pub(super) fn line(found: &RetrievalRanks) -> String {
    row(&[
        found.by.clone(),
        percent(found.top_1),
        percent(found.top_5),
        format!("{:.3}", found.reciprocal_rank),
        format!("{:.1}", found.median_rank),
    ])
}
