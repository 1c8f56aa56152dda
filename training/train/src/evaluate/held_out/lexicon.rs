//! The rated lexicon without what it says of the materials that a fold leaves out.

use crate::captions::{Captions, dot};
use asperity_corpus::{Material, Rating, leaks::TrainingTexts};

/// A phrase of the lexicon of a larger cosine with a left-out text is left out with it.
pub(in crate::evaluate) const SAME: f32 = 0.9;

/// The texts without every phrase of the lexicon that is a caption, a name or a synonym of the materials at the
/// indices `held_out`, whatever its articles, endings and order, or nearly the same as one by its vector.
pub(super) fn without(captions: &Captions, materials: &[Material], held_out: &[usize]) -> Captions {
    let left_out = || held_out.iter().map(|&index| &materials[index]);
    let texts = TrainingTexts::new(left_out().flat_map(|material| {
        let captions = material.training.iter().map(|caption| &caption.text);
        let names = material.synonyms.iter().chain([&material.name]);
        let all = captions.chain(&material.held_out).chain(names);
        all.map(String::as_str)
    }));
    let vectors = || {
        let own = |&index: &usize| {
            captions.training[index]
                .iter()
                .chain(&captions.held_out[index])
        };
        held_out.iter().flat_map(own)
    };
    let mut kept = captions.clone();
    kept.lexicon.retain(|phrase| {
        let near = |vector: &Vec<f32>| dot(&phrase.vector, vector) > SAME;
        !texts.hold(&phrase.text) && !vectors().any(near)
    });
    kept
}

/// Which of some ratings is nearest to another: the place in the list.
pub(super) fn nearest_rating(
    rating: &Rating,
    among: impl Iterator<Item = Option<Rating>>,
) -> Option<usize> {
    let apart = |other: &Rating| {
        let [rough, slippery, hard] = [
            other.rough - rating.rough,
            other.slippery - rating.slippery,
            other.hard - rating.hard,
        ];
        rough * rough + slippery * slippery + hard * hard
    };
    let rated = among.enumerate();
    let rated = rated.filter_map(|(place, other)| Some((place, apart(&other?))));
    rated
        .min_by(|a, b| a.1.total_cmp(&b.1))
        .map(|(place, _)| place)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::synthetic;
    use asperity_corpus::reference::LexiconEntry;

    #[test]
    fn phrases_of_a_left_out_material_go_and_the_others_stay() {
        let mut corpus = synthetic::corpus(4, 1);
        corpus.materials[2].synonyms = vec!["fine grit".into()];
        corpus.materials[3].synonyms = vec!["coarse wool".into()];
        let caption = corpus.materials[2].held_out[0].clone();
        let phrases = [
            "fine grit",
            "a grit that is fine",
            &caption,
            // Other words, and a vector that is nearly the same.
            &format!("{caption} {caption} {caption} indeed"),
            "coarse wool",
            "fine grit paper",
        ];
        let entry = synthetic::lexicon().remove(0);
        let lexicon = phrases.map(|text| LexiconEntry {
            text: text.into(),
            ..entry.clone()
        });
        let captions = Captions::encode(&corpus, &lexicon, &synthetic::WordBag).unwrap();
        let left = |held_out: &[usize]| -> Vec<String> {
            let kept = without(&captions, &corpus.materials, held_out);
            assert_eq!(
                (&kept.training, &kept.held_out),
                (&captions.training, &captions.held_out)
            );
            kept.lexicon.into_iter().map(|phrase| phrase.text).collect()
        };
        assert_eq!(left(&[2]), ["coarse wool", "fine grit paper"]);
        assert_eq!(left(&[0, 1]), phrases);
    }

    #[test]
    fn the_nearest_rating_is_that_of_least_distance_and_the_unrated_have_none() {
        let at = |rough, slippery, hard| Rating {
            rough,
            slippery,
            hard,
        };
        let among = [
            None,
            Some(at(9.0, 1.0, 1.0)),
            Some(at(4.0, 5.0, 6.0)),
            Some(at(5.0, 5.0, 8.0)),
        ];
        let nearest = |rating: Rating| nearest_rating(&rating, among.into_iter());
        assert_eq!(nearest(at(4.0, 5.0, 6.5)), Some(2));
        assert_eq!(nearest(at(9.0, 2.0, 1.0)), Some(1));
        assert_eq!(nearest(at(5.0, 5.0, 7.5)), Some(3));
        assert_eq!(nearest_rating(&at(1.0, 1.0, 1.0), [None].into_iter()), None);
    }
}
