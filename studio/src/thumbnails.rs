//! Pictures of a library's textures: those that assets hold, and small ones drawn of the others.

use crate::{error::ApiError, texture::damaged};
use asperity::{emit::raise::raise, views::preview};
use asperity_formats::Asset;
use std::{
    collections::{HashMap, VecDeque},
    sync::{Arc, Mutex, PoisonError},
};

/// Width and height of a picture that is drawn.
const SIZE_PX: u32 = 96;
/// Bytes of drawn pictures that are kept.
const MOST_BYTES: usize = 64 << 20;

/// The pictures that were drawn last.
#[derive(Debug, Default)]
pub(crate) struct Thumbnails(Mutex<ThumbnailCache>);

#[derive(Debug, Default)]
struct ThumbnailCache {
    drawn: HashMap<usize, Arc<[u8]>>,
    /// Places, the picture that was drawn first at the front.
    order: VecDeque<usize>,
    bytes: usize,
}

impl Thumbnails {
    /// The picture of the texture at a place, whose bytes `asset` reads.
    ///
    /// # Errors
    /// As `asset`, and where the picture cannot be drawn.
    pub(crate) fn get(
        &self,
        at: usize,
        asset: impl FnOnce() -> Result<Vec<u8>, ApiError>,
    ) -> Result<Arc<[u8]>, ApiError> {
        if let Some(png) = self.lock().drawn.get(&at) {
            return Ok(Arc::clone(png));
        }
        let bytes = asset()?;
        let asset = Asset::parse(&bytes).map_err(damaged)?;
        let stored = asset.preview_png();
        if let Some(png) = stored.filter(|png| preview::stored(png).is_ok()) {
            return Ok(png.into());
        }
        let picture = preview::draw(&raise(&asset), SIZE_PX).map_err(|e| ApiError::of(&e))?;
        let png = picture
            .png()
            .map_err(|e| ApiError::of(&preview::not_encoded(e)))?;
        let png: Arc<[u8]> = png.into();
        self.lock().keep(at, &png);
        Ok(png)
    }

    fn lock(&self) -> std::sync::MutexGuard<'_, ThumbnailCache> {
        self.0.lock().unwrap_or_else(PoisonError::into_inner)
    }
}

impl ThumbnailCache {
    /// Keeps a picture; the oldest make room for it.
    fn keep(&mut self, at: usize, png: &Arc<[u8]>) {
        if self.drawn.insert(at, Arc::clone(png)).is_some() {
            return;
        }
        self.order.push_back(at);
        self.bytes += png.len();
        while self.bytes > MOST_BYTES {
            let Some(oldest) = self.order.pop_front() else {
                return;
            };
            self.bytes -= self.drawn.remove(&oldest).map_or(0, |png| png.len());
        }
    }
}
