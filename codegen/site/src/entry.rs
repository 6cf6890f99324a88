//! Rows of the item tables. Each item has a row, and facts without a column are shown below the row.

use super::anchor::Names;
use super::bits::{self, Bits, Label};
use super::diagnostics::{ShownDiagnostic, ShownDiagnostics};
use super::link::{self, Relation};
use super::requests::{self, OfRecord, Request};
use super::tools;
use super::words::{self, PLAIN};
use lexibus_codegen::backend::rust::Calls;
use lexibus_codegen::facts::words::{capital, row_of, sentence};
use lexibus_codegen::facts::{address, item, types};
use lexibus_codegen::ir::{Item, ItemId, Manual, ModbusTable, Severity, Type, TypeDef};
use lexibus_codegen::number::ALLOWED_SHOWN;

/// The row of an item in a table.
#[derive(Debug)]
pub(super) struct Row {
    pub id: ItemId,
    pub anchor: String,
    /// The displayed address, such as `0x6040:00` or `register 12`.
    pub number: String,
    /// All addresses in the notation of the search.
    pub addresses: Vec<String>,
    pub name: String,
    pub names: Vec<(String, String)>,
    pub ty: String,
    pub access: &'static str,
    pub default: String,
    pub range: String,
    /// The default value and the range without units and raw values.
    pub cells: [String; 2],
    pub unit: String,
    /// First line of the description, which the row shows after the name.
    pub description: String,
    /// The facts below the row, one sentence each. They begin with further lines of the description.
    pub facts: Vec<String>,
    /// Description of the item in other languages.
    pub translations: Vec<(String, String)>,
    /// Addresses of the item on other buses, with the names of the buses.
    pub elsewhere: Vec<String>,
    pub doubts: Vec<Doubt>,
    /// Ambiguities about the bits or values of the item's type.
    pub doubts_of_type: Vec<Doubt>,
    pub diagnostics: Vec<ShownDiagnostic>,
    /// Links to related elements.
    pub relations: Vec<Relation>,
    /// Lines of Rust code that read and write the item.
    pub rust: Vec<String>,
    /// Conversion to physical values, for the script of the page.
    pub scale: String,
    /// Raw values that can be written, for the script of the page.
    pub writable: String,
    /// Addresses for requests, for the script of the page.
    pub requests: String,
    /// Requests that read and write the item, for pages without a script.
    pub fixed_requests: Vec<Request>,
    pub bits: Option<Bits>,
    pub labels: Vec<Label>,
    /// Anchor and name of the row on this page that shows the bits or values of the same type.
    pub same_as: Option<(String, String)>,
}

/// An ambiguity in the source.
#[derive(Clone, Debug, PartialEq, Eq, Hash)]
pub(super) struct Doubt {
    /// Subject of the ambiguity, such as `HomingMethod, 33`; empty for the device, and for objects, items, PDOs and messages.
    pub subject: String,
    /// Row, bit, value or command of the subject; empty for the whole subject.
    pub part: String,
    /// Text that is shown before the ambiguity: the part if the page shows the name of the subject, otherwise the subject.
    pub prefix: String,
    pub severity: Severity,
    pub says: String,
    pub chosen: String,
    pub why: String,
    pub cite: String,
}

impl Doubt {
    /// Returns whether a wrong assumption can move a motor or damage wiring.
    pub fn is_hazard(&self) -> bool {
        self.severity == Severity::Hazard
    }
}

/// Splits ambiguities, which are sorted by severity, into hazards and others.
pub(super) fn by_hazard(doubts: &[Doubt]) -> (&[Doubt], &[Doubt]) {
    doubts.split_at(doubts.partition_point(Doubt::is_hazard))
}

impl Row {
    /// Returns the addresses for the search without repetitions. The first address is that of the row, with the wire
    /// address if known.
    pub fn lookups(&self) -> Vec<&str> {
        let (of_row, others): (Vec<&str>, Vec<&str>) =
            self.addresses.iter().map(String::as_str).partition(|address| address.starts_with(&self.number));
        let first = of_row.first().filter(|address| address.contains(" (")).copied().unwrap_or(&self.number);
        std::iter::once(first).chain(others).collect()
    }

    /// Returns the default value and the range with units and raw values, if the row shows them without units and raw
    /// values.
    pub fn values(&self) -> Option<String> {
        let parts = [("Default", &self.default, &self.cells[0]), ("Range", &self.range, &self.cells[1])];
        let parts = parts.into_iter().filter(|(_, text, cell)| text != cell && !cell.is_empty());
        let parts: Vec<String> = parts.map(|(title, text, _)| format!("{title}: {text}.")).collect();
        (!parts.is_empty()).then(|| parts.join(" "))
    }

    /// Returns whether the page shows anything below the row, such as facts, ambiguities, Rust code or requests.
    pub fn has_more(&self) -> bool {
        !self.facts.is_empty()
            || !self.translations.is_empty()
            || !self.elsewhere.is_empty()
            || !self.doubts.is_empty()
            || !self.doubts_of_type.is_empty()
            || !self.diagnostics.is_empty()
            || !self.relations.is_empty()
            || !self.rust.is_empty()
            || self.bits.is_some()
            || !self.labels.is_empty()
            || self.same_as.is_some()
            || !self.requests.is_empty()
    }
}

/// Data about the description that the rows of all items use.
#[derive(Clone, Copy)]
pub(super) struct Known<'d> {
    pub manual: &'d Manual,
    /// The Modbus tables with the requests that they accept.
    pub modbus: &'d [ModbusTable],
    /// Lines of Rust code that read and write each item.
    pub calls: &'d Calls,
    pub diagnostics: &'d ShownDiagnostics,
    /// PROFINET record that contains the items. Used only for items in a PROFINET record.
    pub record: OfRecord<'d>,
}

/// Data that the rows of a page share.
pub(super) struct Rows<'p> {
    pub types: &'p [TypeDef],
    pub names: Names,
    pub known: Known<'p>,
    /// Types whose bits or values the page already shows, with the anchor and name of the row that shows them.
    pub shown: Vec<(Type, String, String)>,
}

impl<'p> Rows<'p> {
    pub fn new(types: &'p [TypeDef], known: Known<'p>, names: Names) -> Self {
        Rows { types, names, known, shown: Vec::new() }
    }

    /// Creates the row of an item. `number` is the displayed address. If `by_name` is set and the item has a name, the
    /// anchor is the name; otherwise, it is `number`.
    pub fn row(&mut self, id: ItemId, item: &Item, number: String, by_name: bool) -> Row {
        let anchor = self.names.anchor(if by_name && !item.name.is_empty() { &item.name } else { &number });
        let (mut drawn, mut labels, mut same_as) = (None, Vec::new(), None);
        match self.shown.iter().find(|(ty, ..)| *ty == item.ty) {
            Some((_, anchor, name)) => same_as = Some((anchor.clone(), name.clone())),
            None => {
                (drawn, labels) = bits::of_type(self.types, item.ty, &anchor);
                if drawn.is_some() || !labels.is_empty() {
                    let has_name = !item::is_placeholder(&item.name);
                    let name = if has_name { item.name.to_string() } else { number.clone() };
                    self.shown.push((item.ty, anchor.clone(), name));
                }
            }
        }
        // If several rows of a page have the same type, only the first of them shows the facts of the type.
        let definition = types::definition(self.types, item.ty).filter(|_| same_as.is_none());
        let addresses = address::addresses(item, self.known.modbus);
        let lookups: Vec<String> =
            addresses.iter().map(|address| address.lookup.clone()).filter(|lookup| !lookup.is_empty()).collect();
        let addresses = addresses.into_iter().filter(|address| address.text != number);
        // Remove repeated addresses, because several windows can have the same address.
        let elsewhere = link::unique(addresses.map(|address| format!("{}: {}", address.bus, address.text)));
        let description = words::description(&item.name, item.documentation.as_deref());
        let names = words::names(&item.name, &item.names);
        Row {
            id,
            anchor,
            number,
            addresses: lookups,
            name: item.name.to_string(),
            ty: types::name(self.types, item.ty),
            access: item.access_name(),
            default: item::default(item, self.types),
            range: item::range(item, &item.limits, self.types, ALLOWED_SHOWN),
            cells: [item::default_cell(item, self.types), item::range_cell(item, self.types, ALLOWED_SHOWN)],
            unit: item::unit(item).to_owned(),
            facts: self.facts(item, &description, definition),
            description: description.first().cloned().unwrap_or_default(),
            translations: words::translations(&item.name, &names, item.documentation.as_deref()),
            names,
            elsewhere,
            doubts: doubts(&item.doubts, "", self.known.manual),
            doubts_of_type: definition
                .map(|definition| doubts(&definition.doubts, &definition.name, self.known.manual))
                .unwrap_or_default(),
            diagnostics: self.known.diagnostics.of_item(item),
            relations: Vec::new(),
            rust: self.known.calls.get(&id).cloned().unwrap_or_default(),
            scale: tools::scale(item),
            writable: tools::range(item),
            requests: tools::addresses(item, self.types, self.known.modbus, &self.known.record),
            fixed_requests: requests::requests(item, self.types, self.known.modbus, &self.known.record),
            bits: drawn,
            labels,
            same_as,
        }
    }

    /// Returns the facts that the page shows below a row. `description` contains the lines of the description; the row shows
    /// the first one.
    fn facts(&self, item: &Item, description: &[String], definition: Option<&TypeDef>) -> Vec<String> {
        let of_type = PLAIN.description(definition.and_then(|definition| definition.documentation.as_deref()));
        let of_type = of_type.into_iter().filter(|fact| !description.contains(fact));
        let mut facts: Vec<String> = description.iter().skip(1).cloned().chain(of_type).collect();
        facts.extend(PLAIN.access(item));
        facts.extend(item::mappable(item.mappable).map(|pdos| format!("Mappable into {pdos}.")));
        facts.extend(PLAIN.meaning_from(types::definition(self.types, item.ty)));
        if let Some(quantity) = &item.quantity {
            let scale = quantity.scale.as_ref().and_then(|_| PLAIN.unit(quantity));
            facts.extend(scale.map(|scale| sentence(&capital(&scale))));
            facts.extend(PLAIN.notes(quantity));
        }
        facts.extend(PLAIN.origins(&item.origins));
        if let Some(behavior) = &item.behavior {
            facts.extend(PLAIN.behavior(behavior));
        }
        facts.extend(PLAIN.variants(item, self.known.manual));
        facts.extend(item.availability.as_ref().map(|availability| PLAIN.availability(availability)));
        facts.extend(PLAIN.manual_entry(self.known.manual, row_of(item), item.documentation.as_deref(), &item.names));
        let configured = item.configured_value();
        let configured = configured.map(|value| PLAIN.of_item(item, value, &|value| PLAIN.value(value)));
        facts.extend(configured.map(|value| format!("Configured to {value}.")));
        facts.retain(|fact| !fact.is_empty());
        facts
    }
}

/// Converts the ambiguities of an element for display on a page. `name` is the name of the element that the page shows; empty for
/// the device, and for objects, items, PDOs and messages.
pub(super) fn doubts(list: &[lexibus_codegen::ir::Doubt], name: &str, manual: &Manual) -> Vec<Doubt> {
    let mut ready = doubts_with_subjects(list.iter().map(|doubt| (name, doubt)), manual);
    ready.iter_mut().for_each(|doubt| doubt.prefix.clone_from(&doubt.part));
    ready
}

/// Converts ambiguities, each with the name of its element, for display on a page that does not show the elements.
pub(super) fn doubts_with_subjects<'d>(
    list: impl Iterator<Item = (&'d str, &'d lexibus_codegen::ir::Doubt)>,
    manual: &Manual,
) -> Vec<Doubt> {
    let doubt = |(name, doubt): (&str, &lexibus_codegen::ir::Doubt)| {
        let names = [name, &doubt.part].into_iter().filter(|name| !name.is_empty());
        let subject = names.collect::<Vec<_>>().join(", ");
        Doubt {
            prefix: subject.clone(),
            subject,
            part: doubt.part.to_string(),
            says: sentence(&doubt.says),
            chosen: sentence(&doubt.chosen),
            why: if doubt.why.is_empty() { String::new() } else { sentence(&doubt.why) },
            cite: doubt.cite.as_ref().map(|cite| PLAIN.citation(manual, "", cite)).unwrap_or_default(),
            severity: doubt.severity,
        }
    };
    let mut ready: Vec<Doubt> = list.map(doubt).collect();
    ready.sort_by_key(|doubt| doubt.severity);
    ready
}
