//! Reads the flags of objects and sub-items, such as access rights and PDO mapping.

use super::reader::Reader;
use crate::diagnostics::codes;
use crate::frontend::xml::{Given, Read};
use crate::ir::{Access, Behavior, Category, CompactString, Mappable, ToolFlags};
use crate::source::Span;
use crate::syntax::xml::Tag;
use crate::text::brief;

/// Contents of a `Flags` element.
#[derive(Clone, Debug, Default)]
pub(super) struct Flags {
    /// True if the file contains the `Flags` element.
    pub given: bool,
    pub access: Option<Access>,
    pub access_at: Span,
    pub mappable: Option<Mappable>,
    pub mappable_at: Span,
    pub category: Option<Category>,
    pub backup: Option<bool>,
    pub setting: Option<bool>,
    /// Flags that few objects have.
    pub more: Option<Box<MoreFlags>>,
}

#[derive(Clone, Debug, Default)]
pub(super) struct MoreFlags {
    pub safety: Option<CompactString>,
    pub read_states: Vec<CompactString>,
    pub write_states: Vec<CompactString>,
}

/// Reads a `Flags` element. Stores the flags for tools in `tool`. Without `tool`, they become extensions.
pub(super) fn read<'a>(
    reader: &mut Reader<'a, '_>,
    parent: &Tag<'a>,
    mut tool: Option<&mut Option<Box<ToolFlags>>>,
) -> Read<Flags> {
    let mut flags = Flags { given: true, ..Flags::default() };
    while let Some(tag) = reader.child(parent)? {
        match tag.name {
            "Access" => access(reader, &tag, &mut flags)?,
            "Category" => {
                let given = reader.text(&tag)?;
                flags.category = category(reader, &given);
            }
            "PdoMapping" => {
                let given = reader.text(&tag)?;
                flags.mappable = mapping(reader, &given);
                flags.mappable_at = given.span;
            }
            "SafetyMapping" => {
                let given = reader.text(&tag)?;
                let text = given.text.to_ascii_lowercase();
                if !matches!(text.as_str(), "" | "si" | "so" | "sio" | "sp") {
                    unknown(reader, &given, "safety mapping", "kept unchanged; expected si, so, sio or sp");
                }
                flags.more().safety = (!text.is_empty()).then(|| text.into());
            }
            "Backup" => flags.backup = reader.flag_of(&tag)?,
            "Setting" => flags.setting = reader.flag_of(&tag)?,
            "SdoAccess" | "Transition" | "Attribute" => {
                let Some(tool) = tool.as_deref_mut() else {
                    reader.note_text(&tag)?;
                    continue;
                };
                let tool = tool.get_or_insert_default();
                *match tag.name {
                    "SdoAccess" => &mut tool.sdo_access,
                    "Transition" => &mut tool.transition,
                    _ => &mut tool.attribute,
                } = reader.text(&tag)?.compact();
            }
            _ => reader.unknown(&tag)?,
        }
    }
    Ok(flags)
}

fn access<'a>(reader: &mut Reader<'a, '_>, tag: &Tag<'a>, flags: &mut Flags) -> Read<()> {
    let [read, write] = reader.attributes(tag, ["ReadRestrictions", "WriteRestrictions"])?;
    if !read.is_empty() {
        flags.more().read_states = states(&read);
    }
    if !write.is_empty() {
        flags.more().write_states = states(&write);
    }
    let given = reader.content()?;
    flags.access_at = given.span;
    flags.access = match given.text.as_ref() {
        "ro" => Some(Access::ReadOnly),
        "rw" => Some(Access::ReadWrite),
        "wo" => Some(Access::WriteOnly),
        "" => None,
        text => {
            let access = match text.to_ascii_lowercase().as_str() {
                "rw" | "rwr" | "rww" => Access::ReadWrite,
                "wo" | "w" => Access::WriteOnly,
                _ => Access::ReadOnly,
            };
            unknown(reader, &given, "access right", &format!("read as {}; expected ro, rw or wo", access.name()));
            Some(access)
        }
    };
    Ok(())
}

/// Splits a list of EtherCAT states such as `PreOP_SafeOP`.
fn states(given: &Given<'_>) -> Vec<CompactString> {
    given.text.split('_').filter(|state| !state.is_empty()).map(CompactString::from).collect()
}

fn category(reader: &mut Reader<'_, '_>, given: &Given<'_>) -> Option<Category> {
    match given.text.as_ref() {
        "m" | "M" => Some(Category::Mandatory),
        "o" | "O" => Some(Category::Optional),
        "c" | "C" => Some(Category::Conditional),
        "" => None,
        _ => {
            unknown(reader, given, "category", "left out; expected m, o or c");
            None
        }
    }
}

/// Reads a PDO mapping. `R` means that the item can be mapped into an RxPDO, and `T` that it can be mapped into a
/// TxPDO.
fn mapping(reader: &mut Reader<'_, '_>, given: &Given<'_>) -> Option<Mappable> {
    let mut mappable = Mappable::default();
    for letter in given.text.bytes() {
        match letter {
            b'R' | b'r' => mappable.rpdo = true,
            b'T' | b't' => mappable.tpdo = true,
            _ => {
                unknown(reader, given, "PDO mapping", "read as not mappable; expected R, T or RT");
                return Some(Mappable::default());
            }
        }
    }
    Some(mappable).filter(|_| !given.is_empty())
}

fn unknown(reader: &mut Reader<'_, '_>, given: &Given<'_>, what: &str, label: &str) {
    let message = format!("ETG.2000 does not define the {what} `{}`", brief(&given.text));
    reader.report(&codes::UNKNOWN_FLAG, given.span, message, label);
}

impl Flags {
    fn more(&mut self) -> &mut MoreFlags {
        self.more.get_or_insert_default()
    }

    /// Returns the number of text bytes that a copy of the flags needs.
    pub fn weight(&self) -> usize {
        let Some(more) = self.more.as_deref() else { return 0 };
        let states = more.read_states.iter().chain(&more.write_states);
        states.chain(&more.safety).map(|text| size_of::<CompactString>() + text.len()).sum()
    }

    /// Returns the access rights of a sub-item, or those of its object if the sub-item declares none.
    pub fn access_or<'f>(&'f self, object: &'f Flags) -> (Option<Access>, Span) {
        let flags = if self.access.is_some() { self } else { object };
        (flags.access, flags.access_at)
    }

    /// Returns the PDOs into which a sub-item can be mapped. A sub-item with flags but without a PDO mapping cannot be
    /// mapped. A sub-item without flags has the PDO mapping of its object, except sub-index 0, which cannot be mapped.
    pub fn mappable_or(&self, object: &Flags, sub_index: u8) -> (Mappable, Span) {
        let flags = if self.given || sub_index == 0 { self } else { object };
        (flags.mappable.unwrap_or_default(), flags.mappable_at)
    }

    /// Returns the storage and the safety mapping of a sub-item, and the EtherCAT states in which it can be read or written. A
    /// sub-item without flags has the storage of its object. A safety mapping or list of states that the sub-item does not declare
    /// is that of its object. Returns `None` if none of these facts applies.
    pub fn behavior_or(&self, object: &Flags) -> Option<Box<Behavior>> {
        let stored = if self.given { self } else { object };
        let (backup, setting) = (stored.backup.unwrap_or(false), stored.setting.unwrap_or(false));
        let [item, object] = [self, object].map(|flags| flags.more.as_deref());
        if item.or(object).is_none() && !backup && !setting {
            return None;
        }
        let [item, object] = [item, object].map(|more| more.cloned().unwrap_or_default());
        let or = |states: Vec<_>, default| if states.is_empty() { default } else { states };
        Some(Box::new(Behavior {
            backup,
            setting,
            safety: item.safety.or(object.safety),
            read_states: or(item.read_states, object.read_states),
            write_states: or(item.write_states, object.write_states),
            ..Behavior::default()
        }))
    }
}
