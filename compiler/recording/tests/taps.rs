//! Taps whose truth is known come back: a hand taps at four speeds, and sensors write what they would.

use asperity_recording::{
    check,
    impact::{self, TAP_RATE_HZ, TAP_SAMPLES, Transient},
    reader,
    signal::quantile::median,
};
use std::{
    f64::consts::{PI, TAU},
    fmt::Write as _,
    fs,
    path::Path,
};

const SPEEDS_M_S: [f64; 4] = [0.06, 0.11, 0.19, 0.32];
const TAPS_OF_A_SPEED: usize = 6;
const ACCEL_HZ: f64 = 5000.0;
const BETWEEN_S: f64 = 0.7;
/// Height between taps, m, and the time in which the hand changes its speed, s.
const HOVER_M: f64 = 0.008;
const HAND_S: f64 = 0.025;
/// Full scale of the WAV, m/s².
const RANGE_M_S2: f64 = 157.0;
/// Band of third octaves, Hz, and how far below the strongest one still counts, dB.
const BAND_HZ: (f64, f64) = (60.0, 1600.0);
const DEPTH_DB: f64 = 20.0;

/// A surface: contact time at 0.1 m/s, s, and the part of the peak that rings at 420 Hz.
#[derive(Clone, Copy)]
struct Surface {
    contact_s: f64,
    ring: f64,
}

const HARD: Surface = Surface {
    contact_s: 0.0012,
    ring: 0.3,
};
const SOFT: Surface = Surface {
    contact_s: 0.005,
    ring: 0.0,
};

impl Surface {
    /// Acceleration after an impact, m/s²: Hertz's pulse, whose impulse is 5 % of the speed and whose
    /// time falls as v^(−1/5), and a mode.
    fn tap(self, speed_m_s: f64, t_s: f64) -> f64 {
        if !(0.0..0.01).contains(&t_s) {
            return 0.0;
        }
        let contact_s = self.contact_s * (speed_m_s / 0.1_f64).powf(-0.2);
        let peak = 0.05 * speed_m_s / (0.5564 * contact_s);
        let pulse = (PI * (t_s / contact_s).min(1.0)).sin().max(0.0).powf(1.5);
        let fade = (0.5 * PI * ((t_s - 0.008) / 0.002).clamp(0.0, 1.0)).cos();
        let ring = (-t_s / 0.002).exp() * (TAU * 420.0 * t_s).sin();
        peak * (pulse + self.ring * ring) * fade
    }
}

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
fn landings() -> Vec<(f64, f64)> {
    let mut noise = Noise(9);
    (0..TAPS_OF_A_SPEED * SPEEDS_M_S.len())
        .map(|n| {
            let speed_m_s = SPEEDS_M_S[n % SPEEDS_M_S.len()] * (1.0 + 0.16 * noise.next());
            (1.0 + BETWEEN_S * n as f64 + 0.02 * noise.next(), speed_m_s)
        })
        .collect()
}

/// When the hand changes its speed for a tap, and by how much, m/s: down, stop, up again, stop.
fn bends(at_s: f64, speed_m_s: f64) -> [(f64, f64); 4] {
    let up_m_s = HOVER_M / 0.1;
    [
        (at_s - HOVER_M / speed_m_s, -speed_m_s),
        (at_s, speed_m_s),
        (at_s + 0.06, up_m_s),
        (at_s + 0.16, -up_m_s),
    ]
}

/// Writes what sensors would: acceleration with gravity, the hand and noise at 5 kHz and 24 bits,
/// force with a bias, and the position in steps of 0.05 mm, 1 ms late.
fn record(surface: Surface, folder: &Path) {
    let landings = landings();
    let seconds = 2.5 + BETWEEN_S * landings.len() as f64;
    let strokes_s = seconds - 1.2;
    let mut noise = Noise(4);
    let spec = hound::WavSpec {
        channels: 1,
        sample_rate: ACCEL_HZ as u32,
        bits_per_sample: 24,
        sample_format: hound::SampleFormat::Int,
    };
    let mut wav = hound::WavWriter::create(folder.join("accel.wav"), spec).expect("a file");
    for n in 0..(seconds * ACCEL_HZ) as usize {
        let t_s = n as f64 / ACCEL_HZ;
        let a: f64 = landings
            .iter()
            .filter(|(at_s, _)| (t_s - at_s).abs() < 0.5)
            .map(|(at_s, speed_m_s)| {
                let hand: f64 = bends(*at_s, *speed_m_s)
                    .into_iter()
                    .map(|(bend_s, slope)| {
                        slope / (HAND_S * PI.sqrt()) * (-((t_s - bend_s) / HAND_S).powi(2)).exp()
                    })
                    .sum();
                hand + surface.tap(*speed_m_s, t_s - at_s)
            })
            .sum();
        let sample = (9.81 + a + 0.14 * noise.next()) / RANGE_M_S2;
        wav.write_sample((sample * f64::from(1 << 23)).round() as i32)
            .expect("written");
    }
    wav.finalize().expect("written");
    let mut csv = String::from("t,x,z,fx,fz\n");
    for n in 0..(seconds * 1000.0) as usize {
        let t_s = n as f64 / 1000.0;
        let pressed = |at_s: f64, speed_m_s: f64, t_s: f64| {
            let part = (t_s - at_s) / 0.06;
            if (0.0..1.0).contains(&part) {
                (0.5 + 6.0 * speed_m_s) * (PI * part).sin()
            } else {
                0.0
            }
        };
        let height_m = |t_s: f64| {
            let down: f64 = landings
                .iter()
                .flat_map(|&(at_s, speed_m_s)| bends(at_s, speed_m_s))
                .map(|(bend_s, slope)| slope * (t_s - bend_s).max(0.0))
                .sum();
            HOVER_M + down
        };
        let load: f64 = landings
            .iter()
            .map(|&(at_s, speed_m_s)| pressed(at_s, speed_m_s, t_s))
            .sum();
        let stroking = if t_s > strokes_s { 1.0 } else { 0.0 };
        let z_mm = 1e3 * height_m(t_s - 0.001);
        let x_mm = 30.0 * stroking * (TAU * 0.7 * (t_s - strokes_s)).sin();
        let _ = writeln!(
            csv,
            "{t_s:.3},{x_mm:.3},{:.3},{:.4},{:.4}",
            (z_mm / 0.05).round() * 0.05,
            0.01 * noise.next(),
            0.03 + load + stroking + 0.017 * noise.next(),
        );
    }
    fs::write(folder.join("rest.csv"), csv).expect("written");
    let channel = |column: &str, quantity: &str, axis: &str, unit: &str| {
        format!(
            "[[file.channel]]\ncolumn = {column}\nquantity = \"{quantity}\"\naxis = \"{axis}\"\nunit = \"{unit}\"\n"
        )
    };
    let text = [
        "name = \"taps\"\n[[file]]\npath = \"accel.wav\"\n".to_owned(),
        channel("0", "acceleration", "z", "m/s^2"),
        format!("scale = {RANGE_M_S2}\n[[file]]\npath = \"rest.csv\"\nclock = \"t\"\n"),
        channel("\"x\"", "position", "x", "mm"),
        channel("\"z\"", "position", "z", "mm"),
        channel("\"fx\"", "force", "x", "N"),
        channel("\"fz\"", "force", "z", "N"),
    ];
    fs::write(folder.join("recording.toml"), text.concat()).expect("written");
}

/// Energy in third octaves, dB.
fn third_octaves(trace: &[f64]) -> Vec<f64> {
    let mut bands = Vec::new();
    let mut low = BAND_HZ.0;
    while low < BAND_HZ.1 {
        let high = low * 2_f64.cbrt();
        let energy: f64 = (0..8)
            .map(|n| {
                let omega = TAU * (low + (high - low) * (f64::from(n) + 0.5) / 8.0) / TAP_RATE_HZ;
                let part = |turn: fn(f64) -> f64| -> f64 {
                    trace
                        .iter()
                        .enumerate()
                        .map(|(k, x)| x * turn(omega * k as f64))
                        .sum()
                };
                part(f64::cos).powi(2) + part(f64::sin).powi(2)
            })
            .sum();
        bands.push(10.0 * (energy / 8.0).max(1e-30).log10());
        low = high;
    }
    bands
}

/// RMS over third octaves of a transient against the truth, level included, dB.
fn error_db(surface: Surface, transient: &Transient) -> f64 {
    let truth: Vec<f64> = (0..TAP_SAMPLES)
        .map(|n| surface.tap(transient.speed_m_s, n as f64 / TAP_RATE_HZ))
        .collect();
    let (exact, found) = (third_octaves(&truth), third_octaves(&transient.accel_m_s2));
    let strongest = exact.iter().copied().fold(f64::NEG_INFINITY, f64::max);
    let squares: Vec<f64> = exact
        .iter()
        .zip(&found)
        .filter(|(e, _)| **e > strongest - DEPTH_DB)
        .map(|(e, f)| (e - f).powi(2))
        .collect();
    (squares.iter().sum::<f64>() / squares.len() as f64).sqrt()
}

/// Results of an import: impacts with their speeds, and transients.
fn found(surface: Surface) -> (Vec<impact::Impact>, Vec<Transient>) {
    let folder = tempfile::tempdir().expect("a folder");
    record(surface, folder.path());
    let recording = reader::load(folder.path()).expect("read");
    let (checked, timeline) = check::check(&recording).expect("checked");
    let late_s = checked.late_of("accel.wav");
    let impacts = impact::impacts(&recording, &timeline, late_s);
    let transients = impact::transients(&impacts);
    (impacts, transients)
}

#[test]
fn taps_come_back_within_two_decibels_of_hard_and_soft_surfaces() {
    for surface in [HARD, SOFT] {
        let (impacts, transients) = found(surface);
        assert_eq!(transients.len(), SPEEDS_M_S.len(), "{impacts:?}");
        let errors: Vec<f64> = transients.iter().map(|t| error_db(surface, t)).collect();
        println!("{errors:.2?} dB");
        assert!(median(errors.iter().copied()) < 1.0, "{errors:?}");
        assert!(errors.iter().all(|error| *error < 2.0), "{errors:?}");
    }
}

#[test]
fn impacts_are_found_when_and_as_fast_as_they_were() {
    let (impacts, _) = found(HARD);
    let exact = landings();
    assert_eq!(impacts.len(), exact.len());
    for (impact, (at_s, speed_m_s)) in impacts.iter().zip(exact) {
        assert!((impact.at_s - at_s).abs() < 3e-4, "{} {at_s}", impact.at_s);
        let off = impact.speed_m_s / speed_m_s;
        assert!((off - 1.0).abs() < 0.06, "{speed_m_s}: {off}");
    }
}

/// The runtime mixes the traces of the next slower and the next faster speed.
#[test]
fn a_mixture_of_recorded_traces_beats_the_nearest_at_a_speed_that_was_left_out() {
    for surface in [HARD, SOFT] {
        let (_, transients) = found(surface);
        assert_eq!(transients.len(), SPEEDS_M_S.len());
        for triple in transients.windows(3) {
            let [slow, left_out, fast] = [&triple[0], &triple[1], &triple[2]];
            let w = (left_out.speed_m_s - slow.speed_m_s) / (fast.speed_m_s - slow.speed_m_s);
            let apart = |trace: &dyn Fn(usize) -> f64| -> f64 {
                (0..TAP_SAMPLES)
                    .map(|n| (trace(n) - left_out.accel_m_s2[n]).powi(2))
                    .sum()
            };
            let mixed = apart(&|n| (1.0 - w) * slow.accel_m_s2[n] + w * fast.accel_m_s2[n]);
            let nearest = apart(&|n| slow.accel_m_s2[n]).min(apart(&|n| fast.accel_m_s2[n]));
            println!("{mixed:.2} {nearest:.2}");
            assert!(mixed < 0.5 * nearest, "{mixed} {nearest}");
        }
    }
}
