//! Arguments that select a single device or module of a file.

use crate::collections::HashMap;
use crate::number::hex32;

use super::{device_names, module_names, number, DeviceFilter};
use crate::ir::{Device, Module};

/// Returns, for each device, an argument of `--device` that selects only this device, or `None` if there is no such argument. An
/// argument is the order code, name, identifier or product code. The revision follows if several devices match the text before it.
pub fn of_devices(devices: &[Device]) -> Vec<Option<String>> {
    let index = Index::new(devices.iter().map(|device| (device.identity.product_code, device_names(device).to_vec())));
    let revision = |at: &usize| devices[*at].identity.revision_number;
    let argument = |(at, device): (usize, &Device)| {
        let names = [&device.identity.order_code, &device.name, &device.id].map(|name| name.as_str().to_owned());
        let code = device.identity.product_code.map(hex32);
        let candidates: Vec<String> = names.into_iter().chain(code).filter(|text| is_plain(text)).collect();
        let alone = candidates.iter().find(|text| index.matching(text) == [at]).cloned();
        alone.or_else(|| {
            let number = revision(&at)?;
            let is_only =
                |text: &&String| index.matching(text).iter().filter(|at| revision(at) == Some(number)).count() == 1;
            Some(format!("{}@{}", candidates.iter().find(is_only)?, hex32(number)))
        })
    };
    devices.iter().enumerate().map(argument).collect()
}

/// Returns, for each module, an argument of `--module` that selects only this module: the identifier, name, order code or ident
/// number. Returns `None` if there is no such argument.
pub fn of_modules(modules: &[Module]) -> Vec<Option<String>> {
    let index = Index::new(modules.iter().map(|module| (Some(module.number), module_names(module).to_vec())));
    let argument = |(at, module): (usize, &Module)| {
        let names = [&module.id, &module.name, &module.identity.order_code].map(|name| name.as_str().to_owned());
        let candidates = names.into_iter().chain([hex32(module.number)]);
        candidates.filter(|text| is_plain(text)).find(|text| index.matching(text) == [at])
    };
    modules.iter().enumerate().map(argument).collect()
}

/// Returns whether `text` can be an argument that matches only elements with exactly this name or number: `text` has no revision,
/// no `*`, no control characters and no surrounding white space, and does not start with `-`.
fn is_plain(text: &str) -> bool {
    let has_revision = text.parse::<DeviceFilter>().map_or(true, |filter| filter.revision.is_some());
    // The command line would read a text that starts with `-` as an option.
    let is_argument = !text.starts_with('-') && !text.chars().any(char::is_control);
    text == text.trim() && !has_revision && !text.contains('*') && is_argument
}

/// The positions of all elements, by name in lower case and by number.
struct Index {
    names: HashMap<String, Vec<usize>>,
    numbers: HashMap<u32, Vec<usize>>,
}

impl Index {
    fn new<'n>(elements: impl Iterator<Item = (Option<u32>, Vec<&'n str>)>) -> Self {
        let mut index = Index { names: HashMap::default(), numbers: HashMap::default() };
        for (at, (number, names)) in elements.enumerate() {
            for name in names {
                index.names.entry(name.to_lowercase()).or_default().push(at);
            }
            if let Some(number) = number {
                index.numbers.entry(number).or_default().push(at);
            }
        }
        index
    }

    /// Returns the positions of the elements that a filter with this text selects.
    fn matching(&self, text: &str) -> Vec<usize> {
        let named = self.names.get(&text.to_lowercase());
        let numbered = number(text).and_then(|number| self.numbers.get(&number));
        let mut found: Vec<usize> = named.into_iter().chain(numbered).flatten().copied().collect();
        found.sort_unstable();
        found.dedup();
        found
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::ir::Identity;

    fn device(order_code: &str, name: &str, product_code: u32, revision: u32) -> Device {
        let identity = Identity {
            order_code: order_code.into(),
            product_code: Some(product_code),
            revision_number: Some(revision),
            ..Identity::default()
        };
        Device { name: name.into(), identity, ..Device::default() }
    }

    #[test]
    fn an_argument_selects_one_device() {
        let devices = [
            device("EL1", "First", 1, 1),
            device("EL1", "First", 1, 2),
            device("", "Second", 2, 1),
            device("EL*", "Second", 3, 1),
            device("2", "Third", 4, 1),
            device("-4", "Fo\"u\"r", 6, 1),
            device("-4", "-", 7, 1),
            device("", "", 5, 1),
            device("", "", 5, 1),
        ];
        let expected = [
            Some("EL1@0x00000001"),
            Some("EL1@0x00000002"),
            Some("0x00000002"),
            Some("0x00000003"),
            Some("Third"),
            Some("Fo\"u\"r"),
            Some("0x00000007"),
            None,
            None,
        ];
        let arguments = of_devices(&devices);
        assert_eq!(arguments.iter().map(Option::as_deref).collect::<Vec<_>>(), expected);
        for (argument, device) in arguments.iter().zip(&devices) {
            let Some(argument) = argument else { continue };
            let filter: DeviceFilter = argument.parse().expect("a filter");
            let found: Vec<&Device> = devices.iter().filter(|device| filter.matches(device)).collect();
            assert_eq!(found, [device], "{argument}");
        }
    }
}
