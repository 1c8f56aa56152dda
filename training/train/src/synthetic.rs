//! A small corpus and a text encoder for tests.

use asperity::learned::text::{Encoded, TextEncoder};
use asperity_corpus::{
    BINS, Caption, Corpus, Focus, Instance, Material, ORDER, Rating, TAP_SAMPLES, TAPS,
    UnifiedGrid, reference::LexiconEntry,
};

use crate::{
    evaluate::Watch,
    progress::{EpochLoss, Progress},
    rng::{Purpose, Stream},
};
use asperity_io::diagnostic::Fault;

/// Width of [`WordBag`]'s vectors.
pub(crate) const WIDTH: usize = 24;

/// A corpus of resonances, levels and decays that move along three hidden traits.
pub(crate) fn corpus(materials: usize, instances: usize) -> Corpus {
    let mut stream = Stream::new(7, Purpose::Initialisation, 0);
    let materials = (0..materials)
        .map(|index| {
            let traits = [stream.uniform(), stream.uniform(), stream.uniform()];
            let instances = (0..instances)
                .map(|_| instance(traits.map(|t| t + 0.02 * stream.normal())))
                .collect();
            let words = ["rough", "hard", "dull"].iter().zip(traits);
            let words: Vec<String> = words
                .map(|(w, t)| format!("{w}{}", (t * 6.0) as u8))
                .collect();
            let text = |focus: &str| format!("{focus} name{index} {}", words.join(" "));
            Material {
                name: format!("material {index}"),
                family: format!("family {}", index % 3),
                synonyms: Vec::new(),
                training: [
                    (Focus::Look, "look"),
                    (Focus::Touch, "touch"),
                    (Focus::Use, "use"),
                ]
                .map(|(focus, word)| Caption {
                    focus,
                    text: text(word),
                })
                .to_vec(),
                // As in the real corpus, they do not name the material.
                held_out: vec![format!("held {}", words.join(" "))],
                rating: Some(Rating {
                    rough: f64::from(traits[0]) * 100.0,
                    slippery: f64::from(1.0 - traits[0]) * 100.0,
                    hard: f64::from(traits[1]) * 100.0,
                }),
                mu: 0.2 + f64::from(traits[0]),
                stiffness_n_m: 500.0,
                prototype: instance(traits),
                instances,
            }
        })
        .collect();
    Corpus {
        name: "synthetic".into(),
        licence: "none".into(),
        crc32: 0x1234_5678,
        grid: UnifiedGrid::reference(),
        tap_speeds_m_s: std::array::from_fn(|index| 0.02 + 0.02 * index as f64),
        taps_synthetic: true,
        materials,
    }
}

fn instance([rough, hard, dull]: [f32; 3]) -> Instance {
    let mut instance = Instance {
        lsf_rad: [[0.0; ORDER]; BINS],
        level_db: [0.0; BINS],
        taps_m_s2: [[0.0; TAP_SAMPLES]; TAPS],
    };
    for (bin, (lsf_rad, level_db)) in instance
        .lsf_rad
        .iter_mut()
        .zip(&mut instance.level_db)
        .enumerate()
    {
        let place = bin as f32 / BINS as f32;
        *level_db = -30.0 + 20.0 * rough + 10.0 * place;
        let step = std::f32::consts::PI / (ORDER + 1) as f32;
        for (index, omega) in lsf_rad.iter_mut().enumerate() {
            let sway = 0.3 * (rough + place) * libm::sinf(index as f32 * (0.4 + dull));
            *omega = step * (index as f32 + 1.0 + sway);
        }
    }
    for (trace, samples) in instance.taps_m_s2.iter_mut().enumerate() {
        for (index, sample) in samples.iter_mut().enumerate() {
            let t = index as f32 / TAP_SAMPLES as f32;
            let decay = libm::expf(-t * (3.0 + 5.0 * dull));
            *sample = (1.0 + trace as f32) * decay * libm::sinf(t * (8.0 + 30.0 * hard));
        }
    }
    instance
}

/// Words hashed to directions: texts that share words are alike.
pub(crate) struct WordBag;

impl TextEncoder for WordBag {
    fn name(&self) -> &str {
        "minilm"
    }

    fn width(&self) -> usize {
        WIDTH
    }

    fn encode(&self, text: &str) -> Result<Encoded, Fault> {
        let mut vector = vec![0.0; WIDTH];
        for word in text.split_whitespace() {
            let key = word
                .bytes()
                .fold(1, |key: u64, byte| key.wrapping_mul(31) + u64::from(byte));
            let direction = Stream::new(key, Purpose::Initialisation, 1).normals(WIDTH);
            for (x, y) in vector.iter_mut().zip(direction) {
                *x += y;
            }
        }
        let norm = vector.iter().map(|x| x * x).sum::<f32>().sqrt();
        vector.iter_mut().for_each(|x| *x /= norm);
        Ok(Encoded {
            vector,
            tokens: text.split_whitespace().count(),
            cut: 0,
        })
    }
}

/// Phrases of words the captions use.
pub(crate) fn lexicon() -> Vec<LexiconEntry> {
    (0..6_u8)
        .map(|level| LexiconEntry {
            text: format!("rough{level} hard{}", 5 - level),
            rating: Rating {
                rough: f64::from(level) * 20.0,
                slippery: 100.0 - f64::from(level) * 20.0,
                hard: 100.0 - f64::from(level) * 20.0,
            },
            sure: 75.0,
        })
        .collect()
}

/// Listens to nothing.
pub(crate) struct Silent;

impl Progress for Silent {
    fn epoch(&mut self, _: usize, _: usize, _: &EpochLoss) {}
    fn text_epoch(&mut self, _: usize, _: usize, _: f32) {}
}

/// Listens to nothing.
pub(crate) struct Unwatched;

impl Watch for Unwatched {
    fn begin(&mut self, _: &str, _: usize) {}
    fn done(&mut self, _: usize) {}
}
