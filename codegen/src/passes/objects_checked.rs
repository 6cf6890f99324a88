//! After this pass the structure of every object of a dictionary, on CANopen or EtherCAT, was held against CiA 301 7.4.3
//! and reported on.

use crate::diagnostics::{codes, Diagnostic, Diagnostics};
use crate::ir::{AxisStep, Device, Format, Group, Item, Module, ObjectCode, Shape, Type, TypeDef, TypeId, Value};
use crate::passes::values_checked::excluded;

pub(super) fn run(device: &Device, modules: &[Module], format: Option<Format>, diagnostics: &mut Diagnostics) {
    let fixed = device.own_modules(modules).flat_map(|module| &module.fixed_objects);
    for group in device.groups.iter().chain(fixed) {
        let (Some(index), Some(code)) = (group.index(), group.object_code()) else { continue };
        // What is wrong with a row brings more of it, of which there is nothing new to say.
        if format == Some(Format::Table) && diagnostics.has_error_in(group.origin.span) {
            continue;
        }
        if device.canopen.is_some() || format == Some(Format::Table) {
            names(group, index, diagnostics);
        }
        if matches!(code, ObjectCode::Array | ObjectCode::Record) {
            structure(group, index, format, diagnostics);
            if !has_entries_of_axes(device, index) {
                highest_sub(group, index, format, diagnostics);
            }
            sub0_access(group, index, diagnostics);
        }
        if code == ObjectCode::Array {
            element_types(group, index, &device.types, diagnostics);
        }
    }
    mandatory(device, diagnostics);
}

fn sub_of(item: &Item) -> u8 {
    item.object().map_or(0, |(_, sub)| sub)
}

fn names(group: &Group, index: u16, diagnostics: &mut Diagnostics) {
    let mut nameless = |span, what: String| {
        diagnostics.push(Diagnostic::new(&codes::EMPTY_NAME, span, format!("{what} has no name")));
    };
    if group.name.is_empty() {
        nameless(group.name_at.or(group.origin.span), format!("0x{index:04X}"));
    }
    if !group.object_code().is_some_and(ObjectCode::has_subs) {
        return;
    }
    let mut items = group.items.iter().filter(|item| item.name.is_empty());
    let Some(first) = items.next() else { return };
    // An array of a hundred nameless elements is one finding.
    let others = match items.count() {
        0 => String::new(),
        others => format!(" (and {others} more of the object)"),
    };
    nameless(first.at.name.or(first.origin.span), format!("0x{index:04X} sub-index {:#x}{others}", sub_of(first)));
}

fn structure(group: &Group, index: u16, format: Option<Format>, diagnostics: &mut Diagnostics) {
    let span = group.origin.span;
    if group.items.is_empty() {
        let (message, help) = match format {
            Some(Format::Eds | Format::Dcf) => (
                format!("0x{index:04X} has neither sub-indices nor CompactSubObj"),
                "give it SubNumber and the sections of its sub-indices, or CompactSubObj".to_owned(),
            ),
            _ => (
                format!("0x{index:04X} has no sub-indices"),
                "describe them, sub-index 0 included; an object that is one value is a VAR".to_owned(),
            ),
        };
        diagnostics.push(Diagnostic::new(&codes::NO_SUBS, span, message).help(help));
    } else if group.sub(0).is_none() {
        let message = format!("sub-index 0 of 0x{index:04X} isn't described");
        let highest = group.items.iter().map(sub_of).filter(|&sub| sub != 0xFF).max().unwrap_or(0);
        let help = format!("describe it: UNSIGNED8, the highest sub-index, which is {highest}");
        diagnostics.push(Diagnostic::new(&codes::NO_SUB0, span, message).help(help));
    }
}

/// Whether sub-index 0 is the number of valid entries, and not the highest sub-index.
fn is_counter(index: u16) -> bool {
    matches!(index, 0x1003 | 0x1600..=0x17FF | 0x1A00..=0x1BFF | 0x1C10..=0x1C2F)
}

/// Whether further axes have sub-indices of their own in the object, which sub-index 0 counts as well.
fn has_entries_of_axes(device: &Device, index: u16) -> bool {
    let rules = device.axes.iter().flat_map(|axes| &axes.rules);
    let rule = rules.into_iter().find(|rule| (rule.indices.0..=rule.indices.1).contains(&index));
    rule.is_some_and(|rule| !matches!(rule.step, AxisStep::Index(_)))
}

fn highest_sub(group: &Group, index: u16, format: Option<Format>, diagnostics: &mut Diagnostics) {
    let Some(sub0) = group.sub(0).filter(|_| !is_counter(index)) else { return };
    let Some(default) = sub0.default.as_ref().and_then(Value::as_int) else { return };
    let highest = group.items.iter().map(sub_of).filter(|&sub| sub != 0xFF).max().unwrap_or(0);
    if default != i128::from(highest) {
        let span = sub0.at.default.or(sub0.origin.span);
        let message = format!("sub-index 0 of 0x{index:04X} says {default}, but the highest sub-index is {highest}");
        let found = Diagnostic::new(&codes::SUB0_MISMATCH, span, message);
        // Another number must be one that sub-index 0 may have.
        let is_possible = excluded(&sub0.limits, &Value::Int(highest.into())).is_none();
        diagnostics.push(match format {
            // The form depends on the element that gives the default.
            Some(Format::Esi) => {
                found.help(format!("write `{highest:02X}` in DefaultData, or `{highest}` in DefaultValue"))
            }
            _ if is_possible && !sub0.at.default.is_empty() => found.fix(highest.to_string()),
            _ => found,
        });
    }
}

fn sub0_access(group: &Group, index: u16, diagnostics: &mut Diagnostics) {
    let Some(sub0) = group.sub(0) else { return };
    let entries_writable = group.items.iter().any(|item| !matches!(sub_of(item), 0 | 0xFF) && item.access.writable());
    let message = match (sub0.access.writable(), entries_writable) {
        (true, false) if !is_counter(index) => "can be written, but none of its entries",
        // A mapping is changed by writing 0 there first (CiA 301 7.5.2.36).
        (false, true) if is_counter(index) && index != 0x1003 => "can't be written, but its entries can",
        _ => return,
    };
    let span = sub0.at.access.or(sub0.origin.span);
    diagnostics.push(Diagnostic::new(&codes::SUB0_ACCESS, span, format!("sub-index 0 of 0x{index:04X} {message}")));
}

/// The type below an enumeration or a bit field: what the bits mean is no matter of the dictionary.
fn basic(types: &[TypeDef], ty: Type) -> Type {
    let Type::Named(TypeId(id)) = ty else { return ty };
    match types.get(id as usize).map(|def| &def.shape) {
        Some(Shape::Enumeration { base, .. } | Shape::BitField { base, .. }) => *base,
        _ => ty,
    }
}

fn element_types(group: &Group, index: u16, types: &[TypeDef], diagnostics: &mut Diagnostics) {
    let mut elements = group.items.iter().filter(|item| !matches!(sub_of(item), 0 | 0xFF));
    let Some(first) = elements.next() else { return };
    if let Some(other) = elements.find(|item| basic(types, item.ty) != basic(types, first.ty)) {
        let message = format!("an element of the array 0x{index:04X} is {}, the first is {}", other.ty, first.ty);
        diagnostics.push(
            Diagnostic::new(&codes::ARRAY_TYPES, other.at.ty.or(other.origin.span), message)
                .note_at(first.at.ty.or(first.origin.span), "the first element"),
        );
    }
}

fn mandatory(device: &Device, diagnostics: &mut Diagnostics) {
    if device.groups.is_empty() || device.canopen.is_none() {
        return;
    }
    for index in [0x1000, 0x1001, 0x1018] {
        if device.object(index).is_none() {
            let message = format!("the mandatory object 0x{index:04X} isn't described");
            diagnostics.push(Diagnostic::new(&codes::MISSING_MANDATORY_OBJECT, device.origin.span, message));
        }
    }
}
