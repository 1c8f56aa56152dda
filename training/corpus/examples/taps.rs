//! Prints the tables of `docs/taps.md`: the banks of the generator, and how far its modes and heights
//! are from measured ones.
//!
//! ```console
//! $ cargo run -p asperity-corpus --example taps
//! ```

use asperity_corpus::{
    generator::{
        Physical,
        constants::{ConstantSet, Constants},
    },
    measured::{banks::Bank, modes, profiles},
    reference,
};
use std::{collections::BTreeMap, error::Error};

/// Materials of the first table, from soft to hard.
const SHOWN: [&str; 8] = [
    "memory foam",
    "kitchen sponge",
    "ribbed rubber mat",
    "printer paper",
    "planed pine",
    "ABS",
    "window glass",
    "polished steel",
];
/// A material is hard from here on, MPa.
const HARD_MPA: f64 = 500.0;

fn main() -> Result<(), Box<dyn Error>> {
    let materials = reference::physical()?;
    banks(&materials);
    modes(&materials);
    profiles(&Constants::embedded(ConstantSet::Calibrated)?, &materials);
    Ok(())
}

fn banks(materials: &BTreeMap<String, Physical>) {
    println!(
        "## Banks\n\n| material | contact, ms | centroid, Hz | cosine | peak ∝ v^ | error between speeds | nearest trace |"
    );
    println!("|---|---|---|---|---|---|---|");
    for name in SHOWN {
        let Some(physical) = materials.get(name) else {
            continue;
        };
        let bank = Bank::of(physical);
        println!(
            "| {name} | {:.2} to {:.2} | {:.0} to {:.0} | {:.2} | {:.2} | {:.1} % | {:.0} % |",
            bank.hertz_ms[0],
            bank.hertz_ms[12],
            bank.centroid_hz[0],
            bank.centroid_hz[12],
            bank.cosine,
            bank.peak_exponent,
            100.0 * bank.between[0],
            100.0 * bank.between[1],
        );
    }
    let all: Vec<(f64, Bank)> = materials
        .values()
        .map(|p| (p.modulus_mpa, Bank::of(p)))
        .collect();
    let range = |of: &dyn Fn(&Bank) -> f64, hard: bool| {
        let chosen = all
            .iter()
            .filter(|(modulus_mpa, _)| !hard || *modulus_mpa > HARD_MPA);
        chosen.fold(
            (f64::INFINITY, f64::NEG_INFINITY),
            |(low, high), (_, bank)| (low.min(of(bank)), high.max(of(bank))),
        )
    };
    let hard = all
        .iter()
        .filter(|(modulus_mpa, _)| *modulus_mpa > HARD_MPA)
        .count();
    println!("\n## Materials\n\n{}\n\n## Hard\n\n{hard}", all.len());
    println!("\n## Ranges\n\n| over all materials | from | to |\n|---|---|---|");
    for (what, hard, of) in [
        (
            "cosine between the slowest and the fastest trace",
            false,
            &(|b: &Bank| b.cosine) as &dyn Fn(&Bank) -> f64,
        ),
        ("the same above 500 MPa", true, &|b| b.cosine),
        (
            "exponent of the peak in the speed, Hertz 1.2",
            false,
            &|b| b.peak_exponent,
        ),
        (
            "contact time against Hertz's, worst speed, above 500 MPa",
            true,
            &|b| b.contact_error().unwrap_or(f64::NAN),
        ),
        ("error between speeds", false, &|b| b.between[0]),
        ("the same over the nearest trace's", false, &|b| {
            b.between[0] / b.between[1]
        }),
    ] {
        let (low, high) = range(of, hard);
        // Errors are shares.
        if what.starts_with("contact time") || what.starts_with("error") {
            println!("| {what} | {:.1} % | {:.1} % |", 100.0 * low, 100.0 * high);
        } else {
            println!("| {what} | {low:.3} | {high:.3} |");
        }
    }
}

fn modes(materials: &BTreeMap<String, Physical>) {
    println!(
        "\n## Modes\n\n| measured (objects) | ours | first mode, Hz | ours | ratio | −60 dB, ms | ours | ratio | |"
    );
    println!("|---|---|---|---|---|---|---|---|---|");
    let mut squares = [[0.0; 3]; 2];
    for (name, ours, kept_out) in modes::PAIRS {
        let (Some(physical), Some(truth)) = (materials.get(ours), modes::first(name)) else {
            continue;
        };
        let found = modes::generated(physical);
        let freq = found.freq_hz / truth.freq_hz;
        let decay = found.decay_s / truth.decay_s;
        println!(
            "| {name} ({}) | {ours} | {:.0} | {:.0} | {freq:.2} | {:.0} | {:.0} | {decay:.2} | {} |",
            truth.objects,
            truth.freq_hz,
            found.freq_hz,
            1e3 * truth.decay_s,
            1e3 * found.decay_s,
            if kept_out { "kept out" } else { "used" },
        );
        let sums = &mut squares[usize::from(kept_out)];
        sums[0] += libm::log(freq).powi(2);
        sums[1] += libm::log(decay).powi(2);
        sums[2] += 1.0;
    }
    println!("\n## Mode errors\n\n| materials | frequency | decay |\n|---|---|---|");
    for (what, [freq, decay, count]) in ["used", "kept out"].iter().zip(squares) {
        let factor = |sum: f64| libm::exp((sum / count).sqrt());
        println!("| {what} | {:.2} | {:.2} |", factor(freq), factor(decay));
    }
}

fn profiles(constants: &Constants, materials: &BTreeMap<String, Physical>) {
    println!(
        "\n## Profiles\n\n| profile | ours | third octaves, dB RMS | slope, dB/octave | ours | heights alone, dB RMS |"
    );
    println!("|---|---|---|---|---|---|");
    for (profile, ours) in profiles::PAIRS {
        let distance = materials
            .get(ours)
            .and_then(|physical| profiles::distance(constants, profile, physical));
        if let Some(distance) = distance {
            let [measured, generated] = distance.slope_db_per_octave;
            println!(
                "| {profile} | {ours} | {:.1} | {measured:.1} | {generated:.1} | {:.1} |",
                distance.rms_db, distance.heights_rms_db,
            );
        }
    }
}
