//! Impact speeds without a position along z: what a hand, a surface and gravity do to an accelerometer
//! is integrated from rest to rest.

use asperity_recording::{
    check,
    impact::{self, Impact, SpeedSource},
    reader,
    signal::quantile::{median, quantile},
};
use std::{
    f64::consts::{PI, TAU},
    fmt::Write as _,
    fs,
    path::Path,
};

const RATE_HZ: f64 = 4000.0;
const BETWEEN_S: f64 = 0.8;
const TAPS: usize = 24;
const SPEEDS_M_S: [f64; 4] = [0.06, 0.11, 0.19, 0.32];
/// Height between taps, m, the time in which the surface stops the tool, in which it presses, and in
/// which the hand lifts it, s.
const HOVER_M: f64 = 0.008;
const STOP_S: f64 = 0.004;
const PRESS_S: f64 = 0.09;
const LIFT_S: f64 = 0.12;

struct Noise(u64);

impl Noise {
    /// −0.5..0.5
    fn next(&mut self) -> f64 {
        self.0 = self
            .0
            .wrapping_mul(6_364_136_223_846_793_005)
            .wrapping_add(1_442_695_040_888_963_407);
        (self.0 >> 33) as f64 / f64::from(1_u32 << 31) - 0.5
    }
}

/// When and how fast the tool lands.
fn landings(seed: u64) -> Vec<(f64, f64)> {
    let mut noise = Noise(seed);
    (0..TAPS)
        .map(|n| {
            let speed_m_s = SPEEDS_M_S[n % SPEEDS_M_S.len()] * (1.0 + 0.16 * noise.next());
            (1.2 + BETWEEN_S * n as f64 + 0.1 * noise.next(), speed_m_s)
        })
        .collect()
}

/// Acceleration along z of a tap, m/s², and height, m: from rest to the speed at which it lands as half a
/// cosine, stopped as half a sine, at rest, and up again.
fn tap((at_s, speed_m_s): (f64, f64), t_s: f64) -> (f64, f64) {
    let down_s = 2.0 * HOVER_M / speed_m_s;
    let t_s = t_s - at_s;
    // The tip sinks into the surface while it is stopped, and stays there.
    let sunk_m = -0.5 * speed_m_s * STOP_S;
    let raised = |phase: f64| phase - (TAU * phase).sin() / TAU;
    if t_s < -down_s {
        (0.0, HOVER_M)
    } else if t_s < 0.0 {
        let phase = 1.0 + t_s / down_s;
        let height_m = HOVER_M - 0.5 * speed_m_s * down_s * (phase - (PI * phase).sin() / PI);
        (
            -0.5 * speed_m_s * PI / down_s * (PI * phase).sin(),
            height_m,
        )
    } else if t_s < STOP_S {
        let phase = t_s / STOP_S;
        let a = 0.5 * speed_m_s * PI / STOP_S * (PI * phase).sin();
        (a, sunk_m * (phase + (PI * phase).sin() / PI))
    } else if t_s < PRESS_S {
        (0.0, sunk_m)
    } else if t_s < PRESS_S + LIFT_S {
        let phase = (t_s - PRESS_S) / LIFT_S;
        let way_m = HOVER_M - sunk_m;
        (
            way_m * TAU / LIFT_S.powi(2) * (TAU * phase).sin(),
            sunk_m + way_m * raised(phase),
        )
    } else {
        (0.0, HOVER_M)
    }
}

/// Writes what sensors would. The tool is tilted by 20° and sways by 2°, and the sensor has an offset.
fn record(seed: u64, with_height: bool, folder: &Path) {
    let landings = landings(seed);
    let seconds = 3.0 + BETWEEN_S * TAPS as f64;
    let strokes_s = seconds - 1.5;
    let mut noise = Noise(seed ^ 77);
    let nearest = |t_s: f64| {
        let between = |n: &&(f64, f64)| (t_s - n.0 - 0.1).abs();
        let nearest = landings
            .iter()
            .min_by(|a, b| between(a).total_cmp(&between(b)));
        tap(*nearest.expect("taps"), t_s)
    };
    let mut accel = String::from("t,az\n");
    for n in 0..(seconds * RATE_HZ) as usize {
        let t_s = n as f64 / RATE_HZ;
        let tilt: f64 = 0.35 + 0.035 * (TAU * 0.4 * t_s).sin();
        let az = nearest(t_s).0 + 9.81 * tilt.cos() + 0.3 + 0.12 * noise.next();
        let _ = writeln!(accel, "{t_s:.6},{az:.4}");
    }
    fs::write(folder.join("accel.csv"), accel).expect("written");
    let mut rest = String::from(if with_height {
        "t,x,fz,z\n"
    } else {
        "t,x,fz\n"
    });
    for n in 0..(seconds * 1000.0) as usize {
        let t_s = n as f64 / 1000.0;
        let pressed: f64 = landings
            .iter()
            .map(|(at_s, _)| {
                let since_s = t_s - at_s;
                let rise = (since_s / 0.02).clamp(0.0, 1.0);
                1.5 * rise * ((PRESS_S - since_s) / 0.02).clamp(0.0, 1.0)
            })
            .sum();
        let stroking = if t_s > strokes_s { 1.0 } else { 0.0 };
        let x_mm = 30.0 * stroking * (TAU * 0.7 * (t_s - strokes_s)).sin();
        let fz = 0.03 + pressed + stroking + 0.017 * noise.next();
        let _ = write!(rest, "{t_s:.3},{x_mm:.3},{fz:.4}");
        if with_height {
            let _ = write!(rest, ",{:.4}", 1e3 * nearest(t_s).1);
        }
        rest.push('\n');
    }
    fs::write(folder.join("rest.csv"), rest).expect("written");
    let channel = |column: &str, quantity: &str, axis: &str, unit: &str| {
        format!(
            "[[file.channel]]\ncolumn = \"{column}\"\nquantity = \"{quantity}\"\naxis = \"{axis}\"\nunit = \"{unit}\"\n"
        )
    };
    let mut text = [
        "name = \"taps\"\n[[file]]\npath = \"accel.csv\"\nclock = \"t\"\n".to_owned(),
        channel("az", "acceleration", "z", "m/s^2"),
        "[[file]]\npath = \"rest.csv\"\nclock = \"t\"\n".to_owned(),
        channel("x", "position", "x", "mm"),
        channel("fz", "force", "z", "N"),
    ]
    .concat();
    if with_height {
        text += &channel("z", "position", "z", "mm");
    }
    fs::write(folder.join("recording.toml"), text).expect("written");
}

fn found(seed: u64, with_height: bool) -> (Vec<Impact>, SpeedSource) {
    let folder = tempfile::tempdir().expect("a folder");
    record(seed, with_height, folder.path());
    let recording = reader::load(folder.path()).expect("read");
    let (checked, timeline) = check::check(&recording).expect("checked");
    let late_s = checked.late_of("accel.csv");
    let impacts = impact::impacts(&recording, &timeline, late_s);
    let source = SpeedSource::new(&timeline, &impacts);
    (impacts, source)
}

#[test]
fn the_integrated_acceleration_tells_impact_speeds_within_a_tenth() {
    let mut errors = Vec::new();
    for seed in 1..=4 {
        let (impacts, source) = found(seed, false);
        assert_eq!((source.source, source.by_both), ("acceleration", 0));
        let exact = landings(seed);
        assert_eq!(impacts.len(), exact.len());
        for (impact, (at_s, speed_m_s)) in impacts.iter().zip(exact) {
            assert!((impact.at_s - at_s).abs() < 2e-3, "{} {at_s}", impact.at_s);
            errors.push(impact.speed_m_s / speed_m_s - 1.0);
        }
    }
    let sizes = || errors.iter().map(|x: &f64| x.abs());
    println!(
        "{} impacts: {:+.3} in the median, size {:.3} in the median, {:.3} at 95 %, {:.3} at most",
        errors.len(),
        median(errors.iter().copied()),
        median(sizes()),
        quantile(sizes(), 0.95),
        sizes().fold(0.0, f64::max)
    );
    assert!(
        median(sizes()) < 0.05 && quantile(sizes(), 0.95) < 0.1,
        "{errors:.3?}"
    );
}

#[test]
fn position_and_acceleration_agree_and_the_position_is_used() {
    let (impacts, source) = found(5, true);
    println!("{source:?}");
    assert_eq!((source.source, source.by_both), ("position", impacts.len()));
    assert!(source.apart.expect("both") < 0.07, "{source:?}");
    let exact = landings(5);
    for (impact, (_, speed_m_s)) in impacts.iter().zip(exact) {
        assert!(
            (impact.speed_m_s / speed_m_s - 1.0).abs() < 0.06,
            "{} {speed_m_s}",
            impact.speed_m_s
        );
    }
}
