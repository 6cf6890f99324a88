//! Facts about device access points of PROFINET: slots, cycle times, redundancy and lengths of data.

use crate::ir::{
    Catalog, CompactString, Device, Numbers, ProfinetSettings, SlotNumbers, Submodule, SubmoduleId, SubmoduleKind,
    SubmoduleUse,
};
use crate::number::{hex16, ranges};

/// Names and values of facts.
pub type NamedFacts = Vec<(&'static str, String)>;

/// Number of units of 31.25 µs in one millisecond.
const UNITS_PER_MS: f64 = 32.0;

/// Returns the facts about a device access point. The list is empty for other devices.
pub fn access_point(catalog: &Catalog, device: &Device) -> NamedFacts {
    let Some(settings) = device.profinet.as_deref() else { return NamedFacts::new() };
    let interface = interface(catalog, device);
    let mut facts = slots(settings);
    facts.extend(cycle_times(settings, interface));
    facts.extend(redundancy(settings, interface));
    facts.extend(lengths(settings));
    facts.retain(|(_, value)| !value.is_empty());
    facts
}

/// Converts a time in units of 31.25 µs to milliseconds: `0.25`.
fn milliseconds(units: u16) -> String {
    (f64::from(units) / UNITS_PER_MS).to_string()
}

/// Converts times in units of 31.25 µs to milliseconds: `0.25, 0.5, 1 ms`. The text is empty if there are none.
fn times(units: &Numbers) -> String {
    if units.is_empty() {
        return String::new();
    }
    format!("{} ms", ranges(&units.0, milliseconds))
}

/// Returns the first interface submodule of an access point, or `None` if it has no interface.
fn interface<'c>(catalog: &'c Catalog, device: &Device) -> Option<&'c Submodule> {
    let submodules = device.submodules.iter().filter_map(|used| catalog.submodules.get(used.submodule.0 as usize));
    submodules.into_iter().find(|submodule| submodule.kind == SubmoduleKind::Interface)
}

/// Returns an attribute that the IR stores as the source spells it. The text is empty if the attribute is missing.
fn attribute<'a>(attributes: &'a [(CompactString, CompactString)], key: &str) -> &'a str {
    attributes.iter().find(|(name, _)| name == key).map_or("", |(_, value)| value.as_str())
}

/// Formats a list of tokens that the source separates by semicolons: `RT_CLASS_1, RT_CLASS_3`.
fn tokens(list: &str) -> String {
    list.split(';').map(str::trim).filter(|token| !token.is_empty()).collect::<Vec<_>>().join(", ")
}

/// Parses a list of numbers and ranges (`1 2 4..8`). Ignores parts that are not numbers.
fn numbers(list: &str) -> Numbers {
    let range = |part: &str| {
        let (first, last) = part.split_once("..").unwrap_or((part, part));
        Some((first.parse().ok()?, last.parse().ok()?))
    };
    Numbers(list.split_whitespace().filter_map(range).collect())
}

fn slots(settings: &ProfinetSettings) -> NamedFacts {
    let shown = |numbers: &Numbers| ranges(&numbers.0, |slot| slot.to_string());
    let places = [(&settings.places.fixed, ""), (&settings.places.allowed, "possible in ")];
    let places = places.into_iter().filter(|(numbers, _)| !numbers.is_empty());
    let places: Vec<String> = places.map(|(numbers, text)| format!("{text}{}", shown(numbers))).collect();
    vec![("Physical slots", shown(&settings.slots)), ("Slot of the access point", places.join("; "))]
}

fn cycle_times(settings: &ProfinetSettings, interface: Option<&Submodule>) -> NamedFacts {
    let of_interface = |key| interface.map_or("", |interface| attribute(&interface.attributes, key));
    let ratios = |numbers: &Numbers| ranges(&numbers.0, |ratio| ratio.to_string());
    let classes = match of_interface("SupportedRT_Classes") {
        "" => of_interface("SupportedRT_Class"),
        classes => classes,
    };
    let isochronous = numbers(of_interface("RT_Class3TimingProperties@SendClock"));
    let isochronous_ratios = numbers(of_interface("RT_Class3TimingProperties@ReductionRatioPow2"));
    vec![
        ("Real-time classes", tokens(classes)),
        ("Send clock", times(&settings.send_clocks)),
        ("Reduction ratios", ratios(&settings.reduction_ratios)),
        ("Send clock (RT class 3)", times(&isochronous)),
        ("Reduction ratios (RT class 3)", ratios(&isochronous_ratios)),
        (
            "Minimum device interval",
            settings.min_device_interval.map(|units| format!("{} ms", milliseconds(units))).unwrap_or_default(),
        ),
        ("Start-up modes", settings.startup_modes.join(", ")),
    ]
}

fn redundancy(settings: &ProfinetSettings, interface: Option<&Submodule>) -> NamedFacts {
    let of_ring = |interface: &Submodule| {
        let attributes = &interface.attributes;
        let is_supported = attributes.iter().any(|(key, _)| key.starts_with("MediaRedundancy@"));
        let role = match attribute(attributes, "MediaRedundancy@SupportedRole") {
            "" => "Client",
            role => role,
        };
        let with_duplication = attribute(attributes, "MediaRedundancy@MRPD_Supported") == "true";
        let duplication = if with_duplication { "; MRPD" } else { "" };
        is_supported.then(|| format!("{}{duplication}", tokens(role)))
    };
    let of_system = |key| attribute(&settings.attributes, key);
    let types = match of_system("SystemRedundancy@DeviceTypes") {
        "" => of_system("SystemRedundancy@DeviceType"),
        types => types,
    };
    let sets = of_system("SystemRedundancy@NumberOfAR_Sets");
    let sets = if types.is_empty() || sets.is_empty() { String::new() } else { format!("; AR sets: {sets}") };
    vec![
        ("Media redundancy (MRP)", interface.and_then(of_ring).unwrap_or_default()),
        ("System redundancy", format!("{}{sets}", tokens(types))),
        ("Application relations", if settings.relations == 0 { String::new() } else { settings.relations.to_string() }),
    ]
}

fn lengths(settings: &ProfinetSettings) -> NamedFacts {
    let bytes = |length: Option<u16>| length.map(|length| format!("up to {length} bytes")).unwrap_or_default();
    let lengths = settings.max_lengths;
    vec![
        ("Input data with status", bytes(lengths.input)),
        ("Output data with status", bytes(lengths.output)),
        ("Input and output data", bytes(lengths.data)),
        ("Record data", format!("up to {} bytes", settings.max_record_size)),
    ]
}

/// First subslot of interfaces and ports.
const FIRST_INTERFACE: u16 = 0x8000;

/// Formats the number of a slot.
pub fn slot(slot: u16) -> String {
    slot.to_string()
}

/// Formats the number of a subslot. The subslots of interfaces and ports are hexadecimal: `0x8000`.
pub fn subslot(subslot: u16) -> String {
    if subslot < FIRST_INTERFACE {
        subslot.to_string()
    } else {
        hex16(subslot)
    }
}

/// Text in place of the address of a submodule's records, if the description does not contain the submodule.
pub const ANY_SUBMODULE: &str = "API, slot and subslot of the submodule";

/// Returns the address of the records of a submodule: API, slot and subslot. If only the configuration determines the
/// slot or the subslot, the text states what to insert and lists the possible numbers.
pub fn address_of_records(catalog: &Catalog, submodule: SubmoduleId) -> String {
    let (mut slots, mut subslots) = (Places::default(), Places::default());
    let is_used = |used: &&SubmoduleUse| used.submodule == submodule;
    for (device, settings) in catalog.devices.iter().filter_map(|device| Some((device, device.profinet.as_deref()?))) {
        for used in device.submodules.iter().filter(is_used) {
            slots.add(&settings.places, &Numbers::default());
            subslots.add(&used.places, &Numbers::default());
        }
        for of_module in &device.modules {
            let Some(module) = catalog.modules.get(of_module.module.0 as usize) else { continue };
            for used in module.submodules.iter().filter(is_used) {
                slots.add(&of_module.places, &settings.slots);
                subslots.add(&used.places, &module.subslots);
            }
        }
    }
    let api = catalog.submodules.get(submodule.0 as usize).map_or(0, |submodule| submodule.api);
    let api = if api == 0 { "0".to_owned() } else { hex16(api) };
    format!("API {api}, slot {}, subslot {}", slots.text("the module", slot), subslots.text("the submodule", subslot))
}

/// Slots or subslots that can contain an element.
#[derive(Default)]
struct Places(Vec<(u16, u16)>);

impl Places {
    /// Adds the slots or subslots that a use lists. If the use lists none, adds the numbers in `all`.
    fn add(&mut self, places: &SlotNumbers, all: &Numbers) {
        let lists = [&places.fixed, &places.used, &places.allowed];
        let before = self.0.len();
        self.0.extend(lists.iter().flat_map(|list| &list.0));
        if self.0.len() == before {
            self.0.extend(&all.0);
        }
    }

    /// Returns the number if only one slot or subslot is possible. Otherwise, returns a text that lists the possible
    /// numbers, such as `of the module (1 to 4)`, or `of the module` if no numbers are known.
    fn text(mut self, element: &str, number: fn(u16) -> String) -> String {
        self.0.sort_unstable();
        self.0.dedup();
        match self.0.as_slice() {
            [] => format!("of {element}"),
            [(first, last)] if first == last => number(*first),
            places => format!("of {element} ({})", ranges(places, number)),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn times_are_in_milliseconds() {
        assert_eq!(times(&numbers("1 8 16..32 x 128")), "0.03125, 0.25, 0.5 to 1, 4 ms");
        assert_eq!(times(&numbers("")), "");
        assert_eq!(tokens("RT_CLASS_1; RT_CLASS_3;"), "RT_CLASS_1, RT_CLASS_3");
    }
}
