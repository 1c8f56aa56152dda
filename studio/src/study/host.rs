//! A study that is running: which step is open for each participant, and what they answer.

use super::{
    answers::{Answered, Try},
    dataset::{Dataset, POSITION_BYTES, Row},
    participants::Participants,
    plan::{self, Phase, Step},
    prepared::Study,
    stimuli::prompted,
    utc::rfc3339,
};
use crate::{
    VERSION, device::LiveDevice, download::Download, error::ApiError, http::Status,
    limiter::Limiter, prompts::Prompts, texture::Texture, token::Token,
};
use asperity_io::diagnostic::Fault;
use serde_json::{Value, json};
use std::{
    collections::HashMap,
    path::Path,
    sync::{Arc, Mutex, MutexGuard, PoisonError},
    time::{Instant, SystemTime},
};

/// Ticks of a log: two minutes. What a hand does later is not kept.
const MOST_LOG_BYTES: usize = 120 * 16_000 * POSITION_BYTES;
/// Letters of a prompt.
const PROMPT_LETTERS: usize = 1000;

/// A study with its participants, behind a server.
pub struct StudyHost {
    study: Study,
    prompts: Prompts,
    dataset: Dataset,
    device: Option<LiveDevice>,
    participants: Mutex<Participants>,
    /// By the participant's number.
    sessions: Mutex<HashMap<usize, Arc<Mutex<Session>>>>,
    computing: Limiter,
    said: Box<dyn Fn(&str) + Send + Sync>,
}

/// The open step of a participant, and what belongs to it.
struct Session {
    steps: Vec<Step>,
    /// The open step, which is the number of trials that are kept.
    index: usize,
    /// Time up to the last answer, ms, and when that or the first look was.
    elapsed_ms: u64,
    since: Option<Instant>,
    started_at: String,
    /// Positions of the open trial.
    log: Vec<u8>,
    tries: Vec<Try>,
    withdrawn: bool,
}

impl StudyHost {
    /// Opens the dataset of a study in a folder; `said` hears who begins, ends and withdraws.
    ///
    /// # Errors
    /// [`Fault`] for a folder of another study, in use, or that cannot be written.
    pub fn open(
        study: Study,
        folder: &Path,
        device: Option<LiveDevice>,
        said: impl Fn(&str) + Send + Sync + 'static,
    ) -> Result<Self, Fault> {
        let dataset = Dataset::open(
            folder,
            (&study.design, &study.text),
            &study.stimuli,
            &study.forms,
            None,
        )?;
        let participants = Participants::open(&dataset)?;
        for one in participants.all() {
            dataset.progress(&one.subject)?;
        }
        Ok(Self {
            prompts: Prompts::new(Some(study.load)),
            study,
            dataset,
            device,
            participants: Mutex::new(participants),
            sessions: Mutex::default(),
            computing: Limiter::computing(),
            said: Box::new(said),
        })
    }

    /// The secret of its address, which is the same as long as its folder is.
    pub(crate) fn token(&self) -> Option<Token> {
        lock(&self.participants).token()
    }

    /// The device behind it.
    pub(crate) fn device(&self) -> Option<&LiveDevice> {
        self.device.as_ref()
    }

    /// Lets a page take part: a new participant, or the one whose secret it has.
    ///
    /// # Errors
    /// For an unknown secret, where all have begun, and where the folder cannot be written.
    pub(crate) fn join(&self, secret: Option<&str>) -> Result<Value, ApiError> {
        let mut participants = lock(&self.participants);
        let (number, secret) = match secret {
            Some(secret) => (
                participants.find(secret).ok_or_else(stranger)?,
                secret.to_owned(),
            ),
            None if participants.here() >= self.study.design.participants => {
                let help = "ask the experimenter";
                return Err(ApiError::new(
                    Status::Conflict,
                    "all places of this study are taken",
                    help,
                ));
            }
            None => {
                let (number, secret) = participants
                    .add(&self.dataset)
                    .map_err(|fault| unkept(&fault))?;
                (self.said)(&format!("{} begins", participants.all()[number].subject));
                (number, secret)
            }
        };
        Ok(json!({ "me": secret, "subject": participants.all()[number].subject }))
    }

    /// The participant whose page has this secret: pseudonym and session.
    fn session(&self, secret: &str) -> Result<(usize, String, Arc<Mutex<Session>>), ApiError> {
        let participants = lock(&self.participants);
        let number = participants.find(secret).ok_or_else(stranger)?;
        let one = &participants.all()[number];
        let mut sessions = lock(&self.sessions);
        if let Some(session) = sessions.get(&number) {
            return Ok((number, one.subject.clone(), Arc::clone(session)));
        }
        let (index, elapsed_ms) = self
            .dataset
            .progress(&one.subject)
            .map_err(|fault| unkept(&fault))?;
        let Study {
            design,
            stimuli,
            forms,
            ..
        } = &self.study;
        let session = Arc::new(Mutex::new(Session {
            steps: plan::steps(design, stimuli.len(), forms, number),
            index,
            elapsed_ms,
            since: None,
            started_at: String::new(),
            log: Vec::new(),
            tries: Vec::new(),
            withdrawn: one.withdrawn,
        }));
        sessions.insert(number, Arc::clone(&session));
        Ok((number, one.subject.clone(), session))
    }

    /// The step that is open.
    ///
    /// # Errors
    /// For an unknown secret.
    pub(crate) fn step(&self, secret: &str) -> Result<Value, ApiError> {
        let (_, _, session) = self.session(secret)?;
        let mut session = lock(&session);
        session.since.get_or_insert_with(Instant::now);
        session.log.clear();
        session.started_at = rfc3339(SystemTime::UNIX_EPOCH.elapsed().unwrap_or_default());
        let Study {
            design,
            stimuli,
            forms,
            ..
        } = &self.study;
        let mut shown = json!({ "index": session.index, "of": session.steps.len(), "title": design.title,
            "device": self.device.as_ref().map(|device| device.description().name.to_owned()),
            "device_rate_hz": self.device.as_ref().map(|device| device.description().rate_hz) });
        let mut say = |more: Value| {
            if let (Some(shown), Value::Object(more)) = (shown.as_object_mut(), more) {
                shown.extend(more);
            }
        };
        match session.open() {
            None => say(
                json!({ "kind": "end", "text": if session.withdrawn { "Your answers are deleted." } else { &design.thanks } }),
            ),
            Some(Step::Consent) => {
                say(json!({ "kind": "consent", "text": design.consent.get_ref() }))
            }
            Some(Step::Rating { texture, phase, .. }) => {
                self.play(&stimuli[texture].texture);
                let attributes: Vec<_> = design.attributes.iter().map(|it| it.get_ref()).collect();
                say(
                    json!({ "kind": "rating", "practice": phase == Phase::Practice, "attributes": attributes,
                    "texture": format!("api/stimulus/{secret}/{}", session.index) }),
                );
                say(self.felt());
            }
            Some(Step::Break { done }) => {
                let total = session
                    .steps
                    .iter()
                    .filter(|step| matches!(step, Step::Rating { .. }))
                    .count();
                say(
                    json!({ "kind": "break", "seconds": design.ratings.break_s, "done": done, "total": total }),
                );
            }
            Some(Step::Form(at)) => {
                say(json!({ "kind": "form" }));
                say(forms[at].shown());
            }
            Some(Step::Prompt) => {
                let prompts = design.prompts.as_ref();
                say(
                    json!({ "kind": "prompt", "text": prompts.map(|it| &it.text), "tries": prompts.map(|it| 1 + it.refinements) }),
                );
                say(self.felt());
                say(self.last_try(secret, &session));
            }
        }
        Ok(shown)
    }

    /// Tries of a prompt.
    fn most_tries(&self) -> usize {
        let prompts = self.study.design.prompts.as_ref();
        prompts.map_or(0, |it| 1 + it.refinements)
    }

    /// The prompt that was tried last, if any.
    fn last_try(&self, secret: &str, session: &Session) -> Value {
        let count = session.tries.len();
        let Some(last) = session.tries.last() else {
            return json!({});
        };
        json!({ "texture": format!("api/stimulus/{secret}/{}-{}", session.index, count - 1), "prompt": last.prompt,
            "width_mm": asperity::views::preview::WIDTH_MM, "tries_left": self.most_tries().saturating_sub(count) })
    }

    /// The conditions of every texture, alike for all.
    fn felt(&self) -> Value {
        let design = &self.study.design;
        json!({ "picture": design.picture, "explore": design.explore, "volume_db": design.volume_db,
            "width_mm": asperity::views::preview::WIDTH_MM })
    }

    fn play(&self, texture: &Texture) {
        if let Some(device) = &self.device {
            device.want("texture", texture.asset());
        }
    }

    /// A file of the texture that is open, by what is after `api/stimulus/`: `SECRET/INDEX.ENDING`, or `SECRET/INDEX-TRY.ENDING`.
    ///
    /// # Errors
    /// For an unknown secret, and a texture that is not open.
    pub(crate) fn stimulus(&self, address: &str) -> Result<(&'static str, Arc<[u8]>), ApiError> {
        let closed = || {
            ApiError::new(
                Status::NotFound,
                "this texture is not open now",
                "reload the page",
            )
        };
        let (secret, file) = address.split_once('/').ok_or_else(closed)?;
        let (place, ending) = file.split_once('.').ok_or_else(closed)?;
        let (index, tried) = place
            .split_once('-')
            .map_or((place, None), |(index, tried)| (index, Some(tried)));
        let (_, _, session) = self.session(secret)?;
        let texture = {
            let session = lock(&session);
            if index.parse() != Ok(session.index) {
                return Err(closed());
            }
            match (session.open(), tried) {
                (Some(Step::Rating { texture, .. }), None) => {
                    Arc::clone(&self.study.stimuli[texture].texture)
                }
                (Some(Step::Prompt), Some(tried)) => {
                    let tried: usize = tried.parse().map_err(|_| closed())?;
                    Arc::clone(&session.tries.get(tried).ok_or_else(closed)?.texture)
                }
                _ => return Err(closed()),
            }
        };
        let download = match ending {
            "worklet.asp" => Download::Worklet,
            "unlit.png" => Download::Unlit,
            "normal.png" => Download::Normals,
            _ => return Err(closed()),
        };
        let bytes = self.computing.take(|| download.bytes(&texture))?;
        Ok((download.content_type(), bytes))
    }

    /// Compiles a prompt that a participant tries.
    ///
    /// # Errors
    /// As `asperity compile`, for another step than the open one, and after the last try.
    pub(crate) fn try_prompt(
        &self,
        secret: &str,
        index: usize,
        prompt: &str,
    ) -> Result<Value, ApiError> {
        let (_, _, session) = self.session(secret)?;
        let mut session = lock(&session);
        if index != session.index || session.open() != Some(Step::Prompt) {
            return Err(elsewhere());
        }
        // A line of a table is a trial.
        let prompt = prompt.split_whitespace().collect::<Vec<_>>().join(" ");
        if prompt.chars().count() > PROMPT_LETTERS {
            return Err(ApiError::new(
                Status::Unprocessable,
                "the prompt is too long",
                "say it in fewer words",
            ));
        }
        // An answer that was lost is asked for again.
        if session
            .tries
            .last()
            .is_none_or(|last| last.prompt != prompt)
        {
            if session.tries.len() >= self.most_tries() {
                return Err(elsewhere());
            }
            let compile = || prompted(prompt.clone(), 0, self.prompts.get()?);
            let texture = self.computing.take(compile)?;
            self.play(&texture);
            session.tries.push(Try { prompt, texture });
        }
        session.log.clear();
        Ok(self.last_try(secret, &session))
    }

    /// Takes positions of the hand from tick `first` of the open trial on. A part that comes again takes its own place.
    ///
    /// # Errors
    /// For another step than the open one, for a gap, and for what are no positions.
    pub(crate) fn log(
        &self,
        secret: &str,
        index: usize,
        first: usize,
        positions: &[u8],
    ) -> Result<(), ApiError> {
        let (_, _, session) = self.session(secret)?;
        let mut session = lock(&session);
        if index != session.index {
            return Err(elsewhere());
        }
        let at = first.saturating_mul(POSITION_BYTES);
        let finite =
            |bytes: &[u8]| f32::from_le_bytes([bytes[0], bytes[1], bytes[2], bytes[3]]).is_finite();
        if !positions.len().is_multiple_of(POSITION_BYTES)
            || !positions.chunks_exact(4).all(finite)
            || at > session.log.len() && session.log.len() < MOST_LOG_BYTES
        {
            return Err(ApiError::new(
                Status::Unprocessable,
                "these are no positions that follow those before",
                "reload the page",
            ));
        }
        if at <= session.log.len() {
            session.log.truncate(at);
            let room = MOST_LOG_BYTES - at;
            session
                .log
                .extend_from_slice(&positions[..positions.len().min(room)]);
        }
        Ok(())
    }

    /// Keeps the answer to the open step, and opens the next one.
    ///
    /// # Errors
    /// For another step than the open one, an answer that is missing or impossible, and where it cannot be written: the
    /// step then stays open.
    pub(crate) fn answer(&self, secret: &str, given: &Answered) -> Result<(), ApiError> {
        let (_, subject, session) = self.session(secret)?;
        let mut session = lock(&session);
        let step = session
            .open()
            .filter(|_| given.index == session.index)
            .ok_or_else(elsewhere)?;
        let since = session.since.unwrap_or_else(Instant::now);
        let passed_ms = u64::try_from(since.elapsed().as_millis()).unwrap_or(u64::MAX);
        let elapsed_ms = session.elapsed_ms.saturating_add(passed_ms);
        let mut row = Row {
            trial_index: session.index,
            time_elapsed: elapsed_ms,
            // A page cannot have waited longer than the participant was here.
            rt: given.rt_ms.min(passed_ms),
            started_at: session.started_at.clone(),
            device: self
                .device
                .as_ref()
                .map_or("page", |it| it.description().name)
                .to_owned(),
            version: VERSION,
            ..Row::default()
        };
        let filled = given.fill(&mut row, step, &self.study, &session.tries);
        filled.map_err(|error| {
            ApiError::new(Status::Unprocessable, error, "answer every question")
        })?;
        let kept = || {
            if let Some(tried) = session.tries.last() {
                // The log renders with it again.
                let name = format!("materials/{}.asp", &row.asset_sha256[..16]);
                self.dataset.write(&name, tried.texture.asset())?;
            }
            if step.is_felt() && !session.log.is_empty() {
                row.log = self.dataset.log(&subject, session.index, &session.log)?;
            }
            self.dataset.append(&subject, &[row])
        };
        kept().map_err(|fault| unkept(&fault))?;
        session.index += 1;
        session.elapsed_ms = elapsed_ms;
        session.since = Some(Instant::now());
        session.log.clear();
        session.tries.clear();
        if session.index == session.steps.len() {
            (self.said)(&format!("{subject} has finished"));
        }
        Ok(())
    }

    /// Deletes what is kept of a participant.
    ///
    /// # Errors
    /// For an unknown secret, and where something cannot be deleted.
    pub(crate) fn withdraw(&self, secret: &str) -> Result<(), ApiError> {
        let (number, subject, session) = self.session(secret)?;
        let mut session = lock(&session);
        self.dataset
            .withdraw(&subject)
            .map_err(|fault| unkept(&fault))?;
        lock(&self.participants)
            .withdraw(number, &self.dataset)
            .map_err(|fault| unkept(&fault))?;
        session.withdrawn = true;
        session.log = Vec::new();
        (self.said)(&format!("{subject} has withdrawn; their data are deleted"));
        Ok(())
    }
}

impl Session {
    fn open(&self) -> Option<Step> {
        self.steps
            .get(self.index)
            .copied()
            .filter(|_| !self.withdrawn)
    }
}

fn lock<T>(mutex: &Mutex<T>) -> MutexGuard<'_, T> {
    mutex.lock().unwrap_or_else(PoisonError::into_inner)
}

fn stranger() -> ApiError {
    ApiError::new(
        Status::Forbidden,
        "nobody of this study has this page",
        "open the study's address again",
    )
}

fn elsewhere() -> ApiError {
    ApiError::new(
        Status::Conflict,
        "this step is not open",
        "reload the page; what was answered is kept",
    )
}

/// Something that could not be written: nothing of it was.
fn unkept(fault: &Fault) -> ApiError {
    ApiError {
        status: Status::Internal,
        ..ApiError::of(fault)
    }
}
