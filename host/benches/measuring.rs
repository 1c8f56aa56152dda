//! Overhead of measuring per tick: clock reads at the end of three more stages, and a push into the
//! record queue, which another thread drains. The loop itself reads the clock once.
//!
//! `cargo bench -p asperity-host` prints ns a tick; `-- --test` checks that it runs.

use asperity_host::device::Reading;
use asperity_host::servo::{Clock as _, Monotonic, Observer as _, Record, Times, queues};
use asperity_runtime::{Flags, Output, Sample};
use std::hint::black_box;
use std::thread;
use std::time::Instant;

/// Ticks of a round; the queue has room for all of them, so that none is lost.
const TICKS: u32 = 20_000;

fn main() {
    let rounds = if std::env::args().any(|argument| argument == "--test") {
        2
    } else {
        200
    };
    let mut ns: Vec<f64> = (0..rounds).map(|_| round()).collect();
    ns.sort_by(f64::total_cmp);
    let at = |share: f64| ns[((ns.len() - 1) as f64 * share) as usize];
    println!(
        "measuring a tick: {:.0} ns in the median of {rounds} rounds of {TICKS} ticks, 10 % of the rounds above {:.0} ns",
        at(0.5),
        at(0.9)
    );
}

/// ns a tick.
fn round() -> f64 {
    let (mut record_writer, mut record_reader) = queues(TICKS as usize);
    let mut record = record();
    let clock = Monotonic::default();
    let reader = thread::spawn(move || {
        let mut taken = 0;
        while !record_reader.is_over() {
            while let Some(record) = record_reader.record() {
                taken += 1;
                black_box(record);
            }
            thread::yield_now();
        }
        assert_eq!(record_reader.lost(), 0);
        taken
    });
    let began = Instant::now();
    for tick in 0..TICKS {
        record.period = tick.into();
        record.times.read_ns = clock.now_ns();
        record.times.computed_ns = clock.now_ns();
        record.times.written_ns = clock.now_ns();
        record_writer.tick(black_box(&record));
    }
    let ns = began.elapsed().as_nanos() as f64 / f64::from(TICKS);
    drop(record_writer);
    let taken: u32 = reader.join().expect("the reader does not panic");
    assert_eq!(taken, TICKS);
    ns
}

fn record() -> Record {
    Record {
        tick: 0,
        period: 0,
        missed: 0,
        times: Times::default(),
        reading: Ok(Reading {
            position_m: [0.0; 3],
            fresh: true,
            buttons: 0,
        }),
        sample: Sample::at([0.0; 3]),
        output: Output {
            force_n: [0.0; 3],
            depth_m: 0.0,
            speed_mm_s: 0.0,
            normal_force_n: 0.0,
            vib_m_s2: 0.0,
            tap_n: 0.0,
            friction_n: 0.0,
            flags: Flags::default(),
        },
        exchanges: 0,
        written: Ok(()),
    }
}
