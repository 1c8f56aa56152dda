//! The gallery: what it shows of a library, and what is taken of it.

use super::nothing_here;
use crate::{
    difference,
    error::ApiError,
    http::{Answer, Content, Keep},
    studio::Studio,
};

/// A resource of a library: the path below `api/library/`.
#[derive(Debug, PartialEq, Eq)]
enum LibraryResource<'a> {
    /// `LIB.json`
    Columns(&'a str),
    /// `LIB/N.png`
    Picture(&'a str, usize),
    /// `LIB/N.json`
    Texture(&'a str, usize),
}

impl<'a> LibraryResource<'a> {
    fn of(path: &'a str) -> Option<Self> {
        let number = |text: &str| {
            let digits = text.bytes().all(|b| b.is_ascii_digit());
            digits.then(|| text.parse().ok()).flatten()
        };
        Some(match path.split_once('/') {
            None => Self::Columns(path.strip_suffix(".json")?),
            Some((library, file)) => match file.split_once('.')? {
                (place, "png") => Self::Picture(library, number(place)?),
                (place, "json") => Self::Texture(library, number(place)?),
                _ => return None,
            },
        })
    }
}

/// Answers a request for a path below `api/library/`.
pub(super) fn answer(studio: &Studio, path: &str, reads: bool) -> Result<Answer, ApiError> {
    let resource = LibraryResource::of(path).ok_or_else(nothing_here)?;
    if !reads {
        return Ok(Answer::only("GET, HEAD"));
    }
    match resource {
        LibraryResource::Columns(id) => {
            let named = studio.library(id)?;
            let columns = Content::Shared(named.library.columns(id));
            Ok(Answer::new("application/json", columns, Keep::Forever))
        }
        LibraryResource::Picture(id, at) => {
            let named = studio.library(id)?;
            let png = studio.compute(|| named.library.thumbnail(at))?;
            Ok(Answer::new(
                "image/png",
                Content::Shared(png),
                Keep::Forever,
            ))
        }
        LibraryResource::Texture(id, at) => {
            let texture = studio.pick(&studio.library(id)?, at)?;
            Ok(Answer::json(studio.shown(&texture)))
        }
    }
}

/// Answers a request for a path below `api/difference/`: `OLD/NOW.json`.
pub(super) fn difference(studio: &Studio, path: &str, reads: bool) -> Result<Answer, ApiError> {
    let two = path
        .strip_suffix(".json")
        .and_then(|ids| ids.split_once('/'));
    let (old, now) = two.ok_or_else(nothing_here)?;
    if !reads {
        return Ok(Answer::only("GET, HEAD"));
    }
    let (old, now) = (studio.library(old)?, studio.library(now)?);
    let found = studio.compute(|| difference::difference(&old.library, &now.library))?;
    Ok(Answer::json(found))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn places_are_digits_alone() {
        assert_eq!(
            LibraryResource::of("0.json"),
            Some(LibraryResource::Columns("0"))
        );
        assert_eq!(
            LibraryResource::of("0/12.png"),
            Some(LibraryResource::Picture("0", 12))
        );
        assert_eq!(
            LibraryResource::of("0/12.json"),
            Some(LibraryResource::Texture("0", 12))
        );
        for path in [
            "",
            "0",
            "0/",
            "0/12",
            "0/.json",
            "0/+1.json",
            "0/-1.json",
            "0/1.asp",
            "0/1.json.json",
            "0/1/2",
            "0/x.png",
            "0/99999999999999999999.png",
        ] {
            assert_eq!(LibraryResource::of(path), None, "{path}");
        }
    }
}
