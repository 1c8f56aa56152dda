//! The page of a library as static files, for any web server: the page itself, and the answers of the interface to
//! everything that it asks for by GET.

use crate::{
    about::{MODULE, OFFERED, Served},
    bundle,
    collection::Collection,
    download::Download,
    error::ApiError,
    http::PAGE_POLICY,
    library_store::LibraryHandle,
    module::Module,
    page,
    prompts::LoadPrompts,
    studio::Studio,
};
use asperity_io::{
    diagnostic::Diagnostic,
    output::{OutputError, WholeFolder},
};
use rayon::prelude::*;
use std::{
    collections::HashSet,
    path::Path,
    sync::{
        Mutex, PoisonError,
        atomic::{AtomicU64, AtomicUsize, Ordering},
    },
};
use thiserror::Error;

/// Files that the page itself also loads.
const LOADED: [&str; 2] = ["worklet.asp", "unlit.png"];
/// Before which the policy stands in the page, since a static server sends none.
const BEFORE_POLICY: &str = "<meta name=\"viewport\"";

/// Size of an exported page.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Exported {
    /// Number of textures.
    pub textures: usize,
    /// Number of files.
    pub files: usize,
    /// Bytes of all files.
    pub bytes: u64,
}

/// Why a page was not written.
#[derive(Debug, Error)]
pub enum ExportError {
    /// A texture whose files cannot be computed.
    #[error("{name}: {error}")]
    Texture {
        /// The texture.
        name: String,
        /// Why.
        error: String,
        /// The remedy.
        help: String,
    },
    /// A file that cannot be written.
    #[error(transparent)]
    Output(#[from] OutputError),
}

impl Diagnostic for ExportError {
    fn remedy(&self) -> String {
        match self {
            Self::Texture { help, .. } => help.clone(),
            Self::Output(error) => error.remedy(),
        }
    }
}

/// Writes the page of a collection into a folder that is new or empty. The same collection gives the same bytes on
/// every machine, wherever it lies. `done` is called after each texture, from any thread.
///
/// With a module, the page also compiles, edits, opens and saves as the studio does; what loads the same prompt compiler
/// here serves for what the page says of each texture.
///
/// # Errors
/// [`ExportError`] for the first texture that cannot be shown, and where a file cannot be written. Nothing of the page
/// stays then.
pub fn export(
    collection: Collection,
    module: Option<(Module, LoadPrompts)>,
    folder: &Path,
    done: impl Fn() + Sync,
) -> Result<Exported, ExportError> {
    let writer = Writer {
        folder: WholeFolder::create(folder)?,
        textures: Mutex::default(),
        files: AtomicUsize::new(0),
        bytes: AtomicU64::new(0),
    };
    for (name, bytes) in bundle::files() {
        writer.write(name, &exported(name, bytes))?;
    }
    let textures = collection.textures();
    let (module, load) = module.unzip();
    let studio = Studio::new(Some(collection.elsewhere()), load);
    let mut served = Served::Files;
    if let Some(module) = module {
        writer.write(MODULE, module.bytes())?;
        served = Served::FilesAndModule(module.bytes().len());
    }
    writer.write("api/about.json", &studio.about_exported(served))?;
    // The library that the studio was started with, which is there.
    if let Some(handle) = studio.start() {
        let ids = (0..textures).into_par_iter().map(|at| {
            let id = writer.texture(&studio, &handle, at)?;
            done();
            Ok(id)
        });
        let ids: Vec<String> = ids.collect::<Result<_, ExportError>>()?;
        let columns = handle.library.columns_with(&handle.id, &ids);
        writer.write(&format!("api/library/{}.json", handle.id), &columns)?;
    }
    writer.folder.commit()?;
    Ok(Exported {
        textures,
        files: writer.files.into_inner(),
        bytes: writer.bytes.into_inner(),
    })
}

struct Writer {
    folder: WholeFolder,
    /// Textures whose files are there, or on their way.
    textures: Mutex<HashSet<String>>,
    files: AtomicUsize,
    bytes: AtomicU64,
}

impl Writer {
    /// Writes the texture at a place of a library: what the page gets when it picks it, and its files. Textures that are
    /// the same but for their place share those. Gives what names the texture.
    fn texture(
        &self,
        studio: &Studio,
        handle: &LibraryHandle,
        at: usize,
    ) -> Result<String, ExportError> {
        let library = &handle.library;
        let fail = |error: ApiError| ExportError::Texture {
            name: library.names().nth(at).unwrap_or_default().to_owned(),
            error: error.error,
            help: error.help.unwrap_or_default(),
        };
        let texture = library.texture(at).map_err(fail)?;
        let shown = studio.shown(&texture);
        self.write(
            &format!("api/library/{}/{at}.json", handle.id),
            shown.as_bytes(),
        )?;
        let id = texture.id();
        let mut textures = self.textures.lock().unwrap_or_else(PoisonError::into_inner);
        let is_new = textures.insert(id.to_owned());
        drop(textures);
        if is_new {
            for ending in OFFERED.into_iter().chain(LOADED) {
                if let Some(file) = Download::of(ending) {
                    let bytes = file.bytes(&texture).map_err(fail)?;
                    self.write(&format!("api/texture/{id}.{ending}"), &bytes)?;
                }
            }
        }
        Ok(id.to_owned())
    }

    fn write(&self, name: &str, bytes: &[u8]) -> Result<(), OutputError> {
        self.folder.write(name, bytes)?;
        self.files.fetch_add(1, Ordering::Relaxed);
        self.bytes.fetch_add(bytes.len() as u64, Ordering::Relaxed);
        Ok(())
    }
}

/// A file of the page, as a static server gives it.
fn exported(name: &str, bytes: Vec<u8>) -> Vec<u8> {
    if name != page::INDEX {
        return bytes;
    }
    let page = String::from_utf8_lossy(&bytes);
    let policy = format!(
        "<meta http-equiv=\"Content-Security-Policy\" content=\"{PAGE_POLICY}\">\n  {BEFORE_POLICY}"
    );
    page.replacen(BEFORE_POLICY, &policy, 1).into_bytes()
}
