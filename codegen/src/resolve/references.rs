//! Resolves references: sets the id of each reference to the position of the element with its name.

use super::mentions::{for_each, for_each_field, for_each_quantity, of_items_and_types, window_sides, Mention};
use crate::collections::HashMap;
use crate::ir::owner::{Index, Owner};
use crate::ir::{
    Binding, Catalog, CommandId, CompactString, Device, DeviceStateId, ElementId, Entries, FamilyId, GivenId, Group,
    ImageId, ItemId, MessageField, MessageId, Module, Outcome, Pdo, PdoEntryKind, ProcedureId, Reference, Shape,
    SpaceId, StateId, StateMachine, Step, Transition, TypeDef, TypeId, VariantId,
};

/// Resolves the references of a device. Returns whether the device contains a reference whose target can be an item.
pub(super) fn device(device: &mut Device) -> bool {
    mapped_items(&mut device.process_data.pdos, &device.groups, 0);
    messages(device);
    procedures(device);
    state_types(device);
    machines(device);
    images(device);
    parameter_spaces(device);
    models_and_given_numbers(device);
    let mut names = HashMap::default();
    for_each(device, &mut |mention| collect(&mut names, &mention));
    if names.is_empty() {
        return false;
    }
    find(&mut names, &[&device.groups], &device.types);
    let messages = Positions::new(device.messages.iter().map(|message| &message.name));
    for_each(device, &mut |mention| resolve(mention, &names, &messages));
    true
}

/// Resolves the references of EtherCAT devices to device families. A reference to a family that has no name gets no id.
pub(super) fn families(catalog: &mut Catalog) {
    let named = (0..).zip(&catalog.families).filter(|(_, family)| !family.name.is_empty());
    let positions = Positions::of(named.map(|(position, family)| (position, &family.id)));
    for settings in catalog.devices.iter_mut().filter_map(|device| device.ethercat.as_mut()) {
        positions.resolve(&mut settings.group, FamilyId);
    }
}

/// Resolves the references of a module. In the ids of a module, the groups are numbered consecutively: first the fixed objects,
/// then the other groups.
pub(super) fn module(module: &mut Module) {
    let mut names = HashMap::default();
    let Module { fixed_objects, groups, types, process_data, .. } = module;
    mapped_items(&mut process_data.pdos, groups, fixed_objects.len() as u32);
    of_items_and_types(fixed_objects.iter_mut().chain(&mut *groups), types, &mut |mention| {
        collect(&mut names, &mention);
    });
    if !names.is_empty() {
        find(&mut names, &[fixed_objects, groups], types);
        let messages = Positions::new([].into_iter());
        let groups = fixed_objects.iter_mut().chain(groups);
        of_items_and_types(groups, types, &mut |mention| resolve(mention, &names, &messages));
    }
}

/// The position of the first element with each name.
struct Positions(HashMap<CompactString, u32>);

impl Positions {
    fn new<'n>(names: impl Iterator<Item = &'n CompactString>) -> Self {
        Positions::of((0..).zip(names))
    }

    fn of<'n>(named: impl Iterator<Item = (u32, &'n CompactString)>) -> Self {
        let mut positions = HashMap::default();
        for (position, name) in named {
            positions.entry(name.clone()).or_insert(position);
        }
        Positions(positions)
    }

    fn resolve<Id>(&self, reference: &mut Reference<Id>, id: fn(u32) -> Id) {
        reference.id = self.find(&reference.name).map(id);
    }

    fn find(&self, name: &CompactString) -> Option<u32> {
        self.0.get(name).copied()
    }
}

/// Sets the id of a reference.
fn resolve(mention: Mention<'_>, items: &Found, messages: &Positions) {
    let item = items.get(mention.name()).copied().flatten();
    match mention {
        Mention::Item(reference) => reference.id = item,
        Mention::Element(reference) => {
            let message = || messages.find(&reference.name).map(|at| ElementId::Message(MessageId(at)));
            reference.id = item.map(ElementId::Item).or_else(message);
        }
    }
}

fn messages(device: &mut Device) {
    if device.messages.is_empty() {
        return;
    }
    let positions = Positions::new(device.messages.iter().map(|message| &message.name));
    let availabilities = device.messages.iter_mut().filter_map(|message| message.availability.as_mut());
    for other in availabilities.filter_map(|availability| availability.replaced_by.as_mut()) {
        positions.resolve(other, |at| ElementId::Message(MessageId(at)));
    }
    let of_messages = device.messages.iter_mut().flat_map(|message| [&mut message.after, &mut message.error]);
    let of_spaces =
        device.parameter_spaces.iter_mut().flat_map(|space| [&mut space.read, &mut space.write, &mut space.store]);
    of_messages.chain(of_spaces).flatten().for_each(|reference| positions.resolve(reference, MessageId));
    let rows = device.machines.iter_mut().flat_map(|machine| &mut machine.outcomes);
    rows.flat_map(|row| &mut row.commands).for_each(|command| positions.resolve(command, MessageId));
    for step in device.procedures.iter_mut().flat_map(|procedure| &mut procedure.steps) {
        if let Step::Send(message) = step {
            positions.resolve(message, MessageId);
        }
    }
}

fn procedures(device: &mut Device) {
    if device.procedures.is_empty() {
        return;
    }
    let positions = Positions::new(device.procedures.iter().map(|procedure| &procedure.name));
    let items = device.groups.iter_mut().flat_map(|group| &mut group.items);
    for side in items.flat_map(|item| &mut item.bindings).flat_map(window_sides) {
        side.procedure.iter_mut().for_each(|reference| positions.resolve(reference, ProcedureId));
    }
}

/// Resolves the states and commands of the state machines. `Message::accepted_in` can refer to the states of all machines.
fn machines(device: &mut Device) {
    if device.machines.is_empty() {
        return;
    }
    let messages = Positions::new(device.messages.iter().map(|message| &message.name));
    device.machines.iter_mut().for_each(|each| machine(each, &messages));
    let mut states = HashMap::default();
    for (machine, definition) in (0..).zip(&device.machines) {
        for (state, pattern) in (0..).map(StateId).zip(&definition.states) {
            states.entry(pattern.name.clone()).or_insert(DeviceStateId { machine, state });
        }
    }
    for state in device.messages.iter_mut().flat_map(|message| &mut message.accepted_in) {
        state.id = states.get(&state.name).copied();
    }
}

/// Resolves the states and commands in the state machine of a profile.
pub(super) fn machine_of_profile(definition: &mut StateMachine) {
    machine(definition, &Positions::new([].into_iter()));
}

fn machine(machine: &mut StateMachine, messages: &Positions) {
    let states = Positions::new(machine.states.iter().map(|state| &state.name));
    let commands = Positions::new(machine.commands.iter().map(|command| &command.name));
    machine.initial.iter_mut().chain(&mut machine.faults).for_each(|state| states.resolve(state, StateId));
    for cell in machine.outcomes.iter_mut().flat_map(|row| &mut row.cells) {
        states.resolve(&mut cell.state, StateId);
        for outcome in &mut cell.outcomes {
            if let Outcome::States(list) = outcome {
                list.iter_mut().for_each(|state| states.resolve(state, StateId));
            }
        }
    }
    // Devices share the transitions of their profile, which are already resolved. A change would copy the list.
    let is_resolved = |transition: &Transition| {
        let Transition { from, to, command, .. } = transition;
        to.id.is_some()
            && from.as_ref().is_none_or(|from| from.id.is_some())
            && command.as_ref().is_none_or(|command| command.id.is_some())
    };
    if machine.transitions.iter().all(is_resolved) {
        return;
    }
    for transition in machine.transitions.to_mut() {
        transition.from.iter_mut().chain([&mut transition.to]).for_each(|state| states.resolve(state, StateId));
        if let Some(command) = &mut transition.command {
            let message = || messages.find(&command.name).map(|at| CommandId::Message(MessageId(at)));
            command.id = commands.find(&command.name).map(CommandId::Pattern).or_else(message);
        }
    }
}

fn state_types(device: &mut Device) {
    let mut types = device.machines.iter_mut().filter_map(|machine| machine.state_type.as_mut()).peekable();
    if types.peek().is_some() {
        let is_enumeration = |definition: &TypeDef| matches!(definition.shape, Shape::Enumeration { .. });
        let enumerations = (0..).zip(&device.types).filter(|(_, definition)| is_enumeration(definition));
        let positions = Positions::of(enumerations.map(|(position, definition)| (position, &definition.name)));
        types.for_each(|reference| positions.resolve(reference, TypeId));
    }
}

fn images(device: &mut Device) {
    if device.process_data.images.is_empty() {
        return;
    }
    let positions = Positions::new(device.process_data.images.iter().map(|image| &image.name));
    for binding in device.groups.iter_mut().flat_map(|group| &mut group.items).flat_map(|item| &mut item.bindings) {
        if let Binding::Image(image) = binding {
            positions.resolve(&mut image.image, ImageId);
        }
    }
}

fn parameter_spaces(device: &mut Device) {
    if device.parameter_spaces.is_empty() {
        return;
    }
    let positions = Positions::new(device.parameter_spaces.iter().map(|space| &space.name));
    for binding in device.groups.iter_mut().flat_map(|group| &mut group.items).flat_map(|item| &mut item.bindings) {
        if let Binding::Parameter(parameter) = binding {
            positions.resolve(&mut parameter.space, SpaceId);
        }
    }
    for message in &mut device.messages {
        for_each_field(message, &mut |field| match field {
            MessageField::ItemCode { space, .. }
            | MessageField::ItemValue { space }
            | MessageField::ItemPadding { space } => positions.resolve(space, SpaceId),
            _ => {}
        });
    }
}

/// Resolves the references to models and machine constants in machine constants, machine units and example conversions.
fn models_and_given_numbers(device: &mut Device) {
    let models = Positions::new(device.variants.iter().map(|model| &model.name));
    let given = Positions::new(device.given.iter().map(|number| &number.name));
    for (model, _) in device.given.iter_mut().flat_map(|number| &mut number.models) {
        models.resolve(model, VariantId);
    }
    if models.0.is_empty() && given.0.is_empty() {
        return;
    }
    for_each_quantity(device, &mut |quantity| {
        let machine = quantity.machine.iter_mut().flat_map(|unit| unit.times.iter_mut().chain(&mut unit.over));
        machine.for_each(|number| given.resolve(number, GivenId));
        for conversion in &mut quantity.conversions {
            conversion.given.iter_mut().for_each(|(number, _)| given.resolve(number, GivenId));
            conversion.model.iter_mut().for_each(|model| models.resolve(model, VariantId));
        }
    });
}

/// Sets the id of the mapped item in each PDO entry that maps an item. `first` is the number of groups that precede `groups`.
fn mapped_items(pdos: &mut [Pdo], groups: &[Group], first: u32) {
    let items = Entries::new(groups);
    for entry in pdos.iter_mut().flat_map(|pdo| &mut pdo.entries).filter(|entry| entry.kind == PdoEntryKind::Item) {
        let id = items.find(entry.index, entry.sub_index);
        entry.item = id.map(|id| ItemId { group: id.group + first, ..id });
    }
}

/// Items by name; `None` for a name without an item.
type Found = HashMap<CompactString, Option<ItemId>>;

fn collect(names: &mut Found, mention: &Mention<'_>) {
    let name = mention.name();
    if !name.is_empty() && !names.contains_key(name) {
        names.insert(name.clone(), None);
    }
}

fn find(names: &mut Found, groups: &[&[Group]], types: &[TypeDef]) {
    let items = Index::new(Owner { types, groups });
    for (name, id) in names {
        *id = items.find(name);
    }
}

#[cfg(test)]
mod tests {
    use super::super::{mentions::target, removal};
    use super::*;
    use crate::ir::{
        CommandOutcomes, Conversion, Direction, Doubts, EtherCatSettings, Family, GivenNumber, GroupKind, ImageBinding,
        Item, MachineUnit, Message, ObjectCode, ParameterSpace, Pattern, ProcessImage, Quantity, RelatedItems,
        StateOutcome, Value, Variant,
    };

    fn item(name: &str, index: u16) -> Item {
        let mut item = Item::new(Binding::canopen(index, 0));
        item.name = name.into();
        item
    }

    fn group(name: &str, kind: GroupKind, items: Vec<Item>) -> Group {
        Group { name: name.into(), kind, items, ..Group::object(0, ObjectCode::Var) }
    }

    fn id(group: u32, item: u32) -> Option<ItemId> {
        Some(ItemId { group, item })
    }

    fn pattern(name: &str) -> Pattern {
        Pattern { name: name.into(), ..Pattern::default() }
    }

    #[test]
    fn states_and_commands_of_machines_become_ids() {
        let transition = |from: &str, to: &str, command: &str| Transition {
            from: Some(from.into()),
            to: to.into(),
            command: Some(command.into()),
            ..Transition::default()
        };
        let mut machine = StateMachine {
            name: "Drive".into(),
            states: vec![pattern("off"), pattern("on")].into(),
            initial: Some("off".into()),
            faults: vec!["on".into(), "lost".into()],
            commands: vec![pattern("stop")].into(),
            transitions: vec![transition("off", "on", "Start"), transition("on", "off", "stop")].into(),
            ..StateMachine::default()
        };
        machine.outcomes.push(CommandOutcomes {
            commands: vec!["Start".into(), "stop".into()],
            cells: vec![StateOutcome {
                state: "on".into(),
                outcomes: vec![Outcome::States(vec!["off".into()])],
                documentation: None,
            }],
            ..CommandOutcomes::default()
        });
        let message = Message { name: "Start".into(), accepted_in: vec!["on".into()], ..Message::default() };
        let other =
            StateMachine { states: vec![pattern("idle")].into(), transitions: Vec::new().into(), ..machine.clone() };
        let mut device = Device { machines: vec![other, machine], messages: vec![message], ..Device::default() };
        super::device(&mut device);
        let machine = &device.machines[1];
        assert_eq!(machine.initial.as_ref().and_then(|state| state.id), Some(StateId(0)));
        assert_eq!([0, 1].map(|at| machine.faults[at].id), [Some(StateId(1)), None]);
        let [first, second] = [0, 1].map(|at| &machine.transitions[at]);
        assert_eq!((first.from.as_ref().and_then(|from| from.id), first.to.id), (Some(StateId(0)), Some(StateId(1))));
        assert_eq!(first.command.as_ref().and_then(|command| command.id), Some(CommandId::Message(MessageId(0))));
        assert_eq!(second.command.as_ref().and_then(|command| command.id), Some(CommandId::Pattern(0)));
        assert_eq!([0, 1].map(|at| machine.outcomes[0].commands[at].id), [Some(MessageId(0)), None]);
        let cell = &machine.outcomes[0].cells[0];
        let Outcome::States(states) = &cell.outcomes[0] else { panic!("{cell:?}") };
        assert_eq!((cell.state.id, states[0].id), (Some(StateId(1)), Some(StateId(0))));
        assert_eq!(device.messages[0].accepted_in[0].id, Some(DeviceStateId { machine: 1, state: StateId(1) }));
    }

    #[test]
    fn images_parameter_spaces_models_and_machine_constants_become_ids() {
        let mut values = item("Speed", 0x2000);
        let image = ImageBinding { image: "in".into(), bit_offset: 0, bits: 8, ty: None };
        values.bindings = [Binding::Image(Box::new(image)), Binding::parameter("gains", 1)].into_iter().collect();
        let machine = MachineUnit { unit: "mm".into(), times: vec!["pitch".into()], over: vec!["ratio".into()] };
        let conversion =
            Conversion { model: Some("Large".into()), given: vec![("ratio".into(), 2.0)], ..Conversion::default() };
        let quantity =
            Quantity { machine: Some(Box::new(machine)), conversions: vec![conversion], ..Quantity::default() };
        values.quantity = Some(Box::new(quantity));
        let named = |name: &str| GivenNumber {
            name: name.into(),
            models: vec![("Large".into(), Value::Int(1))],
            ..GivenNumber::default()
        };
        let code = MessageField::ItemCode { space: "gains".into(), bits: 8 };
        let mut device = Device {
            groups: vec![group("Axis", GroupKind::Chapter, vec![values])],
            given: vec![named("ratio"), named("pitch")],
            variants: ["Small", "Large"].map(|name| Variant { name: name.into(), ..Variant::default() }).into(),
            parameter_spaces: vec![ParameterSpace { name: "gains".into(), ..ParameterSpace::default() }],
            messages: vec![Message { request: vec![code], ..Message::default() }],
            ..Device::default()
        };
        device.process_data.images = ["out", "in"].map(process_image).into();
        super::device(&mut device);
        let found = &device.groups[0].items[0];
        let [Binding::Image(image), Binding::Parameter(parameter)] = &found.bindings[..] else { panic!("{found:?}") };
        assert_eq!((image.image.id, parameter.space.id), (Some(ImageId(1)), Some(SpaceId(0))));
        let MessageField::ItemCode { space, .. } = &device.messages[0].request[0] else { panic!("{device:?}") };
        assert_eq!(device.parameter_space(space).map(|space| space.name.as_str()), Some("gains"));
        let quantity = found.quantity.as_ref().expect("a quantity");
        let machine = quantity.machine.as_ref().expect("a unit");
        assert_eq!((machine.times[0].id, machine.over[0].id), (Some(GivenId(1)), Some(GivenId(0))));
        let conversion = &quantity.conversions[0];
        assert_eq!(conversion.given[0].0.id, Some(GivenId(0)));
        assert_eq!(conversion.model.as_ref().and_then(|model| model.id), Some(VariantId(1)));
        assert_eq!(device.given[1].models[0].0.id, Some(VariantId(1)));
    }

    fn process_image(name: &str) -> ProcessImage {
        let (length, overhead, fields, doubts) = (8, 0, Vec::new(), Doubts::new());
        let name = name.into();
        ProcessImage { name, direction: Direction::Receive, length, overhead, big_endian: true, fields, doubts }
    }

    #[test]
    fn families_become_ids() {
        let settings = EtherCatSettings { group: "io".into(), ..EtherCatSettings::default() };
        let family = |id: &str, name: &str| Family { id: id.into(), name: name.into(), ..Family::default() };
        let mut catalog = Catalog {
            devices: vec![Device { ethercat: Some(Box::new(settings)), ..Device::default() }],
            families: vec![family("io", ""), family("drives", "Drives"), family("io", "Terminals")],
            ..Catalog::default()
        };
        families(&mut catalog);
        let settings = catalog.devices[0].ethercat.as_ref().expect("settings");
        assert_eq!(settings.group.id, Some(FamilyId(2)), "the first family with a name");
    }

    #[test]
    fn names_paths_and_addresses_become_ids() {
        let object = GroupKind::Object { index: 0x2005, code: ObjectCode::Var, category: None };
        let chapter = group("Axis", GroupKind::Chapter, vec![item("Speed", 0x2000), item("Mode", 0x2001)]);
        let mut device =
            Device { groups: vec![chapter, group("Limit", object, vec![item("", 0x2005)])], ..Device::default() };
        let related = RelatedItems {
            same_as: Some(Box::new("Axis/Mode".into())),
            same_quantity: Some(Box::new("Nothing".into())),
            ..RelatedItems::default()
        };
        device.groups[0].items[0].related = Some(Box::new(related));
        let steps = ["Speed", "0x2001", "Limit"].map(|name| Step::Write(name.into(), Value::Int(1)));
        let procedure =
            crate::ir::Procedure { name: "Start".into(), steps: steps.into(), ..crate::ir::Procedure::default() };
        device.procedures.push(procedure);
        assert!(super::device(&mut device));
        let ids: Vec<_> = device.procedures[0].steps.iter_mut().filter_map(|step| target(step)?.id).collect();
        assert_eq!(ids.into_iter().map(Some).collect::<Vec<_>>(), [id(0, 0), id(0, 1), id(1, 0)]);
        let related = device.groups[0].items[0].related.as_deref().expect("relations");
        assert_eq!(related.same_as.as_ref().and_then(|reference| reference.id), id(0, 1));
        assert_eq!(related.same_quantity.as_ref().and_then(|reference| reference.id), None);
        // After the removal of a group, the ids refer to the same items as before.
        removal::of_device(&mut device, |group| group.name != "Axis");
        let ids: Vec<_> =
            device.procedures[0].steps.iter_mut().filter_map(target).map(|reference| reference.id).collect();
        assert_eq!(ids, [None, None, id(0, 0)]);
    }
}
