//! The speed–force grid: triangles, vertices, and the level between them.

use super::layout::{margins, reach};
use super::level::{level, level_scale};
use asperity_plot::{Axis, Canvas, Color, Key, Marker, Panel, Rect, Stroke, ink, legend};
use asperity_texture::model::{ModelGrid, VertexKind, mixture::Field};

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
    // A model need not be one that an asset holds.
    let is_there = |triangle: &&[usize; 3]| triangle.iter().all(|&v| v < grid.vertices.len());
    let triangles: Vec<[usize; 3]> = grid.triangles.iter().filter(is_there).copied().collect();
    let field = Field::new(grid);
    panel.field(canvas, SQUARE_PX, |speed_mm_s, force_n| {
        let place = field.locate_among(&triangles, speed_mm_s, force_n)?;
        let corners = place.vertices.iter().zip(place.weights);
        let parts = corners.map(|(&vertex, weight)| weight * level(&grid.vertices[vertex]));
        Some(scale.color(parts.sum()))
    });
    // Light lines on dark ones, so that the mesh shows on every colour.
    for mesh in [
        Stroke::new(ink::BLACK.alpha(70), 3.5),
        Stroke::new(ink::PAPER.alpha(210), 1.5),
    ] {
        for triangle in &triangles {
            let [a, b, c] = triangle.map(|vertex| {
                let vertex = &grid.vertices[vertex];
                (vertex.speed_mm_s, vertex.force_n)
            });
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
