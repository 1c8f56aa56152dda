//! Both maps side by side, a colour and a shape a family.

use super::{Map, Place};
use asperity_plot::{
    Align, Axis, Canvas, Color, Marker, Panel, PlotError, Rect, Stroke, TextStyle, VAlign, ink,
    size,
};
use std::collections::BTreeSet;

const WIDTH: f32 = 2400.0;
const HEIGHT: f32 = 1160.0;
const LEGEND: f32 = 260.0;
const RADIUS: f32 = 9.0;
/// Distance of lines in the legend, at most.
const LINE: f32 = 46.0;
/// First line of the legend.
const TOP: f32 = 90.0;
/// Below this a sign is filled, from it on hollow.
const FILLED: usize = INKS * MARKERS.len();
const MARKERS: [Marker; 4] = [
    Marker::Circle,
    Marker::Square,
    Marker::Diamond,
    Marker::Triangle,
];
/// Inks of [`ink::category`].
const INKS: usize = 6;

/// Where an anchor lies on one of the maps.
type Spot = fn(&Place) -> [f64; 2];

/// The picture as PNG.
pub(in crate::evaluate) fn draw(map: &Map) -> Result<Vec<u8>, PlotError> {
    let mut canvas = Canvas::new(WIDTH as u32, HEIGHT as u32)?;
    let families: BTreeSet<&str> = map.places.iter().map(|p| p.family.as_str()).collect();
    let families: Vec<&str> = families.into_iter().collect();
    let half = 0.5 * (WIDTH - LEGEND);
    let percent = |share: f64| format!("{:.0} %", 100.0 * share);
    let label = |k: usize| {
        format!(
            "Component {} ({} of variance)",
            k + 1,
            percent(map.explained[k])
        )
    };
    let panels: [(char, &str, [String; 2], Spot); 2] = [
        (
            'a',
            "Principal components of the anchors",
            [label(0), label(1)],
            |p| p.pca,
        ),
        (
            'b',
            "t-SNE of the anchors",
            ["t-SNE 1".into(), "t-SNE 2".into()],
            |p| p.tsne,
        ),
    ];
    for (index, (letter, title, [x, y], place)) in panels.into_iter().enumerate() {
        let outer = Rect::new(index as f32 * half, 0.0, half, HEIGHT);
        let axis =
            |label: String, k: usize| Axis::covering(label, map.places.iter().map(|p| place(p)[k]));
        let panel = Panel::new(outer, axis(x, 0), axis(y, 1))
            .letter(letter)
            .title(title);
        panel.draw_frame(&mut canvas);
        for spot in &map.places {
            let family = families.iter().position(|f| *f == spot.family).unwrap_or(0);
            let (marker, fill, outline) = sign(family);
            let [x, y] = place(spot);
            panel.points(
                &mut canvas,
                [(x, y)],
                marker,
                RADIUS,
                Some(fill),
                Some(outline),
            );
        }
    }
    let style = TextStyle::new(size::TICK).align(Align::Left, VAlign::Middle);
    let line = LINE.min((HEIGHT - TOP - LINE) / families.len().max(1) as f32);
    for (index, family) in families.iter().enumerate() {
        let at = (WIDTH - LEGEND + 40.0, TOP + line * index as f32);
        let (marker, fill, outline) = sign(index);
        canvas.marker(at, marker, RADIUS, Some(fill), Some(outline));
        let name = canvas.fitted(family, &style, LEGEND - 80.0);
        canvas.text(&name, (at.0 + 24.0, at.1), &style);
    }
    canvas.png()
}

/// Shape, fill and outline of a family.
fn sign(family: usize) -> (Marker, Color, Stroke) {
    let (marker, color) = (
        MARKERS[family / INKS % MARKERS.len()],
        ink::category(family),
    );
    if family < FILLED {
        (marker, color, Stroke::new(ink::PAPER, 1.5))
    } else {
        (marker, ink::PAPER, Stroke::new(color, 3.0))
    }
}
