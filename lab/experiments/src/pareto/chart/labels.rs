//! Names beside points, placed so that none overlaps another.

use asperity_plot::{Align, Canvas, Rect, Stroke, TextStyle, VAlign, ink, size};

/// From a point to a name that stands off.
const LEADER: Stroke = Stroke::new(ink::GREY, 1.0);

/// The places that are taken.
pub(super) struct Labels {
    area: Rect,
    occupied: Vec<Rect>,
}

impl Labels {
    /// Labels for a panel's area; no name may cover one of the points.
    pub(super) fn new(area: Rect, points: impl IntoIterator<Item = (f32, f32)>) -> Self {
        let occupied = points
            .into_iter()
            .map(|(x, y)| Rect::new(x - 7.0, y - 7.0, 14.0, 14.0))
            .collect();
        Self { area, occupied }
    }

    /// Keeps names out of a rectangle.
    fn reserve(&mut self, rect: Rect) {
        self.occupied.push(rect);
    }

    /// Keeps names off a line of horizontal and vertical pieces.
    pub(super) fn reserve_line(&mut self, points: &[(f32, f32)]) {
        for pair in points.windows(2) {
            let (a, b) = (pair[0], pair[1]);
            let (left, top) = (a.0.min(b.0), a.1.min(b.1));
            let (width, height) = ((a.0 - b.0).abs(), (a.1 - b.1).abs());
            self.reserve(Rect::new(left - 2.0, top - 2.0, width + 4.0, height + 4.0));
        }
    }

    /// Sets a name beside a point where there is room, with a line to the point if others stand
    /// between, and leaves it out where there is no room.
    pub(super) fn set(&mut self, canvas: &mut Canvas, text: &str, at: (f32, f32)) {
        let style = TextStyle::new(size::TICK - 2.0).align(Align::Left, VAlign::Middle);
        let (width, height) = (canvas.text_width(text, &style), style.size);
        let (x, y) = at;
        let side = 13.0;
        let rows = [0.0, -0.6, 0.6, -1.2, 1.2, -1.8, 1.8, -2.6, 2.6, -3.4, 3.4];
        let beside = rows.into_iter().flat_map(|row| {
            let dy = row * height;
            [(x + side, y + dy), (x - side - width, y + dy)]
        });
        let around = [-1.1, 1.1, -2.0, 2.0].map(|row| (x - 0.5 * width, y + row * height));
        let free = beside.chain(around).find(|&(left, middle)| {
            let rect = Rect::new(left, middle - 0.5 * height, width, height);
            let inside = rect.x >= self.area.x + 4.0
                && rect.right() <= self.area.right() - 4.0
                && rect.y >= self.area.y + 4.0
                && rect.bottom() <= self.area.bottom() - 4.0;
            inside && !self.occupied.iter().any(|other| overlap(other, &rect))
        });
        if let Some((left, middle)) = free {
            let near = (x.clamp(left, left + width), middle);
            if (near.1 - y).abs() > 0.8 * height {
                let edge = near.1 - 0.5 * height * (near.1 - y).signum();
                canvas.line(&[at, (near.0, edge)], LEADER, None);
            }
            canvas.text(text, (left, middle), &style);
            self.occupied
                .push(Rect::new(left, middle - 0.5 * height, width, height));
        }
    }
}

fn overlap(a: &Rect, b: &Rect) -> bool {
    a.x < b.right() && b.x < a.right() && a.y < b.bottom() && b.y < a.bottom()
}
