//! Writes the mailbox: its protocols and the start-up commands that the master sends.

use super::pdo::slot_index;
use super::text::hex;
use super::Context;
use crate::note::{NoteKind, Notes, Subject};
use crate::types::hex_digits;
use crate::xml::Xml;
use lexibus_codegen::ir::{Coe, CompactString, InitCommand, Mailbox, Protocol};

/// Attributes of mailbox protocols that the IR stores unchanged.
const ATTRIBUTES: [(&str, &[&str]); 5] = [
    ("AoE", &["AdsRouter", "GenerateOwnNetId", "InitializeOwnNetId"]),
    ("EoE", &["IP", "MAC", "TimeStamp"]),
    ("CoE", &["EdsFile", "DS402Channels", "SdoUploadWithMaxLength", "TimeDistribution"]),
    ("Module/CoE", &["EdsFile", "ModuleOD"]),
    ("SoE", &["ChannelCount", "DriveFollowsBit3Support"]),
];

/// Writes the mailbox of the source. If the source has no mailbox, writes the mailbox that the options describe.
pub(super) fn write(xml: &mut Xml, context: &mut Context<'_>, declared: Option<&Mailbox>) {
    let given = if declared.is_none() { context.options.coe() } else { None };
    let given = given.map(|coe| Mailbox { coe: Some(coe), ..Mailbox::default() });
    let Some(mailbox) = declared.or(given.as_ref()) else { return };
    let notes = &mut context.notes;
    xml.open("Mailbox");
    xml.flag("DataLinkLayer", mailbox.data_link_layer, "true");
    xml.flag("RealTimeMode", mailbox.real_time, "true");
    protocol(xml, notes, "AoE", mailbox.aoe.as_ref());
    protocol(xml, notes, "EoE", mailbox.eoe.as_ref());
    if let Some(coe) = &mailbox.coe {
        self::coe(xml, notes, coe, "CoE");
    }
    protocol(xml, notes, "FoE", mailbox.foe.as_ref());
    protocol(xml, notes, "SoE", mailbox.soe.as_ref());
    protocol(xml, notes, "VoE", mailbox.voe.as_ref());
    xml.close();
}

/// Writes the CoE element. `element` is its key in [`ATTRIBUTES`].
pub(super) fn coe(xml: &mut Xml, notes: &mut Notes, coe: &Coe, element: &'static str) {
    xml.open("CoE");
    xml.flag("SdoInfo", coe.sdo_info, "true");
    xml.flag("PdoAssign", coe.pdo_assign, "true");
    xml.flag("PdoConfig", coe.pdo_config, "true");
    xml.flag("PdoUpload", coe.pdo_upload, "true");
    xml.flag("CompleteAccess", coe.complete_access, "true");
    xml.flag("SegmentedSdo", coe.segmented_sdo, "true");
    xml.flag("DiagHistory", coe.diag_history, "true");
    attributes(xml, notes, element, &coe.attributes);
    coe.init_commands.iter().for_each(|command| init_command(xml, notes, "CoE", command));
    xml.close();
}

fn protocol(xml: &mut Xml, notes: &mut Notes, element: &'static str, protocol: Option<&Protocol>) {
    let Some(protocol) = protocol else { return };
    xml.open(element);
    attributes(xml, notes, element, &protocol.attributes);
    match element {
        "FoE" | "VoE" => notes.add_many(NoteKind::Setting, protocol.init_commands.len(), Subject::Named(element)),
        _ => protocol.init_commands.iter().for_each(|command| init_command(xml, notes, element, command)),
    }
    xml.close();
}

fn attributes(xml: &mut Xml, notes: &mut Notes, element: &'static str, list: &[(CompactString, CompactString)]) {
    let known = ATTRIBUTES.iter().find(|(known, _)| *known == element).map_or(&[] as &[&str], |(_, names)| names);
    for (name, value) in list {
        match known.contains(&name.as_str()) {
            true => xml.attribute(name, value),
            false => notes.add(NoteKind::Extension, Subject::Named(element)),
        }
    }
}

/// Writes a command that a master sends on a state transition.
fn init_command(xml: &mut Xml, notes: &mut Notes, protocol: &'static str, command: &InitCommand) {
    let subject = Subject::Object(command.index);
    xml.open("InitCmd");
    if protocol == "CoE" {
        xml.flag("Fixed", command.fixed, "true");
        xml.flag("CompleteAccess", command.complete_access, "true");
        xml.flag("OverwrittenByModule", command.overwritten_by_module, "true");
    }
    xml.optional("Chn", Some(command.sub_index).filter(|channel| protocol == "SoE" && *channel != 0));
    for transition in &command.transitions {
        match matches!(transition.as_str(), "IP" | "PS" | "SO" | "SP" | "OP" | "OS") {
            true => xml.leaf("Transition", transition),
            false => notes.add(NoteKind::Spelling, subject),
        }
    }
    match protocol {
        "EoE" => xml.leaf("Type", command.index),
        "SoE" => xml.leaf("IDN", command.index),
        "CoE" => {
            slot_index(xml, "Index", command.index, command.depends_on_slot, command.depends_on_slot_group);
            xml.leaf("SubIndex", hex(command.sub_index, 2));
        }
        _ => {}
    }
    xml.open("Data");
    xml.flag("AdaptAutomatically", command.adapt && protocol == "CoE", "true");
    xml.content(hex_digits(&command.data));
    xml.close();
    xml.text_leaf("Comment", &command.comment);
    xml.close();
}
