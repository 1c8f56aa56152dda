//! Assets that wait for their library: few in memory, many in a temporary file. So the memory of a
//! build does not grow with what it builds.

use crate::emit::pack::unwritable;
use asperity_formats::library::{self, IndexedTexture};
use asperity_io::diagnostic::Fault;
use std::{
    io::{self, Read as _, Seek as _, SeekFrom, Write},
    path::Path,
    sync::{Mutex, PoisonError},
};
use tempfile::SpooledTempFile;

/// Bytes that are kept in memory before a temporary file takes them.
const IN_MEMORY: usize = 16 << 20;

/// Where assets wait. Any thread may bring one.
#[derive(Debug)]
pub(super) struct Spill(Mutex<Held>);

#[derive(Debug)]
struct Held {
    file: SpooledTempFile,
    end: u64,
}

impl Held {
    fn read(&mut self, slot: Slot) -> io::Result<Vec<u8>> {
        let mut asset = vec![0; slot.len as usize];
        self.file.seek(SeekFrom::Start(slot.offset))?;
        self.file.read_exact(&mut asset)?;
        Ok(asset)
    }
}

/// An asset that waits.
#[derive(Debug, Clone, Copy)]
pub(super) struct Slot {
    offset: u64,
    /// Bytes of the asset.
    pub(super) len: u32,
    /// Bytes of it that a runtime needs.
    pub(super) haptic_len: u32,
}

impl Spill {
    /// Creates an empty spill whose temporary file, if needed, lies in a folder; in that of the system if `None`.
    pub(super) fn new(folder: Option<&Path>) -> Self {
        let file = match folder {
            Some(folder) => tempfile::spooled_tempfile_in(IN_MEMORY, folder),
            None => tempfile::spooled_tempfile(IN_MEMORY),
        };
        Self(Mutex::new(Held { file, end: 0 }))
    }

    /// Takes an asset of which a runtime needs `haptic_len` bytes.
    pub(super) fn take(&self, asset: &[u8], haptic_len: usize) -> io::Result<Slot> {
        let too_long = |_| io::Error::from(io::ErrorKind::FileTooLarge);
        let len = u32::try_from(asset.len()).map_err(too_long)?;
        let haptic_len = u32::try_from(haptic_len).map_err(too_long)?;
        let mut held = self.0.lock().unwrap_or_else(PoisonError::into_inner);
        let offset = held.end;
        // A write that failed half way leaves bytes that no slot has.
        held.file.seek(SeekFrom::Start(offset))?;
        held.file.write_all(asset)?;
        held.end += u64::from(len);
        Ok(Slot {
            offset,
            len,
            haptic_len,
        })
    }
}

/// A library that is ready to be written, one asset after the other.
#[derive(Debug)]
pub struct Packed {
    index: Vec<u8>,
    len: u64,
    slots: Vec<Slot>,
    spill: Spill,
}

/// Returns the fault of a temporary file that takes no more.
pub(crate) fn no_room(error: io::Error) -> Fault {
    Fault::new(
        format!("the texture cannot be stored until the library is written: {error}"),
        "free space beside the output, or in the folder for temporary files if it is `-`",
    )
}

impl Packed {
    /// The library of assets in ascending order of name.
    ///
    /// # Errors
    /// [`Fault`] for two assets of one name.
    pub(super) fn new<'a>(
        named: impl Iterator<Item = (&'a str, Slot)>,
        spill: Spill,
    ) -> Result<Self, Fault> {
        let (textures, slots): (Vec<IndexedTexture<'_>>, Vec<Slot>) = named
            .map(|(name, slot)| {
                let Slot {
                    len, haptic_len, ..
                } = slot;
                let listed = IndexedTexture {
                    name,
                    len,
                    haptic_len,
                };
                (listed, slot)
            })
            .unzip();
        let mut index = vec![0; library::encoded_index_len(&textures)];
        let (_, len) = library::encode_index(&textures, &mut index).map_err(unwritable)?;
        Ok(Self {
            index,
            len,
            slots,
            spill,
        })
    }

    /// Bytes of the library.
    #[must_use]
    pub fn len(&self) -> u64 {
        self.len
    }

    /// Returns true if it has no texture.
    #[must_use]
    pub fn is_empty(&self) -> bool {
        self.slots.is_empty()
    }

    /// The assets, in order of name.
    pub(crate) fn assets(&self) -> io::Result<Vec<Vec<u8>>> {
        let mut held = self.spill.0.lock().unwrap_or_else(PoisonError::into_inner);
        self.slots.iter().map(|slot| held.read(*slot)).collect()
    }

    /// Writes the library: the bytes that [`encode`](crate::emit::pack::encode) gives of the same assets.
    ///
    /// # Errors
    /// A failed read of the temporary file, or a failed write.
    pub fn write(&self, out: &mut impl Write) -> io::Result<()> {
        let mut held = self.spill.0.lock().unwrap_or_else(PoisonError::into_inner);
        out.write_all(&self.index)?;
        for slot in &self.slots {
            out.write_all(&held.read(*slot)?)?;
        }
        out.flush()
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{
        emit::{
            lower::lower,
            pack::{NamedAsset, encode},
        },
        sources::builtin,
    };
    use asperity_formats::Asset;

    /// Whatever the order that assets come in, and whether memory holds them or a file.
    #[test]
    fn a_packed_library_has_the_bytes_of_one_that_memory_holds() {
        let asset = lower(&builtin::texture(), None).unwrap().bytes;
        let haptic_len = Asset::parse(&asset).unwrap().haptic_len();
        for count in [0, 1, 7, IN_MEMORY / asset.len() + 50] {
            let names: Vec<String> = (0..count).map(|n| format!("t{n:06}")).collect();
            let folder = tempfile::tempdir().unwrap();
            let spill = Spill::new(Some(folder.path()));
            let mut slots: Vec<(&str, Slot)> = names
                .iter()
                .rev()
                .map(|name| (name.as_str(), spill.take(&asset, haptic_len).unwrap()))
                .collect();
            slots.reverse();
            let packed = Packed::new(slots.into_iter(), spill).unwrap();
            let mut bytes = Vec::new();
            packed.write(&mut bytes).unwrap();
            let named: Vec<NamedAsset<'_>> = names
                .iter()
                .map(|name| NamedAsset {
                    name,
                    bytes: &asset,
                })
                .collect();
            assert!(bytes == encode(&named).unwrap(), "{count}");
            assert_eq!(packed.len(), bytes.len() as u64);
            // Nothing is left beside the library.
            assert_eq!(std::fs::read_dir(folder.path()).unwrap().count(), 0);
        }
    }
}
