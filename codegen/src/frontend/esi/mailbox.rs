//! The mailbox: its protocols, and what a master sends at start-up.

use super::pdo::{slot_index, SlotIndex};
use super::reader::{has_attributes, Read, Reader};
use crate::diagnostics::codes;
use crate::ir::{Coe, CompactString, Extension, Extensions, InitCommand, Mailbox, Protocol};
use crate::syntax::xml::Tag;

/// Reads the Mailbox of a device or module.
pub(super) fn read<'a>(reader: &mut Reader<'a, '_>, parent: &Tag<'a>, extensions: &mut Extensions) -> Read<Mailbox> {
    let [data_link, real_time] = reader.fields(parent, &["DataLinkLayer", "RealTimeMode"], extensions)?;
    let mut mailbox =
        Mailbox { data_link_layer: reader.flag(&data_link), real_time: reader.flag(&real_time), ..Mailbox::default() };
    while let Some(tag) = reader.cursor.child(parent)? {
        match tag.name {
            "CoE" => mailbox.coe = Some(coe(reader, &tag, extensions)?),
            "AoE" => mailbox.aoe = Some(protocol(reader, &tag, extensions)?),
            "EoE" => mailbox.eoe = Some(protocol(reader, &tag, extensions)?),
            "FoE" => mailbox.foe = Some(protocol(reader, &tag, extensions)?),
            "SoE" => mailbox.soe = Some(protocol(reader, &tag, extensions)?),
            "VoE" => mailbox.voe = Some(protocol(reader, &tag, extensions)?),
            "VendorSpecific" => reader.vendor_specific(&tag, extensions)?,
            _ => reader.unknown(&tag, extensions)?,
        }
    }
    Ok(mailbox)
}

fn coe<'a>(reader: &mut Reader<'a, '_>, parent: &Tag<'a>, extensions: &mut Extensions) -> Read<Coe> {
    const NAMES: [&str; 7] =
        ["SdoInfo", "PdoAssign", "PdoConfig", "PdoUpload", "CompleteAccess", "SegmentedSdo", "DiagHistory"];
    let mut others = Extensions::new();
    let fields = reader.fields(parent, &NAMES, &mut others)?;
    let [info, assign, config, upload, complete, segmented, history] =
        fields.each_ref().map(|given| reader.flag(given));
    // Extensions are called `CoE@EdsFile`; here the element is known.
    let own = |extension: Extension| {
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
        attributes: others.into_iter().map(own).collect(),
        init_commands: Vec::new(),
    };
    while let Some(tag) = reader.cursor.child(parent)? {
        match tag.name {
            "InitCmd" => coe.init_commands.push(init_command(reader, &tag, extensions)?),
            "Object" => reader.keep(&tag, extensions)?,
            _ => reader.unknown(&tag, extensions)?,
        }
    }
    Ok(coe)
}

fn protocol<'a>(reader: &mut Reader<'a, '_>, parent: &Tag<'a>, extensions: &mut Extensions) -> Read<Protocol> {
    let mut protocol = Protocol::default();
    if has_attributes(parent) {
        for attribute in parent.attributes() {
            let attribute = attribute?;
            if !attribute.is_namespace() {
                let value = attribute.value(reader.diagnostics).into();
                protocol.attributes.push((attribute.name.into(), value));
            }
        }
    }
    while let Some(tag) = reader.cursor.child(parent)? {
        match tag.name {
            "InitCmd" => protocol.init_commands.push(init_command(reader, &tag, extensions)?),
            "DiagFile" => reader.note(&tag, extensions)?,
            "DiagMessages" => reader.keep(&tag, extensions)?,
            // VoE may contain anything.
            _ if parent.name == "VoE" => reader.keep(&tag, extensions)?,
            _ => reader.unknown(&tag, extensions)?,
        }
    }
    Ok(protocol)
}

fn init_command<'a>(reader: &mut Reader<'a, '_>, parent: &Tag<'a>, extensions: &mut Extensions) -> Read<InitCommand> {
    const NAMES: [&str; 4] = ["Fixed", "CompleteAccess", "OverwrittenByModule", "Chn"];
    let mut command = InitCommand { origin: reader.cursor.origin(parent), ..InitCommand::default() };
    let fields = reader.fields(parent, &NAMES, extensions)?;
    let [fixed, complete, overwritten, channel] = &fields;
    command.fixed = reader.flag(fixed);
    command.complete_access = reader.flag(complete);
    command.overwritten_by_module = reader.flag(overwritten);
    command.sub_index = reader.int(channel, "number of a channel").unwrap_or(0);
    while let Some(tag) = reader.cursor.child(parent)? {
        match tag.name {
            "Transition" => {
                let given = reader.leaf(&tag, extensions)?;
                if !matches!(given.text.as_ref(), "IP" | "PS" | "SO" | "SP" | "OP" | "OS") {
                    reader.bad(&given, "change of state", "kept as it is; expected IP, PS, SO, SP, OP or OS");
                }
                command.transitions.push(given.compact());
            }
            "Index" => {
                let SlotIndex { given, slot, group, .. } = slot_index(reader, &tag, extensions)?;
                (command.depends_on_slot, command.depends_on_slot_group) = (slot, group);
                command.index = reader.int(&given, "index").unwrap_or(0);
            }
            "IDN" | "Type" => command.index = reader.number(&tag, "number", extensions)?.unwrap_or(0),
            "SubIndex" => command.sub_index = reader.number(&tag, "sub-index", extensions)?.unwrap_or(0),
            "Data" => {
                let [adapt] = reader.fields(&tag, &["AdaptAutomatically"], extensions)?;
                command.adapt = reader.flag(&adapt);
                let given = reader.content(extensions)?;
                command.data = reader.octets(&given).unwrap_or_default();
            }
            "Comment" => command.comment = reader.leaf(&tag, extensions)?.compact(),
            _ => reader.unknown(&tag, extensions)?,
        }
    }
    if command.transitions.is_empty() {
        let message = "nothing says when this command is sent";
        reader.report(&codes::ESI_VALUE, parent.span, message, "kept without a change of state");
    }
    Ok(command)
}
