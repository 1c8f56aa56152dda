//! A study, read, checked and compiled.

use super::{
    design::Design,
    forms::{self, Form},
    plan::{self, Step},
    simulate,
    stimuli::{self, Stimulus},
    text::Text,
};
use crate::prompts::{LoadPrompts, Prompts};
use asperity_io::diagnostic::{Failures, Fault, all, one};
use std::path::Path;

/// A study that is ready to run.
pub struct Study {
    pub(crate) design: Design,
    pub(crate) text: Text,
    pub(crate) forms: Vec<Form>,
    pub(crate) stimuli: Vec<Stimulus>,
    pub(crate) load: LoadPrompts,
}

/// The work of a participant.
#[derive(Debug, Clone, PartialEq, serde::Serialize)]
pub struct Outline {
    /// Title of the study.
    pub title: String,
    /// Textures that are rated, midpoints included.
    pub textures: usize,
    /// Steps: ratings, breaks, forms, prompts and consent.
    pub steps: usize,
    /// Ratings, practice and repeated ones included.
    pub ratings: usize,
    /// Questionnaires.
    pub forms: usize,
    /// Prompts of the participant's own.
    pub prompts: usize,
    /// About how long it takes, min: least times of exploring and breaks, and 4 s a slider, 6 s an item of a form, 60 s a
    /// prompt, which are assumed.
    pub minutes: f64,
    /// Participants after which every texture has stood at every place equally often; `None` where the order is drawn.
    pub balanced_after: Option<usize>,
}

impl Study {
    /// Reads a study, and compiles every texture; `done` is called after each.
    ///
    /// # Errors
    /// Every [`Fault`] of the file, of its forms and of its textures, with line and field.
    pub fn open(path: &Path, load: LoadPrompts, done: impl Fn()) -> Result<Self, Failures> {
        let text = Text::read(path).map_err(one)?;
        let design = Design::read(&text).map_err(all)?;
        let folder = path.parent().unwrap_or(Path::new(""));
        let forms = forms::forms(&design, &text, folder).map_err(one)?;
        let prompts = Prompts::new(Some(load));
        let loaded = prompts
            .get()
            .map_err(|error| one(Fault::new(error.error, error.help.unwrap_or_default())))?;
        let stimuli = stimuli::compile(&design, &text, loaded, done).map_err(all)?;
        Ok(Self {
            design,
            text,
            forms,
            stimuli,
            load,
        })
    }

    /// The work of a participant.
    #[must_use]
    pub fn outline(&self) -> Outline {
        let Self {
            design,
            forms,
            stimuli,
            ..
        } = self;
        let steps = plan::steps(design, stimuli.len(), forms, 0);
        let count = |is: fn(&Step) -> bool| steps.iter().filter(|step| is(step)).count();
        let textures = stimuli.len();
        let rows = if textures.is_multiple_of(2) {
            textures
        } else {
            2 * textures
        };
        let participants = || rows / gcd(rows, design.ratings.repeats).max(1);
        Outline {
            title: design.title.clone(),
            textures,
            steps: steps.len(),
            ratings: count(|step| matches!(step, Step::Rating { .. })),
            forms: count(|step| matches!(step, Step::Form(_))),
            prompts: count(|step| *step == Step::Prompt),
            minutes: plan::seconds(design, &steps, forms) / 60.0,
            balanced_after: (design.ratings.order == super::design::Order::Latin && textures > 1)
                .then(participants),
        }
    }

    /// Writes the dataset of participants that nobody asked.
    ///
    /// # Errors
    /// [`Fault`] for a folder that has something in it or cannot be written.
    pub fn simulate(
        &self,
        participants: usize,
        seed: u64,
        folder: &Path,
        done: impl Fn(),
    ) -> Result<(), Fault> {
        simulate::simulate(self, participants, seed, folder, done)
    }
}

fn gcd(a: usize, b: usize) -> usize {
    if b == 0 { a } else { gcd(b, a % b) }
}
