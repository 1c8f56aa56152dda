//! Kernels for the compiler's models.

use asperity::{
    model::{self, ModelGrid, mixture::BarycentricPoint},
    signal::spectrum::ArmaModel,
};
use asperity_kernels::{
    Rendering,
    design::Design,
    texture::{self, Numerator, Texture, Vertex},
};

/// A kernel of some design for a grid.
pub struct Kernel {
    rendering: Box<dyn Rendering>,
    sample_rate_hz: f64,
}

impl Kernel {
    /// The kernel; `None` where the design has no filter for the grid.
    ///
    /// The order is the grid's: the caller has applied [`Design::order`] already.
    #[must_use]
    pub fn new(design: &Design, grid: &ModelGrid) -> Option<Self> {
        let vertices: Vec<Vertex<'_>> = grid
            .vertices
            .iter()
            .map(|vertex| Vertex {
                lsf_rad: &vertex.lsf_rad,
                ma_lsf_rad: vertex.ma_lsf_rad.as_deref().unwrap_or_default(),
                level_m_s2: vertex.gain * vertex.sigma_m_s2,
            })
            .collect();
        let texture = Texture {
            sample_rate_hz: grid.sample_rate_hz,
            numerator: match grid.numerator {
                model::Numerator::None => Numerator::None,
                model::Numerator::Nyquist => Numerator::Nyquist,
                model::Numerator::Lsf => Numerator::Lsf,
            },
            vertices: &vertices,
        };
        Some(Self {
            rendering: asperity_kernels::kernel(design, &texture)?,
            sample_rate_hz: grid.sample_rate_hz,
        })
    }

    /// Starts from silence with the model at a place.
    pub fn settle(&mut self, place: &BarycentricPoint) {
        self.rendering.settle(&of(place));
    }

    /// The model that is rendered now, in f64.
    #[must_use]
    pub fn model(&self) -> ArmaModel {
        let filter = self.rendering.filter();
        ArmaModel {
            sample_rate_hz: self.sample_rate_hz,
            a: filter.a,
            b: filter.b,
            level_m_s2: filter.level_m_s2,
        }
    }

    /// Renders one sample, m/s², for each place and excitation.
    pub fn render(&mut self, places: &[BarycentricPoint], epsilon: &[f64]) -> Vec<f64> {
        let places: Vec<texture::BarycentricPoint> = places.iter().map(of).collect();
        self.rendering.render(&places, epsilon)
    }
}

fn of(place: &BarycentricPoint) -> texture::BarycentricPoint {
    texture::BarycentricPoint {
        vertices: place.vertices,
        weights: place.weights,
    }
}

#[cfg(test)]
mod tests;
