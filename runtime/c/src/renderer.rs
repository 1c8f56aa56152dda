//! The renderer.

use crate::{
    AsperityConfig, AsperityError, AsperityStatus,
    memory::{self, ASPERITY_RENDERER_SIZE, Object, place},
    status::call,
};
use asperity_runtime::{Config, Renderer};
use core::ffi::c_void;

/// A checked configuration; it serves any number of states and textures.
#[derive(Debug)]
pub struct AsperityRenderer {
    tag: u32,
    pub(crate) renderer: Renderer,
}

impl Object for AsperityRenderer {
    const TAG: u32 = u32::from_le_bytes(*b"aspR");
    const SIZE: usize = ASPERITY_RENDERER_SIZE;

    fn tag(this: *const Self) -> *const u32 {
        // SAFETY: the address is computed and nothing is read; the caller's pointer leads
        // to memory of this size.
        unsafe { &raw const (*this).tag }
    }
}

/// Checks a configuration and makes a renderer in `memory` of at least
/// `ASPERITY_RENDERER_SIZE` bytes.
///
/// # Safety
/// `memory` is null or `size` bytes that nothing else uses; `config` is null or readable;
/// `renderer` and `error` are null or valid for writes.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn asperity_renderer_init(
    memory: *mut c_void,
    size: usize,
    config: *const AsperityConfig,
    renderer: *mut *mut AsperityRenderer,
    error: *mut AsperityError,
) -> AsperityStatus {
    // SAFETY: the caller's promises; any bits are a configuration, if not a valid one.
    unsafe {
        call(error, || {
            let checked = Renderer::new(&Config::try_from(memory::read(config)?)?)?;
            let object = || AsperityRenderer {
                tag: AsperityRenderer::TAG,
                renderer: checked,
            };
            Ok(place(memory, size, renderer, object)?)
        })
    }
}
