//! The raw exports of the module. The caller reserves a request, writes its bytes, asks, and reads the reply before it
//! reserves the next one.
#![allow(
    unsafe_code,
    reason = "exports have names, and what lies between two calls is in statics of the only thread"
)]

use asperity::{learned::inference::Backend, sources::prompt::PromptCompiler};
use asperity_studio::{Reply, Studio};
use std::{cell::RefCell, sync::OnceLock};

/// The module's version, in a section of its own, so that programs can read it from the file without running it.
#[used]
#[unsafe(link_section = "asperity-studio")]
static VERSION: [u8; asperity_studio::VERSION.len()] = {
    let text = asperity_studio::VERSION.as_bytes();
    let mut bytes = [0; asperity_studio::VERSION.len()];
    let mut at = 0;
    while at < bytes.len() {
        bytes[at] = text[at];
        at += 1;
    }
    bytes
};

static STUDIO: OnceLock<Studio> = OnceLock::new();

thread_local! {
    static REQUEST: RefCell<Vec<u8>> = const { RefCell::new(Vec::new()) };
    static REPLY: RefCell<Reply> = const {
        RefCell::new(Reply { status: 0, content_type: "", bytes: Vec::new() })
    };
}

/// Room for a request of so many bytes: the path below the page's address with its query, then the body.
#[unsafe(no_mangle)]
extern "C" fn reserve(length: usize) -> *mut u8 {
    REPLY.with_borrow_mut(|reply| reply.bytes = Vec::new());
    REQUEST.with_borrow_mut(|request| {
        request.clear();
        request.resize(length, 0);
        request.as_mut_ptr()
    })
}

/// Answers the request, whose path ends at `target_length`; what follows is its body if it `posts`. The status of the reply.
#[unsafe(no_mangle)]
extern "C" fn ask(target_length: usize, posts: u32) -> u32 {
    let mut request = REQUEST.take();
    let body = request.split_off(target_length.min(request.len()));
    let target = String::from_utf8_lossy(&request);
    let studio = STUDIO.get_or_init(|| {
        Studio::new(
            None,
            Some(|| Ok(PromptCompiler::embedded(&Backend::Portable)?)),
        )
    });
    let reply = studio.reply(&target, (posts != 0).then_some(body));
    let status = u32::from(reply.status);
    REPLY.set(reply);
    status
}

/// Where the body of the reply lies.
#[unsafe(no_mangle)]
extern "C" fn reply() -> *const u8 {
    REPLY.with_borrow(|reply| reply.bytes.as_ptr())
}

/// Bytes of the body of the reply.
#[unsafe(no_mangle)]
extern "C" fn reply_length() -> usize {
    REPLY.with_borrow(|reply| reply.bytes.len())
}

/// Where the type of the reply lies.
#[unsafe(no_mangle)]
extern "C" fn reply_type() -> *const u8 {
    REPLY.with_borrow(|reply| reply.content_type.as_ptr())
}

/// Bytes of the type of the reply.
#[unsafe(no_mangle)]
extern "C" fn reply_type_length() -> usize {
    REPLY.with_borrow(|reply| reply.content_type.len())
}

/// Nothing here asks for random numbers: tokens belong to servers, names of temporary files to disks.
#[unsafe(no_mangle)]
unsafe extern "Rust" fn __getrandom_v03_custom(
    _to: *mut u8,
    _length: usize,
) -> Result<(), getrandom::Error> {
    Err(getrandom::Error::UNSUPPORTED)
}
