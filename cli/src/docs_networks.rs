//! The networks in a documentation site.

use std::collections::HashMap;
use std::path::{Path, PathBuf};

use lexibus_codegen::diagnostics::Levels;
use lexibus_codegen::source::Source;
use lexibus_network::compile::{compile, Compilation};
use lexibus_network::frontend::{is_network, Format};
use lexibus_network::model::Network;
use lexibus_network::output::{announce, pages};
use lexibus_site::{page_name, Page, Site};

use super::report::Reporter;
use super::Failure;

/// The networks of a site, each with its title.
pub(super) struct Networks(Vec<(String, Compilation)>);

impl Networks {
    /// Compiles the network files in a list of files, reports their diagnostics, and removes these files from the list.
    pub(super) fn take(files: &mut Vec<PathBuf>, levels: &Levels, reporter: &mut Reporter) -> Result<Self, Failure> {
        let (mut networks, mut titles) = (Vec::new(), HashMap::new());
        for path in std::mem::take(files) {
            let Some(source) = network_file(&path) else {
                files.push(path);
                continue;
            };
            let compilation = compile(source, levels.clone());
            super::network::report(reporter, &compilation)?;
            let title = title(&path, &compilation);
            if let Some(other) = titles.insert(page_name(&title), title.clone()) {
                let path = path.display();
                reporter.error(&format!(
                    "{path}: the network `{title}` would have the same page as the network `{other}`; change `name`"
                ));
                continue;
            }
            networks.push((title, compilation));
        }
        Ok(Networks(networks))
    }

    pub(super) fn is_empty(&self) -> bool {
        self.0.is_empty()
    }

    /// Announces to the site the devices of all networks without errors.
    pub(super) fn announce(&self, site: &mut Site) {
        self.usable().for_each(|(title, network)| announce(network, title, site));
    }

    /// Returns the pages of all networks without errors, and the pages of the devices in these networks.
    pub(super) fn pages(&self, site: &mut Site) -> Vec<Page> {
        self.usable().flat_map(|(title, network)| pages(network, title, site)).collect()
    }

    fn usable(&self) -> impl Iterator<Item = (&str, &Network)> {
        self.0.iter().filter_map(|(title, compilation)| Some((title.as_str(), compilation.usable()?)))
    }
}

/// Returns the content of a network file, or `None` for other files. Files without the extension of a network file are
/// not read, because ESI files can be large.
fn network_file(path: &Path) -> Option<Source> {
    Format::of_name(&path.to_string_lossy())?;
    Source::read(path).ok().filter(is_network)
}

/// Returns the name of a network, or the file name without extension if the network has no name.
fn title(path: &Path, compilation: &Compilation) -> String {
    match compilation.network.as_ref().map(|network| network.name.as_str()) {
        None | Some("") => path.file_stem().unwrap_or_default().to_string_lossy().into_owned(),
        Some(name) => name.to_owned(),
    }
}
