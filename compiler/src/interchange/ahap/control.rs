//! A control of all events over time: neutral before its first point, and constant after its last.
//!
//! A parameter is a step at its time. A curve goes straight from point to point, and holds its last value
//! until the next parameter or curve begins. Where one begins before the last point of another, the later
//! one takes over.

/// A parameter, which has one point, or a curve: (time, value) in order of time.
pub(super) type Part = Vec<(f64, f64)>;

/// Straight lines between points; two points of one time are a step.
#[derive(Debug)]
pub(super) struct Control {
    neutral: f64,
    points: Vec<(f64, f64)>,
}

impl Control {
    /// A control of parts in the order of the file, and how many of them end where another takes over.
    pub(super) fn new(neutral: f64, mut parts: Vec<Part>) -> (Self, usize) {
        parts.retain(|part| !part.is_empty());
        parts.sort_by(|a, b| a[0].0.total_cmp(&b[0].0));
        let mut points: Vec<(f64, f64)> = Vec::new();
        let mut cut = 0;
        for (n, part) in parts.iter().enumerate() {
            // The value before this part holds until it begins.
            let before = points.last().map_or(neutral, |last| last.1);
            points.push((part[0].0, before));
            let end = parts.get(n + 1).map_or(f64::INFINITY, |next| next[0].0);
            let inside = part.partition_point(|(t, _)| *t <= end);
            points.extend(&part[..inside]);
            if let Some(&next) = part.get(inside) {
                let last = part[inside - 1];
                points.push((end, between(last, next, end)));
                cut += 1;
            }
        }
        (Self { neutral, points }, cut)
    }

    /// The value just before a time.
    pub(super) fn before(&self, t_s: f64) -> f64 {
        self.at(self.points.partition_point(|(t, _)| *t < t_s), t_s)
    }

    /// The value from a time on.
    pub(super) fn after(&self, t_s: f64) -> f64 {
        self.at(self.points.partition_point(|(t, _)| *t <= t_s), t_s)
    }

    /// The value at a time that lies before the point `next` and not before the one before it.
    fn at(&self, next: usize, t_s: f64) -> f64 {
        match (next.checked_sub(1), self.points.get(next)) {
            (None, _) => self.neutral,
            (Some(last), None) => self.points[last].1,
            (Some(last), Some(&next)) => between(self.points[last], next, t_s),
        }
    }

    /// Times of the points between two times.
    pub(super) fn times(&self, from: f64, to: f64) -> impl ExactSizeIterator<Item = f64> + '_ {
        let first = self.points.partition_point(|(t, _)| *t <= from);
        let end = self.points.partition_point(|(t, _)| *t < to).max(first);
        self.points[first..end].iter().map(|(t, _)| *t)
    }
}

/// The line between two points; the second one's value where both have one time.
fn between((t0, a): (f64, f64), (t1, b): (f64, f64), t_s: f64) -> f64 {
    if t1 > t0 {
        a + (t_s - t0) / (t1 - t0) * (b - a)
    } else {
        b
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_control_is_neutral_before_its_first_point_steps_and_holds() {
        let curve = |points: &[(f64, f64)]| points.to_vec();
        let (control, cut) = Control::new(
            1.0,
            vec![
                curve(&[(5.0, 0.2), (6.0, 0.4)]),
                curve(&[(2.0, 0.5)]),
                curve(&[(3.0, 0.0), (3.0, 0.6), (4.0, 0.8)]),
            ],
        );
        assert_eq!(cut, 0);
        for (t_s, before, after) in [
            (0.0, 1.0, 1.0),
            (2.0, 1.0, 0.5),
            (2.9, 0.5, 0.5),
            (3.0, 0.5, 0.6),
            (3.5, 0.7, 0.7),
            (4.5, 0.8, 0.8),
            (5.0, 0.8, 0.2),
            (5.5, 0.3, 0.3),
            (9.0, 0.4, 0.4),
        ] {
            let found = [control.before(t_s), control.after(t_s)];
            let off = (found[0] - before).abs().max((found[1] - after).abs());
            assert!(off < 1e-12, "{t_s} s: {found:?}");
        }
        assert_eq!(
            control.times(2.0, 5.0).collect::<Vec<_>>(),
            [3.0, 3.0, 3.0, 4.0]
        );
        let (none, _) = Control::new(0.0, vec![Vec::new()]);
        assert_eq!((none.before(1.0), none.after(1.0)), (0.0, 0.0));
    }

    #[test]
    fn what_begins_later_takes_over() {
        let (control, cut) =
            Control::new(1.0, vec![vec![(0.0, 0.0), (4.0, 1.0)], vec![(2.0, 0.9)]]);
        assert_eq!(cut, 1);
        assert!((control.before(2.0) - 0.5).abs() < 1e-12);
        assert_eq!((control.after(2.0), control.after(4.0)), (0.9, 0.9));
    }
}
