//! The Asperity tick: device sample in, limited force out.
//!
//! A [`Renderer`] (configuration, immutable) and a [`Texture`] (compiled data,
//! immutable) drive any number of small [`State`]s. [`Renderer::tick`] allocates
//! nothing, locks nothing, calls no system, reads no clock and cannot panic; its
//! result is finite and within the device's limits for every input, NaN and
//! infinities included, and the same bits on every platform.
//!
//! Time is an argument: a simulator, a servo loop and a replay drive the same
//! function. One call is one servo period.
//!
//! Every stage is written once over an [`Arithmetic`]: [`Float`], the default, or [`Fixed`] for
//! processors without an FPU.
//!
//! | file | the paper's | computes |
//! |---|---|---|
//! | [`arithmetic`] | | floats, or fixed point with a binary point a quantity |
//! | [`velocity`] | v_t | velocity from positions |
//! | [`contact`] | δ, n̂ | depth and normal on a plane, a sphere, a box |
//! | [`locate`] | f–v grid | triangle and barycentric weights, edge models |
//! | `lsf` | a_k(F_n, v_t) | mixed LSFs to direct-form coefficients |
//! | [`vibration`] | y\[n\] | the model that sounds, made in shares over four to six ticks |
//! | [`excitation`] | ε | Gaussian noise |
//! | [`synthesis`] | | the AR or ARMA recursion |
//! | `interpolate` | | samples of the models to ticks of a faster servo loop |
//! | [`tap`] | a_tap(t) | impact detection and transient |
//! | [`friction`] | F_t | leaking bristle bounded by μF_n |
//! | [`wall`] | F_n | stiffness and damping that the device can bear |
//! | [`limiter`] | | peak and slew of the total force |
//! | `events` | | what happened in a tick, as flags, and how often |
//! | [`safety`] | | bad samples, safe state, ramp |
//! | [`scene`] | | which of several surfaces is touched, the way from one to the next |
//! | [`exchange`] | | another texture while the servo loop runs |
//!
//! ```
//! use asperity_formats::Asset;
//! use asperity_runtime::{Config, Flags, HostTexture, Renderer, Sample, State};
//!
//! # let bytes = include_bytes!(concat!(
//! #     env!("CARGO_MANIFEST_DIR"),
//! #     "/../tests/tests/assets/builtin-v1.asp"
//! # ));
//! let config = Config::default();
//! let renderer = Renderer::new(&config)?;
//! // Or a static, of your own capacities.
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
//! What must stay absent: allocation, a file system, a clock, platform maths, any
//! dependency on a crate above.
#![no_std]
#![forbid(unsafe_code)]

pub mod arithmetic;
mod complex;
pub mod config;
pub mod contact;
mod crossing;
mod cycle;
mod events;
pub mod exchange;
pub mod excitation;
pub mod friction;
mod interpolate;
mod lanes;
pub mod limiter;
pub mod locate;
mod lsf;
pub mod math;
mod resample;
pub mod safety;
pub mod scene;
mod schedule;
pub mod synthesis;
pub mod tap;
mod texture;
mod tick;
pub mod velocity;
pub mod vibration;
pub mod wall;
mod workspace;

pub use arithmetic::{Arithmetic, Fixed, Float};
pub use config::{
    Config, ConfigError, FrictionConfig, Limits, MechanicsConfig, SafetyConfig, TapConfig,
    VibrationAxis,
};
pub use contact::Surface;
pub use events::{Counters, Flags};
pub use exchange::{Exchange, Player, PrepareError, Preparer};
pub use interpolate::ticks_per_sample;
pub use locate::Barycentric;
pub use scene::{HostScene, Scene, SceneError, SceneState};
pub use synthesis::Filter;
pub use texture::{HostTexture, LoadError, Texture};
pub use tick::{Output, Renderer, Sample, State};
pub use wall::{Passivity, Wall};
