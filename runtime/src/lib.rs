//! The Asperity tick: device sample in, limited force out.
//!
//! A [`Renderer`] (configuration, immutable) and a [`Texture`] (compiled data, immutable) drive any
//! number of small [`State`]s. [`Renderer::tick`] allocates nothing, locks nothing, calls no
//! system, reads no clock and cannot panic; its result is finite and within the device's limits for
//! every input, NaN and infinities included. It is the same, to the bit, on every platform.
//!
//! Time is an argument: a simulator, a servo loop and a replay drive the same
//! function. One call is one servo period.
//!
//! ```
//! use asperity_formats::Asset;
//! use asperity_runtime::{Config, Flags, HostTexture, Renderer, Sample, State};
//!
//! # let bytes = include_bytes!(concat!(
//! #     env!("CARGO_MANIFEST_DIR"),
//! #     "/tests/data/builtin-v1.asp"
//! # ));
//! let config = Config::default();
//! let renderer = Renderer::new(&config)?;
//! // A static slot with capacities of your own does as well.
//! let mut texture = Box::new(HostTexture::new());
//! texture.load(&Asset::parse(bytes)?, config.servo_rate_hz)?;
//! let mut state = State::new(1);
//!
//! // 1 mm deep, at rest: the wall answers k·δ.
//! let mut output = renderer.tick(&texture, &mut state, &Sample::at([0.0, 0.0, -0.001]));
//! assert!(output.flags.contains(Flags::CONTACT));
//! assert!((output.force_n[2] - 0.5).abs() < 1e-6);
//!
//! // The device is lost: two ticks hold the last sample, then the force goes to zero.
//! for _ in 0..4 {
//!     output = renderer.tick(&texture, &mut state, &Sample::STALE);
//! }
//! assert!(output.flags.contains(Flags::SAFE_STATE));
//! assert_eq!(output.force_n, [0.0; 3]);
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```
//!
//! # What to read first
//!
//! [`tick`], which sums the forces of the stages, then [`stage`], a file for each of them. `docs/reading.md` in the
//! repository follows a sample through these files. To use the crate: [`Config`], [`HostTexture`] or a [`Texture`] with
//! capacities of your own, [`Renderer`], [`State`]; [`Exchange`] and [`Scene`] for more than one texture.
//!
//! # Where everything is
//!
//! Every stage is written once over a [`RenderArithmetic`]: [`Float`], the default, or [`Fixed`]
//! for processors without an FPU.
//!
//! | folder or file | what it holds |
//! |---|---|
//! | [`quantity`] | numbers with a unit; which product gives which unit |
//! | [`arithmetic`] | floats, or fixed point with a binary point for each unit |
//! | `model` | the paper's parameters at a speed and a force: edge models, barycentric weights, mixture, LSF → AR |
//! | `update` | the same, cut into slices over ticks |
//! | [`stage`] | gate, contact, velocity, wall, friction, tap, vibration (excitation, recursion, upsampling), limiter |
//! | [`tick`] | the sum of the stages: the paper's force equation |
//! | `texture` | the slot: an asset prepared for the tick |
//! | [`scene`] | which of several surfaces is touched |
//! | [`exchange`] | another texture while the servo loop runs |
//!
//! What must stay absent: allocation, a file system, a clock, platform maths, any
//! dependency on a crate above.
#![no_std]
#![forbid(unsafe_code)]

pub mod arithmetic;
mod capacity;
mod complex;
pub mod config;
mod coupling;
mod events;
pub mod exchange;
mod lanes;
mod load_error;
pub mod math;
mod model;
pub mod quantity;
mod range;
mod render_arithmetic;
mod renderer;
mod sample;
pub mod scene;
pub mod stage;
mod state;
mod texture;
mod texture_change;
pub mod tick;
mod update;

pub use arithmetic::{Arithmetic, Fixed, Float};
pub use asperity_formats::Solid;
pub use capacity::{Capacities, Capacity, HostCapacities};
pub use config::{
    Config, ConfigError, FrictionConfig, Limits, MechanicsConfig, SafetyConfig, TapConfig,
    VibrationAxis,
};
pub use events::{Counters, Flags};
pub use exchange::{Exchange, Player, PrepareError, Preparer};
pub use load_error::LoadError;
pub use model::{
    barycentric::{Barycentric, WeightSearch},
    filter::Filter,
    mixture::RowMixture,
    section_pair::{SectionPair, SectionProduct},
};
pub use render_arithmetic::RenderArithmetic;
pub use renderer::Renderer;
pub use sample::{Output, Sample};
pub use scene::{HostScene, Scene, SceneError, SceneState};
pub use stage::{passivity::Passivity, upsample::ticks_per_sample, wall::Wall};
pub use state::State;
pub use texture::{HostTexture, Needs, Texture};
