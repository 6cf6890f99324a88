//! Compares catalogs: devices, modules, submodules and their shared data.

use super::change::{Change, Judgment};
use super::comparison::{
    each, fact, fact_as, list, or_default, part, rules, text, Comparison, Elements, COMPARED, KEY, POSITION,
};
use super::pairing::pairs;
use super::show::Show;
use super::texts::extensions;
use super::{codes, devices, modules, profinet, types};
use lexibus_codegen::facts::device::title;
use lexibus_codegen::ir::{Catalog, Device, Family, Graphic, LocalText, Module, ProfileHeader, Submodule, UnusedText};

/// Compares two versions of a device description.
///
/// The result begins with changes that break Rust code or the communication. Changes that break the behavior follow,
/// then compatible changes, then changes without an effect. In each of these groups, the changes have the order of the
/// old description, and added elements follow at the end of their list.
pub fn compare(old: &Catalog, new: &Catalog) -> Vec<Change> {
    let mut comparison = Comparison::new(old, new);
    all_devices(&old.devices, &new.devices, &mut comparison);
    compare_modules(&old.modules, &new.modules, &mut comparison);
    compare_submodules(&old.submodules, &new.submodules, &mut comparison);
    shared(old, new, &mut comparison);
    types::compare_unused(&mut comparison);
    let mut changes = comparison.changes;
    changes.sort_by_key(|change| change.judgment.class());
    changes
}

/// Compares two revisions of a device, each with its catalog. The changes have the same order as those of [`compare`].
pub fn compare_devices(old_catalog: &Catalog, old: &Device, new_catalog: &Catalog, new: &Device) -> Vec<Change> {
    let mut comparison = Comparison::new(old_catalog, new_catalog);
    comparison.in_types(&old.types, &new.types, |comparison| devices::compare(old, new, comparison));
    let mut changes = comparison.changes;
    changes.sort_by_key(|change| change.judgment.class());
    changes
}

// Compares data that devices, modules and submodules share.
rules!(fn shared(Catalog) {
    code_tables: codes::tables(),
    unit_diagnoses: profinet::unit_diagnoses(),
    families: list(Elements::titled(|family: &Family| format!("family {}", family.id))
        .judged(Judgment::NONE, Judgment::NONE), family),
    graphics: part("the catalog", each("pictures", Judgment::NONE, |graphic: &Graphic| {
        format!("{} {}", graphic.id, graphic.file)
    })),
    vendor_names: part("the catalog", text("name of the vendor in other languages")),
    descriptions: part("the catalog", text("description in other languages")),
    vendor_urls: part("the catalog", fact("URLs of the vendor", Judgment::NONE)),
    format_version: part("the file", text("version of the format")),
    profile_header: part("the file", or_default(profile_header)),
    unused_texts: part("the catalog", each("texts without a use", Judgment::NONE, |text: &UnusedText| {
        format!("{} {}{}", text.id, text.text, text.translations.show())
    })),
    extensions: part("the catalog", extensions),
}, "the files that are compared" => [files], COMPARED => [devices, modules, submodules, types]);

rules!(fn profile_header(ProfileHeader) {
    identification: text("identification of the profile"),
    revision: text("revision of the profile"),
    name: text("name of the profile"),
    source: text("source of the profile"),
    class: text("class of the profile"),
    date: text("date of the profile"),
    additional_information: text("additional information"),
    iso_part: text("part of ISO 15745"),
    iso_edition: text("edition of ISO 15745"),
    technology: text("technology of the profile"),
});

/// Compares the devices. If both descriptions have exactly one device, these two are compared. Otherwise, devices are
/// paired if product code, name and identifier are equal, and the remaining ones by name.
fn all_devices<'a>(old: &'a [Device], new: &'a [Device], comparison: &mut Comparison<'a>) {
    let is_one = old.len() == 1 && new.len() == 1;
    let key = |device: &Device| format!("{:?} {} {}", device.identity.product_code, title(device), device.id);
    let key = |device: &Device| if is_one { String::new() } else { key(device) };
    let position = |device: &Device| if is_one { String::new() } else { title(device).to_owned() };
    for (old, new) in pairs(old, new, key, position) {
        let owner = old.or(new).filter(|_| !is_one).map(title).unwrap_or_default().to_owned();
        owned(owner, "device", (old, new), comparison, |old, new, comparison| {
            comparison.in_types(&old.types, &new.types, |comparison| devices::compare(old, new, comparison));
        });
    }
}

fn compare_modules<'a>(old: &'a [Module], new: &'a [Module], comparison: &mut Comparison<'a>) {
    for (old, new) in pairs(old, new, modules::key, |_| String::new()) {
        let owner = old.or(new).map(|module| format!("module {}", module.name)).unwrap_or_default();
        owned(owner, "module", (old, new), comparison, |old, new, comparison| {
            comparison.in_types(&old.types, &new.types, |comparison| modules::compare(old, new, comparison));
        });
    }
}

fn compare_submodules<'a>(old: &'a [Submodule], new: &'a [Submodule], comparison: &mut Comparison<'a>) {
    for (old, new) in pairs(old, new, profinet::submodule_key, |_| String::new()) {
        let owner = old.or(new).map(|submodule| format!("submodule {}", submodule.name)).unwrap_or_default();
        owned(owner, "submodule", (old, new), comparison, profinet::submodule);
    }
}

/// Compares a pair of devices, modules or submodules, or reports that the element was added or removed. Each change
/// contains `owner`, the name of the element.
fn owned<'a, T>(
    owner: String,
    kind: &str,
    pair: (Option<&'a T>, Option<&'a T>),
    comparison: &mut Comparison<'a>,
    compare: impl Fn(&'a T, &'a T, &mut Comparison<'a>),
) {
    comparison.owner = owner;
    match pair {
        (Some(old), Some(new)) => compare(old, new, comparison),
        (Some(_), None) => comparison.within(kind, |comparison| comparison.removed(Judgment::API_AND_WIRE)),
        _ => comparison.within(kind, |comparison| comparison.added(Judgment::ADDITION)),
    }
    comparison.owner.clear();
}

rules!(fn family(Family) {
    name: text("name"),
    names,
    descriptions: fact_as("description", Judgment::NONE, |list: &Vec<LocalText>| list.show()),
}, KEY => [id], POSITION => [origin]);
