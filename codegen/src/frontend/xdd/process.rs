//! Reads the application process: lists of data types, parameters, templates and groups.

use super::application::{dangling, insert, Application};
use super::reader::{Reader, Texts};
use super::{data_type_list, parameter};
use crate::frontend::xml::{Given, Read};
use crate::ir::{CompactString, Extension};
use crate::syntax::xml::Tag;

/// Maximum number of characters of a group label that are stored with each parameter of the group.
const MAX_GROUP_LABEL: usize = 128;

/// References of groups to parameters, each with the label of the innermost group that has a label.
type Grouped<'a> = Vec<(Given<'a>, CompactString)>;

/// Reads an `ApplicationProcess` element.
pub(super) fn read<'a>(reader: &mut Reader<'a, '_>, parent: &Tag<'a>, application: &mut Application<'a>) -> Read<()> {
    let mut grouped = Grouped::new();
    while let Some(list) = reader.child(parent)? {
        match list.name {
            "dataTypeList" => {
                while let Some(tag) = reader.child(&list)? {
                    data_type_list::read(reader, &tag, application)?;
                }
            }
            "parameterList" => reader.each(&list, "parameter", |reader, tag| {
                let (id, parameter) = parameter::read(reader, tag)?;
                insert(reader, &mut application.parameter_ids, id, application.parameters.len());
                application.parameters.push(parameter);
                Ok(())
            })?,
            "templateList" => {
                while let Some(tag) = reader.child(&list)? {
                    template(reader, &tag, application)?;
                }
            }
            "parameterGroupList" => groups(reader, &list, &mut grouped)?,
            "functionTypeList" | "functionInstanceList" => reader.keep(&list)?,
            _ => reader.unknown(&list)?,
        }
    }
    note_groups(reader, application, grouped);
    Ok(())
}

fn template<'a>(reader: &mut Reader<'a, '_>, tag: &Tag<'a>, application: &mut Application<'a>) -> Read<()> {
    match tag.name {
        "parameterTemplate" => {
            let (id, parameter) = parameter::read(reader, tag)?;
            insert(reader, &mut application.template_ids, id, application.templates.len());
            application.templates.push(parameter);
        }
        "allowedValuesTemplate" => {
            let id = reader.attribute(tag, "uniqueID")?;
            insert(reader, &mut application.allowed_ids, id, application.allowed_templates.len());
            application.allowed_templates.push(parameter::allowed(reader, tag)?);
        }
        _ => reader.unknown(tag)?,
    }
    Ok(())
}

/// Reads parameter groups, which may be nested.
fn groups<'a>(reader: &mut Reader<'a, '_>, parent: &Tag<'a>, grouped: &mut Grouped<'a>) -> Read<()> {
    let mut texts = Texts::default();
    let first = grouped.len();
    while let Some(tag) = reader.child(parent)? {
        match tag.name {
            "parameterGroup" => groups(reader, &tag, grouped)?,
            "parameterRef" => {
                let given = reader.attribute(&tag, "uniqueIDRef")?;
                if !given.is_missing() {
                    grouped.push((given, CompactString::default()));
                }
            }
            _ => reader.text_or_keep(&tag, &mut texts)?,
        }
    }
    // The label is copied for each reference, so its length is limited.
    let label: CompactString = texts.labels.name().chars().take(MAX_GROUP_LABEL).collect();
    for (_, name) in grouped.iter_mut().skip(first).filter(|(_, name)| name.is_empty()) {
        name.clone_from(&label);
    }
    Ok(())
}

fn note_groups<'a>(reader: &mut Reader<'a, '_>, application: &mut Application<'a>, grouped: Grouped<'a>) {
    for (given, value) in grouped {
        match application.parameter_ids.get(given.text.as_ref()) {
            Some(&at) if !value.is_empty() => {
                let parameter = &mut application.parameters[at];
                parameter.weight += size_of::<Extension>() + value.len();
                let key = "parameterGroup".into();
                parameter.extensions.push(Extension { key, value, span: given.span });
            }
            Some(_) => {}
            None => dangling(reader, &given, "parameter"),
        }
    }
}
