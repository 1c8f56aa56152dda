//! Cache lines that a tick touches: `cargo run --release -p asperity-benches --bin lines`.
//!
//! A servo loop wakes once a millisecond on caches that others used meanwhile. What a tick then
//! costs is the lines that it fetches, code and data. The command runs itself under `valgrind
//! --tool=lackey` and counts the distinct lines of each tick. It needs valgrind on the PATH.
#![forbid(unsafe_code)]

use asperity_benches::{
    Rig,
    motion::Motion,
    texture::texture,
    trace::{Lines, Owner, Places, lines_of_ticks},
};
use asperity_formats::Numerator;
use std::{
    env,
    error::Error,
    hint::black_box,
    io::{BufRead, BufReader, Read, Write},
    ops::Range,
    process::{Command, Stdio},
    sync::atomic::{AtomicU8, Ordering::Relaxed},
    thread,
};

/// Ticks before the first one that counts.
const WARM_UP: u32 = 600;
/// Ticks that count: whole cycles of 6, 7 and 8 samples.
const TICKS: u32 = 336;
const TEXTURES: [(&str, usize, Numerator); 3] = [
    ("order 20, ARMA", 20, Numerator::Lsf),
    ("order 20, Nyquist zero", 20, Numerator::Nyquist),
    ("order 4, Nyquist zero", 4, Numerator::Nyquist),
];

/// Written before and after each tick that counts.
static MARK: AtomicU8 = AtomicU8::new(0);

fn main() -> Result<(), Box<dyn Error>> {
    let arguments: Vec<String> = env::args().skip(1).collect();
    if let [texture, motion] = arguments.as_slice() {
        run(texture.parse()?, motion.parse()?);
        return Ok(());
    }
    println!(
        "cache lines of 64 bytes that a tick touches: mean (most) of {TICKS} ticks ({}, release)",
        env::consts::ARCH
    );
    for (texture, (label, ..)) in TEXTURES.iter().enumerate() {
        println!("{label}");
        print!("  {:<8}{:>12}", "", "all");
        for (_, name) in Owner::ALL {
            print!("{name:>width$}", width = name.len().max(10) + 2);
        }
        println!();
        for (motion, (_, name)) in Motion::ALL.iter().enumerate() {
            print!("  {name:<8}");
            let ticks = trace(texture, motion)?;
            let sums = ticks.iter().map(|lines| lines.iter().sum::<usize>());
            print!("{:>12}", mean_and_most(sums));
            for (owner, (_, name)) in Owner::ALL.iter().enumerate() {
                let cell = mean_and_most(ticks.iter().map(|lines| lines[owner]));
                print!("{cell:>width$}", width = name.len().max(10) + 2);
            }
            println!();
        }
    }
    Ok(())
}

fn mean_and_most(counts: impl Iterator<Item = usize> + Clone) -> String {
    let (sum, most) = counts.fold((0, 0), |(sum, most), n| (sum + n, most.max(n)));
    format!("{:.1} ({most})", sum as f64 / f64::from(TICKS))
}

/// The measured program.
fn run(texture_index: usize, motion_index: usize) {
    let (_, order, numerator) = TEXTURES[texture_index];
    let motion = Motion::ALL[motion_index].0;
    let mut rig = Rig::new(&texture(order, numerator));
    let samples: Vec<_> = (0..WARM_UP + TICKS)
        .map(|tick| motion.sample(tick))
        .collect();
    let [state, slot, renderer] = rig.places();
    println!("{}", address(&raw const MARK));
    for Range { start, end } in [state, slot, renderer] {
        println!("{start}\n{end}");
    }
    // The reader of the trace has to know the places before the first tick.
    let _ = std::io::stdin().read_line(&mut String::new());
    let (warm_up, counted) = samples.split_at(WARM_UP as usize);
    for sample in warm_up {
        black_box(&rig.tick(sample));
    }
    for sample in counted {
        MARK.store(1, Relaxed);
        let output = rig.tick(sample);
        MARK.store(0, Relaxed);
        black_box(&output);
    }
}

fn address<T>(pointer: *const T) -> u64 {
    pointer.addr() as u64
}

/// Runs the measured program and counts its lines, tick by tick.
fn trace(texture: usize, motion: usize) -> Result<Vec<Lines>, Box<dyn Error>> {
    let mut child = Command::new("valgrind")
        .args(["--tool=lackey", "--trace-mem=yes"])
        .arg(env::current_exe()?)
        .args([texture.to_string(), motion.to_string()])
        .stdin(Stdio::piped())
        .stdout(Stdio::piped())
        .stderr(Stdio::piped())
        .spawn()
        .map_err(|error| format!("valgrind cannot be started ({error}); install it"))?;
    let (stdin, stdout) = (child.stdin.take(), child.stdout.take());
    let mut trace = BufReader::new(child.stderr.take().ok_or("the trace is not piped")?);
    let ticks = thread::scope(|scope| {
        let go = scope.spawn(move || {
            let places = read_places(stdout?)?;
            stdin?.write_all(b"\n").ok()?;
            Some(places)
        });
        // What comes before the first tick would fill the pipe.
        let mut line = Vec::new();
        while !go.is_finished() && trace.read_until(b'\n', &mut line)? > 0 {
            line.clear();
        }
        let places = go.join().ok().flatten();
        lines_of_ticks(
            trace,
            &places.ok_or("the program did not say where its data are")?,
        )
        .map_err(Box::<dyn Error>::from)
    })?;
    if !child.wait()?.success() || ticks.len() != TICKS as usize {
        return Err(format!("{} of {TICKS} ticks were traced", ticks.len()).into());
    }
    Ok(ticks)
}

/// Parses the measured program's output: the mark's address, then start and end of each place.
fn read_places(stdout: impl Read) -> Option<Places> {
    let mut numbers = BufReader::new(stdout)
        .lines()
        .map(|line| line.ok()?.parse().ok());
    let mut next = || numbers.next().flatten();
    let mark = next()?;
    let mut place = |owner| Some((owner, next()?..next()?));
    let ranges = [
        place(Owner::State)?,
        place(Owner::Slot)?,
        place(Owner::Renderer)?,
    ];
    Some(Places { mark, ranges })
}
