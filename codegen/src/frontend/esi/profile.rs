//! Profiles: their numbers, the dictionary and the diagnosis messages that belong to them.

use std::collections::HashSet;

use super::diagnosis;
use super::dictionary::Dictionary;
use super::reader::{note, Read, Reader};
use super::references::{Elsewhere, Reference, Target};
use crate::ir::{CodeTable, Extensions};
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
    pub fn read(&mut self, reader: &mut Reader<'a, '_>, parent: &Tag<'a>, extensions: &mut Extensions) -> Read<()> {
        let [channel] = reader.fields(parent, &["Channel"], extensions)?;
        note("Profile@Channel", &channel, extensions);
        while let Some(tag) = reader.cursor.child(parent)? {
            match tag.name {
                "ProfileNo" => self.number(reader, &tag, extensions)?,
                "AddInfo" | "SubAddInfo" | "ChannelCount" => reader.note(&tag, extensions)?,
                "ChannelInfo" => self.channel(reader, &tag, extensions)?,
                "Dictionary" => self.dictionary.read(reader, &tag)?,
                "DictionaryFile" => self.file(reader, &tag, Target::Dictionary, extensions)?,
                "DiagFile" => self.file(reader, &tag, Target::Diagnosis, extensions)?,
                "DiagMessages" => self.code_tables.extend(diagnosis::read(reader, &tag, extensions)?),
                "VendorSpecific" => reader.vendor_specific(&tag, extensions)?,
                _ => reader.unknown(&tag, extensions)?,
            }
        }
        Ok(())
    }

    fn number(&mut self, reader: &mut Reader<'a, '_>, tag: &Tag<'a>, extensions: &mut Extensions) -> Read<()> {
        let number = reader.number(tag, "number of a profile", extensions)?;
        self.numbers.extend(number.filter(|&number| self.seen.insert(number)));
        Ok(())
    }

    /// A channel follows a profile of its own.
    fn channel(&mut self, reader: &mut Reader<'a, '_>, parent: &Tag<'a>, extensions: &mut Extensions) -> Read<()> {
        let fields = reader.fields(parent, &["OverwrittenByModule", "ChannelGroup"], extensions)?;
        let [overwritten, group] = &fields;
        note("ChannelInfo@OverwrittenByModule", overwritten, extensions);
        note("ChannelInfo@ChannelGroup", group, extensions);
        while let Some(tag) = reader.cursor.child(parent)? {
            match tag.name {
                "ProfileNo" => self.number(reader, &tag, extensions)?,
                "AddInfo" | "SubAddInfo" | "DisplayName" => reader.keep(&tag, extensions)?,
                _ => reader.unknown(&tag, extensions)?,
            }
        }
        Ok(())
    }

    fn file(
        &mut self,
        reader: &mut Reader<'a, '_>,
        tag: &Tag<'a>,
        target: Target,
        extensions: &mut Extensions,
    ) -> Read<()> {
        let given = reader.leaf(tag, extensions)?;
        if !given.is_empty() {
            note(tag.name, &given, extensions);
            self.elsewhere.files.push(Reference::new(&given, target));
        }
        Ok(())
    }
}
