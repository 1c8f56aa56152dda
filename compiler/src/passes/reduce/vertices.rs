//! Removes vertices that their neighbours can stand for.
//!
//! Vertices are tried one after the other, in ascending order of the distance between their own
//! model and what the neighbours give there. A vertex is removed if the grid stays within the budget
//! without it, and its neighbours tile the hole. Corners stay, and a vertex on the border is replaced
//! by an edge along it, so the triangles always tile the rectangle.

use super::budget::{Distances, Reference, Tally};
use asperity_texture::model::{
    GridVertex, ModelGrid, mesh,
    mixture::{BarycentricPoint, Cosines, Field},
};
use std::rc::Rc;

/// Difference of areas that is rounding, for a rectangle of area 1.
const AREA_TOLERANCE: f64 = 1e-9;

/// The grid with as few vertices as the budget allows.
#[must_use]
pub fn fewest(grid: &ModelGrid, reference: &Reference<'_>) -> ModelGrid {
    fewer(grid, reference)
        .filter(|smaller| mesh::check(smaller).is_ok())
        .unwrap_or_else(|| grid.clone())
}

fn fewer(grid: &ModelGrid, reference: &Reference<'_>) -> Option<ModelGrid> {
    let mut state = State::of(grid, reference)?;
    if !state.distances.are_within_budget() {
        return None;
    }
    let mut order: Vec<(f64, usize)> = (0..grid.vertices.len())
        .filter_map(|vertex| Some((state.missed(vertex, reference)?, vertex)))
        .collect();
    // The sort is stable, so the same grid always loses the same vertices.
    order.sort_by(|x, y| x.0.total_cmp(&y.0));
    let mut here: Vec<usize> = (0..grid.vertices.len()).collect();
    for (_, vertex) in order {
        if let Ok(index) = here.binary_search(&vertex)
            && let Some(next) = state.without(index, reference)
        {
            state = next;
            here.remove(index);
        }
    }
    Some(state.grid)
}

/// A grid with the place and the distance of everything that is compared.
struct State {
    grid: ModelGrid,
    cosines: Vec<Rc<Cosines>>,
    located: Vec<BarycentricPoint>,
    distances: Distances,
}

impl State {
    fn of(grid: &ModelGrid, reference: &Reference<'_>) -> Option<Self> {
        let field = Field::new(grid);
        let located = reference.located(grid, &field)?;
        let distances = located
            .iter()
            .enumerate()
            .map(|(index, place)| reference.distance(index, &field, place))
            .collect();
        Some(Self {
            grid: grid.clone(),
            cosines: field.cosines().to_vec(),
            located,
            distances: Distances(distances),
        })
    }

    /// The cosines of all vertices but one.
    fn cosines_without(&self, vertex: usize) -> Vec<Rc<Cosines>> {
        let mut cosines = self.cosines.clone();
        cosines.remove(vertex);
        cosines
    }

    /// Distance between the model of a vertex and what the grid gives there without it, dB. `None`
    /// for a vertex that cannot be removed.
    fn missed(&self, vertex: usize, reference: &Reference<'_>) -> Option<f64> {
        let GridVertex {
            speed_mm_s,
            force_n,
            ..
        } = self.grid.vertices[vertex];
        let Smaller { grid, filled } = removed(&self.grid, vertex)?;
        let field = Field::with_cosines(&grid, &self.cosines_without(vertex));
        let place = field.locate_among(&grid.triangles[filled..], speed_mm_s, force_n)?;
        let index = reference
            .at()
            .position(|other| other == (speed_mm_s, force_n))?;
        Some(reference.distance(index, &field, &place))
    }

    /// The state without a vertex. `None` where the vertex is needed.
    fn without(&self, vertex: usize, reference: &Reference<'_>) -> Option<Self> {
        let Smaller { grid, filled } = removed(&self.grid, vertex)?;
        let cosines = self.cosines_without(vertex);
        let field = Field::with_cosines(&grid, &cosines);
        let mut distances = self.distances.0.clone();
        let mut located = self.located.clone();
        let is_moved = |place: &BarycentricPoint| place.vertices.contains(&vertex);
        let mut tally = Tally::of(distances.len());
        let stays = |(place, distance): (&BarycentricPoint, &f64)| {
            is_moved(place) || tally.admits(*distance)
        };
        if !located.iter().zip(&distances).all(stays) {
            return None;
        }
        for (index, at) in reference.at().enumerate() {
            let place = &mut located[index];
            if is_moved(place) {
                *place = field.locate_among(&grid.triangles[filled..], at.0, at.1)?;
                distances[index] = reference.distance(index, &field, place);
                if !tally.admits(distances[index]) {
                    return None;
                }
            } else {
                // The vertices after it move up by one.
                place.vertices = place.vertices.map(|v| v - usize::from(v > vertex));
            }
        }
        Some(Self {
            grid,
            cosines,
            located,
            distances: Distances(distances),
        })
    }
}

/// A grid without one of its vertices.
struct Smaller {
    grid: ModelGrid,
    /// Index of the first triangle that fills the hole. Whatever lay in the triangles of the vertex
    /// lies in these.
    filled: usize,
}

/// The grid without a vertex, with the hole tiled. `None` for a corner, and where no tiling is
/// found.
fn removed(grid: &ModelGrid, vertex: usize) -> Option<Smaller> {
    let (width, height) = mesh::corner(grid);
    let at = |v: usize| {
        let vertex = &grid.vertices[v];
        (vertex.speed_mm_s / width, vertex.force_n / height)
    };
    let (here, others): (Vec<_>, Vec<_>) = grid
        .triangles
        .iter()
        .partition(|triangle| triangle.contains(&vertex));
    let polygon = ring(&here, vertex, &at)?;
    let hole = tiled(&polygon, &at)?;
    // What is left must tile the same rectangle.
    let area = |triangles: &[[usize; 3]]| -> f64 {
        let twice = |&[a, b, c]: &[usize; 3]| cross(at(a), at(b), at(c)).abs();
        triangles.iter().map(twice).sum()
    };
    if (area(&hole) - area(&here)).abs() > AREA_TOLERANCE {
        return None;
    }
    let mut triangles: Vec<[usize; 3]> = others;
    let filled = triangles.len();
    triangles.extend(hole);
    for triangle in &mut triangles {
        *triangle = triangle.map(|v| v - usize::from(v > vertex));
    }
    let mut vertices = grid.vertices.clone();
    vertices.remove(vertex);
    let smaller = ModelGrid {
        sample_rate_hz: grid.sample_rate_hz,
        order: grid.order,
        numerator: grid.numerator,
        vertices,
        triangles,
    };
    (mesh::corner(&smaller) == (width, height)).then_some(Smaller {
        grid: smaller,
        filled,
    })
}

/// The neighbours of a vertex, counter-clockwise; on a border from one end to the other.
fn ring(
    triangles: &[[usize; 3]],
    vertex: usize,
    at: &impl Fn(usize) -> (f64, f64),
) -> Option<Vec<usize>> {
    let mut links: Vec<(usize, usize)> = Vec::with_capacity(triangles.len());
    for &[a, b, c] in triangles {
        let (from, to) = if a == vertex {
            (b, c)
        } else if b == vertex {
            (c, a)
        } else {
            (a, b)
        };
        let turn = cross(at(vertex), at(from), at(to));
        // A sliver has no side that could be told.
        if turn.abs() < 1e-12 {
            return None;
        }
        links.push(if turn > 0.0 { (from, to) } else { (to, from) });
    }
    // An open chain begins where no other link ends.
    let start = links
        .iter()
        .find(|(from, _)| !links.iter().any(|(_, to)| to == from))
        .or(links.first())?
        .0;
    let mut polygon = vec![start];
    let mut last = start;
    while let Some(place) = links.iter().position(|(from, _)| *from == last) {
        last = links.swap_remove(place).1;
        if last == start {
            break;
        }
        polygon.push(last);
    }
    links.is_empty().then_some(polygon)
}

/// Triangles of a simple polygon. Ears are cut off, the roundest first.
fn tiled(polygon: &[usize], at: &impl Fn(usize) -> (f64, f64)) -> Option<Vec<[usize; 3]>> {
    let mut left = polygon.to_vec();
    let mut triangles = Vec::new();
    while left.len() > 2 {
        let count = left.len();
        let corner = |i: usize| {
            [
                left[(i + count - 1) % count],
                left[i],
                left[(i + 1) % count],
            ]
        };
        let ear = (0..count)
            .filter_map(|i| {
                let [a, b, c] = corner(i);
                let turn = cross(at(a), at(b), at(c));
                let inside = |v: &usize| {
                    ![a, b, c].contains(v)
                        && cross(at(a), at(b), at(*v)) >= 0.0
                        && cross(at(b), at(c), at(*v)) >= 0.0
                        && cross(at(c), at(a), at(*v)) >= 0.0
                };
                let fits = turn > 1e-12 && !left.iter().any(inside);
                fits.then(|| (i, roundness(turn, [at(a), at(b), at(c)])))
            })
            .max_by(|x, y| x.1.total_cmp(&y.1));
        match ear {
            Some((i, _)) => {
                triangles.push(corner(i));
                left.remove(i);
            }
            // The rest has no area: it is a border that has become straight.
            None => {
                let flat = (0..count).all(|i| {
                    let [a, b, c] = corner(i);
                    cross(at(a), at(b), at(c)).abs() <= 1e-12
                });
                return flat.then_some(triangles);
            }
        }
    }
    Some(triangles)
}

/// Twice the area over the sum of squared sides.
fn roundness(turn: f64, [a, b, c]: [(f64, f64); 3]) -> f64 {
    let square = |p: (f64, f64), q: (f64, f64)| (p.0 - q.0).powi(2) + (p.1 - q.1).powi(2);
    turn / (square(a, b) + square(b, c) + square(c, a))
}

/// Twice the signed area of a triangle, positive counter-clockwise.
fn cross(a: (f64, f64), b: (f64, f64), c: (f64, f64)) -> f64 {
    (b.0 - a.0) * (c.1 - a.1) - (c.0 - a.0) * (b.1 - a.1)
}

#[cfg(test)]
mod tests {
    use super::*;
    use asperity_texture::model::triangulate;
    use asperity_texture::model::{Numerator, VertexKind};

    /// A grid of 5 × 5 vertices of one shape; levels by position.
    fn grid(level: impl Fn(f64, f64) -> f64) -> ModelGrid {
        let vertices: Vec<GridVertex> = (0..25)
            .map(|n| {
                let (speed_mm_s, force_n) = (f64::from(n % 5) * 50.0, f64::from(n / 5) * 0.5);
                GridVertex {
                    speed_mm_s,
                    force_n,
                    kind: VertexKind::Interior,
                    lsf_rad: vec![0.5, 1.5],
                    ma_lsf_rad: None,
                    gain: 1.0,
                    sigma_m_s2: level(speed_mm_s, force_n),
                }
            })
            .collect();
        ModelGrid {
            sample_rate_hz: 1000.0,
            order: 2,
            numerator: Numerator::Nyquist,
            triangles: triangulate::delaunay(&vertices),
            vertices,
        }
    }

    #[test]
    fn of_a_plane_the_corners_are_left() {
        let plane = grid(|v, f| 0.01 * v + f + 1.0);
        let kept = fewest(&plane, &Reference::new(&plane).unwrap());
        assert_eq!(kept.vertices.len(), 4);
        assert_eq!(kept.triangles.len(), 2);
        assert_eq!(mesh::check(&kept), Ok(()));
    }

    #[test]
    fn a_peak_stays() {
        let peak = grid(|v, f| if (v, f) == (100.0, 1.0) { 9.0 } else { 1.0 });
        let kept = fewest(&peak, &Reference::new(&peak).unwrap());
        assert!(kept.vertices.iter().any(|v| v.sigma_m_s2 == 9.0));
        assert!(kept.vertices.len() < 25);
        let distances = Reference::new(&peak).unwrap().distances(&kept).unwrap();
        assert!(distances.are_within_budget());
    }

    /// Claim: a vertex is missed by as much as its own model differs from its neighbours'.
    #[test]
    fn a_vertex_is_missed_at_its_own_place() {
        let middle = (100.0, 1.0);
        let peak = grid(|v, f| if (v, f) == middle { 10.0 } else { 1.0 });
        let reference = Reference::new(&peak).unwrap();
        let state = State::of(&peak, &reference);
        let state = state.expect("a state");
        let index = |at: (f64, f64)| {
            let same = |v: &GridVertex| (v.speed_mm_s, v.force_n) == at;
            peak.vertices.iter().position(same).expect("a vertex")
        };
        let missed = |at| state.missed(index(at), &reference).expect("removable");
        assert!(
            (missed(middle) - 20.0).abs() < 1e-6,
            "{} dB",
            missed(middle)
        );
        assert!(missed((50.0, 0.5)) > 0.0, "its neighbour stands beside it");
        assert!(missed((150.0, 0.5)) < missed(middle));
    }
}
