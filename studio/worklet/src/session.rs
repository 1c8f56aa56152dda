//! The rendering session: the runtime as `asperity render --rate 16000` sets it up.

use crate::{hand::RATE_HZ, spectrum::Spectrum};
use asperity_runtime::{
    Config, ConfigError, Exchange, HostTexture, Output, Player, PrepareError, Preparer, Renderer,
    SafetyConfig, Sample,
};
use core::ptr;

/// Textures on their way to the one that plays.
pub const SPARE: usize = 2;

/// A tick of a [`Session`], in the units of the columns that `asperity render` writes.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Tick {
    /// `depth_mm`, `speed_mm_s`, `normal_force_n`, `vib_m_s2`, `tap_n`, `friction_n`, `fx_n`, `fy_n`,
    /// `fz_n`.
    pub columns: [f32; 9],
    /// `flags`.
    pub flags: u32,
    /// Acceleration of a tool with the effective mass of the texture: vibration and tap as one
    /// acceleration, `vib_m_s2` + `tap_n`/m_eff, m/s².
    pub acceleration_m_s2: f32,
}

/// The configuration of `asperity render`: the default device on the plane z = 0, which reaches as
/// far as the runtime counts, 10 km.
#[must_use]
pub fn config() -> Config {
    let default = Config::default();
    Config {
        servo_rate_hz: RATE_HZ,
        safety: SafetyConfig {
            reach_m: 1.0e4,
            ..default.safety
        },
        ..default
    }
}

/// A rendering, from its first tick on.
pub struct Session<'q, 'a> {
    renderer: Renderer,
    preparer: Preparer<'q, 'a>,
    player: Player<'q, 'a>,
    swaps: u32,
}

impl<'q, 'a> Session<'q, 'a> {
    /// A rendering of the texture in `playing`, which was loaded for [`RATE_HZ`]. `seed` is that of
    /// the command.
    ///
    /// # Errors
    /// [`ConfigError`] on a processor that does not round to nearest.
    pub fn start(
        exchange: &'q mut Exchange<'a>,
        playing: &'a mut HostTexture,
        spare: [&'a mut HostTexture; SPARE],
        seed: u64,
    ) -> Result<Self, ConfigError> {
        let renderer = Renderer::new(&config())?;
        let (preparer, player) = exchange.split(playing, spare, seed);
        Ok(Self {
            renderer,
            preparer,
            player,
            swaps: 0,
        })
    }

    /// Sends another texture, whose sound and wall the runtime then cross-fades to; nothing else
    /// starts anew. Of the asset's bytes those behind its haptic sections may be missing.
    ///
    /// # Errors
    /// [`PrepareError::NoneSpare`] while two textures wait, which a tap makes them do; a reason to
    /// refuse the asset. Nothing is sent then.
    pub fn swap(&mut self, asset: &[u8]) -> Result<(), PrepareError> {
        self.preparer.prepare_haptic(asset, RATE_HZ)
    }

    /// Renders the hand at a position, mm, as the command renders a row with these numbers.
    pub fn tick(&mut self, position_mm: [f32; 3]) -> Tick {
        let position_m = position_mm.map(|mm| (f64::from(mm) / 1000.0) as f32);
        let before = ptr::from_ref(self.player.texture());
        let output = (self.renderer).tick_player(&mut self.player, &Sample::at(position_m));
        if !ptr::eq(before, self.player.texture()) {
            self.swaps = self.swaps.wrapping_add(1);
        }
        let Output {
            force_n: [fx_n, fy_n, fz_n],
            depth_m,
            speed_mm_s,
            normal_force_n,
            vib_m_s2,
            tap_n,
            friction_n,
            flags,
        } = output;
        // A slot waits while a tap plays, so the tap is this texture's.
        let tap_m_s2 = tap_n / self.effective_mass_kg();
        let tap_m_s2 = if tap_m_s2.is_finite() { tap_m_s2 } else { 0.0 };
        Tick {
            columns: [
                depth_m * 1000.0,
                speed_mm_s,
                normal_force_n,
                vib_m_s2,
                tap_n,
                friction_n,
                fx_n,
                fy_n,
                fz_n,
            ],
            flags: flags.bits().into(),
            acceleration_m_s2: vib_m_s2 + tap_m_s2,
        }
    }

    /// Returns the number of swaps that have begun to play.
    #[must_use]
    pub const fn swaps(&self) -> u32 {
        self.swaps
    }

    /// Effective mass m_eff of the texture that plays, kg.
    #[must_use]
    pub fn effective_mass_kg(&self) -> f32 {
        self.player.texture().coupling().effective_mass_kg
    }

    /// Stiffness of the wall as it is rendered, N/m: a depth of F/k presses with the force F.
    #[must_use]
    pub fn stiffness_n_m(&self) -> f32 {
        let coupling = self.player.texture().coupling();
        self.renderer.wall(&coupling).stiffness.0
    }

    /// Returns true if what plays gives way.
    #[must_use]
    pub fn gives_way(&self) -> bool {
        self.player.texture().gives_way()
    }

    /// Rate of the models of the texture that plays, Hz.
    #[must_use]
    pub fn model_rate_hz(&self) -> f32 {
        RATE_HZ / f32::from(self.player.texture().ticks_per_sample())
    }

    /// Spectrum of the texture that plays at a speed and a force, once both rest.
    #[must_use]
    pub fn spectrum(&self, speed_mm_s: f32, force_n: f32) -> Spectrum {
        let filter = self.player.texture().filter_at(speed_mm_s, force_n);
        Spectrum::new(&filter, self.model_rate_hz())
    }
}
