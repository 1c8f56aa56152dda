//! Horizontal bars in groups, with whiskers.

use asperity_plot::{
    Align, Axis, Canvas, Color, Margins, Panel, Rect, Stroke, TextStyle, VAlign, ink, size,
};

/// Space for the names of groups, pixels.
const NAMES: f32 = 400.0;
/// Height of a line of the legend, pixels.
const LEGEND: f32 = 52.0;

/// A bar: its value and the ends of its whisker.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Bar {
    pub(super) value: f64,
    pub(super) low: f64,
    pub(super) high: f64,
}

/// Bars under a name, one a series.
pub(super) struct Group {
    pub(super) name: String,
    pub(super) bars: Vec<Bar>,
}

/// Labels, axis and mark of a chart.
pub(super) struct Chart<'a> {
    pub(super) letter: char,
    pub(super) title: &'a str,
    pub(super) axis: Axis,
    /// Names and colours of the series.
    pub(super) series: &'a [(&'a str, Color)],
    /// A value to compare with.
    pub(super) mark: f64,
}

/// Draws into `rect`, the first group on top.
pub(super) fn draw(canvas: &mut Canvas, rect: Rect, chart: &Chart<'_>, groups: &[Group]) {
    let count = groups.len().max(1) as f64;
    let margins = Margins {
        left: NAMES,
        right: 40.0,
        top: 70.0 + LEGEND,
        ..Margins::default()
    };
    let rows = Axis::new("", 0.0, count).unnumbered().ticks_about(1);
    let panel = Panel::new(rect, chart.axis.clone(), rows)
        .letter(chart.letter)
        .title(chart.title)
        .margins(margins)
        .without_grid();
    panel.draw_frame(canvas);
    let area = panel.area();
    legend(canvas, (area.x, area.y - 0.5 * LEGEND), chart.series);
    let name = TextStyle::new(size::TICK).align(Align::Right, VAlign::Middle);
    for (row, group) in groups.iter().enumerate() {
        let middle = count - row as f64 - 0.5;
        let y = panel.position(panel.x.min, middle).1;
        let text = canvas.fitted(&group.name, &name, NAMES - 40.0);
        canvas.text(&text, (area.x - 16.0, y), &name);
        let height = 0.8 / group.bars.len().max(1) as f64;
        for (index, (bar, (_, color))) in group.bars.iter().zip(chart.series).enumerate() {
            let top = middle + 0.4 - height * index as f64;
            let from = panel.position(panel.x.min.max(0.0), top);
            let to = panel.position(bar.value.min(panel.x.max), top - height);
            let filled = Rect::new(from.0, from.1 + 1.0, to.0 - from.0, to.1 - from.1 - 2.0);
            canvas.fill_rect(filled, *color);
            let line = top - 0.5 * height;
            let whisker = [(bar.low, line), (bar.high, line)];
            panel.line(canvas, whisker, Stroke::new(ink::BLACK, 2.0));
        }
    }
    panel.vertical_line(canvas, chart.mark, Stroke::new(ink::GREY, 2.0).dashed());
    canvas.stroke_rect(area, Stroke::new(ink::BLACK, size::FRAME));
}

fn legend(canvas: &mut Canvas, (mut x, y): (f32, f32), series: &[(&str, Color)]) {
    let style = TextStyle::new(size::TICK).align(Align::Left, VAlign::Middle);
    for (name, color) in series {
        canvas.fill_rect(Rect::new(x, y - 10.0, 20.0, 20.0), *color);
        canvas.text(name, (x + 30.0, y), &style);
        x += 30.0 + canvas.text_width(name, &style) + 36.0;
    }
}
