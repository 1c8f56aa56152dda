//! Hostile inputs to every command of both programs that reads any (`tree` holds the list against theirs), seeded: damaged, forged, endless, strange.
//!
//! Whatever the input, a command ends by itself with exit status 0, 1 or 2, within two seconds of
//! processor time, or that of 50 plain prompts on a slow machine, and 512 MiB of memory. It leaves no partial
//! output and no input changed.
//!
//! At full size 2,000 cases are run, at the small one every 50th of them. `ASPERITY_ATTACKS=COUNT` runs the
//! first of them, `ASPERITY_ATTACKS=1234..1235` one again. `ASPERITY_PROGRAMS` names a folder with other builds
//! of the programs, by an absolute path. A case that fails keeps its folder.
#![cfg(unix)]

mod case;
mod forge;
mod forms;
mod mutate;
mod pieces;
mod programs;
mod recording;
mod run;
mod seeds;
mod strange;
mod tree;
mod verdict;

use asperity_tests::{draw::Draw, size::sized};
use std::{
    iter::StepBy,
    ops::Range,
    path::Path,
    sync::atomic::{AtomicUsize, Ordering},
};

/// Cases at full size.
const CASES: usize = 2000;
/// From so many on, shares of all cases are held to bounds.
const MANY: usize = 200;

fn wanted() -> StepBy<Range<usize>> {
    let Ok(text) = std::env::var("ASPERITY_ATTACKS") else {
        return (0..CASES).step_by(sized("every so many of 2,000 attacks", 50, 1));
    };
    let number = |text: &str| text.parse().expect("ASPERITY_ATTACKS=COUNT or FROM..TO");
    let range = match text.split_once("..") {
        Some((from, to)) => number(from)..number(to),
        None => 0..number(&text),
    };
    range.step_by(1)
}

#[test]
fn no_input_brings_a_command_down() {
    let programs = programs::built();
    let seeds = seeds::Seeds::new(&programs);
    let root = Path::new(env!("CARGO_TARGET_TMPDIR")).join("attacks");
    let _ = std::fs::remove_dir_all(&root);
    let cases: Vec<usize> = wanted().collect();
    let next = AtomicUsize::new(0);
    let work = || {
        let mut done = verdict::Tally::default();
        loop {
            let Some(&number) = cases.get(next.fetch_add(1, Ordering::Relaxed)) else {
                return done;
            };
            done.add(attacked(number, &programs, &seeds, &root));
        }
    };
    let threads = std::thread::available_parallelism().map_or(2, usize::from);
    let tally = std::thread::scope(|scope| {
        let workers: Vec<_> = (0..threads).map(|_| scope.spawn(work)).collect();
        let mut tally = verdict::Tally::default();
        for worker in workers {
            tally.merge(worker.join().expect("a worker that does not panic"));
        }
        tally
    });
    println!("{tally}");
    assert!(tally.failures.is_empty(), "{}", tally.failures.join("\n\n"));
    // A suite that refuses everything, or accepts everything, attacks nothing.
    assert!(tally.refused > 0 && tally.accepted > 0, "{tally}");
    if cases.len() >= MANY {
        assert!(tally.refused > cases.len() / 4, "{tally}");
        assert!(tally.accepted > cases.len() / 40, "{tally}");
    }
}

/// The attacks start from inputs that the commands take. A text tower of CLIP is not shipped.
#[test]
fn what_is_not_attacked_is_accepted() {
    let programs = programs::built();
    let seeds = seeds::Seeds::new(&programs);
    let root = Path::new(env!("CARGO_TARGET_TMPDIR")).join("not-attacked");
    let _ = std::fs::remove_dir_all(&root);
    let stride = sized("every so many commands", 6, 1);
    for (number, form) in forms::FORMS.iter().enumerate().step_by(stride) {
        if form.is_long || form.line.contains("clip:") {
            continue;
        }
        let folder = root.join(number.to_string());
        let harmless = case::Attack::valid(form, &seeds);
        seeds.write(&folder);
        harmless.prepare(&folder, &seeds);
        let run = run::run(programs.path(form.program), &harmless.arguments, &folder);
        assert_eq!(run.status.code(), Some(0), "{}: {}", form.line, run.stderr);
    }
    let _ = std::fs::remove_dir_all(&root);
}

/// Whatever lies in the place of a cached texture, the build makes it anew and writes to nothing else.
#[test]
fn nothing_in_a_cache_leads_a_build_astray() {
    let programs = programs::built();
    let seeds = seeds::Seeds::new(&programs);
    let root = Path::new(env!("CARGO_TARGET_TMPDIR")).join("astray");
    let _ = std::fs::remove_dir_all(&root);
    let form = forms::FORMS.iter().find(|form| form.target == seeds::ENTRY);
    let form = form.expect("a build with a cache");
    let mut tally = verdict::Tally::default();
    for (number, strange) in strange::Strange::ALL.into_iter().enumerate() {
        let attack = case::Attack::strange(form, strange);
        tally.add(ran(number, &attack, &programs, &seeds, &root));
    }
    assert!(tally.failures.is_empty(), "{}", tally.failures.join("\n\n"));
    // What cannot be used is passed over: a build does not need its cache.
    assert_eq!(tally.accepted, strange::Strange::ALL.len(), "{tally}");
}

/// Runs a case of the suite.
fn attacked(
    number: usize,
    programs: &programs::Programs,
    seeds: &seeds::Seeds,
    root: &Path,
) -> verdict::Verdict {
    let mut draw = Draw::new(0xa77a_c4ed ^ (number as u64) << 20);
    let attack = match pieces::PIECES.get(number) {
        Some(piece) => case::Attack::of_piece(piece, seeds),
        None => case::Attack::drawn(number, seeds, &mut draw),
    };
    ran(number, &attack, programs, seeds, root)
}

/// Runs a case in a folder of its own, and judges what came of it.
fn ran(
    number: usize,
    attack: &case::Attack,
    programs: &programs::Programs,
    seeds: &seeds::Seeds,
    root: &Path,
) -> verdict::Verdict {
    let folder = root.join(number.to_string());
    seeds.write(&folder);
    attack.prepare(&folder, seeds);
    let before = verdict::Snapshot::of(&folder);
    let run = run::run(programs.path(attack.program), &attack.arguments, &folder);
    let verdict = verdict::judge(number, attack, &run, &before, &folder, programs.max_cpu);
    if verdict.failure.is_none() {
        let _ = std::fs::remove_dir_all(&folder);
    }
    verdict
}
