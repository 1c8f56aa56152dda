//! Section 4.

use super::{percent, row, table};
use crate::evaluate::probes::{Attribute, Baseline, ChangeKind, Direction, Order, Probing};

pub(super) fn section(part: &Probing) -> String {
    let mut text = String::from(
        "## 4. Do words move the texture the right way?\n\n\
         Prompts of `training/corpora/probes.toml` and `pairs.toml` are decoded, moved to the \
         attributes that the projection gives for their words, and their objective attributes \
         read: rough from rough_db, slippery from −μ, hard from hard_hz. This measures the network \
         alone, without the reading and the grammar of prompts that `compile` has around it. No \
         prompt is a caption of training or a phrase of the lexicon letter for letter; some are \
         one in another article, number or order of words, and names and synonyms were not \
         excluded. The baselines are the training material nearest in text, and the rating of the nearest phrase of the everyday lexicon.\n\n\
         ![Directions and pairs](probes.png)\n\n",
    );
    let p = &part.paraphrases;
    text += &format!(
        "**Paraphrases.** {} pairs lie {:.2} deviations of the corpus apart, prompts of different \
         pairs {:.2}: a ratio of {:.2}. {} of the pairs are closer than half of the random \
         ones.\n\n**Directions.**\n\n",
        p.pairs,
        p.distance,
        p.random_distance,
        p.ratio,
        percent(p.closer)
    );
    text += &table(&["changed by", "rough", "slippery", "hard", "all"]);
    let kinds = [
        ("negation", Some(ChangeKind::Negation)),
        ("less, more", Some(ChangeKind::Comparative)),
        ("degree", Some(ChangeKind::Degree)),
        ("all", None),
    ];
    for (name, kind) in kinds {
        let of_kind = |d: &Direction| kind.is_none_or(|kind| d.kind == kind);
        let mut cells = vec![name.to_owned()];
        for attribute in Attribute::ALL {
            let share = part.right(|d| of_kind(d) && d.attribute == attribute);
            cells.push(format!("{} of {}", share.hits, share.of));
        }
        cells.push(percent(part.right(of_kind)));
        text += &row(&cells);
    }
    text += "\n**Pairs** in which nearly anyone would agree on the first:\n\n";
    text += &table(&[
        "attribute",
        "pairs",
        "decoded texture",
        "nearest material",
        "nearest phrase",
    ]);
    for ranked in &part.pairs {
        text += &row(&[
            ranked.attribute.name().into(),
            ranked.model.of.to_string(),
            percent(ranked.model),
            ties(&ranked.material),
            ties(&ranked.phrase),
        ]);
    }
    text += "\n**Abrasive over cork over foam**, the paper's order:\n\n";
    text += &table(&["prompts", "sharp_hz", "rough_db", "in order"]);
    part.orders.iter().for_each(|order| text += &line(order));
    let (negation, all) = (
        part.right(|d| d.kind == ChangeKind::Negation),
        part.right(|_| true),
    );
    text += &format!(
        "\n**Answer.** {} of the directions are right, {} of the negations (chance is 50 %).\n",
        percent(all),
        percent(negation)
    );
    text
}

/// `70.0 % (62.0–77.0) + 5.0 % tied`.
fn ties(baseline: &Baseline) -> String {
    let of = baseline.right.of.max(1) as f64;
    let tied = 100.0 * baseline.tied as f64 / of;
    format!("{} + {tied:.1} % tied", percent(baseline.right))
}

/// With a true minus sign, and none on zero.
fn number(x: f64) -> String {
    let rounded = (10.0 * x).round() / 10.0 + 0.0;
    format!("{rounded:.1}").replace('-', "−")
}

fn line(order: &Order) -> String {
    let values = |x: [f64; 3]| x.map(number).join(", ");
    let said = match (order.sharp_falls, order.rough_falls) {
        (true, true) => "both",
        (true, false) => "sharpness",
        (false, true) => "excitation",
        (false, false) => "none",
    };
    row(&[
        order.prompts.join("; "),
        values(order.sharp_hz),
        values(order.rough_db),
        said.into(),
    ])
}
