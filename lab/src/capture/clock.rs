//! From a sensor's own clock to that of the servo loop.
//!
//! A sample arrives when it was taken, or later: ports, kernels and other programs hold it back for a
//! varying time. So the arrivals over the sensor's own time lie above a line, and the line that
//! touches them from below with the least sum of distances is the sensor's clock with the least
//! delay (Moon, Skelly and Towsley, "Estimation and removal of clock skew from network delay
//! measurements", INFOCOM 1999). It is the edge of their lower convex hull over their mean.
//!
//! One stamp that was damaged on the way would pull that edge to itself. So the line is laid through
//! the longest chain of stamps that never go back: a damaged one is in it only where it lies between
//! its neighbours, and is then wrong by less than their distance.

/// Largest relative error of a sensor's stated rate.
const MOST_DRIFT: f64 = 0.01;

/// Stamps at either end of a recording, which have neighbours on one side alone.
const AT_THE_ENDS: usize = 64;
/// Steps at an end that no clock makes, in usual ones.
const LEAP: f64 = 4.0;

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

/// Which of a sensor's own times are believed: the longest chain that never goes back, without what
/// leaps at its ends. Their places, ascending. It takes n·log n steps.
#[must_use]
pub(super) fn chain(own: &[f64]) -> Vec<u32> {
    let mut chain = longest_ascent(own);
    let mut steps: Vec<f64> = chain
        .windows(2)
        .map(|pair| own[pair[1] as usize] - own[pair[0] as usize])
        .collect();
    // Of a coarse clock, several samples share a time.
    let mut moves: Vec<f64> = steps.iter().copied().filter(|step| *step > 0.0).collect();
    if moves.is_empty() || chain.len() <= 4 * AT_THE_ENDS {
        return chain;
    }
    let middle = moves.len() / 2;
    let usual = *moves.select_nth_unstable_by(middle, f64::total_cmp).1;
    let leaps = |step: &f64| *step > LEAP * usual;
    let late = steps.len() - AT_THE_ENDS;
    if let Some(at) = steps[late..].iter().position(leaps) {
        chain.truncate(late + at + 1);
        steps.truncate(late + at);
    }
    if let Some(at) = steps[..AT_THE_ENDS].iter().rposition(leaps) {
        chain.drain(..=at);
    }
    chain
}

/// Places of the longest part of a list that never descends.
fn longest_ascent(own: &[f64]) -> Vec<u32> {
    if own.is_sorted() {
        return (0..own.len() as u32).collect();
    }
    // Ends of the best chains of each length, and what comes before each place in its best chain.
    let mut ends: Vec<u32> = Vec::new();
    let mut before: Vec<u32> = Vec::with_capacity(own.len());
    for (place, &time) in own.iter().enumerate() {
        let length = ends.partition_point(|&end| own[end as usize] <= time);
        before.push(length.checked_sub(1).map_or(u32::MAX, |last| ends[last]));
        match ends.get_mut(length) {
            Some(end) => *end = place as u32,
            None => ends.push(place as u32),
        }
    }
    let mut chain = Vec::with_capacity(ends.len());
    let mut at = ends.last().copied();
    while let Some(place) = at {
        chain.push(place);
        at = before
            .get(place as usize)
            .copied()
            .filter(|&former| former != u32::MAX);
    }
    chain.reverse();
    chain
}

/// Own time and time of arrival of the newest believed sample of each batch, s; without those at the
/// ends of a long recording, where one that is damaged goes unnoticed. `batches` hold the place
/// behind their last sample, and when they arrived.
pub(super) fn arrivals(own: &[f64], chain: &[u32], batches: &[(usize, f64)]) -> Vec<(f64, f64)> {
    let ends = if chain.len() > 4 * AT_THE_ENDS {
        AT_THE_ENDS
    } else {
        0
    };
    let believed = &chain[ends..chain.len() - ends];
    let mut arrivals = Vec::with_capacity(batches.len());
    let mut from = 0;
    for &(end, at_s) in batches {
        let to = believed.partition_point(|&place| (place as usize) < end);
        if to > from {
            arrivals.push((own[believed[to - 1] as usize], at_s));
        }
        from = to;
    }
    arrivals
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
#[path = "clock_tests.rs"]
mod tests;
