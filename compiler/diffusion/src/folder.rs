//! Contents of a model folder.

use asperity_nn::Session;

/// Pipeline class and name of the model.
pub const MODEL_INDEX: &str = "model_index.json";
/// Noise schedule and prediction type of the training.
pub const SCHEDULER_CONFIG: &str = "scheduler/scheduler_config.json";
/// Tokens and their ids.
pub const VOCABULARY: &str = "tokenizer/vocab.json";
/// Pairs of tokens that make a new one, in order.
pub const MERGES: &str = "tokenizer/merges.txt";
/// Padding of texts.
pub const TOKENIZER_CONFIG: &str = "tokenizer/tokenizer_config.json";
/// The text encoder.
pub const TEXT_ENCODER: &str = "text_encoder/model.onnx";
/// The denoising network.
pub const UNET: &str = "unet/model.onnx";
/// Its sizes.
pub const UNET_CONFIG: &str = "unet/config.json";
/// From latents to pictures.
pub const VAE_DECODER: &str = "vae_decoder/model.onnx";
/// Its scale.
pub const VAE_CONFIG: &str = "vae_decoder/config.json";

/// The texts and networks of a folder. Those in an `Option` have defaults: of Stable Diffusion 1
/// and 2, and padding with the end mark.
pub struct Parts {
    /// [`MODEL_INDEX`].
    pub model_index: String,
    /// [`SCHEDULER_CONFIG`].
    pub scheduler_config: String,
    /// [`VOCABULARY`].
    pub vocabulary: String,
    /// [`MERGES`].
    pub merges: String,
    /// [`TOKENIZER_CONFIG`].
    pub tokenizer_config: Option<String>,
    /// [`UNET_CONFIG`].
    pub unet_config: Option<String>,
    /// [`VAE_CONFIG`].
    pub vae_config: Option<String>,
    /// [`TEXT_ENCODER`].
    pub text_encoder: Box<dyn Session>,
    /// [`UNET`].
    pub unet: Box<dyn Session>,
    /// [`VAE_DECODER`].
    pub vae_decoder: Box<dyn Session>,
}
