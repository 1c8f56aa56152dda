//! An asset under another name.

use asperity_formats::{Asset, EncodeError, assemble, assembled_len};

/// The asset with another name. All other sections keep their bytes.
///
/// # Errors
/// [`EncodeError`] for bytes that are no asset, or a name that no asset can have.
pub fn renamed(asset: &[u8], name: &str) -> Result<Vec<u8>, EncodeError> {
    let asset = Asset::parse(asset)?;
    let sections: Vec<([u8; 4], &[u8])> = asset
        .sections()
        .map(|section| {
            let body = asset.section(&section).unwrap_or_default();
            let named = section.tag == *b"NAME";
            (section.tag, if named { name.as_bytes() } else { body })
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
}
