//! Section 7.

use super::{percent, retrieval::line, table};
use crate::evaluate::names::{LeftOut, Names};

const TITLES: [&str; 5] = ["by", "first", "among five", "MRR", "median rank"];

pub(super) fn section(part: &Names) -> String {
    let mut text = format!(
        "## 7. Does a name find its material?\n\n\
         Names and synonyms are training texts. Each ranks {} materials by the cosine of its latent \
         with the anchors.\n\n",
        part.materials
    );
    text += &table(&TITLES);
    text += &line(&part.names);
    text += &line(&part.synonyms);
    match &part.left_out {
        Some(out) => {
            text += &left_out(out);
            let baseline = part.baseline().map(percent).unwrap_or_default();
            text += &format!(
                "\n**Answer.** Of the names {} and of the synonyms {} find their material first. A \
                 synonym that was left out finds it among five in {}, by the better TF-IDF in {}.\n",
                percent(part.names.top_1),
                percent(part.synonyms.top_1),
                percent(out.latent.top_5),
                baseline
            );
        }
        None => {
            text += &format!(
                "\n**Answer.** Of the names {} find their material first. Synonyms were not left out: \
                 the model has no memory of texts that could be fitted without them.\n",
                percent(part.names.top_1)
            );
        }
    }
    text
}

fn left_out(out: &LeftOut) -> String {
    let mut text = format!(
        "\nThe {} synonyms, each left out of training in one of {} parts. Synonyms of a material that \
         are nearer than a cosine of 0.8 are left out together, and phrases of the lexicon nearer \
         than 0.9 with them ({} over all parts). The text stage is fitted anew without them. The \
         anchors stay, because names have no part in what a texture is, but the first stage did \
         see the synonyms as texts to align with. TF-IDF ranks by captions, names and remaining synonyms.\n\n",
        out.synonyms, out.folds, out.phrases
    );
    text += &table(&TITLES);
    let [words, trigrams] = &out.tfidf;
    for found in [&out.latent, &out.similarity, words, trigrams] {
        text += &line(found);
    }
    text
}
