//! A run, and a comparison of two, for a person.

use asperity_host::latency::{
    Conditions, Percentiles, Punctuality, QUANTILES, Run, Shift, Verdict, Wakeups,
};
use asperity_host::servo::Stage;
use asperity_io::shown::counted;
use std::fmt::Write as _;

/// The report of a run.
#[must_use]
pub fn report(run: &Run, verdict: &Verdict, cyclictest: Option<&Wakeups>) -> String {
    let facts = &run.facts;
    let mut text = format!(
        "{} with a period of {} µs, {} missed, longest gap {} µs\n{}\n",
        counted(facts.ticks, "tick", "ticks"),
        us(facts.period_ns),
        facts.missed,
        us(facts.longest_gap_ns),
        in_words(verdict),
    );
    let mut rows = Vec::new();
    for stage in Stage::ALL {
        let raw = run.percentiles(stage);
        rows.push((stage.name().to_owned(), raw));
        let corrected = Percentiles::of(&run.corrected(stage));
        if corrected != raw {
            rows.push((format!("  {}, corrected", stage.name()), corrected));
        }
    }
    if let Some(wakeups) = cyclictest {
        let mut percentiles = Percentiles::of(&wakeups.counts.histogram());
        percentiles.max = wakeups.max_ns;
        rows.push(("cyclictest's wakeup".to_owned(), percentiles));
    }
    text += &percentile_table(&rows);
    if facts.lost > 0 {
        let lost = counted(facts.lost, "tick was", "ticks were");
        let _ = writeln!(text, "\n{lost} lost and missing from the histograms");
    }
    text += "\nworst ticks, µs\n";
    let _ = writeln!(
        text,
        "{:>10} {:>10}  {:<8} {:>9} {:>9} {:>9} {:>9} {:>9}",
        "tick", "s", "stage", "total", "wakeup", "read", "compute", "write"
    );
    for tick in &facts.worst {
        let _ = writeln!(
            text,
            "{:>10} {:>10.4}  {:<8} {:>9} {:>9} {:>9} {:>9} {:>9}",
            tick.period,
            tick.t_s,
            tick.stage,
            us(tick.total_ns),
            us(tick.wakeup_ns),
            us(tick.read_ns),
            us(tick.compute_ns),
            us(tick.write_ns)
        );
    }
    for conditions in &facts.conditions {
        text += &format!("\n{}", conditions_of(conditions));
    }
    text
}

/// A row for each name, in the percentiles that a count carries.
fn percentile_table(rows: &[(String, Percentiles)]) -> String {
    let carried = |at: usize| rows.iter().any(|(_, row)| row.values()[at].is_some());
    let columns: Vec<usize> = (0..QUANTILES.len()).filter(|at| carried(*at)).collect();
    let width = rows.iter().map(|(name, _)| name.chars().count()).max();
    let width = width.unwrap_or(0).max(22);
    let mut text = format!("{:<width$}", "µs");
    for &at in &columns {
        let _ = write!(text, "{:>10}", QUANTILES[at].1);
    }
    text += &format!("{:>10}\n", "max");
    for (name, row) in rows {
        let _ = write!(text, "{name:<width$}");
        for &at in &columns {
            let value = row.values()[at].map_or_else(|| "–".to_owned(), us);
            let _ = write!(text, "{value:>10}");
        }
        text += &format!("{:>10}\n", us(row.max));
    }
    text
}

/// Runs side by side: the percentiles of a stage.
#[must_use]
pub fn side_by_side(runs: &[(String, Run)], stage: Stage) -> String {
    let rows: Vec<_> = runs
        .iter()
        .map(|(name, run)| (name.clone(), run.percentiles(stage)))
        .collect();
    format!("{}\n{}", stage.name(), percentile_table(&rows))
}

/// A run by the rule of thumb, and by the limits that were stated.
fn in_words(verdict: &Verdict) -> String {
    let rule = us(verdict.rule_ns);
    let latest = us(verdict.latest_wakeup_ns);
    let mut text = match verdict.punctuality {
        Punctuality::Punctual => format!(
            "punctual: no period missed, and no wake-up later than {rule} µs, a tenth of a period\n"
        ),
        Punctuality::Late => format!(
            "late: no period missed, but a wake-up was {latest} µs late; at most {rule} µs, a tenth of a period, is good\n"
        ),
        Punctuality::Missed => format!(
            "periods missed: {} of {} ({:.2} %), and a wake-up was {latest} µs late; none missed, and at most {rule} µs, a tenth of a period, is good\n",
            verdict.missed,
            verdict.periods,
            100.0 * verdict.missed as f64 / verdict.periods.max(1) as f64,
        ),
    };
    for exceeded in &verdict.exceeded {
        let _ = writeln!(text, "exceeded: {exceeded}");
    }
    text
}

fn conditions_of(conditions: &Conditions) -> String {
    let machine = &conditions.machine;
    let told = |value: &Option<String>| value.clone().unwrap_or_else(|| "unknown".into());
    let kind = match machine.virtual_machine {
        Some(true) => "a virtual machine",
        Some(false) => "not a virtual machine",
        None => "unknown whether it is virtual",
    };
    let or_none = |list: &[String]| {
        if list.is_empty() {
            "nothing".into()
        } else {
            list.join(", ")
        }
    };
    let mut text = format!(
        "kernel     {}, preemption {}\nmachine    {}, {}, {kind}, clock {}, load {}\n",
        machine.kernel,
        machine.preemption,
        told(&machine.processor),
        counted(machine.processors, "processor", "processors"),
        told(&machine.clock_source),
        told(&machine.load_average),
    );
    text += &format!(
        "settings   governor {}, isolated {}, nohz_full {}, rcu_nocbs {}\n",
        told(&machine.governor),
        told(&machine.isolated),
        told(&machine.nohz_full),
        told(&machine.rcu_nocbs),
    );
    text += &format!(
        "granted    {}\nrefused    {}\n",
        or_none(&conditions.granted),
        or_none(&conditions.refused)
    );
    text += &format!(
        "loop       {} Hz, overrun {}, spin {} µs, device {}, texture {}, delay {}, asperity {}\n",
        conditions.rate_hz,
        conditions.overrun,
        conditions.spin_us,
        conditions.device,
        conditions.texture,
        conditions.injected.as_deref().unwrap_or("none"),
        conditions.version
    );
    text
}

/// A comparison of two runs.
#[must_use]
pub fn shifts(shifts: &[Shift]) -> String {
    let mut text = format!(
        "{:<9} {:>7} {:>10} {:>10} {:>10}  {}\n",
        "stage", "%", "A µs", "B µs", "shift µs", "95 % confidence"
    );
    for shift in shifts {
        let confidence = match shift.confidence_ns {
            None => "too few values".to_owned(),
            Some([low, high]) => {
                let mark = if shift.is_clear() { "  clear" } else { "" };
                format!("{} to {}{mark}", signed_us(low), signed_us(high))
            }
        };
        let _ = writeln!(
            text,
            "{:<9} {:>7} {:>10} {:>10} {:>10}  {confidence}",
            shift.stage,
            shift.percentile,
            us(shift.a_ns),
            us(shift.b_ns),
            signed_us(shift.shift_ns),
        );
    }
    text
}

/// Nanoseconds as µs, with as many digits as a histogram has.
fn us(ns: u64) -> String {
    let us = 1e-3 * ns as f64;
    match ns {
        0..10_000 => format!("{us:.2}"),
        10_000..100_000 => format!("{us:.1}"),
        _ => format!("{us:.0}"),
    }
}

fn signed_us(ns: i64) -> String {
    let sign = if ns < 0 { "−" } else { "+" };
    format!("{sign}{}", us(ns.unsigned_abs()))
}
