//! Reads the mailbox of a device or module: its protocols and its start-up commands.

use super::reader::Reader;
use super::slot_index::SlotIndex;
use crate::diagnostics::codes;
use crate::frontend::xml::Read;
use crate::ir::{Coe, CompactString, Extension, InitCommand, Mailbox, Protocol};
use crate::syntax::xml::Tag;

/// Reads the `Mailbox` element of a device or module.
pub(super) fn read<'a>(reader: &mut Reader<'a, '_>, parent: &Tag<'a>) -> Read<Mailbox> {
    let [data_link, real_time] = reader.attributes(parent, ["DataLinkLayer", "RealTimeMode"])?;
    let mut mailbox =
        Mailbox { data_link_layer: reader.flag(&data_link), real_time: reader.flag(&real_time), ..Mailbox::default() };
    while let Some(tag) = reader.child(parent)? {
        match tag.name {
            "CoE" => mailbox.coe = Some(coe(reader, &tag)?),
            "AoE" => mailbox.aoe = Some(protocol(reader, &tag)?),
            "EoE" => mailbox.eoe = Some(protocol(reader, &tag)?),
            "FoE" => mailbox.foe = Some(protocol(reader, &tag)?),
            "SoE" => mailbox.soe = Some(protocol(reader, &tag)?),
            "VoE" => mailbox.voe = Some(protocol(reader, &tag)?),
            "VendorSpecific" => reader.vendor_specific(&tag)?,
            _ => reader.unknown(&tag)?,
        }
    }
    Ok(mailbox)
}

fn coe<'a>(reader: &mut Reader<'a, '_>, parent: &Tag<'a>) -> Read<Coe> {
    const NAMES: [&str; 7] =
        ["SdoInfo", "PdoAssign", "PdoConfig", "PdoUpload", "CompleteAccess", "SegmentedSdo", "DiagHistory"];
    let start = reader.extensions.len();
    let [info, assign, config, upload, complete, segmented, history] =
        reader.attributes(parent, NAMES)?.map(|given| reader.flag(&given));
    let others = reader.extensions_since(start);
    // Extension keys have the form `CoE@EdsFile`. In the IR, the names of protocol attributes omit the element name.
    let attribute = |extension: Extension| {
        let name = extension.key.rsplit('@').next().map(CompactString::from);
        (name.unwrap_or_default(), extension.value)
    };
    let mut coe = Coe {
        sdo_info: info,
        pdo_assign: assign,
        pdo_config: config,
        pdo_upload: upload,
        complete_access: complete,
        segmented_sdo: segmented,
        diag_history: history,
        attributes: others.into_iter().map(attribute).collect(),
        init_commands: Vec::new(),
    };
    while let Some(tag) = reader.child(parent)? {
        match tag.name {
            "InitCmd" => coe.init_commands.push(init_command(reader, &tag)?),
            "Object" => reader.keep(&tag)?,
            _ => reader.unknown(&tag)?,
        }
    }
    Ok(coe)
}

fn protocol<'a>(reader: &mut Reader<'a, '_>, parent: &Tag<'a>) -> Read<Protocol> {
    let mut protocol = Protocol::default();
    reader.attributes_and_others(parent, [], &mut protocol.attributes)?;
    while let Some(tag) = reader.child(parent)? {
        match tag.name {
            "InitCmd" => protocol.init_commands.push(init_command(reader, &tag)?),
            "DiagFile" => reader.note_text(&tag)?,
            "DiagMessages" => reader.keep(&tag)?,
            // A `VoE` element may contain any element.
            _ if parent.name == "VoE" => reader.keep(&tag)?,
            _ => reader.unknown(&tag)?,
        }
    }
    Ok(protocol)
}

fn init_command<'a>(reader: &mut Reader<'a, '_>, parent: &Tag<'a>) -> Read<InitCommand> {
    const NAMES: [&str; 4] = ["Fixed", "CompleteAccess", "OverwrittenByModule", "Chn"];
    let mut command = InitCommand { origin: reader.origin(parent), ..InitCommand::default() };
    let fields = reader.attributes(parent, NAMES)?;
    let [fixed, complete, overwritten, channel] = &fields;
    command.fixed = reader.flag(fixed);
    command.complete_access = reader.flag(complete);
    command.overwritten_by_module = reader.flag(overwritten);
    command.sub_index = reader.int(channel, "channel number").unwrap_or(0);
    while let Some(tag) = reader.child(parent)? {
        match tag.name {
            "Transition" => {
                let given = reader.text(&tag)?;
                if !matches!(given.text.as_ref(), "IP" | "PS" | "SO" | "SP" | "OP" | "OS") {
                    reader.bad(&given, "state transition", "kept unchanged; expected IP, PS, SO, SP, OP or OS");
                }
                command.transitions.push(given.compact());
            }
            "Index" => {
                let SlotIndex { given, slot, group, .. } = SlotIndex::read(reader, &tag)?;
                (command.depends_on_slot, command.depends_on_slot_group) = (slot, group);
                command.index = reader.int(&given, "index").unwrap_or(0);
            }
            "IDN" | "Type" => command.index = reader.number(&tag, "number")?.unwrap_or(0),
            "SubIndex" => command.sub_index = reader.number(&tag, "sub-index")?.unwrap_or(0),
            "Data" => {
                let [adapt] = reader.attributes(&tag, ["AdaptAutomatically"])?;
                command.adapt = reader.flag(&adapt);
                let given = reader.content()?;
                command.data = reader.octets(&given).unwrap_or_default();
            }
            "Comment" => command.comment = reader.text(&tag)?.compact(),
            _ => reader.unknown(&tag)?,
        }
    }
    if command.transitions.is_empty() {
        let message = "this command has no state transition";
        reader.report(&codes::ESI_VALUE, parent.span, message, "kept without a state transition");
    }
    Ok(command)
}
