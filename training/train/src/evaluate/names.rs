//! Part 7: whether a name finds its material, as trained and when it was left out of training.

use super::{
    EvaluateError, Watch,
    held_out::SAME,
    retrieval::{RetrievalRanks, TfIdf, Words, found},
    statistics::Share,
    subject::Subject,
    watch::pause,
};
use crate::{
    captions::{Captions, dot},
    config::{Config, TextStage},
    kernel_ridge::KernelRidge,
    lda_retrieval::LdaRetrieval,
    material::MaterialLatent,
    rng::Stream,
    text_stage::Examples,
    words_held_out::groups,
};
use asperity::learned::{Latent, friction::cosine};
use asperity_corpus::Corpus;
use serde::{Deserialize, Serialize};

/// Parts that the synonyms are left out in.
const FOLDS: usize = 5;

/// Part 7.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Names {
    /// Materials to choose from.
    pub materials: usize,
    /// Their names, by the latent of the model as it is.
    pub names: RetrievalRanks,
    /// Their synonyms, by the same.
    pub synonyms: RetrievalRanks,
    /// The synonyms, each left out of training; `None` for a model without a memory.
    pub left_out: Option<LeftOut>,
}

/// Synonyms that were left out of training.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct LeftOut {
    /// Synonyms.
    pub synonyms: usize,
    /// Parts that they were left out in; near synonyms of a material are in one.
    pub folds: usize,
    /// Phrases of the lexicon that were left out as nearly the same, over all parts.
    pub phrases: usize,
    /// By the latent of a text stage that was fitted without them.
    pub latent: RetrievalRanks,
    /// By the cosine of the text vector with the mean text of each material, without them.
    pub similarity: RetrievalRanks,
    /// TF-IDF over the remaining texts: words, and runs of three characters.
    pub tfidf: [RetrievalRanks; 2],
}

/// A name of a material.
struct Name<'a> {
    /// Place of its material among the anchors.
    owner: usize,
    /// Its place among the material's training texts.
    place: usize,
    text: &'a str,
    vector: &'a [f32],
}

/// Asks for every name and synonym, and fits the text stage without each fifth of the synonyms.
pub(super) fn measure(
    subject: &Subject,
    corpus: &Corpus,
    captions: &Captions,
    materials: &[usize],
    config: &Config,
    watch: &mut dyn Watch,
) -> Result<Names, EvaluateError> {
    let (names, synonyms) = names(corpus, captions, materials);
    watch.begin("names", 1 + FOLDS);
    let anchors = subject.anchors();
    let shipped = |by: &str, names: &[Name<'_>]| -> Result<RetrievalRanks, EvaluateError> {
        let vectors: Vec<Vec<f32>> = names.iter().map(|name| name.vector.to_vec()).collect();
        let projected = subject.project(&vectors)?;
        let scores = projected.iter().map(|said| scores(&said.z, &anchors));
        Ok(found(by, &owners(names), scores))
    };
    let names = shipped("names, as trained", &names)?;
    let as_trained = shipped("synonyms, as trained", &synonyms)?;
    watch.done(1);
    let setting = Setting {
        corpus,
        captions,
        materials,
        anchors: &anchors,
        synonyms: &synonyms,
    };
    let left_out = match &config.text_stage {
        Some(stage) => Some(setting.left_out(stage, config.seed, watch)?),
        None => None,
    };
    Ok(Names {
        materials: materials.len(),
        names,
        synonyms: as_trained,
        left_out,
    })
}

/// Names and synonyms of the anchors' materials.
fn names<'a>(
    corpus: &'a Corpus,
    captions: &'a Captions,
    materials: &[usize],
) -> (Vec<Name<'a>>, Vec<Name<'a>>) {
    let (mut names, mut synonyms) = (Vec::new(), Vec::new());
    for (owner, &m) in materials.iter().enumerate() {
        let (material, vectors) = (&corpus.materials[m], &captions.training[m]);
        let first = vectors.len() - captions.names[m];
        let texts = [&material.name].into_iter().chain(&material.synonyms);
        for (place, text) in (first..).zip(texts) {
            let to = if place == first {
                &mut names
            } else {
                &mut synonyms
            };
            to.push(Name {
                owner,
                place,
                text,
                vector: &vectors[place],
            });
        }
    }
    (names, synonyms)
}

/// Data shared by all folds.
struct Setting<'a> {
    corpus: &'a Corpus,
    captions: &'a Captions,
    materials: &'a [usize],
    anchors: &'a [Latent],
    synonyms: &'a [Name<'a>],
}

impl Setting<'_> {
    fn left_out(
        &self,
        stage: &TextStage,
        seed: u64,
        watch: &mut dyn Watch,
    ) -> Result<LeftOut, EvaluateError> {
        let fold = folds(self.synonyms, seed);
        let mut own = Vec::new();
        let mut ranked: [Vec<Vec<f64>>; 4] = Default::default();
        let mut phrases = 0;
        for number in 0..FOLDS {
            pause(watch, "names")?;
            let out: Vec<&Name<'_>> = (self.synonyms.iter().zip(&fold))
                .filter_map(|(name, &fold)| (fold == number).then_some(name))
                .collect();
            let captions = self.without(&out);
            phrases += self.captions.lexicon.len() - captions.lexicon.len();
            own.extend(out.iter().map(|name| name.owner));
            let vectors: Vec<&[f32]> = out.iter().map(|name| name.vector).collect();
            let latents = self.placed(&captions, stage, &vectors);
            ranked[0].extend(latents.iter().map(|z| scores(z, self.anchors)));
            let means: Vec<Vec<f32>> = self.materials.iter().map(|&m| captions.mean(m)).collect();
            ranked[1].extend(vectors.iter().map(|vector| {
                let scores = means.iter().map(|mean| f64::from(dot(mean, vector)));
                scores.collect()
            }));
            let documents = self.documents(&out);
            for (ranked, terms) in ranked[2..].iter_mut().zip([Words::All, Words::Trigrams]) {
                let index = TfIdf::new(&documents, terms);
                ranked.extend(out.iter().map(|name| index.scores(name.text)));
            }
            watch.done(2 + number);
        }
        let [latent, similarity, words, trigrams] = ranked;
        let found = |by: &str, scores: Vec<Vec<f64>>| found(by, &own, scores.into_iter());
        Ok(LeftOut {
            synonyms: self.synonyms.len(),
            folds: FOLDS,
            phrases,
            latent: found("latent z(text)", latent),
            similarity: found("text similarity", similarity),
            tfidf: [
                found("TF-IDF, words", words),
                found("TF-IDF, runs of three characters", trigrams),
            ],
        })
    }

    /// The texts without these names, and without the phrases that are nearly the same.
    fn without(&self, out: &[&Name<'_>]) -> Captions {
        let mut captions = self.captions.clone();
        for name in out.iter().rev() {
            // The last first, so that places before it stand.
            let m = self.materials[name.owner];
            captions.training[m].remove(name.place);
            captions.names[m] -= 1;
        }
        captions.lexicon.retain(|phrase| {
            let near = |name: &&Name<'_>| dot(&phrase.vector, name.vector) > SAME;
            !out.iter().any(near)
        });
        captions
    }

    /// Where a text stage that is fitted to these texts places vectors.
    fn placed(&self, captions: &Captions, stage: &TextStage, vectors: &[&[f32]]) -> Vec<Latent> {
        let materials: Vec<MaterialLatent> = self
            .materials
            .iter()
            .zip(self.anchors)
            .map(|(&material, &mean)| MaterialLatent {
                material,
                mean,
                caption: captions.mean(material),
            })
            .collect();
        let ratings: Vec<_> = self
            .materials
            .iter()
            .map(|&m| self.corpus.materials[m].rating)
            .collect();
        let examples = Examples::new(&materials, &ratings, captions, stage);
        let (texts, targets, weights) = examples.all();
        let memory = KernelRidge::fit(&texts, &targets, &weights, &stage.memory, |_, _, _| ());
        let mut latents = memory.project(vectors);
        if let Some(how) = &stage.memory.recall {
            let recall = LdaRetrieval::new(&memory, &materials, captions, how);
            let directions = memory.directions(vectors);
            recall.draw(self.anchors, &directions, &mut latents);
        }
        latents
    }

    /// The training texts of each material without these names.
    fn documents(&self, out: &[&Name<'_>]) -> Vec<Vec<&str>> {
        let owners = self.materials.iter().enumerate();
        owners
            .map(|(owner, &m)| {
                let material = &self.corpus.materials[m];
                let left_out = |text: &str| out.iter().any(|o| o.owner == owner && o.text == text);
                let captions = material
                    .training
                    .iter()
                    .map(|caption| caption.text.as_str());
                let names = [&material.name].into_iter().chain(&material.synonyms);
                let names = names.map(String::as_str).filter(|text| !left_out(text));
                captions.chain(names).collect()
            })
            .collect()
    }
}

/// The fold of each synonym: near synonyms of a material are left out together.
fn folds(synonyms: &[Name<'_>], seed: u64) -> Vec<usize> {
    let mut draws = Stream::seeded(seed);
    let mut folds = Vec::with_capacity(synonyms.len());
    for own in synonyms.chunk_by(|a, b| a.owner == b.owner) {
        let vectors: Vec<&[f32]> = own.iter().map(|name| name.vector).collect();
        let group = groups(&vectors);
        let count = group.iter().copied().max().map_or(0, |last| last + 1);
        let drawn: Vec<usize> = (0..count).map(|_| draws.below(FOLDS)).collect();
        folds.extend(group.iter().map(|&g| drawn[g]));
    }
    folds
}

fn owners(names: &[Name<'_>]) -> Vec<usize> {
    names.iter().map(|name| name.owner).collect()
}

fn scores(z: &Latent, anchors: &[Latent]) -> Vec<f64> {
    anchors.iter().map(|anchor| cosine(z, anchor)).collect()
}

impl Names {
    /// The better of the two TF-IDFs on left-out synonyms.
    #[must_use]
    pub fn baseline(&self) -> Option<Share> {
        let [words, trigrams] = &self.left_out.as_ref()?.tfidf;
        Some(if words.top_5.hits > trigrams.top_5.hits {
            words.top_5
        } else {
            trigrams.top_5
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn near_synonyms_of_a_material_are_left_out_together() {
        let at = |angle: f32| [angle.cos(), angle.sin()];
        let vectors = [at(0.0), at(0.3), at(1.5), at(0.0), at(3.0)];
        let owners = [0, 0, 0, 1, 1];
        let synonyms: Vec<Name<'_>> = (vectors.iter().zip(owners))
            .map(|(vector, owner)| Name {
                owner,
                place: 0,
                text: "",
                vector,
            })
            .collect();
        let mut apart = false;
        for seed in 0..50 {
            let fold = folds(&synonyms, seed);
            assert_eq!(fold[0], fold[1]);
            assert!(fold.iter().all(|&fold| fold < FOLDS));
            apart |= fold[0] != fold[2];
        }
        assert!(apart);
    }
}
