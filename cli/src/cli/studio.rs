//! Arguments of the studio.

use clap::Args;
use std::path::PathBuf;

#[derive(Debug, Args)]
#[command(
    after_help = "Prints the address of the page and opens it in a browser. The page is served to this machine alone, and \
only under that address, which holds a secret: whoever has it can use the studio until it ends. Prompts are compiled as \
`asperity compile` does, to the same bytes. What is made is kept in a project, and is there again at the next start. Ctrl-C \
ends it.

With --export, the page of a library becomes static files for any web server: to see, hear and stroke its textures without \
Asperity. With --compiler as well, the page also compiles prompts, in a worker. Browsers play sound only for pages \
that come over HTTPS or from the same machine.

Examples:
  asperity studio
  asperity studio hatt.aspl
  asperity studio textures/ --port 8016 --no-open
  asperity studio --project dashboard
  asperity studio hatt.aspl --export page"
)]
pub(crate) struct Studio {
    /// A library (.aspl), an asset (.asp), or a folder of assets, to have at hand; or the folder of a project
    #[arg(value_name = "LIBRARY|ASSET|FOLDER|PROJECT")]
    pub(crate) collection: Option<PathBuf>,
    /// Folder that keeps what is made, new, empty or a project [default: one of the user's own]
    #[arg(long, value_name = "DIR")]
    pub(crate) project: Option<PathBuf>,
    /// Port to listen on; 0 is a free one [default: 8417, or a free one where that is taken]
    #[arg(long, value_name = "N")]
    pub(crate) port: Option<u16>,
    /// Only print the address, and open no browser
    #[arg(long)]
    pub(crate) no_open: bool,
    /// Write the page of the library as static files into this folder, new or empty, and serve nothing
    #[arg(long, value_name = "DIR", requires = "collection", conflicts_with_all = ["port", "no_open", "project"])]
    pub(crate) export: Option<PathBuf>,
    /// With --export: put this compiler into the page, so that it needs no server for prompts, edits and files;
    /// `studio/build-module` builds it
    #[arg(long, value_name = "FILE.wasm", requires = "export")]
    pub(crate) compiler: Option<PathBuf>,
}
