//! A long session with faults: nothing leaves its limits, no tick is lost, and all of it is
//! rendered again to the bit.

use asperity_host::device::fault_injection::InjectedFault;
use asperity_host::device::supervised::Report;
use asperity_host::fault_plan::FaultPlan;
use asperity_host::session_log::{Encoder, Ending, SessionLog, render_again};
use asperity_runtime::Config;
use asperity_tests::figures;

use super::servo::{Servo, asset, conditions, load};
use super::simulated::Simulated;

fn distance(a: [f64; 3], b: [f64; 3]) -> f64 {
    (0..3)
        .map(|axis| (a[axis] - b[axis]).powi(2))
        .sum::<f64>()
        .sqrt()
}

/// Ten minutes at 1 kHz.
const PERIODS: u64 = 600_000;

/// [`PERIODS`], or what `ASPERITY_PERIODS` says.
fn periods() -> u64 {
    let asked = std::env::var("ASPERITY_PERIODS").ok();
    asked.map_or(PERIODS, |text| {
        text.parse().expect("ASPERITY_PERIODS: a number of periods")
    })
}

#[test]
fn strokes_and_taps_with_one_percent_of_faults() {
    let bytes = asset();
    let texture = load(&bytes);
    let periods = periods();
    let limits = Config::default().limits;
    let slew_n = f64::from(limits.slew_n_s) / f64::from(Config::default().servo_rate_hz);
    // An exploration lasts about twelve seconds.
    let cycles = (periods / 10_000) as usize + 2;
    let mut servo = Servo::new(
        Simulated::new(1, cycles),
        &texture,
        FaultPlan::all(&InjectedFault::ALL, 0.01, 8),
        2,
    );
    let mut encoder = Encoder::new(Vec::new(), &conditions(&bytes, "sim:")).expect("a vector");
    let (mut began, mut ended, mut missed, mut contacts) = (0_u64, 0_u64, 0_u64, 0_u64);
    let (mut largest, mut steepest) = (0.0_f64, 0.0_f64);
    let (mut largest_rendered, mut steepest_rendered) = (0.0_f64, 0.0_f64);
    let (mut last, mut last_rendered) = ([0.0; 3], [0.0; 3]);
    for _ in 0..periods {
        let period = servo.period();
        let rendered = period.entry.force_n.map(f64::from);
        largest_rendered = largest_rendered.max(distance(rendered, [0.0; 3]));
        steepest_rendered = steepest_rendered.max(distance(rendered, last_rendered));
        last_rendered = rendered;
        // What the hand feels. A device that loses its plug loses its force at once, whoever asks.
        let felt = servo.faulty().inner().force_n();
        largest = largest.max(distance(felt, [0.0; 3]));
        if servo.faulty().running() != Some(InjectedFault::Unplugged) {
            steepest = steepest.max(distance(felt, last));
        }
        last = felt;
        contacts += u64::from(period.output.depth_m > 0.0);
        missed += u64::from(period.entry.sample.elapsed_ticks.saturating_sub(1));
        match period.report {
            Some(Report::Began(_)) => began += 1,
            Some(Report::Ended { .. }) => ended += 1,
            None => {}
        }
        encoder.push(&period.entry).expect("a vector takes all");
    }
    let counts = servo.faulty().counts().clone();
    let total: u64 = counts.values().sum();
    for kind in InjectedFault::ALL {
        assert!(counts.contains_key(&kind), "{} never ran", kind.name());
    }
    assert!(contacts > periods / 4, "the hand touched: {contacts}");

    // The converter rounds a force to a step of 12 bits over ±3.3 N, on each axis.
    let rounding_n = 3.0_f64.sqrt() * 6.6 / 4095.0;
    assert!(
        largest <= f64::from(limits.peak_n) + rounding_n,
        "{largest} N"
    );
    assert!(
        largest_rendered <= f64::from(limits.peak_n) * (1.0 + 1e-5),
        "{largest_rendered} N"
    );
    assert!(
        steepest <= slew_n * (1.0 + 1e-5) + rounding_n,
        "{steepest} N in a period"
    );
    assert!(
        steepest_rendered <= slew_n * (1.0 + 1e-5),
        "{steepest_rendered} N in a period"
    );

    // Every period had a tick, and only clock steps skipped any.
    let tally = servo.device.tally();
    let counters = *servo.state.counters();
    assert_eq!(
        (tally.periods, u64::from(counters.ticks)),
        (periods, periods)
    );
    let pending = u64::from(servo.device.device_mut().take_clock_step());
    assert_eq!(tally.missed + pending, servo.faulty().skipped());
    assert_eq!(u64::from(counters.missed_ticks), missed);
    // Bad samples are those of faults, and the period after a force that did not arrive.
    let harmless = [
        InjectedFault::Duplicate,
        InjectedFault::Stuck,
        InjectedFault::ClockStep,
    ];
    let harmful: u64 = total - harmless.map(|kind| counts[&kind]).iter().sum::<u64>();
    let bad = u64::from(counters.bad_samples);
    let after = tally.write_faults;
    assert!(
        bad <= harmful + after,
        "{bad} bad samples of {harmful} faults and {after} after them"
    );
    assert!(
        bad >= harmful - counts[&InjectedFault::WriteFailed] - 2,
        "{bad} of {harmful}"
    );
    // Each fault is reported once, and so is its end.
    assert_eq!(began, tally.episodes);
    assert!(ended == began || ended + 1 == began);
    assert!(began <= harmful && began > 0);

    let (file, summary) = encoder.finish(0).expect("a vector takes all");
    let recording = SessionLog::read(&mut &file[..]).expect("a recording");
    assert_eq!(recording.ending, Ending::Whole(summary));
    let comparison = render_again(&recording, |_| Some(bytes.clone())).expect("rendered");
    assert!(
        comparison.is_same() && comparison.compared == periods,
        "{comparison:?}"
    );
    let figures = [
        ("periods", figures::count(periods)),
        ("in_contact", figures::count(contacts)),
        ("with_a_fault", figures::count(total)),
        (
            "with_a_fault_percent",
            format!("{:.2}", 100.0 * total as f64 / periods as f64),
        ),
        ("bad_samples", figures::count(bad)),
        ("safe_states", figures::count(u64::from(counters.faults))),
        ("reports", figures::count(began)),
        ("largest_n", format!("{largest_rendered:.4}")),
        ("largest_at_the_tip_n", format!("{largest:.3}")),
        ("steepest_n", format!("{steepest_rendered:.4}")),
        ("steepest_at_the_tip_n", format!("{steepest:.3}")),
    ];
    if periods == PERIODS {
        figures::hold(
            "fault_session",
            "-p asperity-sim --test it strokes_and_taps",
            figures,
        );
    } else {
        println!("{figures:?}");
    }
}
