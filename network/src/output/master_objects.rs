//! Builds objects of the master's object dictionary.

use lexibus_codegen::ir::{Access, Binding, Configured, Group, Item, Mappable, ObjectCode, Type, Value};
use lexibus_codegen::source::Origin;

pub(super) const U8: Type = Type::Unsigned(8);
pub(super) const U16: Type = Type::Unsigned(16);
pub(super) const U32: Type = Type::Unsigned(32);

/// Name, type and access rights of an item.
pub(super) type Fields<'n> = (&'n str, Type, Access);

/// Creates an item without a value.
pub(super) fn item(index: u16, sub_index: u8, fields: Fields<'_>) -> Item {
    let (name, ty, access) = fields;
    let mut item = Item::new(Binding::canopen(index, sub_index));
    item.name = name.into();
    item.ty = ty;
    item.access = access;
    item
}

/// Sets the default value.
pub(super) fn with_default(mut item: Item, default: impl Into<i128>) -> Item {
    item.default = Some(Value::Int(default.into()));
    item
}

/// Sets the configured value.
pub(super) fn with_value(mut item: Item, value: impl Into<i128>) -> Item {
    item.configured = Some(Box::new(Configured { value: Some(Value::Int(value.into())), ..Configured::default() }));
    item
}

/// Sets the file that contains the value of a domain.
pub(super) fn with_file(mut item: Item, file: &str) -> Item {
    item.configured = Some(Box::new(Configured { upload_file: Some(file.into()), ..Configured::default() }));
    item
}

/// Makes an item mappable in the directions that its access rights allow.
pub(super) fn mappable(mut item: Item) -> Item {
    item.mappable = Mappable::by_access(item.access);
    item
}

/// Creates an object with a single value.
pub(super) fn var(item: Item) -> Group {
    let index = item.object().map_or(0, |(index, _)| index);
    Group { name: item.name.clone(), items: vec![item], ..Group::object(index, ObjectCode::Var) }
}

/// Creates an object whose sub-indices have different names. Sub-index 0 contains the number of items.
pub(super) fn record(index: u16, name: &str, code: ObjectCode, items: Vec<Item>) -> Group {
    let count = item(index, 0, ("Highest sub-index supported", U8, Access::Constant));
    let count = with_default(count, items.len() as i128);
    let items = std::iter::once(count).chain(items).collect();
    Group { name: name.into(), items, ..Group::object(index, code) }
}

/// Creates an array of `count` elements with the same type, access rights and default value. `values` contains sub-indices with their
/// configured values.
pub(super) fn array(index: u16, fields: Fields<'_>, default: Option<u32>, count: u8, values: &[(u8, u32)]) -> Group {
    let (name, ty, access) = fields;
    let element = |sub_index: u8| {
        let element = item(index, sub_index, (&format!("{name}{sub_index}"), ty, access));
        let element = default.into_iter().fold(element, with_default);
        let value = values.iter().find(|(sub, _)| *sub == sub_index).map(|(_, value)| *value);
        value.into_iter().fold(element, with_value)
    };
    let number = with_default(item(index, 0, ("NrOfObjects", U8, Access::ReadOnly)), count);
    let items = std::iter::once(number).chain((1..=count).map(element)).collect();
    // Because all elements have the same origin, the export writes them together, with CompactSubObj.
    let origin = Origin { line: 1, ..Origin::default() };
    let mut group = Group { name: name.into(), items, origin, ..Group::object(index, ObjectCode::Array) };
    group.items.iter_mut().for_each(|item| item.origin = origin);
    group
}
