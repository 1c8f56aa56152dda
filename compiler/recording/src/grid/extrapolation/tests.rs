use super::*;
use crate::{
    grid::{Choice, Form, build, simulated::segments},
    segments::POINTS,
};
use asperity_formats::limits::{MAX_TRIANGLES, MAX_VERTICES};
use asperity_texture::model::{ModelGrid, Numerator, mesh, mixture::Field};

/// Segments of half a second of white vibration whose mean power is a function of speed and force.
fn strokes(speeds: (f64, f64), forces: (f64, f64), power: impl Fn(f64, f64) -> f64) -> Segments {
    let segments = segments(5, 120, (speeds, forces), |v, f, _| power(v, f));
    Segments {
        segments,
        ..Segments::default()
    }
}

fn grid(strokes: &Segments) -> ModelGrid {
    let choice = Choice {
        form: Form {
            order: 4,
            numerator: Numerator::None,
        },
        width: 0.5,
        beyond: Slopes::new(strokes),
    };
    let all: Vec<&Segment> = strokes.segments.iter().collect();
    build(strokes, &all, choice).expect("a grid").0
}

/// Power of the grid over another one, dB.
fn over_db(grid: &ModelGrid, place: (f64, f64), power: f64) -> f64 {
    let field = Field::new(grid);
    let at = field.locate(place.0, place.1).expect("a triangle");
    let vibration = field.model(&at).vibration();
    10.0 * libm::log10(vibration.map_or(1e-30, |v| v.power) / power)
}

#[test]
fn a_power_law_goes_on_beyond_what_was_visited_and_rest_is_silent() {
    let law = |v: f64, f: f64| libm::pow(v / 100.0, 1.6) * libm::pow(f, 0.8);
    let grid = grid(&strokes((40.0, 160.0), (0.5, 2.0), law));
    // A quarter of the slowest speed may be louder: speeds count as ln(v + 3 mm/s), which alone is 1 dB.
    for (v, f, most_db) in [
        (20.0, 1.0, 2.0),
        (10.0, 1.0, 3.0),
        (210.0, 1.0, 2.0),
        (80.0, 0.25, 2.0),
        (80.0, 2.7, 2.0),
    ] {
        let off_db = over_db(&grid, (v, f), law(v, f));
        assert!(off_db.abs() < most_db, "{v} mm/s, {f} N: {off_db} dB");
    }
    for place in [(0.0, 1.0), (80.0, 0.0), (0.0, 0.0)] {
        assert!(over_db(&grid, place, 1.0) < -200.0, "{place:?}");
    }
}

#[test]
fn a_level_that_speed_and_force_do_not_change_stays_beyond_what_was_visited() {
    let grid = grid(&strokes((40.0, 160.0), (0.5, 2.0), |_, _| 1.0));
    for (v, f) in [
        (20.0, 1.0),
        (10.0, 1.0),
        (220.0, 1.0),
        (80.0, 0.25),
        (80.0, 2.8),
    ] {
        let off_db = over_db(&grid, (v, f), 1.0);
        assert!(off_db.abs() < 1.0, "{v} mm/s, {f} N: {off_db} dB");
    }
}

#[test]
fn any_visited_range_makes_a_grid_within_the_limits_that_is_not_much_louder() {
    let steep = |v: f64, f: f64| libm::pow(v / 100.0, 6.0) * libm::pow(f, -3.0);
    for (speeds, forces) in [
        ((40.0, 160.0), (0.5, 2.0)),
        ((99.0, 101.0), (1.0, 1.0)),
        ((8.0, 9_000.0), (0.03, 500.0)),
    ] {
        let strokes = strokes(speeds, forces, steep);
        let grid = grid(&strokes);
        assert!(grid.vertices.len() <= MAX_VERTICES, "{speeds:?}");
        assert!(grid.triangles.len() <= MAX_TRIANGLES, "{speeds:?}");
        assert_eq!(mesh::check(&grid), Ok(()), "{speeds:?}");
        let all: Vec<&Segment> = strokes.segments.iter().collect();
        let local = Local::new(&strokes, &all);
        let visited = Visited::new(&strokes.segments);
        let mean = |place| {
            let (power, _) = local.spectrum(place, 0.5).expect("segments");
            power.iter().sum::<f64>() / POINTS as f64
        };
        let loudest = [speeds.0, speeds.1]
            .into_iter()
            .flat_map(|v| [forces.0, forces.1].map(|f| mean(visited.nearest((v, f)))))
            .fold(0.0, f64::max);
        for vertex in grid.vertices.iter().filter(|v| v.kind == VertexKind::Edge) {
            let place = (vertex.speed_mm_s, vertex.force_n);
            assert!(over_db(&grid, place, loudest) < 6.5, "{vertex:?}");
        }
    }
}
