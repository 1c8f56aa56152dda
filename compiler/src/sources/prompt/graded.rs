//! Attribute changes of a material by a stated number.

use super::{PromptCompiler, PromptError, named_things::Referent};
use asperity_language::words::grade::{
    Grade, PAPERS, Scale, grit_um, is_paper, janka, own_grain_um,
};
use asperity_texture::model::shift::Scales;

/// ln Hz of a tap by which a pile with a relief e times as coarse yields more.
const PILE_YIELDS: f64 = 0.6;
/// Known Shore hardnesses: a material and its number. D is counted from A 50, as E follows both:
/// lg(E/MPa) = 0.0235·S − 0.6403 (Ruess).
const SHORE: [(&str, f64); 2] = [("rubber", 65.0), ("acrylic sheet", 135.0)];
const D_FROM_A: f64 = 50.0;
/// Woods that the model knows, from the softest to the hardest, lbf.
const WOODS: [(&str, f64); 4] = [
    ("balsa", 80.0),
    ("pine", 560.0),
    ("oak", 1290.0),
    ("ebony", 3080.0),
];
/// The same of Mohs.
const MOHS: [(&str, f64); 2] = [("gypsum", 2.0), ("diamond", 10.0)];

impl PromptCompiler {
    /// A material at its grades. Where grades conflict, the last holds.
    pub(super) fn graded(&self, name: &str, grades: &[Grade]) -> Result<Referent, PromptError> {
        let mut found = self.thing(name)?;
        for (n, grade) in grades.iter().enumerate() {
            if !grades[n + 1..].iter().any(|later| later.conflicts(*grade)) {
                found = self.at_grade(found, name, *grade)?;
            }
        }
        Ok(found)
    }

    /// A named wood: as hard as it was measured, with the grain of the known wood that is next to it in
    /// hardness where only "wood" behind its name says that it is one. `None` for what is no wood.
    pub(super) fn wood(
        &self,
        name: &str,
        thing: Referent,
    ) -> Result<Option<Referent>, PromptError> {
        let Some(force) = janka(name) else {
            return Ok(None);
        };
        let known = WOODS.map(|(name, force): (&str, f64)| (name, libm::log(force)));
        let [softest, .., hardest] = known;
        let force = libm::log(force);
        let wood = self.as_hard(thing, [softest, hardest], force)?;
        if !name.ends_with(" wood") {
            return Ok(Some(wood));
        }
        let apart = |of: &&(&str, f64)| (of.1 - force).abs();
        let next = known.iter().min_by(|a, b| apart(a).total_cmp(&apart(b)));
        let (next, _) = next.unwrap_or(&softest);
        let z = self.named_thing(next)?.z;
        Ok(Some(Referent { z, ..wood }))
    }

    fn at_grade(&self, thing: Referent, name: &str, grade: Grade) -> Result<Referent, PromptError> {
        let Grade { scale, value } = grade;
        let coarser = grade.coarser(name);
        match scale {
            Scale::Grit { .. } if is_paper(name) => self.paper(grit_um(value, name)),
            Scale::Grit { .. } | Scale::Mesh => self.of_grain(thing, own_grain_um(name), coarser),
            Scale::ShoreA => self.as_hard(thing, SHORE, value),
            Scale::ShoreD => self.as_hard(thing, SHORE, value + D_FROM_A),
            Scale::Mohs => self.as_hard(thing, MOHS, value),
            Scale::Ra | Scale::Threads | Scale::Denier | Scale::Cut | Scale::Wale | Scale::Pile => {
                let rougher = moved(thing, 0, self.rough_per_e()? * libm::log(coarser));
                let yields = if scale == Scale::Pile {
                    PILE_YIELDS
                } else {
                    0.0
                };
                Ok(moved(rougher, 2, -yields * libm::log(coarser)))
            }
        }
    }

    /// Sandpaper with this grain: between the two that the model knows, or beyond the last, by the
    /// logarithm.
    fn paper(&self, grain_um: f64) -> Result<Referent, PromptError> {
        let after = PAPERS.iter().position(|(um, _)| *um <= grain_um);
        let after = after.unwrap_or(PAPERS.len() - 1).max(1);
        let [(coarse, a), (fine, b)] = [PAPERS[after - 1], PAPERS[after]];
        let t = libm::log(coarse / grain_um) / libm::log(coarse / fine);
        let (a, b) = (self.named_thing(a)?, self.named_thing(b)?);
        // A latent beyond those that are known may be anything; attributes go on.
        let within = t.clamp(0.0, 1.0) as f32;
        Ok(Referent {
            composed: true,
            z: std::array::from_fn(|k| a.z[k] + within * (b.z[k] - a.z[k])),
            wanted: std::array::from_fn(|k| {
                let (a, b) = (a.wanted[k]?, b.wanted[k]?);
                Some(if k == 2 {
                    a + f64::from(within) * (b - a)
                } else {
                    a + t * (b - a)
                })
            }),
        })
    }

    /// A material with grain so much coarser than its own: as much rougher and grippier as sandpaper would be.
    fn of_grain(
        &self,
        thing: Referent,
        own_um: f64,
        coarser: f64,
    ) -> Result<Referent, PromptError> {
        let (to, from) = (self.paper(coarser * own_um)?, self.paper(own_um)?);
        let by = |k: usize| Some(to.wanted[k]? - from.wanted[k]?);
        let thing = moved(thing, 0, by(0).unwrap_or(0.0));
        Ok(moved(thing, 1, by(1).unwrap_or(0.0)))
    }

    /// dB for grain, or relief, of e times the size, as sandpaper has it.
    fn rough_per_e(&self) -> Result<f64, PromptError> {
        let [(coarse, a), .., (fine, b)] = PAPERS;
        let rough = |name| Ok::<_, PromptError>(self.named_thing(name)?.wanted[0].unwrap_or(0.0));
        let (a, b): (f64, f64) = (rough(a)?, rough(b)?);
        Ok((a - b) / libm::log(coarse / fine))
    }

    /// A material of the hardness on the line through two known ones.
    fn as_hard(
        &self,
        thing: Referent,
        known: [(&str, f64); 2],
        number: f64,
    ) -> Result<Referent, PromptError> {
        let [(a, at_a), (b, at_b)] = known;
        let hard = |name| Ok::<_, PromptError>(self.named_thing(name)?.wanted[2]);
        let (a, b) = (hard(a)?, hard(b)?);
        let mut wanted: Scales = thing.wanted;
        let line = |a: f64, b: f64| a + (number - at_a) / (at_b - at_a) * (b - a);
        wanted[2] = a.zip(b).map(|(a, b)| line(a, b)).or(wanted[2]);
        Ok(Referent { wanted, ..thing })
    }
}

fn moved(mut thing: Referent, attribute: usize, by: f64) -> Referent {
    thing.wanted[attribute] = thing.wanted[attribute].map(|x| x + by);
    thing
}
