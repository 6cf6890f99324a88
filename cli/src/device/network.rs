//! Nodes of a network file.

use std::path::Path;

use lexibus_codegen::compile::Compilation as Reported;
use lexibus_codegen::diagnostics::{Levels, Severity};
use lexibus_codegen::text::similar;
use lexibus_device::{BusAddress, Description, Network};
use lexibus_network::compile::{compile, Compilation};
use lexibus_network::model::{self, NetworkNode};
use lexibus_network::output::node_catalog;

use crate::files::read;
use crate::Failure;

/// Default path of the network file, relative to the working directory.
pub(super) const DEFAULT: &str = "network.toml";

/// A network file without errors.
pub(super) struct NetworkFile {
    compilation: Compilation,
}

/// The origin of the values in a node's description.
#[derive(Clone, Copy, PartialEq, Eq)]
pub(super) enum Values {
    /// The values of the description file.
    Described,
    /// The values and PDOs that the network file configures.
    Configured,
}

impl NetworkFile {
    /// Reads a network file, by default `network.toml` in the working directory.
    pub(super) fn open(path: Option<&Path>) -> Result<Self, Failure> {
        let compilation = compile(read(path.unwrap_or(Path::new(DEFAULT)))?, Levels::lenient());
        if compilation.usable().is_some() {
            return Ok(NetworkFile { compilation });
        }
        let Compilation { source, diagnostics, .. } = compilation;
        let reported = Reported::of_diagnostics(source, diagnostics);
        let mut errors = reported.diagnostics.list().iter().filter(|found| found.severity == Severity::Error);
        let first =
            errors.next().map_or_else(|| "the file is not a network file".to_owned(), |one| reported.one_line(one));
        Err(Failure::Failed(first))
    }

    fn network(&self) -> &model::Network {
        self.compilation.network.as_ref().expect("a usable network")
    }

    fn name(&self) -> &str {
        self.compilation.source.name()
    }

    /// Returns the names of all nodes.
    pub(super) fn names(&self) -> impl Iterator<Item = &str> {
        self.network().nodes.iter().map(|node| node.name.value.as_str())
    }

    /// Returns the node-ID and the description of a node.
    pub(super) fn node(&self, name: &str, values: Values) -> Result<(u8, Description), Failure> {
        let node = self.network().nodes.iter().find(|node| node.name.value == name);
        let node = node.ok_or_else(|| self.unknown(name))?;
        let catalog = match values {
            Values::Described => node.description.catalog().clone(),
            Values::Configured => node_catalog(self.network(), node),
        };
        let description = Description::new(catalog, Network::CanOpen);
        Ok((node.id, description.map_err(|error| Failure::Failed(format!("{name}: {error}")))?))
    }

    fn unknown(&self, name: &str) -> Failure {
        let shown = |node: &NetworkNode| format!("{} ({})", node.name.value, node.id);
        let nodes: Vec<String> = self.network().nodes.iter().map(shown).collect();
        let question = similar(name, self.names()).map_or(String::new(), |name| format!(" Did you mean `{name}`?"));
        let text = format!("{} has no node `{name}`. Its nodes are {}.{question}", self.name(), nodes.join(", "));
        Failure::Usage(text)
    }

    /// Returns the bus `given`, or the bus of the network file if `given` is `None`. If the bus is a serial CAN adapter
    /// without a bit rate, the adapter gets the bit rate that the network file declares.
    pub(super) fn bus(&self, given: Option<&BusAddress>) -> Result<BusAddress, Failure> {
        let mut bus = match (given, &self.compilation.bus) {
            (Some(bus), _) => bus.clone(),
            (None, Some(bus)) => {
                let at = self.compilation.source.position(bus.span.start);
                let wrong = |error| Failure::Failed(format!("{}:{}:{}: {error}", self.name(), at.line, at.column));
                bus.value.parse().map_err(wrong)?
            }
            (None, None) => {
                let text =
                    format!("{} states no bus: add the key `bus` to the section `network`, or use --bus", self.name());
                return Err(Failure::Usage(text));
            }
        };
        if bus.network() != Network::CanOpen {
            return Err(Failure::Usage(format!(
                "{} needs a CAN bus, such as can:can0 or slcan:/dev/ttyACM0",
                self.name()
            )));
        }
        let network = self.network();
        if let BusAddress::Slcan { bit_rate: bit_rate @ None, .. } = &mut bus {
            *bit_rate = (!network.bit_rate_at.is_empty()).then_some(network.bit_rate);
        }
        Ok(bus)
    }
}
