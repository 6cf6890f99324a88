//! Objects in the object dictionary of a CANopen or EtherCAT device: their structure according to CiA 301 7.4.3.

use super::context::Context;
use crate::diagnostics::{codes, Diagnostics};
use crate::ir::owner::Owner;
use crate::ir::{excluded, stated, AxisStep, Device, Fact, FactOrigin, Format, Group, Item, ObjectCode, Rule, Value};
use crate::number::{hex16, sub_entry};
use crate::text::{count_of, more};

/// Reports contradictory objects. For CANopen devices, also reports missing names and missing mandatory objects.
pub(super) fn check(context: &Context<'_>, diagnostics: &mut Diagnostics) {
    for (index, group) in described(context) {
        if context.device.canopen.is_some() {
            names(group, index, diagnostics);
        }
        object(context, group, index, diagnostics);
    }
    mandatory(context.device, diagnostics);
}

/// Reports contradictory objects of a register table, missing names and, for CANopen devices, missing mandatory objects.
/// Rows that already failed are skipped, to suppress follow-up diagnostics.
pub(super) fn rows(context: &Context<'_>, diagnostics: &mut Diagnostics) {
    let errors = diagnostics.error_spans();
    for (index, group) in described(context) {
        if !errors.any_in(group.origin.span) {
            names(group, index, diagnostics);
            object(context, group, index, diagnostics);
        }
    }
    mandatory(context.device, diagnostics);
}

/// Returns the objects that the description file describes, including the fixed objects of modules.
fn described<'a>(context: &Context<'a>) -> impl Iterator<Item = (u16, &'a Group)> {
    let fixed = context.device.accepted_modules(context.modules).flat_map(|module| &module.fixed_objects);
    let all = context.device.groups.iter().chain(fixed).filter(|group| !group.origin.is_derived());
    all.filter_map(|group| Some((group.index()?, group)))
}

/// Returns those items of an object that the source describes.
fn described_items(group: &Group) -> impl Iterator<Item = &Item> {
    group.items.iter().filter(|item| !item.origin.is_derived())
}

/// Returns the item at sub-index 0, if the source describes it.
fn sub0(group: &Group) -> Option<&Item> {
    group.sub(0).filter(|item| !item.origin.is_derived())
}

fn object(context: &Context<'_>, group: &Group, index: u16, diagnostics: &mut Diagnostics) {
    let Some(code @ (ObjectCode::Array | ObjectCode::Record)) = group.object_code() else { return };
    structure(group, index, context.format, diagnostics);
    if !has_entries_of_axes(context.device, index) {
        highest_sub(group, index, context.format, diagnostics);
    }
    sub0_access(group, index, diagnostics);
    if code == ObjectCode::Array {
        element_types(group, index, context.owner, diagnostics);
    }
}

fn sub_of(item: &Item) -> u8 {
    item.object().map_or(0, |(_, sub)| sub)
}

/// Returns the highest described sub-index of an object, except 0xFF (structure of the object).
fn highest(group: &Group) -> u8 {
    described_items(group).map(sub_of).filter(|&sub| sub != 0xFF).max().unwrap_or(0)
}

fn names(group: &Group, index: u16, diagnostics: &mut Diagnostics) {
    let mut nameless = |span, what: String| {
        diagnostics.push(codes::EMPTY_NAME.at(span, format!("{what} has no name")));
    };
    if group.name.is_empty() {
        nameless(group.name_at.or(group.origin.span), hex16(index));
    }
    if !group.object_code().is_some_and(ObjectCode::has_subs) {
        return;
    }
    let mut items = described_items(group).filter(|item| item.name.is_empty());
    let Some(first) = items.next() else { return };
    // One diagnostic covers all unnamed sub-indices of an object, because there can be hundreds of them.
    let others = more(items.count(), |others| format!(" (and {} of the object)", count_of(others, "other")));
    nameless(first.at.name.or(first.origin.span), format!("{}{others}", sub_entry(index, sub_of(first))));
}

fn structure(group: &Group, index: u16, format: Format, diagnostics: &mut Diagnostics) {
    let span = group.origin.span;
    if described_items(group).next().is_none() {
        let (lacks, help) = format.missing_subs();
        diagnostics.push(codes::NO_SUBS.at(span, format!("{} has {lacks}", hex16(index))).help(help));
    } else if sub0(group).is_none() {
        let message = format!("sub-index 0 of {} is not described", hex16(index));
        let help =
            format!("describe sub-index 0 as UNSIGNED8 with the highest sub-index {} as its default", highest(group));
        diagnostics.push(codes::NO_SUB0.at(span, message).help(help));
    }
}

/// Returns whether sub-index 0 of an object is the number of valid entries, instead of the highest sub-index.
fn is_counter(index: u16) -> bool {
    matches!(index, 0x1003 | 0x1600..=0x17FF | 0x1A00..=0x1BFF | 0x1C10..=0x1C2F)
}

/// Returns whether further axes use sub-indices of the object. In such an object, sub-index 0 counts the sub-indices of all axes.
fn has_entries_of_axes(device: &Device, index: u16) -> bool {
    let rules = device.axes.iter().flat_map(|axes| &axes.rules);
    let rule = rules.into_iter().find(|rule| (rule.indices.0..=rule.indices.1).contains(&index));
    rule.is_some_and(|rule| !matches!(rule.step, AxisStep::Index(_)))
}

fn highest_sub(group: &Group, index: u16, format: Format, diagnostics: &mut Diagnostics) {
    let Some(sub0) = sub0(group).filter(|_| !is_counter(index)) else { return };
    let Some(default) = sub0.default_integer() else { return };
    let highest = highest(group);
    if default != i128::from(highest) {
        let span = sub0.at.default.or(sub0.origin.span);
        let message = format!(
            "sub-index 0 of {} has the default value {default}, but the highest sub-index is {highest}",
            hex16(index)
        );
        let found = codes::SUB0_MISMATCH.at(span, message);
        // The fix must be within the limits of sub-index 0.
        let is_possible = excluded(&sub0.limits, &Value::Int(highest.into())).is_none();
        diagnostics.push(match format.default_forms(highest) {
            Some(help) => found.help(help),
            None if is_possible && !sub0.at.default.is_empty() => found.fix(highest.to_string()),
            None => found,
        });
    }
}

fn sub0_access(group: &Group, index: u16, diagnostics: &mut Diagnostics) {
    // CiA 306 defines the access rights of sub-index 0 if the sub-indices are described in compact form
    // (CompactSubObj).
    let is_compact = |item: &&Item| item.origins.get(Fact::Access) == Some(&FactOrigin::Rule(Rule::CompactObject));
    let Some(sub0) = sub0(group).filter(|item| !is_compact(item)) else { return };
    let entries_writable =
        described_items(group).any(|item| !matches!(sub_of(item), 0 | 0xFF) && item.access.writable());
    let message = match (sub0.access.writable(), entries_writable) {
        (true, false) if !is_counter(index) => "is writable, but no other sub-index of the object is",
        // Changing a mapping requires writing 0 to sub-index 0 first (CiA 301 7.5.2.36).
        (false, true) if is_counter(index) && index != 0x1003 => {
            "is not writable, but other sub-indices of the object are"
        }
        _ => return,
    };
    let span = sub0.at.access.or(sub0.origin.span);
    diagnostics.push(codes::SUB0_ACCESS.at(span, format!("sub-index 0 of {} {message}", hex16(index))));
}

fn element_types(group: &Group, index: u16, owner: Owner<'_>, diagnostics: &mut Diagnostics) {
    let mut elements = described_items(group).filter(|item| !matches!(sub_of(item), 0 | 0xFF));
    let Some(first) = elements.next() else { return };
    // Elements of an array may differ in the names of bits and values, because the object dictionary does not contain such names.
    let ty = |item| stated::ty(owner, item);
    if let Some(other) = elements.find(|item| owner.integer(ty(item)) != owner.integer(ty(first))) {
        let (array, one, other_type) = (hex16(index), ty(first), ty(other));
        let message = format!("an element of the array {array} is {other_type}, but the first element is {one}");
        let found = codes::ARRAY_TYPES.at(other.at.ty.or(other.origin.span), message);
        diagnostics.push(found.note_at(first.at.ty.or(first.origin.span), "the first element"));
    }
}

fn mandatory(device: &Device, diagnostics: &mut Diagnostics) {
    let has_objects = device.groups.iter().any(|group| !group.origin.is_derived());
    if !has_objects || device.canopen.is_none() {
        return;
    }
    for index in [0x1000, 0x1001, 0x1018] {
        if device.object(index).is_none() {
            let message = format!("the mandatory object {} is not described", hex16(index));
            diagnostics.push(codes::MISSING_MANDATORY_OBJECT.at(device.origin.span, message));
        }
    }
}
