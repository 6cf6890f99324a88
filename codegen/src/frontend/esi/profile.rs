//! Profiles: their numbers, the dictionary and the diagnosis messages that belong to them.

use std::collections::HashSet;

use super::description::{Elsewhere, Reference, Target};
use super::diagnosis;
use super::dictionary::Dictionary;
use super::reader::Reader;
use crate::frontend::xml::Read;
use crate::ir::CodeTable;
use crate::syntax::xml::Tag;

/// What the profiles of a device or module say.
#[derive(Default)]
pub(super) struct Profiles<'a> {
    /// Numbers, each once.
    pub numbers: Vec<u32>,
    seen: HashSet<u32>,
    pub dictionary: Dictionary<'a>,
    pub code_tables: Vec<CodeTable>,
    /// Files that belong to the profiles, and what is left to them.
    pub elsewhere: Elsewhere,
}

impl<'a> Profiles<'a> {
    /// Reads a Profile.
    pub fn read(&mut self, reader: &mut Reader<'a, '_>, parent: &Tag<'a>) -> Read<()> {
        let [channel] = reader.attributes(parent, ["Channel"])?;
        reader.note("Profile@Channel", &channel);
        while let Some(tag) = reader.child(parent)? {
            match tag.name {
                "ProfileNo" => self.number(reader, &tag)?,
                "AddInfo" | "SubAddInfo" | "ChannelCount" => reader.note_text(&tag)?,
                "ChannelInfo" => self.channel(reader, &tag)?,
                "Dictionary" => self.dictionary.read(reader, &tag)?,
                "DictionaryFile" => self.file(reader, &tag, Target::Dictionary)?,
                "DiagFile" => self.file(reader, &tag, Target::Diagnosis)?,
                "DiagMessages" => self.code_tables.extend(diagnosis::read(reader, &tag)?),
                "VendorSpecific" => reader.vendor_specific(&tag)?,
                _ => reader.unknown(&tag)?,
            }
        }
        Ok(())
    }

    fn number(&mut self, reader: &mut Reader<'a, '_>, tag: &Tag<'a>) -> Read<()> {
        let number = reader.number(tag, "number of a profile")?;
        self.numbers.extend(number.filter(|&number| self.seen.insert(number)));
        Ok(())
    }

    /// A channel follows a profile of its own.
    fn channel(&mut self, reader: &mut Reader<'a, '_>, parent: &Tag<'a>) -> Read<()> {
        let fields = reader.attributes(parent, ["OverwrittenByModule", "ChannelGroup"])?;
        let [overwritten, group] = &fields;
        reader.note("ChannelInfo@OverwrittenByModule", overwritten);
        reader.note("ChannelInfo@ChannelGroup", group);
        while let Some(tag) = reader.child(parent)? {
            match tag.name {
                "ProfileNo" => self.number(reader, &tag)?,
                "AddInfo" | "SubAddInfo" | "DisplayName" => reader.keep(&tag)?,
                _ => reader.unknown(&tag)?,
            }
        }
        Ok(())
    }

    fn file(&mut self, reader: &mut Reader<'a, '_>, tag: &Tag<'a>, target: Target) -> Read<()> {
        let given = reader.text(tag)?;
        if !given.is_empty() {
            reader.note(tag.name, &given);
            self.elsewhere.files.push(Reference::new(&given, target));
        }
        Ok(())
    }
}
