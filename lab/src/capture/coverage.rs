//! Dwell time in each cell of the force-speed grid.

/// Most edges of an axis.
const MOST: usize = 17;

/// Why there is no such grid.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
#[error("{axis}: {why}")]
pub struct GridError {
    /// `speeds` or `forces`.
    pub axis: &'static str,
    /// The problem.
    pub why: String,
}

/// The grid: bands of speed by bands of force.
#[derive(Debug, Clone, PartialEq)]
pub struct Coverage {
    speeds_mm_s: Vec<f64>,
    forces_n: Vec<f64>,
    need_s: f64,
    /// Row after row, a row for each band of force.
    seconds: Vec<f64>,
}

impl Coverage {
    /// A grid between ascending edges, each of whose cells needs some seconds.
    ///
    /// # Errors
    /// [`GridError`] for edges that do not ascend, are not positive, or are fewer than two.
    pub fn new(speeds_mm_s: &[f64], forces_n: &[f64], need_s: f64) -> Result<Self, GridError> {
        for (axis, edges) in [("speeds", speeds_mm_s), ("forces", forces_n)] {
            let fail = |why: &str| {
                Err(GridError {
                    axis,
                    why: why.into(),
                })
            };
            if !(2..=MOST).contains(&edges.len()) {
                return fail(&format!(
                    "{} edges, and 2 to {MOST} make bands",
                    edges.len()
                ));
            }
            if edges.iter().any(|edge| !(1e-3..=1e4).contains(edge)) {
                return fail("an edge is outside 0.001 to 10000");
            }
            if edges.windows(2).any(|pair| pair[0] >= pair[1]) {
                return fail("the edges do not ascend");
            }
        }
        let cells = (speeds_mm_s.len() - 1) * (forces_n.len() - 1);
        Ok(Self {
            speeds_mm_s: speeds_mm_s.to_owned(),
            forces_n: forces_n.to_owned(),
            need_s,
            seconds: vec![0.0; cells],
        })
    }

    /// Bands of speed and of force.
    #[must_use]
    pub fn bands(&self) -> (usize, usize) {
        (self.speeds_mm_s.len() - 1, self.forces_n.len() - 1)
    }

    /// Edges of a band of speed, mm/s.
    #[must_use]
    pub fn speed(&self, band: usize) -> [f64; 2] {
        [self.speeds_mm_s[band], self.speeds_mm_s[band + 1]]
    }

    /// Edges of a band of force, N.
    #[must_use]
    pub fn force(&self, band: usize) -> [f64; 2] {
        [self.forces_n[band], self.forces_n[band + 1]]
    }

    /// The cell of a speed and a force: its bands.
    #[must_use]
    pub fn cell(&self, speed_mm_s: f64, force_n: f64) -> Option<(usize, usize)> {
        let band = |edges: &[f64], value: f64| {
            let last = edges[edges.len() - 1];
            (value >= edges[0] && value < last)
                .then(|| edges.partition_point(|edge| *edge <= value) - 1)
        };
        Some((
            band(&self.speeds_mm_s, speed_mm_s)?,
            band(&self.forces_n, force_n)?,
        ))
    }

    /// Adds a steady stretch; what lies outside the grid is not counted.
    pub fn add(&mut self, speed_mm_s: f64, force_n: f64, seconds: f64) {
        if let Some(cell) = self.cell(speed_mm_s, force_n) {
            let index = self.index(cell);
            self.seconds[index] += seconds;
        }
    }

    fn index(&self, (speed, force): (usize, usize)) -> usize {
        force * self.bands().0 + speed
    }

    /// Returns the fraction of its required time that a cell has, at most 1.
    #[must_use]
    pub fn part(&self, cell: (usize, usize)) -> f64 {
        (self.seconds[self.index(cell)] / self.need_s).min(1.0)
    }

    /// Cells that have all of their seconds, and cells.
    #[must_use]
    pub fn covered(&self) -> (usize, usize) {
        // Sums of tenths of a second.
        let enough = |seconds: &&f64| **seconds > self.need_s - 1e-6;
        (
            self.seconds.iter().filter(enough).count(),
            self.seconds.len(),
        )
    }

    /// The cell to stroke next: the nearest to a cell that lacks seconds; of several, the one that
    /// lacks most, then the slowest and lightest.
    #[must_use]
    pub fn next(&self, from: (usize, usize)) -> Option<(usize, usize)> {
        let (speeds, forces) = self.bands();
        let cells = (0..forces).flat_map(|force| (0..speeds).map(move |speed| (speed, force)));
        let lacking = cells.filter(|&cell| self.seconds[self.index(cell)] <= self.need_s - 1e-6);
        lacking.min_by(|&a, &b| {
            let far =
                |(speed, force): (usize, usize)| speed.abs_diff(from.0) + force.abs_diff(from.1);
            let by_seconds = || self.seconds[self.index(a)].total_cmp(&self.seconds[self.index(b)]);
            far(a).cmp(&far(b)).then_with(by_seconds)
        })
    }

    /// Seconds of every cell: a row for each band of force.
    #[must_use]
    pub fn rows(&self) -> Vec<Vec<f64>> {
        self.seconds
            .chunks(self.bands().0)
            .map(<[f64]>::to_vec)
            .collect()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn grid() -> Coverage {
        Coverage::new(&[20.0, 40.0, 80.0, 160.0], &[0.3, 0.6, 1.2], 0.5).expect("a grid")
    }

    #[test]
    fn a_cell_holds_its_lower_edges_and_not_its_upper_ones() {
        let grid = grid();
        assert_eq!(grid.cell(20.0, 0.3), Some((0, 0)));
        assert_eq!(grid.cell(39.999, 0.6), Some((0, 1)));
        assert_eq!(grid.cell(40.0, 1.199), Some((1, 1)));
        for outside in [(19.9, 0.5), (160.0, 0.5), (50.0, 1.2), (50.0, f64::NAN)] {
            assert_eq!(grid.cell(outside.0, outside.1), None);
        }
    }

    #[test]
    fn following_what_is_asked_covers_every_cell_once() {
        let mut grid = grid();
        let mut at = (2, 1);
        let mut asked = Vec::new();
        while let Some(next) = grid.next(at) {
            assert!(grid.part(next) < 1.0);
            asked.push(next);
            for _ in 0..5 {
                grid.add(
                    grid.speed(next.0)[0] + 1.0,
                    grid.force(next.1)[0] + 0.01,
                    0.1,
                );
            }
            at = next;
        }
        assert_eq!(asked.len(), 6, "{asked:?}");
        assert_eq!(asked[0], (2, 1), "it begins where the tool is");
        assert_eq!(grid.covered(), (6, 6));
    }

    #[test]
    fn strokes_outside_the_grid_cover_nothing() {
        let mut grid = grid();
        grid.add(500.0, 0.5, 100.0);
        grid.add(50.0, 9.0, 100.0);
        assert_eq!(grid.covered(), (0, 6));
        assert!(grid.rows().concat().iter().all(|seconds| *seconds == 0.0));
    }

    #[test]
    fn edges_that_make_no_bands_are_refused_by_name() {
        let refused = |speeds: &[f64], forces: &[f64]| {
            Coverage::new(speeds, forces, 1.0)
                .expect_err("no grid")
                .axis
        };
        assert_eq!(refused(&[20.0], &[0.1, 1.0]), "speeds");
        assert_eq!(refused(&[20.0, 20.0], &[0.1, 1.0]), "speeds");
        assert_eq!(refused(&[20.0, f64::NAN], &[0.1, 1.0]), "speeds");
        assert_eq!(refused(&[20.0, 40.0], &[0.0, 1.0]), "forces");
        assert_eq!(refused(&[20.0, 40.0], &[1.0, 0.5]), "forces");
    }
}
