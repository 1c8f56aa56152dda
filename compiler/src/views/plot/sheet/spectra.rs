//! Power spectral densities of the distinct models: force by column, speed by colour.

use super::distinct::distinct_models;
use super::layout::{margins, reach};
use super::level::level;
use asperity_plot::{
    Align, Axis, Canvas, ColorMap, ColorScale, Key, Panel, Rect, Stroke, TextStyle, VAlign, ink,
    legend, size,
};
use asperity_texture::model::{GridVertex, ModelGrid};
use asperity_texture::signal::spectrum::ArmaModel;

const POINTS: usize = 600;
const COLUMN_GAP: f32 = 40.0;
const BAR_ROOM: f32 = 150.0;
/// Largest range of the vertical axis, dB. Notches may be arbitrarily deep.
const SPAN_DB: f64 = 70.0;

/// Spectrum: dB at `POINTS` frequencies from 0 to Nyquist.
struct Curve {
    speed_mm_s: f64,
    density_db: Vec<f64>,
}

pub(super) fn draw(canvas: &mut Canvas, rect: Rect, grid: &ModelGrid) {
    let audible: Vec<&GridVertex> = distinct_models(grid)
        .into_iter()
        .filter(|vertex| level(vertex) > 0.0)
        .collect();
    let groups = by_force(&audible);
    let nyquist_hz = 0.5 * grid.sample_rate_hz;
    let curves: Vec<Vec<Curve>> = groups
        .iter()
        .map(|group| group.iter().map(|vertex| curve(grid, vertex)).collect())
        .collect();
    let y = density_axis(curves.iter().flatten());
    let scale = ColorScale::new(ColorMap::Plasma, 0.0, reach(&grid.vertices).0);

    let room = margins(0.0);
    let count = curves.len().max(1) as f32;
    let inner = rect.width - room.left - BAR_ROOM - COLUMN_GAP * (count - 1.0);
    let width = inner / count;
    for (index, group) in curves.iter().enumerate() {
        let first = index == 0;
        let x = rect.x + room.left + index as f32 * (width + COLUMN_GAP);
        let mut margins = room;
        margins.left = if first { room.left } else { 0.0 };
        let outer = Rect::new(x - margins.left, rect.y, width + margins.left, rect.height);
        let ticks = if curves.len() > 1 { 3 } else { 8 };
        let axis = Axis::new("Frequency (Hz)", 0.0, nyquist_hz).ticks_about(ticks);
        let mut panel = Panel::new(outer, axis, y.clone()).margins(margins);
        if first {
            // The title may run over all columns.
            panel.outer.width = rect.right() - outer.x;
            panel.margins.right = panel.outer.width - margins.left - width;
            panel = panel
                .letter('b')
                .title("Power spectral density of the vibration");
        } else {
            panel.y.label.clear();
            panel.y.numbered = false;
        }
        panel.draw_frame(canvas);
        for curve in group {
            let stroke = Stroke::new(scale.color(curve.speed_mm_s), size::LINE);
            let step = nyquist_hz / (POINTS - 1) as f64;
            let points = curve.density_db.iter().enumerate();
            panel.line(canvas, points.map(|(i, &db)| (i as f64 * step, db)), stroke);
        }
        let area = panel.area();
        if let Some(group) = groups.get(index) {
            let title = group_title(group);
            legend(
                canvas,
                (area.x, area.y - 26.0),
                rect.right(),
                &[(Key::Text, &title)],
            );
        }
        if group.is_empty() {
            let style = TextStyle::new(size::LABEL)
                .color(ink::GREY)
                .align(Align::Center, VAlign::Middle);
            canvas.text("silent everywhere", area.center(), &style);
        }
        if index + 1 == curves.len() {
            panel.colorbar(canvas, &scale, "Speed (mm/s)");
        }
    }
}

/// Splits models into at most three groups of neighbouring force and about equal size.
///
/// Models of equal force stay together. There is always at least one group.
fn by_force<'a>(models: &[&'a GridVertex]) -> Vec<Vec<&'a GridVertex>> {
    let mut sorted = models.to_vec();
    sorted.sort_by(|a, b| {
        a.force_n
            .total_cmp(&b.force_n)
            .then(a.speed_mm_s.total_cmp(&b.speed_mm_s))
    });
    let wanted = if sorted.len() < 6 { 1 } else { 3 };
    let mut groups: Vec<Vec<&GridVertex>> = vec![Vec::new()];
    let mut previous = None;
    for (index, vertex) in sorted.iter().enumerate() {
        let due = index * wanted / sorted.len();
        if due >= groups.len() && previous != Some(vertex.force_n) {
            groups.push(Vec::new());
        }
        if let Some(group) = groups.last_mut() {
            group.push(vertex);
        }
        previous = Some(vertex.force_n);
    }
    groups
}

fn group_title(group: &[&GridVertex]) -> String {
    let (Some(first), Some(last)) = (group.first(), group.last()) else {
        return String::new();
    };
    let models = match group.len() {
        1 => "1 model".to_owned(),
        count => format!("{count} models"),
    };
    let (low, high) = (
        format!("{:.2}", first.force_n),
        format!("{:.2}", last.force_n),
    );
    if low == high {
        format!("{low} N, {models}")
    } else {
        format!("{low}–{high} N, {models}")
    }
}

/// Computes the one-sided density 2·S/f_s in dB re 1 (m/s²)²/Hz.
fn curve(grid: &ModelGrid, vertex: &GridVertex) -> Curve {
    let model = ArmaModel::at_vertex(grid, vertex);
    let step = 0.5 * grid.sample_rate_hz / (POINTS - 1) as f64;
    let density_db = (0..POINTS)
        .map(|i| 2.0 * model.power(i as f64 * step) / grid.sample_rate_hz)
        .map(|density| 10.0 * density.log10())
        .collect();
    Curve {
        speed_mm_s: vertex.speed_mm_s,
        density_db,
    }
}

/// A vertical axis that shows all curves except the deepest parts of their notches.
fn density_axis<'a>(curves: impl Iterator<Item = &'a Curve>) -> Axis {
    let (mut low, mut high) = (f64::INFINITY, f64::NEG_INFINITY);
    for curve in curves {
        let mut sorted: Vec<f64> = curve
            .density_db
            .iter()
            .copied()
            .filter(|db| db.is_finite())
            .collect();
        sorted.sort_by(f64::total_cmp);
        if let (Some(&lowest), Some(&highest)) = (sorted.get(sorted.len() / 20), sorted.last()) {
            low = low.min(lowest);
            high = high.max(highest);
        }
    }
    let label = "Density (dB re 1 (m/s²)²/Hz)";
    if low > high {
        return Axis::new(label, -60.0, 0.0);
    }
    let high = ((high + 2.0) / 5.0).ceil() * 5.0;
    let low = ((low - 2.0) / 5.0).floor() * 5.0;
    Axis::new(label, low.max(high - SPAN_DB), high).ticks_about(8)
}

#[cfg(test)]
mod tests {
    use super::*;
    use asperity_texture::model::VertexKind;

    fn at_force(force_n: f64) -> GridVertex {
        GridVertex {
            speed_mm_s: 10.0,
            force_n,
            kind: VertexKind::Interior,
            lsf_rad: vec![1.0, 2.0],
            ma_lsf_rad: None,
            gain: 1.0,
            sigma_m_s2: 1.0,
        }
    }

    /// Claim: every model is in exactly one group, groups ascend in force, and models of equal force
    /// are in one group.
    #[test]
    fn groups_partition_the_models_by_force() {
        for forces in [
            vec![],
            vec![1.0],
            vec![1.0; 9],
            vec![1.0, 1.0, 1.0, 1.0, 1.0, 1.0, 1.0, 2.0],
            (0..18).map(|i| f64::from(i / 3)).collect(),
            (0..64).rev().map(f64::from).collect(),
        ] {
            let vertices: Vec<GridVertex> = forces.into_iter().map(at_force).collect();
            let models: Vec<&GridVertex> = vertices.iter().collect();
            let groups = by_force(&models);
            assert!((1..=3).contains(&groups.len()));
            assert_eq!(groups.iter().map(Vec::len).sum::<usize>(), vertices.len());
            for pair in groups.windows(2) {
                let (below, above) = (pair[0].last().unwrap(), pair[1].first().unwrap());
                assert!(below.force_n < above.force_n);
            }
        }
    }
}
