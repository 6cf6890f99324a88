//! Writes the modules of modular devices.

use super::mailbox::init_command;
use super::text::{hex, names};
use super::types::Types;
use super::{dictionary, extras, losses, objects, pdo, Context};
use crate::note::{NoteKind, Subject};
use crate::xml::Xml;
use lexibus_codegen::ir::{Extension, Module};

/// Attributes of a module's CoE element, which the IR stores as extensions.
const COE: [&str; 9] = [
    "CoE@SdoInfo",
    "CoE@PdoAssign",
    "CoE@PdoConfig",
    "CoE@PdoUpload",
    "CoE@CompleteAccess",
    "CoE@SegmentedSdo",
    "CoE@DiagHistory",
    "CoE@EdsFile",
    "CoE@ModuleOD",
];

/// Extension that marks a module whose mailbox supports CoE.
const HAS_COE: &str = "Mailbox/CoE";

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
    names(xml, "Name", &module.name, &module.names, &mut context.notes, subject);
    let mut types = Types::new(&module.types, context.is_esi, &mut context.notes);
    for pdo in &module.process_data.pdos {
        pdo::write(xml, &mut context.notes, &types, pdo, true);
    }
    mailbox(xml, context, module);
    profile(xml, context, module, &mut types);
    xml.optional_leaf(
        "DcOpModeName",
        module.extensions.iter().find(|extension| extension.key == "DcOpModeName").map(|name| &name.value),
    );
    xml.close();
    let is_written = |extension: &Extension| matches!(extension.key.as_str(), "DcOpModeName" | HAS_COE);
    let is_lost = |extension: &&Extension| !is_written(extension) && !is_coe(extension);
    let lost = module.extensions.iter().filter(is_lost).filter(|extension| !extras::is_of_profile(extension)).count();
    context.notes.add_many(NoteKind::Extension, lost, subject);
    losses::of_module(context, module);
}

fn is_coe(extension: &Extension) -> bool {
    COE.contains(&extension.key.as_str())
}

fn mailbox(xml: &mut Xml, context: &mut Context<'_>, module: &Module) {
    let attributes: Vec<&Extension> = module.extensions.iter().filter(|extension| is_coe(extension)).collect();
    let has_coe = module.extensions.iter().any(|extension| extension.key == HAS_COE);
    if module.init_commands.is_empty() && attributes.is_empty() && !has_coe {
        return;
    }
    xml.open("Mailbox");
    xml.open("CoE");
    for extension in attributes {
        xml.attribute(extension.key.trim_start_matches("CoE@"), &extension.value);
    }
    module.init_commands.iter().for_each(|command| init_command(xml, &mut context.notes, "CoE", command));
    xml.close();
    xml.close();
}

/// Writes the Profile element of a module. ETG.2000 allows only one such element per module, so other profile numbers
/// are left out with a note.
fn profile(xml: &mut Xml, context: &mut Context<'_>, module: &Module, types: &mut Types<'_>) {
    let objects = objects::all(module.groups.iter(), &mut context.notes);
    if module.profiles.is_empty() && objects.is_empty() && types.defs.is_empty() {
        return;
    }
    xml.open("Profile");
    if let Some((number, others)) = module.profiles.split_first() {
        xml.leaf("ProfileNo", number);
        context.notes.add_many(NoteKind::Setting, others.len(), Subject::Named(&module.name));
    }
    extras::profile(xml, &module.extensions);
    dictionary::write(xml, context, types, &objects);
    xml.close();
}
