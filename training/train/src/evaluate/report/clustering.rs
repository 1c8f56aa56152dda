//! Section 1.

use super::{row, table};
use crate::evaluate::clustering::{Clustering, Collapse, Indices, PAPER};

pub(super) fn section(part: &Clustering) -> String {
    let mut text = format!(
        "## 1. Do instances of a material lie together?\n\n\
         Posterior means of {} augmented instances of {} materials. The indices are those of \
         scikit-learn; ARI and NMI (arithmetic mean) compare the materials with k-means, k = {}, \
         of which the best of four starts counts. *Unseen* instances differ from those of training \
         in their random numbers alone.{}\n\n",
        part.instances,
        part.materials,
        part.materials,
        if part.taps_synthetic {
            " Taps are synthetic."
        } else {
            ""
        }
    );
    text += &table(&[
        "instances, encoders",
        "silhouette",
        "Calinski–Harabasz",
        "Davies–Bouldin",
        "ARI",
        "NMI",
    ]);
    text += &indices("the paper: 2,000 of 100, training", &PAPER);
    for found in &part.rows {
        let name = format!("{}, {}", found.instances, found.encoder);
        text += &indices(&name, &found.indices);
    }
    text += &format!(
        "\nA latent that forgot everything but the label would be tight as well. What these latents \
         keep (AR + taps):\n\n{}",
        table(&["", "training", "unseen"])
    );
    let (seen, unseen) = (&part.collapse, &part.collapse_unseen);
    type Value = fn(&Collapse) -> String;
    let share = |x: f64| format!("{:.1} %", 100.0 * x);
    let rows: [(&str, Value); 7] = [
        ("variance of LSFs explained", |c| percent(c.lsf_explained)),
        ("variance of levels explained", |c| {
            percent(c.level_explained)
        }),
        ("variance of tap samples explained", |c| {
            percent(c.taps_explained)
        }),
        ("active units of 64 (variance > 0.01)", |c| {
            c.active_units.to_string()
        }),
        ("effective rank of the covariance", |c| {
            format!("{:.1}", c.effective_rank)
        }),
        ("participation ratio", |c| format!("{:.1}", c.participation)),
        ("variance between materials / total", |c| {
            percent(c.between_share)
        }),
    ];
    for (name, value) in rows {
        text += &row(&[name.into(), value(seen), value(unseen)]);
    }
    let unseen_row = part
        .rows
        .iter()
        .find(|r| r.instances == "unseen" && r.encoder == "AR + taps");
    if let Some(found) = unseen_row {
        text += &format!(
            "\n**Answer.** On unseen instances the silhouette is {:.2} and k-means recovers the \
             materials with ARI {:.2}, while {} of the variance of LSFs and {} of that of levels \
             survive the latent.\n",
            found.indices.silhouette,
            found.indices.adjusted_rand,
            share(unseen.lsf_explained),
            share(unseen.level_explained)
        );
    }
    text
}

fn percent(share: f64) -> String {
    format!("{:.1} %", 100.0 * share)
}

fn indices(name: &str, found: &Indices) -> String {
    row(&[
        name.into(),
        format!("{:.3}", found.silhouette).replace('-', "−"),
        format!("{:.3e}", found.calinski_harabasz),
        format!("{:.3}", found.davies_bouldin),
        format!("{:.3}", found.adjusted_rand).replace('-', "−"),
        format!("{:.3}", found.mutual_information),
    ])
}
