//! Converts objects and their data types to groups and items of the IR.

use std::rc::Rc;

use compact_str::{format_compact, CompactString};
use thin_vec::ThinVec;

use super::array_default;
use super::budget::Cost;
use super::data_type::{RawField, RawType};
use super::dictionary::missing_index;
use super::entries::{self, Entry};
use super::flags::Flags;
use super::info_value::RawInfo;
use super::number;
use super::object::{RawObject, RawSub};
use super::reader::{Names, Reader};
use super::types::Types;
use super::value::{self, Role};
use crate::diagnostics::codes;
use crate::etg::unit;
use crate::frontend::xml::Given;
use crate::ir::{Access, Binding, Fact, FactOrigins, Group, GroupKind, Item, ObjectCode, Quantity, Rule, Type};
use crate::number::{hex16, hex8};
use crate::text::brief;

/// Converts the objects of a dictionary to groups, sorted by index. Adds to `types` the types that are defined only by
/// their names, such as `BITARR8`.
///
/// `raw` contains the data types as written in the file.
pub(super) fn build<'a>(
    reader: &mut Reader<'_, '_>,
    types: &mut Types<'a>,
    raw: Vec<RawType<'a>>,
    mut objects: Vec<RawObject<'a>>,
    subs: &mut [RawSub<'a>],
    units: &[(u32, CompactString)],
) -> Vec<Group> {
    // The objects are removed from the end of the list, so that the list can be shortened while the groups are created.
    // The fields of a data type are freed after its last object, and its other contents at once. This reduces the peak
    // memory use.
    objects.sort_by_key(|object| object.index);
    objects.reverse();
    let mut fields = fields_of(types, raw, &objects);
    let missing_access = FactOrigins::by_rule(&[Fact::Access], Rule::MissingKey);
    let mut builder = Builder { reader, types, units, missing_access };
    let mut groups: Vec<Group> = Vec::with_capacity(objects.len());
    while let Some(object) = objects.pop() {
        let fields = fields.pop().flatten();
        if objects.len() < objects.capacity() / 2 {
            objects.shrink_to_fit();
        }
        let Some(index) = object.index else {
            missing_index(builder.reader, object.origin.span, "this object has no usable index");
            continue;
        };
        if let Some(first) = groups.last().filter(|first| first.index() == Some(index)) {
            let message = format!("object {} occurs twice", hex16(index));
            let found = codes::ESI_DUPLICATE_OBJECT.at(object.origin.span, message).label("ignored");
            builder.reader.diagnostics.push(found.note_at(first.origin.span, "this object is used"));
            continue;
        }
        let sub_items = subs.get_mut(object.subs.clone()).unwrap_or_default();
        groups.push(builder.object(index, object, fields.as_deref(), sub_items));
    }
    groups
}

/// Returns the fields of each object's data type; `None` for an object whose data type is not a record.
fn fields_of<'a>(
    types: &Types<'_>,
    raw: Vec<RawType<'a>>,
    objects: &[RawObject<'_>],
) -> Vec<Option<Rc<ThinVec<RawField<'a>>>>> {
    let records: Vec<_> = raw.into_iter().map(|ty| (!ty.fields.is_empty()).then(|| Rc::new(ty.fields))).collect();
    objects.iter().map(|object| records.get(types.position(&object.ty.text)?)?.clone()).collect()
}

/// Builds the groups of a device or module from its objects.
struct Builder<'b, 'a, 'r, 'd> {
    reader: &'b mut Reader<'r, 'd>,
    types: &'b mut Types<'a>,
    units: &'b [(u32, CompactString)],
    /// Origins of an item whose access rights are not declared.
    missing_access: FactOrigins,
}

impl<'a> Builder<'_, 'a, '_, '_> {
    fn object(
        &mut self,
        index: u16,
        mut raw: RawObject<'a>,
        fields: Option<&ThinVec<RawField<'a>>>,
        subs: &mut [RawSub<'a>],
    ) -> Group {
        let ty = self.object_type(&raw);
        let mut group = Group::object(index, ObjectCode::Var);
        (group.name, group.names, group.name_at) = (raw.name.name(), raw.name.others(), raw.name.span());
        group.documentation = raw.comment.documentation();
        group.origin = raw.origin;
        group.depends_on_slot = raw.depends_on_slot;
        group.depends_on_slot_group = raw.depends_on_slot_group;
        group.described = u32::try_from(subs.len()).unwrap_or(u32::MAX);
        group.tool_flags = raw.tool_flags.take();
        group.extensions = std::mem::take(&mut raw.extensions);
        let code = match fields {
            Some(fields) => self.record(&mut group, &raw, ty, fields, subs),
            None if subs.is_empty() => {
                group.items = vec![self.value(&group, index, &raw, ty)];
                ObjectCode::Var
            }
            None => self.untyped(&mut group, &raw, subs),
        };
        let code = match code {
            ObjectCode::Var if index < 0x1000 => ObjectCode::DefType,
            _ if index < 0x1000 => ObjectCode::DefStruct,
            code => code,
        };
        group.kind = GroupKind::Object { index, code, category: raw.flags.category };
        self.access_given(&mut group, &raw.flags);
        group
    }

    fn object_type(&mut self, raw: &RawObject<'_>) -> Type {
        if raw.ty.is_empty() {
            let message = "this object has no type";
            self.reader.report(&codes::UNRESOLVED_TYPE, raw.origin.span, message, "kept as raw bytes");
            return Type::Opaque(None);
        }
        let ty = self.types.resolve(self.reader, &raw.ty);
        let size = self.types.bits(ty);
        match (size, raw.bits) {
            (Some(size), Some(bits)) if size != bits && self.reader.diagnostics.wants(&codes::BIT_SIZE) => {
                let message = format!("BitSize is {bits}, but the data type `{}` has {size} bits", brief(&raw.ty.text));
                self.reader.report(&codes::BIT_SIZE, raw.bits_at, message, "the data type is used");
            }
            _ => {}
        }
        ty
    }

    /// Builds the item of an object that has a single value.
    fn value(&mut self, group: &Group, index: u16, raw: &RawObject<'a>, ty: Type) -> Item {
        let mut item = Item::new(Binding::coe(index, 0));
        item.name = group.name.clone();
        item.names = group.names.clone();
        item.at.name = group.name_at;
        item.origin = raw.origin;
        (item.ty, item.at.ty) = (ty, raw.ty.span);
        self.flags(&mut item, &raw.flags, &raw.flags, None);
        self.info(&mut item, &raw.info, None);
        item
    }

    /// Builds the items of an object with a record type. Combines the entries of the type with the sub-items of the
    /// object.
    fn record(
        &mut self,
        group: &mut Group,
        raw: &RawObject<'a>,
        ty: Type,
        fields: &[RawField<'a>],
        subs: &mut [RawSub<'a>],
    ) -> ObjectCode {
        let entries = entries::of_object(self.reader, self.types, raw, ty, fields);
        let mut matched = entries::match_up(self.reader, &entries, subs);
        let mut parts = array_default::split(self.types, &entries, &matched.of_entry, subs);
        group.items.reserve_exact(entries.len() + matched.extra.len());
        let of_object = raw.flags.weight();
        for (position, entry) in entries.iter().enumerate() {
            let sub = matched.of_entry.get(position).copied().flatten().and_then(|at| subs.get_mut(at));
            let described = sub.is_some() || parts.contains_key(&position);
            let cost = Cost { items: usize::from(!described), bytes: entry.field.weight() + of_object };
            if !self.reader.derive(cost, raw.origin.span) {
                break;
            }
            // The large struct is added to the list first and filled there, which avoids a copy.
            group.items.push(Item::new(Binding::coe(raw.index.unwrap_or(0), entry.sub_index)));
            if let Some(item) = group.items.last_mut() {
                let part = parts.remove(&position).unwrap_or_default();
                self.entry(raw, entry, sub, part, item);
            }
        }
        matched.extra.sort_unstable();
        self.extra(group, raw, entries.last(), &matched.extra, subs);
        self.keep_whole(raw, group);
        let element = |entry: &Entry<'_, '_>| entry.element.is_some();
        match entries.split_first() {
            Some((first, rest)) if first.sub_index == 0 && !rest.is_empty() && rest.iter().all(element) => {
                ObjectCode::Array
            }
            _ => ObjectCode::Record,
        }
    }

    /// Stores the default value, limits and unit of a whole record as extensions of the group. Adds the display names
    /// of the record to the names of the group.
    fn keep_whole(&self, raw: &RawObject<'a>, group: &mut Group) {
        let more = raw.info.more.as_deref();
        let limits = more.into_iter().flat_map(|more| [("Min", more.min.as_ref()), ("Max", more.max.as_ref())]);
        for (key, value) in [("Default", raw.info.default.as_ref())].into_iter().chain(limits) {
            if let Some(value) = value {
                group.extensions.extend(value.given().extension(key));
            }
        }
        if let Some(more) = more {
            group.extensions.extend(more.unit.extension("Unit"));
        }
        if let Some(display) = raw.info.display.as_deref() {
            let mut names: Vec<_> = group.names.iter().cloned().collect();
            names.extend(display.all().filter(|text| text.text != group.name));
            group.names = names.into();
        }
    }

    fn entry(
        &mut self,
        raw: &RawObject<'a>,
        entry: &Entry<'_, 'a>,
        sub: Option<&mut RawSub<'a>>,
        part: RawInfo<'a>,
        item: &mut Item,
    ) {
        let field = entry.field;
        (item.ty, item.at.ty) = (entry.ty, field.ty.span);
        self.flags(item, &field.flags, &raw.flags, Some(entry.sub_index));
        item.documentation = field.comment.as_deref().and_then(Names::documentation);
        match sub {
            Some(sub) => {
                item.origin = sub.origin;
                item.extensions = std::mem::take(&mut sub.extensions);
                let named = if sub.name.is_empty() { &field.name } else { &sub.name };
                (item.name, item.at.name) = (named.compact(), named.span);
                self.info(item, &sub.info, Some(&field.info));
            }
            None => {
                item.origin = field.origin;
                item.at.name = field.name.span;
                item.name = match entry.element {
                    Some(number) => format_compact!("{} {number}", field.name.text),
                    None => field.name.compact(),
                };
                self.info(item, &part, Some(&field.info));
            }
        }
    }

    /// Adds those sub-items of an object that the data type of the object does not define. The added sub-items get the
    /// sub-indices after the last entry, and the type of the last entry. Without an entry after sub-index 0, they
    /// become raw bytes.
    fn extra(
        &mut self,
        group: &mut Group,
        raw: &RawObject<'a>,
        last: Option<&Entry<'_, 'a>>,
        extra: &[usize],
        subs: &mut [RawSub<'a>],
    ) {
        let mut next = last.map_or(0, |entry| u16::from(entry.sub_index) + 1);
        for &at in extra {
            let Some(sub) = subs.get_mut(at) else { continue };
            let Ok(sub_index) = u8::try_from(next) else {
                let message = "an object has at most 255 sub-indices after sub-index 0";
                self.reader.report(&codes::SUB_INDEX_RANGE, sub.origin.span, message, "left out");
                continue;
            };
            let message = format!("`{}` is not a sub-item of the data type", brief(&sub.name.text));
            let label = format!("read as sub-index {}", hex8(sub_index));
            self.reader.report(&codes::SUB_ITEM_MISMATCH, sub.name.span.or(sub.origin.span), message, label);
            let ty = last.filter(|entry| entry.sub_index > 0).map_or(Type::Opaque(None), |entry| entry.ty);
            let flags = last.filter(|entry| entry.sub_index > 0).map_or(&raw.flags, |entry| &entry.field.flags);
            if !self.reader.derive(Cost::text(flags.weight() + raw.flags.weight()), sub.origin.span) {
                break;
            }
            group.items.push(self.plain(raw, sub_index, ty, flags, sub));
            next += 1;
        }
    }

    /// Adds the sub-items of an object whose type is not a record. The sub-indices follow the order of the file.
    fn untyped(&mut self, group: &mut Group, raw: &RawObject<'a>, subs: &mut [RawSub<'a>]) -> ObjectCode {
        let message = format!("the object has sub-items, but its type `{}` has none", brief(&raw.ty.text));
        let label = "numbered from 0 and kept as raw bytes";
        self.reader.report(&codes::SUB_ITEM_MISMATCH, raw.ty.span.or(raw.origin.span), message, label);
        for (at, sub) in subs.iter_mut().enumerate() {
            let Ok(sub_index) = u8::try_from(at) else {
                let message = "an object has at most 255 sub-indices after sub-index 0";
                let label = "this and all later sub-items are left out";
                self.reader.report(&codes::SUB_INDEX_RANGE, sub.origin.span, message, label);
                break;
            };
            if !self.reader.derive(Cost::text(raw.flags.weight()), sub.origin.span) {
                break;
            }
            // Sub-index 0 contains the number of the other sub-indices.
            let ty = if sub_index == 0 { Type::Unsigned(8) } else { Type::Opaque(None) };
            group.items.push(self.plain(raw, sub_index, ty, &raw.flags, sub));
        }
        self.keep_whole(raw, group);
        ObjectCode::Record
    }

    /// Builds the item of a sub-item that the data type does not define.
    fn plain(&mut self, raw: &RawObject<'a>, sub_index: u8, ty: Type, flags: &Flags, sub: &mut RawSub<'a>) -> Item {
        let mut item = Item::new(Binding::coe(raw.index.unwrap_or(0), sub_index));
        (item.name, item.at.name, item.origin) = (sub.name.compact(), sub.name.span, sub.origin);
        item.ty = ty;
        item.extensions = std::mem::take(&mut sub.extensions);
        self.flags(&mut item, flags, &raw.flags, Some(sub_index));
        self.info(&mut item, &sub.info, None);
        item
    }

    /// Sets the access rights, PDO mapping and behavior of an item. `sub_index` is `None` for the value of an object
    /// without sub-items.
    fn flags(&self, item: &mut Item, flags: &Flags, object: &Flags, sub_index: Option<u8>) {
        let (access, at) = flags.access_or(object);
        (item.access, item.at.access) = (access.unwrap_or(Access::ReadOnly), at);
        (item.mappable, item.at.mappable) = match sub_index {
            Some(sub_index) => flags.mappable_or(object, sub_index),
            None => (flags.mappable.unwrap_or_default(), flags.mappable_at),
        };
        item.behavior = flags.behavior_or(object);
    }

    /// Sets the default value, limits, unit and display name of an item. Values of the object take precedence over
    /// values of the data type.
    fn info(&mut self, item: &mut Item, raw: &RawInfo<'a>, of_type: Option<&RawInfo<'a>>) {
        let of_type = of_type.filter(|info| !info.is_empty());
        if raw.is_empty() && of_type.is_none() {
            return;
        }
        let base = self.types.underlying(item.ty);
        let default = raw.default.as_ref().or_else(|| of_type.and_then(|info| info.default.as_ref()));
        if let Some(raw) = default {
            item.default = value::convert(self.reader, raw, base, Role::Default);
            item.at.default = raw.span;
        }
        let more = [raw.more.as_deref(), of_type.and_then(|info| info.more.as_deref())];
        let more = more.into_iter().flatten();
        if let Some(raw) = more.clone().find_map(|more| more.min.as_ref()) {
            item.limits.low = value::convert(self.reader, raw, base, Role::Limit);
            item.at.others.low = raw.span;
        }
        if let Some(raw) = more.clone().find_map(|more| more.max.as_ref()) {
            item.limits.high = value::convert(self.reader, raw, base, Role::Limit);
            item.at.others.high = raw.span;
        }
        if let Some(given) = more.map(|more| &more.unit).find(|unit| !unit.is_empty()) {
            let unit = self.unit(given);
            item.quantity = Some(Box::new(Quantity { unit, ..Quantity::default() }));
        }
        let display = [raw.display.as_deref(), of_type.and_then(|info| info.display.as_deref())];
        let display = display.into_iter().flatten().flat_map(Names::all);
        let display: Vec<_> = display.filter(|text| text.text != item.name).collect();
        if !display.is_empty() {
            item.names = display.into();
        }
    }

    fn unit(&mut self, given: &Given<'_>) -> CompactString {
        let number = number::parse(&given.text).and_then(|number| u32::try_from(number.value).ok());
        match number {
            // A unit symbol that the file defines may be long, so the budget must allow each copy.
            Some(number) => unit::text(number, self.units)
                .filter(|text| self.reader.derive(Cost::text(text.len()), given.span))
                .unwrap_or_else(|| given.compact()),
            None => {
                self.reader.bad(given, "unit number", "kept unchanged");
                given.compact()
            }
        }
    }

    /// Reports an object without declared access rights if at least one of its items declares none either. Records for each such
    /// item that a rule of the compiler makes it read-only.
    fn access_given(&mut self, group: &mut Group, flags: &Flags) {
        if flags.access.is_some() {
            return;
        }
        let mut silent = 0;
        for item in group.items.iter_mut().filter(|item| item.at.access.is_empty()) {
            silent += 1;
            item.origins.clone_from(&self.missing_access);
        }
        if silent > 0 && self.reader.diagnostics.wants(&codes::ESI_MISSING_ACCESS) {
            let message = "the file does not declare the access rights of this object";
            let label = if silent == group.items.len() {
                "kept as read-only".to_owned()
            } else {
                format!("{silent} of {} sub-indices kept as read-only", group.items.len())
            };
            self.reader.report(&codes::ESI_MISSING_ACCESS, group.origin.span, message, label);
        }
    }
}
