//! The textures that were made last, by what names their bytes.

use crate::texture::Texture;
use std::{
    collections::VecDeque,
    sync::{Arc, Mutex, PoisonError},
};

/// Textures that are kept: more than a session has.
pub(crate) const MOST: usize = 256;
/// Drafts that are kept, which are heard while a slider moves.
pub(crate) const MOST_DRAFTS: usize = 16;
/// Bytes of assets that are kept: opened ones may be large.
const MOST_BYTES: usize = 256 << 20;

/// The last textures, the newest at the end.
pub(crate) struct Recent {
    most: usize,
    kept: Mutex<VecDeque<Arc<Texture>>>,
}

impl Recent {
    /// No texture yet, of so many.
    pub(crate) fn new(most: usize) -> Self {
        Self {
            most,
            kept: Mutex::default(),
        }
    }

    /// Keeps a texture. What has the same bytes makes room, then the oldest.
    pub(crate) fn keep(&self, texture: Arc<Texture>) {
        let mut kept = self.kept.lock().unwrap_or_else(PoisonError::into_inner);
        kept.retain(|other| other.id() != texture.id());
        kept.push_back(texture);
        let mut bytes: usize = kept.iter().map(|texture| texture.asset().len()).sum();
        while kept.len() > self.most || (bytes > MOST_BYTES && kept.len() > 1) {
            bytes -= kept.pop_front().map_or(0, |oldest| oldest.asset().len());
        }
    }

    /// The texture of this name, which counts as new: what drafts are made of is asked for again and again.
    pub(crate) fn get(&self, id: &str) -> Option<Arc<Texture>> {
        let mut kept = self.kept.lock().unwrap_or_else(PoisonError::into_inner);
        let at = kept.iter().position(|texture| texture.id() == id)?;
        let texture = kept.remove(at)?;
        kept.push_back(Arc::clone(&texture));
        Some(texture)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn texture(id: &str, bytes: usize) -> Arc<Texture> {
        Arc::new(Texture::of_bytes(id, &vec![0; bytes].into()))
    }

    #[test]
    fn the_last_256_are_kept_each_once() {
        let named = |n: usize| texture(&format!("texture {n}"), 1);
        let recent = Recent::new(MOST);
        let first = named(0);
        recent.keep(Arc::clone(&first));
        for n in 1..MOST {
            recent.keep(named(n));
        }
        recent.keep(named(MOST - 1));
        assert!(recent.get(first.id()).is_some(), "{MOST} fit");
        recent.keep(named(MOST));
        assert!(recent.get(first.id()).is_some(), "it was asked for");
        assert!(recent.get(named(1).id()).is_none(), "the oldest goes");
        assert!(recent.get(named(2).id()).is_some());
        assert!(recent.get("").is_none());
    }

    #[test]
    fn assets_of_256_mib_are_kept_and_not_a_byte_more() {
        let recent = Recent::new(MOST);
        let kept = |ids: &[&str]| ids.iter().filter(|id| recent.get(id).is_some()).count();
        recent.keep(texture("half", 128 << 20));
        recent.keep(texture("rest", (128 << 20) - 1));
        recent.keep(texture("last", 1));
        assert_eq!(kept(&["half", "rest", "last"]), 3, "256 MiB fit");
        recent.keep(texture("more", 1));
        assert_eq!(kept(&["half"]), 0, "the oldest goes");
        assert_eq!(kept(&["rest", "last", "more"]), 3);
    }
}
