//! Profiles: what standards say of the objects of every device that follows them.
//!
//! They are tables with `[profile]`, written like overlays (`dictionaries/README.md`), and part of the compiler. They are
//! applied last, when everything that a device and its overlays say of an object is known: a profile never changes any of
//! it, and no check needs what it adds.

use std::sync::OnceLock;

use crate::diagnostics::{Diagnostic, Diagnostics};
use crate::frontend::table::overlay::{Completion, Profile};
use crate::ir::{Bus, Buses, Catalog, Device, Group, Value};
use crate::source::{FileId, Source};

/// The files, in the order in which they are applied: what one of them says, later ones leave alone.
pub const FILES: [(&str, &str); 4] = [
    ("cia402.toml", include_str!("../profiles/cia402.toml")),
    ("coe.toml", include_str!("../profiles/coe.toml")),
    ("cia301.toml", include_str!("../profiles/cia301.toml")),
    ("profidrive.toml", include_str!("../profiles/profidrive.toml")),
];

/// The number of the profile of modular devices, whose modules follow profiles of their own (ETG.5001).
const MODULAR: u32 = 5001;

/// All profiles, read once.
fn all() -> &'static [Profile] {
    static PROFILES: OnceLock<Vec<Profile>> = OnceLock::new();
    PROFILES.get_or_init(|| {
        let read = |(name, text): &(&str, &str)| Profile::read(source(name, text), &mut Diagnostics::default());
        FILES.iter().filter_map(read).collect()
    })
}

fn source(name: &str, text: &str) -> Source {
    Source::new(name, text.as_bytes().to_vec())
}

/// What is wrong with a profile, written like those of the compiler.
pub fn check(name: &str, text: &str) -> Vec<Diagnostic> {
    let mut diagnostics = Diagnostics::default();
    Profile::read(source(name, text), &mut diagnostics);
    diagnostics.list().to_vec()
}

/// Completes all devices and modules of `catalog`.
pub(crate) fn apply(catalog: &mut Catalog) {
    let Catalog { files, devices, modules, submodules, types, .. } = catalog;
    // Overlays are in no list of files.
    let is_table = |FileId(id): FileId| files.get(id as usize).is_none_or(|file| file.format.is_of_manual());
    for profile in all() {
        let mut completion = None;
        for device in devices.iter_mut().filter(|device| is_device_of(device, profile)) {
            let completion = completion.get_or_insert_with(|| Completion::new(profile));
            if is_on(device, completion.buses()) {
                completion.device(device, &is_table);
            }
        }
        for module in modules.iter_mut().filter(|module| follows(&module.profiles, &module.groups, profile)) {
            completion.get_or_insert_with(|| Completion::new(profile)).module(module);
        }
        let mut own = submodules.iter_mut().filter(|own| Some(own.api) == profile.head.api).peekable();
        if own.peek().is_some() {
            completion.get_or_insert_with(|| Completion::new(profile)).submodules(own, types);
        }
    }
}

fn is_on(device: &Device, buses: Buses) -> bool {
    let [canopen, ethercat] = [Bus::CanOpen, Bus::EtherCat].map(|bus| buses.contains(bus));
    let has_object = device.groups.iter().any(|group| group.index().is_some());
    let is_ethercat = device.ethercat.is_some() || device.dictionary_only;
    has_object && ((canopen && !is_ethercat) || (ethercat && (is_ethercat || device.canopen.is_none())))
}

fn is_device_of(device: &Device, profile: &Profile) -> bool {
    let declared = device.entry(0x1000, 0).and_then(|item| item.default.as_ref()).and_then(Value::as_int);
    let declared = declared.map(|number| (number & 0xFFFF) as u32).filter(|&number| number != 0 && number != 0xFFFF);
    let numbers: Vec<u32> = device.profiles.iter().copied().chain(declared).collect();
    follows(&numbers, &device.groups, profile)
}

/// Whether something that declares these profiles, and has these objects, follows a profile: it declares it, or has the
/// object that shows it and declares no other one.
fn follows(numbers: &[u32], groups: &[Group], profile: &Profile) -> bool {
    if profile.head.api.is_some() {
        return false;
    }
    let Some(number) = profile.head.number else { return profile.is_shown_by(groups) };
    numbers.contains(&number) || (numbers.iter().all(|&own| own == MODULAR) && profile.is_shown_by(groups))
}
