//! Applies profiles to the devices and modules that follow them.

use std::sync::OnceLock;

use super::complete::Completion;
use super::profile::Profile;
use super::stored;
use crate::ir::{Catalog, Device, Group, Value};
use crate::resolve::references;
use crate::source::FileId;

/// Profiles in the order in which they are applied. The first profile that states a fact takes precedence.
pub(super) const STORED: [&str; 4] = [
    include_str!("stored/cia402.txt"),
    include_str!("stored/coe.txt"),
    include_str!("stored/cia301.txt"),
    include_str!("stored/profidrive.txt"),
];

/// Number of the profile of modular devices (ETG.5001). The modules of such devices follow other profiles.
const MODULAR: u32 = 5001;

/// Returns all profiles. The profiles are parsed at the first call.
pub(crate) fn all() -> &'static [Profile] {
    static PROFILES: OnceLock<Vec<Profile>> = OnceLock::new();
    PROFILES.get_or_init(|| {
        let mut profiles: Vec<Profile> = STORED.iter().filter_map(|text| stored::read(text)).collect();
        let machines = profiles.iter_mut().flat_map(|profile| &mut profile.machines);
        machines.for_each(references::machine_of_profile);
        profiles
    })
}

/// Applies the profiles to the devices, modules and submodules of `catalog`.
pub(crate) fn apply(catalog: &mut Catalog) {
    let Catalog { files, devices, modules, submodules, types, .. } = catalog;
    // A file that is not in the catalog's list of files is an overlay.
    let is_table = |FileId(id): FileId| files.get(id as usize).is_none_or(|file| file.format.is_of_manual());
    for profile in all() {
        let mut completion = Completion::new(profile);
        let follows_on_bus = |device: &&mut Device| is_device_of(device, profile) && is_on(device, profile);
        for device in devices.iter_mut().filter(follows_on_bus) {
            completion.device(device, &is_table);
        }
        for module in modules.iter_mut().filter(|module| follows(&module.profiles, &module.groups, profile)) {
            completion.module(module);
        }
        let mut submodules = submodules.iter_mut().filter(|submodule| Some(submodule.api) == profile.api).peekable();
        if submodules.peek().is_some() {
            completion.submodules(submodules, types);
        }
    }
}

fn is_on(device: &Device, profile: &Profile) -> bool {
    let has_object = device.groups.iter().any(|group| group.index().is_some());
    let is_ethercat = device.ethercat.is_some() || device.dictionary_only;
    let is_on_canopen = profile.on_canopen && !is_ethercat;
    has_object && (is_on_canopen || (profile.on_ethercat && (is_ethercat || device.canopen.is_none())))
}

/// Returns whether a device follows the profile with this number.
pub fn is_device_of_number(device: &Device, number: u32) -> bool {
    all().iter().any(|profile| profile.number == Some(number) && is_device_of(device, profile))
}

fn is_device_of(device: &Device, profile: &Profile) -> bool {
    let declared = device.entry(0x1000, 0).and_then(|item| item.default.as_ref()).and_then(Value::as_int);
    let declared = declared.map(|number| (number & 0xFFFF) as u32).filter(|&number| number != 0 && number != 0xFFFF);
    let numbers: Vec<u32> = device.profiles.iter().copied().chain(declared).collect();
    follows(&numbers, &device.groups, profile)
}

/// Returns whether a device or module follows a profile. It follows a profile that it declares. If it declares no profile except
/// `MODULAR`, it also follows each profile whose identifying object it has. Only the object identifies a profile without a number.
/// Profiles of PROFINET submodules (with an API number) apply to no device or module.
fn follows(numbers: &[u32], groups: &[Group], profile: &Profile) -> bool {
    if profile.api.is_some() {
        return false;
    }
    let Some(number) = profile.number else { return profile.is_shown_by(groups) };
    numbers.contains(&number) || (numbers.iter().all(|&declared| declared == MODULAR) && profile.is_shown_by(groups))
}
