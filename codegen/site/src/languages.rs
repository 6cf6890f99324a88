//! The languages of names and descriptions.

use std::collections::BTreeSet;

use lexibus_codegen::ir::{Catalog, Device, Documentation, Group, Texts};

/// Returns the languages of names and descriptions in these devices and in the modules. `modules` contains the
/// languages of the module pages, which all devices share.
pub(super) fn languages(devices: &[Device], modules: &BTreeSet<&str>) -> Vec<String> {
    let mut all = Languages(modules.clone());
    for device in devices {
        all.add(&device.names, device.documentation.as_deref());
        device.messages.iter().for_each(|message| all.add(&message.names, message.documentation.as_deref()));
        all.add_groups(&device.groups);
    }
    all.0.into_iter().map(str::to_owned).collect()
}

pub(super) fn languages_of_modules(catalog: &Catalog) -> BTreeSet<&str> {
    let mut all = Languages::default();
    for module in &catalog.modules {
        all.add(&module.names, module.documentation.as_deref());
        all.add_groups(&module.groups);
    }
    for submodule in &catalog.submodules {
        all.add(&submodule.names, submodule.documentation.as_deref());
        all.add_groups(&submodule.records);
    }
    all.0
}

#[derive(Default)]
struct Languages<'c>(BTreeSet<&'c str>);

impl<'c> Languages<'c> {
    fn add(&mut self, names: &'c Texts, documentation: Option<&'c Documentation>) {
        let translations = documentation.into_iter().flat_map(|documentation| documentation.translations.iter());
        self.0.extend(names.iter().chain(translations).map(|text| text.language.as_str()));
    }

    fn add_groups(&mut self, groups: &'c [Group]) {
        for group in groups {
            self.add(&group.names, group.documentation.as_deref());
            group.items.iter().for_each(|item| self.add(&item.names, item.documentation.as_deref()));
        }
    }
}
