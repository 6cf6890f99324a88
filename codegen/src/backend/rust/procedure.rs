//! Procedures that consist only of object writes, such as a start-up list. These procedures become constants that a
//! program can send.

use super::code::{list, seq, Declaration};
use super::context::Context;
use super::doc_table;
use super::docs::{self, WORDS};
use super::links::DocModule;
use super::literal;
use super::pdo;
use super::scope::ObjectBus;
use crate::ir::{Binding, Device, Item, Procedure, Step, Type, Value};
use crate::names::{self, Case};
use crate::number::{hex16, hex8};

/// Returns a constant for each procedure that consists only of object writes.
pub(super) fn models(context: &Context<'_>, device: &Device) -> Vec<Declaration> {
    let procedures = device.procedures.iter();
    let procedures: Vec<(&Procedure, Vec<String>)> =
        procedures.filter_map(|procedure| Some((procedure, writes(context, procedure)?))).collect();
    let name_requests = names::numbered(procedures.iter().map(|(procedure, _)| procedure.name.as_str()), "procedure");
    let names = names::unique(name_requests, &["rt"], Case::Snake);
    let constant = |((procedure, writes), name): (&(&Procedure, Vec<String>), String)| {
        let start = seq!["const ", name.to_ascii_uppercase(), ": [rt::SdoWrite; ", writes.len(), "]"];
        Declaration::new(documentation(context, procedure), start, list("[", writes, "]"))
    };
    procedures.iter().zip(names).map(constant).collect()
}

fn documentation(context: &Context<'_>, procedure: &Procedure) -> Vec<String> {
    let mut sentences = WORDS.description(procedure.documentation.as_deref());
    if sentences.is_empty() {
        sentences.push(docs::sentence(&docs::escape(&procedure.name)));
    }
    sentences.extend(WORDS.manual_entry(&context.manual, "", procedure.documentation.as_deref(), &procedure.names));
    sentences.extend(docs::doubts(&procedure.doubts, &context.manual));
    let rows: Vec<[String; 2]> = procedure.steps.iter().filter_map(|step| row(context, step)).collect();
    docs::paragraphs(sentences).into_iter().chain(doc_table::table(["Item", "Value"], &rows)).collect()
}

/// Returns the cells of a table row: the item and the value that is written. Returns `None` if the step does not write
/// a constant value.
fn row(context: &Context<'_>, step: &Step) -> Option<[String; 2]> {
    let Step::Write(name, value) = step else { return None };
    let item = context.link(name, DocModule::OTHER).unwrap_or_else(|| docs::escape(name));
    let ty = context.referred(name).map_or(Type::Opaque(None), |item| context.base(item.ty));
    Some([item, docs::typed(value, ty)])
}

/// Returns the constructor calls of a procedure's writes. Returns `None` if there are no steps, or if a step does not
/// write a constant integer. Also returns `None` if a step writes to an item that is not an object with an 8-, 16- or
/// 32-bit integer type, or if the value does not fit in this type.
fn writes(context: &Context<'_>, procedure: &Procedure) -> Option<Vec<String>> {
    let writes: Option<Vec<String>> = procedure.steps.iter().map(|step| write(context, step)).collect();
    writes.filter(|writes| !writes.is_empty())
}

fn write(context: &Context<'_>, step: &Step) -> Option<String> {
    let Step::Write(name, Value::Int(value)) = step else { return None };
    let item = context.referred(name)?;
    let (index, sub_index) = object(context, item)?;
    let (Type::Unsigned(bits @ (8 | 16 | 32)) | Type::Integer(bits @ (8 | 16 | 32))) = context.base(item.ty) else {
        return None;
    };
    let mask = (1i128 << bits) - 1;
    let number = value & mask;
    // Do not truncate a number that does not fit in its item. A lint of the compiler reports numbers that do not fit.
    if *value != number && *value != number - mask - 1 {
        return None;
    }
    let number = match bits {
        8 => hex8(number),
        16 => hex16(number),
        _ => literal::word(number),
    };
    Some(pdo::write(&format!("u{bits}"), index, sub_index, &number))
}

/// Returns the index and sub-index of an item on the bus of the device.
fn object(context: &Context<'_>, item: &Item) -> Option<(u16, u8)> {
    item.bindings.iter().find_map(|binding| match binding {
        Binding::Object { buses, index, sub_index } => {
            let is_there = if context.bus == ObjectBus::CoE { buses.coe } else { buses.canopen };
            is_there.then_some((*index, *sub_index))
        }
        _ => None,
    })
}
