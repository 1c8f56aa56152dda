//! The renderer.

use crate::{
    AsperityConfig, AsperityError, AsperityStatus,
    arithmetic::{Numbered, by_arithmetic},
    memory::{Object, Tag, room, uninit},
    sized,
    status::{Fault, call},
};
use asperity_runtime::Renderer;
use core::ffi::c_void;

/// Size of the memory of an `AsperityRenderer`, bytes.
pub const ASPERITY_RENDERER_SIZE: usize = 1024;

/// A checked configuration; it serves any number of states and textures.
#[derive(Debug)]
#[repr(C)]
pub struct AsperityRenderer {
    tag: Tag,
}

/// Object behind an `AsperityRenderer` pointer.
#[repr(C)]
pub(crate) struct RendererOf<A: Numbered> {
    tag: Tag,
    pub(crate) renderer: Renderer<A>,
}

// SAFETY: `repr(C)`, the tag is first.
unsafe impl<A: Numbered> Object for RendererOf<A> {
    const TAG: Tag = Tag::new(b'R', A::NUMBER, 0);
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
            let config = sized::read(config)?;
            let checked = config.checked()?;
            by_arithmetic!(config.arithmetic, A => {
                let object = room::<RendererOf<A>, _>(
                    memory,
                    size,
                    ASPERITY_RENDERER_SIZE,
                    renderer,
                )?;
                Renderer::prepare_in(uninit(&raw mut (*object).renderer), &checked)?;
                (&raw mut (*object).tag).write(RendererOf::<A>::TAG);
                renderer.write(object.cast());
                Ok(())
            }, else Fault::Choice {
                field: "arithmetic",
                value: config.arithmetic,
                known: if cfg!(feature = "fixed") {
                    "0 (floats) or 1 (fixed point)"
                } else {
                    "0 (floats): this library is built without fixed point"
                },
            })
        })
    }
}
