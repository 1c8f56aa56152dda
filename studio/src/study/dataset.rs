//! The dataset of a study in the layout of Psych-DS, in which each trial is complete or not there.
//!
//! | file | holds |
//! |---|---|
//! | `dataset_description.json` | what the columns mean |
//! | `data/study-NAME_subject-P01_data.csv` | the trials of a participant |
//! | `materials/` | the study, its textures and forms, as the analysis needs them |
//! | `log/subject-P01/trial-0007.csv.gz` | where the hand was, at every tick of a trial |
//! | `sourcedata/participants.json` | addresses of participants: not to be published |

use super::{
    design::{Design, Simulate},
    forms::Form,
    stimuli::{Stimulus, sha256},
    text::Text,
};
use crate::VERSION;
use asperity_io::{
    diagnostic::Fault,
    output::{OutputError, write_atomic},
};
use flate2::{Compression, write::GzEncoder};
use serde::Serialize;
use serde_json::{Value, json};
use std::{
    fs::{self, File, TryLockError},
    io::{self, Write as _},
    path::{Path, PathBuf},
};

/// Ticks of the page's renderer, a second.
pub(crate) const TICK_HZ: f64 = 16_000.0;
/// Bytes of a position: x, y and z in 32 bits.
pub(crate) const POSITION_BYTES: usize = 12;

/// A trial of a participant, one line of the table. What does not apply is an empty cell.
#[derive(Debug, Clone, Default, Serialize)]
pub(crate) struct Row {
    pub(crate) trial_type: &'static str,
    pub(crate) trial_index: usize,
    /// From the participant's first step on, ms.
    pub(crate) time_elapsed: u64,
    /// From the step's being shown to its answer, ms.
    pub(crate) rt: u64,
    pub(crate) stimulus: String,
    /// JSON.
    pub(crate) response: String,
    pub(crate) phase: &'static str,
    pub(crate) repeat: Option<usize>,
    pub(crate) anchor_a: String,
    pub(crate) anchor_b: String,
    pub(crate) t: Option<f64>,
    pub(crate) form: String,
    pub(crate) strokes: Option<u64>,
    pub(crate) taps: Option<u64>,
    pub(crate) contact_s: Option<f64>,
    /// JSON, s in each of 6 × 6 bins of speed and force.
    pub(crate) exploration: String,
    pub(crate) asset_sha256: String,
    pub(crate) log: String,
    pub(crate) started_at: String,
    pub(crate) device: String,
    pub(crate) version: &'static str,
}

/// Columns with what they mean and their units, in the order of [`Row`].
const COLUMNS: [(&str, &str, &str); 21] = [
    (
        "trial_type",
        "consent, texture-rating, break, form or prompt",
        "",
    ),
    ("trial_index", "number of the trial, from 0", ""),
    (
        "time_elapsed",
        "from the participant's first step to the end of the trial, while the program ran",
        "ms",
    ),
    ("rt", "from the trial's being shown to its answer", "ms"),
    (
        "stimulus",
        "name of the texture, or the prompt that was tried last",
        "",
    ),
    ("response", "answers as a JSON object", ""),
    (
        "phase",
        "practice, main, or catch for a rating that comes once more",
        "",
    ),
    ("repeat", "block of the rating, from 1", ""),
    (
        "anchor_a",
        "first of the textures that this one lies between",
        "",
    ),
    ("anchor_b", "second of them", ""),
    ("t", "place between them, 0 to 1", ""),
    ("form", "name of the form", ""),
    ("strokes", "strokes until the answer", ""),
    ("taps", "taps until the answer", ""),
    ("contact_s", "time in contact until the answer", "s"),
    (
        "exploration",
        "time in contact in 6 bins of speed (from 0, 40, 80, 120, 160, 200 mm/s) times 6 of force (from 0, 0.5, 1, 1.5, 2, 3 N), as a JSON list, speed by speed",
        "s",
    ),
    (
        "asset_sha256",
        "SHA-256 of the texture's file in materials",
        "",
    ),
    ("log", "file of the hand's positions at 16 kHz", ""),
    ("started_at", "when the trial was shown, UTC", ""),
    ("device", "page, or the name of the haptic device", ""),
    ("version", "version of Asperity", ""),
];

/// The folder of a study, which this program alone writes to.
#[derive(Debug)]
pub(crate) struct Dataset {
    folder: PathBuf,
    study: String,
    _lock: File,
}

impl Dataset {
    /// Opens the dataset of a study, or begins one in a new or empty folder.
    ///
    /// # Errors
    /// [`Fault`] for a folder with another study or other files, one in use, and one that cannot be written.
    pub(crate) fn open(
        folder: &Path,
        (design, text): (&Design, &Text),
        stimuli: &[Stimulus],
        forms: &[Form],
        simulated: Option<(&Simulate, u64)>,
    ) -> Result<Self, Fault> {
        let failed = |error: io::Error| {
            let what = format!("the folder of the study cannot be used: {error}");
            Fault::new(what, "give a folder that you may write to, as --output").at(folder)
        };
        fs::create_dir_all(folder).map_err(failed)?;
        let study = folder.join("materials/study.toml");
        let is_new = !study.exists();
        // One that was begun and not finished, as on a full disk, has its lock.
        let is_begun = folder.join("sourcedata/lock").exists();
        let is_empty = fs::read_dir(folder).map_err(failed)?.next().is_none();
        if is_new && !is_begun && !is_empty {
            let what = "no dataset of a study, but other files";
            return Err(Fault::new(what, "give a new or an empty folder as --output").at(folder));
        }
        if !is_new && fs::read(&study).map_err(failed)? != text.text.as_bytes() {
            let what =
                "the folder has the data of another study, or of an earlier state of this one";
            return Err(Fault::new(what, "give a new folder, or the study as it was").at(folder));
        }
        let described = fs::read(folder.join("materials/study.json")).unwrap_or_default();
        let described: Value = serde_json::from_slice(&described).unwrap_or_default();
        if simulated.is_none() && described["simulated"].is_object() {
            let what = "the folder has simulated participants";
            return Err(Fault::new(what, "give a new folder for people").at(folder));
        }
        for name in [
            "data",
            "materials",
            "log",
            "sourcedata",
            "analysis",
            "results",
            "documentation",
        ] {
            fs::create_dir_all(folder.join(name)).map_err(failed)?;
        }
        private(&folder.join("sourcedata")).map_err(failed)?;
        let lock = File::create(folder.join("sourcedata/lock")).map_err(failed)?;
        match lock.try_lock() {
            Ok(()) => {}
            Err(TryLockError::WouldBlock) => {
                let what = "another program runs this study";
                return Err(Fault::new(what, "use that one, or give another folder").at(folder));
            }
            Err(TryLockError::Error(error)) => return Err(failed(error)),
        }
        let dataset = Self {
            folder: folder.to_owned(),
            study: design.name.get_ref().clone(),
            _lock: lock,
        };
        dataset.remove_unfinished().map_err(failed)?;
        dataset.write_materials(design, text, stimuli, forms, simulated)?;
        Ok(dataset)
    }

    /// Removes what a killed program had begun to write.
    fn remove_unfinished(&self) -> io::Result<()> {
        for name in [".", "data", "materials", "sourcedata"] {
            for entry in fs::read_dir(self.folder.join(name))?.flatten() {
                if entry
                    .file_name()
                    .to_string_lossy()
                    .starts_with(".asperity-")
                {
                    fs::remove_file(entry.path())?;
                }
            }
        }
        Ok(())
    }

    fn write_materials(
        &self,
        design: &Design,
        text: &Text,
        stimuli: &[Stimulus],
        forms: &[Form],
        simulated: Option<(&Simulate, u64)>,
    ) -> Result<(), Fault> {
        let attributes: Vec<_> = design.attributes.iter().map(|it| it.get_ref()).collect();
        let forms: Vec<Value> = forms
            .iter()
            .map(|form| json!({ "name": form.name, "kind": form.name, "items": form.items }))
            .collect();
        let simulated = simulated.map_or(json!(false), |(made, seed)| {
            let mut made = json!(made);
            made["seed"] = json!(seed);
            made
        });
        let study = json!({ "name": self.study, "title": design.title, "attributes": attributes, "forms": forms,
            "simulated": simulated });
        let textures: Vec<_> = stimuli.iter().map(|it| &it.entry).collect();
        let written = pretty(&json!(textures));
        let known = self.folder.join("materials/textures.json");
        if known.exists() && fs::read(&known).ok().as_deref() != Some(&written[..]) {
            let what =
                "the textures of this study are others than those that its participants felt";
            let remedy =
                "use the version of Asperity and the files that it was begun with, or a new folder";
            return Err(Fault::new(what, remedy).at(&known));
        }
        self.write("materials/textures.json", &written)?;
        self.write("materials/study.json", &pretty(&study))?;
        for Stimulus { entry, texture } in stimuli {
            self.write(&format!("materials/{}.asp", entry.name), texture.asset())?;
        }
        self.write(
            "dataset_description.json",
            &pretty(&self.description(&design.title)),
        )?;
        let readme = format!(
            "# {}\n\nThe dataset of a study with Asperity {VERSION}, in the layout of Psych-DS. `materials/study.toml` is the study,\n\
             `data/` has a table a participant, by pseudonym, `log/` where their hands were.\n\
             Do not publish `sourcedata/`: it holds the participants' addresses.\n\n\
             `python -m asperity.study report .` analyses it.\n",
            design.title
        );
        self.write("README.md", readme.as_bytes())?;
        self.write(
            "CHANGES.md",
            format!("# 1.0.0\n\nRecorded with Asperity {VERSION}.\n").as_bytes(),
        )?;
        // What says that the folder is one, last.
        self.write("materials/study.toml", text.text.as_bytes())
    }

    fn description(&self, title: &str) -> Value {
        let variable = |(name, about, unit): (&str, &str, &str)| {
            let mut variable =
                json!({ "@type": "PropertyValue", "name": name, "description": about });
            if !unit.is_empty() {
                variable["unitText"] = json!(unit);
            }
            variable
        };
        json!({
            "@context": "https://schema.org/",
            "@type": "Dataset",
            "name": self.study,
            "description": title,
            "schemaVersion": "Psych-DS 1.5.0",
            "variableMeasured": COLUMNS.map(variable),
        })
    }

    /// Writes a file of it, whole or not at all.
    pub(crate) fn write(&self, name: &str, bytes: &[u8]) -> Result<(), Fault> {
        let written = write_atomic(&self.folder.join(name), bytes);
        written.map_err(|error: OutputError| Fault::of(&error))
    }

    /// Reads a file of it, if it is there.
    pub(crate) fn read(&self, name: &str) -> Result<Option<Vec<u8>>, Fault> {
        match fs::read(self.folder.join(name)) {
            Ok(bytes) => Ok(Some(bytes)),
            Err(error) if error.kind() == io::ErrorKind::NotFound => Ok(None),
            Err(error) => {
                let what = format!("cannot be read: {error}");
                Err(Fault::new(what, "check its permissions").at(self.folder.join(name)))
            }
        }
    }

    /// Returns true if somebody's trials are kept.
    ///
    /// # Errors
    /// [`Fault`] where the folder cannot be read.
    pub(crate) fn has_tables(&self) -> Result<bool, Fault> {
        let folder = self.folder.join("data");
        let entries = fs::read_dir(&folder)
            .map_err(|error| Fault::new(error, "see that the folder can be read").at(&folder))?;
        let mut names = entries.flatten().map(|entry| entry.file_name());
        Ok(names.any(|name| name.to_string_lossy().ends_with("_data.csv")))
    }

    fn table(&self, subject: &str) -> String {
        format!("data/study-{}_subject-{subject}_data.csv", self.study)
    }

    /// Number of trials that are kept of a participant, and the time that they took, ms.
    ///
    /// # Errors
    /// [`Fault`] for a table that was changed by others so that it says neither.
    pub(crate) fn progress(&self, subject: &str) -> Result<(usize, u64), Fault> {
        let name = self.table(subject);
        let Some(bytes) = self.read(&name)? else {
            return Ok((0, 0));
        };
        let mut reader = csv::Reader::from_reader(&bytes[..]);
        let (mut trials, mut elapsed_ms) = (0, 0);
        for record in reader.records() {
            let broken = |what: String| {
                let remedy =
                    "restore the file as it was written; a copy in a spreadsheet is not the data";
                Fault::new(what, remedy)
                    .at(self.folder.join(&name))
                    .line(trials as u64 + 2)
            };
            let record = record.map_err(|error| broken(error.to_string()))?;
            let number = |at: usize| record.get(at).and_then(|cell| cell.parse::<u64>().ok());
            if number(1) != Some(trials as u64) {
                return Err(broken(
                    "the trials are not numbered one after the other".into(),
                ));
            }
            elapsed_ms = number(2).ok_or_else(|| broken("no time_elapsed".into()))?;
            trials += 1;
        }
        Ok((trials, elapsed_ms))
    }

    /// Adds trials to a participant's table.
    ///
    /// # Errors
    /// [`Fault`] where it cannot be written; the table is then as it was.
    pub(crate) fn append(&self, subject: &str, rows: &[Row]) -> Result<(), Fault> {
        let name = self.table(subject);
        let mut table = self.read(&name)?.unwrap_or_default();
        // An editor may have taken the last end of a line.
        if table.last().is_some_and(|byte| *byte != b'\n') {
            table.push(b'\n');
        }
        let mut writer = csv::WriterBuilder::new()
            .has_headers(table.is_empty())
            .from_writer(Vec::new());
        let encoded = rows.iter().try_for_each(|row| writer.serialize(row));
        let added = encoded.ok().and_then(|()| writer.into_inner().ok());
        // Memory takes every row.
        table.extend(added.unwrap_or_default());
        self.write(&name, &table)
    }

    /// Keeps where the hand was in a trial; the name of the file.
    ///
    /// # Errors
    /// [`Fault`] where it cannot be written.
    pub(crate) fn log(
        &self,
        subject: &str,
        trial: usize,
        positions: &[u8],
    ) -> Result<String, Fault> {
        let name = format!("log/subject-{subject}/trial-{trial:04}.csv.gz");
        let folder = self.folder.join(format!("log/subject-{subject}"));
        fs::create_dir_all(&folder)
            .map_err(|error| Fault::new(error, "see that the folder can be written").at(&folder))?;
        let mut packed = GzEncoder::new(Vec::new(), Compression::fast());
        // Memory takes every byte.
        let _ = packed.write_all(b"t_s,x_mm,y_mm,z_mm\n");
        for (tick, position) in positions.chunks_exact(POSITION_BYTES).enumerate() {
            let at = |k: usize| {
                f64::from(f32::from_le_bytes([
                    position[k],
                    position[k + 1],
                    position[k + 2],
                    position[k + 3],
                ]))
            };
            // All digits of the float, which the runtime divides before it rounds.
            let _ = writeln!(
                packed,
                "{},{},{},{}",
                tick as f64 / TICK_HZ,
                at(0),
                at(4),
                at(8)
            );
        }
        self.write(&name, &packed.finish().unwrap_or_default())?;
        Ok(name)
    }

    /// Deletes all that was kept of a participant.
    ///
    /// # Errors
    /// [`Fault`] where something of it stays.
    pub(crate) fn withdraw(&self, subject: &str) -> Result<(), Fault> {
        let failed = |path: &Path, error: io::Error| {
            let what = format!("the data of {subject} cannot be deleted: {error}");
            Fault::new(what, "delete this yourself").at(path)
        };
        let (table, log) = (
            self.folder.join(self.table(subject)),
            self.folder.join(format!("log/subject-{subject}")),
        );
        let gone = |path: &Path, removed: io::Result<()>| match removed {
            Err(error) if error.kind() != io::ErrorKind::NotFound => Err(failed(path, error)),
            _ => Ok(()),
        };
        gone(&table, fs::remove_file(&table))?;
        gone(&log, fs::remove_dir_all(&log))
    }
}

/// The row's texture.
pub(crate) fn stimulus_cells(row: &mut Row, stimulus: &Stimulus) {
    let described = &stimulus.entry;
    let [a, b] = described.anchors.clone().unwrap_or_default();
    row.stimulus.clone_from(&described.name);
    (row.anchor_a, row.anchor_b, row.t) = (a, b, described.t);
    row.asset_sha256 = sha256(stimulus.texture.asset());
}

fn pretty(value: &Value) -> Vec<u8> {
    // A value always serialises.
    let mut text = serde_json::to_vec_pretty(value).unwrap_or_default();
    text.push(b'\n');
    text
}

/// Lets the user alone read a folder.
fn private(folder: &Path) -> io::Result<()> {
    #[cfg(unix)]
    {
        use std::os::unix::fs::PermissionsExt as _;
        fs::set_permissions(folder, fs::Permissions::from_mode(0o700))?;
    }
    let _ = folder;
    Ok(())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_columns_are_those_of_a_row() {
        let mut writer = csv::Writer::from_writer(Vec::new());
        writer.serialize(Row::default()).unwrap();
        let table = String::from_utf8(writer.into_inner().unwrap()).unwrap();
        let header = COLUMNS.map(|(name, _, _)| name).join(",");
        assert_eq!(table.lines().next(), Some(&*header));
    }
}
