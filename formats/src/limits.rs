//! Upper bounds of a valid asset; readers size their tables by these.

/// Vertices of the speed–force grid.
pub const MAX_VERTICES: usize = 64;
/// Triangles of the grid.
pub const MAX_TRIANGLES: usize = 128;
/// Order of A(z) and of B(z).
pub const MAX_ORDER: usize = 24;
/// Traces of the tap bank, one an impact speed.
pub const MAX_TAPS: usize = 16;
/// Samples of one tap trace at its source rate.
pub const MAX_TAP_SAMPLES: usize = 1024;
/// Friction anchors.
pub const MAX_ANCHORS: usize = 16;
/// Fewest points of a law of friction over speed.
pub const MIN_LAW_POINTS: usize = 2;
/// Most points of a law of friction over speed.
pub const MAX_LAW_POINTS: usize = 8;
/// Bytes of a name (texture or anchor), UTF-8.
pub const MAX_NAME_BYTES: usize = 64;
/// Bytes of the provenance section.
pub const MAX_PROVENANCE_BYTES: usize = 16 * 1024;
/// Numbers of one latent.
pub const MAX_LATENT: usize = 1024;
/// Bytes of the history section.
pub const MAX_HISTORY_BYTES: usize = 64 * 1024;
/// Sections of an asset.
pub const MAX_SECTIONS: usize = 16;
/// Surfaces of a scene.
pub const MAX_SURFACES: usize = 64;
/// Textures of a library.
pub const MAX_TEXTURES: usize = 1 << 20;

/// Smallest distance between neighbouring LSFs of A(z), and of the outermost ones
/// from 0 and π, in codes of π/65536: 0.0048 rad, 0.76 Hz at 1 kHz. It keeps
/// poles off the unit circle; how far, the compiler verifies.
pub const MIN_LSF_GAP_CODES: u16 = 100;

/// Range of every sample rate, Hz.
pub const SAMPLE_RATE_HZ: (f32, f32) = (100.0, 200_000.0);
/// Largest speed of a grid, mm/s.
pub const MAX_SPEED_MM_S: f32 = 10_000.0;
/// A grid reaches at least this speed, mm/s, and this force, N.
pub const MIN_EXTENT: f32 = 1e-3;
/// Largest force of a grid, N.
pub const MAX_FORCE_N: f32 = 1_000.0;
/// Largest standard deviation of the excitation, m/s².
pub const MAX_SIGMA_M_S2: f32 = 10_000.0;
/// Largest gain of a numerator.
pub const MAX_GAIN: f32 = 10_000.0;
/// Largest impact speed of a trace, m/s.
pub const MAX_IMPACT_SPEED_M_S: f32 = 100.0;
/// Largest acceleration of a trace, m/s².
pub const MAX_TAP_ACCEL_M_S2: f32 = 1.0e6;
/// Largest coefficient of friction.
pub const MAX_MU: f32 = 10.0;
/// Largest wall stiffness, N/m.
pub const MAX_STIFFNESS_N_M: f32 = 100_000.0;
/// Largest rendered wall damping, N·s/m.
pub const MAX_DAMPING_N_S_M: f32 = 1_000.0;
/// Most points of a spring's shape.
pub const MAX_SPRING_POINTS: usize = 6;
/// Largest damping that grows with the load, s/m.
pub const MAX_LOAD_DAMPING_S_M: f32 = 100.0;
/// Range of a time constant of relaxation, s.
pub const RELAXATION_S: (f32, f32) = (0.005, 20.0);
/// Largest elastic depth at which a surface yields, m.
pub const MAX_YIELD_M: f32 = 0.05;
/// Largest time constant with which an imprint recovers, s.
pub const MAX_RECOVERY_S: f32 = 60.0;
/// Largest viscous drag, N·s/m².
pub const MAX_VISCOUS_N_S_M2: f32 = 1.0e5;
/// Largest drag of ploughing, N/m.
pub const MAX_PLOUGH_N_M: f32 = 1.0e4;
/// Largest pull of adhesion, N.
pub const MAX_PULL_N: f32 = 100.0;
/// Largest power along an axis over that across it.
pub const MAX_POWER_RATIO: f32 = 2.0;
/// Range of the speed across an axis that a stroke along it sounds like, as a part of its speed.
pub const SPEED_RATIO: (f32, f32) = (0.125, 2.0);
/// Range of μ along an axis over μ across it.
pub const MU_RATIO: (f32, f32) = (0.0625, 4.0);
/// Largest vibration gain, s²/m.
pub const MAX_VIB_GAIN_S2_M: f32 = 1_000.0;
/// Largest effective mass, kg.
pub const MAX_EFFECTIVE_MASS_KG: f32 = 100.0;
/// Largest force the gains are relative to, N.
pub const MAX_DEVICE_FORCE_N: f32 = 10_000.0;
/// Largest coordinate and size of a scene, m.
pub const MAX_POSITION_M: f32 = 10_000.0;
/// Smallest radius and half edge length of a solid, m.
pub const MIN_SOLID_M: f32 = 1e-6;
