//! From objects and their data types to groups and items.

use std::collections::HashMap;

use compact_str::{format_compact, CompactString};

use super::array_default;
use super::data_type::{RawField, RawType};
use super::dictionary::missing_index;
use super::flags::Flags;
use super::object::{RawInfo, RawObject, RawSub};
use super::reader::{shortened, Given, Reader};
use super::types::Types;
use super::value::{self, Role};
use super::{number, unit};
use crate::diagnostics::{codes, Diagnostic};
use crate::ir::{Access, Binding, Group, GroupKind, Item, ObjectCode, Quantity, Type};

/// Turns the objects of a dictionary into groups, sorted by index. Types that only a name defines are added to `types`.
pub(super) fn build<'a>(
    reader: &mut Reader<'_, '_>,
    types: &mut Types<'_, 'a>,
    mut objects: Vec<RawObject<'a>>,
    subs: &mut [RawSub<'a>],
    units: &[(u32, CompactString)],
) -> Vec<Group> {
    objects.sort_by_key(|object| object.index);
    let mut builder = Builder { types, units };
    let mut groups: Vec<Group> = Vec::with_capacity(objects.len());
    for object in objects {
        let Some(index) = object.index else {
            missing_index(reader, object.origin.span, "this object has no usable index");
            continue;
        };
        if let Some(first) = groups.last().filter(|first| first.index() == Some(index)) {
            let message = format!("object 0x{index:04X} occurs twice");
            reader.diagnostics.push(
                Diagnostic::new(&codes::ESI_DUPLICATE_OBJECT, object.origin.span, message)
                    .label("left out")
                    .note_at(first.origin.span, "this one is used"),
            );
            continue;
        }
        let own = subs.get_mut(object.subs.clone()).unwrap_or_default();
        groups.push(builder.object(reader, index, object, own));
    }
    groups
}

struct Builder<'b, 't, 'a> {
    types: &'b mut Types<'t, 'a>,
    units: &'b [(u32, CompactString)],
}

/// Sub-indices that an object has room for, 0 included.
const SUB_INDICES: u32 = 256;

/// How many sub-indices that occur twice are told of one object.
const MAX_TOLD: usize = 16;

/// A value of an object, as its data type describes it.
pub(super) struct Entry<'t, 'a> {
    sub_index: u8,
    pub ty: Type,
    pub field: &'t RawField<'a>,
    /// The number of the element, where the field is an array.
    pub element: Option<u32>,
}

impl<'t, 'a> Builder<'_, 't, 'a> {
    fn object(
        &mut self,
        reader: &mut Reader<'_, '_>,
        index: u16,
        mut raw: RawObject<'a>,
        subs: &mut [RawSub<'a>],
    ) -> Group {
        let ty = self.object_type(reader, &raw);
        let mut group = Group::object(index, ObjectCode::Var);
        (group.name, group.names, group.name_at) = (raw.name.name(), raw.name.others(), raw.name.span());
        group.documentation = raw.comment.documentation();
        group.origin = raw.origin;
        group.depends_on_slot = raw.depends_on_slot;
        group.depends_on_slot_group = raw.depends_on_slot_group;
        group.described = u32::try_from(subs.len()).unwrap_or(u32::MAX);
        group.extensions = std::mem::take(&mut raw.extensions);
        let code = match self.types.record_of(ty) {
            Some(record) => self.record(reader, &mut group, &raw, ty, record, subs),
            None if subs.is_empty() => {
                group.items.push(self.value(reader, &group, index, &raw, ty));
                ObjectCode::Var
            }
            None => self.untyped(reader, &mut group, &raw, subs),
        };
        let code = match code {
            ObjectCode::Var if index < 0x1000 => ObjectCode::DefType,
            _ if index < 0x1000 => ObjectCode::DefStruct,
            code => code,
        };
        group.kind = GroupKind::Object { index, code, category: raw.flags.category };
        self.access_given(reader, &group, &raw.flags);
        group
    }

    fn object_type(&mut self, reader: &mut Reader<'_, '_>, raw: &RawObject<'_>) -> Type {
        if raw.ty.is_empty() {
            let message = "this object has no type";
            reader.report(&codes::UNRESOLVED_TYPE, raw.origin.span, message, "kept as raw bytes");
            return Type::Opaque(None);
        }
        let ty = self.types.resolve(reader, &raw.ty);
        let size = self.types.bits(ty);
        match (size, raw.bits) {
            (Some(size), Some(bits)) if size != bits && reader.diagnostics.wants(&codes::BIT_SIZE) => {
                let message = format!("BitSize is {bits}, but `{}` has {size} bits", shortened(&raw.ty.text));
                reader.report(&codes::BIT_SIZE, raw.bits_at, message, "the data type is used");
            }
            _ => {}
        }
        ty
    }

    /// An object that is one value.
    fn value(&mut self, reader: &mut Reader<'_, '_>, group: &Group, index: u16, raw: &RawObject<'a>, ty: Type) -> Item {
        let mut item = Item::new(Binding::coe(index, 0));
        item.name = group.name.clone();
        item.names = group.names.clone();
        item.at.name = group.name_at;
        item.origin = raw.origin;
        (item.ty, item.at.ty) = (ty, raw.ty.span);
        self.flags(&mut item, &raw.flags, &raw.flags, None);
        self.info(reader, &mut item, &raw.info, None);
        item
    }

    /// An object of a record type: its entries with what the object says of each.
    fn record(
        &mut self,
        reader: &mut Reader<'_, '_>,
        group: &mut Group,
        raw: &RawObject<'a>,
        ty: Type,
        record: &'t RawType<'a>,
        subs: &mut [RawSub<'a>],
    ) -> ObjectCode {
        let entries = self.entries(reader, raw, ty, record);
        let mut matched = match_up(reader, &entries, subs);
        let mut parts = array_default::take_apart(self.types, &entries, &matched.of_entry, subs);
        group.items.reserve_exact(entries.len() + matched.extra.len());
        let of_object = raw.flags.weight();
        for (position, entry) in entries.iter().enumerate() {
            let sub = matched.of_entry.get(position).copied().flatten().and_then(|at| subs.get_mut(at));
            let described = sub.is_some() || parts.contains_key(&position);
            let cost = (usize::from(!described), entry.field.weight + of_object);
            if !reader.derive(cost, raw.origin.span) {
                break;
            }
            // Filled where it stands: it is too large to be moved about.
            group.items.push(Item::new(Binding::coe(raw.index.unwrap_or(0), entry.sub_index)));
            if let Some(item) = group.items.last_mut() {
                let part = RawInfo { default: parts.remove(&position), more: None };
                self.entry(reader, raw, entry, (sub, part), item);
            }
        }
        matched.extra.sort_unstable();
        self.extra(reader, group, raw, entries.last(), &matched.extra, subs);
        self.keep_whole(raw, group);
        let element = |entry: &Entry<'_, '_>| entry.element.is_some();
        match entries.split_first() {
            Some((first, rest)) if first.sub_index == 0 && !rest.is_empty() && rest.iter().all(element) => {
                ObjectCode::Array
            }
            _ => ObjectCode::Record,
        }
    }

    /// What Info says of a record as a whole.
    fn keep_whole(&self, raw: &RawObject<'a>, group: &mut Group) {
        let more = raw.info.more.as_deref();
        let limits = more.into_iter().flat_map(|more| [("Min", more.min.as_ref()), ("Max", more.max.as_ref())]);
        for (key, value) in [("Default", raw.info.default.as_ref())].into_iter().chain(limits) {
            if let Some(value) = value {
                super::reader::note(key, &value.given, &mut group.extensions);
            }
        }
        if let Some(more) = more {
            super::reader::note("Unit", &more.unit, &mut group.extensions);
            let mut names: Vec<_> = group.names.iter().cloned().collect();
            names.extend(more.display.all().filter(|text| text.text != group.name));
            group.names = names.into();
        }
    }

    /// The entries of an object, each element of an array by itself, sorted by sub-index.
    fn entries(
        &mut self,
        reader: &mut Reader<'_, '_>,
        raw: &RawObject<'_>,
        ty: Type,
        record: &'t RawType<'a>,
    ) -> Vec<Entry<'t, 'a>> {
        let mut entries: Vec<Entry<'t, 'a>> = Vec::with_capacity(record.fields.len());
        let (mut next, mut is_told) = (0u32, false);
        for (position, field) in record.fields.iter().enumerate() {
            let field_type = self.types.field(ty, position);
            let following = record.fields.get(position + 1).and_then(|field| field.sub_index);
            let (first, mut count, mut element) = self.span_of(field, field_type, next, following);
            if count > 1 && first.saturating_add(count) > SUB_INDICES {
                let message = format!("there is no room for the {count} elements of `{}`", shortened(&field.name.text));
                reader.report(&codes::SUB_INDEX_RANGE, raw.origin.span, message, "kept as one value, an array");
                (count, element) = (1, field_type);
            }
            for number in 0..count {
                let Some(sub_index) = first.checked_add(number).and_then(|sub| u8::try_from(sub).ok()) else {
                    // A type may have any number of them, and any number of objects.
                    if !std::mem::replace(&mut is_told, true) {
                        let message = "an object has at most 255 sub-indices besides 0";
                        reader.report(&codes::SUB_INDEX_RANGE, field.origin.span, message, "left out");
                    }
                    break;
                };
                let number = (element != field_type || count > 1).then_some(number + 1);
                entries.push(Entry { sub_index, ty: element, field, element: number });
            }
            next = first.saturating_add(count);
        }
        self.sorted(reader, raw, entries)
    }

    /// The first sub-index of a field, the number of its sub-indices, and their type.
    fn span_of(&self, field: &RawField<'_>, ty: Type, next: u32, following: Option<u16>) -> (u32, u32, Type) {
        let single = |first| (first, 1, ty);
        let given = field.sub_index.map(u32::from);
        let Some((element, lower, count)) = self.types.elements(ty) else { return single(given.unwrap_or(next)) };
        let first = given.unwrap_or_else(|| u32::try_from(lower).unwrap_or(0).max(next));
        // A type of the tables that is called an array is one value, and so is one that leaves no room for its elements.
        let room = following.is_none_or(|following| u32::from(following) >= first.saturating_add(count));
        if field.ty.text.starts_with("ARRAY") || !room {
            return single(first);
        }
        (first, count, element)
    }

    fn sorted(
        &self,
        reader: &mut Reader<'_, '_>,
        raw: &RawObject<'_>,
        mut entries: Vec<Entry<'t, 'a>>,
    ) -> Vec<Entry<'t, 'a>> {
        if entries.is_sorted_by(|one, other| one.sub_index < other.sub_index) {
            return entries;
        }
        entries.sort_by_key(|entry| entry.sub_index);
        let mut told = 0;
        entries.dedup_by(|later, earlier| {
            let twice = later.sub_index == earlier.sub_index;
            told += usize::from(twice);
            if twice && told <= MAX_TOLD {
                let message = format!("sub-index 0x{:02X} occurs twice", later.sub_index);
                reader.diagnostics.push(
                    Diagnostic::new(&codes::ESI_DUPLICATE_OBJECT, later.field.origin.span, message)
                        .label("left out")
                        .note_at(earlier.field.origin.span, "this one is used")
                        .note_at(raw.origin.span, "of this object"),
                );
            }
            twice
        });
        entries
    }

    fn entry(
        &mut self,
        reader: &mut Reader<'_, '_>,
        raw: &RawObject<'a>,
        entry: &Entry<'t, 'a>,
        (sub, part): (Option<&mut RawSub<'a>>, RawInfo<'a>),
        item: &mut Item,
    ) {
        let field = entry.field;
        (item.ty, item.at.ty) = (entry.ty, field.ty.span);
        self.flags(item, &field.flags, &raw.flags, Some(entry.sub_index));
        item.documentation = field.comment.documentation();
        match sub {
            Some(sub) => {
                item.origin = sub.origin;
                item.extensions = std::mem::take(&mut sub.extensions);
                let named = if sub.name.is_empty() { &field.name } else { &sub.name };
                (item.name, item.at.name) = (named.compact(), named.span);
                self.info(reader, item, &sub.info, Some(&field.info));
            }
            None => {
                item.origin = field.origin;
                item.at.name = field.name.span;
                item.name = match entry.element {
                    Some(number) => format_compact!("{} {number}", field.name.text),
                    None => field.name.compact(),
                };
                self.info(reader, item, &part, Some(&field.info));
            }
        }
    }

    /// Sub-items of the object that its data type doesn't have: they follow the others, and are of the last one's type.
    fn extra(
        &mut self,
        reader: &mut Reader<'_, '_>,
        group: &mut Group,
        raw: &RawObject<'a>,
        last: Option<&Entry<'t, 'a>>,
        extra: &[usize],
        subs: &mut [RawSub<'a>],
    ) {
        let mut next = last.map_or(0, |entry| u16::from(entry.sub_index) + 1);
        for &at in extra {
            let Some(sub) = subs.get_mut(at) else { continue };
            let Ok(sub_index) = u8::try_from(next) else {
                let message = "an object has at most 255 sub-indices besides 0";
                reader.report(&codes::SUB_INDEX_RANGE, sub.origin.span, message, "left out");
                continue;
            };
            let message = format!("`{}` is no sub-item of the data type", shortened(&sub.name.text));
            let label = format!("taken as sub-index 0x{sub_index:02X}");
            reader.report(&codes::SUB_ITEM_MISMATCH, sub.name.span.or(sub.origin.span), message, label);
            let ty = last.filter(|entry| entry.sub_index > 0).map_or(Type::Opaque(None), |entry| entry.ty);
            let flags = last.filter(|entry| entry.sub_index > 0).map_or(&raw.flags, |entry| &entry.field.flags);
            if !reader.derive((0, flags.weight() + raw.flags.weight()), sub.origin.span) {
                break;
            }
            let item = self.plain(reader, (raw.index.unwrap_or(0), sub_index), ty, flags, &raw.flags, sub);
            group.items.push(item);
            next += 1;
        }
    }

    /// Sub-items of an object whose type is none of a record: numbered in the order of the file.
    fn untyped(
        &mut self,
        reader: &mut Reader<'_, '_>,
        group: &mut Group,
        raw: &RawObject<'a>,
        subs: &mut [RawSub<'a>],
    ) -> ObjectCode {
        let message = format!("the object has sub-items, but its type `{}` has none", shortened(&raw.ty.text));
        let label = "they are numbered from 0, and kept as raw bytes";
        reader.report(&codes::SUB_ITEM_MISMATCH, raw.ty.span.or(raw.origin.span), message, label);
        for (at, sub) in subs.iter_mut().enumerate() {
            let Ok(sub_index) = u8::try_from(at) else {
                let message = "an object has at most 255 sub-indices besides 0";
                reader.report(&codes::SUB_INDEX_RANGE, sub.origin.span, message, "those from here on are left out");
                break;
            };
            if !reader.derive((0, raw.flags.weight()), sub.origin.span) {
                break;
            }
            // Sub-index 0 is the number of the others wherever there are others.
            let ty = if sub_index == 0 { Type::Unsigned(8) } else { Type::Opaque(None) };
            let item = self.plain(reader, (raw.index.unwrap_or(0), sub_index), ty, &raw.flags, &raw.flags, sub);
            group.items.push(item);
        }
        self.keep_whole(raw, group);
        ObjectCode::Record
    }

    /// An item that no field describes.
    fn plain(
        &mut self,
        reader: &mut Reader<'_, '_>,
        (index, sub_index): (u16, u8),
        ty: Type,
        flags: &Flags,
        object: &Flags,
        sub: &mut RawSub<'a>,
    ) -> Item {
        let mut item = Item::new(Binding::coe(index, sub_index));
        (item.name, item.at.name, item.origin) = (sub.name.compact(), sub.name.span, sub.origin);
        item.ty = ty;
        item.extensions = std::mem::take(&mut sub.extensions);
        self.flags(&mut item, flags, object, Some(sub_index));
        self.info(reader, &mut item, &sub.info, None);
        item
    }

    /// Access and mapping; `sub_index` is that of an entry of a record.
    fn flags(&self, item: &mut Item, own: &Flags, object: &Flags, sub_index: Option<u8>) {
        let (access, at) = own.access_or(object);
        (item.access, item.at.access) = (access.unwrap_or(Access::ReadOnly), at);
        (item.mappable, item.at.mappable) = match sub_index {
            Some(sub_index) => own.mappable_or(object, sub_index),
            None => (own.mappable.unwrap_or_default(), own.mappable_at),
        };
        item.behaviour = own.behaviour_or(object);
    }

    /// Default, limits, unit and name for people: what the object says counts before what the data type says.
    fn info(&mut self, reader: &mut Reader<'_, '_>, item: &mut Item, own: &RawInfo<'a>, of_type: Option<&RawInfo<'a>>) {
        let of_type = of_type.filter(|info| !info.is_empty());
        if own.is_empty() && of_type.is_none() {
            return;
        }
        let base = self.types.underlying(item.ty);
        let default = own.default.as_ref().or_else(|| of_type.and_then(|info| info.default.as_ref()));
        if let Some(raw) = default {
            item.default = value::convert(reader, raw, base, Role::Default);
            item.at.default = raw.given.span;
        }
        let more = [own.more.as_deref(), of_type.and_then(|info| info.more.as_deref())];
        let mut more = more.into_iter().flatten().peekable();
        if more.peek().is_none() {
            return;
        }
        if let Some(raw) = more.clone().find_map(|more| more.min.as_ref()) {
            item.limits.low = value::convert(reader, raw, base, Role::Limit);
            item.at.low = raw.given.span;
        }
        if let Some(raw) = more.clone().find_map(|more| more.max.as_ref()) {
            item.limits.high = value::convert(reader, raw, base, Role::Limit);
            item.at.high = raw.given.span;
        }
        if let Some(given) = more.clone().map(|more| &more.unit).find(|unit| !unit.is_empty()) {
            let unit = self.unit(reader, given);
            item.quantity = Some(Box::new(Quantity { unit, ..Quantity::default() }));
        }
        let display: Vec<_> = more.flat_map(|more| more.display.all()).filter(|text| text.text != item.name).collect();
        if !display.is_empty() {
            item.names = display.into();
        }
    }

    fn unit(&self, reader: &mut Reader<'_, '_>, given: &Given<'_>) -> CompactString {
        let number = number::parse(&given.text).and_then(|number| u32::try_from(number.value).ok());
        match number {
            // A unit of the file's own may have a long name.
            Some(number) => unit::text(number, self.units)
                .filter(|text| reader.derive((0, text.len()), given.span))
                .unwrap_or_else(|| given.compact()),
            None => {
                reader.bad(given, "number of a unit", "kept as it is");
                given.compact()
            }
        }
    }

    /// Reports an object of which nothing says how it may be accessed.
    fn access_given(&self, reader: &mut Reader<'_, '_>, group: &Group, flags: &Flags) {
        if flags.access.is_some() || !reader.diagnostics.wants(&codes::ESI_MISSING_ACCESS) {
            return;
        }
        let silent = group.items.iter().filter(|item| item.at.access.is_empty()).count();
        if silent > 0 {
            let message = "nothing says how this object may be accessed";
            let label = if silent == group.items.len() {
                "read-only".to_owned()
            } else {
                format!("{silent} of its {} sub-indices are read-only", group.items.len())
            };
            reader.report(&codes::ESI_MISSING_ACCESS, group.origin.span, message, label);
        }
    }
}

/// Which sub-item of an object belongs to which entry of its data type.
struct Matched {
    /// The sub-item of each entry.
    of_entry: Vec<Option<usize>>,
    /// Sub-items that belong to none.
    extra: Vec<usize>,
}

/// Matches by name if the names are those of the type and the type has each only once. Matches by position otherwise.
fn match_up(reader: &mut Reader<'_, '_>, entries: &[Entry<'_, '_>], subs: &[RawSub<'_>]) -> Matched {
    let mut matched = Matched { of_entry: vec![None; entries.len()], extra: Vec::new() };
    let named = |entry: &Entry<'_, '_>, sub: &RawSub<'_>| sub.name.text == entry.field.name.text;
    // Elements of an array have no names of their own in the type.
    let fits = |(entry, sub): (&Entry<'_, '_>, &RawSub<'_>)| entry.element.is_some() || named(entry, sub);
    if entries.iter().zip(subs).all(fits) && subs.len() <= entries.len() {
        (0..subs.len()).zip(&mut matched.of_entry).for_each(|(at, place)| *place = Some(at));
        return matched;
    }
    let singles = entries.iter().enumerate().filter(|(_, entry)| entry.element.is_none_or(|number| number == 1));
    let singles: Vec<_> = singles.collect();
    let mut by_name: HashMap<&str, usize> = HashMap::with_capacity(entries.len());
    for &(at, entry) in &singles {
        by_name.entry(entry.field.name.text.as_ref()).or_insert(at);
    }
    if by_name.len() < singles.len() && subs.len() == entries.len() {
        // A repeated name matches several positions.
        return by_position(reader, entries, subs);
    }
    let mut next = 0;
    for (at, sub) in subs.iter().enumerate() {
        let free = |position: &usize| matched.of_entry.get(*position).is_some_and(Option::is_none);
        let by_name = by_name.get(sub.name.text.as_ref()).copied().filter(free);
        let by_place = || Some(at).filter(|_| subs.len() == entries.len()).filter(free);
        let Some(position) = by_name.or_else(by_place).or_else(|| (next..entries.len()).find(free)) else {
            matched.extra.push(at);
            continue;
        };
        next = position + 1;
        if let Some(place) = matched.of_entry.get_mut(position) {
            *place = Some(at);
        }
        let guessed = by_name.is_none() && subs.len() != entries.len();
        if let Some(entry) = entries.get(position).filter(|entry| guessed && entry.element.is_none()) {
            by_place_only(reader, entry, sub);
        }
    }
    matched
}

/// Each sub-item of the object belongs to the entry at the same position.
fn by_position(reader: &mut Reader<'_, '_>, entries: &[Entry<'_, '_>], subs: &[RawSub<'_>]) -> Matched {
    for (entry, sub) in entries.iter().zip(subs) {
        let (name, of_type) = (&sub.name.text, &entry.field.name.text);
        if entry.element.is_none() && name != of_type {
            let message = format!("`{}` is called `{}` in the data type", shortened(name), shortened(of_type));
            let label = format!("read as sub-index 0x{:02X}: the data type has a name twice", entry.sub_index);
            mismatch(reader, entry, sub, message, label);
        }
    }
    Matched { of_entry: (0..subs.len()).map(Some).collect(), extra: Vec::new() }
}

fn by_place_only(reader: &mut Reader<'_, '_>, entry: &Entry<'_, '_>, sub: &RawSub<'_>) {
    let message = format!("the data type has no sub-item called `{}`", shortened(&sub.name.text));
    let label = format!("read as sub-index 0x{:02X}, by its position", entry.sub_index);
    mismatch(reader, entry, sub, message, label);
}

fn mismatch(reader: &mut Reader<'_, '_>, entry: &Entry<'_, '_>, sub: &RawSub<'_>, message: String, label: String) {
    reader.diagnostics.push(
        Diagnostic::new(&codes::SUB_ITEM_MISMATCH, sub.name.span.or(sub.origin.span), message)
            .label(label)
            .note_at(entry.field.name.span.or(entry.field.origin.span), "the sub-item of the data type"),
    );
}
