//! A hand that presses, strokes and leaves a prompt's surface, and what it feels.

use super::texture;
use asperity::emit::lower::lower;
use asperity_formats::Asset;
use asperity_runtime::{Config, HostTexture, Output, Renderer, Sample, State};
use std::{
    collections::HashMap,
    sync::{Arc, LazyLock, Mutex},
};

/// A tick of the servo loop, s.
const TICK_S: f64 = 0.001;

/// Silent textures of prompts, so that only the contact is measured.
static SLOTS: LazyLock<Mutex<HashMap<String, Arc<HostTexture>>>> = LazyLock::new(Mutex::default);

fn slot(prompt: &str) -> Arc<HostTexture> {
    if let Some(slot) = SLOTS.lock().unwrap().get(prompt) {
        return slot.clone();
    }
    let texture = texture(prompt).silent();
    let bytes = lower(&texture, None).unwrap().bytes;
    let asset = Asset::parse(&bytes).unwrap();
    assert_eq!(
        asset.contact().is_some(),
        texture.contact.is_some(),
        "{prompt}"
    );
    let mut slot = HostTexture::new();
    slot.load(&asset, Config::default().servo_rate_hz).unwrap();
    let slot = Arc::new(slot);
    SLOTS
        .lock()
        .unwrap()
        .insert(prompt.to_owned(), slot.clone());
    slot
}

/// A hand on a surface.
struct Hand {
    renderer: Renderer,
    slot: Arc<HostTexture>,
    state: State,
    x_m: f64,
    z_m: f64,
}

impl Hand {
    fn on(prompt: &str) -> Self {
        Self {
            renderer: Renderer::new(&Config::default()).unwrap(),
            slot: slot(prompt),
            state: State::new(1),
            x_m: 0.0,
            z_m: 0.005,
        }
    }

    /// A tick at these speeds, m/s.
    fn go(&mut self, along_m_s: f64, up_m_s: f64) -> Output {
        self.x_m += along_m_s * TICK_S;
        self.z_m += up_m_s * TICK_S;
        let sample = Sample::at([self.x_m as f32, 0.0, self.z_m as f32]);
        self.renderer.tick(&self.slot, &mut self.state, &sample)
    }

    /// Presses to a load and returns the depth, mm, and the work, N·mm.
    fn press(&mut self, load_n: f64, speed_m_s: f64) -> (f64, f64) {
        let mut work = 0.0;
        for _ in 0..(0.065 / speed_m_s / TICK_S) as usize {
            let force_n = f64::from(self.go(0.0, -speed_m_s).force_n[2]);
            work += force_n * 1000.0 * speed_m_s * TICK_S;
            if force_n >= load_n {
                break;
            }
        }
        (-1000.0 * self.z_m, work)
    }

    /// Leaves the surface, and returns the work, N·mm, and the largest pull, N.
    fn leave(&mut self, speed_m_s: f64) -> (f64, f64) {
        let (mut work, mut pull_n) = (0.0, 0.0_f64);
        while self.z_m < 0.005 {
            let force_n = f64::from(self.go(0.0, speed_m_s).force_n[2]);
            work += force_n * 1000.0 * speed_m_s * TICK_S;
            pull_n = pull_n.max(-force_n);
        }
        (work, pull_n)
    }
}

/// A measure by its name.
pub(super) fn measure(name: &str) -> Option<fn(&str) -> f64> {
    Some(match name {
        "depth" => depth,
        "fast_depth" => fast_depth,
        "lost" => lost,
        "pull" => pull,
        "slow_drag" => slow_drag,
        "fast_drag" => fast_drag,
        "drag_of_speed" => drag_of_speed,
        "print" => print,
        "late_print" => late_print,
        "held" => held,
        _ => return None,
    })
}

/// Depth under 1 N, mm.
fn depth(prompt: &str) -> f64 {
    Hand::on(prompt).press(1.0, 0.02).0
}

/// Load at a depth, mm, of a hand that presses slowly, N.
pub(super) fn load(prompt: &str, depth_mm: f64) -> f64 {
    let mut hand = Hand::on(prompt);
    let mut load_n = 0.0;
    while -1000.0 * hand.z_m < depth_mm {
        load_n = f64::from(hand.go(0.0, -0.01).force_n[2]);
    }
    load_n
}

/// Depth under 1 N of a fast hand, mm.
fn fast_depth(prompt: &str) -> f64 {
    Hand::on(prompt).press(1.0, 0.2).0
}

/// Part of the work of pressing that does not come back.
pub(super) fn lost(prompt: &str) -> f64 {
    let mut hand = Hand::on(prompt);
    let (_, done) = hand.press(1.0, 0.02);
    let (back, _) = hand.leave(0.02);
    1.0 - back / done
}

/// Largest pull of a hand that leaves after a load of 1 N, N.
pub(super) fn pull(prompt: &str) -> f64 {
    let mut hand = Hand::on(prompt);
    hand.press(1.0, 0.02);
    hand.leave(0.02).1
}

/// Friction of a stroke 2 mm deep, N.
fn drag(prompt: &str, speed_m_s: f64) -> f64 {
    let mut hand = Hand::on(prompt);
    while hand.z_m > -0.002 {
        hand.go(0.0, -0.02);
    }
    let ticks = 400;
    let along = (0..ticks).map(|_| f64::from(hand.go(speed_m_s, 0.0).friction_n));
    along.skip(ticks / 2).sum::<f64>() / (ticks / 2) as f64
}

/// Friction of a slow stroke, N.
fn slow_drag(prompt: &str) -> f64 {
    drag(prompt, 0.02)
}

/// Friction of a fast stroke, N.
pub(super) fn fast_drag(prompt: &str) -> f64 {
    drag(prompt, 0.2)
}

/// Friction of a fast stroke over that of a slow one.
pub(super) fn drag_of_speed(prompt: &str) -> f64 {
    fast_drag(prompt) / slow_drag(prompt)
}

/// Depth of a print that 1 N left a while ago, mm.
fn print_after(prompt: &str, rest_s: f64) -> f64 {
    let mut hand = Hand::on(prompt);
    hand.press(1.0, 0.02);
    hand.leave(0.05);
    for _ in 0..(rest_s / TICK_S) as usize {
        hand.go(0.0, 0.0);
    }
    hand.press(0.03, 0.02).0 - Hand::on(prompt).press(0.03, 0.02).0
}

/// Depth of a print just left, mm.
pub(super) fn print(prompt: &str) -> f64 {
    print_after(prompt, 0.0)
}

/// Depth of a print after 5 s, mm.
fn late_print(prompt: &str) -> f64 {
    print_after(prompt, 5.0)
}

/// Part of the load that is left after half a second at one depth.
fn held(prompt: &str) -> f64 {
    let mut hand = Hand::on(prompt);
    hand.press(1.0, 0.2);
    let last = (0..500).map(|_| hand.go(0.0, 0.0)).last().unwrap();
    f64::from(last.force_n[2])
}
