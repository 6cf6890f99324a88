//! Compiles a network file: front end, resolution and checks.

use lexibus_codegen::diagnostics::{Diagnostics, Levels};
use lexibus_codegen::source::{FileId, Source};

use crate::model::Network;
use crate::syntax::At;
use crate::{check, ethercat, frontend, resolve};

/// The result of a compilation.
#[derive(Debug)]
pub struct Compilation {
    /// The network file.
    pub source: Source,
    /// Bus through which the computer accesses the devices of the network, such as `can:can0`.
    pub bus: Option<At<String>>,
    /// The network; `None` if the file cannot be read as a network.
    pub network: Option<Network>,
    /// Diagnostics, sorted by position.
    pub diagnostics: Diagnostics,
}

impl Compilation {
    /// Returns the network, or `None` if there are errors.
    pub fn usable(&self) -> Option<&Network> {
        self.network.as_ref().filter(|_| !self.diagnostics.has_errors())
    }
}

/// Compiles a network file. Relative paths of descriptions are looked up in the folders that the network file declares, and
/// then in the folder of the network file.
pub fn compile(source: Source, levels: Levels) -> Compilation {
    let mut diagnostics = Diagnostics::new(levels);
    let declared = frontend::read(&source, FileId(0), &mut diagnostics);
    let bus = declared.as_ref().and_then(|declared| declared.bus.clone());
    let network = declared.map(|mut declared| {
        let segment = declared.segment.take();
        let network = resolve::resolve(&source, declared, &mut diagnostics);
        let segment = segment.map(|segment| ethercat::resolve(&source, &segment, &mut diagnostics));
        Network { segment, ..network }
    });
    if let Some(network) = &network {
        check::check(network, &mut diagnostics);
    }
    diagnostics.sort();
    Compilation { source, bus, network, diagnostics }
}
