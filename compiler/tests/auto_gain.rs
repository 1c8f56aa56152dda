//! Auto-gain over a library's worth of prompts: what is felt stays within the device, and in order.

use asperity::{
    attributes::{self, Attributes},
    ceiling::CONTINUOUS_SHARE,
    inference::Backend,
    mixture::Field,
    model::TextureModel,
    pipeline::Pipeline,
    prompt::{Options, PromptCompiler},
    raise::raise,
    reduce::Fidelity,
};
use asperity_formats::Asset;
use asperity_tests::size::sized_or;
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

/// Places on each axis of a grid, and frequencies, at which the level is summed up.
const PLACES: usize = 12;
const FREQUENCIES: usize = 256;

/// Largest RMS of the vibration's force over the grid, N, by the mean of its power density.
fn loudest_n(texture: &TextureModel) -> f64 {
    let grid = &texture.grid;
    let field = Field::new(grid);
    let far = |of: fn(&(f64, f64)) -> f64| {
        let all = grid.vertices.iter().map(|v| (v.speed_mm_s, v.force_n));
        all.map(|place| of(&place)).fold(0.0, f64::max)
    };
    let (fastest, firmest) = (far(|p| p.0), far(|p| p.1));
    let mut loudest = 0.0_f64;
    for n in 0..PLACES * PLACES {
        let share = |k: usize| k as f64 / (PLACES - 1) as f64;
        let (v, f) = (share(n % PLACES) * fastest, share(n / PLACES) * firmest);
        let Some(weights) = field.locate(v, f) else {
            continue;
        };
        let model = field.model(&weights);
        let hz = |k: usize| (k as f64 + 0.5) / FREQUENCIES as f64 * 0.5 * grid.sample_rate_hz;
        let power: f64 = (0..FREQUENCIES).map(|k| model.power(hz(k))).sum();
        loudest = loudest.max((power / FREQUENCIES as f64).sqrt());
    }
    texture.gains.vib_s2_m * texture.gains.f_max_n * loudest
}

/// An attribute's name, what it is, and by how much the numbers of an asset may round it.
type Scale = (&'static str, fn(&Attributes) -> f64, f64);

const SCALES: [Scale; 4] = [
    (
        "rough, dB",
        |a| a.rough_db.unwrap_or(f64::NEG_INFINITY),
        0.02,
    ),
    ("sharp, Hz", |a| a.sharp_hz.unwrap_or(0.0), 0.5),
    ("hard, Hz", |a| a.hard_hz.unwrap_or(0.0), 2.0),
    ("μ", |a| a.mu, 1e-3),
];

#[test]
fn every_texture_stays_within_the_continuous_force_and_attributes_keep_their_order() {
    let prompt_compiler =
        PromptCompiler::embedded(&Backend::Portable).expect("the shipped model loads");
    let options = Options::default().without_preview();
    let made: Vec<(Attributes, Attributes, f64, bool)> = prompts()
        .par_iter()
        .map(|prompt| {
            let compiled = prompt_compiler.compile(prompt, &options).expect(prompt);
            let before = Pipeline::default().reduce(&compiled.whole, Fidelity::Auto);
            let asset = Asset::parse(&compiled.lowered.bytes).expect(prompt);
            let kept = raise(&asset);
            let share = loudest_n(&kept) / (CONTINUOUS_SHARE * kept.gains.f_max_n);
            assert!(share <= 1.0, "{prompt}: {share} of the continuous force");
            let lowered = kept.gains.vib_s2_m < 0.999 * compiled.whole.gains.vib_s2_m;
            (
                attributes::of(&before.texture),
                attributes::of(&kept),
                share,
                lowered,
            )
        })
        .collect();
    let loudest = made.iter().map(|made| made.2).fold(0.0, f64::max);
    let lowered = made.iter().filter(|made| made.3).count();
    println!(
        "{} textures, the loudest at {:.0} % of the continuous force, {lowered} lowered",
        made.len(),
        100.0 * loudest
    );
    for (name, scale, rounding) in SCALES {
        let mut pairs: Vec<(f64, f64)> = made.iter().map(|m| (scale(&m.0), scale(&m.1))).collect();
        pairs.sort_by(|a, b| a.0.total_cmp(&b.0));
        let mut highest = f64::NEG_INFINITY;
        for (before, after) in pairs {
            assert!(
                after >= highest - rounding,
                "{name}: {before} came to {after}"
            );
            highest = highest.max(after);
        }
    }
}
