//! Pictures of materials by Stable Diffusion (Rombach et al., 2022), from an ONNX folder that the
//! user brings.
//!
//! | file | says |
//! |---|---|
//! | [`folder`](Parts), `index`, `ports` | what the folder must hold, and how it is checked |
//! | `tokenizer`, `text` | from a prompt to what the UNet attends to |
//! | [`scheduler`] | DDIM and Euler: coefficients of each step |
//! | `noise`, `unet`, `sampler` | from noise to a latent, with classifier-free guidance |
//! | `tile` | how a picture repeats |
//! | `vae`, `picture` | from a latent to colours |
//! | [`tiny`] | a folder for tests, whose picture is known |
//!
//! The crate reads no file and knows no engine. Noise and coefficients are the same on every
//! machine; the bits of a picture are those of the engine.
//!
//! ```
//! use asperity_diffusion::{Parts, Request, StableDiffusion, tiny};
//! use asperity_nn::{Portable, Session};
//!
//! let files = tiny::folder(&tiny::Options::default());
//! let bytes = |part: &str| files.iter().find(|(name, _)| *name == part).unwrap().1.clone();
//! let text = |part: &str| String::from_utf8(bytes(part)).unwrap();
//! let network = |part: &str| -> Box<dyn Session> {
//!     Box::new(Portable::from_bytes(&bytes(part)).unwrap())
//! };
//! let model = StableDiffusion::new(Parts {
//!     model_index: text("model_index.json"),
//!     scheduler_config: text("scheduler/scheduler_config.json"),
//!     vocabulary: text("tokenizer/vocab.json"),
//!     merges: text("tokenizer/merges.txt"),
//!     tokenizer_config: None,
//!     unet_config: Some(text("unet/config.json")),
//!     vae_config: None,
//!     text_encoder: network("text_encoder/model.onnx"),
//!     unet: network("unet/model.onnx"),
//!     vae_decoder: network("vae_decoder/model.onnx"),
//! })?;
//! let request = Request { steps: 4, tile: true, ..Request::new("cork".into(), 0) };
//! let sampled = model.sample(&request, &mut |_| {})?;
//! assert_eq!(sampled.picture.size, tiny::PICTURE);
//! # Ok::<(), asperity_diffusion::DiffusionError>(())
//! ```
#![forbid(unsafe_code)]

mod error;
pub mod folder;
mod index;
mod json;
mod noise;
mod picture;
mod ports;
mod sampler;
pub mod scheduler;
mod text;
mod tile;
pub mod tiny;
mod tokenizer;
mod unet;
mod vae;

pub use error::{DiffusionError, Problem};
pub use folder::Parts;
pub use picture::Picture;
pub use sampler::{Request, Sampled, StableDiffusion};
pub use scheduler::Method;
pub use tokenizer::{CONTEXT, Encoded, Tokens};
