//! The speed–force grid: triangles, vertices, and the level between them.

use super::layout::{margins, reach};
use super::level::{level, level_scale};
use asperity_plot::{Axis, Canvas, Color, Key, Marker, Panel, Rect, Stroke, ink, legend};
use asperity_texture::model::{GridVertex, ModelGrid, VertexKind};

const INTERIOR_RADIUS: f32 = 11.0;
const EDGE_RADIUS: f32 = 8.5;
const SQUARE_PX: usize = 2;

pub(super) fn draw(canvas: &mut Canvas, rect: Rect, grid: &ModelGrid) {
    let (max_speed_mm_s, max_force_n) = reach(&grid.vertices);
    let panel = Panel::new(
        rect,
        Axis::new("Speed (mm/s)", 0.0, max_speed_mm_s),
        Axis::new("Normal force (N)", 0.0, max_force_n),
    )
    .letter('d')
    .title("Grid of models, level interpolated")
    .margins(margins(160.0))
    .without_grid();

    let scale = level_scale(&grid.vertices);
    let triangles: Vec<Triangle> = grid
        .triangles
        .iter()
        .filter_map(|corners| Triangle::new(corners, &grid.vertices))
        .collect();
    panel.field(canvas, SQUARE_PX, |speed_mm_s, force_n| {
        triangles
            .iter()
            .find_map(|triangle| triangle.level_at(speed_mm_s, force_n))
            .map(|level| scale.color(level))
    });
    // Light lines on dark ones, so that the mesh shows on every colour.
    for mesh in [
        Stroke::new(ink::BLACK.alpha(70), 3.5),
        Stroke::new(ink::PAPER.alpha(210), 1.5),
    ] {
        for triangle in &triangles {
            let [a, b, c] = triangle.corners;
            panel.line(canvas, [a, b, c, a], mesh);
        }
    }
    panel.draw_frame(canvas);

    for kind in [VertexKind::Edge, VertexKind::Interior] {
        for vertex in grid.vertices.iter().filter(|vertex| vertex.kind == kind) {
            let at = panel.position(vertex.speed_mm_s, vertex.force_n);
            draw_vertex(canvas, at, kind, scale.color(level(vertex)));
        }
    }

    let sample = scale.map.at(0.6);
    let (shape, radius) = shape(VertexKind::Interior);
    let rim = Some(Stroke::new(ink::BLACK, 1.5));
    let interior = Key::Point(shape, radius - 1.0, Some(sample), rim);
    let (shape, radius) = self::shape(VertexKind::Edge);
    let edge = Key::Point(shape, radius - 1.0, Some(sample), rim);
    let area = panel.area();
    legend(
        canvas,
        (area.x, area.y - 26.0),
        rect.right(),
        &[(interior, "interior model"), (edge, "edge model")],
    );
    panel.colorbar(canvas, &scale, "Level, gain·σ (m/s²)");
}

fn shape(kind: VertexKind) -> (Marker, f32) {
    match kind {
        VertexKind::Interior => (Marker::Circle, INTERIOR_RADIUS),
        VertexKind::Edge => (Marker::Square, EDGE_RADIUS),
    }
}

/// A marker that shows on any colour: a white ring between fill and rim.
fn draw_vertex(canvas: &mut Canvas, at: (f32, f32), kind: VertexKind, color: Color) {
    let (marker, radius) = shape(kind);
    let rim = Some(Stroke::new(ink::BLACK, 1.5));
    canvas.marker(at, marker, radius, Some(ink::PAPER), rim);
    canvas.marker(at, marker, radius - 2.8, Some(color), None);
}

/// A triangle in the plane of speed and force, with levels at its corners.
struct Triangle {
    corners: [(f64, f64); 3],
    levels: [f64; 3],
    twice_area: f64,
}

impl Triangle {
    /// The triangle; `None` for an index without a vertex or for corners on one line.
    fn new(corners: &[usize; 3], vertices: &[GridVertex]) -> Option<Self> {
        let [a, b, c] = corners.map(|index| vertices.get(index));
        let corners = [a?, b?, c?];
        let levels = corners.map(level);
        let corners = corners.map(|vertex| (vertex.speed_mm_s, vertex.force_n));
        let twice_area = cross(corners[0], corners[1], corners[2]);
        (twice_area != 0.0 && twice_area.is_finite()).then_some(Self {
            corners,
            levels,
            twice_area,
        })
    }

    /// The level at a point inside, mixed with barycentric weights as the renderer does; `None`
    /// outside.
    fn level_at(&self, speed_mm_s: f64, force_n: f64) -> Option<f64> {
        let point = (speed_mm_s, force_n);
        let [a, b, c] = self.corners;
        let weights = [cross(point, b, c), cross(a, point, c), cross(a, b, point)]
            .map(|area| area / self.twice_area);
        weights
            .iter()
            .all(|&weight| weight >= -1e-9)
            .then(|| weights.iter().zip(self.levels).map(|(w, l)| w * l).sum())
    }
}

fn cross(a: (f64, f64), b: (f64, f64), c: (f64, f64)) -> f64 {
    (b.0 - a.0) * (c.1 - a.1) - (b.1 - a.1) * (c.0 - a.0)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn vertex(speed_mm_s: f64, force_n: f64, sigma_m_s2: f64) -> GridVertex {
        GridVertex {
            speed_mm_s,
            force_n,
            kind: VertexKind::Edge,
            lsf_rad: vec![1.0, 2.0],
            ma_lsf_rad: None,
            gain: 2.0,
            sigma_m_s2,
        }
    }

    /// Claim: in either orientation the level is linear, exact at corners and absent outside.
    /// Corners on one line and indices without a vertex give no triangle.
    #[test]
    fn the_level_is_barycentric() {
        let vertices = [
            vertex(0.0, 0.0, 0.0),
            vertex(10.0, 0.0, 1.0),
            vertex(0.0, 2.0, 3.0),
            vertex(5.0, 0.0, 3.0),
        ];
        for corners in [[0, 1, 2], [2, 1, 0]] {
            let triangle = Triangle::new(&corners, &vertices).expect("it has an area");
            assert!((triangle.level_at(10.0, 0.0).expect("corner") - 2.0).abs() < 1e-12);
            assert!((triangle.level_at(5.0, 1.0).expect("edge") - 4.0).abs() < 1e-12);
            assert_eq!(triangle.level_at(6.0, 1.0), None);
        }
        assert!(Triangle::new(&[0, 1, 3], &vertices).is_none());
        assert!(Triangle::new(&[0, 1, 4], &vertices).is_none());
    }
}
