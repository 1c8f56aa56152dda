//! Contact laws with a part left out, and a linear spring in their place: what a tick costs, and what force it loses.

use super::statistics::Spread;
use crate::{signal::rms, stability::material::Material};
use asperity::{
    learned::contact,
    model::{ContactLaw, TextureModel},
    sources::builtin,
};
use asperity_runtime::{Config, Renderer, Sample, State};
use rayon::prelude::*;
use std::{collections::HashMap, f64::consts::TAU};

/// The load at the deepest point of a motion, N.
const LOAD_N: f64 = 2.0;
/// Ticks of each half of a motion: a press that is held, then strokes.
const HALF: usize = 2000;
/// A tick, s.
const TICK_S: f64 = 0.001;

/// What is rendered in the place of a whole law.
pub struct Design {
    /// Its name.
    pub name: &'static str,
    /// The law of which it leaves something out; `None` for a linear spring.
    left_out: Option<fn(&mut ContactLaw)>,
}

/// Every design; the first is the whole law, the second a linear spring.
pub const DESIGNS: [Design; 7] = [
    Design::without("whole law", |_| ()),
    Design {
        name: "a linear spring instead",
        left_out: None,
    },
    Design::without("a linear damper instead", |law| law.damping_s_m = 0.0),
    Design::without("without relaxation", |law| law.relaxation = None),
    Design::without("without imprint", |law| law.imprint = None),
    Design::without("without drag", |law| law.drag = None),
    Design::without("without adhesion", |law| law.adhesion = None),
];

impl Design {
    const fn without(name: &'static str, left_out: fn(&mut ContactLaw)) -> Self {
        Self {
            name,
            left_out: Some(left_out),
        }
    }

    /// The silent built-in texture that gives way as a material does; `None` where nothing is left out of its law.
    /// A linear spring bears 1 N as deep as the law does.
    fn texture(&self, material: &contact::Material) -> Option<TextureModel> {
        let mut texture = builtin::texture().silent();
        texture.friction.mu = material.mu.unwrap_or(texture.friction.mu);
        let whole = &material.law;
        match self.left_out {
            None => texture.wall.stiffness_n_m = 1000.0 / whole.pressed_mm(1.0, 0.0),
            Some(leave_out) => {
                let mut law = whole.clone();
                leave_out(&mut law);
                if law == *whole && self.name != DESIGNS[0].name {
                    return None;
                }
                contact::set(&mut texture, Some(law));
            }
        }
        Some(texture)
    }
}

/// A design over the materials whose law it changes.
#[derive(Debug, Clone, PartialEq)]
pub struct ContactSummary {
    /// The design's name.
    pub name: &'static str,
    /// Number of materials.
    pub materials: usize,
    /// Instructions of a whole tick in a stroke: mean over the materials.
    pub instructions: Option<f64>,
    /// The same of the whole laws of these materials.
    pub whole: Option<f64>,
    /// RMS error of the force away from the surface over the RMS of that force.
    pub press: Option<Spread>,
    /// RMS error of the force along the surface over the RMS of that force.
    pub drag: Option<Spread>,
}

/// Measures every design on every material of the compiler's table.
///
/// `count` gives the instructions a tick of what [`run`] runs with a material and a design; it is called once for each
/// design on each set of parts of a whole law.
pub fn measure(mut count: impl FnMut(&[usize]) -> Option<f64>) -> Vec<ContactSummary> {
    let mut known = HashMap::new();
    let materials: Vec<&contact::Material> = contact::materials().collect();
    let forces = |design: &Design, material: &contact::Material| {
        let depth_mm = material.law.pressed_mm(LOAD_N, 0.0);
        design
            .texture(material)
            .map(|texture| render(&texture, &motion(depth_mm)))
    };
    let truths: Vec<_> = materials
        .par_iter()
        .filter_map(|material| forces(&DESIGNS[0], material))
        .collect();
    let mut summaries = Vec::new();
    for (index, design) in DESIGNS.iter().enumerate() {
        let errors: Vec<(usize, [f64; 2])> = (materials.par_iter().zip(&truths).enumerate())
            .filter_map(|(n, (material, truth))| {
                forces(design, material).map(|found| (n, errors(truth, &found)))
            })
            .collect();
        let mut mean = |design: usize| {
            let counts = errors.iter().map(|&(material, _)| {
                // A part is left out of the material that was counted whole.
                let whole = parts(&materials[material].law);
                *known
                    .entry((whole, design))
                    .or_insert_with(|| count(&[material, design]))
            });
            let sum: Option<f64> = counts.sum();
            sum.map(|sum| sum / errors.len() as f64)
        };
        let spread = |axis: usize| {
            let of_axis: Vec<f64> = errors.iter().map(|(_, error)| error[axis]).collect();
            Spread::of(&of_axis)
        };
        summaries.push(ContactSummary {
            name: design.name,
            materials: errors.len(),
            instructions: mean(index),
            whole: mean(0),
            press: spread(0),
            drag: spread(1),
        });
    }
    summaries
}

/// Runs a design on a material for some ticks of strokes, for counting, and returns the last force, N.
///
/// `None` where there is no such material or design.
#[must_use]
pub fn run([material, design]: [usize; 2], ticks: usize) -> Option<f64> {
    let material = contact::materials().nth(material)?;
    let texture = DESIGNS.get(design)?.texture(material)?;
    let strokes = &motion(material.law.pressed_mm(LOAD_N, 0.0))[HALF..];
    let path: Vec<_> = strokes.iter().copied().cycle().take(ticks).collect();
    render(&texture, &path).pop().map(|[press, _]| press)
}

/// Which parts a law has.
fn parts(law: &ContactLaw) -> [bool; 5] {
    let drag = law.drag.is_some();
    let (relaxation, imprint) = (law.relaxation.is_some(), law.imprint.is_some());
    [
        law.damping_s_m > 0.0,
        relaxation,
        imprint,
        drag,
        law.adhesion.is_some(),
    ]
}

/// Positions along and above the surface, m: a press of 0.2 s that is held for 1.3 s and left, then strokes of 1.5 Hz
/// under a hand that presses and leaves at 1 Hz, down to `depth_mm` each.
fn motion(depth_mm: f64) -> Vec<[f64; 2]> {
    let held = |t: f64| (t / 0.2).min((1.7 - t) / 0.2).clamp(-0.1, 1.0);
    let waved = |t: f64| 0.5 - 0.6 * (TAU * t).cos();
    (0..2 * HALF)
        .map(|tick| {
            let t = (tick % HALF) as f64 * TICK_S;
            let (along_m, depth) = if tick < HALF {
                (0.0, held(t))
            } else {
                (0.03 * (1.5 * TAU * t).sin(), waved(t))
            };
            [along_m, -1e-3 * depth_mm * depth]
        })
        .collect()
}

/// Forces away from and along the surface, N, on the default device.
fn render(texture: &TextureModel, path: &[[f64; 2]]) -> Vec<[f64; 2]> {
    let material = Material::new(texture.clone()).expect("the compiler's own texture");
    let renderer = Renderer::new(&Config::default()).expect("the defaults");
    let mut state = State::new(1);
    path.iter()
        .map(|&[x, z]| {
            let sample = Sample::at([x as f32, 0.0, z as f32]);
            let force_n = renderer.tick(&material.slot, &mut state, &sample).force_n;
            [force_n[2], force_n[0]].map(f64::from)
        })
        .collect()
}

/// RMS of the error over the RMS of the truth, away from and along the surface.
fn errors(truth: &[[f64; 2]], found: &[[f64; 2]]) -> [f64; 2] {
    [0, 1].map(|axis| {
        let of = |forces: &[[f64; 2]]| -> Vec<f64> { forces.iter().map(|f| f[axis]).collect() };
        let (truth, found) = (of(truth), of(found));
        let apart: Vec<f64> = truth.iter().zip(&found).map(|(t, f)| f - t).collect();
        rms(&apart) / rms(&truth)
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Claim: a whole law has no error; a linear spring and a law without relaxation, imprint, drag or adhesion lose what
    /// a finger notices; damping over the load could as well be a linear damper.
    #[test]
    fn every_part_but_damping_is_felt() {
        let summaries = measure(|_| None);
        let most = |name: &str| {
            let summary = summaries
                .iter()
                .find(|summary| summary.name == name)
                .unwrap();
            summary.press.unwrap().max.max(summary.drag.unwrap().max)
        };
        assert_eq!(most(DESIGNS[0].name), 0.0);
        for design in DESIGNS.iter().skip(1) {
            let felt = most(design.name) > 0.1;
            assert_eq!(
                felt,
                design.name != "a linear damper instead",
                "{}",
                design.name
            );
        }
        assert!(summaries[1].press.unwrap().median > 0.2);
    }
}
