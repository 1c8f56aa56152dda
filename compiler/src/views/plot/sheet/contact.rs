//! Friction with its anchors, against normal force or, where it depends on it, speed; and the wall's force against displacement.

use super::{
    layout::reach,
    press::{self, HOLD_S, Press, SPEED_M_S},
};
use asperity_plot::{
    Align, Axis, Canvas, Color, Key, Margins, Panel, Rect, Stroke, TextStyle, VAlign, ink, legend,
    size,
};
use asperity_texture::model::{Friction, FrictionAnchor, FrictionLaw, TextureModel};

/// Width of the words beside each picture.
const WORDS_WIDTH: f32 = 400.0;
/// Width of a key before its name.
const KEY_WIDTH: f32 = 44.0;
const LINE_HEIGHT: f32 = 31.0;
/// Speed of pressing and leaving at which damping is shown, m/s.
const PRESS_SPEED_M_S: f64 = 0.1;
/// Part of the peak force to which a press goes.
const PRESSED: f64 = 0.6;

pub(super) fn draw(canvas: &mut Canvas, rect: Rect, model: &TextureModel) {
    let half = 0.5 * rect.height;
    let above = Rect::new(rect.x, rect.y, rect.width, half + 12.0);
    let below = Rect::new(rect.x, rect.y + half + 12.0, rect.width, half - 12.0);
    draw_friction(canvas, above, model);
    draw_wall(canvas, below, model);
}

fn margins(top: f32) -> Margins {
    Margins {
        left: 100.0,
        right: WORDS_WIDTH,
        top,
        bottom: 88.0,
    }
}

fn draw_friction(canvas: &mut Canvas, rect: Rect, model: &TextureModel) {
    let friction = &model.friction;
    let shown = shown_anchors(friction);
    let panel = match &friction.law {
        Some(law) => draw_law(canvas, rect, model, law, &shown),
        None => draw_coulomb(canvas, rect, model, &shown),
    };
    let area = panel.area();
    let mut words = Words::beside(area, rect);
    words.strong(canvas, &format!("μ = {:.3}", friction.mu));
    if let Some(law) = &friction.law {
        let ends = [law.points.first(), law.points.last()];
        for point in ends.into_iter().flatten() {
            let (mu, speed) = (friction.mu * point.factor, point.speed_mm_s);
            words.quiet(canvas, &format!("μ = {mu:.3} at {speed:.0} mm/s"));
        }
    }
    match friction.anchors_mu() {
        None => words.quiet(canvas, "no anchors"),
        Some(mean) => {
            let moved = 100.0 * (friction.mu / mean - 1.0);
            if moved.abs() >= 0.5 {
                words.quiet(canvas, &format!("{moved:+.0} % by words or edits"));
            }
            words.quiet(canvas, &format!("from μ = {mean:.3} of its anchors:"));
        }
    }
    for (index, anchor) in shown.iter().enumerate() {
        let dash = Stroke::new(ink::category(index), 2.5).dashed();
        words.line_key(canvas, dash, &anchor.name);
        let share = 100.0 * anchor.weight;
        words.indented(
            canvas,
            &format!("μ = {:.3}, weight {share:.0} %", anchor.mu),
        );
    }
    let hidden = friction.anchors.len() - shown.len();
    if hidden > 0 {
        words.quiet(canvas, &format!("and {hidden} more"));
    }
}

/// The largest μ of a texture and of the anchors that are shown.
fn steepest(friction: &Friction, shown: &[&FrictionAnchor]) -> f64 {
    let anchors = shown.iter().map(|anchor| anchor.mu);
    anchors.fold(friction.highest_mu(), f64::max)
}

/// μ over speed.
fn draw_law(
    canvas: &mut Canvas,
    rect: Rect,
    model: &TextureModel,
    law: &FrictionLaw,
    shown: &[&FrictionAnchor],
) -> Panel {
    let mu = model.friction.mu;
    let last = law.points.last().map_or(0.0, |p| p.speed_mm_s);
    let fastest = reach(&model.grid.vertices).0.max(1.1 * last).max(1.0);
    let highest = 1.05 * steepest(&model.friction, shown);
    let panel = Panel::new(
        rect,
        Axis::new("Speed (mm/s)", 0.0, fastest).ticks_about(4),
        Axis::new("Friction μ", 0.0, if highest > 0.0 { highest } else { 1.0 }).ticks_about(5),
    )
    .letter('e')
    .title("Friction and wall")
    .margins(margins(96.0));
    panel.draw_frame(canvas);
    let points = law.points.iter().map(|p| (p.speed_mm_s, mu * p.factor));
    let ends = [0.0, fastest].map(|v| (v, model.friction.mu_at(v)));
    let curve = [ends[0]].into_iter().chain(points).chain([ends[1]]);
    panel.line(canvas, curve, Stroke::new(ink::BLACK, 5.0));
    for (index, anchor) in shown.iter().enumerate() {
        let stroke = Stroke::new(ink::category(index), 2.5).dashed();
        panel.horizontal_line(canvas, anchor.mu, stroke);
    }
    panel
}

/// Friction over normal force.
fn draw_coulomb(
    canvas: &mut Canvas,
    rect: Rect,
    model: &TextureModel,
    shown: &[&FrictionAnchor],
) -> Panel {
    let friction = &model.friction;
    let force_n = reach(&model.grid.vertices).1;
    let force_n = if force_n > 0.0 { force_n } else { 1.0 };
    let steepest = steepest(friction, shown);
    let panel = Panel::new(
        rect,
        Axis::new("Normal force (N)", 0.0, force_n).ticks_about(4),
        Axis::new("Friction force (N)", 0.0, 1.05 * steepest * force_n).ticks_about(5),
    )
    .letter('e')
    .title("Friction and wall")
    .margins(margins(96.0));
    panel.draw_frame(canvas);
    let ray = |mu: f64| [(0.0, 0.0), (force_n, mu * force_n)];
    panel.line(canvas, ray(friction.mu), Stroke::new(ink::BLACK, 5.0));
    for (index, anchor) in shown.iter().enumerate() {
        let stroke = Stroke::new(ink::category(index), 2.5).dashed();
        panel.line(canvas, ray(anchor.mu), stroke);
    }
    panel
}

/// The anchors of the largest weights, as many as there are lines beside the picture.
fn shown_anchors(friction: &Friction) -> Vec<&FrictionAnchor> {
    let mut anchors: Vec<&FrictionAnchor> = friction.anchors.iter().collect();
    anchors.sort_by(|a, b| b.weight.total_cmp(&a.weight));
    anchors.truncate(3);
    anchors
}

fn draw_wall(canvas: &mut Canvas, rect: Rect, model: &TextureModel) {
    let (wall, gains) = (&model.wall, &model.gains);
    let limit_n = gains.f_max_n;
    let damping_n = wall.damping_n_s_m * PRESS_SPEED_M_S;
    let top_n = 1.2 * limit_n.max(0.0) + damping_n.max(0.0);
    let loop_of = press::press(model, PRESSED * limit_n.max(0.0));
    let depth_mm = match &model.contact {
        Some(law) => law.pressed_mm(top_n, wall.stiffness_n_m),
        None => 1000.0 * top_n / wall.stiffness_n_m,
    };
    let pulls = loop_of.iter().flat_map(|press| &press.up);
    let pull_n = pulls.map(|&(_, force_n)| force_n).fold(0.0, f64::min);
    let panel = Panel::new(
        rect,
        Axis::new("Penetration (mm)", 0.0, depth_mm).ticks_about(4),
        Axis::new("Wall force (N)", 1.2 * pull_n, top_n).ticks_about(5),
    )
    .margins(margins(40.0));
    panel.draw_frame(canvas);
    let depth_mm = panel.x.max;
    let force_n = |depth_mm: f64, speed_m_s: f64| {
        let spring_n = match &model.contact {
            Some(law) => law.pressed_n(depth_mm, wall.stiffness_n_m),
            None => wall.stiffness_n_m * depth_mm / 1000.0,
        };
        (spring_n + wall.damping_n_s_m * speed_m_s).max(0.0)
    };
    let moving = Stroke::new(ink::BLUE, 2.5).dashed();
    let path = |speed_m_s: f64| {
        (0..=200).map(move |step| {
            let depth_mm = depth_mm * f64::from(step) / 200.0;
            (depth_mm, force_n(depth_mm, speed_m_s))
        })
    };
    // Damping is drawn where it is large enough to be seen.
    let damped = damping_n > 0.01 * top_n && loop_of.is_none();
    if damped {
        panel.line(canvas, path(PRESS_SPEED_M_S), moving);
        panel.line(canvas, path(-PRESS_SPEED_M_S), moving);
    }
    let slowly = Stroke::new(ink::BLACK, 4.0);
    panel.line(canvas, path(0.0), slowly);
    let held = Stroke::new(ink::ORANGE, 3.0);
    if let Some(Press {
        down,
        held: hold,
        up,
    }) = &loop_of
    {
        panel.line(canvas, down.iter().copied(), moving);
        panel.line(canvas, hold.iter().copied(), held);
        panel.line(canvas, up.iter().copied(), moving);
    }
    let limit = Stroke::new(ink::VERMILION, 2.5).dotted();
    panel.horizontal_line(canvas, limit_n, limit);

    let mut words = Words::beside(panel.area(), rect);
    words.strong(canvas, &format!("k = {} N/m", brief(wall.stiffness_n_m)));
    words.strong(canvas, &format!("b = {} N·s/m", brief(wall.damping_n_s_m)));
    if damped {
        words.line_key(canvas, moving, "pressed, left at 0.1 m/s");
    }
    if loop_of.is_some() {
        words.line_key(canvas, slowly, "pressed slowly");
        words.line_key(canvas, moving, &format!("pressed, left at {SPEED_M_S} m/s"));
        words.line_key(canvas, held, &format!("held for {HOLD_S} s"));
    }
    words.line_key(canvas, limit, &format!("peak force {} N", brief(limit_n)));
    words.quiet(
        canvas,
        &format!("vibration gain {} s²/m", brief(gains.vib_s2_m)),
    );
    words.quiet(
        canvas,
        &format!("tap mass {} g", brief(1000.0 * gains.effective_mass_kg)),
    );
}

/// A number with about three significant digits.
fn brief(value: f64) -> String {
    if value == 0.0 || !value.is_finite() {
        return format!("{value}");
    }
    let exponent = value.abs().log10().floor() as i32;
    let decimals = usize::try_from(2 - exponent).unwrap_or(0).min(9);
    let text = format!("{value:.decimals$}");
    if text.contains('.') {
        text.trim_end_matches('0').trim_end_matches('.').to_owned()
    } else {
        text
    }
}

/// Lines of text beside a picture, from top to bottom.
struct Words {
    left: f32,
    right: f32,
    y: f32,
}

impl Words {
    fn beside(area: Rect, rect: Rect) -> Self {
        Self {
            left: area.right() + 24.0,
            right: rect.right() - 40.0,
            y: area.y + 12.0,
        }
    }

    fn style(color: Color) -> TextStyle {
        TextStyle::new(size::TICK)
            .color(color)
            .align(Align::Left, VAlign::Middle)
    }

    fn set(&mut self, canvas: &mut Canvas, text: &str, style: &TextStyle) {
        let text = canvas.fitted(text, style, self.right - self.left);
        canvas.text(&text, (self.left, self.y), style);
        self.y += LINE_HEIGHT;
    }

    fn strong(&mut self, canvas: &mut Canvas, text: &str) {
        let mut style = Self::style(ink::BLACK);
        style.size = size::LABEL;
        self.set(canvas, text, &style);
    }

    fn quiet(&mut self, canvas: &mut Canvas, text: &str) {
        self.set(canvas, text, &Self::style(ink::GREY));
    }

    fn line_key(&mut self, canvas: &mut Canvas, stroke: Stroke, text: &str) {
        legend(
            canvas,
            (self.left, self.y),
            f32::INFINITY,
            &[(Key::Line(stroke), "")],
        );
        self.indented(canvas, text);
    }

    /// A line that belongs to the key above it.
    fn indented(&mut self, canvas: &mut Canvas, text: &str) {
        let style = Self::style(ink::GREY);
        let text = canvas.fitted(text, &style, self.right - self.left - KEY_WIDTH);
        canvas.text(&text, (self.left + KEY_WIDTH, self.y), &style);
        self.y += LINE_HEIGHT;
    }
}
