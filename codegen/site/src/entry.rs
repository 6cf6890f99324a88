//! Rows of tables: an item a row, and what there is no column for below it.

use std::collections::HashMap;

use super::anchor::Names;
use super::bits::{self, Bits, Label};
use super::findings::{Finding, Findings};
use super::words::{self, PLAIN};
use lexibus_codegen::facts::words::{capital, row_of, sentence, ALLOWED_SHOWN};
use lexibus_codegen::facts::{address, item, types};
use lexibus_codegen::ir::{Item, ItemId, Manual, ModbusTable, Severity, Subject, SubjectKind, Type, TypeDef};

/// An item, ready to be written.
#[derive(Debug)]
pub(super) struct Row {
    pub anchor: String,
    /// By what it is looked up: `0x6040:00`, `register 12`.
    pub number: String,
    /// All addresses, as a search finds them.
    pub addresses: Vec<String>,
    pub name: String,
    pub names: Vec<(String, String)>,
    pub ty: String,
    pub access: &'static str,
    pub default: String,
    pub range: String,
    pub unit: String,
    /// The first sentence of its description.
    pub description: String,
    /// Sentences.
    pub facts: Vec<String>,
    /// The description in other languages.
    pub translations: Vec<(String, String)>,
    /// Further addresses, with their bus.
    pub elsewhere: Vec<String>,
    pub doubts: Vec<Doubt>,
    /// Ambiguities of its bits or values.
    pub doubts_of_type: Vec<Doubt>,
    pub findings: Vec<Finding>,
    /// The lines of a program that read and write it.
    pub rust: Vec<String>,
    pub bits: Option<Bits>,
    pub labels: Vec<Label>,
    /// The address of the row that has the bits or values, where another one on the page has the same type.
    pub same_as: Option<(String, String)>,
}

/// A contradiction of the source.
#[derive(Debug, PartialEq, Eq, Hash)]
pub(super) struct Doubt {
    /// What it is about within the device: `HomingMethod, 33`; empty if the page shows it there.
    pub subject: String,
    pub severity: Severity,
    pub says: String,
    pub chosen: String,
    pub why: String,
    pub cite: String,
}

impl Row {
    /// The addresses for the search, each once. The address of the row is as the row shows it, unless more is known.
    pub fn lookups(&self) -> Vec<&str> {
        let (own, others): (Vec<&str>, Vec<&str>) =
            self.addresses.iter().map(String::as_str).partition(|address| address.starts_with(&self.number));
        let first = own.first().filter(|address| address.contains(" (")).copied().unwrap_or(&self.number);
        std::iter::once(first).chain(others).collect()
    }

    /// Whether anything stands below the row.
    pub fn has_more(&self) -> bool {
        !self.facts.is_empty()
            || !self.translations.is_empty()
            || !self.elsewhere.is_empty()
            || !self.doubts.is_empty()
            || !self.doubts_of_type.is_empty()
            || !self.findings.is_empty()
            || !self.rust.is_empty()
            || self.bits.is_some()
            || !self.labels.is_empty()
            || self.same_as.is_some()
    }
}

/// The lines of a program that read and write items.
pub(super) type Calls = HashMap<ItemId, Vec<String>>;

/// What is known of a description beside its items.
#[derive(Clone, Copy)]
pub(super) struct Known<'d> {
    pub manual: &'d Manual,
    /// The ambiguities of the device.
    pub doubts: &'d [lexibus_codegen::ir::Doubt],
    /// The requests that its tables of Modbus take.
    pub modbus: &'d [ModbusTable],
    /// How programs reach items.
    pub calls: &'d Calls,
    pub findings: &'d Findings,
}

/// The ambiguities of a device about an element of this kind and name, ready to be written.
pub(super) fn about(all: &[lexibus_codegen::ir::Doubt], kind: SubjectKind, name: &str, manual: &Manual) -> Vec<Doubt> {
    doubts(all.iter().filter(|doubt| doubt.is_about(kind, name)), manual)
}

/// What rows of one page have in common.
pub(super) struct Rows<'p> {
    pub types: &'p [TypeDef],
    pub names: &'p mut Names,
    pub known: Known<'p>,
    /// The types whose bits or values the page has already, with the address and name of the row.
    pub shown: Vec<(Type, String, String)>,
}

impl Rows<'_> {
    /// A row; `number` is by what it is looked up, and its address, where the name isn't.
    pub fn row(&mut self, id: ItemId, item: &Item, number: String, by_name: bool) -> Row {
        let anchor = self.names.anchor(if by_name && !item.name.is_empty() { &item.name } else { &number });
        let (mut drawn, mut labels, mut same_as) = (None, Vec::new(), None);
        match self.shown.iter().find(|(ty, ..)| *ty == item.ty) {
            Some((_, anchor, name)) => same_as = Some((anchor.clone(), name.clone())),
            None => {
                (drawn, labels) = bits::of_type(self.types, item.ty);
                if drawn.is_some() || !labels.is_empty() {
                    let name = if item.name.is_empty() { number.clone() } else { item.name.to_string() };
                    self.shown.push((item.ty, anchor.clone(), name));
                }
            }
        }
        // The first row with a type shows the facts about it.
        let definition = types::definition(self.types, item.ty).filter(|_| same_as.is_none());
        let addresses = address::addresses(item, self.known.modbus);
        let lookups: Vec<String> =
            addresses.iter().map(|address| address.lookup.clone()).filter(|own| !own.is_empty()).collect();
        let addresses = addresses.into_iter().filter(|address| address.text != number);
        let elsewhere = addresses.map(|address| format!("{}: {}", address.bus, address.text)).collect();
        Row {
            anchor,
            number,
            addresses: lookups,
            name: item.name.to_string(),
            names: words::names(&item.names),
            ty: types::name(self.types, item.ty),
            access: item.access_name(),
            default: item::default(item, self.types),
            range: item::range(item, &item.limits, self.types, ALLOWED_SHOWN),
            unit: item::unit(item).to_owned(),
            description: PLAIN.description(item.documentation.as_deref()).into_iter().next().unwrap_or_default(),
            facts: self.facts(item, definition),
            translations: words::translations(item.documentation.as_deref()),
            elsewhere,
            doubts: doubts(&item.doubts, self.known.manual),
            doubts_of_type: definition
                .map(|definition| about(self.known.doubts, SubjectKind::Type, &definition.name, self.known.manual))
                .unwrap_or_default(),
            findings: self.known.findings.of_item(item),
            rust: self.known.calls.get(&id).cloned().unwrap_or_default(),
            bits: drawn,
            labels,
            same_as,
        }
    }

    fn facts(&self, item: &Item, definition: Option<&TypeDef>) -> Vec<String> {
        let mut facts = PLAIN.description(item.documentation.as_deref());
        let of_type = PLAIN.description(definition.and_then(|definition| definition.documentation.as_deref()));
        facts.extend(of_type.into_iter().filter(|fact| !facts.contains(fact)).collect::<Vec<_>>());
        facts.extend(PLAIN.access(item));
        facts.extend(item::mappable(item.mappable).map(|pdos| format!("Mappable into {pdos}.")));
        facts.extend(PLAIN.meaning_from(types::definition(self.types, item.ty)));
        if let Some(quantity) = &item.quantity {
            let scale = quantity.scale.as_ref().map(|_| PLAIN.quantity(quantity));
            facts.extend(scale.map(|scale| sentence(&capital(scale.trim_start_matches([',', ' '])))));
            facts.extend(PLAIN.notes(quantity));
        }
        facts.extend(PLAIN.origins(item));
        if let Some(behaviour) = &item.behaviour {
            facts.extend(PLAIN.behaviour(behaviour));
        }
        facts.extend(PLAIN.variants(item, self.known.manual));
        facts.extend(item.availability.as_ref().map(|availability| PLAIN.availability(availability)));
        facts.extend(PLAIN.place(self.known.manual, row_of(item), item.documentation.as_deref(), &item.names));
        let configured = item.configured.as_ref().and_then(|configured| configured.value.as_ref());
        facts.extend(
            configured
                .map(|value| format!("Configured to {}.", PLAIN.of_item(item, value, &|value| PLAIN.value(value)))),
        );
        facts.retain(|fact| !fact.is_empty());
        facts
    }
}

/// `HomingMethod, 33`.
fn subject(own: &Subject) -> String {
    match own.element.as_str() {
        "" => own.name.to_string(),
        element => format!("{}, {element}", own.name),
    }
}

/// Doubts, ready to be written.
pub(super) fn doubts<'d>(
    doubts: impl IntoIterator<Item = &'d lexibus_codegen::ir::Doubt>,
    manual: &Manual,
) -> Vec<Doubt> {
    let doubt = |doubt: &lexibus_codegen::ir::Doubt| Doubt {
        subject: doubt.subject.as_deref().map(subject).unwrap_or_default(),
        says: sentence(&doubt.says),
        chosen: sentence(&doubt.chosen),
        why: if doubt.why.is_empty() { String::new() } else { sentence(&doubt.why) },
        cite: doubt.cite.as_ref().map(|cite| PLAIN.citation(manual, "", cite)).unwrap_or_default(),
        severity: doubt.severity,
    };
    let mut ready: Vec<Doubt> = doubts.into_iter().map(doubt).collect();
    ready.sort_by_key(|doubt| doubt.severity);
    ready
}
