//! DCF of a node: its description with node-ID, bit rate and configured values.

use lexibus_codegen::ir::{Catalog, Commissioning, Configured, Device};
use lexibus_export::eds::{self, Flavor, Reals};

use crate::model::{Network, NetworkNode};
use crate::values::Write;

/// Returns the DCF of a node. Returns `None` if the description has no objects.
pub fn dcf(network: &Network, node: &NetworkNode) -> Option<String> {
    let catalog = configured(network, node, node.description.without_profiles()?);
    let options = eds::Options { flavor: Flavor::Dcf, reals: Reals::Decimal };
    eds::export(&catalog, &catalog.devices[0], options).map(|exported| exported.text)
}

/// Adds node-ID, bit rate, names and configured values of a node to its catalog.
pub(super) fn configured(network: &Network, node: &NetworkNode, mut catalog: Catalog) -> Catalog {
    let device = &mut catalog.devices[0];
    let commissioning = device.commissioning.take().unwrap_or_default();
    device.commissioning = Some(Box::new(Commissioning {
        node_id: Some(node.id),
        node_name: node.name.value.as_str().into(),
        bit_rate: Some(network.bit_rate),
        network_name: network.name.as_str().into(),
        manager: false,
        lss_serial_number: Some(node.identity[3]).filter(|serial| *serial != 0),
        ..*commissioning
    }));
    node.writes.iter().for_each(|write| configure(device, write));
    catalog
}

/// Sets the configured value of an item.
fn configure(device: &mut Device, write: &Write) {
    let Some(value) = &write.value else { return };
    let items = device.groups.iter_mut().flat_map(|group| &mut group.items);
    if let Some(item) = items.into_iter().find(|item| item.object() == Some(write.object)) {
        let others = item.configured.take().unwrap_or_default();
        item.configured = Some(Box::new(Configured { value: Some(value.clone()), ..*others }));
    }
}
