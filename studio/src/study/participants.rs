//! Who takes part: pseudonyms and the secrets of their pages, which survive the program.

use super::dataset::Dataset;
use crate::token::Token;
use asperity_io::diagnostic::Fault;
use serde::{Deserialize, Serialize};

const FILE: &str = "sourcedata/participants.json";

/// All that have begun, in the order in which they did.
#[derive(Serialize, Deserialize)]
pub(crate) struct Participants {
    /// The secret of the study's address.
    token: String,
    participants: Vec<Participant>,
}

/// A participant.
#[derive(Serialize, Deserialize)]
pub(crate) struct Participant {
    pub(crate) subject: String,
    secret: String,
    pub(crate) withdrawn: bool,
}

impl Participants {
    /// Those of a dataset.
    ///
    /// # Errors
    /// [`Fault`] for a damaged file, and where it cannot be written or the system has no random numbers.
    pub(crate) fn open(dataset: &Dataset) -> Result<Self, Fault> {
        let remedy = "restore it from a copy, or run the study in a new folder";
        let Some(bytes) = dataset.read(FILE)? else {
            if dataset.has_tables()? {
                let what = "missing, although participants have answered";
                return Err(Fault::new(what, remedy).at(FILE));
            }
            let token = random()?.text().to_owned();
            let new = Self {
                token,
                participants: Vec::new(),
            };
            new.write(dataset)?;
            return Ok(new);
        };
        let known: Option<Self> = serde_json::from_slice(&bytes).ok();
        let known = known.filter(|it| {
            let tokens = it
                .participants
                .iter()
                .map(|one| &one.secret)
                .chain([&it.token]);
            tokens.cloned().all(|text| Token::restored(text).is_some())
        });
        known.ok_or_else(|| Fault::new("damaged", remedy).at(FILE))
    }

    /// The secret of the study's address.
    pub(crate) fn token(&self) -> Option<Token> {
        Token::restored(self.token.clone())
    }

    /// Adds one; the number, and the secret of their page.
    ///
    /// # Errors
    /// As [`open`](Self::open).
    pub(crate) fn add(&mut self, dataset: &Dataset) -> Result<(usize, String), Fault> {
        let number = self.participants.len();
        let secret = random()?.text().to_owned();
        self.participants.push(Participant {
            subject: format!("P{:02}", number + 1),
            secret: secret.clone(),
            withdrawn: false,
        });
        self.write(dataset).inspect_err(|_| {
            self.participants.pop();
        })?;
        Ok((number, secret))
    }

    /// Notes that one has withdrawn.
    ///
    /// # Errors
    /// [`Fault`] where it cannot be written.
    pub(crate) fn withdraw(&mut self, number: usize, dataset: &Dataset) -> Result<(), Fault> {
        self.participants[number].withdrawn = true;
        self.write(dataset)
    }

    /// The one whose page knows this secret.
    pub(crate) fn find(&self, secret: &str) -> Option<usize> {
        let is = |one: &Participant| {
            Token::restored(one.secret.clone()).is_some_and(|token| token.is(secret))
        };
        self.participants.iter().position(is)
    }

    /// Number of those who have not withdrawn.
    pub(crate) fn here(&self) -> usize {
        self.participants
            .iter()
            .filter(|one| !one.withdrawn)
            .count()
    }

    /// All of them.
    pub(crate) fn all(&self) -> &[Participant] {
        &self.participants
    }

    fn write(&self, dataset: &Dataset) -> Result<(), Fault> {
        dataset.write(FILE, &serde_json::to_vec_pretty(self).unwrap_or_default())
    }
}

fn random() -> Result<Token, Fault> {
    Token::random().map_err(|error| {
        let what = format!("the system gives no random numbers: {error}");
        Fault::new(
            what,
            "see that the system offers them (getrandom, /dev/urandom)",
        )
    })
}
