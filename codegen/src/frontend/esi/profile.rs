//! Reads profiles: their numbers, dictionaries and diagnosis messages.

use super::description::{OtherFiles, Reference, Target};
use super::diagnosis;
use super::dictionary::Dictionary;
use super::reader::Reader;
use crate::collections::HashSet;
use crate::frontend::xml::{Given, Read};
use crate::ir::CodeTable;
use crate::syntax::xml::Tag;

/// Contents of the profiles of a device or module.
#[derive(Default)]
pub(super) struct Profiles<'a> {
    /// Profile numbers, without duplicates.
    pub numbers: Vec<u32>,
    seen: HashSet<u32>,
    /// Additional numbers of the first profile that has them.
    pub add_info: Given<'a>,
    pub sub_add_info: Given<'a>,
    pub dictionary: Dictionary<'a>,
    pub code_tables: Vec<CodeTable>,
    /// Files to which the profiles refer, and types that these files may define.
    pub other_files: OtherFiles,
}

impl<'a> Profiles<'a> {
    /// Reads a `Profile` element.
    pub fn read(&mut self, reader: &mut Reader<'a, '_>, parent: &Tag<'a>) -> Read<()> {
        let [channel] = reader.attributes(parent, ["Channel"])?;
        reader.note("Profile@Channel", &channel);
        while let Some(tag) = reader.child(parent)? {
            match tag.name {
                "ProfileNo" => self.number(reader, &tag)?,
                "AddInfo" | "SubAddInfo" => {
                    let given = reader.text(&tag)?;
                    let first = if tag.name == "AddInfo" { &mut self.add_info } else { &mut self.sub_add_info };
                    match first.is_empty() {
                        true => *first = given,
                        false => reader.note(tag.name, &given),
                    }
                }
                "ChannelCount" => reader.note_text(&tag)?,
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
        let number = reader.number(tag, "profile number")?;
        self.numbers.extend(number.filter(|&number| self.seen.insert(number)));
        Ok(())
    }

    /// Reads a `ChannelInfo` element, which describes the profile of a channel.
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
            self.other_files.files.push(Reference::new(&given, target));
        }
        Ok(())
    }
}
