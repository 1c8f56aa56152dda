//! A legend beside a panel's title.

use asperity_plot::{Canvas, Panel, Stroke, TextStyle, size};

/// A line of a legend.
pub(super) struct Entry {
    pub(super) name: &'static str,
    pub(super) stroke: Stroke,
}

/// Names the lines of a panel at the right end of its title.
pub(super) fn legend(canvas: &mut Canvas, panel: &Panel, entries: &[Entry]) {
    let style = TextStyle::new(size::TICK);
    let area = panel.area();
    let y = area.y - 26.0;
    let mut x = area.right();
    for entry in entries.iter().rev() {
        x -= canvas.text_width(entry.name, &style);
        canvas.text(entry.name, (x, y + 6.0), &style);
        canvas.line(&[(x - 46.0, y), (x - 10.0, y)], entry.stroke, None);
        x -= 72.0;
    }
}
