//! Tools and sensors that are not as one would wish: a resonance, and no position along z. What an import
//! makes of their files is held against the texture that was stroked.

use asperity::{
    pipeline::Pipeline,
    sources::{
        builtin,
        recording::{self, Analysis},
    },
};
use asperity_experiments::import_accuracy::{
    self, Comparison, Performance, Resonance, Sensors, Strokes, Until,
};
use asperity_recording::{
    resonance,
    signal::{
        filter::{derivative, low_pass},
        quantile::{median, quantile},
    },
};
use asperity_tests::size::sized;
use std::sync::LazyLock;

/// Two rounds of taps.
const SECONDS: f64 = 42.0;
const SEED: u64 = 21;
/// Performance recorded by two tests, and its import with a rigid tool and a height.
static STROKED: LazyLock<Performance> = LazyLock::new(|| {
    let until = Until::Seconds(SECONDS);
    import_accuracy::perform(&builtin::texture(), Strokes::Steady, until, SEED).expect("it renders")
});
static RIGID: LazyLock<(Analysis, Comparison)> = LazyLock::new(|| imported(|_| ()));

/// Records a performance with altered sensors.
fn written(
    performance: &Performance,
    seed: u64,
    alter: impl Fn(&mut Sensors),
) -> (tempfile::TempDir, Sensors) {
    let folder = tempfile::tempdir().expect("a folder");
    let mut sensors = Sensors::seeded(seed);
    alter(&mut sensors);
    import_accuracy::record(
        performance,
        &builtin::texture(),
        &sensors,
        seed,
        folder.path(),
    )
    .expect("room");
    (folder, sensors)
}

/// The same, and what an import makes of it.
fn imported(alter: impl Fn(&mut Sensors)) -> (Analysis, Comparison) {
    let performance = &*STROKED;
    let (folder, sensors) = written(performance, SEED, alter);
    let analysis =
        recording::analyse(folder.path(), false, &mut Pipeline::default()).expect("a texture");
    let comparison =
        import_accuracy::compare(&builtin::texture(), performance, &sensors, &analysis);
    (analysis, comparison)
}

/// Median and 95 % of the cells' errors, and median of the taps', dB.
fn errors_db(comparison: &Comparison) -> (f64, f64, f64) {
    let cells = || comparison.cells.iter().map(|cell| cell.error_db);
    (
        median(cells()),
        quantile(cells(), 0.95),
        median(comparison.taps_db.iter().copied()),
    )
}

#[test]
fn a_tap_in_free_air_takes_the_resonance_away() {
    let resonance = Some(Resonance {
        freq_hz: 300.0,
        q: 8.0,
    });
    let (rigid, with_none) = &*RIGID;
    let (left, with_resonance) = imported(|s| s.resonance = resonance);
    let (found, compensated) = imported(|s| {
        (s.resonance, s.free_taps) = (resonance, 1);
    });
    assert_eq!((rigid.free_air.taps, left.free_air.taps), (0, 0));
    assert!(left.free_air.resonances.is_empty());
    assert_eq!(found.free_air.taps, 1);
    assert_eq!(found.free_air.resonances.len(), 3, "{:?}", found.free_air);
    for axis in &found.free_air.resonances {
        assert!((axis.freq_hz / 300.0 - 1.0).abs() < 0.01, "{axis:?}");
        assert!((axis.q / 8.0 - 1.0).abs() < 0.1, "{axis:?}");
    }
    let (rigid_db, left_db, compensated_db) = (
        errors_db(with_none),
        errors_db(&with_resonance),
        errors_db(&compensated),
    );
    println!("rigid {rigid_db:.2?}, left {left_db:.2?}, compensated {compensated_db:.2?} dB");
    assert!(left_db.0 > rigid_db.0 + 4.0 && left_db.2 > rigid_db.2 + 4.0);
    assert!(
        compensated_db.0 < rigid_db.0 + 0.3,
        "{compensated_db:?} {rigid_db:?}"
    );
    assert!(
        compensated_db.2 < rigid_db.2 + 0.3,
        "{compensated_db:?} {rigid_db:?}"
    );
}

#[test]
fn sensors_without_a_resonance_show_none_with_and_without_a_tap() {
    let texture = builtin::texture();
    for seed in 1..=sized("recordings", 6, 20) {
        let performance =
            import_accuracy::perform(&texture, Strokes::Steady, Until::Seconds(8.0), seed)
                .expect("it renders");
        let free_taps = (seed % 3) as usize;
        let (folder, _) = written(&performance, seed, |s| s.free_taps = free_taps);
        let (recording, checked, timeline) = recording::check(folder.path()).expect("read");
        let late_s = checked.late_of("accel.wav");
        let free_air = resonance::find(&recording, &timeline, late_s);
        assert_eq!(free_air.taps, free_taps, "seed {seed}");
        assert!(free_air.resonances.is_empty(), "seed {seed}: {free_air:?}");
    }
}

#[test]
fn without_a_height_impact_speeds_come_from_the_acceleration() {
    let performance = &*STROKED;
    let (analysis, comparison) = imported(|s| s.has_height = false);
    assert_eq!(analysis.speed_source.source, "acceleration");
    let near = |at_s: f64| {
        let apart = |tick: usize| (tick as f64 / 1000.0 - at_s).abs();
        let nearest = performance
            .impacts
            .iter()
            .min_by(|a, b| apart(a.0).total_cmp(&apart(b.0)));
        nearest.filter(|impact| apart(impact.0) < 0.02)
    };
    let ratios: Vec<f64> = analysis
        .impacts
        .iter()
        .filter_map(|impact| Some(impact.speed_m_s / near(impact.at_s)?.1 - 1.0))
        .collect();
    // The simulated accelerometer feels the hand below 8 Hz alone, so no integral could tell more.
    let height_m: Vec<f64> = performance.records.iter().map(|r| r.true_m[2]).collect();
    let fall = derivative(&low_pass(&height_m, 8.0 / 1000.0, 120));
    let felt: Vec<f64> = performance
        .impacts
        .iter()
        .map(|&(tick, speed_m_s)| {
            let before = fall[tick.saturating_sub(80)..tick].iter();
            -1000.0 * before.copied().fold(0.0, f64::min) / speed_m_s - 1.0
        })
        .collect();
    let (with_height, by_height) = &*RIGID;
    println!(
        "{} impacts of {}: {:+.3} in the median, {:.3} at 90 %, and {:+.3} of what is felt; taps {:.2?} dB, with the height {:.2?} dB; {:?}",
        ratios.len(),
        performance.impacts.len(),
        median(ratios.iter().copied()),
        quantile(ratios.iter().map(|x| x.abs()), 0.9),
        median(felt),
        comparison.taps_db,
        by_height.taps_db,
        with_height.speed_source,
    );
    assert!(ratios.len() >= 12, "{ratios:?}");
    let off = median(ratios.iter().copied());
    assert!((-0.25..0.05).contains(&off), "{off}: {ratios:?}");
    assert!(median(comparison.taps_db.iter().copied()) < 2.0);
}
