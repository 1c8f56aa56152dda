//! Executed instructions of a tick, exact and repeatable: `cargo run --release -p
//! asperity-benches --bin instructions`.
//!
//! Every scenario runs twice under `valgrind --tool=callgrind`, with n and with 2n ticks;
//! the difference over n is one tick, without start-up. The command also counts the ticks of
//! one cycle one by one, loading, and servo loops that are faster than the models. `instructions 1`
//! leaves these loops out: its argument is a rate in kHz. `instructions ASSET…` counts these assets in a stroke and
//! beyond their grids instead. It needs valgrind on the PATH.
#![forbid(unsafe_code)]

use asperity_benches::{
    Rig,
    callgrind::count,
    load::{Loading, Work},
    motion::Motion,
    queries::queries,
    reference::Reference,
    texture::{texture, texture_with_contact, texture_with_direction},
};
use asperity_formats::{Asset, Numerator};
use asperity_tests::{
    figures::{self, Set},
    hatt,
};
use std::{env, error::Error, fmt, fs, hint::black_box};

/// First argument of the measured program that loads.
const LOADING: &str = "load";
/// First argument of the measured program that renders an asset.
const ASSET: &str = "asset";
/// First argument of the measured program that renders the usual way.
const REFERENCE: &str = "reference";
const TICKS: u32 = 4000;
/// Servo rates over the rate of the models.
const RATIOS: [u32; 3] = [1, 5, 10];
/// The motion whose ticks are counted one by one.
const STROKE: usize = 2;
/// The motion that takes most.
const BEYOND: usize = 3;
/// Instructions that the mean tick of a motion is to take at most.
const GOAL: u64 = 700;
/// Every texture: label, AR order, numerator. Behind the walls two have a contact law, and the last one ribs.
const TEXTURES: [(&str, usize, Numerator); 7] = [
    ("order 20, ARMA", 20, Numerator::Lsf),
    ("order 20, Nyquist zero", 20, Numerator::Nyquist),
    ("order 20, AR", 20, Numerator::None),
    ("order 4, Nyquist zero", 4, Numerator::Nyquist),
    ("order 20, ARMA, contact", 20, Numerator::Lsf),
    ("order 4, zero, contact", 4, Numerator::Nyquist),
    ("order 20, ARMA, ribs", 20, Numerator::Lsf),
];
/// Number of textures that are walls.
const WALLS: usize = 4;
/// The texture with ribs.
const RIBS: usize = TEXTURES.len() - 1;

/// The bytes of a texture.
fn bytes_of(index: usize) -> Vec<u8> {
    let (_, order, numerator) = TEXTURES[index];
    match index {
        ..WALLS => texture(order, numerator),
        RIBS => texture_with_direction(order, numerator),
        _ => texture_with_contact(order, numerator),
    }
}

fn main() -> Result<(), Box<dyn Error>> {
    let arguments: Vec<String> = env::args().skip(1).collect();
    if let [LOADING, work_index, times] =
        arguments.iter().map(String::as_str).collect::<Vec<_>>()[..]
    {
        load(work_index.parse()?, times.parse()?);
        return Ok(());
    }
    if let [REFERENCE, texture_index, samples] =
        arguments.iter().map(String::as_str).collect::<Vec<_>>()[..]
    {
        reference(texture_index.parse()?, samples.parse()?);
        return Ok(());
    }
    if let [ASSET, file, motion_index, ticks] =
        arguments.iter().map(String::as_str).collect::<Vec<_>>()[..]
    {
        let ticks = ticks.parse()?;
        run(&fs::read(file)?, motion_index.parse()?, 1, ticks);
        return Ok(());
    }
    if arguments
        .first()
        .is_some_and(|argument| argument.ends_with(".asp"))
    {
        return many(&arguments);
    }
    if let [texture_index, motion_index, ratio, ticks] = arguments.as_slice() {
        run(
            &bytes_of(texture_index.parse()?),
            motion_index.parse()?,
            ratio.parse()?,
            ticks.parse()?,
        );
        return Ok(());
    }
    let asked: Option<u32> = arguments.first().map(|rate| rate.parse()).transpose()?;
    let mut at_1_khz = Vec::new();
    for ratio in RATIOS {
        if asked.is_none_or(|asked| asked == ratio) {
            let rows = table(ratio)?;
            if ratio == 1 {
                at_1_khz = rows;
            }
        }
    }
    println!("executed instructions of a sample the usual way (see `reference.rs`)");
    let mut samples = Vec::new();
    for (index, (label, ..)) in TEXTURES[..WALLS].iter().enumerate() {
        let usual = |samples: u32| count(&[REFERENCE, &index.to_string(), &samples.to_string()]);
        let a_sample = (usual(2 * TICKS)? - usual(TICKS)?) / u64::from(TICKS);
        println!("{label:<24}{a_sample:>9}");
        samples.push(a_sample);
    }
    println!("executed instructions at load");
    for (index, (_, label)) in Work::ALL.iter().enumerate() {
        let load = |times: u32| count(&[LOADING, &index.to_string(), &times.to_string()]);
        println!("{label:<32}{:>9}", (load(20)? - load(10)?) / 10);
    }
    if !at_1_khz.is_empty() {
        figures::keep("instructions", &figures(&at_1_khz, &samples))?;
    }
    Ok(())
}

/// Every texture and motion at `ratio` kHz, models at 1 kHz.
fn table(ratio: u32) -> Result<Vec<InstructionCounts>, Box<dyn Error>> {
    let mut rows = Vec::new();
    println!(
        "executed instructions a tick at {ratio} kHz ({}, release)",
        env::consts::ARCH
    );
    print!("{:<24}", "");
    for (_, motion) in Motion::ALL {
        print!("{motion:>9}");
    }
    println!("{:>9}  ticks of a cycle, stroke", "spread");
    for (texture_index, &(label, ..)) in TEXTURES.iter().enumerate() {
        print!("{label:<24}");
        let mut counts = Vec::new();
        for motion_index in 0..Motion::ALL.len() {
            let motion = |ticks| count_motion(texture_index, motion_index, ratio, ticks);
            let (once, twice) = (motion(TICKS)?, motion(2 * TICKS)?);
            let a_tick = ((twice - once) as f64 / f64::from(TICKS)).round();
            print!("{a_tick:>9.0}");
            counts.push(a_tick);
        }
        rows.push(InstructionCounts {
            label,
            ticks: counts.iter().map(|count| *count as u64).collect(),
        });
        let most = counts.iter().copied().fold(f64::MIN, f64::max);
        let least = counts.iter().copied().fold(f64::MAX, f64::min);
        print!("{:>8.1}%", (most / least - 1.0) * 100.0);
        let mut before = count_motion(texture_index, STROKE, ratio, TICKS)?;
        let mut cycle = Vec::new();
        let cycle_samples = Rig::new(&bytes_of(texture_index)).cycle_samples();
        for tick in 1..=u32::from(cycle_samples) * ratio {
            let now = count_motion(texture_index, STROKE, ratio, TICKS + tick)?;
            cycle.push(now - before);
            before = now;
        }
        if ratio == 1 {
            println!(" {cycle:?}");
        } else {
            cycle.sort_unstable();
            println!(" {} to {}", cycle[0], cycle[cycle.len() - 1]);
        }
    }
    Ok(rows)
}

/// The ticks of each asset in two motions, and their quantiles.
fn many(files: &[String]) -> Result<(), Box<dyn Error>> {
    println!("executed instructions a tick: stroke, beyond the grid, asset");
    let mut counts = [const { Vec::new() }; 2];
    for file in files {
        for (counts, motion) in counts.iter_mut().zip([STROKE, BEYOND]) {
            let motion = motion.to_string();
            let ticks = |ticks: u32| count(&[ASSET, file, &motion, &ticks.to_string()]);
            let difference = ticks(2 * TICKS)? - ticks(TICKS)?;
            let a_tick = (difference as f64 / f64::from(TICKS)).round() as u64;
            print!("{a_tick:>6}");
            counts.push(a_tick);
        }
        println!("  {file}");
    }
    let [stroke, beyond] = counts.map(Counts::of);
    println!("stroke: {stroke}\nbeyond: {beyond}");
    if files.len() == hatt::PUBLISHED {
        let figures = [
            ("least", stroke.least),
            ("median", stroke.median),
            ("most", stroke.most),
            ("most_beyond", beyond.most),
            ("above", stroke.above as u64),
        ];
        let set = Set::new(
            "asperity import hatt HATT -o hatt.aspl, asperity split hatt.aspl -o hatt, cargo run --release -p asperity-benches --bin instructions hatt/*.asp",
            figures.map(|(key, count)| (key, figures::count(count))),
        );
        let set = set.under(format!("{}, {}", env::consts::ARCH, figures::compiler()));
        let set = set.of_now(&figures::root(), vec!["runtime/src".into()])?;
        figures::keep("instructions_hatt", &set)?;
    }
    Ok(())
}

/// Instructions of several assets in a motion.
struct Counts {
    least: u64,
    median: u64,
    most: u64,
    /// Assets above the [`GOAL`].
    above: usize,
    of: usize,
}

impl Counts {
    fn of(mut counts: Vec<u64>) -> Self {
        counts.sort_unstable();
        let of = counts.len();
        Self {
            least: counts[0],
            median: counts[of / 2],
            most: counts[of - 1],
            above: counts.iter().filter(|&&count| count > GOAL).count(),
            of,
        }
    }
}

impl fmt::Display for Counts {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Self {
            least,
            median,
            most,
            above,
            of,
        } = self;
        write!(
            f,
            "{least} to {most}, median {median}; {above} of {of} above {GOAL}"
        )
    }
}

/// Executed instructions of a texture's ticks, in the order of [`Motion::ALL`].
struct InstructionCounts {
    label: &'static str,
    ticks: Vec<u64>,
}

/// Returns the figures that pages quote: the ticks at 1 kHz, and samples the usual way.
fn figures(rows: &[InstructionCounts], usual: &[u64]) -> Set {
    let count = |row: &InstructionCounts| {
        figures::count(row.ticks.iter().copied().max().unwrap_or_default())
    };
    let least = rows[0].ticks.iter().copied().min().unwrap_or_default();
    let line = |row: &InstructionCounts| {
        let cells: Vec<String> = row.ticks.iter().map(u64::to_string).collect();
        format!("| {} | {} |\n", row.label, cells.join(" | "))
    };
    let head = Motion::ALL.map(|(_, motion)| motion).join(" | ");
    let rule = "---:|".repeat(Motion::ALL.len());
    let ratio = |n: usize| {
        let ours = rows[n].ticks[STROKE];
        format!("{:.0}", usual[n] as f64 / ours as f64)
    };
    let beside = rows.iter().zip(usual).enumerate().map(|(n, (row, usual))| {
        let ours = row.ticks[STROKE];
        format!(
            "| {} | {} | {ours} | {} × |\n",
            row.label,
            figures::count(*usual),
            ratio(n)
        )
    });
    let ticks: String = rows.iter().map(line).collect();
    let beside: String = beside.collect();
    Set::new(
        "cargo run --release -p asperity-benches --bin instructions 1",
        [
            ("least", figures::count(least)),
            ("most", count(&rows[0])),
            ("times_arma", ratio(0)),
            ("times_ar", ratio(2)),
            ("ticks", format!("| texture | {head} |\n|---|{rule}\n{ticks}")),
            (
                "beside",
                format!(
                    "| executed instructions | reference: a sample | ours: the whole tick | ratio |\n\
                     |---|---:|---:|---:|\n{beside}"
                ),
            ),
        ],
    )
    .under(format!("{}, {}", env::consts::ARCH, figures::compiler()))
}

/// The measured program: loading.
fn load(work_index: usize, times: usize) {
    let mut loading = Loading::new();
    for _ in 0..times {
        black_box(loading.once(Work::ALL[work_index].0));
    }
}

/// The measured program: samples the usual way, a query each.
fn reference(texture_index: usize, samples: usize) {
    let bytes = bytes_of(texture_index);
    let asset = Asset::parse(&bytes).expect("a valid asset");
    let mut reference = Reference::new(&asset);
    for &(speed, force) in queries(&asset).iter().cycle().take(samples) {
        let (speed, force) = (black_box(speed), black_box(force));
        black_box(reference.tick(speed.into(), force.into(), 0.5));
    }
}

/// The measured program: ticks on samples made beforehand.
fn run(asset: &[u8], motion_index: usize, ratio: u32, ticks: u32) {
    let motion = Motion::ALL[motion_index].0;
    let mut rig = Rig::at(asset, 1000.0 * ratio as f32);
    // The same number of samples for n as for 2n ticks, so that the cost of making them cancels.
    let samples: Vec<_> = (0..TICKS)
        .map(|tick| motion.sample_at(tick, ratio))
        .collect();
    for sample in samples.iter().cycle().take(ticks as usize) {
        black_box(&rig.tick(sample));
    }
}

fn count_motion(
    texture: usize,
    motion: usize,
    ratio: u32,
    ticks: u32,
) -> Result<u64, Box<dyn Error>> {
    let numbers = [texture, motion, ratio as usize, ticks as usize];
    count(&numbers.map(|number| number.to_string()))
}
