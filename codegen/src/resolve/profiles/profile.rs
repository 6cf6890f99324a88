//! Data of a profile.

use std::sync::Arc;

use crate::ir::owner::object;
use crate::ir::{
    Behavior, CodeTable, CompactString, Condition, Direction, Documentation, Group, ObjectBuses, ObjectCode, Quantity,
    Shape, StateMachine, Type, TypeDef, TypeId, Value,
};

/// Facts of a standard about all devices, modules and submodules that follow it.
#[derive(Clone, Debug, Default, PartialEq)]
pub(crate) struct Profile {
    /// Name of the standard.
    pub name: CompactString,
    /// Number of the device profile.
    pub number: Option<u32>,
    /// Index of the object by which devices that follow the profile are recognized.
    pub when: Option<u16>,
    /// API number of submodules that follow the profile (PROFINET).
    pub api: Option<u32>,
    /// True if the profile applies to devices on CANopen.
    pub on_canopen: bool,
    pub on_ethercat: bool,
    /// Index offset from axis to axis for the objects 0x6000 to 0x67FF.
    pub axis_index: Option<u16>,
    /// Facts about the objects of devices that follow the profile.
    pub objects: Vec<Described>,
    /// Signals in telegrams of submodules.
    pub signals: Vec<Signal>,
    /// Telegrams of submodules, each in one direction.
    pub telegrams: Vec<Telegram>,
    /// Types that name the bits and values of objects and signals.
    pub types: Vec<TypeDef>,
    /// Code tables of devices that follow the profile.
    pub codes: Vec<CodeTable>,
    /// State machines of devices that follow the profile.
    pub machines: Vec<StateMachine>,
}

/// Facts of a profile about objects or sub-indices.
#[derive(Clone, Debug, Default, PartialEq)]
pub(crate) struct Described {
    /// First and last index of the objects.
    pub indices: (u16, u16),
    /// First and last sub-index; `None` for the objects themselves.
    pub subs: Option<(u8, u8)>,
    /// Expected type of the objects or sub-indices, without regard to the signedness; `None` = any type.
    pub ty: Option<Type>,
    /// Buses on which the facts apply; `None` means all buses.
    pub buses: Option<ObjectBuses>,
    /// Type with the names of bits or values, from [`Profile::types`].
    pub meaning: Option<TypeId>,
    /// Standard and clause that state the facts.
    pub standard: CompactString,
    pub quantity: Option<Box<Quantity>>,
    pub behavior: Option<Box<Behavior>>,
    pub documentation: Option<Arc<Documentation>>,
}

/// A signal of a telegram.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Signal {
    pub name: CompactString,
    pub ty: Option<Type>,
    /// Type with the names of bits or values, from [`Profile::types`].
    pub meaning: Option<TypeId>,
}

/// A telegram in one direction.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Telegram {
    pub name: CompactString,
    pub direction: Direction,
    /// Byte offset and name of each signal.
    pub signals: Vec<(u32, CompactString)>,
}

impl Profile {
    /// Returns whether `groups` contain the object by which the profile is recognized, with a single value of the expected type.
    /// Returns true if the profile has no such object.
    pub fn is_shown_by(&self, groups: &[Group]) -> bool {
        let Some(index) = self.when else { return true };
        let found = groups.binary_search_by_key(&Some(index), Group::index).ok().and_then(|at| groups.get(at));
        let Some(group) = found.filter(|group| !group.object_code().is_some_and(ObjectCode::has_subs)) else {
            return false;
        };
        let described = self.objects.iter().find(|described| described.indices == (index, index));
        // An item with a named type is accepted, because the definition of the type is not available here.
        let is_alike = |ty: Type| {
            matches!(ty, Type::Named(_)) || described.is_none_or(|known| self.is_alike(ty, known.ty, known.meaning))
        };
        group.sub(0).is_some_and(|item| is_alike(item.ty))
    }

    /// Returns the type with this id.
    pub fn definition(&self, id: TypeId) -> Option<&TypeDef> {
        self.types.get(id.0 as usize)
    }

    /// Returns the names of the values in a condition, if the profile names all values of the condition.
    pub fn value_names(&self, when: &Condition) -> Option<Vec<CompactString>> {
        let (index, sub_index) = object(&when.item)?;
        let is_described = |described: &&Described| {
            described.indices == (index, index) && described.subs.is_none_or(|subs| subs == (sub_index, sub_index))
        };
        let meaning = self.objects.iter().find(is_described)?.meaning?;
        let Shape::Enumeration { values, .. } = &self.definition(meaning)?.shape else { return None };
        let name_of = |value: &Value| {
            let label = values.iter().find(|label| label.last.is_none() && Some(label.value) == value.as_int())?;
            Some(label.name.clone())
        };
        when.values.iter().map(name_of).collect()
    }

    /// Returns whether a type has the kind that the profile expects and, if it is an integer, the expected length. Returns true if
    /// the profile expects no particular type. The signedness of integers may differ, but a signed type never matches a bit field.
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
