//! Studies as pages meet them: what is open, what is refused, what is kept.

use crate::client::{Reply, Site, embedded};
use asperity_studio::{Limits, Study, StudyHost};
use serde_json::{Value, json};
use std::{
    fs,
    io::Read as _,
    path::{Path, PathBuf},
};

/// A study of two textures and what lies between them, a form, and a prompt.
const STUDY: &str = r#"
name = "short"
title = "Short"
consent = "Agree."
midpoints = true
participants = 2

[ratings]
practice = 1
catch = 1
break_every = 3
break_s = 0

[[texture]]
name = "cork"
prompt = "cork"
anchor = true

[[texture]]
name = "ice"
prompt = "wet ice"
anchor = true

[[attribute]]
name = "rough"
question = "How rough?"
low = "smooth"
high = "rough"

[[form]]
name = "tlx"

[prompts]
text = "Make something rough."
count = 1
"#;

struct Running {
    site: Site,
    folder: PathBuf,
}

impl Running {
    fn start(folder: &Path) -> Self {
        let file = folder.join("study.toml");
        fs::write(&file, STUDY).expect("room");
        let Ok(study) = Study::open(&file, embedded, || ()) else {
            panic!("a good study is refused");
        };
        let data = folder.join("data set");
        let host = StudyHost::open(study, &data, None, |_| ()).expect("an empty folder");
        Self {
            site: Site::of(host, Limits::default()),
            folder: data,
        }
    }

    fn stop(self) -> String {
        self.site.stopper.stop();
        self.site.thread.join().expect("no panic");
        self.site.page
    }

    fn post(&self, path: &str, body: &Value) -> Reply {
        self.site.post(path, body.to_string().as_bytes())
    }

    fn join(&self) -> String {
        self.post("api/join", &json!({})).json()["me"]
            .as_str()
            .expect("a secret")
            .to_owned()
    }

    fn step(&self, me: &str) -> Value {
        self.site.get(&format!("api/step?me={me}")).json()
    }

    /// A good answer to what is open.
    fn good(&self, me: &str, step: &Value) -> Value {
        let response = match step["kind"].as_str().expect("a kind") {
            "consent" => json!({ "agreed": true }),
            "rating" => json!({ "rough": 40 }),
            "form" => {
                json!({ "mental": 5, "physical": 10, "temporal": 15, "performance": 20, "effort": 25, "frustration": 100 })
            }
            "prompt" => {
                let tried = self.post(
                    &format!("api/try?me={me}"),
                    &json!({ "index": step["index"], "prompt": "gravel,  \"coarse\"" }),
                );
                let file = tried.json()["texture"]
                    .as_str()
                    .expect("an address")
                    .to_owned();
                assert_eq!(self.site.get(&format!("{file}.worklet.asp")).status, 200);
                json!({})
            }
            _ => json!({}),
        };
        let felt =
            json!({ "strokes": 2, "taps": 1, "contact_s": 1.5, "exploration": vec![0.25; 36] });
        let mut answer = json!({ "index": step["index"], "rt_ms": 12, "response": response });
        if ["rating", "prompt"]
            .iter()
            .any(|kind| step["kind"] == *kind)
        {
            answer
                .as_object_mut()
                .expect("an object")
                .extend(felt.as_object().cloned().expect("an object"));
        }
        answer
    }

    fn answer(&self, me: &str, answer: &Value) -> u16 {
        self.post(&format!("api/answer?me={me}"), answer).status
    }

    fn advance(&self, me: &str) {
        let good = self.good(me, &self.step(me));
        assert_eq!(self.answer(me, &good), 200);
    }

    fn table(&self, subject: &str) -> Vec<Vec<String>> {
        let name = format!("data/study-short_subject-{subject}_data.csv");
        let mut reader = csv::Reader::from_path(self.folder.join(name)).expect("a table");
        let rows = reader
            .records()
            .map(|row| row.expect("a row").iter().map(str::to_owned).collect());
        rows.collect()
    }
}

#[test]
fn a_participant_goes_from_consent_to_the_end_through_a_restart() {
    let folder = tempfile::tempdir().expect("a folder");
    let study = Running::start(folder.path());
    let me = study.join();
    let mut kinds = Vec::new();
    for _ in 0..4 {
        kinds.push(study.step(&me)["kind"].clone());
        study.advance(&me);
    }
    let page = study.stop();
    // What a killed program had begun to write.
    fs::write(folder.path().join("data set/data/.asperity-1"), "x").expect("room");
    let study = Running::start(folder.path());
    assert_eq!(study.site.page, page, "the address stays");
    assert!(!study.folder.join("data/.asperity-1").exists());
    assert_eq!(
        study.post("api/join", &json!({ "me": me })).json()["subject"],
        "P01"
    );
    loop {
        let step = study.step(&me);
        if step["kind"] == "end" {
            break;
        }
        kinds.push(step["kind"].clone());
        study.advance(&me);
    }
    assert_eq!(
        kinds,
        [
            "consent", "rating", "rating", "rating", "rating", "break", "rating", "form", "prompt"
        ]
    );
    let rows = study.table("P01");
    assert_eq!(rows.len(), kinds.len());
    let column = |at: usize| rows.iter().map(|row| &*row[at]).collect::<Vec<_>>();
    let indices: Vec<String> = (0..rows.len()).map(|at| at.to_string()).collect();
    assert_eq!(column(1), indices);
    let phases = column(6);
    assert_eq!(phases[1], "practice");
    assert_eq!(phases.iter().filter(|phase| **phase == "main").count(), 3);
    let again = phases
        .iter()
        .position(|phase| *phase == "catch")
        .expect("a rating that comes again");
    let first = (2..again)
        .find(|at| rows[*at][4] == rows[again][4])
        .expect("its first time");
    assert!(again - first >= 2, "not one right after the other");
    let elapsed: Vec<u64> = column(2).iter().map(|ms| ms.parse().expect("ms")).collect();
    assert!(elapsed.is_sorted(), "{elapsed:?}");
    assert_eq!(rows[8][4], "gravel, \"coarse\"");
    for name in ["cork", "ice", "cork+ice"] {
        assert_eq!(
            rows.iter()
                .filter(|row| row[4] == name && row[6] == "main")
                .count(),
            1
        );
    }
    study.stop();
}

#[test]
fn a_page_that_lies_is_refused_and_the_open_step_stays() {
    let folder = tempfile::tempdir().expect("a folder");
    let study = Running::start(folder.path());
    let (me, other) = (study.join(), study.join());
    assert_eq!(
        study.post("api/join", &json!({})).status,
        409,
        "two places are taken"
    );
    assert_eq!(
        study
            .post("api/join", &json!({ "me": "A".repeat(22) }))
            .status,
        403
    );
    assert_eq!(
        study
            .site
            .get(&format!("api/step?me={}", "A".repeat(22)))
            .status,
        403
    );
    for _ in 0..2 {
        study.advance(&me);
    }
    study.advance(&other);
    let step = study.step(&me);
    let good = study.good(&me, &step);
    let with = |key: &str, value: Value| {
        let mut answer = good.clone();
        answer[key] = value;
        answer
    };
    let wrong = [
        (with("index", json!(1)), 409),
        (with("index", json!(3)), 409),
        (with("response", json!({})), 422),
        (with("response", json!({ "rough": 101 })), 422),
        (with("response", json!({ "rough": 40, "wet": 1 })), 422),
        (with("exploration", json!([1.0])), 422),
        (with("strokes", json!(null)), 422),
        (with("strokes", json!(-1)), 400),
    ];
    for (answer, status) in wrong {
        assert_eq!(study.answer(&me, &answer), status, "{answer}");
    }
    // The texture of another participant, of a step that is over, and a file that would say which it is.
    let file = |me: &str, index: usize, ending: &str| {
        study
            .site
            .get(&format!("api/stimulus/{me}/{index}.{ending}"))
            .status
    };
    let index = step["index"].as_u64().expect("a number") as usize;
    assert_eq!(file(&me, index, "worklet.asp"), 200);
    assert_eq!(file(&other, index, "worklet.asp"), 404);
    assert_eq!(file(&me, index - 1, "worklet.asp"), 404);
    assert_eq!(file(&me, index, "json"), 404);
    assert!(
        !step.to_string().contains("cork") && !step.to_string().contains("wet"),
        "{step}"
    );
    assert_eq!(study.table("P01").len(), 2);
    assert_eq!(study.answer(&me, &good), 200);
    assert_eq!(study.answer(&me, &good), 409, "a trial is answered once");
    assert_eq!(study.table("P01").len(), 3);
    assert_eq!(study.table("P02").len(), 1);
    study.stop();
}

#[test]
fn a_log_is_what_the_hand_did_and_withdrawing_deletes_it() {
    let folder = tempfile::tempdir().expect("a folder");
    let study = Running::start(folder.path());
    let me = study.join();
    study.advance(&me);
    let positions = |ticks: std::ops::Range<usize>| -> Vec<u8> {
        let position = |tick: usize| [0.1 * tick as f32, 0.0, -1.0 / 3.0];
        ticks
            .flat_map(position)
            .flat_map(f32::to_le_bytes)
            .collect()
    };
    let send = |index: usize, first: usize, ticks: std::ops::Range<usize>| {
        study
            .site
            .post(
                &format!("api/log?me={me}&index={index}&first={first}"),
                &positions(ticks),
            )
            .status
    };
    let step = study.step(&me);
    assert_eq!(send(1, 0, 0..1000), 200);
    assert_eq!(send(1, 2000, 2000..2500), 422, "a gap");
    assert_eq!(send(1, 1000, 1000..2000), 200);
    assert_eq!(send(1, 1000, 1000..2000), 200, "a part that came twice");
    assert_eq!(send(2, 0, 0..10), 409);
    assert_eq!(study.answer(&me, &study.good(&me, &step)), 200);
    let row = &study.table("P01")[1];
    let packed = fs::read(study.folder.join(&row[17])).expect("a log");
    let mut log = String::new();
    flate2::read::GzDecoder::new(&packed[..])
        .read_to_string(&mut log)
        .expect("gzip");
    assert_eq!(log.lines().count(), 2001);
    let last = log
        .lines()
        .last()
        .expect("a line")
        .split(',')
        .map(|cell| cell.parse::<f64>().expect("a number"));
    let expected = [
        1999.0 / 16_000.0,
        f64::from(0.1 * 1999.0_f32),
        0.0,
        f64::from(-1.0_f32 / 3.0),
    ];
    assert_eq!(last.collect::<Vec<_>>(), expected);

    assert_eq!(
        study
            .post(&format!("api/withdraw?me={me}"), &json!({}))
            .status,
        200
    );
    assert_eq!(study.step(&me)["kind"], "end");
    assert!(
        !study
            .folder
            .join("data/study-short_subject-P01_data.csv")
            .exists()
    );
    assert!(!study.folder.join("log/subject-P01").exists());
    assert_ne!(study.post("api/join", &json!({})).json()["subject"], "P01");
    study.stop();
}

#[test]
fn a_folder_of_another_study_is_refused_and_stays_as_it_is() {
    let folder = tempfile::tempdir().expect("a folder");
    let data = folder.path().join("data set");
    Running::start(folder.path()).stop();
    let open = |text: &str, data: &Path| {
        let file = folder.path().join("other.toml");
        fs::write(&file, text).expect("room");
        let study = Study::open(&file, embedded, || ()).unwrap_or_else(|_| panic!("a good study"));
        StudyHost::open(study, data, None, |_| ())
            .err()
            .expect("a refusal")
    };
    let fault = open(&STUDY.replace("count = 1", "count = 2"), &data);
    assert!(fault.what.contains("another study"), "{fault}");
    let files = folder.path().join("files");
    fs::create_dir(&files).expect("room");
    fs::write(files.join("thesis.txt"), "x").expect("room");
    assert!(open(STUDY, &files).what.contains("other files"));
    // Whoever has answered is known, and nobody is mistaken for another.
    let study = Running::start(folder.path());
    let me = study.join();
    study.advance(&me);
    study.stop();
    fs::remove_file(data.join("sourcedata/participants.json")).expect("a file");
    assert!(open(STUDY, &data).what.contains("missing"));
    assert_eq!(fs::read_dir(&files).expect("a folder").count(), 1);
}
