//! State of the server: networks, the textures that it was started with, the last textures.

use crate::{
    about::{self, Served},
    batch::{self, Batch},
    collection::Collection,
    device::LiveDevice,
    error::ApiError,
    folder::Folder,
    http::Status,
    library_store::{LibraryHandle, LibraryStore},
    limiter::Limiter,
    making,
    opening::{self, FileContent, Stated},
    project::Project,
    prompts::{LoadPrompts, Prompts},
    recent::{self, Recent},
    recipe::{Link, Operation},
    texture::Texture,
};
use std::sync::Arc;

/// A studio for one person.
pub struct Studio {
    shelf: LibraryStore,
    device: Option<LiveDevice>,
    prompts: Prompts,
    batch: Batch,
    recent: Recent,
    drafts: Recent,
    project: Option<Project>,
    computing: Limiter,
    sending: Limiter,
}

/// An opened file that the server keeps.
pub(crate) enum OpenedFile {
    Texture(Arc<Texture>),
    Library(LibraryHandle),
}

impl Studio {
    /// A studio with the textures that it was started with, and with how the prompt compiler is loaded. Without the
    /// latter it shows textures, and makes none.
    #[must_use]
    pub fn new(collection: Option<Collection>, prompts: Option<LoadPrompts>) -> Self {
        Self {
            shelf: LibraryStore::new(collection),
            device: None,
            prompts: Prompts::new(prompts),
            batch: Batch::default(),
            recent: Recent::new(recent::MOST),
            drafts: Recent::new(recent::MOST_DRAFTS),
            project: None,
            computing: Limiter::computing(),
            sending: Limiter::sending(),
        }
    }

    /// The same, beside the servo loop of this device.
    #[must_use]
    pub fn with_device(self, device: LiveDevice) -> Self {
        Self {
            device: Some(device),
            ..self
        }
    }

    /// The same, which keeps what is made in a project.
    #[must_use]
    pub fn with_project(self, project: Project) -> Self {
        Self {
            project: Some(project),
            ..self
        }
    }

    /// Keeps what the page shows in the project.
    ///
    /// # Errors
    /// As [`Project::save`], and without a project.
    pub(crate) fn save(&self, page: &str, state: &[u8]) -> Result<(), ApiError> {
        self.project()?.save(page, state, |id| self.recent.get(id))
    }

    /// The project.
    ///
    /// # Errors
    /// Where there is none.
    pub(crate) fn project(&self) -> Result<&Project, ApiError> {
        self.project.as_ref().ok_or_else(|| {
            let error = "this studio keeps no project";
            ApiError::new(Status::NotFound, error, "start it with --project")
        })
    }

    /// The device beside it.
    pub(crate) fn device(&self) -> Option<&LiveDevice> {
        self.device.as_ref()
    }

    /// Loads the networks, unless they are loaded; others who need them wait.
    pub(crate) fn load(&self) {
        let _ = self.prompts.get();
    }

    /// Returns the server's version and capabilities, JSON.
    pub(crate) fn about(&self) -> Vec<u8> {
        about::about(
            &self.prompts,
            self.start().as_ref(),
            self.device.as_ref(),
            self.project.as_ref(),
            Served::Live,
        )
    }

    /// Returns the capabilities of a page without a server, JSON.
    pub(crate) fn about_exported(&self, served: Served) -> Vec<u8> {
        about::about(&self.prompts, self.start().as_ref(), None, None, served)
    }

    /// The library that it was started with.
    pub(crate) fn start(&self) -> Option<LibraryHandle> {
        self.shelf.start()
    }

    /// Performs an operation, and keeps what comes of it: a draft not for long.
    ///
    /// # Errors
    /// As the command, for textures that are not here, and without a prompt compiler.
    pub(crate) fn perform(&self, operation: Operation) -> Result<Arc<Texture>, ApiError> {
        self.perform_on(operation, |id| self.texture(id))
    }

    /// Performs the operations of a link; what each gave.
    ///
    /// # Errors
    /// As [`perform`](Self::perform), for the first that fails.
    pub(crate) fn follow(&self, link: &Link) -> Result<Vec<Arc<Texture>>, ApiError> {
        let mut made: Vec<Arc<Texture>> = Vec::with_capacity(link.steps.len());
        for (at, step) in link.steps.iter().enumerate() {
            let texture = self.perform_on(step.clone(), |name| {
                Ok(Arc::clone(&made[Link::place(at, name)?]))
            })?;
            made.push(texture);
        }
        Ok(made)
    }

    fn perform_on(
        &self,
        mut operation: Operation,
        texture: impl Fn(&str) -> Result<Arc<Texture>, ApiError>,
    ) -> Result<Arc<Texture>, ApiError> {
        let names = operation.others_mut().into_iter();
        let others = names
            .map(|name| texture(name))
            .collect::<Result<Vec<_>, _>>()?;
        let made = self.compute(|| making::perform(self.prompts.get()?, &operation, &others))?;
        if operation.is_draft() {
            let made = Arc::new(made);
            self.drafts.keep(Arc::clone(&made));
            return Ok(made);
        }
        Ok(self.keep(made))
    }

    /// Opens the bytes of a file, and keeps what it holds. Of a picture, its size and its material have to be stated.
    ///
    /// # Errors
    /// As a command that opens such a file.
    pub(crate) fn open(
        &self,
        file: &str,
        bytes: Vec<u8>,
        stated: Stated<'_>,
    ) -> Result<OpenedFile, ApiError> {
        if batch::is_list(file) {
            let library = self.batch.run(file, &bytes, self.prompts.loader()?)?;
            return Ok(OpenedFile::Library(self.shelf.keep(library)));
        }
        let found = self.compute(|| {
            if !opening::is_picture(&bytes) {
                return opening::open(file, bytes);
            }
            let texture = opening::surface(file, &bytes, stated, self.prompts.get()?)?;
            Ok(FileContent::Texture(Box::new(texture)))
        })?;
        Ok(match found {
            FileContent::Texture(texture) => OpenedFile::Texture(self.keep(*texture)),
            FileContent::Library(library) => OpenedFile::Library(self.shelf.keep(*library)),
        })
    }

    /// Opens the files of a recording or of a material, and keeps the texture.
    ///
    /// # Errors
    /// As `asperity import`, and without a prompt compiler.
    pub(crate) fn open_folder(
        &self,
        folder: &Folder<'_>,
        stated: Stated<'_>,
    ) -> Result<OpenedFile, ApiError> {
        let texture = self.compute(|| folder.texture(stated, self.prompts.get()?))?;
        Ok(OpenedFile::Texture(self.keep(texture)))
    }

    /// The list of prompts that is compiled, if any.
    pub(crate) fn batch(&self) -> &Batch {
        &self.batch
    }

    /// The library of this name.
    ///
    /// # Errors
    /// Where there is none, or no longer.
    pub(crate) fn library(&self, id: &str) -> Result<LibraryHandle, ApiError> {
        self.shelf.get(id)
    }

    /// Takes the texture at a place of a library, and keeps it.
    ///
    /// # Errors
    /// As `asperity extract`.
    pub(crate) fn pick(
        &self,
        library: &LibraryHandle,
        at: usize,
    ) -> Result<Arc<Texture>, ApiError> {
        let texture = self.compute(|| library.library.texture(at))?;
        Ok(self.keep(texture))
    }

    /// A texture that was made or opened lately, or is in the project.
    ///
    /// # Errors
    /// Where there is none.
    pub(crate) fn texture(&self, id: &str) -> Result<Arc<Texture>, ApiError> {
        let lately = || self.recent.get(id).or_else(|| self.drafts.get(id));
        let kept = || {
            let texture = Arc::new(self.project.as_ref()?.texture(id)?);
            self.recent.keep(Arc::clone(&texture));
            Some(texture)
        };
        lately().or_else(kept).ok_or_else(|| {
            ApiError::new(
                Status::NotFound,
                "the server does not have this texture, or no longer",
                "compile or open it again",
            )
        })
    }

    /// Returns the page's view of a texture, JSON.
    pub(crate) fn shown(&self, texture: &Texture) -> String {
        texture.shown(self.prompts.get().ok())
    }

    /// Does this once few others compute.
    pub(crate) fn compute<T>(&self, work: impl FnOnce() -> T) -> T {
        self.computing.take(work)
    }

    /// Does this, which reads a large body, once few others do.
    pub(crate) fn send<T>(&self, work: impl FnOnce() -> T) -> T {
        self.sending.take(work)
    }

    fn keep(&self, texture: Texture) -> Arc<Texture> {
        let texture = Arc::new(texture);
        self.recent.keep(Arc::clone(&texture));
        texture
    }
}
