//! A kernel of any [`Design`].
//!
//! There is one generic kernel. It looks up in the design what differs and shares the rest,
//! so a difference between two kernels comes from their designs alone.

use crate::coefficients::Coefficients;
use crate::convert::{self, OrderArray};
use crate::design::{Arithmetic, Design, Level, Shape, Structure, Transition};
use crate::number::{Fixed16, Fixed32, Number, Rounds};
use crate::parameters::{Parameters, coefficients, cosines, parameters, reflections};
use crate::synthesis::Synthesis;
use crate::texture::{BarycentricPoint, Filter, Numerator, Texture};
use alloc::{boxed::Box, vec::Vec};
use asperity_formats::limits::MAX_ORDER;

/// Time constant of the smoothing, s: the runtime's.
const SMOOTHING_S: f64 = 0.005;
/// Floor of a mixed logarithm relative to the loudest vertex: −60 dB.
const LOG_FLOOR: f64 = 1e-3;
/// Samples of an impulse response. The slowest poles of known materials decay by 100 dB in 800.
const RESPONSE: usize = 2048;

/// A kernel, whatever its arithmetic.
pub trait Rendering: Send {
    /// Starts from silence with the model at a place.
    fn settle(&mut self, place: &BarycentricPoint);
    /// The filter that is rendered with now.
    fn filter(&self) -> Filter;
    /// Renders one sample, m/s², for each place and excitation.
    fn render(&mut self, places: &[BarycentricPoint], epsilon: &[f64]) -> Vec<f64>;
    /// Renders `ticks` samples, cycling over the places, and returns the last one.
    ///
    /// All work besides the ticks themselves costs the same for any number of ticks.
    fn repeat(&mut self, places: &[BarycentricPoint], epsilon: &[f64], ticks: usize) -> f64;
}

/// The kernel of a design for a texture, with LSFs rounded as the design says.
///
/// `None` where rounding leaves no filter, for a direct LSP form of anything but LSFs, and for
/// orders above [`MAX_ORDER`]. The order is the texture's: the caller has applied
/// [`Design::order`] already.
#[must_use]
pub fn kernel(design: &Design, texture: &Texture<'_>) -> Option<Box<dyn Rendering>> {
    let of_lsfs = matches!(design.shape, Shape::LsfOmega | Shape::LsfCosine);
    if design.structure == Structure::DirectLsp && !of_lsfs {
        return None;
    }
    Some(match design.arithmetic {
        Arithmetic::F64 => Box::new(Kernel::<f64, f64>::new(design, texture)?),
        Arithmetic::F32 => Box::new(Kernel::<f32, f32>::new(design, texture)?),
        Arithmetic::Fixed32 => Box::new(Kernel::<Fixed32, Fixed32>::new(design, texture)?),
        Arithmetic::Fixed16 => Box::new(Kernel::<Fixed32, Fixed16>::new(design, texture)?),
    })
}

struct Vertex<P> {
    shape: Parameters<P>,
    level: P,
}

#[derive(Clone, Copy)]
struct Mix<P> {
    vertices: [usize; 3],
    weights: [P; 3],
}

struct Kernel<P, S> {
    design: Design,
    numerator: Numerator,
    order: usize,
    ma_order: usize,
    /// Orders rounded up to lanes of four.
    used: (usize, usize),
    vertices: Vec<Vertex<P>>,
    /// Fraction of the way to their target that parameters go in one update.
    fraction: P,
    /// Fraction of a crossfade that has passed at each tick between two updates.
    ramp: Vec<S>,
    /// Acceleration for a signal of 1, m/s².
    scale: f64,
    tick: usize,
    mixed: Parameters<P>,
    from: Coefficients<S>,
    to: Coefficients<S>,
    now: Coefficients<S>,
    level: P,
    synthesis: Synthesis<S>,
}

impl<P: Number + Rounds<S>, S: Number> Kernel<P, S> {
    fn new(design: &Design, texture: &Texture<'_>) -> Option<Self> {
        let first = texture.vertices.first()?;
        let order = first.lsf_rad.len();
        let ma_order = match texture.numerator {
            Numerator::None => 0,
            Numerator::Nyquist => 1,
            Numerator::Lsf => first.ma_lsf_rad.len(),
        };
        if order.max(ma_order) > MAX_ORDER {
            return None;
        }
        let scale = scale(design, texture)?;
        let levels = texture.vertices.iter().map(|vertex| vertex.level_m_s2);
        let loudest = levels.fold(0.0, f64::max);
        let vertices = texture
            .vertices
            .iter()
            .map(|vertex| {
                let level = vertex.level_m_s2;
                Some(Vertex {
                    shape: parameters(design, vertex)?,
                    level: P::of(match design.level {
                        Level::Variance => (level / scale) * (level / scale),
                        Level::Rms => level / scale,
                        Level::Log => libm::log(level.max(LOG_FLOOR * loudest) / scale),
                    }),
                })
            })
            .collect::<Option<Vec<_>>>()?;
        let constants = design.update_ticks as f64 / (SMOOTHING_S * texture.sample_rate_hz);
        Some(Self {
            design: *design,
            numerator: texture.numerator,
            order,
            ma_order,
            used: (order.next_multiple_of(4), ma_order.next_multiple_of(4)),
            vertices,
            fraction: P::of(1.0 - libm::exp(-constants)),
            ramp: (1..=design.update_ticks)
                .map(|tick| S::of(tick as f64 / design.update_ticks as f64))
                .collect(),
            scale,
            tick: 0,
            mixed: Parameters {
                ar: [P::ZERO; MAX_ORDER],
                ma: [P::ZERO; MAX_ORDER],
            },
            from: Coefficients::zero(),
            to: Coefficients::zero(),
            now: Coefficients::zero(),
            level: P::ZERO,
            synthesis: Synthesis::silent(),
        })
    }

    #[inline]
    fn mix_shape(&self, mix: &Mix<P>) -> Parameters<P> {
        let [a, b, c] = mix.vertices.map(|v| &self.vertices[v].shape);
        let [u, v, w] = mix.weights;
        let row = |a: &OrderArray<P>, b: &OrderArray<P>, c: &OrderArray<P>, used: usize| {
            let mut row = [P::ZERO; MAX_ORDER];
            for (((row, a), b), c) in row.iter_mut().zip(a).zip(b).zip(c).take(used) {
                *row = u.times(*a).plus(v.times(*b)).plus(w.times(*c));
            }
            row
        };
        let has_ma = self.numerator == Numerator::Lsf;
        Parameters {
            ar: row(&a.ar, &b.ar, &c.ar, self.used.0),
            ma: row(&a.ma, &b.ma, &c.ma, if has_ma { self.used.1 } else { 0 }),
        }
    }

    #[inline]
    fn mix_level(&self, mix: &Mix<P>) -> P {
        let [a, b, c] = mix.vertices.map(|v| self.vertices[v].level);
        let [u, v, w] = mix.weights;
        let mixed = u.times(a).plus(v.times(b)).plus(w.times(c));
        match self.design.level {
            Level::Rms => mixed,
            Level::Variance => mixed.root(),
            Level::Log => mixed.exp(),
        }
    }

    #[inline]
    fn follow(&mut self, target: &Parameters<P>) {
        let step = |x: &mut OrderArray<P>, target: &OrderArray<P>, used: usize, fraction: P| {
            for (x, t) in x.iter_mut().zip(target).take(used) {
                *x = x.plus(fraction.times(t.minus(*x)));
            }
        };
        step(&mut self.mixed.ar, &target.ar, self.used.0, self.fraction);
        if self.numerator == Numerator::Lsf {
            step(&mut self.mixed.ma, &target.ma, self.used.1, self.fraction);
        }
    }

    fn convert(&self) -> Coefficients<S> {
        let mut out = Coefficients::zero();
        let ar = match self.design.structure {
            Structure::Direct => coefficients(self.design.shape, &self.mixed.ar, self.order),
            Structure::DirectLsp => cosines(self.design.shape, &self.mixed.ar, self.order),
            Structure::Lattice | Structure::NormalisedLattice => {
                reflections(self.design.shape, &self.mixed.ar, self.order)
            }
        };
        rounded(&mut out.ar, &ar, self.order);
        match self.numerator {
            Numerator::None => {}
            Numerator::Nyquist => out.ma[0] = S::of(1.0),
            Numerator::Lsf => {
                let ma = if self.design.structure == Structure::DirectLsp {
                    cosines(self.design.shape, &self.mixed.ma, self.ma_order)
                } else {
                    coefficients(self.design.shape, &self.mixed.ma, self.ma_order)
                };
                rounded(&mut out.ma, &ma, self.ma_order);
            }
        }
        if self.design.structure == Structure::NormalisedLattice {
            let one = P::of(1.0);
            let mut product = one;
            for (complement, k) in out.complement.iter_mut().zip(&ar).take(self.order) {
                let root = one.minus(k.times(*k)).root();
                product = product.times(root);
                *complement = root.rounded();
            }
            out.gain = one.over(product).rounded();
        }
        out
    }

    #[inline]
    fn update(&mut self, mix: &Mix<P>) {
        let target = self.mix_shape(mix);
        if self.design.transition == Transition::Smooth {
            self.follow(&target);
        } else {
            self.mixed = target;
        }
        if self.design.transition == Transition::Crossfade {
            self.from = self.to.clone();
            self.to = self.convert();
        } else {
            self.now = self.convert();
        }
    }

    #[inline]
    fn step(&mut self, mix: &Mix<P>, epsilon: P) -> S {
        let phase = self.tick % self.design.update_ticks;
        if phase == 0 {
            self.update(mix);
        }
        if self.design.transition == Transition::Crossfade {
            self.now = Coefficients::between(&self.from, &self.to, self.ramp[phase], self.used);
        }
        self.tick += 1;
        self.level = self.mix_level(mix);
        let e: S = self.level.times(epsilon).rounded();
        match self.design.structure {
            Structure::Direct => self.synthesis.direct(&self.now, self.used, e),
            Structure::DirectLsp => {
                let chain = (self.used.1, self.numerator == Numerator::Lsf);
                let orders = (self.order, self.ma_order);
                self.synthesis.lsp(&self.now, orders, chain, e)
            }
            Structure::Lattice => self
                .synthesis
                .lattice(&self.now, self.order, self.used.1, e),
            Structure::NormalisedLattice => {
                self.synthesis
                    .normalised(&self.now, self.order, self.used.1, e)
            }
        }
    }

    fn inputs(places: &[BarycentricPoint], epsilon: &[f64]) -> Vec<(Mix<P>, P)> {
        places
            .iter()
            .zip(epsilon)
            .map(|(place, &epsilon)| (mix_of(place), P::of(epsilon)))
            .collect()
    }
}

impl<P: Number + Rounds<S>, S: Number> Rendering for Kernel<P, S> {
    fn settle(&mut self, place: &BarycentricPoint) {
        let mix = mix_of(place);
        self.mixed = self.mix_shape(&mix);
        self.now = self.convert();
        (self.from, self.to) = (self.now.clone(), self.now.clone());
        self.level = self.mix_level(&mix);
        self.synthesis = Synthesis::silent();
        self.tick = 0;
    }

    fn filter(&self) -> Filter {
        let values = |row: &OrderArray<S>| row.map(Number::value);
        let monic = |row: OrderArray<f64>, order: usize| -> Vec<f64> {
            core::iter::once(1.0)
                .chain(row.into_iter().take(order))
                .collect()
        };
        let (ar, ma) = (values(&self.now.ar), values(&self.now.ma));
        let chained = self.design.structure == Structure::DirectLsp;
        let ar = match self.design.structure {
            Structure::Direct => ar,
            Structure::DirectLsp => convert::from_cosines(&ar, self.order),
            Structure::Lattice | Structure::NormalisedLattice => convert::step_up(&ar, self.order),
        };
        let ma = if chained && self.numerator == Numerator::Lsf {
            convert::from_cosines(&ma, self.ma_order)
        } else {
            ma
        };
        Filter {
            a: monic(ar, self.order),
            b: monic(ma, self.ma_order),
            level_m_s2: self.level.value() * self.scale,
        }
    }

    fn render(&mut self, places: &[BarycentricPoint], epsilon: &[f64]) -> Vec<f64> {
        Self::inputs(places, epsilon)
            .iter()
            .map(|(mix, epsilon)| self.step(mix, *epsilon).value() * self.scale)
            .collect()
    }

    fn repeat(&mut self, places: &[BarycentricPoint], epsilon: &[f64], ticks: usize) -> f64 {
        let inputs = Self::inputs(places, epsilon);
        let mut last = S::ZERO;
        for (mix, epsilon) in inputs.iter().cycle().take(ticks) {
            last = self.step(mix, *epsilon);
        }
        last.value()
    }
}

fn mix_of<P: Number>(place: &BarycentricPoint) -> Mix<P> {
    Mix {
        vertices: place.vertices,
        weights: place.weights.map(P::of),
    }
}

fn rounded<P: Number + Rounds<S>, S: Number>(
    out: &mut OrderArray<S>,
    row: &OrderArray<P>,
    order: usize,
) {
    for (out, x) in out.iter_mut().zip(row).take(order) {
        *out = x.rounded();
    }
}

/// Returns the acceleration for a signal of 1, m/s²: 1 in floating point, the loudest vertex's RMS in fixed point.
fn scale(design: &Design, texture: &Texture<'_>) -> Option<f64> {
    if matches!(design.arithmetic, Arithmetic::F64 | Arithmetic::F32) {
        return Some(1.0);
    }
    // The energy of an impulse response, by a filter that is converted once and held.
    let exact = Design {
        update_ticks: RESPONSE,
        transition: Transition::Hold,
        ..Design::ORACLE
    };
    let mut kernel = kernel(&exact, texture)?;
    let mut impulse = alloc::vec![0.0; RESPONSE];
    impulse[0] = 1.0;
    let energy = |vertex| {
        let place = BarycentricPoint {
            vertices: [vertex; 3],
            weights: [1.0, 0.0, 0.0],
        };
        kernel.settle(&place);
        let response = kernel.render(&alloc::vec![place; RESPONSE], &impulse);
        response.iter().map(|y| y * y).sum::<f64>()
    };
    let largest = (0..texture.vertices.len()).map(energy).fold(0.0, f64::max);
    (largest > 0.0 && largest.is_finite()).then(|| libm::sqrt(largest))
}
