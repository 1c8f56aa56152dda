//! Auto-gain over a library's worth of prompts: what is felt stays within the device, and in order.

use asperity::{
    emit::lower::lower,
    learned::inference::Backend,
    passes::reduce::Fidelity,
    pipeline::Pipeline,
    sources::prompt::{Options, PromptCompiler},
};
use asperity_formats::Asset;
use asperity_tests::{figures, oracle, size::sized_or};
use rayon::prelude::*;

const QUALITIES: [&str; 20] = [
    "",
    "rough",
    "smooth",
    "wet",
    "soft",
    "hard",
    "worn",
    "polished",
    "coarse",
    "old",
    "slippery",
    "very rough",
    "slightly soft",
    "cold",
    "dusty",
    "sticky",
    "shiny",
    "damp",
    "thick",
    "extremely rough",
];
const THINGS: [&str; 50] = [
    "cork",
    "velvet",
    "steel",
    "sandpaper",
    "foam",
    "brick",
    "wire mesh",
    "leather",
    "wood",
    "ice",
    "denim",
    "marble",
    "gravel",
    "grass",
    "towel",
    "tile",
    "rubber",
    "paper",
    "glass",
    "wool",
    "sponge",
    "silk",
    "carpet",
    "concrete",
    "bark",
    "plastic",
    "cardboard",
    "felt",
    "sand",
    "snow",
    "canvas",
    "linen",
    "slate",
    "granite",
    "copper",
    "aluminium",
    "suede",
    "fur",
    "moss",
    "clay",
    "wicker",
    "bamboo",
    "asphalt",
    "plaster",
    "chalk",
    "wax",
    "tin",
    "lace",
    "corduroy",
    "fleece",
];

/// Prompts, different ones first. `ASPERITY_PROMPTS` asks for up to 1,000.
fn prompts() -> Vec<String> {
    let count = sized_or("ASPERITY_PROMPTS", "prompts", 24, 100);
    // 37 shares no factor with the number of prompts, so that each comes once.
    let all = QUALITIES.len() * THINGS.len();
    let place = |n: usize| {
        let at = n * 37 % all;
        format!(
            "{} {}",
            QUALITIES[at / THINGS.len()],
            THINGS[at % THINGS.len()]
        )
    };
    (0..count.min(all))
        .map(|n| place(n).trim().to_owned())
        .collect()
}

/// Continuous force of a Touch over its peak force, N over N.
const CONTINUOUS_SHARE: f64 = 0.88 / 3.3;

/// Forces of a texture by the oracle, before and after its gains were limited.
struct Limited {
    /// RMS of the force at the stroke of the attributes, N.
    before_n: f64,
    after_n: f64,
    /// Largest RMS of the force over the continuous one.
    share_before: f64,
    share_after: f64,
}

fn limited(prompt_compiler: &PromptCompiler, prompt: &str) -> Limited {
    let options = Options::default().without_preview();
    let compiled = prompt_compiler.compile(prompt, &options).expect(prompt);
    let before = Pipeline::default().reduce(&compiled.whole, Fidelity::Auto);
    let before = lower(&before.texture, None).expect(prompt);
    let [before, after] =
        [&before, &compiled.lowered].map(|lowered| Asset::parse(&lowered.bytes).expect(prompt));
    // Only gains differ, of which attributes know nothing; those that a report states are those of the bytes.
    let of_bytes = oracle::attributes(&after);
    assert_eq!(oracle::attributes(&before), of_bytes, "{prompt}");
    let stated = compiled.attributes();
    for (stated, found, rounding) in [
        (stated.rough_db, of_bytes.rough_db, 0.05),
        (stated.sharp_hz, of_bytes.sharp_hz, 0.5),
        (stated.hard_hz, of_bytes.hard_hz, 2.0),
        (Some(stated.mu), of_bytes.mu, 1e-3),
    ] {
        let off = stated.map(|stated| (stated - found).abs());
        assert!(
            off.is_none_or(|off| off <= rounding),
            "{prompt}: {stated:?}, {found} in bytes"
        );
    }
    let share = |asset: &Asset<'_>| {
        oracle::loudest_n(asset) / (CONTINUOUS_SHARE * f64::from(asset.coupling().f_max_n))
    };
    Limited {
        before_n: oracle::stroke_n(&before),
        after_n: oracle::stroke_n(&after),
        share_before: share(&before),
        share_after: share(&after),
    }
}

/// Gains are stored in binary32, levels in binary16.
const ROUNDING: f64 = 2e-3;

#[test]
fn auto_gain_lowers_what_is_too_loud_for_the_device_and_nothing_else() {
    let prompt_compiler =
        PromptCompiler::embedded(&Backend::Portable).expect("the shipped model loads");
    let prompts = prompts();
    let made: Vec<Limited> = prompts
        .par_iter()
        .map(|prompt| limited(&prompt_compiler, prompt))
        .collect();
    for (prompt, made) in prompts.iter().zip(&made) {
        let Limited {
            before_n,
            after_n,
            share_before,
            share_after,
        } = *made;
        assert!(
            share_after <= 1.0,
            "{prompt}: {share_after} of the continuous force"
        );
        if share_before > 1.0 {
            assert!(share_after > 0.99, "{prompt}: only {share_after} is left");
        } else {
            let change = (after_n / before_n - 1.0).abs();
            assert!(change < ROUNDING, "{prompt}: {before_n} N to {after_n} N");
        }
    }
    let loudest = made.iter().map(|made| made.share_after).fold(0.0, f64::max);
    let lowered = made
        .iter()
        .filter(|m| m.after_n < (1.0 - ROUNDING) * m.before_n)
        .count();
    println!(
        "{} textures, the loudest at {:.0} % of the continuous force, {} lowered",
        made.len(),
        100.0 * loudest,
        lowered
    );
    if made.len() == QUALITIES.len() * THINGS.len() {
        let command = format!(
            "-p asperity --test it auto_gain, with ASPERITY_PROMPTS={}",
            made.len()
        );
        let made = figures::count(made.len() as u64);
        figures::hold(
            "auto_gain",
            &command,
            [("lowered", lowered.to_string()), ("of", made)],
        );
    }
}
