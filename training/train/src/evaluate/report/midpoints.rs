//! Section 5.

use super::{percent, row, table};
use crate::evaluate::midpoints::Midpoints;

pub(super) fn section(part: &Midpoints) -> String {
    let ends: Vec<String> = part
        .ends
        .iter()
        .map(|[name, material]| format!("{name} ({material})"))
        .collect();
    let mut text = format!(
        "## 5. Does a mixture lie between its ends?\n\n\
         Latents of {} are mixed half and half, and decoded. The place of an attribute is (midpoint \
         − A)/(B − A), all three decoded: from 0 to 1 it lies between, 0.5 is halfway, and — marks \
         ends that differ by less than a tenth of the corpus's deviation. *On the line* projects all \
         four attributes, each in deviations of the corpus, onto the line between the ends; *off \
         it* is the distance that remains, over that of the ends. Nobody was asked whether a \
         mixture feels between its ends.\n\n",
        ends.join(", ")
    );
    text += &table(&[
        "A, B",
        "rough_db",
        "sharp_hz",
        "hard_hz",
        "μ",
        "on the line",
        "off it",
    ]);
    for pair in &part.pairs {
        let mut cells = vec![pair.ends.join(", ")];
        cells.extend(pair.place.map(|place| match place {
            Some(t) => format!("{t:.2}").replace('-', "−"),
            None => "—".into(),
        }));
        cells.push(format!("{:.2}", pair.place_on_line).replace('-', "−"));
        cells.push(format!("{:.2}", pair.off_line));
        text += &row(&cells);
    }
    let mut cells = vec!["between the ends".to_owned()];
    cells.extend(
        part.between
            .map(|share| format!("{} of {}", share.hits, share.of)),
    );
    let line = part.between_on_line;
    cells.push(format!("{} of {}", line.hits, line.of));
    cells.push(String::new());
    text += &row(&cells);
    text += &format!(
        "\n**Answer.** {} of the attributes and {} of the projections lie between their ends.\n",
        percent(part.between_any),
        percent(part.between_on_line)
    );
    text
}
