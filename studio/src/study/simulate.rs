//! Participants that nobody asked: they rate what the software predicts, with stated noise, bias, and a share by which a
//! midpoint lies nearer to its higher anchor. They say how many people a design needs, and nothing of people.

use super::{
    dataset::{Dataset, Row, stimulus_cells},
    design::Simulate,
    plan::{self, Shuffle, Step},
    prepared::Study,
    stimuli::Stimulus,
    utc::rfc3339,
};
use crate::VERSION;
use asperity_io::diagnostic::Fault;
use serde_json::{Map, Value, json};
use std::{path::Path, time::Duration};

/// Time of a step, ms.
const STEP_MS: u64 = 8000;
/// Mixed into the seed, so that ratings are not those numbers that order the trials.
const RATINGS: u64 = 0x5eed_0fa7_1234_5678;

pub(super) fn simulate(
    study: &Study,
    participants: usize,
    seed: u64,
    folder: &Path,
    done: impl Fn(),
) -> Result<(), Fault> {
    if folder.join("materials/study.toml").exists() {
        let what = "it has the data of a study already";
        return Err(Fault::new(what, "give a new folder as --output").at(folder));
    }
    let Study {
        design,
        text,
        forms,
        stimuli,
        ..
    } = study;
    let made = &design.simulate;
    let dataset = Dataset::open(folder, (design, text), stimuli, forms, Some((made, seed)))?;
    for number in 0..participants {
        let mut random = Shuffle::new(seed ^ RATINGS, number as u64);
        let bias: Vec<f64> = design
            .attributes
            .iter()
            .map(|_| made.bias * random.normal())
            .collect();
        let steps = plan::steps(design, stimuli.len(), forms, number);
        let row = |(index, step): (usize, Step)| {
            let mut row = Row {
                trial_type: step.trial_type(),
                trial_index: index,
                time_elapsed: (index as u64 + 1) * STEP_MS,
                rt: STEP_MS,
                started_at: rfc3339(Duration::from_millis(index as u64 * STEP_MS)),
                device: "simulated".into(),
                version: VERSION,
                ..Row::default()
            };
            row.response = answer(&mut row, study, step, &bias, &mut random).to_string();
            row
        };
        let rows: Vec<Row> = steps.into_iter().enumerate().map(row).collect();
        dataset.append(&format!("P{:02}", number + 1), &rows)?;
        done();
    }
    Ok(())
}

fn answer(row: &mut Row, study: &Study, step: Step, bias: &[f64], random: &mut Shuffle) -> Value {
    let Study {
        design,
        forms,
        stimuli,
        ..
    } = study;
    match step {
        Step::Consent => {
            json!({ "agreed": true })
        }
        Step::Break { .. } => {
            json!({})
        }
        Step::Form(at) => {
            row.form.clone_from(&forms[at].name);
            let item = |item: &super::forms::Item| {
                let middle = 0.5 * (item.least + item.most);
                let answer = middle + (item.most - item.least) / 6.0 * random.normal();
                let step = item.least + ((answer - item.least) / item.step).round() * item.step;
                let answer = if item.text {
                    json!("simulated")
                } else {
                    json!(step.clamp(item.least, item.most))
                };
                (item.name.clone(), answer)
            };
            forms[at]
                .items
                .iter()
                .map(item)
                .collect::<Map<_, _>>()
                .into()
        }
        Step::Prompt => {
            row.stimulus = "simulated".into();
            explored(row);
            json!({ "tries": [{ "prompt": "simulated", "certainty": null }] })
        }
        Step::Rating {
            texture,
            phase,
            repeat,
        } => {
            stimulus_cells(row, &stimuli[texture]);
            (row.phase, row.repeat) = (phase.name(), Some(repeat));
            explored(row);
            let rating = |(attribute, bias): (&toml::Spanned<super::design::Attribute>, &f64)| {
                let name = &attribute.get_ref().name;
                let rating = felt(&stimuli[texture], stimuli, name, &design.simulate)
                    + bias
                    + design.simulate.noise * random.normal();
                (name.clone(), json!(rating.clamp(0.0, 100.0)))
            };
            design
                .attributes
                .iter()
                .zip(bias)
                .map(rating)
                .collect::<Map<_, _>>()
                .into()
        }
    }
}

/// The rating without noise: the software's place within the share of the scale that is used. A midpoint lies between its
/// anchors, beyond its share by `dominance` towards the higher one.
fn felt(stimulus: &Stimulus, stimuli: &[Stimulus], attribute: &str, made: &Simulate) -> f64 {
    let place = |stimulus: &Stimulus| {
        let place = stimulus
            .entry
            .attributes
            .get(attribute)
            .and_then(Value::as_f64);
        50.0 + made.spread * (place.unwrap_or(50.0).clamp(0.0, 100.0) - 50.0)
    };
    let end = |name: &String| {
        stimuli
            .iter()
            .find(|other| other.entry.name == *name)
            .map(place)
    };
    let between = |names: &[String; 2]| {
        let [a, b] = [end(&names[0])?, end(&names[1])?];
        let share = stimulus.entry.t?
            + if b > a {
                made.dominance
            } else {
                -made.dominance
            };
        Some(a + share * (b - a))
    };
    let between = stimulus.entry.anchors.as_ref().and_then(between);
    between.unwrap_or_else(|| place(stimulus))
}

/// Nobody touched anything.
fn explored(row: &mut Row) {
    (row.strokes, row.taps, row.contact_s) = (Some(0), Some(0), Some(0.0));
    row.exploration = json!(vec![0.0; 36]).to_string();
}
