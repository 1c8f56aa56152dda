//! Words that move a contact law: "sticky honey", "packed snow".

use super::mix::tidied;
use asperity_language::phrase::degree;
use asperity_texture::model::{Adhesion, ContactLaw, Drag, Imprint, Relaxation, SpringPoint};
use serde::Deserialize;
use std::sync::LazyLock;

/// The words and what they move.
pub(super) const TABLE: &str = include_str!("words.toml");
/// Words that deny what follows.
const DENIALS: [&str; 7] = ["not", "no", "never", "non", "without", "hardly", "neither"];
/// Words between a denial or a degree and what it is about.
const BETWEEN: [&str; 8] = ["at", "all", "so", "as", "too", "a", "and", "or"];
/// Depth to which a crust reaches, mm.
const CRUST_MM: f64 = 1.0;

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct Table {
    effect: Vec<Effect>,
}

/// Factors on a law, 1 for what a word leaves alone.
#[derive(Debug, Clone, PartialEq, Deserialize)]
#[serde(deny_unknown_fields, default)]
struct Effect {
    words: Vec<String>,
    force: f64,
    depth: f64,
    crust: f64,
    damping: f64,
    relaxation: f64,
    time: f64,
    share: f64,
    #[serde(rename = "yield")]
    yields: f64,
    heal: f64,
    recovery: f64,
    viscous: f64,
    plough: f64,
    pull: f64,
    cling: f64,
    at_least: Least,
}

/// Least values of a law, 0 for none.
#[derive(Debug, Clone, Copy, PartialEq, Default, Deserialize)]
#[serde(deny_unknown_fields, default)]
struct Least {
    relaxation: f64,
    time: f64,
    share: f64,
    #[serde(rename = "yield")]
    yields: f64,
    viscous: f64,
    pull: f64,
}

impl Default for Effect {
    fn default() -> Self {
        Self {
            words: Vec::new(),
            force: 1.0,
            depth: 1.0,
            crust: 1.0,
            damping: 1.0,
            relaxation: 1.0,
            time: 1.0,
            share: 1.0,
            yields: 1.0,
            heal: 1.0,
            recovery: 1.0,
            viscous: 1.0,
            plough: 1.0,
            pull: 1.0,
            cling: 1.0,
            at_least: Least::default(),
        }
    }
}

static EFFECTS: LazyLock<Vec<Effect>> = LazyLock::new(|| {
    let table: Option<Table> = toml::from_str(TABLE).ok();
    table.map_or_else(Vec::new, |table| table.effect)
});

/// The effect of a word, or of its comparative.
fn effect(word: &str) -> Option<&'static Effect> {
    let of = |word: &str| {
        let mut effects = EFFECTS.iter();
        effects.find(|effect| effect.words.iter().any(|own| own == word))
    };
    let stem = || word.strip_suffix("er");
    let y = || Some(format!("{}y", stem()?.strip_suffix('i')?));
    of(word)
        .or_else(|| of(&y()?))
        .or_else(|| of(stem()?))
        .or_else(|| of(&format!("{}e", stem()?)))
}

/// Returns true for a word that says how something gives way, or how much so.
#[must_use]
pub fn is_said(word: &str) -> bool {
    let about = degree(word).is_some() || DENIALS.contains(&word) || BETWEEN.contains(&word);
    about || effect(word).is_some()
}

/// A law as the words beside the name of its material move it.
#[must_use]
pub(super) fn worded(law: ContactLaw, words: &[&str]) -> ContactLaw {
    let mut law = law;
    for (n, word) in words.iter().enumerate() {
        if let Some(effect) = effect(word) {
            law = tidied(effect.on(law, strength(&words[..n])));
        }
    }
    law
}

/// Strength of a word after these: 1 without a degree, negative for less, 0 where it is denied.
fn strength(before: &[&str]) -> f64 {
    let mut strength = 1.0;
    for word in before.iter().rev() {
        if DENIALS.contains(word) {
            return 0.0;
        } else if ["less", "least"].contains(word) {
            strength *= -1.0;
        } else if let Some(degree) = degree(word) {
            strength *= degree;
        } else if !BETWEEN.contains(word) {
            break;
        }
    }
    strength
}

impl Effect {
    /// A law with this effect, to a power.
    fn on(&self, law: ContactLaw, power: f64) -> ContactLaw {
        if power == 0.0 {
            return law;
        }
        let by = |factor: f64| match factor {
            1.0 => 1.0,
            // The opposite of none is as it was.
            0.0 if power < 0.0 => 1.0,
            factor => libm::pow(factor, power),
        };
        let least = if power > 0.0 {
            self.at_least
        } else {
            Least::default()
        };
        let within = |x: f64, least: f64, most: f64| x.max(least).min(most);
        let relaxation = law
            .relaxation
            .or((least.relaxation > 0.0).then_some(Relaxation {
                stiffness_n_m: least.relaxation,
                time_s: least.time,
            }));
        let imprint = law.imprint.or((least.share > 0.0).then_some(Imprint {
            yield_mm: 1.5,
            share: least.share,
            heal: 0.0,
            recovery_s: 0.0,
        }));
        let drag = law.drag.or((least.viscous > 0.0).then_some(Drag {
            viscous_n_s_m2: least.viscous,
            plough_n_m: 0.0,
        }));
        let adhesion = law.adhesion.or((least.pull > 0.0).then_some(Adhesion {
            pull_n: least.pull,
            stiffness_n_m: 150.0,
        }));
        ContactLaw {
            spring: self.spring(law.spring, &by),
            damping_s_m: within(law.damping_s_m * by(self.damping), 0.0, 100.0),
            relaxation: relaxation.map(|part| Relaxation {
                stiffness_n_m: within(
                    part.stiffness_n_m * by(self.relaxation),
                    least.relaxation,
                    1e4,
                ),
                time_s: within(part.time_s * by(self.time), least.time.max(0.005), 20.0),
            }),
            imprint: imprint
                .map(|part| Imprint {
                    yield_mm: within(part.yield_mm * by(self.yields), least.yields, 50.0),
                    share: within(
                        part.share * by(self.share),
                        least.share,
                        0.95_f64.max(part.share),
                    ),
                    heal: within(part.heal * by(self.heal), 0.0, 1.0),
                    recovery_s: within(part.recovery_s * by(self.recovery), 0.0, 60.0),
                })
                .filter(|part| part.share > 0.0),
            drag: drag
                .map(|part| Drag {
                    viscous_n_s_m2: within(
                        part.viscous_n_s_m2 * by(self.viscous),
                        least.viscous,
                        1e4,
                    ),
                    plough_n_m: within(part.plough_n_m * by(self.plough), 0.0, 1e3),
                })
                .filter(|part| part.viscous_n_s_m2 > 0.0 || part.plough_n_m > 0.0),
            adhesion: adhesion
                .map(|part| Adhesion {
                    pull_n: within(part.pull_n * by(self.pull), least.pull, 5.0),
                    stiffness_n_m: within(part.stiffness_n_m * by(self.cling), 5.0, 900.0),
                })
                .filter(|part| part.pull_n > 0.0),
        }
    }

    fn spring(&self, spring: Vec<SpringPoint>, by: &impl Fn(f64) -> f64) -> Vec<SpringPoint> {
        let (force, depth, crust) = (by(self.force), by(self.depth), by(self.crust));
        if spring.is_empty() || (force, depth, crust) == (1.0, 1.0, 1.0) {
            return spring;
        }
        let law = ContactLaw {
            spring,
            ..ContactLaw::default()
        };
        let scaled = |point: SpringPoint| SpringPoint {
            depth_mm: depth * point.depth_mm,
            force_n: force * point.force_n,
        };
        if crust == 1.0 {
            return law.spring.into_iter().map(scaled).collect();
        }
        // What the crust bears, everything below bears too.
        let top_n = law.spring_n(CRUST_MM, 0.0);
        let top = SpringPoint {
            depth_mm: CRUST_MM,
            force_n: crust * top_n,
        };
        let below = law
            .spring
            .into_iter()
            .filter(|point| point.depth_mm > CRUST_MM);
        let below = below.map(|point| SpringPoint {
            force_n: point.force_n + (crust - 1.0) * top_n,
            ..point
        });
        let mut points: Vec<SpringPoint> = std::iter::once(top).chain(below).collect();
        points.truncate(6);
        points.into_iter().map(scaled).collect()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_word_is_there_once_and_moves_something() {
        assert_eq!(EFFECTS.len(), TABLE.matches("[[effect]]").count());
        let mut words: Vec<&String> = EFFECTS.iter().flat_map(|effect| &effect.words).collect();
        assert!(words.iter().all(|word| effect(word).is_some()));
        let count = words.len();
        words.sort();
        words.dedup();
        assert_eq!(words.len(), count);
        for effect in EFFECTS.iter() {
            let words = effect.words.clone();
            assert_ne!(
                *effect,
                Effect {
                    words,
                    ..Effect::default()
                }
            );
        }
    }

    #[test]
    fn degrees_stress_and_denials_take_away() {
        let law = ContactLaw {
            adhesion: Some(Adhesion {
                pull_n: 0.2,
                stiffness_n_m: 50.0,
            }),
            ..ContactLaw::default()
        };
        let pull_n = |text: &str| {
            let words: Vec<&str> = text.split(' ').collect();
            worded(law.clone(), &words).adhesion.map(|part| part.pull_n)
        };
        assert_eq!(pull_n("sticky honey"), Some(0.4));
        assert_eq!(pull_n("stickier honey"), Some(0.4));
        assert_eq!(pull_n("not sticky honey"), Some(0.2));
        assert_eq!(pull_n("honey not at all sticky"), Some(0.2));
        assert_eq!(pull_n("less sticky honey"), Some(0.1));
        assert_eq!(pull_n("dry"), None);
        assert!(pull_n("very sticky honey") > pull_n("sticky honey"));
        assert!(pull_n("slightly sticky honey") < pull_n("sticky honey"));
    }
}
