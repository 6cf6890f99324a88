//! Writes the mailbox: its protocols and the start-up commands that the master sends.

use super::pdo::slot_index;
use super::text::hex;
use super::{extras, Context};
use crate::note::{NoteKind, Subject};
use crate::types::hex_digits;
use crate::xml::Xml;
use lexibus_codegen::ir::{Coe, InitCommand, Mailbox, Protocol};

/// Writes the mailbox of the source. If the source has no mailbox, writes the mailbox that the options describe.
pub(super) fn write(xml: &mut Xml, context: &mut Context<'_>, declared: Option<&Mailbox>) {
    let given = if declared.is_none() { context.options.coe() } else { None };
    let given = given.map(|coe| Mailbox { coe: Some(coe), ..Mailbox::default() });
    let Some(mailbox) = declared.or(given.as_ref()) else { return };
    xml.open("Mailbox");
    xml.flag("DataLinkLayer", mailbox.data_link_layer, "true");
    xml.flag("RealTimeMode", mailbox.real_time, "true");
    protocol(xml, "AoE", mailbox.aoe.as_ref());
    protocol(xml, "EoE", mailbox.eoe.as_ref());
    if let Some(coe) = &mailbox.coe {
        self::coe(xml, coe, "CoE");
    }
    protocol(xml, "FoE", mailbox.foe.as_ref());
    protocol(xml, "SoE", mailbox.soe.as_ref());
    protocol(xml, "VoE", mailbox.voe.as_ref());
    xml.close();
}

/// Writes the CoE element. `element` is its name in [`extras::attributes`].
pub(super) fn coe(xml: &mut Xml, coe: &Coe, element: &'static str) {
    xml.open("CoE");
    xml.flag("SdoInfo", coe.sdo_info, "true");
    xml.flag("PdoAssign", coe.pdo_assign, "true");
    xml.flag("PdoConfig", coe.pdo_config, "true");
    xml.flag("PdoUpload", coe.pdo_upload, "true");
    xml.flag("CompleteAccess", coe.complete_access, "true");
    xml.flag("SegmentedSdo", coe.segmented_sdo, "true");
    xml.flag("DiagHistory", coe.diag_history, "true");
    extras::attributes(xml, element, &coe.attributes);
    coe.init_commands.iter().for_each(|command| init_command(xml, "CoE", command));
    xml.close();
}

fn protocol(xml: &mut Xml, element: &'static str, protocol: Option<&Protocol>) {
    let Some(protocol) = protocol else { return };
    xml.open(element);
    extras::attributes(xml, element, &protocol.attributes);
    match element {
        "FoE" | "VoE" => xml.notes.add_many(NoteKind::Setting, protocol.init_commands.len(), Subject::Named(element)),
        _ => protocol.init_commands.iter().for_each(|command| init_command(xml, element, command)),
    }
    xml.close();
}

/// Writes a command that a master sends on a state transition.
fn init_command(xml: &mut Xml, protocol: &'static str, command: &InitCommand) {
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
            false => xml.notes.add(NoteKind::Spelling, subject),
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
