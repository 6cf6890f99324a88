//! A profile as plain data.

use crate::ir::owner::object;
use crate::ir::{
    Behaviour, CodeTable, CompactString, Condition, Direction, Documentation, Doubts, Group, ObjectBuses, ObjectCode,
    Quantity, Shape, StateMachine, Type, TypeDef, TypeId, Value,
};

/// What a standard says of the objects of every device that follows it.
#[derive(Clone, Debug, Default, PartialEq)]
pub(crate) struct Profile {
    /// The standard's name.
    pub name: CompactString,
    /// Number of the device profile.
    pub number: Option<u32>,
    /// The object that shows that a device follows it.
    pub when: Option<u16>,
    /// The number of the API of submodules that follow it (PROFINET).
    pub api: Option<u32>,
    /// The buses on which devices follow it.
    pub on_canopen: bool,
    pub on_ethercat: bool,
    /// What is added to indices from 0x6000 to 0x67FF for each further axis.
    pub axis_index: Option<u16>,
    /// Its objects.
    pub objects: Vec<Described>,
    /// Signals of submodules.
    pub signals: Vec<Signal>,
    /// Telegrams of submodules.
    pub telegrams: Vec<Telegram>,
    /// The types of objects and signals, each over the integer that the profile names.
    pub types: Vec<TypeDef>,
    /// Its codes and state machines, which are the same for every device, each with its doubts.
    pub codes: Vec<(CodeTable, Doubts)>,
    pub machines: Vec<(StateMachine, Doubts)>,
}

/// What a profile says of objects, or of sub-entries.
#[derive(Clone, Debug, Default, PartialEq)]
pub(crate) struct Described {
    /// First and last index.
    pub indices: (u16, u16),
    /// First and last sub-index; `None` for the objects themselves.
    pub subs: Option<(u8, u8)>,
    /// The only type, but for the sign, of entries that the profile speaks of.
    pub ty: Option<Type>,
    /// The only buses on which it holds.
    pub buses: Option<ObjectBuses>,
    /// The bits or values: one of [`Profile::types`].
    pub meaning: Option<TypeId>,
    /// The standard with its clause.
    pub standard: CompactString,
    pub quantity: Option<Box<Quantity>>,
    pub behaviour: Option<Box<Behaviour>>,
    pub documentation: Option<Box<Documentation>>,
}

/// A word of a telegram.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Signal {
    pub name: CompactString,
    pub ty: Option<Type>,
    /// Its bits: one of [`Profile::types`].
    pub meaning: Option<TypeId>,
}

/// A telegram in one direction.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Telegram {
    pub name: CompactString,
    pub direction: Direction,
    /// First byte and name of each signal.
    pub signals: Vec<(u32, CompactString)>,
}

impl Profile {
    /// Whether these objects are those of something that follows the profile. Without an object that would show it, they are.
    pub fn is_shown_by(&self, groups: &[Group]) -> bool {
        let Some(index) = self.when else { return true };
        let found = groups.binary_search_by_key(&Some(index), Group::index).ok().and_then(|at| groups.get(at));
        let Some(group) = found.filter(|group| !group.object_code().is_some_and(ObjectCode::has_subs)) else {
            return false;
        };
        let described = self.objects.iter().find(|described| described.indices == (index, index));
        // A type that the description defines may be anything.
        let is_alike = |ty: Type| {
            matches!(ty, Type::Named(_)) || described.is_none_or(|own| self.is_alike(ty, own.ty, own.meaning))
        };
        group.sub(0).is_some_and(|item| is_alike(item.ty))
    }

    /// A type by its position.
    pub fn definition(&self, id: TypeId) -> Option<&TypeDef> {
        self.types.get(id.0 as usize)
    }

    /// The names of the values of an object with which a condition compares it, if the profile names all of them.
    pub fn value_names(&self, when: &Condition) -> Option<Vec<CompactString>> {
        let (index, sub_index) = object(&when.item)?;
        let is_described = |own: &&Described| {
            own.indices == (index, index) && own.subs.is_none_or(|subs| subs == (sub_index, sub_index))
        };
        let meaning = self.objects.iter().find(is_described)?.meaning?;
        let Shape::Enumeration { values, .. } = &self.definition(meaning)?.shape else { return None };
        let name_of = |value: &Value| {
            let label = values.iter().find(|label| label.last.is_none() && Some(label.value) == value.as_int())?;
            Some(label.name.clone())
        };
        when.values.iter().map(name_of).collect()
    }

    /// Whether values of a type are as long as those that the profile speaks of, and of its kind. Numbers with a sign aren't bits,
    /// whatever their object is elsewhere; named values may well have another sign.
    pub fn is_alike(&self, ty: Type, expected: Option<Type>, meaning: Option<TypeId>) -> bool {
        let Some(expected) = expected else { return true };
        let shape = meaning.and_then(|id| self.definition(id)).map(|definition| &definition.shape);
        if ty.is_signed() && matches!(shape, Some(Shape::BitField { .. })) {
            return false;
        }
        let is_integer = |ty: Type| matches!(ty, Type::Integer(_) | Type::Unsigned(_));
        match is_integer(ty) && is_integer(expected) {
            true => ty.bits() == expected.bits(),
            false => std::mem::discriminant(&ty) == std::mem::discriminant(&expected),
        }
    }
}
