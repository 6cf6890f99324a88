//! Visits the references that can refer to items.

use crate::ir::{
    Binding, CompactString, Completion, Condition, Device, ElementRef, Group, Item, ItemRef, Message, MessageField,
    Quantity, Scale, Shape, Step, Storage, TypeDef, WindowSide,
};

/// A reference to an item, or a reference whose target can be an item or a message.
pub(super) enum Mention<'r> {
    Item(&'r mut ItemRef),
    Element(&'r mut ElementRef),
}

impl Mention<'_> {
    /// Returns the name of the referenced element.
    pub fn name(&self) -> &CompactString {
        match self {
            Mention::Item(reference) => &reference.name,
            Mention::Element(reference) => &reference.name,
        }
    }
}

impl<'r> From<&'r mut ItemRef> for Mention<'r> {
    fn from(reference: &'r mut ItemRef) -> Self {
        Mention::Item(reference)
    }
}

pub(super) type Visit<'v> = &'v mut dyn FnMut(Mention<'_>);

/// Visits all references in a device that can refer to items.
pub(super) fn for_each(device: &mut Device, visit: Visit<'_>) {
    of_items_and_types(device.groups.iter_mut(), &mut device.types, visit);
    for message in &mut device.messages {
        if let Completion::Polled { item, .. } = &mut message.completion {
            visit(item.into());
        }
        message.accepted_when.iter_mut().for_each(|condition| visit((&mut condition.item).into()));
        for_each_field(message, &mut |field| {
            if let MessageField::Value(value) = field {
                of_item(&mut value.item, visit);
            }
        });
    }
    for machine in &mut device.machines {
        visit((&mut machine.status_item).into());
        visit((&mut machine.control_item).into());
    }
    let steps = device.procedures.iter_mut().flat_map(|procedure| &mut procedure.steps);
    steps.filter_map(target).for_each(|item| visit(item.into()));
    for composite in &mut device.composites {
        composite.parts.iter_mut().for_each(|item| visit(item.into()));
        composite.sign.iter_mut().for_each(|(item, _)| visit(item.into()));
    }
}

/// Visits each reference that can refer to an item, first those in items and then those in types.
pub(super) fn of_items_and_types<'g>(
    groups: impl Iterator<Item = &'g mut Group>,
    types: &mut [TypeDef],
    visit: Visit<'_>,
) {
    for item in groups.flat_map(|group| &mut group.items) {
        of_item(item, visit);
    }
    of_types(types, visit);
}

fn of_item(item: &mut Item, visit: Visit<'_>) {
    if let Some(behavior) = &mut item.behavior {
        if let Storage::OnCommand(command) = &mut behavior.storage {
            visit(Mention::Element(command));
        }
        behavior.write_when.iter_mut().for_each(|condition| visit((&mut condition.item).into()));
    }
    if let Some(availability) = &mut item.availability {
        availability.replaced_by.iter_mut().for_each(|other| visit(Mention::Element(other)));
    }
    if let Some(related) = &mut item.related {
        related.all_mut().for_each(|item| visit(item.into()));
    }
    if let Some(scale) = item.quantity.as_mut().and_then(|quantity| quantity.scale.as_mut()) {
        of_scale(scale).into_iter().for_each(|item| visit(item.into()));
    }
    for side in item.bindings.iter_mut().flat_map(window_sides) {
        visit((&mut side.number).into());
        visit((&mut side.value).into());
    }
}

/// Visits the fields of a request and its reply, including repeated fields.
pub(super) fn for_each_field(message: &mut Message, visit: &mut dyn FnMut(&mut MessageField)) {
    fn of_fields(fields: &mut [MessageField], visit: &mut dyn FnMut(&mut MessageField)) {
        for field in fields {
            visit(field);
            if let MessageField::Repeat { fields, .. } = field {
                of_fields(fields, visit);
            }
        }
    }
    of_fields(&mut message.request, visit);
    of_fields(&mut message.reply, visit);
}

/// Visits the quantities of all items and of all values in messages.
pub(super) fn for_each_quantity(device: &mut Device, visit: &mut dyn FnMut(&mut Quantity)) {
    for item in device.groups.iter_mut().flat_map(|group| &mut group.items) {
        item.quantity.as_deref_mut().into_iter().for_each(&mut *visit);
    }
    for message in &mut device.messages {
        for_each_field(message, &mut |field| {
            if let MessageField::Value(value) = field {
                value.item.quantity.as_deref_mut().into_iter().for_each(&mut *visit);
            }
        });
    }
}

fn of_scale(scale: &mut Scale) -> Option<&mut ItemRef> {
    match scale {
        Scale::Exponent { exponent, .. } => Some(exponent),
        Scale::ByItem { item, .. } | Scale::TimesItem { item, .. } => Some(item),
        Scale::Linear { .. } | Scale::Reciprocal { .. } | Scale::Fraction { .. } => None,
    }
}

fn of_types(types: &mut [TypeDef], visit: Visit<'_>) {
    for_each_condition(types, &mut |condition| visit((&mut condition.item).into()));
    for definition in types {
        if let Shape::Scaled { scale, .. } = &mut definition.shape {
            of_scale(scale).into_iter().for_each(|item| visit(item.into()));
        }
    }
}

/// Visits the conditions of the bits and values of types.
pub(super) fn for_each_condition(types: &mut [TypeDef], visit: &mut dyn FnMut(&mut Condition)) {
    for definition in types {
        match &mut definition.shape {
            Shape::Enumeration { values, .. } => {
                values.iter_mut().filter_map(|value| value.when.as_deref_mut()).for_each(&mut *visit)
            }
            Shape::BitField { fields, .. } => {
                fields.iter_mut().filter_map(|field| field.when.as_deref_mut()).for_each(&mut *visit)
            }
            _ => {}
        }
    }
}

/// Returns the item that a step writes, reads or waits for.
pub(super) fn target(step: &mut Step) -> Option<&mut ItemRef> {
    match step {
        Step::Write(item, _) | Step::WriteBits(item, ..) | Step::WriteArgument(item, _) => Some(item),
        Step::Read(item) | Step::WaitFor(item, ..) => Some(item),
        Step::Delay(_) | Step::Send(_) | Step::Exchange(_) | Step::Manual(_) => None,
    }
}

/// Returns the sides of the window of an indirect binding: at most one for read access and one for write access. Other bindings
/// have no window.
pub(super) fn window_sides(binding: &mut Binding) -> impl Iterator<Item = &mut WindowSide> {
    let window = match binding {
        Binding::Indirect(window) => Some(window),
        _ => None,
    };
    window.into_iter().flat_map(|window| [&mut window.read, &mut window.write]).flatten()
}
