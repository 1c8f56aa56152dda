//! Files that a package installs beside a command: completions for shells, and manual pages.

use crate::Console;
use asperity_io::{
    diagnostic::{Failures, one},
    output::{display, write_folder},
    shown::counted,
};
use clap::{Command, CommandFactory};
use clap_complete::{Shell, generate};
use clap_mangen::Man;
use std::path::PathBuf;

/// Arguments of the command that prints completions.
#[derive(Debug, clap::Args)]
pub struct Completions {
    /// The shell
    shell: Shell,
}

/// Arguments of the command that writes manual pages.
#[derive(Debug, clap::Args)]
pub struct Manual {
    /// The folder to write the pages to; created if its parent exists
    #[arg(short, long, value_name = "DIR")]
    output: PathBuf,
}

impl Completions {
    /// Prints what a shell sources to complete the arguments of the command `C`.
    ///
    /// # Errors
    /// Where it cannot be printed.
    pub fn run<C: CommandFactory>(&self, console: Console) -> Result<(), Failures> {
        let mut command = C::command();
        let name = command.get_name().to_owned();
        let mut text = Vec::new();
        generate(self.shell, &mut command, name, &mut text);
        console.print(&String::from_utf8_lossy(&text)).map_err(one)
    }
}

impl Manual {
    /// Writes a page of section 1 for the command `C` and each of its subcommands.
    ///
    /// # Errors
    /// Where a page cannot be written.
    pub fn run<C: CommandFactory>(&self, console: Console) -> Result<(), Failures> {
        let mut command = C::command().disable_help_subcommand(true);
        command.build();
        let mut pages = Vec::new();
        add_pages(&command, &mut pages);
        let files: Vec<(String, &[u8])> = pages
            .iter()
            .map(|(name, page)| (name.clone(), page.as_slice()))
            .collect();
        write_folder(&self.output, &files).map_err(one)?;
        let count = counted(files.len(), "page", "pages");
        let folder = display(&self.output);
        console.report(&format!("{folder}: {count}\n")).map_err(one)
    }
}

fn add_pages(command: &Command, pages: &mut Vec<(String, Vec<u8>)>) {
    let man = Man::new(command.clone());
    let mut page = Vec::new();
    // Writing to memory cannot fail.
    let _ = man.render(&mut page);
    pages.push((man.get_filename(), page));
    for command in command.get_subcommands() {
        if !command.is_hide_set() {
            add_pages(command, pages);
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use clap::{Parser, Subcommand};

    /// Try
    #[derive(Debug, Parser)]
    #[command(name = "try")]
    struct Try {
        #[command(subcommand)]
        _what: TryCommand,
    }

    #[derive(Debug, Subcommand)]
    enum TryCommand {
        /// Go somewhere
        Go { _distance: u8 },
        /// Not for people
        #[command(hide = true)]
        Secret,
        /// Deeper
        #[command(subcommand)]
        In(Inner),
    }

    #[derive(Debug, Subcommand)]
    enum Inner {
        /// The deepest
        Here,
    }

    #[test]
    fn every_command_that_is_shown_has_a_page_that_describes_it() {
        let folder = tempfile::tempdir().expect("a folder");
        let output = folder.path().join("man1");
        let manual = Manual {
            output: output.clone(),
        };
        manual.run::<Try>(Console::new(true)).expect("pages");
        let mut names: Vec<String> = std::fs::read_dir(&output)
            .expect("the folder")
            .map(|entry| {
                entry
                    .expect("a page")
                    .file_name()
                    .into_string()
                    .expect("a name")
            })
            .collect();
        names.sort();
        assert_eq!(names, ["try-go.1", "try-in-here.1", "try-in.1", "try.1"]);
        let page = std::fs::read_to_string(output.join("try-go.1")).expect("a page");
        assert!(
            page.contains("Go somewhere") && page.contains(".TH"),
            "{page}"
        );
    }
}
