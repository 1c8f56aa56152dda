//! From a sensor's own clock to that of the servo loop.
//!
//! A sample arrives when it was taken, or later: ports, kernels and other programs hold it back for a
//! varying time. So the arrivals over the sensor's own time lie above a line, and the line that
//! touches them from below with the least sum of distances is the sensor's clock with the least
//! delay (Moon, Skelly and Towsley, "Estimation and removal of clock skew from network delay
//! measurements", INFOCOM 1999). It is the edge of their lower convex hull over their mean.

/// How much a rate that a sensor states may be wrong, as a fraction.
const MOST_DRIFT: f64 = 0.01;

/// Host time = `start_s` + `scale` × own time.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct ClockLine {
    /// Host time at own time 0, s.
    pub start_s: f64,
    /// Host seconds in a unit of the sensor's own time.
    pub scale: f64,
}

impl ClockLine {
    /// Host time of an own time, s.
    #[must_use]
    pub fn host_s(&self, own: f64) -> f64 {
        self.start_s + self.scale * own
    }
}

/// The line under arrivals, pairs of own time and host time in seconds, both ascending.
///
/// With `stated`, the scale that the sensor claims, a line that differs by more than a hundredth
/// gives way to one of that scale: a short recording says little about a rate. `None` for fewer than
/// two own times without a stated scale.
#[must_use]
pub fn line_under(arrivals: &[(f64, f64)], stated: Option<f64>) -> Option<ClockLine> {
    let fitted = edge(arrivals);
    let is_near = |line: &ClockLine, stated: f64| (line.scale / stated - 1.0).abs() <= MOST_DRIFT;
    match (fitted, stated) {
        (Some(line), Some(stated)) if is_near(&line, stated) => Some(line),
        (_, Some(scale)) => {
            let start_s = arrivals
                .iter()
                .map(|(own, host_s)| host_s - scale * own)
                .reduce(f64::min)?;
            Some(ClockLine { start_s, scale })
        }
        (line, None) => line.filter(|line| line.scale > 0.0),
    }
}

/// The edge of the lower convex hull over the mean own time.
fn edge(arrivals: &[(f64, f64)]) -> Option<ClockLine> {
    let mut hull: Vec<(f64, f64)> = Vec::new();
    for &point in arrivals {
        if let Some(last) = hull.last_mut()
            && last.0 >= point.0
        {
            last.1 = last.1.min(point.1);
            continue;
        }
        while let [.., a, b] = hull[..]
            && cross(a, b, point) <= 0.0
        {
            hull.pop();
        }
        hull.push(point);
    }
    let mean = arrivals.iter().map(|(own, _)| own).sum::<f64>() / arrivals.len() as f64;
    let over = hull.windows(2).find(|pair| pair[1].0 >= mean)?;
    let ((x0, y0), (x1, y1)) = (over[0], over[1]);
    let scale = (y1 - y0) / (x1 - x0);
    Some(ClockLine {
        start_s: y0 - scale * x0,
        scale,
    })
}

/// Positive where `b` lies below the line from `a` to `c`.
fn cross(a: (f64, f64), b: (f64, f64), c: (f64, f64)) -> f64 {
    (b.0 - a.0) * (c.1 - a.1) - (b.1 - a.1) * (c.0 - a.0)
}

#[cfg(test)]
mod tests {
    use super::*;
    use asperity_sim::random::unit;
    use rand_core::SeedableRng as _;
    use rand_xoshiro::Xoshiro256PlusPlus;

    /// Arrivals of a sensor that drifts by 50 ppm and is held back for 1 ms and up to 16 ms more.
    fn arrivals(period: f64) -> Vec<(f64, f64)> {
        let mut rng = Xoshiro256PlusPlus::seed_from_u64(4);
        let delayed = (0..3000).map(|n| {
            let own = f64::from(n) * 0.02 / period;
            let taken_s = 7.0 + own * period * (1.0 + 50e-6);
            (own, taken_s + 0.001 + 0.016 * unit(&mut rng))
        });
        delayed.collect()
    }

    #[test]
    fn drift_and_least_delay_come_back_from_delayed_arrivals() {
        for (period, stated) in [(1.0, Some(1.0)), (2e-4, None), (2e-4, Some(2e-4))] {
            let line = line_under(&arrivals(period), stated).expect("a line");
            for own_s in [0.0, 30.0, 60.0] {
                let error_s = line.host_s(own_s / period) - (7.001 + own_s * (1.0 + 50e-6));
                assert!((0.0..1e-3).contains(&error_s), "{error_s} s at {own_s} s");
            }
        }
    }

    #[test]
    fn a_short_recording_takes_the_stated_rate() {
        let two = [(0.0, 5.0), (100.0, 5.3)];
        let line = line_under(&two, Some(1e-3)).expect("a line");
        assert_eq!(line.scale, 1e-3);
        assert!(
            (line.host_s(100.0) - 5.1).abs() < 1e-9,
            "nothing arrives early"
        );
        assert_eq!(line_under(&two[..1], None), None);
        assert_eq!(line_under(&[], Some(1.0)), None);
        assert!(line_under(&two, None).is_some());
    }
}
