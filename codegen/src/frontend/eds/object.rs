//! Converts the sections of an object to a [`Group`] with its items.

use super::compact;
use super::keywords::{Key, Raw, OF_A_CONFIGURATION, OF_A_VALUE, OF_MANY_VALUES};
use super::lists;
use super::reader::{Fixed, Reader};
use super::sections::Refinement;
use crate::diagnostics::codes;
use crate::frontend::canopen::number;
use crate::frontend::canopen::object::{self, ObjectType, Terms};
use crate::frontend::canopen::value::Role;
use crate::ir::{
    Access, Behavior, Binding, CompactString, Configured, Extension, Extensions, Fact, FactOrigin, Group, Item,
    Mappable, ObjectCode, Rule, Srdo, Type, Value,
};
use crate::source::{Origin, Span};
use crate::syntax::ini::{Entry, Section};

const TERMS: Terms = Terms {
    sub_number: "SubNumber",
    sub_object: "sub-index",
    elements: "sections",
    records: "write `ObjectType=0x9` for a RECORD, `ObjectType=0x8` for an ARRAY",
};

/// Sections of an object, collected from the whole file.
#[derive(Default)]
pub(super) struct ObjectSections {
    /// Section `[xxxx]`, or several such sections if the file repeats the section.
    pub object: Vec<Section>,
    /// Sections `[xxxxsubN]`, each with its sub-index.
    pub subs: Vec<(u8, Section)>,
    /// Sections `[xxxxName]`, `[xxxxValue]` and `[xxxxDenotation]`.
    pub refinements: Vec<(Refinement, Section)>,
    /// Section `[xxxxObjectLinks]`.
    pub links: Vec<Section>,
}

impl ObjectSections {
    pub(super) fn clear(&mut self) {
        self.object.clear();
        self.subs.clear();
        self.refinements.clear();
        self.links.clear();
    }
}

impl<'a> Reader<'a, '_> {
    /// Builds the object `index` from its sections.
    pub(super) fn object(&mut self, index: u16, sections: &mut ObjectSections) -> Option<Group> {
        if sections.object.is_empty() && sections.subs.is_empty() {
            self.refinement_without_object(index, sections);
            return None;
        }
        self.duplicate_sections(&sections.object);
        let mut raw = Raw::new();
        self.assign(&sections.object, &[], &mut raw);
        let orphan = sections.object.is_empty();
        let mut group = Group::object(index, ObjectCode::Record);
        group.origin = raw.origin;
        if orphan {
            let (sub, first) = sections.subs[0];
            group.origin = Origin { span: self.doc.name_span(&first), line: first.line };
            let found = codes::ORPHAN_SUB
                .at(
                    group.origin.span,
                    format!("the section [{index:04X}sub{sub:X}] belongs to an object that the file does not describe"),
                )
                .label(format!("the section [{index:04X}] is missing; read as part of a RECORD"));
            self.diagnostics.push(found.help("add the section of the object, with ObjectType and SubNumber"));
        }
        self.name(raw.get(Key::ParameterName), &mut group.name, &mut group.name_at);
        let compact = self.compact_count(&raw);
        let code = if orphan {
            group.origins.set(Fact::ObjectType, Some(FactOrigin::Rule(Rule::ObjectContents)));
            ObjectCode::Record
        } else {
            self.object_code(index, &raw, !sections.subs.is_empty() || compact.is_some(), &mut group)
        };
        self.take_comments(&mut group.extensions);
        self.fill(&mut group, index, code, &mut raw, sections, compact);
        self.links(&mut group, &sections.links);
        in_order_of_file(&mut group.extensions);
        Some(group)
    }

    fn fill(
        &mut self,
        group: &mut Group,
        index: u16,
        code: ObjectCode,
        raw: &mut Raw,
        sections: &ObjectSections,
        compact: Option<u8>,
    ) {
        group.kind = crate::ir::GroupKind::Object { index, code, category: None };
        group.extensions.append(&mut raw.extensions);
        if code.has_subs() || (!sections.subs.is_empty() && code != ObjectCode::Var) {
            self.subs(group, index, &sections.subs);
            let has_value = code == ObjectCode::Record && raw.get(Key::DataType).is_some() && group.sub(0).is_none();
            if has_value && compact.is_none() && self.is_var(raw) {
                self.value_of_var(group, index, raw);
            } else if compact.is_none() {
                group.flags = self.flags(raw);
                self.unused(raw, &OF_A_VALUE, &mut group.extensions);
            }
            self.sub_number(group, raw, compact);
            if let Some(count) = compact {
                compact::expand(self, group, raw, count);
            }
            self.take_comments(&mut group.extensions);
        } else {
            self.unused(raw, &OF_MANY_VALUES, &mut group.extensions);
            let mut item = Item::new(Binding::canopen(index, 0));
            self.describe(&mut item, raw, code);
            item.name = group.name.clone();
            item.at.name = group.name_at;
            // An object without sub-indices has a single section, so the remaining entries of this section are
            // extensions of the object.
            group.extensions.append(&mut item.extensions);
            group.items = vec![item];
        }
        self.duplicate_refinements(&sections.refinements);
        compact::refine(self, group, index, &sections.refinements);
    }

    /// Reports entries that have no meaning for the object, and stores them as extensions. Ignores empty entries, and
    /// counts and flags of 0.
    pub(super) fn unused(&mut self, raw: &Raw, keys: &[Key], extensions: &mut Extensions) {
        for &key in keys {
            let Some(entry) = raw.get(key) else { continue };
            let (text, span) = (self.doc.value(entry), self.doc.value_span(entry));
            let is_count_or_flag = matches!(key, Key::SubNumber | Key::CompactSubObj | Key::PdoMapping);
            if text.is_empty() || is_count_or_flag && self.peek_number(Some(entry)) == Some(0) {
                continue;
            }
            if self.diagnostics.wants(&codes::NOT_ALLOWED_ENTRY) {
                let message = format!("{} has no meaning for this object", self.doc.key(entry));
                let found = codes::NOT_ALLOWED_ENTRY.at(self.doc.key_span(entry), message);
                self.diagnostics.push(found.label("kept as an extension attribute"));
            }
            extensions.push(Extension { key: self.doc.key(entry).into(), value: text.into(), span });
        }
    }

    fn duplicate_refinements(&mut self, refinements: &[(Refinement, Section)]) {
        if refinements.len() < 2 {
            return;
        }
        for kind in [Refinement::Name, Refinement::Value, Refinement::Denotation] {
            let same = refinements.iter().filter(|(other, _)| *other == kind).map(|&(_, section)| section);
            self.duplicate_sections(&same.collect::<Vec<_>>());
        }
    }

    fn is_var(&self, raw: &Raw) -> bool {
        self.peek_number(raw.get(Key::ObjectType)).is_none_or(|code| code == 7)
    }

    /// Adds sub-index 0 to a VAR that has other sub-indices, but no sub-index 0. The new sub-index contains the value
    /// of the VAR.
    fn value_of_var(&mut self, group: &mut Group, index: u16, raw: &Raw) {
        let mut item = Item::new(Binding::canopen(index, 0));
        self.describe(&mut item, raw, ObjectCode::Var);
        item.name = group.name.clone();
        item.at.name = group.name_at;
        group.items.insert(0, item);
    }

    fn subs(&mut self, group: &mut Group, index: u16, subs: &[(u8, Section)]) {
        group.items.reserve_exact(subs.len());
        let mut rest = subs;
        while let Some(&(sub, _)) = rest.first() {
            let count = rest.iter().take_while(|(other, _)| *other == sub).count();
            let repeated: Vec<Section>;
            let same = if count == 1 {
                std::slice::from_ref(&rest[0].1)
            } else {
                repeated = rest[..count].iter().map(|(_, section)| *section).collect();
                self.duplicate_sections(&repeated);
                &repeated
            };
            let mut raw = Raw::new();
            self.assign(same, &[], &mut raw);
            let code = self.sub_code(&raw);
            // An item that is filled in its list is not copied.
            let position = group.items.len();
            group.items.push(Item::new(Binding::canopen(index, sub)));
            let item = &mut group.items[position];
            item.extensions = std::mem::take(&mut raw.extensions);
            self.describe(item, &raw, code);
            self.name(raw.get(Key::ParameterName), &mut item.name, &mut item.at.name);
            self.unused(&raw, &OF_MANY_VALUES, &mut item.extensions);
            in_order_of_file(&mut item.extensions);
            rest = &rest[count..];
        }
    }

    /// Returns the object type, or `None` if it is missing.
    #[inline]
    fn object_type(&mut self, raw: &Raw) -> Option<ObjectType<'a>> {
        let entry = raw.get(Key::ObjectType)?;
        if let Some(number) = self.plain(entry) {
            let (text, span) = (self.doc.value(entry), self.doc.value_span(entry));
            return Some(ObjectType { text, code: ObjectCode::from_number(number.into()), span });
        }
        let (text, span) = self.fixed(entry, Fixed::Number);
        if text.is_empty() {
            return None;
        }
        let number = number::parse(text, &[]);
        self.converter().quirk(number, text, span);
        Some(ObjectType { text, code: number.int().and_then(ObjectCode::from_number), span })
    }

    /// Returns the object code of a sub-index.
    pub(super) fn sub_code(&mut self, raw: &Raw) -> ObjectCode {
        let given = self.object_type(raw);
        given.map_or(ObjectCode::Var, |given| given.of_sub_index(&TERMS, self.diagnostics))
    }

    /// Returns the object code of an object, and records its origin in `group`.
    fn object_code(&mut self, index: u16, raw: &Raw, has_subs: bool, group: &mut Group) -> ObjectCode {
        let given = self.object_type(raw);
        let span = raw.get(Key::ObjectType).map_or(raw.origin.span, |entry| self.doc.value_span(entry));
        let code = object::object_code(index, given.as_ref(), span, has_subs, &TERMS, self.diagnostics);
        group.origins.set(Fact::ObjectType, object::code_origin(given.as_ref(), code));
        code
    }

    /// Adds the entries of a VAR, DOMAIN or sub-index to an item. The caller sets the name.
    pub(super) fn describe(&mut self, item: &mut Item, raw: &Raw, code: ObjectCode) {
        item.origin = raw.origin;
        let ty = self.data_type(raw, code, item);
        item.ty = ty.unwrap_or(Type::Opaque(None));
        item.access = self.access(raw, code, item);
        if ty.is_none() {
            object::without_type(item);
        }
        item.mappable = self.mappable(raw.get(Key::PdoMapping), item.access, item);
        item.default = self.typed(raw.get(Key::DefaultValue), item.ty, Role::Value);
        item.at.default = self.span_of(raw.get(Key::DefaultValue));
        // Limits are allocated when they are written, so an empty entry must not write any.
        if let Some(entry) = raw.get(Key::LowLimit) {
            if let Some(low) = self.typed(Some(entry), item.ty, Role::Limit) {
                item.limits.low = Some(low);
            }
            item.at.others.low = self.doc.value_span(entry);
        }
        if let Some(entry) = raw.get(Key::HighLimit) {
            if let Some(high) = self.typed(Some(entry), item.ty, Role::Limit) {
                item.limits.high = Some(high);
            }
            item.at.others.high = self.doc.value_span(entry);
        }
        item.flags = self.flags(raw);
        item.behavior = self.srdo(raw).map(|srdo| Box::new(Behavior { srdo: Some(srdo), ..Behavior::default() }));
        self.configured(raw, item);
        self.take_comments(&mut item.extensions);
        item.extensions.shrink_to_fit();
    }

    /// Adds the DCF entries to an item: configured value, denotation and file names.
    fn configured(&mut self, raw: &Raw, item: &mut Item) {
        if OF_A_CONFIGURATION.iter().all(|&key| raw.get(key).is_none()) {
            return;
        }
        if let Some(entry) = raw.get(Key::ParameterValue) {
            item.at.others.configured = self.doc.value_span(entry);
        }
        let value = self.typed(raw.get(Key::ParameterValue), item.ty, Role::Value);
        let text = |key| raw.get(key).map(|entry| self.doc.value(entry)).filter(|text| !text.is_empty());
        let configured = Configured {
            value,
            denotation: text(Key::Denotation).map(CompactString::from),
            upload_file: text(Key::UploadFile).map(CompactString::from),
            download_file: text(Key::DownloadFile).map(CompactString::from),
        };
        if configured != Configured::default() {
            item.configured = Some(Box::new(configured));
        }
    }

    /// Converts the text of an entry to a value of type `ty`. A comment after the value is removed, except from texts,
    /// DOMAIN values and values without a basic type. Returns `None` if the entry is missing or empty.
    // Most values are plain integers. Inlined, they are not copied through memory.
    #[inline(always)]
    pub(super) fn typed(&mut self, entry: Option<&Entry>, ty: Type, role: Role) -> Option<Value> {
        let entry = entry?;
        let text = self.doc.value(entry);
        self.converter().plain_integer(text, ty).or_else(|| self.converted(entry, ty, role))
    }

    /// Converts a text as [`typed`](Self::typed) does, for values of any form.
    #[inline(never)]
    fn converted(&mut self, entry: &Entry, ty: Type, role: Role) -> Option<Value> {
        let (text, span) = match ty {
            Type::VisibleString(_) | Type::UnicodeString(_) | Type::Domain | Type::Opaque(_) | Type::Named(_) => {
                (self.doc.value(entry), self.doc.value_span(entry))
            }
            _ => self.fixed(entry, Fixed::Number),
        };
        self.converter().value(text, span, ty, role)
    }

    /// Returns the data type of an object or sub-index. Returns `None` and reports the data type if it is not a number,
    /// or if it is missing and the value needs one.
    fn data_type(&mut self, raw: &Raw, code: ObjectCode, item: &mut Item) -> Option<Type> {
        let entry = raw.get(Key::DataType);
        let plain = entry.and_then(|entry| self.plain(entry)).and_then(|number| u32::try_from(number).ok());
        if let Some(number) = plain {
            item.at.ty = self.span_of(entry);
            return Some(self.type_by_code(number, item.at.ty));
        }
        let (text, span) = entry.map_or(("", raw.origin.span), |entry| self.fixed(entry, Fixed::Number));
        item.at.ty = span;
        if text.is_empty() {
            return self.no_data_type(code, span);
        }
        // The converter reports a text that is not a number.
        match self.converter().number(text, span)?.as_int().and_then(|number| u32::try_from(number).ok()) {
            Some(number) => Some(self.type_by_code(number, span)),
            None => {
                let message = format!("`{text}` is not the code of a data type");
                let found = codes::UNKNOWN_DATA_TYPE.at(span, message).label("kept as read-only raw bytes");
                self.diagnostics.push(found.help("write the code of a basic type, such as 0x0007 for UNSIGNED32"));
                None
            }
        }
    }

    fn no_data_type(&mut self, code: ObjectCode, span: Span) -> Option<Type> {
        let (kind, message) = match code {
            ObjectCode::Domain => return Some(Type::Domain),
            ObjectCode::DefType | ObjectCode::DefStruct | ObjectCode::Null => return Some(Type::Opaque(None)),
            ObjectCode::Array => (&codes::COMPACT_WITHOUT_TYPE, "the object has CompactSubObj, but no DataType"),
            _ => (&codes::MISSING_DATA_TYPE, "DataType is missing"),
        };
        let found = kind.at(span, message).label("kept as read-only raw bytes");
        self.diagnostics
            .push(found.help("add a DataType with the code of a basic type, such as `DataType=0x0007` for UNSIGNED32"));
        None
    }

    fn type_by_code(&mut self, code: u32, span: Span) -> Type {
        let position = self.types.binary_search_by_key(&code, |&(known, _)| known);
        object::type_by_code(code, span, position.ok().map(|at| self.types[at].1), self.diagnostics)
    }

    fn access(&mut self, raw: &Raw, code: ObjectCode, item: &mut Item) -> Access {
        let (text, span) = match raw.get(Key::AccessType) {
            Some(entry) => self.fixed(entry, Fixed::Number),
            None => ("", raw.origin.span),
        };
        item.at.access = span;
        if text.is_empty() {
            item.origins.set(Fact::Access, Some(FactOrigin::Rule(Rule::MissingKey)));
            return match code {
                ObjectCode::Domain => Access::ReadWrite,
                ObjectCode::DefType | ObjectCode::DefStruct | ObjectCode::Null => Access::ReadOnly,
                _ => {
                    let message = "AccessType is missing";
                    self.report(&codes::MISSING_ACCESS, span, message, "kept read-only");
                    Access::ReadOnly
                }
            };
        }
        object::access(text, span, self.diagnostics)
    }

    fn mappable(&mut self, entry: Option<&Entry>, access: Access, item: &mut Item) -> Mappable {
        let Some(entry) = entry else { return Mappable::default() };
        item.at.mappable = self.doc.value_span(entry);
        if self.flag(entry) {
            Mappable::by_access(access)
        } else {
            Mappable::default()
        }
    }

    fn flags(&mut self, raw: &Raw) -> u32 {
        let Some(entry) = raw.get(Key::ObjFlags) else { return 0 };
        self.u32_of(entry).unwrap_or(0)
    }

    fn srdo(&mut self, raw: &Raw) -> Option<Srdo> {
        let is_mappable = raw.get(Key::SrdoMapping).is_some_and(|entry| self.flag(entry));
        let inverted = raw.get(Key::InvertedSrad).and_then(|entry| self.unsigned(entry, 0xFF_FFFF));
        is_mappable.then(|| Srdo { inverted: inverted.map(|address| ((address >> 8) as u16, address as u8)) })
    }

    /// Returns the number of sub-indices that CompactSubObj declares. Reports a number above 254, and returns 254.
    /// Returns `None` if the entry is missing, unreadable, negative or 0.
    fn compact_count(&mut self, raw: &Raw) -> Option<u8> {
        let entry = raw.get(Key::CompactSubObj)?;
        let (text, span) = self.fixed(entry, Fixed::Number);
        if text.is_empty() {
            return None;
        }
        let count = self.converter().number(text, span)?.as_int().unwrap_or(-1);
        if !(0..=254).contains(&count) {
            let message = format!("CompactSubObj is {text}, expected a number from 0 to 254");
            let label = if count > 0 { "read as 254" } else { "left out" };
            self.diagnostics.push(codes::VALUE_NOT_ALLOWED.at(span, message).label(label));
        }
        (count > 0).then(|| count.min(254) as u8)
    }

    fn sub_number(&mut self, group: &Group, raw: &Raw, compact: Option<u8>) {
        let Some(entry) = raw.get(Key::SubNumber) else { return self.no_sub_number(raw, compact) };
        let (text, span) = self.fixed(entry, Fixed::Number);
        if text.is_empty() {
            return self.no_sub_number(raw, compact);
        }
        let Some(announced) = self.converter().number(text, span) else { return };
        let announced = announced.as_int().unwrap_or(-1);
        if compact.is_some() {
            if announced > 0 {
                let found = codes::COMPACT_AND_SUBS.at(span, "the object has both SubNumber and CompactSubObj");
                self.diagnostics.push(found.label("described sub-indices are kept; CompactSubObj adds the others"));
            }
        } else {
            object::sub_number(group, announced, announced, span, &TERMS, self.diagnostics);
        }
    }

    fn no_sub_number(&mut self, raw: &Raw, compact: Option<u8>) {
        if compact.is_none() && raw.origin.line > 0 && self.diagnostics.wants(&codes::MISSING_ENTRY) {
            let message = "both SubNumber and CompactSubObj are missing";
            self.diagnostics.push(codes::MISSING_ENTRY.at(raw.origin.span, message));
        }
    }

    fn links(&mut self, group: &mut Group, sections: &[Section]) {
        self.duplicate_sections(sections);
        for entry in lists::numbered(self, sections, "ObjectLinks", &mut group.extensions) {
            if let Some(index) = self.index_of(&entry) {
                group.links.push(index);
                self.link_spans.push((index, self.doc.value_span(&entry)));
            }
        }
        self.take_comments(&mut group.extensions);
    }

    fn refinement_without_object(&mut self, index: u16, sections: &ObjectSections) {
        let all = sections.refinements.iter().map(|(_, section)| section).chain(&sections.links);
        for section in all {
            let span = self.doc.name_span(section);
            let name = self.doc.name(section);
            let message = format!("the section [{name}] belongs to an object that the file does not describe");
            let found = codes::NAME_WITHOUT_SUB.at(span, message);
            self.diagnostics
                .push(found.label(format!("the section [{index:04X}] is missing; kept as extension attributes")));
            self.orphan_sections.push(*section);
        }
    }
}

/// Sorts extensions, which were collected by kind, by their position in the file.
pub(super) fn in_order_of_file(extensions: &mut [Extension]) {
    extensions.sort_by_key(|extension| extension.span.start);
}
