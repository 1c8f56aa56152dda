//! `asperity study` as an experimenter starts it, and as a machine ends it.

use super::{studio::Running, *};
use flate2::read::GzDecoder;
use serde_json::{Value, json};
use std::{
    io::{Read as _, Write as _},
    net::TcpStream,
    thread,
    time::Duration,
};

/// A study with many ratings of six textures.
const STUDY: &str = "name = \"many\"
title = \"Many\"
consent = \"Agree.\"
midpoints = true
[ratings]
practice = 0
repeats = 100
break_every = 0
[[texture]]
name = \"cork\"
prompt = \"cork\"
anchor = true
[[texture]]
name = \"ice\"
prompt = \"wet ice\"
anchor = true
[[texture]]
name = \"velvet\"
prompt = \"velvet\"
anchor = true
[[attribute]]
name = \"rough\"
question = \"How rough?\"
low = \"smooth\"
high = \"rough\"
";
/// Ticks of a trial's log: a second.
const TICKS: usize = 16_000;
/// Kills that a participant sees: one who has finished loses nothing.
const KILLS_EACH: u64 = 10;

/// A participant's page.
#[derive(Clone)]
struct Page {
    host: String,
    page: String,
}

impl Page {
    fn of(study: &Running) -> Self {
        Self {
            host: study.host.clone(),
            page: study.page.clone(),
        }
    }

    /// Status and body of an answer; `None` from a server that is not there any more.
    fn ask(&self, method: &str, path: &str, body: &[u8]) -> Option<(u16, Value)> {
        let mut stream = TcpStream::connect(&self.host).ok()?;
        let (page, host, length) = (&self.page, &self.host, body.len());
        let head = format!(
            "{method} {page}{path} HTTP/1.1\r\nHost: {host}\r\nConnection: close\r\nContent-Length: {length}\r\n\r\n"
        );
        stream.write_all(&[head.as_bytes(), body].concat()).ok()?;
        let mut answer = Vec::new();
        stream.read_to_end(&mut answer).ok()?;
        let answer = text(&answer);
        let (head, body) = answer.split_once("\r\n\r\n")?;
        Some((
            head.get(9..12)?.parse().ok()?,
            serde_json::from_str(body).ok()?,
        ))
    }

    fn join(&self) -> String {
        let (_, joined) = self.ask("POST", "api/join", b"{}").expect("an answer");
        joined["me"].as_str().expect("a secret").to_owned()
    }

    /// Answers what is open; the index of what is then answered for certain.
    fn advance(&self, me: &str) -> Option<u64> {
        let (_, step) = self.ask("GET", &format!("api/step?me={me}"), b"")?;
        if step["kind"] == "end" {
            return None;
        }
        let index = step["index"].as_u64()?;
        let answer = if step["kind"] == "rating" {
            let position = |tick: usize| [1e-2 * tick as f32, 0.1, -0.3];
            let log: Vec<u8> = (0..TICKS)
                .flat_map(position)
                .flat_map(f32::to_le_bytes)
                .collect();
            self.ask(
                "POST",
                &format!("api/log?me={me}&index={index}&first=0"),
                &log,
            )?;
            json!({ "index": index, "rt_ms": 1, "response": { "rough": index % 101 }, "strokes": 1, "taps": 0, "contact_s": 0.25,
                "exploration": vec![0.0; 36] })
        } else {
            json!({ "index": index, "rt_ms": 1, "response": { "agreed": true } })
        };
        let (status, _) = self.ask(
            "POST",
            &format!("api/answer?me={me}"),
            answer.to_string().as_bytes(),
        )?;
        assert_eq!(status, 200);
        Some(index)
    }
}

fn start(folder: &Path) -> Running {
    Running::launch(folder, &["study", "run", "study.toml", "-o", "data"])
}

/// Rows of a participant's table, without the header.
fn rows(folder: &Path, subject: &str) -> Vec<String> {
    let table =
        fs::read_to_string(folder.join(format!("data/data/study-many_subject-{subject}_data.csv")));
    table.map_or_else(
        |_| Vec::new(),
        |table| table.lines().skip(1).map(str::to_owned).collect(),
    )
}

/// STUDY_KILLS says how often; `.ci/full` has 50.
#[test]
fn a_study_that_is_killed_loses_the_open_trial_at_most_and_writes_nothing_by_halves() {
    let kills = std::env::var("STUDY_KILLS").map_or(4, |kills| kills.parse().expect("a number"));
    let folder = tempfile::tempdir().expect("a folder");
    let folder = folder.path();
    fs::write(folder.join("study.toml"), STUDY).expect("room");
    let mut members = [String::new(), String::new()];
    let mut kept = [0, 0];
    let mut trials = 0;
    for kill in 0..kills {
        let running = start(folder);
        let page = Page::of(&running);
        if kill % KILLS_EACH == 0 {
            members = members.map(|_| page.join());
            kept = [0, 0];
        }
        let pair = 1 + 2 * (kill / KILLS_EACH);
        let subjects = [format!("P{pair:02}"), format!("P{:02}", pair + 1)];
        let answered = thread::scope(|scope| {
            let work = members.each_ref().map(|me| {
                let page = page.clone();
                scope.spawn(move || {
                    let mut last = None;
                    while let Some(index) = page.advance(me) {
                        last = Some(index);
                    }
                    last
                })
            });
            // Moments that no two kills share.
            thread::sleep(Duration::from_micros(
                3_000 + 57_117 * (kill % 13) + 1_009 * kill,
            ));
            running.kill();
            work.map(|work| work.join().expect("no refusal"))
        });
        for (who, last) in answered.into_iter().enumerate() {
            let rows = rows(folder, &subjects[who]);
            let certain = last.map_or(kept[who], |index| index as usize + 1);
            assert!(
                (certain..=certain + 1).contains(&rows.len()),
                "{} rows of {certain}",
                rows.len()
            );
            for (at, row) in rows.iter().enumerate() {
                assert_eq!(row.split(',').nth(1), Some(&*at.to_string()), "{row}");
                assert_eq!(row.matches(",0.1.0").count(), 1, "a whole row: {row}");
            }
            trials += rows.len() - kept[who];
            kept[who] = rows.len();
        }
    }
    assert!(trials > 0 || kills < 10, "{trials} trials of {kills} runs");
    // The next start removes what the last kill left half-written, and the logs render.
    let running = start(folder);
    for place in ["data", "data/data", "data/materials", "data/sourcedata"] {
        assert!(
            entries(&folder.join(place))
                .iter()
                .all(|name| !name.starts_with(".asperity-")),
            "{place}"
        );
    }
    let page = Page::of(&running);
    let me = page.join();
    for index in 0..2 {
        assert_eq!(page.advance(&me), Some(index));
    }
    running.kill();
    let subject = format!("P{:02}", 1 + 2 * kills.div_ceil(KILLS_EACH));
    let last = rows(folder, &subject).pop().expect("a row");
    let cells: Vec<&str> = last.split(',').collect();
    let log = cells
        .iter()
        .find(|cell| cell.starts_with("log/"))
        .expect("a log");
    let mut trajectory = String::new();
    let packed = fs::File::open(folder.join("data").join(log)).expect("a log");
    GzDecoder::new(packed)
        .read_to_string(&mut trajectory)
        .expect("gzip");
    fs::write(folder.join("t.csv"), trajectory).expect("room");
    let asset = format!("data/materials/{}.asp", cells[4]);
    good(
        folder,
        &[
            "render",
            &asset,
            "--rate",
            "16000",
            "--trajectory",
            "t.csv",
            "-o",
            "felt.csv",
        ],
    );
    let felt = fs::read_to_string(folder.join("felt.csv")).expect("a table");
    assert_eq!(felt.lines().count(), TICKS + 1);
}

#[test]
fn simulated_participants_are_a_whole_dataset_and_the_same_for_the_same_seed() {
    let folder = tempfile::tempdir().expect("a folder");
    let folder = folder.path();
    fs::write(
        folder.join("study.toml"),
        STUDY.replace("repeats = 100", "repeats = 2"),
    )
    .expect("room");
    let simulate = |seed: &str, output: &str| {
        let arguments = [
            "study",
            "simulate",
            "study.toml",
            "--participants",
            "3",
            "--seed",
            seed,
            "-o",
            output,
        ];
        good(folder, &arguments);
        fs::read(
            folder
                .join(output)
                .join("data/study-many_subject-P03_data.csv"),
        )
        .expect("a table")
    };
    let (one, same, other) = (simulate("1", "a"), simulate("1", "b"), simulate("2", "c"));
    assert!(one == same && one != other);
    assert_eq!(text(&one).lines().count(), 1 + 1 + 2 * 6);
    let again = asperity(
        folder,
        &[
            "study",
            "simulate",
            "study.toml",
            "--participants",
            "3",
            "-o",
            "a",
        ],
    );
    assert!(
        text(&again.stderr).contains("give a new folder"),
        "{}",
        text(&again.stderr)
    );
}
