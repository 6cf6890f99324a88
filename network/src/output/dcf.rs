//! DCF of a node: its description with node-ID, bit rate and configured values.

use lexibus_export::eds::{self, Flavor, Reals};

use super::configured::configured;
use crate::model::{Network, NetworkNode};

/// Returns the DCF of a node. Returns `None` if the description has no objects.
pub fn dcf(network: &Network, node: &NetworkNode) -> Option<String> {
    let catalog = configured(network, node, node.description.without_profiles()?);
    let options = eds::Options { flavor: Flavor::Dcf, reals: Reals::Decimal };
    eds::export(&catalog, &catalog.devices[0], options).map(|exported| exported.text)
}
