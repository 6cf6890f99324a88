//! Writes the modules of modular devices.

use super::text::{hex, names};
use super::types::Types;
use super::{dictionary, losses, mailbox, objects, pdo, Context};
use crate::note::{NoteKind, Subject};
use crate::xml::Xml;
use lexibus_codegen::ir::{Mailbox, Module};

/// Writes the Module element of a module.
pub(super) fn write(xml: &mut Xml, context: &mut Context<'_>, module: &Module) {
    let subject = Subject::Named(&module.name);
    xml.open("Module");
    xml.open("Type");
    xml.attribute("ModuleIdent", hex(module.number, 8));
    xml.text_attribute("ModuleClass", &module.class);
    xml.optional("ModulePdoGroup", module.pdo_group);
    xml.content(&module.id);
    xml.close();
    names(xml, "Name", &module.name, &module.names, subject);
    let mut types = Types::new(&module.types, context.is_esi, &mut xml.notes);
    for pdo in &module.process_data.pdos {
        pdo::write(xml, &types, pdo, true);
    }
    of_mailbox(xml, module);
    profile(xml, context, module, &mut types);
    xml.text_leaf("DcOpModeName", &module.clock_mode);
    xml.close();
    xml.notes.add_many(NoteKind::Extension, module.extensions.len() + module.attributes.len(), subject);
    losses::of_module(module, &mut xml.notes);
}

/// Writes the mailbox with CoE. ETG.2000 allows no other protocol for a module, so the others are left out with a note.
fn of_mailbox(xml: &mut Xml, module: &Module) {
    let Some(mailbox) = &module.mailbox else { return };
    let Mailbox { data_link_layer, real_time, aoe, eoe, coe, foe, soe, voe } = &**mailbox;
    let others = [aoe, eoe, foe, soe, voe].into_iter().flatten();
    let of_others: usize = others.map(|protocol| 1 + protocol.attributes.len() + protocol.init_commands.len()).sum();
    let lost = of_others + usize::from(*data_link_layer) + usize::from(*real_time);
    xml.notes.add_many(NoteKind::Extension, lost, Subject::Named(&module.name));
    if let Some(coe) = coe {
        xml.open("Mailbox");
        mailbox::coe(xml, coe, "Module/CoE");
        xml.close();
    }
}

/// Writes the Profile element of a module. ETG.2000 allows only one such element per module, so other profile numbers
/// are left out with a note.
fn profile(xml: &mut Xml, context: &mut Context<'_>, module: &Module, types: &mut Types<'_>) {
    let objects = objects::all(module.groups.iter(), &mut xml.notes);
    if module.profiles.is_empty() && objects.is_empty() && types.defs.is_empty() {
        let lost = [module.add_info, module.sub_add_info].into_iter().flatten().count();
        xml.notes.add_many(NoteKind::Setting, lost, Subject::Named(&module.name));
        return;
    }
    xml.open("Profile");
    if let Some((number, others)) = module.profiles.split_first() {
        xml.leaf("ProfileNo", number);
        xml.notes.add_many(NoteKind::Setting, others.len(), Subject::Named(&module.name));
    }
    xml.optional_leaf("AddInfo", module.add_info);
    xml.optional_leaf("SubAddInfo", module.sub_add_info);
    dictionary::write(xml, context, types, &objects);
    xml.close();
}
