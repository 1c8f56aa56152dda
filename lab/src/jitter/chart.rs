//! The sheet of a run: percentiles of every stage, and the latest tick of each interval.

use asperity_host::latency::{Run, Wakeups};
use asperity_host::servo::Stage;
use asperity_plot::{
    Axis, Canvas, Key, Marker, Panel, PlotError, Rect, Stroke, TextStyle, ink, size,
};
use hdrhistogram::Histogram;

const SIZE: (f32, f32) = (2400.0, 1000.0);
const HEADING_PX: f32 = 130.0;
/// Steps of the percentile in each half of the distance to 100 %.
const STEPS: u32 = 8;

/// The sum of the stages is wider, since its largest part lies upon it.
const TOTAL: Stroke = Stroke::new(ink::LIGHT, 2.5 * size::LINE);
const CYCLICTEST: Stroke = Stroke::category(4, size::LINE);
/// Stages that are drawn. The interval between wake-ups is about a period and would hide the
/// others. The later ones cover the earlier ones.
const DRAWN: [(Stage, Stroke, &str); 5] = [
    (Stage::Total, TOTAL, "due to written"),
    (Stage::WakeUp, Stroke::category(0, size::LINE), "wake-up"),
    (Stage::Read, Stroke::category(1, size::LINE), "read"),
    (Stage::Compute, Stroke::category(2, size::LINE), "compute"),
    (Stage::Write, Stroke::category(3, size::LINE), "write"),
];

/// Draws a run as PNG.
///
/// # Errors
/// [`PlotError`].
pub fn draw(run: &Run, cyclictest: Option<&Wakeups>) -> Result<Vec<u8>, PlotError> {
    let mut canvas = Canvas::new(SIZE.0 as u32, SIZE.1 as u32)?;
    heading(&mut canvas, run);
    let half = 0.5 * SIZE.0;
    let place = |column: f32| {
        let height = SIZE.1 - HEADING_PX;
        Rect::new(column * half, HEADING_PX, half, height)
    };
    percentiles(&mut canvas, place(0.0), run, cyclictest);
    over_time(&mut canvas, place(1.0), run);
    canvas.png()
}

fn heading(canvas: &mut Canvas, run: &Run) {
    let facts = &run.facts;
    let title = "Latency of the servo loop";
    canvas.text(title, (30.0, 62.0), &TextStyle::new(size::HEADING).bold());
    let style = TextStyle::new(size::LABEL).color(ink::GREY);
    let mut below = format!(
        "{} ticks of {} µs, {} missed",
        grouped(facts.ticks),
        facts.period_ns / 1000,
        grouped(facts.missed)
    );
    if let Some(conditions) = facts.conditions.first() {
        let granted = conditions.granted.iter();
        let mut policy = granted.filter_map(|asked| asked.strip_prefix("policy: "));
        below += &format!(
            "; {}, {}",
            policy.next_back().unwrap_or("no policy granted"),
            conditions.device
        );
        if let Some(injected) = &conditions.injected {
            below += &format!(", delay {injected}");
        }
        below += &format!("; {}", conditions.machine.kernel);
    }
    let line = canvas.fitted(&below, &style, SIZE.0 - 60.0);
    canvas.text(&line, (30.0, 106.0), &style);
}

/// A number with a comma before each three digits.
fn grouped(number: u64) -> String {
    let digits = number.to_string();
    let groups: Vec<&str> = digits
        .as_bytes()
        .rchunks(3)
        .rev()
        .filter_map(|group| std::str::from_utf8(group).ok())
        .collect();
    groups.join(",")
}

/// The stroke of the length of a period.
pub(super) fn period_stroke() -> Stroke {
    Stroke::new(ink::GREY, size::FRAME).dashed()
}

fn panel(outer: Rect, x: Axis, y: Axis, letter: char, title: &str) -> Panel {
    let panel = Panel::new(outer, x, y).letter(letter).title(title);
    let mut panel = panel.with_legend(2);
    panel.margins.right = 48.0;
    panel
}

/// µs, no less than what is drawn.
pub(super) fn us(ns: u64) -> f64 {
    (1e-3 * ns as f64).max(LOWEST_US)
}

const LOWEST_US: f64 = 0.02;

/// The axis of latencies up to the largest, µs.
fn latencies(label: &str, largest_ns: u64) -> Axis {
    Axis::log(label, LOWEST_US, 2.0 * us(largest_ns).max(1.0))
}

/// Points (percentile, µs) of a distribution, up to the largest value.
pub(super) fn curve(histogram: &Histogram<u64>) -> Vec<(f64, f64)> {
    let last = 1.0 - 1.0 / histogram.len() as f64;
    let steps = histogram.iter_quantiles(STEPS);
    let points = steps.map(|step| {
        let percentile = 100.0 * step.quantile_iterated_to().min(last);
        (percentile, us(step.value_iterated_to()))
    });
    points.collect()
}

fn percentiles(canvas: &mut Canvas, outer: Rect, run: &Run, cyclictest: Option<&Wakeups>) {
    let corrected = run.corrected(Stage::WakeUp);
    let largest = run.raw(Stage::Total).max().max(corrected.max());
    let largest = largest.max(cyclictest.map_or(0, |wakeups| wakeups.max_ns));
    let panel = panel(
        outer,
        Axis::percentiles("Percentile of the ticks (%)", run.facts.ticks.max(10)),
        latencies("Latency (µs)", largest),
        'a',
        "Percentiles",
    );
    panel.draw_frame(canvas);
    let period = us(run.facts.period_ns);
    panel.horizontal_line(canvas, period, period_stroke());
    let mut keys = Vec::new();
    for (stage, stroke, name) in DRAWN {
        panel.line(canvas, curve(&run.raw(stage)), stroke);
        keys.push((Key::Line(stroke), name));
    }
    keys.push((Key::Line(period_stroke()), "a period"));
    if let Some(wakeups) = cyclictest {
        panel.line(canvas, curve(&wakeups.counts.histogram()), CYCLICTEST);
        keys.push((Key::Line(CYCLICTEST), "cyclictest's wake-up"));
    }
    if corrected != run.raw(Stage::WakeUp) {
        let stroke = Stroke::new(ink::BLUE, size::LINE).dotted();
        panel.line(canvas, curve(&corrected), stroke);
        keys.push((Key::Line(stroke), "wake-up, corrected for omitted ticks"));
    }
    panel.legend(canvas, &keys);
}

fn over_time(canvas: &mut Canvas, outer: Rect, run: &Run) {
    let end_s = run.intervals.last();
    let end_s = end_s.map_or(1.0, |last| last.start_s + last.length_s);
    let largest = run.raw(Stage::Total).max();
    let panel = panel(
        outer,
        Axis::new("Time (s)", 0.0, end_s),
        latencies("Longest of an interval (µs)", largest),
        'b',
        "The longest of each interval, and the worst ticks",
    );
    panel.draw_frame(canvas);
    let period = us(run.facts.period_ns);
    panel.horizontal_line(canvas, period, period_stroke());
    let mut keys = Vec::new();
    for (stage, stroke, name) in DRAWN {
        let longest = run.intervals.iter().filter_map(|interval| {
            let (ns, _) = interval.stage(stage).0.last()?;
            Some((interval.start_s + 0.5 * interval.length_s, us(*ns)))
        });
        panel.line(canvas, longest, stroke);
        keys.push((Key::Line(stroke), name));
    }
    let outline = Stroke::new(ink::BLACK, size::FRAME);
    let worst = run.facts.worst.iter();
    let worst = worst.map(|tick| (tick.t_s, us(tick.total_ns)));
    let key = Key::Point(Marker::Circle, 7.0, Some(ink::PAPER), Some(outline));
    panel.keyed(canvas, worst, key);
    keys.push((Key::Line(period_stroke()), "a period"));
    keys.push((key, "the ten worst ticks"));
    panel.legend(canvas, &keys);
}
