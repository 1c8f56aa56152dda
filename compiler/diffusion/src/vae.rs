//! The decoder of the variational autoencoder: from a latent to colours.

use crate::{
    error::{DiffusionError, Problem},
    folder::{VAE_CONFIG, VAE_DECODER},
    json,
    picture::Picture,
    ports,
    tile::{ROLLS, rolled, weight},
    unet::Latent,
};
use asperity_nn::{ElementType, Session, Tensor};
use serde::Deserialize;

const INPUT: &str = "latent_sample";
const OUTPUT: &str = "sample";

/// Standard deviation of Stable Diffusion's latents, inverted.
const SCALING: f64 = 0.18215;
/// Pixels that a latent may make in one direction.
const PIXELS: std::ops::RangeInclusive<usize> = 1..=16;

/// The decoder of a folder.
pub(crate) struct VaeDecoder {
    session: Box<dyn Session>,
    output: String,
    scaling: f64,
    latent: Latent,
}

#[derive(Deserialize, Default)]
struct Config {
    scaling_factor: Option<f64>,
}

impl VaeDecoder {
    /// Checks the ports of a network that is given the UNet's latents.
    pub(crate) fn new(
        session: Box<dyn Session>,
        config: Option<&str>,
        latent: Latent,
    ) -> Result<Self, DiffusionError> {
        let config: Config = match config {
            Some(text) => json::parse(text).map_err(|problem| problem.of(VAE_CONFIG))?,
            None => Config::default(),
        };
        let scaling = config.scaling_factor.unwrap_or(SCALING);
        if !(1e-3..=1e3).contains(&scaling) {
            let problem = Problem::Field {
                field: "scaling_factor",
                found: scaling.to_string(),
                expected: "0.001 to 1000".into(),
            };
            return Err(problem.of(VAE_CONFIG));
        }
        let output = signature(&*session, latent).map_err(|problem| problem.of(VAE_DECODER))?;
        Ok(Self {
            session,
            output,
            scaling,
            latent,
        })
    }

    /// The picture of a latent, which repeats if `tile`.
    pub(crate) fn decode(&self, latent: &[f32], tile: bool) -> Result<Picture, DiffusionError> {
        let scaled: Vec<f32> = latent
            .iter()
            .map(|&x| (f64::from(x) / self.scaling) as f32)
            .collect();
        let planes = if tile {
            self.tiled(&scaled)
        } else {
            self.run(scaled)
        };
        let (size, planes) = planes.map_err(|problem| problem.of(VAE_DECODER))?;
        let area = size * size;
        // From −1..1 to 0..255.
        let byte = |x: f32| ((x * 0.5 + 0.5).clamp(0.0, 1.0) * 255.0).round() as u8;
        let pixels = (0..area).map(|at| [0, 1, 2].map(|c| byte(planes[c * area + at])));
        Ok(Picture {
            size,
            pixels: pixels.collect(),
        })
    }

    /// The middles of four decoded pictures.
    fn tiled(&self, latent: &[f32]) -> Result<(usize, Vec<f32>), Problem> {
        let half = self.latent.size / 2;
        let mut sum = (0, Vec::new());
        for (down, right) in ROLLS {
            let roll = |is_rolled: bool, half: usize| if is_rolled { half } else { 0 };
            let moved = rolled(
                latent,
                self.latent.size,
                roll(down, half),
                roll(right, half),
            );
            let (size, planes) = self.run(moved)?;
            let factor = size / self.latent.size;
            let back = |is_rolled: bool| size - roll(is_rolled, half * factor);
            let planes = rolled(&planes, size, back(down), back(right));
            sum.0 = size;
            sum.1.resize(planes.len(), 0.0);
            for (at, (sum, x)) in sum.1.iter_mut().zip(planes).enumerate() {
                let (y, x_place) = (at / size % size, at % size);
                *sum += weight(y, size, down) * weight(x_place, size, right) * x;
            }
        }
        Ok(sum)
    }

    /// Width, and three planes of colours in −1..1.
    fn run(&self, latent: Vec<f32>) -> Result<(usize, Vec<f32>), Problem> {
        let tensor = Tensor::f32(&self.latent.batch(1), latent);
        let when = || "of the last latent".to_owned();
        let (shape, data) = ports::run(&*self.session, &[(INPUT, &tensor)], &self.output, when)?;
        let latent = self.latent.size;
        match shape[..] {
            [1, 3, height, width]
                if height == width
                    && height % latent == 0
                    && PIXELS.contains(&(height / latent)) =>
            {
                Ok((width, data))
            }
            _ => {
                let size = 8 * latent;
                Err(ports::wrong_shape(
                    &self.output,
                    &shape,
                    &[1, 3, size, size],
                ))
            }
        }
    }
}

fn signature(session: &dyn Session, latent: Latent) -> Result<String, Problem> {
    let input = ports::input(session, INPUT, &[ElementType::F32], &[4])?;
    ports::no_others(session, &[INPUT], INPUT)?;
    for (axis, expected) in latent.batch(1).into_iter().enumerate() {
        if ports::fixed(input, axis).is_some_and(|size| size != expected) {
            return Err(Problem::Port {
                direction: "input",
                name: INPUT.to_owned(),
                found: input.to_string(),
                expected: format!("float32 {:?}, the UNet's latents", latent.batch(1)),
            });
        }
    }
    Ok(ports::output(session, OUTPUT, 4)?.name.clone())
}
