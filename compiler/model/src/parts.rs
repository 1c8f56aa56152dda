//! The text encoder, put together by the compiler, so that no run has to.

use asperity_model_text_encoder_1 as first;
use asperity_model_text_encoder_2 as second;
use asperity_model_text_encoder_3 as third;

const LENGTH: usize = first::PART.len() + second::PART.len() + third::PART.len();

pub(crate) static TEXT_ENCODER: [u8; LENGTH] = joined([first::PART, second::PART, third::PART]);

const fn joined<const N: usize, const PARTS: usize>(parts: [&[u8]; PARTS]) -> [u8; N] {
    let mut whole = [0; N];
    let mut rest: &mut [u8] = &mut whole;
    let mut index = 0;
    while index < PARTS {
        let (place, after) = rest.split_at_mut(parts[index].len());
        place.copy_from_slice(parts[index]);
        rest = after;
        index += 1;
    }
    assert!(rest.is_empty(), "the parts fill the whole");
    whole
}

#[cfg(test)]
mod tests {
    use super::{TEXT_ENCODER, first, joined, second, third};
    use crate::{
        AR_DECODER, CLIP_MERGES, DESCRIPTION, ENCODER, TAP_DECODER, TEXT_PROJECTION, VOCABULARY,
    };

    #[test]
    fn parts_follow_one_another() {
        assert_eq!(joined([&[1, 2], &[], &[3]]), [1, 2, 3]);
    }

    #[test]
    fn the_text_encoder_is_its_parts() {
        let parts = [first::PART, second::PART, third::PART];
        assert!(TEXT_ENCODER.iter().eq(parts.into_iter().flatten()));
    }

    /// A registry takes 10 MB. Weights hardly compress, so the files count as they are.
    #[test]
    fn every_package_is_small_enough_to_publish() {
        let here = ENCODER.len() + DESCRIPTION.len() + VOCABULARY.len() + CLIP_MERGES.len();
        let others = [
            TEXT_PROJECTION,
            AR_DECODER,
            TAP_DECODER,
            first::PART,
            second::PART,
            third::PART,
        ];
        let largest = others.map(<[u8]>::len).into_iter().fold(here, usize::max);
        assert!(largest < 9_500_000, "{largest}");
    }

    #[test]
    #[should_panic(expected = "the parts fill the whole")]
    fn parts_that_leave_a_gap_are_refused() {
        let _: [u8; 4] = joined([&[1, 2], &[3]]);
    }
}
