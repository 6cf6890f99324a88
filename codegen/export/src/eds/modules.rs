//! Modules that add objects and sub-objects to the dictionary (CiA 306, "modular devices").

use super::losses;
use super::note::{NoteKind, Subject};
use super::object;
use super::section::{comment_lines, indices};
use super::writer::Writer;
use super::Context;
use lexibus_codegen::ir::{Catalog, Group, Module, SubExtension};

/// Writes the modules of a CANopen device. For devices on other buses, adds only a note with the number of modules,
/// because the objects of their modules depend on the slot.
pub(super) fn write(writer: &mut Writer, context: &Context<'_>, catalog: &Catalog) {
    for module in context.device.accepted_modules(&catalog.modules) {
        let number = module.number;
        if !context.is_canopen {
            writer.notes.add(NoteKind::Module, Subject::Named(&module.name));
            continue;
        }
        losses::of_module(module, &mut writer.notes);
        info(writer, module);
        if !module.comments.is_empty() {
            writer.section(format_args!("M{number}Comments"));
            comment_lines(writer, &module.comments);
        }
        fixed_objects(writer, context, module);
        sub_extensions(writer, context, module);
    }
}

fn info(writer: &mut Writer, module: &Module) {
    let subject = Subject::Named(&module.name);
    writer.section(format_args!("M{}ModuleInfo", module.number));
    writer.name("ProductName", &module.name, subject);
    let others = [
        ("ProductVersion", &module.version),
        ("ProductRevision", &module.revision),
        ("OrderCode", &module.identity.order_code),
    ];
    for (key, text) in others.into_iter().filter(|(_, text)| !text.is_empty()) {
        writer.name(key, text, subject);
    }
    writer.extensions(&module.extensions, subject);
}

fn fixed_objects(writer: &mut Writer, context: &Context<'_>, module: &Module) {
    if module.fixed_objects.is_empty() {
        return;
    }
    let number = module.number;
    writer.section(format_args!("M{number}FixedObjects"));
    let fixed_indices = module.fixed_objects.iter().filter_map(Group::index);
    indices(writer, "NrOfEntries", module.fixed_objects.len(), fixed_indices);
    for group in &module.fixed_objects {
        object::object(writer, context, group, &format!("M{number}Fixed"), &module.types);
    }
}

fn sub_extensions(writer: &mut Writer, context: &Context<'_>, module: &Module) {
    if module.sub_extensions.is_empty() {
        return;
    }
    let number = module.number;
    writer.section(format_args!("M{number}SubExtends"));
    let extended_indices = module.sub_extensions.iter().map(|extension| extension.index);
    indices(writer, "NrOfEntries", module.sub_extensions.len(), extended_indices);
    for extension in &module.sub_extensions {
        writer.section(format_args!("M{number}SubExt{:04X}", extension.index));
        sub_extension(writer, context, extension, module);
    }
}

fn sub_extension(writer: &mut Writer, context: &Context<'_>, extension: &SubExtension, module: &Module) {
    let (template, subject) = (&extension.template, Subject::Object(extension.index));
    writer.name("ParameterName", &template.name, subject);
    object::template(writer, context, extension.index, template, &module.types);
    match extension.per {
        Some(per) => writer.entry("Count", format_args!("{};{per}", extension.count)),
        None => writer.entry("Count", extension.count),
    }
    writer.flag("ObjExtend", extension.extends_object);
    writer.extensions(&template.extensions, subject);
}
