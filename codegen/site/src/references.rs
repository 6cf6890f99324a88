//! Links between the elements of a device, in both directions.

use std::collections::HashMap;

use super::entry::Row;
use super::link::{Link, Relation};
use super::machines::{Behavior, Machine};
use super::parts::Parts;
use lexibus_codegen::facts::mentions::Mention;
use lexibus_codegen::facts::referrers::{self, Part, Referrer, Referrers};
use lexibus_codegen::ir::owner::Owner;
use lexibus_codegen::ir::{Binding, Device, ItemId, ItemRef};
use lexibus_codegen::number::hex16;

/// Links to the elements of a device.
pub(super) struct Targets<'d> {
    pub(super) device: &'d Device,
    items: HashMap<ItemId, Link>,
    /// The bits and values that the rows of items show.
    parts: HashMap<(ItemId, Part), Link>,
    /// Links to the objects with several entries, keyed by the index in the notation of the pages, such as `0x1018`.
    objects: HashMap<String, Link>,
    pdos: Vec<Link>,
    images: HashMap<&'d str, Link>,
    machines: Vec<Link>,
    /// The states of each state machine.
    states: Vec<Vec<Link>>,
    procedures: Vec<Link>,
    messages: Vec<Link>,
}

impl<'d> Targets<'d> {
    pub fn new(device: &'d Device, pages: &Parts) -> Self {
        let link = |file: &str, anchor: &str, title: &str| Link {
            title: title.to_owned(),
            target: format!("{file}#{anchor}"),
        };
        let (mut items, mut parts, mut objects) = (HashMap::new(), HashMap::new(), HashMap::new());
        for (area, section) in
            pages.areas.iter().flat_map(|area| area.sections.iter().map(move |section| (area, section)))
        {
            if let Some(anchor) = &section.anchor {
                let title = format!("{} {}", section.number, section.name);
                objects.insert(section.number.clone(), link(&area.file, anchor, &title));
            }
            for row in &section.rows {
                let title = format!("{} {}", row.number, row.name);
                for (part, anchor, name) in parts_of(row) {
                    parts.insert((row.id, part), link(&area.file, anchor, &format!("{}: {name}", title.trim())));
                }
                items.insert(row.id, link(&area.file, &row.anchor, title.trim()));
            }
        }
        let file = pages.process.as_deref();
        let frames = || pages.data.frames.iter().filter_map(|frame| Some(link(file?, &frame.anchor, &frame.title)));
        // The frames of the PDOs precede those of the process images.
        let (pdos, images) = (device.process_data.pdos.len(), &device.process_data.images);
        let states = |file: &str, machine: &Machine| {
            machine.states.iter().map(|state| link(file, &state.anchor, &format!("state {}", state.name))).collect()
        };
        let (machines, states, procedures) = match &pages.behavior {
            Some((file, behavior)) => (
                behavior.machines.iter().map(|machine| link(file, &machine.anchor, &machine.title)).collect(),
                behavior.machines.iter().map(|machine| states(file, machine)).collect(),
                behavior.sequences.iter().map(|sequence| link(file, &sequence.anchor, &sequence.name)).collect(),
            ),
            None => Default::default(),
        };
        let messages = pages.protocol.as_ref().map_or_else(Vec::new, |(file, protocol)| {
            protocol.messages.iter().map(|message| link(file, &message.anchor, &message.name)).collect()
        });
        Targets {
            device,
            items,
            parts,
            objects,
            pdos: frames().take(pdos).collect(),
            images: images.iter().map(|image| image.name.as_str()).zip(frames().skip(pdos)).collect(),
            machines,
            states,
            procedures,
            messages,
        }
    }

    /// Returns the link to an item, if a page shows it.
    pub fn item(&self, id: Option<ItemId>) -> Option<&Link> {
        self.items.get(&id?)
    }

    /// Returns the link to a bit or value of an item. A row can refer to another row with the same type instead of
    /// showing the bits and values. In this case, returns the link to the item.
    pub fn part(&self, id: ItemId, part: Part) -> Option<&Link> {
        self.parts.get(&(id, part)).or_else(|| self.item(Some(id)))
    }

    /// Returns the link to an element that a text mentions, if a page shows the element.
    pub fn mentioned(&self, mention: Mention) -> Option<&Link> {
        match mention {
            Mention::Item(id) => self.item(Some(id)),
            Mention::Bit(id, part) => self.part(id, part),
            Mention::Object(index, first) => self.objects.get(&hex16(index)).or_else(|| self.item(Some(first))),
            Mention::Message(message) => self.messages.get(message),
            Mention::State(machine, state) => self.states.get(machine)?.get(state),
        }
    }

    /// Adds links from the state machines and procedures to the items that they use.
    pub fn link(&self, behavior: &mut Behavior) {
        for (machine, shown) in self.device.machines.iter().zip(&mut behavior.machines) {
            let items = [machine.status_item.id, machine.control_item.id];
            shown.items = items.into_iter().filter_map(|item| self.item(item).cloned()).collect();
        }
        for (procedure, shown) in self.device.procedures.iter().zip(&mut behavior.sequences) {
            for (step, shown) in procedure.steps.iter().zip(&mut shown.steps) {
                shown.item = step.item().and_then(|item| self.item(item.id)).cloned();
            }
        }
    }

    fn refers(&self, items: impl IntoIterator<Item = &'d ItemRef>) -> Vec<Link> {
        items.into_iter().filter_map(|item| self.item(item.id)).cloned().collect()
    }

    /// Returns the relations of an item to other elements.
    pub fn relations(&self, id: ItemId, referrers: &Referrers) -> Vec<Relation> {
        let owner = Owner { types: &self.device.types, groups: &[self.device.groups.as_slice()] };
        let Some(item) = owner.item(id) else { return Vec::new() };
        let mut related = Related::default();
        for &referrer in referrers.of(id) {
            self.add(referrer, &mut related);
        }
        let images = item.bindings.iter().filter_map(|binding| match binding {
            Binding::Image(image) => self.images.get(image.image.as_str()),
            _ => None,
        });
        related.mapped.extend(images.cloned());
        related.items.extend(self.refers(item.related.iter().flat_map(|related| related.all())));
        let conditions = item.behavior.iter().flat_map(|behavior| &behavior.write_when);
        let of_type = referrers::conditions(owner, item.ty).into_iter().map(|(_, condition)| condition);
        let availability = item.availability.as_ref();
        let replacement = availability.and_then(|availability| availability.replaced_by.as_ref()?.id?.item());
        let lists = [
            ("Mapped in", related.mapped),
            ("Used by", related.users),
            ("Condition for", related.dependents),
            ("Depends on", self.refers(conditions.chain(of_type).map(|condition| &condition.item))),
            ("Related", related.items),
            ("Replaces", related.replaced),
            ("Replaced by", self.item(replacement).into_iter().cloned().collect()),
        ];
        lists.into_iter().filter_map(|(title, links)| Relation::new(title, &links)).collect()
    }

    fn add(&self, referrer: Referrer, related: &mut Related) {
        match referrer {
            Referrer::Pdo(at) => related.mapped.extend(self.pdos.get(at).cloned()),
            Referrer::Machine(at) => related.users.extend(self.machines.get(at).cloned()),
            Referrer::Procedure(id) => related.users.extend(self.procedures.get(id.0 as usize).cloned()),
            Referrer::Message(id) => related.dependents.extend(self.messages.get(id.0 as usize).cloned()),
            Referrer::Meaning(item, part) => related.dependents.extend(self.part(item, part).cloned()),
            Referrer::WritableWhen(item) => related.dependents.extend(self.item(Some(item)).cloned()),
            Referrer::Replaced(item) => related.replaced.extend(self.item(Some(item)).cloned()),
            Referrer::Related(item) => related.items.extend(self.item(Some(item)).cloned()),
        }
    }
}

/// Returns the bits and values that a row shows, with their anchors and names.
fn parts_of(row: &Row) -> impl Iterator<Item = (Part, &str, String)> {
    let fields = row.bits.iter().flat_map(|bits| bits.fields.iter().enumerate());
    let fields =
        fields.map(|(at, field)| (Part::Bit(at), field.anchor.as_str(), format!("{} {}", field.number(), field.name)));
    let labels = row.labels.iter().enumerate();
    let labels = labels
        .map(|(at, label)| (Part::Value(at), label.anchor.as_str(), format!("{} {}", label.number(), label.name)));
    fields.chain(labels)
}

/// Links between an item and other elements, by kind of relation.
#[derive(Default)]
struct Related {
    mapped: Vec<Link>,
    users: Vec<Link>,
    dependents: Vec<Link>,
    items: Vec<Link>,
    replaced: Vec<Link>,
}
