//! References between elements. A reference consists of a name with its location and, after the stage `resolve`, an id.

use std::fmt;
use std::hash::{Hash, Hasher};
use std::ops::Deref;

use super::{
    CompactString, Device, GivenNumber, Group, Item, ParameterSpace, Procedure, ProcessImage, TypeId, Variant,
};
use crate::source::Span;

/// Position of an [`Item`] in its device or module.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub struct ItemId {
    /// Position of the item's group in [`Device::groups`]. In a module, the fixed objects are numbered first, and then the other
    /// groups.
    pub group: u32,
    /// Position of the item in [`Group::items`].
    pub item: u32,
}

impl ItemId {
    /// Returns the item with this id in `groups`.
    pub fn of(self, groups: &[Group]) -> Option<&Item> {
        groups.get(self.group as usize)?.items.get(self.item as usize)
    }
}

impl Group {
    /// Returns the items of the group with their ids. `position` is the position of the group in its device.
    pub fn items_at(&self, position: u32) -> impl Iterator<Item = (ItemId, &Item)> {
        (0..).zip(&self.items).map(move |(id, item)| (ItemId { group: position, item: id }, item))
    }
}

/// Position of a [`Message`](super::Message) in [`Device::messages`].
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub struct MessageId(pub u32);

/// Position of a [`MessageField`](super::MessageField) in its list: a request, a reply, or the fields of a repetition.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub struct FieldId(pub u32);

/// Position of a [`Procedure`] in [`Device::procedures`].
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub struct ProcedureId(pub u32);

/// Position of a [`ProcessImage`] in the process data of its device.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub struct ImageId(pub u32);

/// Position of a [`ParameterSpace`] in [`Device::parameter_spaces`].
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub struct SpaceId(pub u32);

/// Position of a [`GivenNumber`] in [`Device::given`].
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub struct GivenId(pub u32);

/// Position of a [`Variant`] in [`Device::variants`].
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub struct VariantId(pub u32);

/// Position of a [`Family`](super::Family) in [`Catalog::families`](super::Catalog::families).
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub struct FamilyId(pub u32);

/// Position of a state in the states of a state machine.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub struct StateId(pub u32);

/// A state of a device: the position of the state machine in [`Device::machines`], and the state.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub struct DeviceStateId {
    /// Position of the state machine.
    pub machine: u32,
    /// Position of the state in its machine.
    pub state: StateId,
}

/// The target of a reference to a command.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub enum CommandId {
    /// Position of a bit pattern in the commands of the state machine.
    Pattern(u32),
    /// Id of a message.
    Message(MessageId),
}

/// The target of a reference to an item or a message.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub enum ElementId {
    /// Id of an item.
    Item(ItemId),
    /// Id of a message.
    Message(MessageId),
}

impl ElementId {
    /// Returns the item, if the target is an item.
    pub fn item(self) -> Option<ItemId> {
        match self {
            ElementId::Item(id) => Some(id),
            ElementId::Message(_) => None,
        }
    }
}

impl From<ItemId> for ElementId {
    fn from(id: ItemId) -> Self {
        ElementId::Item(id)
    }
}

impl From<MessageId> for ElementId {
    fn from(id: MessageId) -> Self {
        ElementId::Message(id)
    }
}

impl Device {
    /// Returns the item with this id.
    pub fn item(&self, id: ItemId) -> Option<&Item> {
        id.of(&self.groups)
    }

    /// Returns the item that a resolved reference refers to.
    pub fn referred(&self, reference: &ItemRef) -> Option<&Item> {
        self.item(reference.id?)
    }

    /// Returns the procedure that a resolved reference refers to.
    pub fn procedure(&self, reference: &ProcedureRef) -> Option<&Procedure> {
        self.procedures.get(reference.id?.0 as usize)
    }

    /// Returns the process image that a resolved reference refers to.
    pub fn image(&self, reference: &ImageRef) -> Option<&ProcessImage> {
        self.process_data.images.get(reference.id?.0 as usize)
    }

    /// Returns the parameter space that a resolved reference refers to.
    pub fn parameter_space(&self, reference: &SpaceRef) -> Option<&ParameterSpace> {
        self.parameter_spaces.get(reference.id?.0 as usize)
    }

    /// Returns the machine constant that a resolved reference refers to.
    pub fn given_number(&self, reference: &GivenRef) -> Option<&GivenNumber> {
        self.given.get(reference.id?.0 as usize)
    }

    /// Returns the model that a resolved reference refers to.
    pub fn variant(&self, reference: &VariantRef) -> Option<&Variant> {
        self.variants.get(reference.id?.0 as usize)
    }
}

/// A reference to another element, usually of the same device.
///
/// A reference dereferences to its name. Two references with the same name are equal. The serialized form is the name, because
/// adding or removing an element changes ids.
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "serde", serde(from = "CompactString", into = "CompactString", bound = "Id: Clone"))]
#[derive(Clone, Debug)]
pub struct Reference<Id> {
    /// The name as the source spells it. The name of an item has the form `Item` or `Chapter/Item`, or is an index with an
    /// optional sub-index (`0x6040`, `0x1018:1`). The name of an object with a single value refers to this value.
    pub name: CompactString,
    /// Location of the name in the source.
    pub span: Span,
    /// Id of the target; `None` if the reference is not resolved, or if no element has this name.
    pub id: Option<Id>,
}

/// A reference to an item.
pub type ItemRef = Reference<ItemId>;

/// A reference to a type.
pub type TypeRef = Reference<TypeId>;

/// A reference to a message.
pub type MessageRef = Reference<MessageId>;

/// A reference to a field of a message. A field that copies a request field has the name of the copied field.
pub type FieldRef = Reference<FieldId>;

/// A reference to an item, or to a message if there is no such item.
pub type ElementRef = Reference<ElementId>;

/// A reference to a procedure.
pub type ProcedureRef = Reference<ProcedureId>;

/// A reference to a process image.
pub type ImageRef = Reference<ImageId>;

/// A reference to a parameter space. A register table can use a parameter space that it does not define. In this case, the
/// reference has no id.
pub type SpaceRef = Reference<SpaceId>;

/// A reference to a state of the same state machine.
pub type StateRef = Reference<StateId>;

/// A reference to a state of any state machine of the device. A reference to a state that only an enumeration contains has no id.
pub type DeviceStateRef = Reference<DeviceStateId>;

/// A reference to a command of the same state machine, or to a message if there is no such command.
pub type CommandRef = Reference<CommandId>;

/// A reference to a family of devices, by its key.
pub type FamilyRef = Reference<FamilyId>;

/// A reference to a machine constant.
pub type GivenRef = Reference<GivenId>;

/// A reference to a model.
pub type VariantRef = Reference<VariantId>;

impl<Id> Reference<Id> {
    /// Creates a reference that is not resolved.
    pub fn new(name: impl Into<CompactString>, span: Span) -> Self {
        Reference { name: name.into(), span, id: None }
    }
}

impl<Id> Default for Reference<Id> {
    fn default() -> Self {
        Reference::new("", Span::default())
    }
}

impl<Id> Deref for Reference<Id> {
    type Target = CompactString;

    fn deref(&self) -> &CompactString {
        &self.name
    }
}

impl<Id> AsRef<str> for Reference<Id> {
    fn as_ref(&self) -> &str {
        &self.name
    }
}

impl<Id> PartialEq for Reference<Id> {
    fn eq(&self, other: &Reference<Id>) -> bool {
        self.name == other.name
    }
}

impl<Id> Eq for Reference<Id> {}

impl<Id> Hash for Reference<Id> {
    fn hash<H: Hasher>(&self, state: &mut H) {
        self.name.hash(state);
    }
}

impl<Id> PartialEq<str> for Reference<Id> {
    fn eq(&self, name: &str) -> bool {
        self.name == name
    }
}

impl<Id> PartialEq<&str> for Reference<Id> {
    fn eq(&self, name: &&str) -> bool {
        self.name == *name
    }
}

impl<Id> PartialEq<CompactString> for Reference<Id> {
    fn eq(&self, name: &CompactString) -> bool {
        self.name == *name
    }
}

impl<Id> fmt::Display for Reference<Id> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        fmt::Display::fmt(&self.name, f)
    }
}

impl<Id> From<CompactString> for Reference<Id> {
    fn from(name: CompactString) -> Self {
        Reference::new(name, Span::default())
    }
}

impl<Id> From<&str> for Reference<Id> {
    fn from(name: &str) -> Self {
        Reference::new(name, Span::default())
    }
}

impl<Id> From<Reference<Id>> for CompactString {
    fn from(reference: Reference<Id>) -> Self {
        reference.name
    }
}
