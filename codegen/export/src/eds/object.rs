//! Writes objects and their entries.

use std::collections::HashMap;

use super::compact;
use super::data_type::{data_type, DataType};
use super::losses;
use super::note::{NoteKind, Subject};
use super::section::indices;
use super::value::{self, Form, Role};
use super::writer::Writer;
use super::{Context, Flavor};
use lexibus_codegen::ir::{
    Access, Bus, Configured, Extension, Group, Item, Mappable, ObjectCode, Type, TypeDef, Value,
};

/// Writes the sections of `objects`.
pub(super) fn all<'g>(writer: &mut Writer, context: &Context<'_>, objects: impl Iterator<Item = &'g &'g Group>) {
    for group in objects {
        object(writer, context, group, "", &context.device.types);
    }
}

/// Writes the sections of an object. `before` is a prefix of the section names, such as `M1Fixed` for a module.
pub(super) fn object(writer: &mut Writer, context: &Context<'_>, group: &Group, before: &str, types: &[TypeDef]) {
    let (Some(index), Some(code)) = (group.index(), group.object_code()) else { return };
    let out = Object { context, group, index, code, before, types };
    losses::of_object(context, group, &mut writer.notes);
    writer.section(format_args!("{before}{index:04X}"));
    writer.name("ParameterName", &group.name, Subject::Object(index));
    writer.entry("ObjectType", format_args!("{:#X}", number(code)));
    let refinements = out.refinements_of_missing();
    let can_be_compact = refinements.is_empty() && before.is_empty();
    match (out.single_value(), compact::elements(group).filter(|_| can_be_compact)) {
        (Some(item), _) => out.single(writer, item),
        (None, Some(elements)) => out.compact(writer, &elements),
        (None, None) => out.entries(writer),
    }
    out.refinements(writer, refinements);
    if !group.links.is_empty() {
        writer.section(format_args!("{before}{index:04X}ObjectLinks"));
        indices(writer, "ObjectLinks", group.links.len(), group.links.iter().copied());
    }
}

/// Returns the number that CiA 301 7.4.3 assigns to an object code.
fn number(code: ObjectCode) -> i128 {
    (0..=9).find(|number| ObjectCode::from_number(*number) == Some(code)).unwrap_or_default()
}

/// An object that is being written.
pub(super) struct Object<'a> {
    context: &'a Context<'a>,
    group: &'a Group,
    index: u16,
    code: ObjectCode,
    before: &'a str,
    types: &'a [TypeDef],
}

impl<'a> Object<'a> {
    /// Returns the only value of an object without sub-indices. Returns `None` if the object has sub-indices, or if
    /// sub-index 0 has a separate section.
    fn single_value(&self) -> Option<&'a Item> {
        let [item] = self.group.items.as_slice() else { return None };
        let is_alone = item.object().is_some_and(|(_, sub)| sub == 0) && !self.code.has_subs();
        // If an object other than a VAR has flags, or if its name differs from that of its value, the source has a
        // separate section for sub-index 0.
        let is_the_object = item.name == self.group.name && self.group.flags == 0;
        (is_alone && (is_the_object || self.code == ObjectCode::Var)).then_some(item)
    }

    fn single(&self, writer: &mut Writer, item: &Item) {
        let subject = Subject::Object(self.index);
        writer.notes.add_many(NoteKind::Name, item.name != self.group.name, subject);
        self.value(writer, item, item.flags | self.group.flags);
        writer.extensions(self.section_extensions(), subject);
        writer.extensions(&item.extensions, subject);
    }

    fn entries(&self, writer: &mut Writer) {
        let items = || self.group.items.iter().filter_map(|item| Some((item.object()?.1, item)));
        // SubNumber does not count sub-index 0xFF. Sub-index 0xFF describes the structure of the object.
        let described = items().filter(|(sub, _)| *sub != 0xFF).count();
        writer.optional("SubNumber", Some(described).filter(|count| self.code != ObjectCode::Var || *count > 0));
        flags(writer, self.group.flags);
        writer.extensions(self.section_extensions(), Subject::Object(self.index));
        let mut seen = [false; 256];
        for (sub, item) in items() {
            if std::mem::replace(&mut seen[usize::from(sub)], true) {
                writer.notes.add(NoteKind::Duplicate, Subject::Entry(self.index, sub));
                continue;
            }
            writer.section(format_args!("{}{:04X}sub{sub:X}", self.before, self.index));
            writer.name("ParameterName", &item.name, Subject::Entry(self.index, sub));
            writer.entry("ObjectType", "0x7");
            self.value(writer, item, item.flags);
            writer.extensions(&item.extensions, Subject::Entry(self.index, sub));
        }
    }

    /// Returns the extension attributes of the object's own section.
    fn section_extensions(&self) -> &'a [Extension] {
        let all = &self.group.extensions;
        all.get(..all.len() - self.refinements_of_missing().len()).unwrap_or(all)
    }

    /// Returns the extension attributes of sections such as `[xxxxName]`. The IR lists them after the attributes of the
    /// object's own section. The returned list is empty unless the source is a CiA 306 file.
    fn refinements_of_missing(&self) -> &'a [Extension] {
        let all = &self.group.extensions;
        let is_first =
            |extension: &Extension| extension.key.split_once('/').is_some_and(|(name, _)| is_refinement(name));
        let first = all.iter().position(is_first).filter(|_| self.context.is_verbatim);
        all.get(first.unwrap_or(all.len())..).unwrap_or(&[])
    }

    /// Writes sections such as `[xxxxName]` for sub-indices that the object does not have.
    fn refinements(&self, writer: &mut Writer, list: &'a [Extension]) {
        let parts = |extension: &'a Extension| extension.key.split_once('/');
        let mut counts: HashMap<&str, usize> = HashMap::new();
        for (section, key) in list.iter().filter_map(parts) {
            // NrOfEntries counts only the entries with numeric keys.
            *counts.entry(section).or_default() += usize::from(key.bytes().all(|byte| byte.is_ascii_digit()));
        }
        let mut section = "";
        for extension in list {
            let (name, key) = parts(extension).unwrap_or((section, &extension.key));
            if name != section {
                section = name;
                writer.section(section);
                writer.entry("NrOfEntries", counts.get(section).copied().unwrap_or(0));
            }
            writer.extension(key, &extension.value, Subject::Object(self.index));
        }
    }

    fn compact(&self, writer: &mut Writer, elements: &compact::Elements<'_>) {
        let plain = Item { configured: None, ..elements.template.clone() };
        self.value(writer, &plain, self.group.flags);
        writer.entry("CompactSubObj", elements.count);
        writer.extensions(self.section_extensions(), Subject::Object(self.index));
        let (before, index) = (self.before, self.index);
        let mut list = |name: &str, rows: Vec<(u8, String)>| {
            if rows.is_empty() {
                return;
            }
            writer.section(format_args!("{before}{index:04X}{name}"));
            writer.entry("NrOfEntries", rows.len());
            for (sub, text) in rows {
                let text = writer.one_line(&text, Subject::Entry(index, sub));
                writer.numbered(sub, text);
            }
        };
        list("Name", elements.names());
        if self.context.flavor == Flavor::Dcf {
            let ty = self.data_type(elements.template).ty;
            list("Value", elements.values(|value| value::text(value, ty, Role::Value, self.form()).0));
            list("Denotation", elements.denotations());
        } else {
            let count = elements.configured();
            writer.notes.add_many(NoteKind::Configuration, count, Subject::Object(index));
        }
    }

    fn data_type(&self, item: &Item) -> DataType {
        data_type(item.type_on(Bus::CanOpen), self.types, self.context.is_canopen, self.context.is_verbatim)
    }

    /// Returns the notation of the object's numbers. Unsigned numbers of communication objects are hexadecimal, because
    /// most of them are COB-IDs, mappings or masks.
    fn form(&self) -> Form {
        Form { hex: (0x1000..0x2000).contains(&self.index), reals: self.context.reals }
    }

    /// Writes the keys of one value, starting with its data type.
    pub(super) fn value(&self, writer: &mut Writer, item: &Item, item_flags: u32) {
        let subject = Subject::item(item);
        let data_type = self.data_type(item);
        losses::of_item(item, &mut writer.notes);
        writer.notes.add_all(data_type.note, subject);
        writer.optional("DataType", data_type.code.map(|code| format!("0x{code:04X}")));
        let (access, is_mappable, note) = access(item.access_on(Bus::CanOpen), item.mappable);
        writer.notes.add_all(note, subject);
        writer.entry("AccessType", access.name());
        let ty = data_type.ty;
        self.number(writer, "DefaultValue", item.default.as_ref(), ty, Role::Value, subject);
        writer.flag("PDOMapping", is_mappable);
        if let Some(srdo) = item.behavior.as_ref().and_then(|behavior| behavior.srdo) {
            writer.flag("SRDOMapping", true);
            writer.optional("InvertedSRAD", srdo.inverted.map(|(index, sub)| format!("0x{index:04X}{sub:02X}")));
        }
        if item.limits.are_swapped(ty) {
            writer.notes.add(NoteKind::SwappedLimits, subject);
        } else {
            self.number(writer, "LowLimit", item.limits.low.as_ref(), ty, Role::Low, subject);
            self.number(writer, "HighLimit", item.limits.high.as_ref(), ty, Role::High, subject);
        }
        flags(writer, item_flags);
        if let Some(configured) = &item.configured {
            self.configured(writer, configured, ty, subject);
        }
    }

    fn configured(&self, writer: &mut Writer, configured: &Configured, ty: Type, subject: Subject<'_>) {
        if self.context.flavor == Flavor::Eds {
            return writer.notes.add(NoteKind::Configuration, subject);
        }
        self.number(writer, "ParameterValue", configured.value.as_ref(), ty, Role::Value, subject);
        let texts = [
            ("Denotation", &configured.denotation),
            ("UploadFile", &configured.upload_file),
            ("DownloadFile", &configured.download_file),
        ];
        for (key, text) in texts {
            writer.plain(key, text.as_deref().unwrap_or_default(), subject);
        }
    }

    fn number(
        &self,
        writer: &mut Writer,
        key: &'static str,
        value: Option<&Value>,
        ty: Type,
        role: Role,
        subject: Subject<'_>,
    ) {
        let Some(value) = value else { return };
        let (text, note) = value::text(value, ty, role, self.form());
        writer.notes.add_all(note, subject);
        if let Some(text) = text {
            let text = writer.one_line(&text, subject);
            writer.entry(key, text);
        }
    }
}

/// Returns whether a section lists names, values or denotations of the sub-indices of an object, such as `2000Name`.
fn is_refinement(section: &str) -> bool {
    let rest =
        section.trim_start_matches(|letter: char| letter.is_ascii_hexdigit() || matches!(letter, 'x' | 'X' | ' '));
    // `D` and `e` are hexadecimal digits, so trimming `2000Denotation` leaves `notation`.
    ["Name", "Value", "Denotation", "notation"].iter().any(|word| word.eq_ignore_ascii_case(rest))
}

/// Writes the template of the sub-objects that a module adds to an object (section `[MxSubExtyyyy]`).
pub(super) fn template(writer: &mut Writer, context: &Context<'_>, index: u16, item: &Item, types: &[TypeDef]) {
    let group = Group::object(index, ObjectCode::Var);
    let out = Object { context, group: &group, index, code: ObjectCode::Var, before: "", types };
    out.value(writer, item, item.flags);
}

fn flags(writer: &mut Writer, flags: u32) {
    writer.optional("ObjFlags", (flags != 0).then(|| format!("0x{flags:X}")));
}

/// Returns the AccessType and PDOMapping that express `access` and `mappable`. If no combination fits exactly, returns the
/// closest combination and a note.
fn access(access: Access, mappable: Mappable) -> (Access, bool, Option<NoteKind>) {
    if !mappable.any() {
        return (access, false, None);
    }
    if Mappable::by_access(access) == mappable {
        return (access, true, None);
    }
    let same = match access {
        Access::ReadWrite | Access::ReadWriteInput | Access::ReadWriteOutput => {
            [Access::ReadWrite, Access::ReadWriteInput, Access::ReadWriteOutput]
                .into_iter()
                .find(|other| Mappable::by_access(*other) == mappable)
        }
        _ => None,
    };
    match same {
        Some(access) => (access, true, Some(NoteKind::Mapping)),
        // CiA 306 has no access type for a read-only value in an RPDO or a write-only value in a TPDO.
        None => {
            let expressible = Mappable::by_access(access);
            let is_left = expressible.rpdo && mappable.rpdo || expressible.tpdo && mappable.tpdo;
            (access, is_left, Some(NoteKind::LostMapping))
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn directions_of_mapping_are_access_types() {
        let to = |access_type, rpdo, tpdo| access(access_type, Mappable { rpdo, tpdo });
        assert_eq!(to(Access::ReadWrite, true, true), (Access::ReadWrite, true, None));
        assert_eq!(to(Access::ReadWrite, false, false), (Access::ReadWrite, false, None));
        assert_eq!(to(Access::ReadWrite, true, false), (Access::ReadWriteOutput, true, Some(NoteKind::Mapping)));
        assert_eq!(to(Access::ReadWrite, false, true), (Access::ReadWriteInput, true, Some(NoteKind::Mapping)));
        assert_eq!(to(Access::ReadOnly, false, true), (Access::ReadOnly, true, None));
        assert_eq!(to(Access::ReadOnly, true, false), (Access::ReadOnly, false, Some(NoteKind::LostMapping)));
        assert_eq!(to(Access::ReadOnly, true, true), (Access::ReadOnly, true, Some(NoteKind::LostMapping)));
    }
}
