//! Hands that draw: their trajectories through `render` and over the simulated Touch.

use asperity::{emit::lower, views::render::render};
use asperity_formats::Asset;
use asperity_runtime::{Config, Flags, HostTexture, Limits, Renderer};
use asperity_sim::{
    axis::Pull,
    device::{Device, DeviceConfig, norm},
    hand::{Grip, GripPreset},
    servo::{RenderedTexture, Servo},
};
use asperity_tests::size::sized;
use std::{
    fmt::Write as _,
    fs,
    path::{Path, PathBuf},
};

const TEXTURES: usize = 10;
/// Seconds from the middle of each trajectory at the small size; at the full one all of it.
const SMALL_S: f64 = 5.0;
/// Shorter contacts and shorter gaps of the force are its noise, s.
const SHORTEST_S: f64 = 0.05;
/// Height of the tool in the air, m.
const HOVER_M: f64 = 2.5e-3;
/// Half the width and depth of the plane that a trajectory is folded into, mm.
const FOLD_MM: [f64; 2] = [60.0, 45.0];
/// Slowest motion that is no rest, mm/s, and how long a rest lasts at least, s.
const REST: (f64, f64) = (2.0, 0.15);
/// Peak of the Touch and of `render`, N.
const PEAK_N: f64 = 3.3;
/// Part of the landings on the simulated Touch that must tap.
const MOST_TAPPED: f64 = 0.95;
/// Change of force from tick to tick at rest that nobody calls chatter, N RMS.
const CHATTER_N: f64 = 0.02;

/// A trajectory, a row per millisecond.
struct Trajectory {
    name: String,
    at_mm: Vec<[f64; 2]>,
    /// Force of the tool, N; 0 in the air.
    force_n: Vec<f64>,
}

impl Trajectory {
    fn touches(&self, n: usize) -> bool {
        self.force_n[n] > 0.0
    }

    /// Ticks at which the force begins after the air.
    fn landings(&self) -> Vec<usize> {
        (1..self.force_n.len())
            .filter(|&n| self.touches(n) && !self.touches(n - 1))
            .collect()
    }
}

fn files(folder: &Path) -> Vec<PathBuf> {
    let mut files: Vec<PathBuf> = fs::read_dir(folder.join("drawing pictures"))
        .expect("the drawings of the repository")
        .filter_map(|entry| Some(entry.ok()?.path()))
        .filter(|path| path.extension().is_some_and(|e| e == "csv"))
        .collect();
    files.sort();
    files
}

/// Time in ms, x and y in mm, force in N and whether it counts as contact, at some 120 Hz.
fn read(file: &Path, seconds: f64) -> Option<Trajectory> {
    let text = fs::read_to_string(file).ok()?;
    let mut rows: Vec<(f64, [f64; 2], f64)> = Vec::new();
    for line in text.lines().skip(1) {
        let mut values = line.split(',').map(|v| v.trim().parse::<f64>().ok());
        let mut next = || values.next().flatten();
        let (t_ms, x, y) = (next()?, next()?, next()?);
        let (_, _, _, force_n, _, touch) = (next()?, next()?, next()?, next()?, next()?, next()?);
        let force_n = if touch > 0.0 { force_n.max(0.05) } else { 0.0 };
        rows.push((t_ms, [x, y], force_n));
    }
    let (first, last) = (rows.first()?.0, rows.last()?.0);
    let length = (last - first).min(1e3 * seconds);
    let begin = first + 0.5 * (last - first - length);
    let count = length as usize;
    let (mut at_mm, mut force_n) = (Vec::new(), Vec::new());
    let mut k = 0;
    for n in 0..count {
        let t_ms = begin + n as f64;
        while k + 2 < rows.len() && rows[k + 1].0 <= t_ms {
            k += 1;
        }
        let (a, b) = (&rows[k], &rows[k + 1]);
        let part = ((t_ms - a.0) / (b.0 - a.0).max(1.0)).clamp(0.0, 1.0);
        let between = |i: usize| a.1[i] + part * (b.1[i] - a.1[i]);
        at_mm.push([0, 1].map(|i| folded(between(i), FOLD_MM[i])));
        force_n.push(if a.2 > 0.0 && b.2 > 0.0 {
            a.2 + part * (b.2 - a.2)
        } else {
            a.2
        });
    }
    debounce(&mut force_n);
    Some(Trajectory {
        name: file.file_name()?.to_string_lossy().into_owned(),
        at_mm,
        force_n,
    })
}

/// A coordinate reflected at ±`half` as often as it takes: speeds stay.
fn folded(x: f64, half: f64) -> f64 {
    let turn = (x + half).rem_euclid(4.0 * half);
    if turn < 2.0 * half {
        turn - half
    } else {
        3.0 * half - turn
    }
}

/// Fills short gaps of contact, then takes short contacts away.
fn debounce(force_n: &mut [f64]) {
    let shortest = (1e3 * SHORTEST_S) as usize;
    for of_contact in [false, true] {
        let mut start = 0;
        while start < force_n.len() {
            let now = force_n[start] > 0.0;
            let length = force_n[start..]
                .iter()
                .take_while(|f| (**f > 0.0) == now)
                .count();
            if now == of_contact && length < shortest && start > 0 {
                let with = force_n[start - 1];
                force_n[start..start + length].fill(with);
            }
            start += length;
        }
    }
    // No contact before the air was seen.
    let first = force_n.iter().take_while(|f| **f > 0.0).count();
    force_n[..first].fill(0.0);
}

/// Totals of rendering a trajectory.
#[derive(Default)]
struct RenderTotals {
    landings: usize,
    /// Landings at which the tool meets the surface.
    met: usize,
    /// Landings with a tap.
    tapped: usize,
    /// Taps without a landing.
    stray: usize,
    peak_n: f64,
    /// Largest RMS of the change of force from tick to tick at rest, N.
    chatter_n: f64,
    /// Largest force in the air, N.
    air_n: f64,
    rests: usize,
}

impl RenderTotals {
    fn add(&mut self, other: &Self) {
        self.landings += other.landings;
        self.met += other.met;
        self.tapped += other.tapped;
        self.stray += other.stray;
        self.rests += other.rests;
        self.peak_n = self.peak_n.max(other.peak_n);
        self.chatter_n = self.chatter_n.max(other.chatter_n);
        self.air_n = self.air_n.max(other.air_n);
    }
}

/// A tick of either way: force, whether a tap began, whether the surface is touched, speed, mm/s.
struct Tick {
    force_n: [f64; 3],
    tap: bool,
    depth_m: f64,
    speed_mm_s: f64,
}

/// Counts. A tap belongs to a landing at most `late` ticks before it.
fn render_totals(trajectory: &Trajectory, ticks: &[Tick], late: usize) -> RenderTotals {
    let landings: Vec<usize> = trajectory
        .landings()
        .into_iter()
        .filter(|n| n + late < ticks.len())
        .collect();
    let taps: Vec<usize> = (0..ticks.len()).filter(|n| ticks[*n].tap).collect();
    let belongs = |tap: usize, landing: usize| (landing..=landing + late).contains(&(tap + 1));
    let mut totals = RenderTotals {
        landings: landings.len(),
        met: landings
            .iter()
            .filter(|l| ticks[**l..=**l + late].iter().any(|t| t.depth_m > 0.0))
            .count(),
        tapped: landings
            .iter()
            .filter(|l| taps.iter().any(|t| belongs(*t, **l)))
            .count(),
        stray: taps
            .iter()
            .filter(|t| !trajectory.landings().iter().any(|l| belongs(**t, *l)))
            .count(),
        ..RenderTotals::default()
    };
    totals.peak_n = ticks.iter().map(|t| norm(t.force_n)).fold(0.0, f64::max);
    // 0.1 s after the tool has left, every transient has ended.
    let mut apart = 0;
    for tick in ticks {
        apart = if tick.depth_m > 0.0 { 0 } else { apart + 1 };
        if apart > 100 {
            totals.air_n = totals.air_n.max(norm(tick.force_n));
        }
    }
    let least = (1e3 * REST.1) as usize;
    let mut still = 0;
    for n in 1..ticks.len() {
        let rests = ticks[n].depth_m > 0.0 && ticks[n].speed_mm_s < REST.0;
        still = if rests { still + 1 } else { 0 };
        // The end of a rest: the landing has died away long before.
        if still > 0 && still % least == 0 {
            totals.rests += 1;
            let span = n - least / 3..n;
            let change =
                |n: usize| norm([0, 1, 2].map(|i| ticks[n].force_n[i] - ticks[n - 1].force_n[i]));
            let squares: f64 = span.clone().map(|n| change(n).powi(2)).sum();
            totals.chatter_n = totals.chatter_n.max((squares / span.len() as f64).sqrt());
        }
    }
    totals
}

/// The asset's bytes and its stiffness.
fn through_render(bytes: &[u8], trajectory: &Trajectory, stiffness_n_m: f64) -> Vec<Tick> {
    let asset = Asset::parse(bytes).expect("an own asset");
    let mut table = String::from("t_s,x_mm,y_mm,z_mm\n");
    for (n, (at, force_n)) in trajectory.at_mm.iter().zip(&trajectory.force_n).enumerate() {
        let z_mm = if *force_n > 0.0 {
            -1e3 * force_n / stiffness_n_m
        } else {
            1e3 * HOVER_M
        };
        // Writing to a string cannot fail.
        let _ = writeln!(
            table,
            "{:.3},{:.4},{:.4},{z_mm:.5}",
            1e-3 * n as f64,
            at[0],
            at[1]
        );
    }
    let mut output = Vec::new();
    render(
        &asset,
        Some(1000.0),
        Path::new(&trajectory.name),
        table.as_bytes(),
        &mut output,
        1,
    )
    .expect("a trajectory a millisecond a row");
    let output = String::from_utf8(output).expect("a table");
    output
        .lines()
        .skip(1)
        .map(|line| {
            let values: Vec<&str> = line.split(',').collect();
            let number = |k: usize| values[k].parse::<f64>().expect("a number");
            let flags = values[11].parse::<u16>().expect("flags");
            Tick {
                force_n: [number(8), number(9), number(10)],
                tap: flags & Flags::TAP_STARTED.bits() != 0,
                depth_m: 1e-3 * number(2),
                speed_mm_s: number(3),
            }
        })
        .collect()
}

/// A hand of springs follows the trajectory and means to press as hard as the recorded one.
fn over_touch(bytes: &[u8], trajectory: &Trajectory) -> Vec<Tick> {
    let device_config = DeviceConfig::touch().expect("a built-in file");
    let grip = Grip::preset(GripPreset::Firm).expect("a built-in file");
    let asset = Asset::parse(bytes).expect("an own asset");
    let mut slot = Box::new(HostTexture::new());
    slot.load(&asset, 1000.0).expect("an own asset");
    let config = Config {
        servo_rate_hz: 1000.0,
        limits: Limits {
            peak_n: device_config.actuator.peak_force_n as f32,
            ..Config::default().limits
        },
        mechanics: device_config.mechanics_config(),
        ..Config::default()
    };
    let renderer = Renderer::new(&config).expect("a sound configuration");
    let mut servo = RenderedTexture::new(renderer, &slot, 1);
    let at = |n: usize| {
        let n = n.min(trajectory.at_mm.len() - 1);
        let [x, y] = trajectory.at_mm[n];
        let force_n = trajectory.force_n[n];
        // Where the grip's spring holds the force against the wall.
        let z_m = if force_n > 0.0 {
            -force_n / grip.stiffness_n_m
        } else {
            HOVER_M
        };
        [1e-3 * x, 1e-3 * y, z_m]
    };
    let mut device = Device::new(&device_config, grip.mass_kg, at(0));
    (0..trajectory.at_mm.len())
        .map(|n| {
            let sample = asperity_runtime::Sample::at(device.measured_m().map(|x| x as f32));
            let output = servo.tick(&sample);
            device.command(output.force_n.map(f64::from));
            let (now, next) = (at(n), at(n + 1));
            device.advance(1e-3, |t_s, _| {
                std::array::from_fn(|i| {
                    // A landing is a jump of the target, not a speed of the hand.
                    let target_m_s = if i == 2 {
                        0.0
                    } else {
                        1e3 * (next[i] - now[i])
                    };
                    Pull {
                        stiffness_n_m: grip.stiffness_n_m,
                        damping_n_s_m: grip.damping_n_s_m,
                        target_m: now[i] + t_s * target_m_s,
                        target_m_s,
                        force_n: 0.0,
                    }
                })
            });
            Tick {
                force_n: output.force_n.map(f64::from),
                tap: output.flags.contains(Flags::TAP_STARTED),
                depth_m: f64::from(output.depth_m),
                speed_mm_s: f64::from(output.speed_mm_s),
            }
        })
        .collect()
}

#[test]
#[ignore = "needs the measurements of others in ASPERITY_DRAWING_TOOLS"]
fn hands_that_draw_feel_no_chatter_and_taps_where_they_land() {
    let folder = super::folder();
    let seconds = sized("seconds of a trajectory", SMALL_S, f64::INFINITY);
    let assets: Vec<(Vec<u8>, f64)> =
        asperity_experiments::import_accuracy::materials(TEXTURES - 1)
            .expect("the own model")
            .iter()
            .map(|texture| {
                let lowered = lower::lower(texture, None).expect("an own texture");
                (lowered.bytes, texture.wall.stiffness_n_m)
            })
            .collect();
    let (mut rendered, mut felt) = (RenderTotals::default(), RenderTotals::default());
    let (mut count, mut total_s) = (0, 0.0);
    for file in files(&folder) {
        let Some(trajectory) = read(&file, seconds) else {
            continue;
        };
        count += 1;
        total_s += 1e-3 * trajectory.at_mm.len() as f64;
        for (bytes, stiffness_n_m) in &assets {
            let ticks = through_render(bytes, &trajectory, *stiffness_n_m);
            rendered.add(&render_totals(&trajectory, &ticks, 12));
            let ticks = over_touch(bytes, &trajectory);
            felt.add(&render_totals(&trajectory, &ticks, 60));
        }
    }
    println!("{count} trajectories, {total_s:.0} s, {TEXTURES} textures");
    println!(
        "| | landings | that meet the surface | with a tap | taps without a landing | peak, N | force in the air, N | rests | change of force a tick at rest, N RMS |"
    );
    println!("|---|---|---|---|---|---|---|---|---|");
    for (name, totals) in [("render", &rendered), ("simulated Touch", &felt)] {
        println!(
            "| {name} | {} | {} | {} | {} | {:.2} | {:.3} | {} | {:.3} |",
            totals.landings,
            totals.met,
            totals.tapped,
            totals.stray,
            totals.peak_n,
            totals.air_n,
            totals.rests,
            totals.chatter_n
        );
    }
    assert!(count > 0, "{}: no trajectory can be read", folder.display());
    assert_eq!(rendered.tapped, rendered.landings);
    // A hand that presses less than the device rubs does not always get down to the surface.
    assert!(felt.tapped as f64 > MOST_TAPPED * felt.met as f64);
    for totals in [&rendered, &felt] {
        assert_eq!(totals.stray, 0);
        assert!(totals.peak_n <= PEAK_N * (1.0 + 1e-6));
        assert_eq!(totals.air_n, 0.0);
        assert!(totals.rests > 0 && totals.chatter_n < CHATTER_N);
    }
}
