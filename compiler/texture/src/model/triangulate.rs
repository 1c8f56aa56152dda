//! Triangulates vertices that a source gives without triangles.

use delaunator::Point;

use super::GridVertex;

/// The Delaunay triangles of the vertices, with both axes scaled to 0..1 so that neither unit
/// counts for more. The same vertices give the same triangles.
///
/// They tile the rectangle from (0, 0) if its four corners are among the vertices.
#[must_use]
pub fn delaunay(vertices: &[GridVertex]) -> Vec<[usize; 3]> {
    let largest = |coordinate: fn(&GridVertex) -> f64| {
        let largest = vertices.iter().map(coordinate).fold(0.0, f64::max);
        if largest > 0.0 { largest } else { 1.0 }
    };
    let (width, height) = (largest(|v| v.speed_mm_s), largest(|v| v.force_n));
    let points: Vec<Point> = vertices
        .iter()
        .map(|vertex| Point {
            x: vertex.speed_mm_s / width,
            y: vertex.force_n / height,
        })
        .collect();
    delaunator::triangulate(&points)
        .triangles
        .chunks_exact(3)
        .map(|corners| [corners[0], corners[1], corners[2]])
        .collect()
}
