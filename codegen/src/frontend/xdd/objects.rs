//! Reads the objects and sub-objects of the object list.

use std::collections::BTreeMap;

use super::application::{Application, ParameterKey, View};
use super::attributes::{keys, Attributes};
use super::number::integer;
use super::object_list::{missing_index, Positions};
use super::reader::Reader;
use crate::diagnostics::codes;
use crate::frontend::canopen::number;
use crate::frontend::canopen::object::{self, define_type, ObjectType, Terms};
use crate::frontend::xml::{Given, Read};
use crate::ir::owner::Owner;
use crate::ir::{Category, Device, Extensions, Fact, Group, GroupKind, ObjectCode, Shape, Type, TypeDef, TypeId};
use crate::limits;
use crate::number::{hex16, hex8};
use crate::source::{Origin, Span};
use crate::syntax::xml::{Cursor, Tag};

/// Reads the objects in the order of their indices, and adds them to `device`.
pub(super) fn build<'a>(
    reader: &mut Reader<'a, '_>,
    application: &Application<'a>,
    mut positions: Positions,
    device: &mut Device,
) -> Read<()> {
    positions.sort_by_key(|&(index, _)| index);
    let mut builder = Builder {
        copies_left: reader.cursor.text().len().saturating_mul(limits::MAX_COPIES_PER_BYTE),
        reader,
        application,
        types: std::mem::take(&mut device.types),
        codes: BTreeMap::new(),
        enumerations: BTreeMap::new(),
        copies_exceeded: false,
    };
    device.groups.reserve(positions.len());
    for (at, &(index, origin)) in positions.iter().enumerate() {
        if let Some((_, later)) = positions.get(at + 1).filter(|(other, _)| *other == index) {
            builder.duplicate(later.span, origin.span, &format!("object {}", hex16(index)));
            continue;
        }
        builder.reader.cursor = Cursor::resume(builder.reader.cursor.text(), origin);
        let tag = builder.reader.cursor.root()?;
        let group = builder.object(index, &tag)?;
        builder.codes.extend(define_type(&group, &mut builder.types, builder.reader.diagnostics));
        device.groups.push(group);
    }
    device.types = builder.types;
    Ok(())
}

keys! {
    /// Attributes of an object or sub-object. The discriminant is the position of the attribute in [`Raw::attributes`].
    Key {
        Index = "index",
        Name = "name",
        ObjectType = "objectType",
        DataType = "dataType",
        AccessType = "accessType",
        DefaultValue = "defaultValue",
        PdoMapping = "PDOmapping",
        LowLimit = "lowLimit",
        HighLimit = "highLimit",
        ObjFlags = "objFlags",
        ActualValue = "actualValue",
        Denotation = "denotation",
        UniqueIdRef = "uniqueIDRef",
        SubNumber = "subNumber",
        RangeSelector = "rangeSelector",
    }
}

/// Attributes that describe a single value, and have no meaning for an object whose values are in its sub-objects.
const OF_A_VALUE: [Key; 8] = [
    Key::DataType,
    Key::AccessType,
    Key::DefaultValue,
    Key::PdoMapping,
    Key::LowLimit,
    Key::HighLimit,
    Key::ActualValue,
    Key::Denotation,
];

/// Attributes and texts of an object or sub-object.
pub(super) struct Raw<'a> {
    attributes: Attributes<'a>,
    pub extensions: Extensions,
    pub origin: Origin,
}

impl<'a> Raw<'a> {
    /// Returns the attribute `key`, or `None` if it is missing.
    pub fn get(&self, key: Key) -> Option<&Given<'a>> {
        self.attributes.get(key as u8)
    }

    fn object_type(&self) -> Option<ObjectType<'_>> {
        let Given { text, span } = self.get(Key::ObjectType)?;
        Some(ObjectType { text, code: number::parse(text, &[]).int().and_then(ObjectCode::from_number), span: *span })
    }

    /// Returns the span of the attribute `key`, or of the element if the attribute is missing.
    pub fn span(&self, key: Key) -> Span {
        self.get(key).map_or(self.origin.span, |given| given.span)
    }
}

const TERMS: Terms = Terms {
    sub_number: "subNumber",
    sub_object: "sub-object",
    elements: "sub-objects",
    records: "write `objectType=\"9\"` for a RECORD, `objectType=\"8\"` for an ARRAY",
};

fn is_var(raw: &Raw<'_>) -> bool {
    raw.object_type().is_none_or(|given| given.code == Some(ObjectCode::Var))
}

/// Builds the groups of a device from its objects.
pub(super) struct Builder<'a, 'd, 'p> {
    pub reader: &'p mut Reader<'a, 'd>,
    pub application: &'p Application<'a>,
    /// Types of the device, starting with those of the application process.
    pub types: Vec<TypeDef>,
    /// Types that objects define, by the index of the object.
    pub codes: BTreeMap<u32, Type>,
    /// Enumerations of allowed values, by the position of their parameter.
    pub enumerations: BTreeMap<usize, TypeId>,
    copies_left: usize,
    copies_exceeded: bool,
}

impl<'a, 'p> Builder<'a, '_, 'p> {
    /// Reads the attributes of an object or sub-object, and calls `child` for each child element. `index` is the name of the
    /// attribute that contains the index or sub-index.
    fn raw(
        &mut self,
        tag: &Tag<'a>,
        index: &'static str,
        mut child: impl FnMut(&mut Self, &Tag<'a>) -> Read<()>,
    ) -> Read<Raw<'a>> {
        let start = self.reader.extensions.len();
        let origin = self.reader.origin(tag);
        let mut names = Key::NAMES;
        names[Key::Index as usize] = index;
        let mut values = self.reader.attributes(tag, names)?;
        self.reader.note("rangeSelector", &values[Key::RangeSelector as usize]);
        while let Some(tag) = self.reader.child(tag)? {
            child(self, &tag)?;
        }
        Ok(Raw { attributes: Attributes::take(&mut values), extensions: self.reader.extensions_since(start), origin })
    }

    fn object(&mut self, index: u16, tag: &Tag<'a>) -> Read<Group> {
        let mut subs: BTreeMap<u8, Raw<'a>> = BTreeMap::new();
        let mut raw = self.raw(tag, "index", |builder, child| match child.name {
            "CANopenSubObject" => builder.sub_object(child, &mut subs),
            _ => builder.reader.unknown(child),
        })?;
        let view = self.view(&raw);
        let mut group = Group::object(index, ObjectCode::Record);
        group.origin = raw.origin;
        self.name(&raw, &view, &mut group.name, &mut group.name_at);
        let (given, span) = (raw.object_type(), raw.span(Key::ObjectType));
        let has_subs = !subs.is_empty();
        let code = object::object_code(index, given.as_ref(), span, has_subs, &TERMS, self.reader.diagnostics);
        group.origins.set(Fact::ObjectType, object::code_origin(given.as_ref(), code));
        group.kind = GroupKind::Object { index, code, category: self.category(&view) };
        group.extensions.append(&mut raw.extensions);
        group.extensions.extend(view.extensions().cloned());
        group.names = view.labels_except(&group.name);
        if code.has_subs() || (!subs.is_empty() && code != ObjectCode::Var) {
            group.documentation = view.documentation();
            self.subs(&mut group, index, &raw, &view, subs);
        } else {
            self.unused(&raw, &[Key::SubNumber], &mut group.extensions);
            let mut item = self.item(index, 0, &raw, &view, code, None);
            item.name = group.name.clone();
            item.at.name = group.name_at;
            item.names = group.names.clone();
            item.documentation = view.documentation();
            group.items = vec![item];
        }
        Ok(group)
    }

    fn sub_object(&mut self, tag: &Tag<'a>, subs: &mut BTreeMap<u8, Raw<'a>>) -> Read<()> {
        let raw = self.raw(tag, "subIndex", |builder, child| builder.reader.unknown(child))?;
        let Some(sub) = raw.get(Key::Index).and_then(|given| self.reader.hex(given, 0xFF, "sub-index")) else {
            missing_index(self.reader, tag, "this sub-object has no sub-index");
            return Ok(());
        };
        let later = raw.origin.span;
        if let Some(earlier) = subs.insert(sub as u8, raw) {
            self.duplicate(later, earlier.origin.span, &format!("sub-index {}", hex8(sub)));
        }
        Ok(())
    }

    fn subs(
        &mut self,
        group: &mut Group,
        index: u16,
        object: &Raw<'a>,
        parent: &View<'p, 'a>,
        subs: BTreeMap<u8, Raw<'a>>,
    ) {
        group.items.reserve_exact(subs.len());
        let count = subs.len();
        let whole = parent.find(|parameter| parameter.ty.as_ref());
        let whole = whole.map(|ty| self.application.resolve(self.reader, ty));
        let first = subs.keys().next().copied();
        for (position, (sub, mut raw)) in subs.into_iter().enumerate() {
            let view = self.view(&raw);
            let code = self.sub_code(&raw);
            let component = whole.and_then(|ty| self.component(ty, sub, position, count));
            let mut item = self.item(index, sub, &raw, &view, code, Some((parent, component)));
            self.name(&raw, &view, &mut item.name, &mut item.at.name);
            item.names = view.labels_except(&item.name);
            item.documentation = view.documentation();
            self.unused(&raw, &[Key::SubNumber], &mut item.extensions);
            item.extensions.append(&mut raw.extensions);
            item.extensions.extend(view.extensions().cloned());
            self.note_field(&view, sub);
            group.items.push(item);
        }
        let is_record = group.object_code() == Some(ObjectCode::Record);
        if is_record && object.get(Key::DataType).is_some() && first != Some(0) && is_var(object) {
            self.value_of_var(group, index, object, parent);
        } else {
            group.flags = self.flags(object);
            self.unused(object, &OF_A_VALUE, &mut group.extensions);
        }
        self.sub_number(group, object);
    }

    /// Adds sub-index 0 to a VAR that has other sub-objects, but no sub-index 0. The new sub-object contains the value
    /// of the VAR.
    fn value_of_var(&mut self, group: &mut Group, index: u16, raw: &Raw<'a>, view: &View<'p, 'a>) {
        let mut item = self.item(index, 0, raw, view, ObjectCode::Var, None);
        item.name = group.name.clone();
        item.at.name = group.name_at;
        group.items.insert(0, item);
    }

    /// Reports attributes that have no meaning for the object, and stores them as extensions. Ignores a PDO mapping of
    /// `no` and a count of `0`.
    fn unused(&mut self, raw: &Raw<'a>, keys: &[Key], extensions: &mut Extensions) {
        for &key in keys {
            let Some(given) = raw.get(key) else { continue };
            if matches!(given.text.as_ref(), "no" | "0") && matches!(key, Key::PdoMapping | Key::SubNumber) {
                continue;
            }
            let name = Key::NAMES[key as usize];
            if self.reader.diagnostics.wants(&codes::NOT_ALLOWED_ENTRY) {
                let message = format!("{name} has no meaning for this object");
                self.reader.report(&codes::NOT_ALLOWED_ENTRY, given.span, message, "kept as an extension attribute");
            }
            extensions.extend(given.extension(name));
        }
    }

    /// Returns the object code of a sub-object, or VAR if the sub-object has none.
    fn sub_code(&mut self, raw: &Raw<'a>) -> ObjectCode {
        let given = raw.object_type();
        given.map_or(ObjectCode::Var, |given| given.of_sub_index(&TERMS, self.reader.diagnostics))
    }

    /// Returns the parameter to which an object refers. Returns no parameter if the limit for copies is exceeded.
    fn view(&mut self, raw: &Raw<'a>) -> View<'p, 'a> {
        let application = self.application;
        let view = application.view(self.reader, raw.get(Key::UniqueIdRef));
        if self.charge(view.weight(), raw.span(Key::UniqueIdRef)) {
            view
        } else {
            View::NONE
        }
    }

    /// Subtracts `weight` bytes from the budget for copies of the application process. Returns false if the budget is
    /// too small. Only the first excess of the budget is reported.
    pub(super) fn charge(&mut self, weight: usize, span: Span) -> bool {
        if let Some(left) = self.copies_left.checked_sub(weight) {
            self.copies_left = left;
            return true;
        }
        if !std::mem::replace(&mut self.copies_exceeded, true) {
            let message = "copies of parameters would exceed the size limit of the description";
            self.reader.report(&codes::INPUT_TOO_LARGE, span, message, "further references are ignored");
        }
        false
    }

    fn name(&mut self, raw: &Raw<'a>, view: &View<'p, 'a>, name: &mut crate::ir::CompactString, at: &mut Span) {
        match raw.get(Key::Name) {
            Some(given) => (*name, *at) = (given.text.as_ref().into(), given.span),
            None => *name = view.name(),
        }
    }

    fn category(&mut self, view: &View<'p, 'a>) -> Option<Category> {
        let given = view.get(ParameterKey::Support)?;
        match given.text.as_ref() {
            "mandatory" => Some(Category::Mandatory),
            "optional" => Some(Category::Optional),
            "conditional" => Some(Category::Conditional),
            _ => {
                self.reader.bad(given, "value of support", "left out; expected mandatory, optional or conditional");
                None
            }
        }
    }

    /// Returns the hexadecimal number in the attribute `objFlags`, or 0 if the attribute is missing or invalid.
    pub(super) fn flags(&mut self, raw: &Raw<'a>) -> u32 {
        raw.get(Key::ObjFlags).and_then(|given| self.reader.hex(given, u32::MAX, "value of objFlags")).unwrap_or(0)
    }

    /// Returns the type of a sub-object, if the type of its object defines the sub-object.
    fn component(&self, whole: Type, sub: u8, position: usize, count: usize) -> Option<Type> {
        let Type::Named(TypeId(at)) = Owner::of_types(&self.types).basic(whole) else { return None };
        match &self.types.get(at as usize)?.shape {
            Shape::Array { element, .. } => (sub > 0).then_some(*element),
            Shape::Record(fields) if fields.len() == count => fields.get(position).map(|field| field.ty),
            _ => None,
        }
    }

    /// Sets the sub-index of a structure field to that of the sub-object that refers to the field.
    fn note_field(&mut self, view: &View<'p, 'a>, sub: u8) {
        let Some((structure, field)) = view.parameter.and_then(|parameter| parameter.field) else { return };
        if let Some(Shape::Record(fields)) = self.types.get_mut(structure).map(|def| &mut def.shape) {
            if let Some(field) = fields.get_mut(field) {
                field.sub_index = Some(u16::from(sub));
            }
        }
    }

    fn sub_number(&mut self, group: &Group, raw: &Raw<'a>) {
        let Some(given) = raw.get(Key::SubNumber) else { return };
        let announced = integer(&given.text).unwrap_or(-1);
        object::sub_number(group, announced, &given.text, given.span, &TERMS, self.reader.diagnostics);
    }

    fn duplicate(&mut self, later: Span, earlier: Span, what: &str) {
        let found = codes::DUPLICATE_OBJECT.at(later, format!("{what} occurs twice")).label("this element is used");
        self.reader.diagnostics.push(found.note_at(earlier, "this element is ignored"));
    }
}
