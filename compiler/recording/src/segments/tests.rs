//! Spans of made timelines, spectra against their definitions.

use super::{spans::IN_AIR, spectra::lags, stationary::WHITENER, *};
use crate::{
    signal::{noise::white, spectrum::hann},
    test_recordings::{near, timeline},
};
use std::f64::consts::TAU;

/// Levels of the parts of a steady stretch.
const EVEN: [f64; PARTS] = [1.0; PARTS];

fn steady_spans(made: &Timeline) -> Vec<(usize, usize)> {
    spans(made, &usable(made), STEADY)
}

#[test]
fn a_steady_stroke_is_cut_into_spans_that_overlap_by_half() {
    let mut made = timeline(2000);
    made.contact[..100].fill(false);
    // Sixty samples of contact are left to the landing.
    assert_eq!(
        steady_spans(&made),
        [
            (160, 800),
            (560, 800),
            (960, 800),
            (1360, 640),
            (1680, 320),
            (1840, 160)
        ]
    );
}

/// The spans of 600 samples with a change at 350, in contact throughout.
fn changed(change: impl Fn(&mut Timeline)) -> Vec<(usize, usize)> {
    let mut made = timeline(600);
    change(&mut made);
    steady_spans(&made)
}

#[test]
fn a_span_ends_where_something_changes_and_the_next_one_begins_behind_it() {
    // Usable from 60 on; starts are multiples of ten until one is found.
    let whole = [(60, 540), (330, 270), (465, 135)];
    let parted = [(60, 290), (205, 145), (357, 243), (478, 122)];
    assert_eq!(changed(|_| ()), whole);
    assert_eq!(changed(|t| t.speed_mm_s[350..].fill(90.0)), parted);
    assert_eq!(changed(|t| t.load_n[350..].fill(2.0)), parted);
    // A bad sample is left out, a landing and what follows it as well.
    assert_eq!(
        changed(|t| t.good[350] = false),
        [(60, 290), (205, 145), (357, 243), (478, 122)]
    );
    assert_eq!(
        changed(|t| t.contact[350] = false),
        [(60, 290), (205, 145), (417, 183)]
    );
}

#[test]
fn speed_and_load_may_change_within_their_bounds_and_no_further() {
    let holds = |speeds: [f64; 2], loads: [f64; 2]| {
        changed(|t| {
            for (values, pair) in [(&mut t.speed_mm_s, speeds), (&mut t.load_n, loads)] {
                values[..350].fill(pair[0]);
                values[350..].fill(pair[1]);
            }
        })[0]
            == (60, 540)
    };
    let (speed, load) = ([50.0; 2], [1.0; 2]);
    // 15 % of the sum of both.
    assert!(holds([50.0, 67.6], load) && !holds([50.0, 67.7], load));
    assert!(holds([67.6, 50.0], load) && !holds([67.7, 50.0], load));
    assert!(holds(speed, [1.0, 1.352]) && !holds(speed, [1.0, 1.354]));
    assert!(holds(speed, [1.352, 1.0]) && !holds(speed, [1.354, 1.0]));
    // Or 10 mm/s and 0.16 N.
    assert!(holds([10.0, 19.9], load) && !holds([10.0, 20.1], load));
    assert!(holds(speed, [0.2, 0.359]) && !holds(speed, [0.2, 0.361]));
    // 8 mm/s is no stroke.
    assert!(holds([8.1, 12.0], load));
    assert!(changed(|t| t.speed_mm_s.fill(8.0)).is_empty());
}

#[test]
fn the_shortest_span_has_a_hundred_samples() {
    let found = |count: usize| {
        let mut made = timeline(400);
        made.good[160 + count..].fill(false);
        made.contact[..100].fill(false);
        steady_spans(&made)
    };
    assert_eq!(found(100), [(160, 100)]);
    assert!(found(99).is_empty());
    // A timeline may end with one.
    let mut made = timeline(160);
    made.good[..60].fill(false);
    assert_eq!(steady_spans(&made), [(60, 100)]);
}

#[test]
fn the_air_is_cut_into_quarters_of_a_second_that_keep_away_from_contact() {
    let mut made = timeline(1000);
    made.contact.fill(false);
    let starts = |made: &Timeline| -> Vec<usize> {
        let found = in_air(made);
        assert!(found.iter().all(|(_, length)| *length == 250));
        found.into_iter().map(|(start, _)| start).collect()
    };
    assert_eq!(starts(&made), [0, 125, 250, 375, 500, 625, 750]);
    made.contact[400] = true;
    assert_eq!(starts(&made), [0, 125, 500, 625, 750]);
    made.contact[400] = false;
    made.good[399] = false;
    assert_eq!(starts(&made), [0, 125, 499, 624, 749]);
    made.good.fill(false);
    assert!(starts(&made).is_empty());
}

#[test]
fn time_that_two_segments_share_is_covered_once() {
    let segment = |start, length| Segment {
        start,
        length,
        speed_mm_s: 0.0,
        force_n: 0.0,
        lags: Vec::new(),
        power: Vec::new(),
        is_steady: true,
        statistic: 0.0,
    };
    let steady = Segments {
        segments: vec![segment(100, 400), segment(300, 400), segment(900, 100)],
        ..Segments::default()
    };
    near(steady.covered_s(), 0.7, 1e-12);
    assert_eq!(Segments::default().covered_s(), 0.0);
}

#[test]
fn the_frequencies_fill_the_band_in_even_steps() {
    let hz = frequencies_hz();
    assert_eq!(hz.len(), POINTS);
    let bin = 1000.0 / 2048.0;
    for (n, expected) in [
        (0, 29.0),
        (1, 32.0),
        (2, 36.0),
        (3, 40.0),
        (100, 426.0),
        (222, 911.0),
        (223, 915.0),
    ] {
        near(hz[n], expected * bin, 1e-9);
    }
}

/// |Σ x e^(−iωn)|² by its definition.
fn transformed(signal: &[f64], bin: usize) -> f64 {
    let (mut re, mut im) = (0.0, 0.0);
    for (n, x) in signal.iter().enumerate() {
        let (s, c) = libm::sincos(TAU * (bin * n % 2048) as f64 / 2048.0);
        re += x * c;
        im -= x * s;
    }
    re * re + im * im
}

#[test]
fn power_and_autocorrelation_are_those_of_their_definitions() {
    let axes: Vec<Vec<f64>> = (1..=2)
        .map(|seed| white(seed, 300, 3).iter().map(|x| x + 0.7).collect())
        .collect();
    let (start, length) = (40, 120);
    let (lags, power) = Analyser::new().spectrum(&axes, start, length);
    let window = hann(length);
    let energy: f64 = window.iter().map(|w| w * w).sum();
    let mut whole = vec![0.0; 1025];
    for axis in &axes {
        let stretch = &axis[start..start + length];
        let level = stretch.iter().sum::<f64>() / length as f64;
        let tapered: Vec<f64> = (0..length)
            .map(|n| (stretch[n] - level) * window[n])
            .collect();
        for (bin, sum) in whole.iter_mut().enumerate() {
            *sum += transformed(&tapered, bin) / energy;
        }
    }
    // 14, 26, 424 and 448 Hz are bins 28, 53, 868 and 917.
    let of = |values: &[f64]| values.iter().sum::<f64>() / values.len() as f64;
    let (low, high) = (of(&whole[28..53]), of(&whole[868..917]));
    whole[..28].fill(low);
    whole[917..].fill(high);
    for (hz, found) in frequencies_hz().iter().zip(&power) {
        let expected = whole[(hz * 2.048).round() as usize];
        near(*found, expected, 1e-9 * expected.max(1.0));
    }
    for (lag, found) in lags.iter().enumerate() {
        let turn = |bin: usize| libm::cos(TAU * (bin * lag) as f64 / 2048.0);
        let ends = whole[0] + whole[1024] * turn(1024);
        let middle: f64 = (1..1024).map(|bin| 2.0 * whole[bin] * turn(bin)).sum();
        let of_window: f64 = (lag..length).map(|n| window[n] * window[n - lag]).sum();
        near(*found, (ends + middle) / 2048.0 * energy / of_window, 1e-8);
    }
    assert_eq!((lags.len(), power.len()), (LAGS + 1, POINTS));
}

#[test]
fn a_flat_spectrum_has_one_lag_and_a_cosine_another() {
    let flat = lags(&[1.0; 1025]);
    near(flat[0], 1.0, 1e-12);
    assert!(flat[1..].iter().all(|r| r.abs() < 1e-9));
    let cosine: Vec<f64> = (0..1025)
        .map(|n| 1.0 + libm::cos(TAU * 5.0 * f64::from(n) / 2048.0))
        .collect();
    for (lag, r) in lags(&cosine).into_iter().enumerate() {
        let expected = [1.0, 0.0, 0.0, 0.0, 0.0, 0.5].get(lag).copied();
        near(r, expected.unwrap_or(0.0), 1e-9);
    }
}

fn of_lags(scale: f64, pole: f64) -> Segment {
    Segment {
        start: 0,
        length: 100,
        speed_mm_s: 0.0,
        force_n: 0.0,
        lags: (0..=LAGS)
            .map(|k| scale * libm::pow(pole, k as f64))
            .collect(),
        power: Vec::new(),
        is_steady: true,
        statistic: 0.0,
    }
}

#[test]
fn the_whitener_of_a_process_of_the_first_order_is_its_denominator() {
    let found = whitener(&[of_lags(1.0, 0.5), of_lags(30.0, 0.5), of_lags(0.0, 0.9)]);
    assert_eq!(found.len(), WHITENER + 1);
    near(found[0], 1.0, 1e-12);
    near(found[1], -0.5, 1e-5);
    assert!(found[2..].iter().all(|a| a.abs() < 1e-5));
    // Loud and soft segments count alike: the mean of r₁ is 0.4.
    let mixed = whitener(&[of_lags(1.0, 0.2), of_lags(900.0, 0.6)]);
    let mean_1 = mixed[1];
    let swapped = whitener(&[of_lags(900.0, 0.2), of_lags(1.0, 0.6)]);
    near(mean_1, swapped[1], 1e-12);
    assert_eq!(whitener(&[]), [1.0]);
    assert_eq!(whitener(&[of_lags(0.0, 0.5)]), [1.0]);
}

#[test]
fn bartletts_statistic_of_known_energies_is_known() {
    // In turn up and down; the last quarter is twice as loud. A start that matters.
    let sign = |n: usize| if n.is_multiple_of(2) { 1.0 } else { -1.0 };
    let loud = |from: usize| -> Vec<f64> {
        (0..500)
            .map(|n| sign(n) * if n >= from { 2.0 } else { 1.0 })
            .collect()
    };
    near(
        bartlett(&[loud(350)], 50, 400, &[1.0], EVEN),
        84.862_9,
        1e-3,
    );
    near(bartlett(&[loud(500)], 50, 400, &[1.0], EVEN), 0.0, 1e-9);
    // Axes add their energies: 2, 2, 2, 5 of the mean 2.75.
    let both = [loud(350), loud(500)];
    let exact =
        100.0 * (3.0 * libm::log(2.75 / 2.0) + libm::log(2.75 / 5.0)) / (1.0 + 5.0 / 1200.0);
    near(bartlett(&both, 50, 400, &[1.0], EVEN), exact, 1e-9);
    // A ramp that a difference makes even, and silence.
    let ramp: Vec<f64> = (0..500).map(|n| 3.0 * f64::from(n)).collect();
    near(
        bartlett(std::slice::from_ref(&ramp), 50, 400, &[1.0, -1.0], EVEN),
        0.0,
        1e-9,
    );
    assert!(bartlett(&[ramp], 50, 400, &[1.0], EVEN) > 100.0);
    assert_eq!(
        bartlett(&[vec![2.0; 500]], 50, 400, &[1.0, -1.0], EVEN),
        f64::INFINITY
    );
}

#[test]
fn what_is_louder_than_the_quiet_quarter_by_a_third_is_no_rest() {
    let air = |levels: &[f64]| {
        levels
            .iter()
            .map(|l| (vec![*l], vec![]))
            .collect::<Vec<_>>()
    };
    let kept = |levels: &[f64]| -> Vec<f64> {
        at_rest(air(levels))
            .into_iter()
            .map(|(lags, _)| lags[0])
            .collect()
    };
    assert_eq!(kept(&[5.0, 1.0, 1.31, 1.0, 1.29, 2.0]), [1.0, 1.0, 1.29]);
    assert_eq!(average(&[vec![1.0, 4.0], vec![2.0, 8.0]]), [1.5, 6.0]);
    assert!(average(&[]).is_empty());
}

#[test]
fn a_stroke_of_even_noise_is_kept_and_one_with_a_burst_is_rejected() {
    let mut made = timeline(2000);
    made.contact[1200..].fill(false);
    made.speed_mm_s[..1200].fill(60.0);
    made.load_n[..1200].fill(2.0);
    let even = white(3, 2000, 12);
    let found = segments(&made, std::slice::from_ref(&even));
    assert_eq!(
        (found.rejected, found.segments.len()),
        (0, steady_spans(&made).len())
    );
    for segment in &found.segments {
        near(segment.speed_mm_s, 60.0, 1e-9);
        near(segment.force_n, 2.0, 1e-9);
        assert!(segment.statistic < LARGEST_STATISTIC && segment.statistic > 0.0);
    }
    let power = |x: &[f64]| x.iter().map(|x| x * x).sum::<f64>() / x.len() as f64;
    let noise = found.noise_lags.expect("air")[0];
    assert!((noise / power(&even[1200..]) - 1.0).abs() < 0.2, "{noise}");
    assert_eq!(found.noise_power.expect("air").len(), POINTS);
    let mut burst = even.clone();
    burst[100..160].iter_mut().for_each(|a| *a *= 6.0);
    let found = segments(&made, &[burst]);
    assert!(found.rejected >= 1 && found.segments.iter().all(|s| s.start > 60));
    // Nothing in the air, and no vibration: nothing is known of the noise, and no segment is left.
    let found = segments(&timeline(1000), &[vec![0.0; 1000]]);
    assert!(found.noise_lags.is_none() && found.segments.is_empty() && found.rejected > 0);
}

#[test]
fn vibration_is_what_is_faster_than_a_hand() {
    let mut made = timeline(3000);
    let tone = |hz: f64, n: usize| libm::sin(TAU * hz * n as f64 / RATE_HZ);
    made.accel_m_s2 = vec![
        (0..3000).map(|n| 5.0 + 3.0 * tone(3.0, n)).collect(),
        (0..3000).map(|n| tone(100.0, n)).collect(),
    ];
    let found = vibration(&made);
    assert_eq!(found.len(), 2);
    assert!(found[0][500..2500].iter().all(|a| a.abs() < 0.01));
    for (n, a) in found[1].iter().enumerate().take(2500).skip(500) {
        near(*a, tone(100.0, n), 0.01);
    }
}

/// A stroke whose speed rises and falls by 500 mm/s² between 30 and 180 mm/s, the vibration in
/// proportion.
fn swinging() -> (Timeline, Vec<f64>) {
    let mut made = timeline(6000);
    made.contact.fill(true);
    for (n, speed) in made.speed_mm_s.iter_mut().enumerate() {
        let away = (n % 600) as f64 - 300.0;
        *speed = 30.0 + 0.5 * away.abs();
    }
    let noise = white(5, 6000, 12);
    let vibration = noise
        .iter()
        .zip(&made.speed_mm_s)
        .map(|(noise, speed)| noise * speed / 100.0)
        .collect();
    (made, vibration)
}

#[test]
fn strokes_of_changing_speed_count_at_the_speeds_that_they_cover() {
    let (made, vibration) = swinging();
    let found = segments(&made, std::slice::from_ref(&vibration));
    let changing: Vec<&Segment> = found.segments.iter().filter(|s| !s.is_steady).collect();
    assert!(found.covered_s() > 5.0, "{} s", found.covered_s());
    assert!(changing.len() > 40 && found.rejected * 20 < found.segments.len());
    // σ² of the noise is ⅓ of its square, and that of the vibration follows v².
    let power = |x: &[f64]| x.iter().map(|x| x * x).sum::<f64>() / x.len() as f64;
    let even = power(&white(5, 6000, 12));
    let ratios: Vec<f64> = changing
        .iter()
        .map(|s| s.lags[0] / (even * (s.speed_mm_s / 100.0).powi(2)))
        .collect();
    // 0.2 dB are 5 %; a single segment of 0.1 s is known to a fifth.
    let mean = mean(&ratios);
    assert!((0.97..1.07).contains(&mean), "{mean}");
    let slowest = changing
        .iter()
        .map(|s| s.speed_mm_s)
        .fold(f64::INFINITY, f64::min);
    let fastest = changing.iter().map(|s| s.speed_mm_s).fold(0.0, f64::max);
    assert!(slowest < 50.0 && fastest > 130.0, "{slowest} {fastest}");
}

#[test]
fn a_knock_in_a_stroke_of_changing_speed_is_rejected() {
    let (made, even) = swinging();
    let mut knocked = even.clone();
    knocked[3100..3125].iter_mut().for_each(|a| *a *= 8.0);
    let count = |axis: &Vec<f64>| {
        let found = segments(&made, std::slice::from_ref(axis));
        let over = |s: &Segment| s.start < 3125 && s.start + s.length > 3100;
        (
            found.segments.iter().filter(|s| over(s)).count(),
            found.rejected,
        )
    };
    let (kept, rejected) = count(&even);
    assert!(kept > 0);
    assert_eq!(count(&knocked), (0, rejected + kept));
}

#[test]
fn levels_follow_the_power_law_of_the_recording() {
    let (made, vibration) = swinging();
    let found = segments(&made, &[vibration]);
    let law = Law::of(&found.segments);
    let segment = found
        .segments
        .iter()
        .find(|s| !s.is_steady && s.length == 160);
    let segment = segment.expect("a long one");
    let levels = law.levels(&made, segment);
    let part = segment.length / PARTS;
    for (index, level) in levels.into_iter().enumerate() {
        let from = segment.start + index * part;
        let speed = mean(&made.speed_mm_s[from..from + part]);
        let exact = (speed / segment.speed_mm_s).powi(2);
        assert!((level / exact - 1.0).abs() < 0.15, "{level} {exact}");
    }
    assert_eq!(Law::of(&[]), Law::default());
}

#[test]
fn the_noise_of_the_sensors_is_known_to_two_percent_in_spite_of_knocks() {
    let analyser = Analyser::new();
    let mut axes: Vec<Vec<f64>> = (1..=3).map(|seed| white(seed, 20_000, 12)).collect();
    let exact: f64 = axes
        .iter()
        .map(|axis| axis.iter().map(|x| x * x).sum::<f64>() / axis.len() as f64)
        .sum();
    // Every fifth stretch has a knock.
    for start in (0..20_000).step_by(5 * IN_AIR) {
        for (n, a) in axes[0][start + 100..start + 140].iter_mut().enumerate() {
            *a += 20.0 * libm::sin(n as f64);
        }
    }
    let air: Vec<_> = (0..20_000 / IN_AIR)
        .map(|n| analyser.spectrum(&axes, n * IN_AIR, IN_AIR))
        .collect();
    let all = air.len();
    let rest = at_rest(air);
    assert!(rest.len() > 3 * all / 4, "{} of {all}", rest.len());
    let (lags, power): (Vec<_>, Vec<_>) = rest.into_iter().unzip();
    let (level, flat) = (average(&lags)[0], mean(&average(&power)));
    assert!((level / exact - 1.0).abs() < 0.02, "{level} {exact}");
    assert!((flat / exact - 1.0).abs() < 0.02, "{flat} {exact}");
}
