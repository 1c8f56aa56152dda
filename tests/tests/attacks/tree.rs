//! Every command of both programs is attacked, or there is a reason why not.

use super::{
    forms::FORMS,
    pieces::PIECES,
    programs::{
        Program::{self, Compiler, Lab},
        Programs,
    },
    run::run,
};
use std::{collections::BTreeSet, ffi::OsString, fs};

/// Commands without an input that could be hostile.
const NOT_ATTACKED: [(Program, &str, &str); 11] = [
    (Compiler, "builtin", "reads nothing"),
    (Compiler, "completions", "reads nothing"),
    (Compiler, "import", "only groups commands"),
    (Compiler, "manual", "reads nothing"),
    (Compiler, "study", "only groups commands"),
    (
        Compiler,
        "study run",
        "reads what `study check` reads, then serves; its own tests attack that",
    ),
    (Lab, "completions", "reads nothing"),
    (Lab, "device", "only groups commands"),
    (
        Lab,
        "device serve",
        "reads USB transfers; its own tests damage them",
    ),
    (Lab, "manual", "reads nothing"),
    (
        Lab,
        "study",
        "reads what `asperity study check` reads, then serves",
    ),
];

/// Every command of a program, by the pages of its manual, which its own tree of commands writes.
fn commands(programs: &Programs, program: Program) -> BTreeSet<String> {
    let folder = tempfile::tempdir().expect("a folder");
    let arguments = ["manual", "-o", "man"].map(OsString::from);
    let run = run(programs.path(program), &arguments, folder.path());
    assert!(run.status.success(), "{}", run.stderr);
    let pages = fs::read_dir(folder.path().join("man")).expect("pages");
    let name = programs.path(program);
    let name = name.file_name().expect("a program").to_string_lossy();
    pages
        .map(|page| {
            let page = page.expect("a page").file_name();
            let page = page.to_string_lossy();
            let command = page
                .strip_suffix(".1")
                .and_then(|page| page.strip_prefix(&*name));
            let command = command.unwrap_or_else(|| panic!("{page}: no page of {name}"));
            command.trim_start_matches('-').to_owned()
        })
        .filter(|command| !command.is_empty())
        .collect()
}

#[test]
fn every_command_of_the_tree_is_attacked_or_has_a_reason() {
    let programs = super::programs::built();
    let mut faults = Vec::new();
    for program in [Compiler, Lab] {
        let commands = commands(&programs, program);
        let forms = FORMS.iter().map(|form| (form.program, form.line));
        let pieces = PIECES.iter().map(|piece| (piece.program, piece.line));
        let lines = forms.chain(pieces).filter(|(of, _)| *of == program);
        // The longest name of a command that a line begins with; in a page's name a space is a dash.
        let attacked: BTreeSet<String> = lines
            .map(|(_, line)| {
                let words: Vec<&str> = line.split(' ').collect();
                let mut names = (1..=words.len())
                    .rev()
                    .map(|count| words[..count].join("-"));
                let name = names.find(|name| commands.contains(name));
                name.unwrap_or_else(|| panic!("{line}: no command"))
            })
            .collect();
        let excused = NOT_ATTACKED.iter().filter(|(of, ..)| *of == program);
        let excused: BTreeSet<String> =
            excused.map(|(_, name, _)| name.replace(' ', "-")).collect();
        for command in &commands {
            match (attacked.contains(command), excused.contains(command)) {
                (false, false) => faults.push(format!(
                    "{program:?} {command}: not attacked; add a form of it, or a reason to NOT_ATTACKED"
                )),
                (true, true) => faults.push(format!("{program:?} {command}: is attacked; remove its reason")),
                _ => {}
            }
        }
        let gone = excused.difference(&commands);
        faults.extend(gone.map(|name| format!("{program:?} {name}: a reason for no command")));
    }
    assert!(faults.is_empty(), "{}", faults.join("\n"));
}
