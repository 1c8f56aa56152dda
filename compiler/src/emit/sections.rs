//! An asset with other sections: under another name, or without its preview.

use asperity_formats::{Asset, EncodeError, assemble, assembled_len};

/// The asset with another name. All other sections keep their bytes.
///
/// # Errors
/// [`EncodeError`] for bytes that are no asset, or a name that no asset can have.
pub fn renamed(asset: &[u8], name: &str) -> Result<Vec<u8>, EncodeError> {
    rewritten(asset, |tag, body| {
        let named = tag == *b"NAME";
        Some(if named { name.as_bytes() } else { body })
    })
}

/// The asset without its preview picture. All other sections keep their bytes.
///
/// # Errors
/// [`EncodeError`] for bytes that are no asset.
pub fn without_preview(asset: &[u8]) -> Result<Vec<u8>, EncodeError> {
    rewritten(asset, |tag, body| (tag != *b"prev").then_some(body))
}

/// The asset with the body that a function gives for each section, and without those for which it gives none.
fn rewritten<'a>(
    asset: &'a [u8],
    body_of: impl Fn([u8; 4], &'a [u8]) -> Option<&'a [u8]>,
) -> Result<Vec<u8>, EncodeError> {
    let asset = Asset::parse(asset)?;
    let sections: Vec<([u8; 4], &[u8])> = asset
        .sections()
        .filter_map(|section| {
            let body = asset.section(&section).unwrap_or_default();
            Some((section.tag, body_of(section.tag, body)?))
        })
        .collect();
    let mut bytes = vec![0; assembled_len(&sections)];
    assemble(&sections, &mut bytes)?;
    Ok(bytes)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{emit::lower::lower, sources::builtin};

    #[test]
    fn only_the_name_changes() {
        let texture = builtin::texture();
        let bytes = lower(&texture, None).unwrap().bytes;
        let other = renamed(&bytes, "Käse").unwrap();
        assert_eq!(Asset::parse(&other).unwrap().name(), "Käse");
        assert_eq!(renamed(&other, &texture.name).unwrap(), bytes);
        for wrong in ["", "a\u{7}b", &"x".repeat(65)] {
            assert!(renamed(&bytes, wrong).is_err(), "{wrong:?}");
        }
    }

    #[test]
    fn only_the_preview_goes() {
        let texture = builtin::texture();
        let plain = lower(&texture, None).unwrap().bytes;
        let png = b"\x89PNG\r\n\x1a\n and pixels";
        let with = lower(&texture, Some(png)).unwrap().bytes;
        assert_ne!(with, plain);
        assert_eq!(without_preview(&with).unwrap(), plain);
        assert_eq!(without_preview(&plain).unwrap(), plain);
        assert!(without_preview(&plain[1..]).is_err());
    }
}
