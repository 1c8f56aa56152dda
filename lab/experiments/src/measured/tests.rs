//! Comparisons of made-up materials, whose errors are known.

use super::{
    Comparison, markdown,
    material::{Material, Materials, Vibration},
    prediction::Method,
    score::score,
    signature::{BANDS, STROKES, Signature},
    trend::FEWEST,
};
use asperity::model::attributes::Attributes;

/// Level of every band in every stroke, dB.
fn flat(level_db: f64) -> Vibration {
    Vibration {
        signature: Signature([[level_db; BANDS]; STROKES]),
        mu: 0.5,
    }
}

/// Specimens of a name with their measured levels, all compiled to one level.
fn named(prompt: &str, measured_db: &[f64], compiled_db: f64) -> Vec<Material> {
    let specimen = |(number, &level_db): (usize, &f64)| Material {
        name: format!("{prompt} {number}"),
        prompt: prompt.to_owned(),
        measured: flat(level_db),
        compiled: flat(compiled_db),
        attributes: Attributes {
            rough_db: Some(compiled_db),
            sharp_hz: Some(200.0),
            hard_hz: Some(300.0),
            mu: 0.5,
        },
        physical: None,
        generated: None,
    };
    measured_db.iter().enumerate().map(specimen).collect()
}

#[test]
fn no_baseline_sees_a_specimen_of_the_same_name() {
    let materials = [
        named("brick", &[0.0, 6.0], 3.0),
        named("silk", &[-30.0], -30.0),
        named("felt", &[-20.0], -24.0),
    ]
    .concat();
    let whole = |method: Method| -> Vec<f64> {
        let predictions = method.predict(&materials).into_iter();
        predictions
            .zip(&materials)
            .filter_map(|(prediction, m)| {
                Some(prediction?.difference(&m.measured.signature).whole_db)
            })
            .collect()
    };
    let near = |found: Vec<f64>, expected: &[f64]| {
        let apart = found.iter().zip(expected).map(|(x, y)| (x - y).abs());
        assert!(
            found.len() == expected.len() && apart.fold(0.0, f64::max) < 1e-9,
            "{found:?}"
        );
    };
    near(whole(Method::Prompt), &[3.0, 3.0, 0.0, 4.0]);
    // Of brick the mean of −30 and −20; of silk that of 0, 6 and −20.
    near(
        whole(Method::MeanOfOthers),
        &[25.0, 31.0, 30.0 - 14.0 / 3.0, 12.0],
    );
    near(whole(Method::OtherSpecimen), &[6.0, 6.0]);
    let ridge = Method::Attributes.predict(&materials);
    let mut changed = materials.clone();
    changed[1].measured = flat(40.0);
    // Another specimen of brick moves no prediction of brick.
    assert_eq!(Method::Attributes.predict(&changed)[0], ridge[0]);
    assert_ne!(Method::Attributes.predict(&changed)[2], ridge[2]);
}

#[test]
fn a_prompt_that_is_its_material_has_no_error_and_the_first_place() {
    let materials: Vec<Material> = (0..FEWEST)
        .flat_map(|n| {
            let level_db = -2.0 * n as f64;
            named(&format!("thing {n}"), &[level_db], level_db)
        })
        .collect();
    let prompt = score(Method::Prompt, &materials).expect("a score");
    assert_eq!((prompt.whole_db.value, prompt.rank.value), (0.0, 1.0));
    assert_eq!(prompt.whole_db.interval, [0.0, 0.0]);
    let mean = score(Method::MeanOfOthers, &materials).expect("a score");
    let [low, high] = mean.whole_db.interval;
    assert!(
        low < mean.whole_db.value && mean.whole_db.value < high,
        "{mean:?}"
    );
    assert_eq!(score(Method::OtherSpecimen, &materials), None);
}

#[test]
fn a_small_folder_has_scores_and_no_means() {
    let mut materials = Materials::default();
    for n in 0..FEWEST {
        let fewer = Comparison::of(&materials, None);
        assert!(fewer.trends.is_none() && !markdown::tables(&fewer).contains("## Spectrum"));
        materials
            .compared
            .extend(named(&format!("thing {n}"), &[n as f64], 0.0));
    }
    materials.left_out.push(("42".into(), "no word".into()));
    let all = Comparison::of(&materials, None);
    assert!(markdown::tables(&all).contains("## Spectrum"));
    assert_eq!(
        (all.materials, all.names, all.left_out.len()),
        (FEWEST, FEWEST, 1)
    );
    let trends = all.trends.expect("as many as it takes");
    assert_eq!(trends.over_force_db.measured.mean, 0.0);
    let rise_db = trends.level_db.measured.mean - trends.level_db.compiled.mean;
    assert!((rise_db - 9.5).abs() < 1e-9, "{rise_db}");
}
