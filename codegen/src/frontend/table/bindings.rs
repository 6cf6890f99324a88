//! Addresses of a row: its register numbers in a space, its objects, and its addresses in other protocols.

use smallvec::SmallVec;

use super::at::At;
use super::buses;
use super::format::{NumberOrText, Row};
use super::numbered::Numbered;
use super::references::ITEM;
use super::rows::{definition, Named, Rows};
use super::spaces::{self, Numbers};
use super::tree::Reader;
use super::{lints, notation, types};
use crate::diagnostics::codes;
use crate::ir::{Binding, Buses, Item, ObjectBuses, RegisterSpace, Type};
use crate::limits;
use crate::number::{hex16, written_object};
use crate::text::{brief, count_of};

/// Number of items of a row, and the distance between their register numbers.
#[derive(Clone, Copy, Debug)]
pub(super) struct Repeat {
    pub count: u32,
    pub step: u32,
}

impl Repeat {
    pub const ONCE: Repeat = Repeat { count: 1, step: 0 };
}

impl Rows {
    pub(super) fn repetition(
        &mut self,
        reader: &mut Reader<'_, '_>,
        key: &str,
        row: &Row,
        space: Option<usize>,
    ) -> Repeat {
        let Some(given) = &row.count else { return Repeat::ONCE };
        let count = match &given.value {
            NumberOrText::Number(count) => u32::try_from(*count).ok(),
            NumberOrText::Text(item) => {
                reader.mention([&At { value: item.clone(), start: given.start, end: given.end }], ITEM);
                if row.max_count.is_none() {
                    let message = "`count` names an item, but the maximum number of items is missing";
                    let found = codes::TABLE_VALUE.at(reader.span(given), message);
                    reader.diagnostics.push(found.help("write the maximum number of items as `max_count`"));
                }
                Some(row.max_count.unwrap_or(1))
            }
        };
        let Some(count) = count.filter(|&number| (1..=limits::MAX_REPEAT).contains(&number)) else {
            let message = format!("`count` must be from 1 to {}", limits::MAX_REPEAT);
            reader.report(&codes::TABLE_VALUE, reader.span(given), message);
            return Repeat::ONCE;
        };
        let span = reader.span(given);
        if !self.repeats.repeat(reader, key, row, count, span) {
            return Repeat::ONCE;
        }
        let unit = self.unit(space);
        let definition = definition(row).filter(|_| row.ty.is_none());
        let base = definition.and_then(|(kind, name)| self.definitions.base(reader, kind, &name.value));
        let bits = row.ty.as_ref().and_then(|ty| types::named(&ty.value));
        let bits = bits.and_then(|named| self.definitions.bits_of(named.ty)?.checked_mul(named.elements.unwrap_or(1)));
        let bits = bits.or(base.and_then(Type::bits));
        let of_type = || if row.reg.is_some() { bits.unwrap_or(unit).div_ceil(unit) } else { 1 };
        Repeat { count, step: row.stride.unwrap_or_else(of_type) }
    }

    /// Reports a list that has more default values than the row has items. Also reports a name without `{n}` or `{n+1}`
    /// if the row has several items because of `count`.
    pub(super) fn each_has_one(&self, reader: &mut Reader<'_, '_>, key: &At<String>, row: &Row, count: u32) {
        // An array has a default value for each of its elements.
        let is_array = row.ty.as_ref().and_then(|ty| types::named(&ty.value)).is_some_and(|ty| ty.elements.is_some());
        if let Some(given) = row.default.as_ref().filter(|given| given.value.0.len() > 1 && !is_array) {
            let defaults = given.value.0.len();
            if defaults > count as usize {
                let message =
                    format!("the list has {defaults} defaults, but the row describes {}", count_of(count, "item"));
                reader.report(&codes::TABLE_VALUE, reader.span(given), message);
            }
        }
        if row.count.is_some() && count > 1 && !key.value.contains("{n") {
            let message = format!("all {count} items of the row have the name `{}`", brief(&key.value));
            let found = codes::TABLE_VALUE.at(reader.span(key), message);
            let help = "write `{n}`, which counts from 0, or `{n+1}`, which counts from 1, in the name";
            reader.diagnostics.push(found.help(help));
        }
    }

    /// Returns the number of bits that one register number of the space addresses, or 16 if there is no space.
    fn unit(&self, space: Option<usize>) -> u32 {
        space.and_then(|at| self.spaces.get(at)).map_or(16, |space| u32::from(space.bits))
    }

    /// Returns all addresses of one item of a row.
    pub(super) fn bindings(
        &mut self,
        reader: &mut Reader<'_, '_>,
        space: Option<usize>,
        named: Named<'_>,
        row: &Row,
        repeat: Repeat,
        ty: Option<Type>,
    ) -> SmallVec<[Binding; 1]> {
        let buses = self.buses_of(reader, row);
        let shift = named.number.saturating_mul(repeat.step);
        let mut bindings = SmallVec::new();
        let bits = ty.and_then(|ty| self.definitions.bits_of(ty));
        let mut by_rule = None;
        if let Some(reg) = &row.reg {
            match self.numbers(reader, row, bits, named.number, repeat, space) {
                Some(mut numbers) => {
                    numbers.first = numbers.first.saturating_add(shift);
                    let span = reader.span(reg);
                    let found = space.and_then(|at| self.spaces.get(at));
                    by_rule = found.and_then(|space| space.object(numbers.first));
                    let unit = self.unit(space).max(1);
                    let last = numbers.first.saturating_add(bits.unwrap_or(unit).div_ceil(unit).saturating_sub(1));
                    self.numbered.push(Numbered { first: numbers.first, last, name: named.name.into() });
                    match found {
                        Some(space) => bindings.extend(space.bindings(reader, numbers, buses, span)),
                        None => {
                            let message = "the table has no `[spaces]` for this register number";
                            reader.report(&codes::UNRESOLVED_NAME, span, message);
                        }
                    }
                }
                None => return bindings,
            }
        }
        if let Some(object) = &row.obj {
            let buses = self.object_buses(reader, row, object);
            self.explicit_object(reader, object, by_rule, shift, buses, &mut bindings);
        }
        bindings.extend(self.other_addresses(reader, named, None, row, shift, bits));
        let is_register = bindings.iter().any(|binding| matches!(binding, Binding::Register(_)));
        if let Some(part) = row.part.as_ref().filter(|_| row.reg.is_some() && !is_register && named.number == 0) {
            let message = "`part` needs a Modbus register, which the row does not have";
            reader.report(&codes::TABLE_PLACE, reader.span(part), message);
        }
        bindings
    }

    /// Returns those addresses of one item of a row that do not depend on a space.
    pub(super) fn other_addresses(
        &self,
        reader: &mut Reader<'_, '_>,
        named: Named<'_>,
        sub_index: Option<u8>,
        row: &Row,
        shift: u32,
        bits: Option<u32>,
    ) -> SmallVec<[Binding; 1]> {
        let mut bindings = SmallVec::new();
        if let Some(given) = &row.esc {
            let length = row.length.as_ref().map(|length| length.value);
            let length = length.unwrap_or_else(|| bits.map_or(1, |bits| bits.div_ceil(8) as u16));
            // The memory of the slave controller is addressed in bytes.
            let shift = named.number.saturating_mul(row.stride.unwrap_or(length.into()));
            match u16::try_from(u32::from(given.value).saturating_add(shift)) {
                Ok(address) => bindings.push(Binding::EscMemory { address, length }),
                Err(_) => {
                    let message =
                        format!("the address of item {} of `{}` is above 0xFFFF", named.number + 1, brief(named.name));
                    reader.report(&codes::TABLE_PLACE, reader.span(given), message);
                }
            }
        }
        if let Some(name) = &row.ascii {
            bindings.push(Binding::Ascii(notation::filled(name, named.number, sub_index).into()));
        }
        if let Some(code) = &row.param {
            bindings.push(Binding::parameter("parameter", code.value.saturating_add(shift)));
        }
        bindings
    }

    /// Reports that a row has no address, or no address on its buses.
    pub(super) fn no_address(&self, reader: &mut Reader<'_, '_>, space: Option<usize>, named: Named<'_>, row: &Row) {
        let key = brief(&named.key.value);
        let message = match (&row.reg, &row.buses, space.and_then(|at| self.spaces.get(at))) {
            (Some(_), Some(buses), Some(space)) => {
                let buses = buses.iter().map(|bus| brief(&bus.value)).collect::<Vec<_>>().join(", ");
                format!("`{key}` has no address on {buses}: the space `{}` has no rule for these buses", space.name)
            }
            (Some(_), None, Some(space)) => {
                format!("`{key}` has no address: the space `{}` has no rule for the buses of the device", space.name)
            }
            _ => {
                let help = "add one of `reg`, `obj`, `param`, `esc` and `ascii`";
                let message = format!("`{key}` has no address");
                return reader.report_with_help(&codes::ROW_WITHOUT_ADDRESS, reader.span(named.key), message, help);
            }
        };
        reader.report(&codes::ROW_WITHOUT_ADDRESS, reader.span(named.key), message);
    }

    fn numbers(
        &mut self,
        reader: &mut Reader<'_, '_>,
        row: &Row,
        bits: Option<u32>,
        number: u32,
        repeat: Repeat,
        space: Option<usize>,
    ) -> Option<Numbers> {
        let reg = row.reg.as_ref()?;
        let (first, last) = match &reg.value {
            NumberOrText::Number(number) => match u32::try_from(*number) {
                Ok(number) => (number, None),
                Err(_) => {
                    let message = format!("`{number}` is not a register number from 0 to {}", u32::MAX);
                    reader.report(&codes::TABLE_PLACE, reader.span(reg), message);
                    return None;
                }
            },
            NumberOrText::Text(text) => match notation::registers(text) {
                Some((first, last)) => (first, Some(last)),
                None => {
                    let message = format!("`{}` is not a register number", brief(text));
                    let help = "write a number such as `63`, or a range such as `\"63-64\"`";
                    reader.report_with_help(&codes::TABLE_PLACE, reader.span(reg), message, help);
                    return None;
                }
            },
        };
        let unit = self.unit(space);
        if let (Some(last), Some(bits), 0) = (last, bits, number) {
            let (printed, needed) = ((last - first).saturating_add(1), bits.div_ceil(unit));
            // The printed range of register numbers may cover only the first item, or all items.
            let all = repeat.step.saturating_mul(repeat.count - 1).saturating_add(needed);
            if ![needed, all, repeat.step.saturating_mul(repeat.count)].contains(&printed) {
                let needed = match repeat.count {
                    0 | 1 => format!("the type needs {needed}"),
                    _ => format!("one repetition needs {needed} and all repetitions need {all}"),
                };
                let registers = count_of(printed, "register");
                let message = format!("the row has {registers} of {unit} bits, but {needed}");
                reader.diagnostics.push(codes::REGISTER_SPAN.at(reader.span(reg), message).label("the type is used"));
            }
        }
        // If the type has no fixed length, the value of a single item fills the range of register numbers.
        let printed = last.map(|last| (last - first).saturating_add(1).saturating_mul(unit));
        let bits = bits.or(printed.filter(|_| repeat.count == 1));
        let bit_offset = row.part.as_ref().and_then(|part| self.part(reader, part, bits, unit));
        Some(Numbers {
            first,
            bits,
            low_word_first: row.order.as_ref().and_then(|order| spaces::word_order(reader, order)),
            bytes_swapped: row.swap,
            bit_offset,
        })
    }

    /// Returns the first bit of the key `part`, which names the bits of a register that contain the value. Returns `None`
    /// and reports the key if it is invalid.
    fn part(&self, reader: &mut Reader<'_, '_>, part: &At<NumberOrText>, bits: Option<u32>, unit: u32) -> Option<u8> {
        let text = part.value.to_string();
        let Some((offset, count)) = notation::bits(&text) else {
            let message = format!("`{}` is neither a bit number nor a range of bits", brief(&text));
            let help = "write a bit such as `7`, or a range such as `\"7-0\"`";
            reader.report_with_help(&codes::TABLE_PLACE, reader.span(part), message, help);
            return None;
        };
        if bits.is_some_and(|bits| bits != u32::from(count)) {
            let message = format!("the part has {}, but the type has {}", count_of(count, "bit"), bits.unwrap_or(0));
            reader.report(&codes::REGISTER_SPAN, reader.span(part), message);
        }
        if u32::from(offset) + u32::from(count) > unit {
            let message = format!("the part ends at bit {}, but a register has {unit} bits", offset + count - 1);
            reader.report(&codes::TABLE_PLACE, reader.span(part), message);
            return None;
        }
        Some(offset)
    }

    fn explicit_object(
        &self,
        reader: &mut Reader<'_, '_>,
        object: &At<NumberOrText>,
        by_rule: Option<(u16, u8)>,
        shift: u32,
        buses: ObjectBuses,
        bindings: &mut SmallVec<[Binding; 1]>,
    ) {
        lints::index(reader, object);
        let text = match &object.value {
            NumberOrText::Number(number) => hex16(*number),
            NumberOrText::Text(text) => text.clone(),
        };
        let found = notation::objects(&text).filter(|found| found.indices.0 == found.indices.1);
        let index = found.and_then(|found| u16::try_from(u32::from(found.indices.0).checked_add(shift)?).ok());
        let (Some(found), Some(index)) = (found, index) else {
            let message = format!("`{}` is not an object address", brief(&text));
            let help = "write an index such as `0x6040`, or an index with a sub-index such as `\"0x2000:1\"`";
            reader.report_with_help(&codes::TABLE_PLACE, reader.span(object), message, help);
            return;
        };
        let sub_index = found.subs.map(|(first, _)| first);
        if let Some((ruled, ruled_sub)) = by_rule {
            if ruled != index || sub_index.is_some_and(|sub| sub != ruled_sub) {
                let ruled = written_object(ruled, ruled_sub);
                let message = format!("the row has object {text}, but the rule in `[spaces]` gives {ruled}");
                let found = codes::REGISTER_FORMULA.at(reader.span(object), message);
                reader.diagnostics.push(found.label("the object of the row is used").help(lints::FORMULA));
            }
            bindings.retain(|binding| !matches!(binding, Binding::Object { .. }));
        }
        let sub_index = sub_index.or(by_rule.map(|(_, sub)| sub)).unwrap_or(0);
        bindings.insert(0, Binding::Object { buses, index, sub_index });
    }

    /// Returns the buses on which a row exists.
    pub(super) fn buses_of(&self, reader: &mut Reader<'_, '_>, row: &Row) -> Buses {
        let Some(list) = &row.buses else { return self.buses };
        let mut found = Buses::NONE;
        for name in list {
            let bus = buses::read(reader, std::slice::from_ref(name));
            if !bus.is_empty() && bus.and(self.buses).is_empty() {
                let message = format!("`buses` of the device does not contain {}", brief(&name.value));
                let wrong = codes::TABLE_VALUE.at(reader.span(name), message);
                reader.diagnostics.push(wrong.help("add the bus to `buses` of `[device]`, or delete it from the row"));
            }
            found = found.or(bus);
        }
        found.and(self.buses)
    }

    /// Returns the buses on which the object of a row exists. Reports a row that exists on neither CANopen nor EtherCAT, and
    /// returns CANopen for this row.
    pub(super) fn object_buses(&self, reader: &mut Reader<'_, '_>, row: &Row, at: &At<impl Clone>) -> ObjectBuses {
        let objects = self.buses_of(reader, row).with_objects();
        if Buses::from(objects).is_empty() {
            let message = "the row has an object, but is on neither CANopen nor EtherCAT";
            let found = codes::TABLE_PLACE.at(reader.span(at), message);
            let help = "add CANopen or EtherCAT to `buses` of the row, of the defaults or of the device";
            reader.diagnostics.push(found.help(help));
        }
        ObjectBuses { canopen: objects.canopen || !objects.coe, ..objects }
    }
}

/// Reports a writable item whose only addresses are Modbus inputs, which are read-only.
pub(super) fn read_only_table(reader: &mut Reader<'_, '_>, item: &Item) {
    let is_input = |binding: &Binding| match binding {
        Binding::Register(register) => matches!(register.space, RegisterSpace::Input | RegisterSpace::DiscreteInput),
        _ => false,
    };
    if item.access.writable() && item.bindings.iter().all(is_input) {
        let message = format!("`{}` is {}, but Modbus inputs are read-only", brief(&item.name), item.access.name());
        reader.report(&codes::ACCESS_CONFLICT, item.at.access.or(item.at.name), message);
    }
}

/// Reports `order` and `swap` in a row that has register numbers, but no Modbus registers.
pub(super) fn words_without_register(reader: &mut Reader<'_, '_>, row: &Row, items: &[Item]) {
    let Some(item) = items.first() else { return };
    let has_register = item.bindings.iter().any(|binding| matches!(binding, Binding::Register(_)));
    if row.reg.is_some() && !has_register && (row.order.is_some() || row.swap.is_some()) {
        let message =
            format!("`order` and `swap` apply to Modbus registers only, and `{}` has none", brief(&item.name));
        reader.report(&codes::TABLE_VALUE, item.at.name, message);
    }
}
