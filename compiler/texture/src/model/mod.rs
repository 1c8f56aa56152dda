//! The intermediate model: one texture in f64 and SI units, and what follows from it alone.
//!
//! Every source ends here, and all that emits or shows a texture starts here.
//!
//! # Rules
//!
//! The types are plain data: their fields are public, and nothing is checked when a value is built. `lower` of the
//! crate `asperity` refuses a model that breaks a rule: it checks counts, tiling, frequencies and the friction law in
//! this order, encodes the parts, and parses the bytes again. `verify` then renders these bytes with the runtime. The
//! error follows each rule: `Mesh`, `TooMany`, `Frequency` and `Gap` are variants of `LowerError`, `Count` one of
//! [`EncodeError`], and a dotted name is the field of a [`FormatError::Invalid`] in [`EncodeError::Rejected`]. A model
//! file obeys the same rules, and stricter ones where noted (a `Fault` with the path of the field). NaN and
//! infinities lie outside every range. Numbers round to f32 unless noted. [`limits`] has the constants.
//!
//! **Grid** ([`ModelGrid`])
//! - Sample rate of all models: 100 to 200 000 Hz (`grid.sample_rate_hz`).
//! - 3 to 64 vertices, 1 to 128 triangles (`TooMany`; too few: `grid.vertex_count`, `grid.triangle_count`).
//! - Vertices: speed 0 to 10 000 mm/s, force 0 to 1000 N (`Mesh` if negative or not finite, else
//!   `grid.vertex.speed_mm_s`, `grid.vertex.force_n`). The largest of each is at least 0.001 (`grid.max_speed_mm_s`,
//!   `grid.max_force_n`).
//! - The triangles tile `[0, max_speed] × [0, max_force]` by [`mesh::check`]: indices exist, no hole, no overlap, areas
//!   within 10⁻⁶ of the rectangle's (`Mesh`). In f32 only the areas are checked, within 10⁻³ (`grid.triangle.area`).
//! - A triangle has three different indices (`grid.triangle`), in any orientation; its area may be 0. Vertices may
//!   share a position, where the runtime answers with any of their models; in a model file they must not.
//! - [`VertexKind`] is not checked. Only interior vertices count in [`tap_synthesis::frequency_hz`].
//!
//! **Models** ([`GridVertex`])
//! - [`order`](ModelGrid::order) is 1 to 24 (`TooMany`; 0: `grid.ar_order`), the length of every `lsf_rad` (`Count`).
//! - LSFs of A(z) ascend strictly in (0, π) rad; the first belongs to the sum polynomial ([`lsf::is_ordered`]). This is
//!   the condition for reflection coefficients inside (−1, 1), hence for a stable A(z). Outside \[0, π\]: `Frequency`.
//!   In codes of π/65536, neighbours and both ends are at least [`MIN_LSF_GAP_CODES`] apart: `Gap`.
//! - LSFs of B(z) with [`Numerator::Lsf`]: 1 to 24 (`grid.ma_order`), the same number at every vertex (`Count`), in
//!   \[0, π\] (`Frequency`), not descending in codes (`grid.model.ma_lsf`), since zeros may lie on the unit circle; in
//!   a model file strictly ascending in (0, π). With another numerator `lower` ignores them, and a model file must have
//!   none.
//! - σ is 0 to 10 000 m/s² (`grid.vertex.sigma_m_s2`), the gain 0 to 10 000 (`grid.model.gain`), both rounded to
//!   binary16. Without [`Numerator::Lsf`] the gain is 1: an asset stores no other, and `verify` compares levels
//!   (`Spectrum`).
//! - The level of a model is gain·σ in m/s², the excitation's variance its square. [`mixture`] mixes cos ω and gain·σ
//!   linearly, never variances or coefficients: an ordered A(z) at every vertex is ordered in between.
//!
//! **Taps** ([`TapBank`])
//! - Sample rate 100 to 200 000 Hz (`taps.sample_rate_hz`), also without traces: [`TapBank::default`] has none and is
//!   refused.
//! - At most 16 traces of 1 to 1024 samples (`TooMany`; 0: `taps.samples`), all of one length (`Count`).
//! - Impact speeds ascend strictly, above 0 and up to 100 m/s (`taps.trace.speed_m_s`). Samples lie within ±10⁶ m/s²
//!   (`taps.trace.samples`, `taps.trace.peak_m_s2`); they round to 12 bits of the trace's peak, and its impulse is
//!   kept.
//!
//! **Friction** ([`Friction`])
//! - μ is 0 to 10 (`friction.mu`).
//! - At most 16 anchors (`TooMany`), each with a name, μ 0 to 10 and weight 0 to 1 (`friction.anchor.mu`, `.weight`).
//!   Weights need not add up to 1, nor μ be the mean of the anchors: see [`Friction::anchors_mu`].
//! - A law has 2 to 8 points (`TooMany`; 1: `friction.law.count`; 0: no law). Speeds, 0 to 4095.9 mm/s, ascend strictly
//!   in codes of 1/16 (`friction.law.speed_mm_s`). Factors are 0 to 7.9999 in codes of 1/8192, and μ·factor is at most
//!   10 (`friction.law.factor`). [`FrictionLaw::through`] reduces to 8 points, [`FrictionLaw::beside`] cuts factors.
//!
//! **Contact law** ([`ContactLaw`])
//! - The spring has at most 6 points. Depths ascend strictly from 0, to 65.5 mm, in codes of 1 µm; forces do not fall,
//!   and rise somewhere (`contact.spring.depth_m`, `contact.spring.shape_m`). With a spring the wall's stiffness is its
//!   slope at 1 N, and an asset stores the steepest one.
//! - Damping: 0 to 100 s/m. Relaxation: stiffness above 0, up to 10⁵ N/m, time constant 0.005 to 20 s. Imprint: yield 0
//!   to 50 mm, share above 0, up to 1, healing 0 to 1, recovery 0 to 60 s. Drag: 0 to 10⁵ N·s/m² and 0 to 10⁴ N/m.
//!   Adhesion: pull above 0, up to 100 N, stiffness as the wall's. All: `contact.…`.
//!
//! **Direction** ([`Direction`])
//! - The axis has length 1, within 10⁻⁴ of its square. Power ratio: 0 to 2. Speed ratio: 0.125 to 2. Ratios of μ: 0.0625
//!   to 4, and μ, its law and a ratio together at most 10. All: `direction.…`.
//!
//! **Wall, gains, names, provenance**
//! - Stiffness: above 0, up to 10⁵ N/m. Damping: 0 to 1000 N·s/m. `vib_s2_m`: 0 to 1000 s²/m. Effective mass: 0 to 100
//!   kg. `f_max_n`: above 0, up to 10⁴ N. All: `surface.…`. [`defaults`] has valid ones; the pipeline's ceiling lowers
//!   gains.
//! - Names of textures and anchors: 1 to 64 bytes of UTF-8 without control characters ([`FormatError::Text`]). The
//!   names in a library differ.
//! - [`Provenance`] takes at most 16 KiB (`provenance.len`). `lower` replaces its `lsf_error_db`.
//!
//! **Runtime** (`verify`: `VerifyError`, or the runtime's `LoadError` in it)
//! - Queries over and beyond the grid, NaN included, have weights of 0 to 1 with sum 1 (`Weights`) and a stable filter
//!   (`Unstable`).
//! - Each vertex renders within 0.5 dB RMS of its model; one at 10⁻⁴ of the loudest or below stays silent (`Spectrum`).
//! - A scripted run stays finite, within peak force and slew, and never clamps the vibration (`Tick`).
//! - max |A| / min |A| of each model is at most 10⁵ (`Conditioning`; [`lsf::magnitude_range`] computes it in f64).
//! - A slot loads it at a servo rate of 1, 2, 3, … 20 times the models' rate (`Rate`). A small slot has less room
//!   (`Capacity`), fixed point a narrower range (`Range`).
//!
//! [`limits`]: asperity_formats::limits
//! [`MIN_LSF_GAP_CODES`]: asperity_formats::limits::MIN_LSF_GAP_CODES
//! [`EncodeError`]: asperity_formats::EncodeError
//! [`EncodeError::Rejected`]: asperity_formats::EncodeError::Rejected
//! [`FormatError::Invalid`]: asperity_formats::FormatError::Invalid
//! [`FormatError::Text`]: asperity_formats::FormatError::Text
//! [`lsf::is_ordered`]: crate::signal::lsf::is_ordered
//! [`lsf::magnitude_range`]: crate::signal::lsf::magnitude_range

pub mod attributes;
mod contact;
pub mod defaults;
mod direction;
mod friction_law;
pub mod mesh;
pub mod mixture;
pub mod shift;
pub mod tap_synthesis;
mod texture;
pub mod triangulate;

pub use contact::{Adhesion, ContactLaw, Drag, Imprint, Relaxation, SpringPoint};
pub use direction::{Bearing, Direction, StrokeFactors};
pub use friction_law::{FrictionLaw, LawPoint};
pub use texture::{
    Friction, FrictionAnchor, Gains, GridVertex, ModelGrid, Numerator, Provenance, TapBank,
    TapTrace, TextureModel, VertexKind, Wall,
};
