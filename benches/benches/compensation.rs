//! Cost of a device profile's compensation filter: executed instructions at load, and per tick of the compensated
//! texture.
//!
//! `cargo bench -p asperity-benches --bench compensation` needs valgrind on the PATH; `-- --test` checks
//! the results and counts nothing. n and 2n turns are counted, and the difference over n is one.

use std::{env, error::Error, hint::black_box};

use asperity_benches::{Rig, callgrind::count, check, motion::Motion, texture::texture};
use asperity_formats::{Asset, Numerator};
use asperity_host::profile::Compensation;
use asperity_lab::compensation;
use asperity_runtime::HostTexture;

const TICKS: u32 = 4000;
const LOADS: u32 = 10;
const TEXTURES: [(&str, usize, Numerator); 4] = [
    ("order 20, ARMA", 20, Numerator::Lsf),
    ("order 20, zero at Nyquist", 20, Numerator::Nyquist),
    ("order 20, AR", 20, Numerator::None),
    ("order 4, zero at Nyquist", 4, Numerator::Nyquist),
];
/// Coefficients of a filter, from 0 (none) to the most.
const FILTERS: [usize; 3] = [0, 4, 8];

/// A filter of so many coefficients. The first outweighs the others together, so that its zeros lie
/// within the unit circle.
fn filter(taps: usize) -> Compensation {
    let whole = [1.2, -0.5, 0.2, -0.1, 0.05, -0.03, 0.02, -0.01];
    Compensation {
        rate_hz: 1000.0,
        taps: whole[..taps].to_vec(),
    }
}

/// A texture as `servo --profile` takes it: without a filter its bytes are not touched.
fn voiced(bytes: Vec<u8>, taps: usize) -> Vec<u8> {
    if taps == 0 {
        return bytes;
    }
    compensation::asset(&bytes, &filter(taps)).expect("the filter fits")
}

fn main() -> Result<(), Box<dyn Error>> {
    let arguments: Vec<String> = env::args().skip(1).collect();
    let asked = |option: &str| arguments.iter().any(|argument| argument == option);
    match arguments.iter().map(String::as_str).collect::<Vec<_>>()[..] {
        ["measured", work, index, taps, times] => {
            measured(work, index.parse()?, taps.parse()?, times.parse()?);
            Ok(())
        }
        // `cargo bench` says `--bench`; `cargo test` does not.
        _ if asked("--bench") && !asked("--test") => table(),
        _ => {
            for (label, order, numerator) in TEXTURES {
                for taps in FILTERS {
                    check(&voiced(texture(order, numerator), taps));
                }
                println!("{label}: sounds with and without a filter");
            }
            Ok(())
        }
    }
}

fn table() -> Result<(), Box<dyn Error>> {
    println!(
        "executed instructions by coefficients of the filter ({})",
        env::consts::ARCH
    );
    for (work, times) in [("tick", TICKS), ("slot", LOADS), ("filter", LOADS)] {
        println!(
            "{}",
            match work {
                "tick" => "a tick of a stroke at 1 kHz",
                "slot" => "bytes checked and a slot prepared",
                _ => "the filter put into the bytes",
            }
        );
        print!("{:<28}", "");
        FILTERS.iter().for_each(|taps| print!("{taps:>12}"));
        println!();
        for (index, (label, ..)) in TEXTURES.iter().enumerate() {
            print!("{label:<28}");
            for taps in FILTERS {
                let turns = |times: u32| {
                    count(&[
                        "measured",
                        work,
                        &index.to_string(),
                        &taps.to_string(),
                        &times.to_string(),
                    ])
                };
                print!(
                    "{:>12}",
                    (turns(2 * times)? - turns(times)?) / u64::from(times)
                );
            }
            println!();
        }
    }
    Ok(())
}

/// The measured program.
fn measured(work: &str, index: usize, taps: usize, times: u32) {
    let (_, order, numerator) = TEXTURES[index];
    let plain = texture(order, numerator);
    match work {
        "tick" => {
            let mut rig = Rig::new(&voiced(plain, taps));
            // As many samples for n as for 2n ticks, so that making them cancels.
            let samples: Vec<_> = (0..TICKS).map(|tick| Motion::Stroke.sample(tick)).collect();
            for sample in samples.iter().cycle().take(times as usize) {
                black_box(&rig.tick(sample));
            }
        }
        "slot" => {
            let bytes = voiced(plain, taps);
            let mut slot = Box::new(HostTexture::new());
            for _ in 0..times {
                let asset = Asset::parse(black_box(&bytes)).expect("a valid asset");
                slot.load(&asset, 1000.0).expect("it fits");
                black_box(&slot);
            }
        }
        _ => {
            // A profile without a filter is a branch that is not taken.
            for _ in 0..times {
                if taps > 0 {
                    black_box(
                        compensation::asset(black_box(&plain), &filter(taps)).expect("it fits"),
                    );
                }
            }
        }
    }
}
