//! A run, and a comparison of two, as JSON.

use asperity_host::latency::{Percentiles, Run, Shift, Verdict, Wakeups};
use asperity_host::servo::Stage;
use serde_json::{Map, Value, json};

/// A run: `{ticks, missed, lost, period_ns, longest_gap_ns, verdict, wakeup_ns, …, conditions,
/// worst}`. Each stage is there as recorded and as corrected for coordinated omission, in the
/// percentiles that its count carries.
#[must_use]
pub fn encode(run: &Run, verdict: &Verdict, cyclictest: Option<&Wakeups>) -> Value {
    let facts = &run.facts;
    let mut object = Map::new();
    let mut put = |key: &str, value: Value| {
        object.insert(key.to_owned(), value);
    };
    put("ticks", facts.ticks.into());
    put("missed", facts.missed.into());
    put("lost", facts.lost.into());
    put("period_ns", facts.period_ns.into());
    put("longest_gap_ns", facts.longest_gap_ns.into());
    put("verdict", json!(verdict));
    for stage in Stage::ALL {
        let name = stage.name();
        put(&format!("{name}_ns"), json!(run.percentiles(stage)));
        let corrected = Percentiles::of(&run.corrected(stage));
        put(&format!("{name}_corrected_ns"), json!(corrected));
    }
    put("worst", json!(facts.worst));
    let mut conditions = facts.conditions.iter();
    put("conditions", json!(conditions.next()));
    let others: Vec<_> = conditions.collect();
    if !others.is_empty() {
        put("other_conditions", json!(others));
    }
    if let Some(wakeups) = cyclictest {
        let wakeup_ns = Percentiles::of(&wakeups.counts.histogram());
        put(
            "cyclictest",
            json!({
                "version": wakeups.version,
                "command": wakeups.command,
                "wakeup_ns": wakeup_ns,
                "max_ns": wakeups.max_ns,
                "beyond": wakeups.beyond,
            }),
        );
    }
    Value::Object(object)
}

/// Runs side by side: an array of `{name, percentiles_ns}`.
#[must_use]
pub fn encode_runs(runs: &[(String, Run)], stage: Stage) -> Value {
    let runs = runs
        .iter()
        .map(|(name, run)| json!({ "name": name, "percentiles_ns": run.percentiles(stage) }));
    json!({ "stage": stage.name(), "runs": runs.collect::<Vec<_>>() })
}

/// A comparison: an array of shifts.
#[must_use]
pub fn encode_shifts(shifts: &[Shift]) -> Value {
    json!({ "shifts": shifts })
}
