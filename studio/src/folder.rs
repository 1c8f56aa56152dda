//! A folder that is dropped on the page: the files of a recording, or the pictures of a material.

use crate::{
    error::{ApiError, refused},
    http::Status,
    opening::{Stated, imported, surface_options},
    prompts::Loaded,
    texture::{Texture, hash},
};
use asperity::sources::{Source, Tools, recording::RecordingFolder, surface::Surface};
use asperity_io::diagnostic::Fault;
use serde::Deserialize;
use std::{
    fs,
    path::{Component, Path},
};

/// A folder as the page sends it: a line of JSON, `[{"name": FILE, "bytes": LENGTH}, …]`, then the bytes of these files.
pub(crate) struct Folder<'a> {
    name: &'a str,
    files: Vec<(String, &'a [u8])>,
    /// All that was sent.
    sent: &'a [u8],
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct Listed {
    name: String,
    bytes: usize,
}

/// What makes a folder a recording.
const DESCRIPTION: &str = "recording.toml";

/// Returns true for the name of a file or folder, which is no path.
fn is_name(name: &str) -> bool {
    let mut parts = Path::new(name).components();
    let is_plain = matches!(parts.next(), Some(Component::Normal(part)) if part == name);
    is_plain && parts.next().is_none() && !name.contains(['/', '\\', '\0'])
}

impl<'a> Folder<'a> {
    /// Reads what the page sends.
    ///
    /// # Errors
    /// For what is no such line, names that are paths or stand twice, and other bytes than it tells.
    pub(crate) fn parse(name: &'a str, sent: &'a [u8]) -> Result<Self, ApiError> {
        let wrong = |error: &str| {
            let help = "send [{\"name\": FILE, \"bytes\": LENGTH}, …], a line feed, and the bytes of these files";
            ApiError::new(Status::BadRequest, error, help)
        };
        let end = sent.iter().position(|byte| *byte == b'\n');
        let (line, mut rest) = sent.split_at(end.ok_or_else(|| wrong("no list of files"))?);
        let listed: Vec<Listed> =
            serde_json::from_slice(line).map_err(|_| wrong("the list of files cannot be read"))?;
        rest = &rest[1..];
        let mut files: Vec<(String, &[u8])> = Vec::with_capacity(listed.len());
        for Listed { name, bytes } in listed {
            if !is_name(&name) || files.iter().any(|(other, _)| *other == name) {
                return Err(wrong("a file's name is a path, or stands twice"));
            }
            let (content, after) = rest
                .split_at_checked(bytes)
                .ok_or_else(|| wrong("fewer bytes than it lists"))?;
            files.push((name, content));
            rest = after;
        }
        if !is_name(name) || !rest.is_empty() {
            return Err(wrong(
                "its name is a path, or there are more bytes than it lists",
            ));
        }
        Ok(Self { name, files, sent })
    }

    /// The texture of the recording, as `asperity import recording`, or of the material with what is stated of it, as
    /// `asperity import surface`. Its files lie in a temporary folder meanwhile.
    ///
    /// # Errors
    /// As the command.
    pub(crate) fn texture(&self, stated: Stated<'_>, loaded: &Loaded) -> Result<Texture, ApiError> {
        let unwritable = |error: std::io::Error| {
            let what = format!("its files cannot be stored: {error}");
            let remedy =
                "see that the folder for temporary files has space, or run `asperity import`";
            refused(&Fault::new(what, remedy).at(self.name))
        };
        let around = tempfile::tempdir().map_err(unwritable)?;
        let folder = around.path().join(self.name);
        fs::create_dir(&folder).map_err(unwritable)?;
        for (name, content) in &self.files {
            fs::write(folder.join(name), content).map_err(unwritable)?;
        }
        let is_recording = self.files.iter().any(|(name, _)| name == DESCRIPTION);
        let (source, command): (Box<dyn Source>, _) = if is_recording {
            let force = false;
            let source = RecordingFolder { folder, force };
            (Box::new(source), ("recording", String::new()))
        } else {
            let (options, words) = surface_options(stated)?;
            let source = Surface {
                path: folder,
                options,
            };
            (Box::new(source), ("surface", words))
        };
        let file = (self.name, hash(self.sent));
        let made = imported(&*source, Tools::of(&loaded.compiler), file, command);
        // Where the files lay is of no interest.
        let around = format!("{}/", around.path().display());
        made.map_err(|error| ApiError {
            error: error.error.replace(&around, ""),
            help: error.help.map(|help| help.replace(&around, "")),
            ..error
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_folder_is_its_list_and_the_bytes_of_that() {
        let list = br#"[{"name":"a.csv","bytes":2},{"name":"b","bytes":0}]"#;
        let sent = [&list[..], b"\nxy"].concat();
        let folder = Folder::parse("oak", &sent).unwrap();
        assert_eq!(
            folder.files,
            [("a.csv".into(), &b"xy"[..]), ("b".into(), b"")]
        );
        for (name, sent) in [
            ("oak", &sent[..sent.len() - 1]),
            ("oak", &[&sent[..], b"z"].concat()),
            ("oak", &list[..]),
            ("oak", b"{}\n"),
            ("../oak", &sent),
            ("..", &sent),
            ("a/b", &sent),
            ("", &sent),
            ("oak", b"[{\"name\":\"../x\",\"bytes\":0}]\n"),
            ("oak", b"[{\"name\":\"/x\",\"bytes\":0}]\n"),
            ("oak", b"[{\"name\":\".\",\"bytes\":0}]\n"),
            (
                "oak",
                b"[{\"name\":\"x\",\"bytes\":0},{\"name\":\"x\",\"bytes\":0}]\n",
            ),
        ] {
            assert!(Folder::parse(name, sent).is_err(), "{name}");
        }
    }
}
