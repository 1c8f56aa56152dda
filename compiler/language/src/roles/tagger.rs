//! A bidirectional GRU over the states of words.
//!
//! `compiler/model/tools/export_roles.py` fits it. A token's input is its state and its [`Flags`]; a layer with ReLU, the GRU of
//! both directions, and a layer over both give the evidence of each [`Role`]. Sums are in one order, so that every
//! machine gives the same bits.

use super::{Flags, Role, STATE, WIDTH};
use std::sync::LazyLock;

/// Matrices in their order, each of int8, `inputs` rows of `outputs`, then a scale (float32, little-endian) of each column and
/// as many offsets.
const WEIGHTS: &[u8] = include_bytes!("tagger.bin");
/// Units of the first layer.
const UNITS: usize = 256;
/// Units of the GRU in a direction.
const HALF: usize = UNITS / 2;
/// Outputs.
const ROLES: usize = Role::ALL.len();

static TAGGER: LazyLock<Tagger> = LazyLock::new(Tagger::read);

/// A matrix with an offset of each column.
struct Layer {
    outputs: usize,
    weights: Vec<f32>,
    offsets: Vec<f32>,
}

impl Layer {
    /// The layer that the bytes begin with.
    fn read(bytes: &mut &'static [u8], inputs: usize, outputs: usize) -> Self {
        let (codes, rest) = bytes.split_at(inputs * outputs);
        let (numbers, rest) = rest.split_at(2 * outputs * size_of::<f32>());
        *bytes = rest;
        let (numbers, _) = numbers.as_chunks();
        let numbers: Vec<f32> = numbers.iter().map(|x| f32::from_le_bytes(*x)).collect();
        let (scales, offsets) = numbers.split_at(outputs);
        let rows = codes.chunks(outputs).flat_map(|row| row.iter().zip(scales));
        Self {
            outputs,
            weights: rows
                .map(|(code, scale)| f32::from(code.cast_signed()) * scale)
                .collect(),
            offsets: offsets.to_vec(),
        }
    }

    fn of(&self, input: impl Iterator<Item = f32>) -> Vec<f32> {
        let mut output = self.offsets.clone();
        for (x, row) in input.zip(self.weights.chunks(self.outputs)) {
            output.iter_mut().zip(row).for_each(|(y, w)| *y += x * w);
        }
        output
    }
}

/// A direction of the GRU: the gates reset, update and new side by side.
struct Direction {
    input: Layer,
    state: Layer,
}

impl Direction {
    fn read(bytes: &mut &'static [u8]) -> Self {
        Self {
            input: Layer::read(bytes, UNITS, 3 * HALF),
            state: Layer::read(bytes, HALF, 3 * HALF),
        }
    }

    /// The state after each input.
    fn of<'a>(&self, inputs: impl Iterator<Item = &'a Vec<f32>>) -> Vec<Vec<f32>> {
        let sigmoid = |x: f32| 1.0 / (1.0 + libm::expf(-x));
        let mut state = vec![0.0; HALF];
        let mut states = Vec::new();
        for input in inputs {
            let x = self.input.of(input.iter().copied());
            let h = self.state.of(state.iter().copied());
            for (n, state) in state.iter_mut().enumerate() {
                let reset = sigmoid(x[n] + h[n]);
                let update = sigmoid(x[HALF + n] + h[HALF + n]);
                let new = libm::tanhf(x[2 * HALF + n] + reset * h[2 * HALF + n]);
                *state = (1.0 - update) * new + update * *state;
            }
            states.push(state.clone());
        }
        states
    }
}

struct Tagger {
    first: Layer,
    forward: Direction,
    backward: Direction,
    last: Layer,
}

impl Tagger {
    fn read() -> Self {
        let mut bytes = WEIGHTS;
        Self {
            first: Layer::read(&mut bytes, STATE + WIDTH, UNITS),
            forward: Direction::read(&mut bytes),
            backward: Direction::read(&mut bytes),
            last: Layer::read(&mut bytes, 2 * UNITS, ROLES),
        }
    }

    /// The evidence of each role of every token.
    fn of(&self, states: &[Vec<f32>], flags: &[Flags]) -> Vec<Vec<f32>> {
        let tokens = states.iter().zip(flags);
        let first = tokens.map(|(state, flags)| {
            let mut units = self.first.of(state.iter().chain(flags).copied());
            units.iter_mut().for_each(|x| *x = libm::fmaxf(*x, 0.0));
            units
        });
        let first: Vec<Vec<f32>> = first.collect();
        let forward = self.forward.of(first.iter());
        let mut backward = self.backward.of(first.iter().rev());
        backward.reverse();
        let all = first.iter().zip(forward.iter().zip(&backward));
        all.map(|(first, (forward, backward))| {
            let units = first.iter().chain(forward).chain(backward).copied();
            self.last.of(units)
        })
        .collect()
    }
}

/// The likeliest role of each token that has a state, and the probability that it says what is touched.
#[must_use]
pub(crate) fn tag(states: &[Vec<f32>], flags: &[Flags]) -> Vec<(Role, f32)> {
    let all = TAGGER.of(states, flags).into_iter();
    all.map(|evidence| {
        let mut best = 0;
        for n in 1..evidence.len() {
            if evidence[n] > evidence[best] {
                best = n;
            }
        }
        let power = |n: usize| libm::expf(evidence[n] - evidence[best]);
        let sum: f32 = (0..evidence.len()).map(power).sum();
        (Role::ALL[best], power(Role::Surface as usize) / sum)
    })
    .collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Claim: the file holds the layers and nothing else.
    #[test]
    fn the_weights_are_read_to_their_end() {
        let layer = |inputs: usize, outputs: usize| inputs * outputs + 8 * outputs;
        let direction = layer(UNITS, 3 * HALF) + layer(HALF, 3 * HALF);
        let all = layer(STATE + WIDTH, UNITS) + 2 * direction + layer(2 * UNITS, ROLES);
        assert_eq!(WEIGHTS.len(), all);
    }
}
