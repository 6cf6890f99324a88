//! Constants of the machine that are not stored in the device, and the unit conversions that depend on them.

use super::context::Context;
use super::docs::{self, WORDS};
use super::options::RustOptions;
use crate::ir::{Device, GivenRef, Item, MachineUnit};
use crate::names::{self, Case, NameRequest};

/// A struct with the machine constants, and unit conversions that depend on them.
pub(super) struct GivenModel {
    pub derives: Vec<String>,
    pub numbers: Vec<NumberModel>,
    pub units: Vec<UnitModel>,
}

/// A machine constant, which becomes a field of the struct.
pub(super) struct NumberModel {
    pub name: String,
    pub docs: Vec<String>,
}

/// Conversions between a unit of the device and a unit of the machine: function names, expressions, and the symbols of
/// both units.
pub(super) struct UnitModel {
    pub to: [String; 2],
    pub back: [String; 2],
    pub symbols: [String; 2],
}

pub(super) fn name_request(name: &str) -> NameRequest<'_> {
    NameRequest { name, fallback: "number".to_owned(), suffix: "other".to_owned() }
}

/// Returns the model of the struct that contains the machine constants. Returns `None` if the device declares no
/// machine constants.
pub(super) fn model(context: &Context<'_>, device: &Device, options: &RustOptions) -> Option<GivenModel> {
    let name_requests = device.given.iter().map(|number| name_request(&number.name));
    let names = names::unique(name_requests, &["self", "super", "crate"], Case::Snake);
    let field = |number: &GivenRef| {
        let name = names.get(number.id?.0 as usize)?;
        Some(format!("self.{}", names::escaped(name)))
    };
    let numbers = device.given.iter().zip(&names).map(|(number, name)| {
        let mut sentences = vec![format!("{}{}.", docs::escape(&number.name), in_unit(&number.unit))];
        sentences.extend(docs::described(number.documentation.as_deref(), &context.manual));
        sentences.extend(number.doubts.iter().map(|doubt| WORDS.doubt(&context.manual, doubt)));
        NumberModel { name: names::escaped(name), docs: docs::paragraphs(sentences) }
    });
    let numbers: Vec<NumberModel> = numbers.collect();
    let units = units(device, &field);
    (!numbers.is_empty()).then(|| GivenModel { derives: options.derives(true), numbers, units })
}

/// Returns the conversions between units of the device and units of the machine, without repetitions, in the order of
/// the items and message fields that need them.
fn units(device: &Device, field: &dyn Fn(&GivenRef) -> Option<String>) -> Vec<UnitModel> {
    let mut found: Vec<(&str, &MachineUnit)> = Vec::new();
    let items = device.groups.iter().flat_map(|group| &group.items);
    let fields = device.messages.iter().flat_map(|message| message.values().map(|value| &value.item));
    let quantities = items.chain(fields).filter_map(|item: &Item| item.quantity.as_ref());
    for quantity in quantities {
        let Some(machine) = quantity.machine.as_deref() else { continue };
        let conversion = (quantity.unit.as_str(), machine);
        if !found.contains(&conversion) {
            found.push(conversion);
        }
    }
    let texts: Vec<[String; 2]> = found.iter().map(|(from, to)| [words(from), words(&to.unit)]).collect();
    let texts: Vec<String> =
        texts.iter().flat_map(|[from, to]| [format!("{from} to {to}"), format!("{to} to {from}")]).collect();
    let name_requests = names::numbered(texts.iter().map(String::as_str), "conversion");
    let names = names::unique(name_requests, &["self"], Case::Snake);
    let expression = |times: &[GivenRef], over: &[GivenRef]| -> Option<String> {
        let mut text = "value".to_owned();
        for (numbers, operator) in [(times, '*'), (over, '/')] {
            for number in numbers {
                text += &format!(" {operator} {}", field(number)?);
            }
        }
        Some(text)
    };
    let unit = |((from, machine), names): (&(&str, &MachineUnit), &[String])| {
        Some(UnitModel {
            to: [names.first()?.clone(), expression(&machine.times, &machine.over)?],
            back: [names.get(1)?.clone(), expression(&machine.over, &machine.times)?],
            symbols: [docs::escape(from), docs::escape(&machine.unit)],
        })
    };
    found.iter().zip(names.chunks(2)).filter_map(unit).collect()
}

/// Returns the text `, in <unit>`, which is appended to a name. The text is empty if the unit is empty.
pub(super) fn in_unit(unit: &str) -> String {
    if unit.is_empty() {
        return String::new();
    }
    format!(", in {}", docs::escape(unit))
}

/// Converts a unit symbol to words: `mm/s²` becomes `mm per s2`.
fn words(symbol: &str) -> String {
    symbol.replace('/', " per ").replace('²', "2").replace('%', "percent").replace('°', "deg")
}
