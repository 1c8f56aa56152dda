//! The distinct filters of a grid. Most edge models repeat an interior one.

use super::level::level;
use asperity_texture::model::{GridVertex, ModelGrid, VertexKind};

/// Returns a vertex for each distinct filter: interior ones first, then edge ones from the loudest on.
///
/// A filter is represented by an interior vertex that has it, else by the loudest
/// edge vertex.
pub(super) fn distinct_models(grid: &ModelGrid) -> Vec<&GridVertex> {
    let interior = grid
        .vertices
        .iter()
        .filter(|vertex| vertex.kind == VertexKind::Interior);
    let mut edges: Vec<&GridVertex> = grid
        .vertices
        .iter()
        .filter(|vertex| vertex.kind == VertexKind::Edge)
        .collect();
    edges.sort_by(|a, b| level(b).total_cmp(&level(a)));

    let mut chosen: Vec<&GridVertex> = Vec::new();
    for vertex in interior.chain(edges) {
        if !chosen.iter().any(|known| same_filter(known, vertex)) {
            chosen.push(vertex);
        }
    }
    chosen
}

fn same_filter(a: &GridVertex, b: &GridVertex) -> bool {
    a.lsf_rad == b.lsf_rad && a.ma_lsf_rad == b.ma_lsf_rad && a.gain == b.gain
}
