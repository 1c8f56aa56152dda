//! Prints the tables of `docs/taps.md`: the banks of the generator, and how far its modes and heights
//! are from measured ones.
//!
//! ```console
//! $ cargo run -p asperity-corpus --example taps
//! ```

use asperity_corpus::{
    generator::Physical,
    measured::{banks::Bank, modes, profiles},
    reference::schema,
};
use std::{collections::BTreeMap, error::Error, fs, path::Path};

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
    let corpora = Path::new(env!("CARGO_MANIFEST_DIR")).join("../corpora");
    let mut materials = BTreeMap::new();
    read(&corpora, &mut materials)?;
    banks(&materials);
    modes(&materials);
    profiles(&materials);
    Ok(())
}

/// Adds the materials of every family file of a folder.
fn read(folder: &Path, materials: &mut BTreeMap<String, Physical>) -> Result<(), Box<dyn Error>> {
    for entry in fs::read_dir(folder)? {
        let path = entry?.path();
        let name = path.file_name().unwrap_or_default().to_string_lossy();
        if !name.ends_with(".toml") {
            continue;
        }
        // Files of other forms hold no materials.
        if let Ok(family) = schema::parse(&name, &fs::read_to_string(&path)?) {
            let entries = family.material.iter();
            materials.extend(entries.map(|m| (m.name.clone(), m.physical.values())));
        }
    }
    Ok(())
}

fn banks(materials: &BTreeMap<String, Physical>) {
    println!(
        "| material | contact, ms | centroid, Hz | cosine | peak ∝ v^ | error between speeds | nearest trace |"
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
    println!("\n{} materials, {hard} of them hard", all.len());
    for (what, hard, of) in [
        (
            "cosine",
            false,
            &(|b: &Bank| b.cosine) as &dyn Fn(&Bank) -> f64,
        ),
        ("cosine, hard", true, &|b| b.cosine),
        ("exponent of the peak", false, &|b| b.peak_exponent),
        ("centroid of the fastest, Hz", false, &|b| b.centroid_hz[12]),
        (
            "contact time over Hertz's, largest error, hard",
            true,
            &|b| b.contact_error().unwrap_or(f64::NAN),
        ),
        ("error between speeds", false, &|b| b.between[0]),
        ("that over the nearest trace's", false, &|b| {
            b.between[0] / b.between[1]
        }),
    ] {
        let (low, high) = range(of, hard);
        println!("{what}: {low:.3} to {high:.3}");
    }
}

fn modes(materials: &BTreeMap<String, Physical>) {
    println!(
        "\n| measured (objects) | ours | first mode, Hz | ours | ratio | −60 dB, ms | ours | ratio | |"
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
    for (what, [freq, decay, count]) in ["used", "kept out"].iter().zip(squares) {
        let factor = |sum: f64| libm::exp((sum / count).sqrt());
        println!(
            "{what}: RMS factor {:.2} in frequency, {:.2} in decay",
            factor(freq),
            factor(decay)
        );
    }
}

fn profiles(materials: &BTreeMap<String, Physical>) {
    println!(
        "\n| profile | ours | third octaves, dB RMS | slope, dB/octave | ours | heights alone, dB RMS |"
    );
    println!("|---|---|---|---|---|---|");
    for (profile, ours) in profiles::PAIRS {
        let distance = materials
            .get(ours)
            .and_then(|physical| profiles::distance(profile, physical));
        if let Some(distance) = distance {
            let [measured, generated] = distance.slope_db_per_octave;
            println!(
                "| {profile} | {ours} | {:.1} | {measured:.1} | {generated:.1} | {:.1} |",
                distance.rms_db, distance.heights_rms_db,
            );
        }
    }
}
