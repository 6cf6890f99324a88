//! The default process image. For each sync manager, the image contains the PDOs that are assigned by default, in the
//! order of the assignment.

use super::Assigned;
use crate::backend::rust::docs;
use crate::backend::rust::method_names::{method_allow, unused_name};
use crate::backend::rust::pdo::{PdoModel, PdoModels};
use crate::collections::HashSet;
use crate::ir::{Direction, Pdo};
use crate::names::{self, Case, NameRequest};

/// The process image of a sync manager.
pub(in super::super) struct ImageModel {
    pub name: String,
    pub title: String,
    pub sync_manager: u8,
    pub bits: u32,
    pub length: usize,
    pub derives: Vec<String>,
    pub fields: Vec<ImageField>,
}

/// A PDO in a process image.
pub(in super::super) struct ImageField {
    pub name: String,
    /// Name of the method that returns the mutable view.
    pub name_mut: String,
    /// Name of the PDO's struct.
    pub pdo: String,
    pub docs: String,
    pub bit: u32,
    pub length: usize,
}

impl ImageModel {
    /// Returns the name of the type that views the process image.
    pub(in super::super) fn view_name(&self) -> String {
        format!("{}View", self.name)
    }

    /// Returns the attribute that suppresses lints about names of the view's methods.
    pub(in super::super) fn view_allow(&self) -> Option<String> {
        method_allow(self.fields.iter().map(|field| field.name.as_str()))
    }

    /// Returns the attribute that suppresses lints about names of the methods that return mutable views.
    pub(in super::super) fn view_mut_allow(&self) -> Option<String> {
        method_allow(self.fields.iter().map(|field| field.name_mut.as_str()))
    }
}

pub(super) fn models(pdos: &PdoModels<'_>, assigned: &[Assigned<'_>]) -> Vec<ImageModel> {
    let mut images = Vec::new();
    let mut numbers: Vec<u8> = assigned.iter().map(|(_, sync_manager)| *sync_manager).collect();
    numbers.sort_unstable();
    numbers.dedup();
    for number in numbers {
        let inside = assigned.iter().filter(|(_, sync_manager)| *sync_manager == number).map(|(pdo, _)| *pdo);
        let inside: Vec<&Pdo> = inside.collect();
        let Some(first) = inside.first() else { continue };
        let kind = match first.direction {
            Direction::Receive => "Outputs",
            Direction::Transmit => "Inputs",
        };
        if let Some(image) = model(kind, number, &inside, pdos) {
            images.push(image);
        }
    }
    let mut kinds: Vec<String> = images.iter().map(|image| image.name.clone()).collect();
    kinds.sort();
    for image in &mut images {
        if kinds.iter().filter(|kind| **kind == image.name).count() > 1 {
            image.name = format!("{}Sm{}", image.name, image.sync_manager);
        }
    }
    images
}

fn model(kind: &str, sync_manager: u8, inside: &[&Pdo], pdos: &PdoModels<'_>) -> Option<ImageModel> {
    let mut bit = 0u32;
    let mut placed = Vec::new();
    for pdo in inside {
        placed.extend(pdos.of(pdo).map(|model| (model, bit)));
        bit = bit.checked_add(pdo.bits())?;
    }
    let derives = placed.first()?.0.derives.clone();
    Some(ImageModel {
        name: kind.to_owned(),
        title: format!("{kind}: data of sync manager {sync_manager} with the default PDO assignment."),
        sync_manager,
        bits: bit,
        length: bit.div_ceil(8) as usize,
        derives,
        fields: fields(&placed),
    })
}

/// Names that field methods of a view must not have. These are keywords, the other methods of the view, and methods of
/// traits that any type may implement.
const RESERVED: [&str; 7] = ["new", "clone", "into", "try_into", "self", "super", "crate"];

/// Maximum length of a field's name, without a suffix that makes the name unique. The limit keeps the generated lines
/// that unpack the field short.
const MAX_NAME: usize = 30;

fn fields(placed: &[(&PdoModel, u32)]) -> Vec<ImageField> {
    let name_requests = placed.iter().map(|(model, bit)| {
        let index = format!("{:04X}", model.mapping_index);
        NameRequest { name: &model.name, fallback: format!("pdo {index}"), suffix: format!("{index}_{bit}") }
    });
    let names = names::unique_up_to(name_requests, &RESERVED, Case::Snake, MAX_NAME);
    let used: HashSet<&String> = names.iter().collect();
    let field = |((model, bit), name): (&(&PdoModel, u32), &String)| ImageField {
        name: names::escaped(name),
        name_mut: unused_name(|name| used.contains(name), format!("{name}_mut")),
        pdo: model.name.clone(),
        docs: docs::sentence(model.docs.first().map_or("", String::as_str)),
        bit: *bit,
        length: model.length,
    };
    placed.iter().zip(&names).map(field).collect()
}
