//! Reads files that a description refers to: further descriptions, dictionaries, diagnosis messages.

use std::collections::VecDeque;
use std::path::Path;

use super::budget::Budget;
use super::budget::Cost;
use super::description::{Description, EntryType, Owner, Reference, Target};
use super::document::document;
use super::lower::check_length;
use super::types::guessed;
use crate::collections::{HashMap, HashMapExt, HashSet};
use crate::diagnostics::{codes, Diagnostics};
use crate::ir::{Catalog, CodeTable, Device, Extension, Group, Shape, Type, TypeDef, TypeId};
use crate::number::hex16;
use crate::source::{References, Source, Span};

/// Content of a referenced file, with the cost of each copy and the elements that already have a copy.
struct Content {
    catalog: Catalog,
    dictionary: Cost,
    messages: Cost,
    /// True if the content was copied. The first copy is free because it is not larger than the file.
    is_copied: bool,
    /// Elements that already have a copy of the content.
    owners: HashSet<(Owner, Target)>,
}

impl Content {
    fn new(catalog: Catalog, length: usize) -> Self {
        let dictionary = catalog.devices.iter().find(|device| device.dictionary_only);
        let dictionary = dictionary.map_or(Cost::text(0), |device| cost_of(device, length));
        let items = catalog.code_tables.iter().map(|table| table.rows.len()).sum();
        let messages = Cost { items, bytes: length + catalog.code_tables.len() * size_of::<CodeTable>() };
        Content { catalog, dictionary, messages, is_copied: false, owners: HashSet::default() }
    }
}

/// Reads all files that `description` refers to, directly or indirectly. Reads each file once.
pub(super) fn follow(
    main: &Source,
    description: &mut Description,
    references: &mut References<'_>,
    diagnostics: &mut Diagnostics,
    budget: &mut Budget,
) {
    let main_name = Path::new(main.name()).file_name().map(|name| name.to_string_lossy().into_owned());
    // Content of each file for later references; `None` if later references cannot use the file.
    let mut files: HashMap<String, Option<Content>> = HashMap::default();
    // A description with devices does not use the devices of referenced files. A description without devices may be a
    // list of other files, so it uses their devices.
    let only_modules = !description.catalog.devices.is_empty();
    let mut is_reported = false;
    let mut queue: VecDeque<(Owner, Reference)> = std::mem::take(&mut description.references).into();
    while let Some((owner, reference)) = queue.pop_front() {
        let name = normal(&reference.name);
        // A reference of the main file to itself adds nothing.
        if Some(&name) == main_name.as_ref() {
            continue;
        }
        if let Some(content) = files.get_mut(&name) {
            if let (Some(content), true) = (content, reference.target != Target::Info) {
                attach(description, owner, &reference, content, diagnostics, budget);
            }
            continue;
        }
        let Some((mut read, length)) = open(&reference, &mut is_reported, references, diagnostics, budget) else {
            files.insert(name, None);
            continue;
        };
        match reference.target {
            Target::Info => {
                if only_modules {
                    read.catalog.devices.clear();
                    read.references.retain(|(owner, _)| !matches!(owner, Owner::Device(_)));
                    read.entry_types.retain(|(owner, _)| !matches!(owner, Owner::Device(_)));
                }
                queue.extend(join(description, read));
                files.insert(name, None);
            }
            _ => {
                queue.extend(read.references.drain(..).filter(|(owner, _)| *owner == Owner::Catalog));
                let mut content = Content::new(read.catalog, length);
                attach(description, owner, &reference, &mut content, diagnostics, budget);
                files.insert(name, Some(content));
            }
        }
    }
    entry_types(description, diagnostics);
}

/// Resolves those types of PDO entries that only the dictionary of a referenced file can define.
fn entry_types(description: &mut Description, diagnostics: &mut Diagnostics) {
    let Description { catalog, entry_types, refused, .. } = description;
    // The types of a file that was not copied remain unknown.
    entry_types.retain(|(owner, _)| !refused.contains(owner));
    for of_owner in entry_types.chunk_by(|(one, _), (other, _)| one == other) {
        let found = match of_owner.first() {
            Some((Owner::Device(at), _)) => {
                catalog.devices.get_mut(*at).map(|device| (&device.types, &mut device.process_data))
            }
            Some((Owner::Module(at), _)) => {
                catalog.modules.get_mut(*at).map(|module| (&module.types, &mut module.process_data))
            }
            _ => None,
        };
        let Some((types, data)) = found else { continue };
        let mut by_name = HashMap::with_capacity(types.len());
        for (at, def) in types.iter().enumerate() {
            by_name.entry(def.name.as_str()).or_insert((TypeId(at as u32), def));
        }
        let waiting: HashMap<Span, &EntryType> =
            of_owner.iter().map(|(_, entry_type)| (entry_type.entry, entry_type)).collect();
        for entry in data.pdos.iter_mut().flat_map(|pdo| &mut pdo.entries) {
            let Some(entry_type) = waiting.get(&entry.origin.span) else { continue };
            let (ty, bits) = match by_name.get(entry_type.name.text.as_ref()) {
                Some((id, def)) => match def.shape {
                    Shape::Alias(ty) => (ty, def.bits),
                    _ => (Type::Named(*id), def.bits),
                },
                None => {
                    let ty = guessed(diagnostics, &entry_type.name);
                    (ty, ty.bits())
                }
            };
            entry.ty = ty;
            check_length(diagnostics, entry, &entry_type.name, bits);
        }
    }
}

/// Returns the normalized file name, by which references to the same file are recognized.
fn normal(name: &str) -> String {
    let name = name.trim().replace('\\', "/");
    name.trim_start_matches("./").to_owned()
}

/// Reads a referenced file. Returns the contents of the file and its length in bytes. Reports the reference and returns
/// `None` if the file cannot be read.
fn open(
    reference: &Reference,
    is_reported: &mut bool,
    references: &mut References<'_>,
    diagnostics: &mut Diagnostics,
    budget: &mut Budget,
) -> Option<(Description, usize)> {
    let source = match references.open(&reference.name) {
        Ok(source) => source,
        Err(refusal) => {
            let message = format!("the file `{}` was not read: {refusal}", reference.name);
            let found = codes::REFERENCED_FILE.at(reference.span, message);
            let found = found.label("the content of the file is missing");
            // Only the first unreadable file is reported with the help text.
            let help = "put the file in the folder of the description, and make the file readable";
            let is_first = !std::mem::replace(is_reported, true);
            diagnostics.push(if is_first { found.help(help) } else { found });
            return None;
        }
    };
    let mut read = Description::default();
    let length = source.text().len();
    budget.extend(length);
    let outcome = document(&source, references.next_file(), &mut read, diagnostics, budget);
    references.add(source);
    if let Err(stop) = outcome {
        let message = format!("the file `{}` was not read: {}", reference.name, stop.message);
        let found = codes::REFERENCED_FILE.at(reference.span, message).label("the content of the file is missing");
        diagnostics.push(found.note_at(stop.span, "reading ends here"));
        return None;
    }
    Some((read, length))
}

/// Appends the contents of `read` to `description`. Returns the references to further files that `read` contains.
fn join(description: &mut Description, read: Description) -> Vec<(Owner, Reference)> {
    let Description { catalog: mut other, references, entry_types, .. } = read;
    let catalog = &mut description.catalog;
    let (devices, modules) = (catalog.devices.len(), catalog.modules.len());
    catalog.devices.append(&mut other.devices);
    catalog.modules.append(&mut other.modules);
    catalog.families.append(&mut other.families);
    catalog.code_tables.append(&mut other.code_tables);
    catalog.vendor_urls.append(&mut other.vendor_urls);
    catalog.extensions.append(&mut other.extensions);
    if catalog.vendor_names.is_empty() {
        catalog.vendor_names = other.vendor_names.clone();
    }
    let moved = |owner| match owner {
        Owner::Device(at) => Owner::Device(at + devices),
        Owner::Module(at) => Owner::Module(at + modules),
        Owner::Catalog => Owner::Catalog,
    };
    description.entry_types.extend(entry_types.into_iter().map(|(owner, ty)| (moved(owner), ty)));
    references.into_iter().map(|(owner, reference)| (moved(owner), reference)).collect()
}

/// Adds the dictionary or the diagnosis messages of a file to the element that refers to the file, unless the element
/// already has them.
fn attach(
    description: &mut Description,
    owner: Owner,
    reference: &Reference,
    content: &mut Content,
    diagnostics: &mut Diagnostics,
    budget: &mut Budget,
) {
    let is_dictionary = reference.target == Target::Dictionary;
    // The IR has no diagnosis messages for single modules, so the messages of a module belong to the catalog.
    let owner = if is_dictionary || matches!(owner, Owner::Device(_)) { owner } else { Owner::Catalog };
    if !content.owners.insert((owner, reference.target)) {
        return;
    }
    let dictionary = content.catalog.devices.iter().find(|device| device.dictionary_only);
    let found = if is_dictionary { dictionary.is_some() } else { !content.catalog.code_tables.is_empty() };
    if !found {
        let what = if is_dictionary { "dictionary" } else { "diagnosis messages" };
        let message = format!("the file `{}` has no {what}", reference.name);
        diagnostics.push(codes::REFERENCED_FILE.at(reference.span, message).label("the file is ignored"));
        return;
    }
    let cost = if is_dictionary { content.dictionary } else { content.messages };
    if std::mem::replace(&mut content.is_copied, true) && !affordable(budget, cost, reference, diagnostics) {
        description.refused.insert(owner);
        return;
    }
    let Description { catalog, .. } = description;
    if !is_dictionary {
        let (tables, extensions) = match owner {
            Owner::Device(at) => match catalog.devices.get_mut(at) {
                Some(device) => (&mut device.code_tables, &mut device.extensions),
                None => return,
            },
            _ => (&mut catalog.code_tables, &mut catalog.extensions),
        };
        tables.extend(content.catalog.code_tables.iter().cloned());
        extensions.extend(content.catalog.extensions.iter().cloned());
        return;
    }
    let target = match owner {
        Owner::Device(at) => {
            catalog.devices.get_mut(at).map(|device| (&mut device.types, &mut device.groups, &mut device.extensions))
        }
        Owner::Module(at) => {
            catalog.modules.get_mut(at).map(|module| (&mut module.types, &mut module.groups, &mut module.extensions))
        }
        Owner::Catalog => None,
    };
    if let (Some((types, groups, extensions)), Some(dictionary)) = (target, dictionary) {
        extensions.extend(dictionary.extensions.iter().cloned());
        merge(types, groups, dictionary, diagnostics);
    }
}

/// Returns the cost of a copy of a dictionary from a file of `length` bytes. The fields and values of data types count
/// as items.
fn cost_of(dictionary: &Device, length: usize) -> Cost {
    let parts = |shape: &Shape| match shape {
        Shape::Record(fields) => fields.len(),
        Shape::Enumeration { values, .. } => values.len(),
        Shape::BitField { fields, .. } => fields.len(),
        Shape::Alias(_) | Shape::Array { .. } | Shape::Scaled { .. } => 0,
    };
    let of_groups = dictionary.groups.iter().map(|group| group.items.len() + 1);
    let items = of_groups.chain(dictionary.types.iter().map(|def| parts(&def.shape) + 1)).sum();
    let of_groups = dictionary.groups.iter().flat_map(|group| {
        let of_group = group.extensions.len() + usize::from(group.tool_flags.is_some());
        group.items.iter().map(|item| item.extensions.len()).chain([of_group])
    });
    let extensions: usize = of_groups.sum::<usize>() + dictionary.extensions.len();
    Cost { items, bytes: length + extensions * size_of::<Extension>() }
}

/// Subtracts the cost of a copy from the budget. Returns false and reports the reference if the budget is too small.
/// The limit applies because many devices may refer to one large file.
fn affordable(budget: &mut Budget, cost: Cost, reference: &Reference, diagnostics: &mut Diagnostics) -> bool {
    let affordable = budget.take(cost);
    if !affordable {
        let message = "copies of referenced files would exceed the size limit of the description";
        diagnostics.push(codes::INPUT_TOO_LARGE.at(reference.span, message).label("this reference is ignored"));
    }
    affordable
}

/// Adds the types and objects of a dictionary to those of a device or module. Existing objects take precedence.
fn merge(types: &mut Vec<TypeDef>, groups: &mut Vec<Group>, dictionary: &Device, diagnostics: &mut Diagnostics) {
    let offset = types.len() as u32;
    types.extend(dictionary.types.iter().cloned().map(|mut def| {
        shift_shape(&mut def.shape, offset);
        def
    }));
    let existing = groups.len();
    groups.extend(dictionary.groups.iter().cloned());
    for item in groups.iter_mut().skip(existing).flat_map(|group| &mut group.items) {
        shift(&mut item.ty, offset);
    }
    groups.sort_by_key(Group::index);
    groups.dedup_by(|later, earlier| {
        let twice = later.index() == earlier.index();
        if let (true, Some(index)) = (twice, later.index()) {
            let found =
                codes::ESI_DUPLICATE_OBJECT.at(later.origin.span, format!("object {} occurs twice", hex16(index)));
            diagnostics.push(found.label("ignored").note_at(earlier.origin.span, "this object is used"));
        }
        twice
    });
}

fn shift(ty: &mut Type, offset: u32) {
    if let Type::Named(TypeId(at)) = ty {
        *at += offset;
    }
}

fn shift_shape(shape: &mut Shape, offset: u32) {
    match shape {
        Shape::Alias(ty) | Shape::Array { element: ty, .. } => shift(ty, offset),
        Shape::Record(fields) => fields.iter_mut().for_each(|field| shift(&mut field.ty, offset)),
        Shape::BitField { base, .. } | Shape::Enumeration { base, .. } | Shape::Scaled { base, .. } => {
            shift(base, offset);
        }
    }
}
