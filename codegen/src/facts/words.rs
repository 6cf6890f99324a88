//! Sentences about elements of the IR for all kinds of documentation.

use crate::facts::cob_id;
use crate::facts::physical::{self, depends_on_node, shown_unit, Physical};
use crate::ir::{
    Access, Availability, Behavior, Binding, Bus, Buses, CiteUnit, CompactString, Condition, Device, Direction,
    Documentation, Doubt, ElementId, Fact, FactOrigin, FactOrigins, Group, Identity, Item, ItemVariant, Limits,
    LocalText, Manual, Quantity, Reference, Rule, Scale, Severity, Shape, Step, Storage, TypeDef, Value,
};
use crate::number::{self, hex, hex16, ALLOWED_SHOWN};

/// Writes sentences in the format of an output. All texts of the source are escaped.
#[derive(Clone, Copy)]
pub struct Words<'w> {
    /// Escapes a text so that the output shows it literally, on one line.
    pub escape: fn(&str) -> String,
    /// Returns a link to an element, or `None` if the output does not contain the element. The link has the given text.
    pub link: &'w dyn Fn(ElementId, &str) -> Option<String>,
}

/// Link function for an output without links. The function returns `None` for all elements.
pub const NO_LINK: &dyn Fn(ElementId, &str) -> Option<String> = &|_, _| None;

/// Builder of sentences as plain text.
pub const PLAIN: Words<'static> = Words { escape: one_line, link: NO_LINK };

/// Returns a text as one line.
pub fn one_line(text: &str) -> String {
    text.split_whitespace().collect::<Vec<_>>().join(" ")
}

/// Returns the manual that a description was transcribed from, or an empty manual.
pub fn manual(device: &Device) -> Manual {
    device.manual.as_deref().cloned().unwrap_or_default()
}

/// Returns the name under which the manual lists an item: its name in an ASCII protocol, or the name of a register or parameter.
/// The text is empty for objects, because some manuals do not print the names of objects.
pub fn row_of(item: &Item) -> &str {
    let ascii = item.bindings.iter().find_map(|binding| match binding {
        Binding::Ascii(name) => Some(name.as_str()),
        _ => None,
    });
    let is_row = |binding: &Binding| matches!(binding, Binding::Register(_) | Binding::Parameter(_));
    ascii.or_else(|| item.bindings.iter().any(is_row).then_some(item.name.as_str())).unwrap_or_default()
}

/// Maximum number of sections in a citation.
const SECTIONS_NAMED: usize = 3;

/// Returns section, row and page of a manual: `PARAMETRI MOVIMENTO, Rvel (page 12)`. Returns only the page or the line
/// if no section is known.
fn citation(manual: &Manual, row: &str, cite: &str) -> String {
    let numbers = cite.split(',').filter_map(|part| part.split('-').next()?.trim().parse().ok());
    let mut sections: Vec<&str> = Vec::new();
    for section in numbers.filter_map(|number| manual.section(number)) {
        if !sections.contains(&section.title.as_str()) {
            sections.push(&section.title);
        }
    }
    let is_number = cite.starts_with(|letter: char| letter.is_ascii_digit());
    let number = match manual.counts {
        Some(_) if !is_number => cite.to_owned(),
        Some(unit) => {
            let plural = if cite.contains([',', '-']) { "s" } else { "" };
            format!("{}{plural} {cite}", if unit == CiteUnit::Page { "page" } else { "line" })
        }
        None => cite.to_owned(),
    };
    if sections.is_empty() {
        return number;
    }
    let more = sections.len().saturating_sub(SECTIONS_NAMED);
    let mut citation = sections[..sections.len() - more].join("; ");
    if more > 0 {
        citation += &format!("; {more} more {}", if more == 1 { "section" } else { "sections" });
    }
    if !row.is_empty() && !sections.contains(&row) {
        citation += ", ";
        citation += row;
    }
    // Line numbers refer to a text version of the manual that readers do not have.
    match is_number && manual.counts == Some(CiteUnit::Line) {
        true => citation,
        false => format!("{citation} ({number})"),
    }
}

/// Returns `text` with a full stop at its end, unless it already ends with `.`, `!`, `?` or `:`.
pub fn sentence(text: &str) -> String {
    match text.ends_with(['.', '!', '?', ':']) {
        true => text.to_owned(),
        false => format!("{text}."),
    }
}

/// Returns `text` with a capital letter at its start.
pub fn capital(text: &str) -> String {
    let mut letters = text.chars();
    letters.next().into_iter().flat_map(char::to_uppercase).chain(letters).collect()
}

/// Returns the name of a bus for use in a sentence.
pub fn bus_name(bus: Bus) -> &'static str {
    match bus {
        Bus::CanOpen => "CANopen",
        Bus::EtherCat => "EtherCAT",
        Bus::Modbus => "Modbus",
        Bus::Profinet => "PROFINET",
        Bus::Serial => "a serial line",
    }
}

/// Returns the names of buses: `CANopen and EtherCAT`.
pub fn bus_names(buses: Buses) -> String {
    enumerated(&buses.iter().map(bus_name).collect::<Vec<_>>())
}

/// Returns access rights in words.
pub fn access_name(access: Access) -> &'static str {
    match access {
        Access::ReadOnly => "read-only",
        Access::WriteOnly => "write-only",
        Access::Constant => "constant",
        Access::ReadWrite | Access::ReadWriteInput | Access::ReadWriteOutput => "read-write",
    }
}

/// Returns the origin of a fact: `CiA 402, 17.3.7`, `overlay pump.toml:12`.
pub fn origin_name(origin: &FactOrigin) -> String {
    match origin {
        FactOrigin::Stated => "the description".to_owned(),
        FactOrigin::Overlay(row) => format!("overlay {}:{}", row.file, row.line),
        FactOrigin::Standard(clause) => clause.to_string(),
        FactOrigin::Rule(Rule::UnstatedAccess) => "the rule for missing access rights".to_owned(),
        FactOrigin::Rule(Rule::ReservedEntry) => "the rule for reserved sub-indices".to_owned(),
        FactOrigin::Rule(Rule::AnnouncedPdo) => "the rule for PDOs without a description".to_owned(),
        FactOrigin::Rule(Rule::MappedObject) => "the rule for objects that occur only in PDOs".to_owned(),
        FactOrigin::Rule(Rule::MissingKey) => "the rule for missing or unknown attributes".to_owned(),
        FactOrigin::Rule(Rule::IdentityObject) => "object 0x1018".to_owned(),
        FactOrigin::Rule(Rule::ObjectContents) => "the rule for missing or wrong object types".to_owned(),
        FactOrigin::Rule(Rule::CompactObject) => "the rule for compact sub-indices".to_owned(),
        FactOrigin::PrintedName => "the name in the manual".to_owned(),
    }
}

/// Returns the noun for a fact, for use in a sentence: `access rights`.
pub fn fact_name(fact: Fact) -> &'static str {
    match fact {
        Fact::Name => "name",
        Fact::Addresses => "addresses",
        Fact::ObjectType => "object type",
        Fact::Type => "type",
        Fact::Meaning => "bits and values",
        Fact::Access => "access rights",
        Fact::Mappable => "PDO mapping",
        Fact::Default => "default",
        Fact::Limits => "range",
        Fact::Unit => "unit",
        Fact::Behavior => "storage and side effects",
        Fact::Availability => "availability",
        Fact::Variants => "differences between models",
        Fact::Description => "description",
    }
}

/// Joins names: `type, access rights and range`.
pub(crate) fn enumerated(names: &[&str]) -> String {
    match names {
        [first @ .., last] if !first.is_empty() => format!("{} and {last}", first.join(", ")),
        _ => names.concat(),
    }
}

/// Returns the special meaning of a raw value, or `None` if the value has no special meaning.
fn sentinel<'i>(item: &'i Item, value: &Value) -> Option<&'i str> {
    let quantity = item.quantity.as_deref()?;
    quantity.sentinels.iter().find(|(sentinel, _)| sentinel == value).map(|(_, meaning)| meaning.as_str())
}

/// Returns whether the values of an item refer to objects: PDO mapping and PDO assignment.
fn is_object_reference(item: &Item) -> bool {
    let is_mapping = |index| matches!(index, 0x1600..=0x17FF | 0x1A00..=0x1BFF | 0x1C10..=0x1C2F);
    item.object().is_some_and(|(index, sub)| sub > 0 && is_mapping(index))
}

impl Words<'_> {
    fn escaped(&self, text: &str) -> String {
        (self.escape)(text)
    }

    /// Returns the name of another element, with a link if possible.
    fn name<Id: Copy + Into<ElementId>>(&self, reference: &Reference<Id>) -> String {
        let link = reference.id.and_then(|id| (self.link)(id.into(), &reference.name));
        link.unwrap_or_else(|| self.escaped(&reference.name))
    }

    fn list(&self, names: &[CompactString]) -> String {
        let names: Vec<String> = names.iter().map(|name| self.escaped(name)).collect();
        enumerated(&names.iter().map(String::as_str).collect::<Vec<_>>())
    }

    /// Returns the lines of a description as sentences.
    pub fn description(&self, documentation: Option<&Documentation>) -> Vec<String> {
        let lines = documentation.into_iter().flat_map(|documentation| documentation.text.lines());
        lines.map(|line| self.escaped(line)).filter(|line| !line.is_empty()).map(|line| sentence(&line)).collect()
    }

    /// Returns the access rights in words. Assumed access rights are marked with `(assumed)`.
    pub fn access_rights(&self, item: &Item) -> String {
        let assumed = if item.is_access_assumed() { " (assumed)" } else { "" };
        format!("{}{assumed}", access_name(item.access))
    }

    /// Returns the sentence about assumed access rights. Returns `None` if the source states the access rights.
    pub fn access(&self, item: &Item) -> Option<String> {
        let assumed = if item.access.writable() { "read-write" } else { "read-only" };
        item.is_access_assumed()
            .then(|| format!("The access rights ({assumed}) are an assumption, because the manual states none."))
    }

    /// Returns sentences about the behavior of a value. They state its storage, the access rights of the slave
    /// application, and the time at which changes take effect. They also state restrictions on writing, automatic
    /// reset, SRDO mapping, and side effects.
    pub fn behavior(&self, behavior: &Behavior) -> Vec<String> {
        let mut sentences = Vec::new();
        sentences.extend(self.storage(&behavior.storage).map(|storage| sentence(&capital(&storage))));
        if let Some(access) = behavior.pdi_access {
            sentences.push(format!("Access rights of the slave application (PDI): {}.", access_name(access)));
        }
        let effective = behavior.effective.as_ref().map(|effective| sentence(&self.escaped(effective)));
        sentences.extend(effective.map(|effective| format!("Changes take effect after: {effective}")));
        let conditions = behavior.write_when.iter().map(|condition| self.holds(condition));
        sentences.extend(conditions.map(|condition| format!("The value can be written only while {condition}.")));
        if !behavior.writable_values.is_empty() {
            sentences.push(format!("Only the value {} can be written.", self.values(&behavior.writable_values)));
        }
        sentences.extend(behavior.self_clearing.then(|| "The device resets the value automatically.".to_owned()));
        sentences.extend(behavior.write_once.then(|| "The value can be written only once.".to_owned()));
        sentences.extend(behavior.srdo.map(|srdo| match srdo.inverted {
            Some((index, sub)) => {
                format!("Mappable into SRDOs. The inverted data are in {}.", number::object(index, sub))
            }
            None => "Mappable into SRDOs.".to_owned(),
        }));
        sentences.extend(behavior.side_effects.iter().map(|effect| sentence(&self.escaped(effect))));
        sentences
    }

    /// Returns the storage: `volatile`, `non-volatile: stored by the command Save`. Returns `None` if the source does not state
    /// how the device stores the value.
    pub fn storage(&self, storage: &Storage) -> Option<String> {
        match storage {
            Storage::Unknown => None,
            Storage::Volatile => Some("volatile".to_owned()),
            Storage::Immediate => Some("non-volatile".to_owned()),
            Storage::OnCommand(command) => Some(format!("non-volatile: stored by the command {}", self.name(command))),
        }
    }

    /// Returns a condition: `Mode is 1 or 2`, `Status & 0x6F is 0x21`. Values of masked bits are hexadecimal.
    pub fn holds(&self, condition: &Condition) -> String {
        let name = self.name(&condition.item);
        match condition.mask {
            None => format!("{name} is {}", self.values(&condition.values)),
            Some(mask) => {
                let mask = self.escaped(&format!("& {}", hex(mask)));
                let values: Vec<String> = condition.values.iter().map(|value| self.bits(value)).collect();
                format!("{name} {mask} is {}", values.join(" or "))
            }
        }
    }

    /// Formats a value as a hexadecimal bit pattern.
    fn bits(&self, value: &Value) -> String {
        match value.as_int().and_then(|number| u64::try_from(number).ok()) {
            Some(0) => "0".to_owned(),
            Some(number) => hex(number),
            None => self.value(value),
        }
    }

    /// Formats a value in a step of a procedure. Large values are hexadecimal, because most of them are codes, indices and
    /// mappings.
    fn step_value(&self, value: &Value) -> String {
        match value.as_int() {
            Some(0x100..) => self.bits(value),
            _ => self.value(value),
        }
    }

    fn values(&self, values: &[Value]) -> String {
        values.iter().map(|value| self.value(value)).collect::<Vec<_>>().join(" or ")
    }

    /// Returns a sentence about a step of a procedure.
    pub fn step(&self, step: &Step) -> String {
        let value = |value| self.step_value(value);
        let name = |name: &str| self.escaped(name);
        match step {
            Step::Write(item, to) => format!("Write {} to {}.", value(to), name(item)),
            Step::WriteBits(item, mask, to) => {
                format!("Write {} to the bits {} of {}.", self.bits(to), hex(*mask), name(item))
            }
            Step::WriteArgument(item, argument) => format!("Write {} to {}.", name(argument), name(item)),
            Step::Read(item) => format!("Read {}.", name(item)),
            Step::WaitFor(item, mask, to, limit) => {
                let limit = limit.map(|limit| format!(", for at most {limit} ms")).unwrap_or_default();
                let condition = match *mask {
                    u64::MAX => format!("{} is {}", name(item), value(to)),
                    mask => {
                        format!("{} {} is {}", name(item), self.escaped(&format!("& {}", hex(mask))), self.bits(to))
                    }
                };
                format!("Wait until {condition}{limit}.")
            }
            Step::Delay(milliseconds) => format!("Wait {milliseconds} ms."),
            Step::Send(message) => format!("Send {}.", name(message)),
            Step::Exchange(Direction::Receive) => "Send the outputs once.".to_owned(),
            Step::Exchange(Direction::Transmit) => "Read the inputs once.".to_owned(),
            Step::Manual(text) => sentence(&name(text)),
        }
    }

    /// Formats a value for a sentence. Long strings and byte sequences are shortened.
    pub fn value(&self, value: &Value) -> String {
        const SHOWN: usize = 60;
        let text = value.to_string();
        match text.char_indices().nth(SHOWN) {
            Some((cut, _)) => format!("{} …", self.escaped(&text[..cut])),
            None => self.escaped(&text),
        }
    }

    /// Formats a value of an item. A COB-ID is followed by its flags. A special value is shown as its meaning, followed by
    /// the raw value. If the item has a scale other than factor 1 with offset 0, the text contains the physical and the raw
    /// value. If the physical value is unknown, the text contains only the raw value. A reference to an object is
    /// hexadecimal. `raw` formats all other values.
    pub fn of_item(&self, item: &Item, value: &Value, raw: &dyn Fn(&Value) -> String) -> String {
        let cob_id = cob_id::of(item).and_then(|kind| cob_id::text(value, kind));
        if let Some(text) = cob_id {
            return self.escaped(&text);
        }
        if let Some(meaning) = sentinel(item, value) {
            return format!("{} (raw {})", self.escaped(meaning), raw(value));
        }
        match Physical::of(item.quantity.as_deref()) {
            Some(physical) => physical.value(value, raw, &|unit| self.escaped(unit)),
            None if is_object_reference(item) => self.reference(value, raw),
            None => raw(value),
        }
    }

    /// Returns whether a value of an item has a name instead of a physical value: a COB-ID, or a value with a special meaning.
    pub fn is_named(&self, item: &Item, value: &Value) -> bool {
        cob_id::of(item).and_then(|kind| cob_id::text(value, kind)).is_some() || sentinel(item, value).is_some()
    }

    /// Formats a value of a PDO assignment or PDO mapping: `0x1701`, `0x60410010`.
    fn reference(&self, value: &Value, raw: &dyn Fn(&Value) -> String) -> String {
        match value.as_int() {
            Some(number @ 0x1000..=0xFFFF_FFFF) => hex16(number),
            _ => raw(value),
        }
    }

    /// Returns the limits: `range 0 to 5`, `one of 1, 3 to 7`, `range -20.0 … 200.0 °C (raw -200 … 2000)`. Returns
    /// `None` if the item has no limits.
    pub fn limits(&self, limits: &Limits, physical: Option<&Physical<'_>>) -> Option<String> {
        if !limits.allowed.is_empty() {
            let allowed = self.allowed(limits, physical, &|value| self.value(value), ALLOWED_SHOWN);
            return Some(format!("one of {allowed}"));
        }
        let text = match (physical, &limits.low, &limits.high) {
            (_, None, None) => return None,
            (Some(_), ..) => format!("range {}", self.range(limits, physical, &|value| self.value(value))),
            (None, Some(low), Some(high)) => format!("range {} to {}", self.value(low), self.value(high)),
            (None, Some(low), None) => format!("at least {}", self.value(low)),
            (None, None, Some(high)) => format!("at most {}", self.value(high)),
        };
        // Limits that depend on the node-ID are only known at run time.
        Some(if depends_on_node(limits) { text + " (depends on the node-ID, not checked)" } else { text })
    }

    /// Returns the range: `0 … 5`, `-20.0 … 200.0 °C (raw -200 … 2000)`. The text is empty if the item has no limits. `raw`
    /// formats raw values.
    pub fn range(&self, limits: &Limits, physical: Option<&Physical<'_>>, raw: &dyn Fn(&Value) -> String) -> String {
        let (low, high) = (limits.low.as_ref(), limits.high.as_ref());
        match physical.filter(|_| low.is_some() || high.is_some()) {
            Some(physical) => physical.range((low, high), raw, &|unit| self.escaped(unit)),
            None => physical::span((low.map(raw), high.map(raw))),
        }
    }

    /// Returns the first `shown` allowed values and ranges, such as `1, 3 to 7`. Adds `…` if there are more.
    pub fn allowed(
        &self,
        limits: &Limits,
        physical: Option<&Physical<'_>>,
        raw: &dyn Fn(&Value) -> String,
        shown: usize,
    ) -> String {
        let unit = |unit: &str| self.escaped(unit);
        let one = |(first, last): &(Value, Value)| match (physical, first == last) {
            (None, true) => raw(first),
            (None, false) => format!("{} to {}", raw(first), raw(last)),
            (Some(physical), true) => physical.value(first, raw, &unit),
            (Some(physical), false) => physical.range((Some(first), Some(last)), raw, &unit),
        };
        let mut list: Vec<String> = limits.allowed.iter().take(shown).map(one).collect();
        list.extend((limits.allowed.len() > shown).then(|| "…".to_owned()));
        list.join(", ")
    }

    /// Returns sentences about the models, firmware versions, buses and options with which an element exists, and about the
    /// element that replaces it. The text is empty if the element always exists and is not replaced.
    pub fn availability(&self, availability: &Availability) -> String {
        let mut sentences = Vec::new();
        if !availability.models.is_empty() {
            sentences.push(format!("Available only on {}.", self.list(&availability.models)));
        }
        let [since, until] = [&availability.since, &availability.until]
            .map(|version| version.as_ref().map(|version| self.escaped(version)));
        sentences.extend(match (since, until) {
            (Some(since), Some(until)) => {
                Some(format!("Available since firmware {since}, removed in firmware {until}."))
            }
            (Some(since), None) => Some(format!("Available since firmware {since}.")),
            (None, Some(until)) => Some(format!("Removed in firmware {until}.")),
            (None, None) => None,
        });
        sentences.extend(availability.replaced_by.as_ref().map(|other| format!("Replaced by {}.", self.name(other))));
        if !availability.buses.is_empty() {
            let buses: Vec<&str> = availability.buses.iter().map(bus_name).collect();
            sentences.push(format!("Available only on {}.", enumerated(&buses)));
        }
        if !availability.options.is_empty() {
            let noun = if availability.options.len() > 1 { "options" } else { "option" };
            sentences.push(format!("Required {noun}: {}.", self.list(&availability.options)));
        }
        sentences.join(" ")
    }

    /// Returns an ambiguity with the assumption: `Note for …: …. Assumed: … (reason). Manual: ….` For a hazard, the
    /// text begins with `Hazard`.
    pub fn doubt(&self, manual: &Manual, doubt: &Doubt) -> String {
        let part = |text: &str| self.escaped(text.trim_end_matches('.'));
        let why = if doubt.why.is_empty() { String::new() } else { format!(" ({})", part(&doubt.why)) };
        let citation = doubt.cite.as_deref().map(|cite| format!(" {}.", self.citation(manual, "", cite)));
        let hazard = if doubt.severity == Severity::Hazard { "Hazard" } else { "Note" };
        let citation = citation.unwrap_or_default();
        let part_of = if doubt.part.is_empty() { String::new() } else { format!(" for {}", self.escaped(&doubt.part)) };
        format!("{hazard}{part_of}: {}. Assumed: {}{why}.{citation}", part(&doubt.says), part(&doubt.chosen))
    }

    /// Returns a citation: `Manual: PARAMETRI MOVIMENTO, Rvel (page 12)`, or `Manual, line 2178` if the sections of the manual are
    /// not known.
    pub fn citation(&self, manual: &Manual, row: &str, cite: &str) -> String {
        let separator = if manual.sections.is_empty() { "," } else { ":" };
        format!("Manual{separator} {}", self.escaped(&citation(manual, row, cite)))
    }

    /// Returns the origin of an element's description, its citation and its name in the manual: `Manual: PARAMETRI
    /// MOVIMENTO, Rvel (page 12): Posizione.` Without a citation, the name is given as `Name in the manual: Posizione.`
    /// Returns `None` if nothing is known.
    pub fn manual_entry(
        &self,
        manual: &Manual,
        row: &str,
        documentation: Option<&Documentation>,
        names: &[LocalText],
    ) -> Option<String> {
        let cite = documentation.and_then(|documentation| documentation.cite.as_deref());
        let from = documentation.and_then(|documentation| self.text_from(documentation));
        let is_original = |text: &&LocalText| !manual.language.is_empty() && text.language == manual.language;
        let is_new = |text: &&LocalText| {
            let is_same = |other: &str| other.to_lowercase() == text.text.to_lowercase();
            !is_same(row) && !manual.sections.iter().any(|section| is_same(&section.title))
        };
        let original = names.iter().find(is_original).filter(is_new).map(|text| self.escaped(&text.text));
        let citation = cite.map(|cite| self.citation(manual, row, cite));
        let citation = match (citation, original) {
            (None, None) => None,
            (Some(citation), None) => Some(format!("{citation}.")),
            (citation, Some(original)) => {
                let citation = citation.unwrap_or_else(|| "Name in the manual".to_owned());
                Some(format!("{citation}: {}", sentence(&original)))
            }
        };
        let sentences: Vec<String> = from.into_iter().chain(citation).collect();
        (!sentences.is_empty()).then(|| sentences.join(" "))
    }

    /// Returns the origin of the bits or values of a type, unless the description itself is the origin: `Bits from CiA 402,
    /// 10.3.1.`
    pub fn meaning_from(&self, definition: Option<&TypeDef>) -> Option<String> {
        let definition = definition?;
        let origin = definition.documentation.as_deref()?.text_from.as_deref()?;
        let what = if matches!(definition.shape, Shape::BitField { .. }) { "Bits" } else { "Values" };
        Some(format!("{what} from {}.", self.escaped(&origin_name(origin))))
    }

    /// Returns the origin of a definition, such as a code table or state machine: `Definition from overlay pump.toml:12.` Returns
    /// `None` if the description is the origin, or if the documentation has the same origin.
    pub fn defined_by(&self, origin: Option<&FactOrigin>, documentation: Option<&Documentation>) -> Option<String> {
        let cited = documentation.and_then(|documentation| documentation.text_from.as_deref());
        let origin = origin.filter(|origin| cited != Some(*origin))?;
        Some(self.origin_sentence("Definition", origin))
    }

    /// Returns the origin of an object's object type, if the description does not state it.
    pub fn object_type_origin(&self, group: &Group) -> Option<String> {
        let origin = group.origins.get(Fact::ObjectType)?;
        Some(self.origin_sentence(&capital(fact_name(Fact::ObjectType)), origin))
    }

    /// Returns a sentence about the origin of facts: `Unit from overlay pump.toml:12 instead of the description.`
    fn origin_sentence(&self, facts: &str, origin: &FactOrigin) -> String {
        let replaces = matches!(origin, FactOrigin::Overlay(row) if row.replaces);
        let instead = if replaces { " instead of the description" } else { "" };
        format!("{facts} from {}{instead}.", self.escaped(&origin_name(origin)))
    }

    /// Returns the origin of a description, unless the description file is the origin: `Description from CiA 402, 17.3.7.`
    fn text_from(&self, documentation: &Documentation) -> Option<String> {
        let origin = documentation.text_from.as_deref()?;
        let name = self.escaped(&origin_name(origin));
        Some(match origin {
            FactOrigin::PrintedName => format!("Description derived from {name}."),
            _ if documentation.text.is_empty() => format!("Definition from {name}."),
            _ => format!("Description from {name}."),
        })
    }

    /// Returns the unit, or the scale with the unit: `unit rpm`, `1 LSB = 0.01 rev/s`. Returns `None` if
    /// the quantity has neither a scale nor a unit to show.
    pub fn unit(&self, quantity: &Quantity) -> Option<String> {
        match &quantity.scale {
            None if shown_unit(quantity).is_empty() => None,
            None => Some(format!("unit {}", self.escaped(shown_unit(quantity)))),
            Some(scale) => Some(self.scale(scale, shown_unit(quantity))),
        }
    }

    /// Returns the scale with the unit of the physical value: `1 LSB = 0.01 rev/s`.
    pub fn scale(&self, scale: &Scale, unit: &str) -> String {
        let unit = if unit.is_empty() { String::new() } else { format!(" {}", self.escaped(unit)) };
        match scale {
            Scale::Linear { factor, offset } if *offset == 0.0 => format!("1 LSB = {factor}{unit}"),
            Scale::Linear { factor, offset } => {
                let sign = if *offset < 0.0 { '−' } else { '+' };
                format!("physical value = raw × {factor} {sign} {}{unit}", offset.abs())
            }
            Scale::Reciprocal { numerator } => format!("physical value = {numerator} / raw{unit}"),
            Scale::Fraction { bits, base } => {
                format!("physical value = raw / 2^{bits} × {}{unit}", self.escaped(base))
            }
            Scale::Exponent { exponent, base, fraction } => {
                let part = if *fraction == 0 { String::new() } else { format!(" / 2^{fraction}") };
                format!("physical value = raw{part} × {base}^{}{unit}", self.name(exponent))
            }
            Scale::ByItem { item, factor } => {
                let factor = if *factor == 1.0 { String::new() } else { format!(" × {factor}") };
                format!("physical value = raw{factor} / {}{unit}", self.name(item))
            }
            Scale::TimesItem { item, factor } => {
                let factor = if *factor == 1.0 { String::new() } else { format!(" × {factor}") };
                format!("physical value = raw{factor} × {}{unit}", self.name(item))
            }
        }
    }

    /// Returns sentences about special values and rounding steps of a quantity.
    pub fn notes(&self, quantity: &Quantity) -> Vec<String> {
        let sentinels = quantity.sentinels.iter();
        let mut notes: Vec<String> = sentinels
            .map(|(value, name)| format!("Special value {}: {}", self.value(value), sentence(&self.escaped(name))))
            .collect();
        if let Some(step) = &quantity.step {
            notes.push(format!("The device rounds to {}.", self.step_of(step, Physical::of(Some(quantity)))));
        }
        notes
    }

    /// Returns the origins of those identity numbers that do not come from the header of the description: `Product code from object
    /// 0x1018.`
    pub fn identity_origins(&self, identity: &Identity) -> Vec<String> {
        self.sentences(identity.origins.iter().map(|(number, origin)| (number.name(), origin)))
    }

    /// Returns the origins of those facts of an item or group that do not come from its description: `Unit from CiA 402,
    /// 17.3.7.` Assumed access rights and reserved entries are left out, and so are the bits, values and descriptions
    /// of a standard. Other methods return sentences about them.
    pub fn origins(&self, origins: &FactOrigins) -> Vec<String> {
        let is_elsewhere = |fact: Fact, origin: &FactOrigin| match origin {
            FactOrigin::Stated | FactOrigin::Rule(Rule::UnstatedAccess | Rule::ReservedEntry) => true,
            FactOrigin::Standard(_) => matches!(fact, Fact::Meaning | Fact::Description),
            FactOrigin::Overlay(_) | FactOrigin::Rule(_) | FactOrigin::PrintedName => false,
        };
        let all = Fact::ALL.into_iter().filter_map(|fact| Some((fact, origins.get(fact)?)));
        let shown = all.filter(|(fact, origin)| !is_elsewhere(*fact, origin));
        self.sentences(shown.map(|(fact, origin)| (fact_name(fact), origin)))
    }

    /// Returns a sentence for each origin, with the names of the facts that come from this origin.
    fn sentences<'f>(&self, facts: impl Iterator<Item = (&'static str, &'f FactOrigin)>) -> Vec<String> {
        let mut groups: Vec<(&FactOrigin, Vec<&str>)> = Vec::new();
        for (fact, origin) in facts {
            match groups.iter_mut().find(|(known, _)| *known == origin) {
                Some((_, facts)) => facts.push(fact),
                None => groups.push((origin, vec![fact])),
            }
        }
        let sentence =
            |(origin, facts): (&FactOrigin, Vec<&str>)| self.origin_sentence(&capital(&enumerated(&facts)), origin);
        groups.into_iter().map(sentence).collect()
    }

    /// Returns a rounding step: `steps of 0.5 K (raw 5)`.
    fn step_of(&self, step: &Value, physical: Option<Physical<'_>>) -> String {
        let raw = |value: &Value| self.value(value);
        let step = physical.map_or_else(|| raw(step), |physical| physical.step(step, &raw, &|unit| self.escaped(unit)));
        format!("steps of {step}")
    }

    /// Returns sentences about the facts of an item that differ on some models or buses.
    pub fn variants(&self, item: &Item, manual: &Manual) -> Vec<String> {
        let is_by_model = item.variants.iter().any(|variant| !variant.models.is_empty());
        let others =
            is_by_model.then(|| "Models that are not listed below have the item's default value and range.".to_owned());
        let of_item = item.documentation.as_deref().and_then(|documentation| documentation.cite.as_ref());
        let sentences = |variant: &ItemVariant| {
            let documentation = variant.documentation.as_deref().filter(|text| text.cite.as_ref() != of_item);
            let citation = self.manual_entry(manual, "", documentation, &[]);
            std::iter::once(self.variant(variant, item)).chain(citation).collect::<Vec<_>>().join(" ")
        };
        others.into_iter().chain(item.variants.iter().map(sentences)).collect()
    }

    /// Returns the sentences about one variant: the facts of an item that differ on some models or buses, and a description.
    fn variant(&self, variant: &ItemVariant, item: &Item) -> String {
        let unit = item.quantity.as_ref().map_or("", |quantity| quantity.unit.as_str());
        let scaled = variant.scale.as_ref().map(|scale| Physical::scaled(scale, unit));
        let physical = || scaled.unwrap_or_else(|| Physical::of(item.quantity.as_deref()));
        let raw = |value: &Value| self.value(value);
        let shown = |value: &Value| match physical() {
            Some(physical) => physical.value(value, &raw, &|unit| self.escaped(unit)),
            None => raw(value),
        };
        let applies_to = match (variant.models.is_empty(), variant.buses.is_empty()) {
            (false, true) => format!("On {}", self.list(&variant.models)),
            (false, false) => format!("On {} via {}", self.list(&variant.models), bus_names(variant.buses)),
            (true, _) => format!("On {}", bus_names(variant.buses)),
        };
        let mut facts = Vec::new();
        facts.extend(variant.ty.map(|ty| ty.to_string()));
        facts.extend(variant.access.map(|access| access_name(access).to_owned()));
        facts.extend(variant.default.as_ref().map(|value| format!("default {}", shown(value))));
        facts.extend(self.limits(&variant.limits, physical().as_ref()));
        facts.extend(variant.step.as_ref().map(|step| format!("rounded to {}", self.step_of(step, physical()))));
        facts.extend(variant.scale.as_ref().map(|scale| self.scale(scale, unit)));
        let mut sentences = vec![format!("{applies_to}: {}.", facts.join(", "))];
        sentences.extend(self.description(variant.documentation.as_deref()));
        sentences.join(" ")
    }
}
