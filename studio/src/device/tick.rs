//! A servo-loop tick, as the page plots it.

/// A servo-loop tick. Non-finite values are shown as 0.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct LiveTick {
    /// Ticks since the loop began; one that was lost on the way leaves a gap.
    pub tick: u64,
    /// Where the tool is, mm.
    pub position_mm: [f32; 3],
    /// Depth in the surface, mm.
    pub depth_mm: f32,
    /// Speed along the surface, mm/s.
    pub speed_mm_s: f32,
    /// Force of the wall, N.
    pub normal_force_n: f32,
    /// Vibration before device gain, m/s².
    pub vib_m_s2: f32,
    /// Force of the tap, N.
    pub tap_n: f32,
    /// Friction, N.
    pub friction_n: f32,
    /// The force that the device got, N.
    pub force_n: [f32; 3],
    /// The runtime's flags.
    pub flags: u32,
    /// From when the tick was due to when the loop ran, µs.
    pub wakeup_us: f32,
}

impl LiveTick {
    /// The nine numbers of `asperity render`, in its order.
    pub(super) fn columns(&self) -> [f32; 9] {
        let [x, y, z] = self.force_n;
        [
            self.depth_mm,
            self.speed_mm_s,
            self.normal_force_n,
            self.vib_m_s2,
            self.tap_n,
            self.friction_n,
            x,
            y,
            z,
        ]
        .map(finite)
    }

    pub(super) fn position(&self) -> [f32; 3] {
        self.position_mm.map(finite)
    }

    pub(super) fn wakeup(&self) -> f32 {
        finite(self.wakeup_us)
    }
}

/// JSON has no other numbers.
fn finite(x: f32) -> f32 {
    if x.is_finite() { x } else { 0.0 }
}
