//! Reads windows: items through which the driver accesses the values of a space by register number.

use super::at::{At, TextOr};
use super::buses;
use super::format::{IndirectRule, SpaceTable, WindowTable};
use super::notation;
use super::references::ITEM;
use super::tree::Reader;
use crate::diagnostics::codes;
use crate::ir::{Binding, Buses, IndirectBinding, WindowSide};

/// Window through which the driver accesses the registers of a space.
#[derive(Clone, Debug)]
pub(super) struct Window {
    buses: Buses,
    numbers: Option<(i128, i128)>,
    add: i64,
    read: Option<WindowSide>,
    write: Option<WindowSide>,
}

/// Reads the windows of a space.
pub(super) fn read(reader: &mut Reader<'_, '_>, name: &At<String>, table: &SpaceTable) -> Vec<Window> {
    let rules = table.indirect.iter().flat_map(|rules| &rules.0);
    rules.map(|rule| window(reader, name, rule)).collect()
}

fn window(reader: &mut Reader<'_, '_>, name: &At<String>, rule: &IndirectRule) -> Window {
    reader.mention(&rule.write_address, ITEM);
    reader.mention(&rule.procedure, "procedure");
    let sides = [(&rule.read, false), (&rule.write, true)];
    let [read, write] = sides.map(|(given, is_write)| side(reader, name, rule, given.as_ref()?, is_write));
    if rule.read.is_none() && rule.write.is_none() {
        let message = "`indirect` needs the items for the number (`write_address`) and for the value (`read`, `write`)";
        reader.report(&codes::TABLE_VALUE, reader.span(name), message);
    }
    let numbers = rule.numbers.as_ref().and_then(|given| {
        let found = notation::range(&given.value).filter(|(first, last)| first <= last);
        if found.is_none() {
            let message = format!("`{}` is not a range of numbers", given.value);
            let help = "write a range such as `\"0x8000..0x8FFF\"`";
            reader.report_with_help(&codes::TABLE_VALUE, reader.span(given), message, help);
        }
        found
    });
    let buses = rule.buses.as_ref().map_or(Buses::ALL, |list| buses::read(reader, list));
    Window { buses, numbers, add: rule.add.unwrap_or(0), read, write }
}

fn side(
    reader: &mut Reader<'_, '_>,
    name: &At<String>,
    rule: &IndirectRule,
    given: &At<TextOr<WindowTable>>,
    is_write: bool,
) -> Option<WindowSide> {
    let plain = WindowTable::default();
    let (side, value) = match &given.value {
        TextOr::Text(item) => (&plain, Some(At { value: item.clone(), start: given.start, end: given.end })),
        TextOr::Table(side) => (&**side, side.value.clone()),
    };
    reader.mention(side.address.iter().chain(&value), ITEM);
    reader.mention(&side.procedure, "procedure");
    let number = side.address.as_ref().or(rule.write_address.as_ref());
    let (Some(number), Some(value)) = (number, value) else {
        let message = "a window needs an item for the number (`write_address`, or `address`), and one for the value";
        reader.report(&codes::TABLE_VALUE, reader.span(name), message);
        return None;
    };
    let order = side.first.as_ref().and_then(|word| {
        if !is_write {
            let message = "`first` applies to writing only: reading always writes the number first";
            reader.report(&codes::TABLE_VALUE, reader.span(word), message);
        }
        reader.word(word, "order of writes", &[("address", true), ("value", false)])
    });
    let procedure = side.procedure.as_ref().or(rule.procedure.as_ref());
    Some(WindowSide {
        number: reader.reference(number),
        value: value.value.as_str().into(),
        number_first: order,
        clears: side.clears.or(rule.clears),
        wait: side.wait.or(rule.wait),
        timeout: side.timeout.or(rule.timeout),
        procedure: procedure.map(|procedure| procedure.value.as_str().into()),
    })
}

/// Returns the windows through which the register number `first` of the space is accessed on `buses`.
pub(super) fn bindings<'w>(
    space: &'w str,
    windows: &'w [Window],
    first: u32,
    buses: Buses,
) -> impl Iterator<Item = Binding> + use<'w> {
    windows.iter().enumerate().filter_map(move |(at, window)| {
        let number = u32::try_from(i64::from(first).checked_add(window.add)?).ok()?;
        let is_within = |(low, high): (i128, i128)| (low..=high).contains(&number.into());
        let buses = buses.and(window.buses);
        if buses.is_empty() || !window.numbers.is_none_or(is_within) {
            return None;
        }
        Some(Binding::Indirect(Box::new(IndirectBinding {
            space: space.into(),
            window: u8::try_from(at).unwrap_or(u8::MAX),
            buses,
            number,
            read: window.read.clone(),
            write: window.write.clone(),
        })))
    })
}
