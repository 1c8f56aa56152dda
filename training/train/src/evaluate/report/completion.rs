//! Section 8.

use super::{row, table};
use crate::evaluate::held_out::{Completed, Completion};

pub(super) fn section(part: &Completion) -> String {
    let mut text = format!(
        "## 8. Can the latent complete what was not recorded?\n\n\
         {} folds of {} materials, single ones spread over the families. Each trains the first stage \
         ({} epochs, one half withheld from {:.0} % of the instances) without a part of the \
         materials, encodes these from one half alone, and decodes what was withheld. *Nearest* is \
         the training material that is nearest in the given half, by its spectra with level or by \
         those of its taps; *both* is encoded from both halves. Absolute errors as in section \
         3.\n",
        part.folds,
        part.materials,
        part.epochs,
        100.0 * part.modality_dropout
    );
    let mut answers = Vec::new();
    for direction in &part.directions {
        text += "\n";
        text += &table(&[
            &direction.name,
            "completed",
            "mean texture",
            "nearest",
            "both",
            "better than mean",
            "better than nearest",
        ]);
        for metric in &direction.metrics {
            text += &line(metric);
        }
        let wins = direction.metrics.iter().filter(|metric| {
            let [completed, mean, nearest, _] = metric.means();
            completed < mean && completed < nearest
        });
        answers.push(format!(
            "{}: better than both baselines in {} of {} metrics",
            direction.name,
            wins.count(),
            direction.metrics.len()
        ));
    }
    text + &format!("\n**Answer.** {}.\n", answers.join("; "))
}

fn line(metric: &Completed) -> String {
    let mut cells = vec![metric.name.clone()];
    cells.extend(metric.errors.map(|s| {
        let digits = if s.mean >= 10.0 { 1 } else { 3 };
        format!("{:.digits$} ± {:.digits$}", s.mean, s.deviation)
    }));
    cells.push(format!("{:.0} %", 100.0 * metric.better_than_mean.share));
    cells.push(format!("{:.0} %", 100.0 * metric.better_than_nearest.share));
    row(&cells)
}
