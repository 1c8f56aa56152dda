//! Mixing, conversion and synthesis in every way that a [`Design`] names.
//!
//! One generic kernel: what differs is looked up in the design, what does not is shared, so
//! that a difference between two designs is theirs.

mod convert;
mod line;
mod number;

pub use number::{Fixed16, Fixed32, Number, Rounds};

use super::design::{Arithmetic, Design, Level, Shape, Structure, Transition};
use asperity::{
    interpolate::Place,
    lsf,
    model::{ModelGrid, Numerator},
    reflection,
    spectrum::ArmaModel,
};
use asperity_formats::limits::MAX_ORDER;
use convert::{Row, stage};
use line::{Coefficients, Line};

/// Time constant of the smoothing, s: the runtime's.
const SMOOTHING_S: f64 = 0.005;
/// Floor of a mixed logarithm relative to the loudest vertex: −60 dB.
const LOG_FLOOR: f64 = 1e-3;

/// A kernel of some arithmetic.
pub trait Rendering: Send {
    /// Starts at a place: its model, at once, from silence.
    fn settle(&mut self, place: &Place);
    /// The model that is rendered now, in f64.
    fn model(&self) -> ArmaModel;
    /// Samples, m/s², one a place and an excitation.
    fn render(&mut self, places: &[Place], epsilon: &[f64]) -> Vec<f64>;
    /// Renders `ticks` samples over and over the same places; the last of them. Everything
    /// but the ticks costs the same for any number of them.
    fn repeat(&mut self, places: &[Place], epsilon: &[f64], ticks: usize) -> f64;
}

/// The kernel of a design for a grid, its LSFs rounded as the design says; `None` where
/// rounding leaves no filter, and for a direct LSP form of anything but LSFs.
///
/// The order is the grid's: [`Design::order`] is applied before.
#[must_use]
pub fn kernel(design: &Design, grid: &ModelGrid) -> Option<Box<dyn Rendering>> {
    let of_lsfs = matches!(design.shape, Shape::LsfOmega | Shape::LsfCosine);
    if design.structure == Structure::DirectLsp && !of_lsfs {
        return None;
    }
    Some(match design.arithmetic {
        Arithmetic::F64 => Box::new(Kernel::<f64, f64>::new(design, grid)?),
        Arithmetic::F32 => Box::new(Kernel::<f32, f32>::new(design, grid)?),
        Arithmetic::Fixed32 => Box::new(Kernel::<Fixed32, Fixed32>::new(design, grid)?),
        Arithmetic::Fixed16 => Box::new(Kernel::<Fixed32, Fixed16>::new(design, grid)?),
    })
}

/// What is mixed of a vertex.
#[derive(Debug, Clone, Copy)]
struct Parameters<P> {
    ar: Row<P>,
    ma: Row<P>,
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
    sample_rate_hz: f64,
    numerator: Numerator,
    order: usize,
    ma_order: usize,
    /// Orders rounded up to lanes of four.
    used: (usize, usize),
    vertices: Vec<Vertex<P>>,
    /// Share of the way that parameters go in one update.
    share: P,
    /// Share of a crossfade that passes in one tick.
    ramp: S,
    /// m/s² of a signal of 1.
    scale: f64,
    tick: usize,
    mixed: Parameters<P>,
    from: Coefficients<S>,
    to: Coefficients<S>,
    now: Coefficients<S>,
    level: P,
    line: Line<S>,
}

impl<P: Number + Rounds<S>, S: Number> Kernel<P, S> {
    fn new(design: &Design, grid: &ModelGrid) -> Option<Self> {
        let order = grid.order;
        let ma_order = match grid.numerator {
            Numerator::None => 0,
            Numerator::Nyquist => 1,
            Numerator::Lsf => grid.vertices.first()?.ma_lsf_rad.as_ref()?.len(),
        };
        let scale = scale(design, grid)?;
        let loudest = grid
            .vertices
            .iter()
            .fold(0.0, |most: f64, v| most.max(v.gain * v.sigma_m_s2));
        let vertices = grid
            .vertices
            .iter()
            .map(|vertex| {
                let ma = vertex.ma_lsf_rad.as_deref().unwrap_or_default();
                let level = vertex.gain * vertex.sigma_m_s2;
                Some(Vertex {
                    shape: Parameters {
                        ar: parameters(design, &stored(design, &vertex.lsf_rad))?,
                        // Zeros may lie on the circle, but not where a recursion ends.
                        ma: parameters(design, &apart(stored(design, ma)))?,
                    },
                    level: P::of(match design.level {
                        Level::Variance => (level / scale).powi(2),
                        Level::Rms => level / scale,
                        Level::Log => (level.max(LOG_FLOOR * loudest) / scale).ln(),
                    }),
                })
            })
            .collect::<Option<Vec<_>>>()?;
        let shares = 1.0 - (-(design.every as f64) / (SMOOTHING_S * grid.sample_rate_hz)).exp();
        Some(Self {
            design: *design,
            sample_rate_hz: grid.sample_rate_hz,
            numerator: grid.numerator,
            order,
            ma_order,
            used: (
                order.next_multiple_of(4),
                if ma_order == 1 && grid.numerator == Numerator::Nyquist {
                    4
                } else {
                    ma_order.next_multiple_of(4)
                },
            ),
            vertices,
            share: P::of(shares),
            ramp: S::of(1.0 / design.every as f64),
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
            line: Line::silent(),
        })
    }

    #[inline]
    fn mix_shape(&self, mix: &Mix<P>) -> Parameters<P> {
        let [a, b, c] = mix.vertices.map(|v| &self.vertices[v].shape);
        let [u, v, w] = mix.weights;
        let row = |a: &Row<P>, b: &Row<P>, c: &Row<P>, used: usize| {
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
        let step = |x: &mut Row<P>, target: &Row<P>, used: usize, share: P| {
            for (x, t) in x.iter_mut().zip(target).take(used) {
                *x = x.plus(share.times(t.minus(*x)));
            }
        };
        step(&mut self.mixed.ar, &target.ar, self.used.0, self.share);
        if self.numerator == Numerator::Lsf {
            step(&mut self.mixed.ma, &target.ma, self.used.1, self.share);
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
        let phase = self.tick % self.design.every;
        if phase == 0 {
            self.update(mix);
        }
        if self.design.transition == Transition::Crossfade {
            let share = S::of(phase as f64 + 1.0).times(self.ramp);
            self.now = Coefficients::between(&self.from, &self.to, share, self.used);
        }
        self.tick += 1;
        self.level = self.mix_level(mix);
        let e: S = self.level.times(epsilon).rounded();
        match self.design.structure {
            Structure::Direct => self.line.direct(&self.now, self.used, e),
            Structure::DirectLsp => {
                let chain = (self.used.1, self.numerator == Numerator::Lsf);
                let orders = (self.order, self.ma_order);
                self.line.lsp(&self.now, orders, chain, e)
            }
            Structure::Lattice => self.line.lattice(&self.now, self.order, self.used.1, e),
            Structure::NormalisedLattice => {
                self.line.normalised(&self.now, self.order, self.used.1, e)
            }
        }
    }

    fn inputs(places: &[Place], epsilon: &[f64]) -> Vec<(Mix<P>, P)> {
        places
            .iter()
            .zip(epsilon)
            .map(|(place, &epsilon)| (mix_of(place), P::of(epsilon)))
            .collect()
    }
}

impl<P: Number + Rounds<S>, S: Number> Rendering for Kernel<P, S> {
    fn settle(&mut self, place: &Place) {
        let mix = mix_of(place);
        self.mixed = self.mix_shape(&mix);
        self.now = self.convert();
        (self.from, self.to) = (self.now.clone(), self.now.clone());
        self.level = self.mix_level(&mix);
        self.line = Line::silent();
        self.tick = 0;
    }

    fn model(&self) -> ArmaModel {
        let values = |row: &Row<S>, order: usize| -> Vec<f64> {
            row[..order].iter().map(|x| x.value()).collect()
        };
        let monic = |rest: Vec<f64>| std::iter::once(1.0).chain(rest).collect::<Vec<f64>>();
        let unstaged = |row: &Row<S>, order: usize| -> Vec<f64> {
            (0..order).map(|i| row[stage(i, order)].value()).collect()
        };
        let chained = self.design.structure == Structure::DirectLsp;
        ArmaModel {
            sample_rate_hz: self.sample_rate_hz,
            a: match self.design.structure {
                Structure::Direct => monic(values(&self.now.ar, self.order)),
                Structure::DirectLsp => lsf::from_cosines(&unstaged(&self.now.ar, self.order)),
                Structure::Lattice | Structure::NormalisedLattice => {
                    reflection::step_up(&values(&self.now.ar, self.order))
                }
            },
            b: if chained && self.numerator == Numerator::Lsf {
                lsf::from_cosines(&unstaged(&self.now.ma, self.ma_order))
            } else {
                monic(values(&self.now.ma, self.ma_order))
            },
            level_m_s2: self.level.value() * self.scale,
        }
    }

    fn render(&mut self, places: &[Place], epsilon: &[f64]) -> Vec<f64> {
        Self::inputs(places, epsilon)
            .iter()
            .map(|(mix, epsilon)| self.step(mix, *epsilon).value() * self.scale)
            .collect()
    }

    fn repeat(&mut self, places: &[Place], epsilon: &[f64], ticks: usize) -> f64 {
        let inputs = Self::inputs(places, epsilon);
        let mut last = S::ZERO;
        for (mix, epsilon) in inputs.iter().cycle().take(ticks) {
            last = self.step(mix, *epsilon);
        }
        last.value()
    }
}

fn mix_of<P: Number>(place: &Place) -> Mix<P> {
    Mix {
        vertices: place.vertices,
        weights: place.weights.map(P::of),
    }
}

fn rounded<P: Number + Rounds<S>, S: Number>(out: &mut Row<S>, row: &Row<P>, order: usize) {
    for (out, x) in out.iter_mut().zip(row).take(order) {
        *out = x.rounded();
    }
}

/// m/s² of a signal of 1: fixed point runs relative to the loudest vertex's RMS.
fn scale(design: &Design, grid: &ModelGrid) -> Option<f64> {
    if matches!(design.arithmetic, Arithmetic::F64 | Arithmetic::F32) {
        return Some(1.0);
    }
    let loudest = grid
        .vertices
        .iter()
        .map(|vertex| super::statistics::rms(&ArmaModel::at_vertex(grid, vertex)))
        .fold(0.0, f64::max);
    (loudest > 0.0 && loudest.is_finite()).then_some(loudest)
}

fn stored(design: &Design, lsf_rad: &[f64]) -> Vec<f64> {
    lsf_rad
        .iter()
        .map(|&omega| quantised(omega, design.lsf_bits))
        .collect()
}

/// Frequencies that rounding made one, a little apart.
fn apart(mut lsf_rad: Vec<f64>) -> Vec<f64> {
    let mut least = 0.0;
    for omega in &mut lsf_rad {
        *omega = omega.max(least);
        least = *omega + 1e-7;
    }
    lsf_rad
}

/// The parameters that stand for some LSFs; `None` where two of them meet and no filter has
/// such parameters.
fn parameters<P: Number>(design: &Design, lsf_rad: &[f64]) -> Option<Row<P>> {
    let order = lsf_rad.len();
    let mut row = [P::ZERO; MAX_ORDER];
    match design.shape {
        Shape::LsfOmega | Shape::LsfCosine => {
            for (index, &omega) in lsf_rad.iter().enumerate() {
                let value = if design.shape == Shape::LsfOmega {
                    omega
                } else {
                    libm::cos(omega)
                };
                row[stage(index, order)] = P::of(value);
            }
        }
        Shape::Coefficients => {
            for (place, a) in row.iter_mut().zip(&lsf::to_polynomial(lsf_rad)[1..]) {
                *place = P::of(*a);
            }
        }
        Shape::Reflection | Shape::LogArea => {
            let reflection = reflection::step_down(&lsf::to_polynomial(lsf_rad))?;
            for (place, k) in row.iter_mut().zip(reflection) {
                *place = P::of(if design.shape == Shape::Reflection {
                    k
                } else {
                    libm::log((1.0 + k) / (1.0 - k))
                });
            }
        }
    }
    Some(row)
}

/// A frequency as some bits hold it: steps of π/2ᵇ.
fn quantised(omega_rad: f64, bits: u32) -> f64 {
    if bits > 32 {
        return omega_rad;
    }
    let step = std::f64::consts::PI / f64::from(1 << bits);
    let last = f64::from((1_u32 << bits) - 1);
    (omega_rad / step).round().clamp(1.0, last) * step
}

#[inline]
fn cosines<P: Number>(shape: Shape, mixed: &Row<P>, order: usize) -> Row<P> {
    let mut row = *mixed;
    if shape == Shape::LsfOmega {
        for x in row.iter_mut().take(order) {
            *x = convert::cosine(*x);
        }
    }
    row
}

#[inline]
fn coefficients<P: Number>(shape: Shape, mixed: &Row<P>, order: usize) -> Row<P> {
    match shape {
        Shape::Coefficients => *mixed,
        Shape::LsfOmega | Shape::LsfCosine => {
            convert::from_cosines(&cosines(shape, mixed, order), order)
        }
        Shape::Reflection | Shape::LogArea => {
            convert::step_up(&reflections(shape, mixed, order), order)
        }
    }
}

#[inline]
fn reflections<P: Number>(shape: Shape, mixed: &Row<P>, order: usize) -> Row<P> {
    match shape {
        Shape::Reflection => *mixed,
        Shape::LogArea => {
            let mut row = *mixed;
            for x in row.iter_mut().take(order) {
                *x = convert::from_log_area(*x);
            }
            row
        }
        Shape::Coefficients | Shape::LsfOmega | Shape::LsfCosine => {
            convert::step_down(&coefficients(shape, mixed, order), order)
        }
    }
}

#[cfg(test)]
mod tests;
