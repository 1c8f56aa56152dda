//! The order in which triangles stand in blocks: along a Z curve.

use super::strips::STRIPS;
use crate::{arithmetic::Zero as _, capacity::Capacity};

/// The place on the curve of a cell of [`STRIPS`] × [`STRIPS`]: the bits of both numbers in turn.
pub(super) fn interleaved(x: usize, y: usize) -> u16 {
    /// The bits of a number, each with a zero before it.
    const SPREAD: [u16; STRIPS] = {
        let mut spread = [0; STRIPS];
        let mut x = 1;
        while x < STRIPS {
            spread[x] = (spread[x / 2] << 2) + x as u16 % 2;
            x += 1;
        }
        spread
    };
    SPREAD[x % STRIPS] | (SPREAD[y % STRIPS] << 1)
}

/// Sorts as many items as there are triangles, fewer than 256, by their places. Items of one place
/// keep their order. The sort goes by the lower half of a place, then by the upper half. It
/// compares nothing, so no branch is mispredicted.
pub(super) fn sort<I: Copy, S: Capacity>(items: &[I], places: &[u16], sorted: &mut [I]) {
    let places = places.get(..items.len()).unwrap_or(places);
    let mut order = S::Triangles::<u8>::ZERO;
    let order = order.as_mut();
    let lower = places.iter().map(|&place| usize::from(place));
    by_digit(lower.zip(0_u8..), order);
    let order = order.get(..places.len()).unwrap_or_default();
    let upper = order.iter().filter_map(|&item| {
        let item = usize::from(item);
        Some((usize::from(*places.get(item)?) / STRIPS, *items.get(item)?))
    });
    by_digit(upper, sorted);
}

/// Sorts items by a digit below [`STRIPS`]. Items of one digit keep their order.
fn by_digit<I>(items: impl Iterator<Item = (usize, I)> + Clone, sorted: &mut [I]) {
    let mut places = [0; STRIPS];
    for (digit, _) in items.clone() {
        places[digit % STRIPS] += 1;
    }
    let mut before = 0;
    for place in &mut places {
        (*place, before) = (before, before + *place);
    }
    for (digit, item) in items {
        let place = &mut places[digit % STRIPS];
        if let Some(sorted) = sorted.get_mut(*place) {
            *sorted = item;
        }
        *place += 1;
    }
}

#[cfg(test)]
mod tests {
    extern crate std;
    use super::*;
    use crate::capacity::Capacities;
    use std::vec::Vec;

    #[test]
    fn places_ascend_and_those_of_one_place_keep_their_order() {
        for count in [0, 1, 5, 56, 128] {
            let place = |t: usize| interleaved(t * 23 % 32, t * t % 11);
            let places: [u16; 128] = core::array::from_fn(place);
            let items: Vec<usize> = (0..count).collect();
            let mut sorted = [usize::MAX; 128];
            sort::<_, Capacities<0, 128, 0, 0, 0>>(&items, &places, &mut sorted);
            let mut expected = items.clone();
            expected.sort_by_key(|&t| places[t]);
            assert_eq!(sorted[..count], expected);
        }
    }

    #[test]
    fn a_place_has_the_bits_of_both_in_turn() {
        assert_eq!(interleaved(0b10110, 0), 0b01_00_01_01_00);
        assert_eq!(interleaved(0, 0b10110), 0b10_00_10_10_00);
        assert_eq!(interleaved(31, 31), 1023);
    }
}
