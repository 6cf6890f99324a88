//! Procedures that are nothing but writes of objects, such as a start-up list: constants that a program sends as they are.

use super::context::Context;
use super::doc_table;
use super::docs;
use super::docs::WORDS;
use super::links::Here;
use super::scope::ObjectBus;
use crate::ir::{Binding, Device, Item, Procedure, Step, SubjectKind, Type, Value};
use crate::names::{self, Case};

/// A procedure, ready to be written.
pub(super) struct ProcedureModel {
    pub name: String,
    pub docs: Vec<String>,
    /// The calls that make the writes.
    pub writes: Vec<String>,
}

pub(super) fn models(context: &Context<'_>, device: &Device) -> Vec<ProcedureModel> {
    let own = device.procedures.iter();
    let own: Vec<(&Procedure, Vec<String>)> = own.filter_map(|own| Some((own, writes(context, own)?))).collect();
    let wishes = names::numbered(own.iter().map(|(own, _)| own.name.as_str()), "procedure");
    let names = names::unique(&wishes, &["rt"], Case::Snake);
    own.into_iter()
        .zip(names)
        .map(|((own, writes), name)| ProcedureModel {
            name: name.to_ascii_uppercase(),
            docs: documentation(context, own),
            writes,
        })
        .collect()
}

fn documentation(context: &Context<'_>, own: &Procedure) -> Vec<String> {
    let mut sentences = Vec::new();
    docs::words(own.documentation.as_deref(), &mut sentences);
    if sentences.is_empty() {
        sentences.push(docs::sentence(&docs::escape(&own.name)));
    }
    sentences.extend(WORDS.place(&context.manual, "", own.documentation.as_deref(), &own.names));
    let mut lines: Vec<String> = sentences.into_iter().flat_map(|sentence| [String::new(), sentence]).collect();
    docs::doubts_about(context, SubjectKind::Procedure, &own.name, &mut lines);
    let rows: Vec<[String; 2]> = own.steps.iter().filter_map(|step| row(context, step)).collect();
    lines.into_iter().skip(1).chain(doc_table::table(["Item", "Value"], &rows)).collect()
}

/// The item and the value of a write.
fn row(context: &Context<'_>, step: &Step) -> Option<[String; 2]> {
    let Step::Write(name, value) = step else { return None };
    let item = context.link(name, Here::BESIDE).unwrap_or_else(|| docs::escape(name));
    let ty = context.referred(name).map_or(Type::Opaque(None), |item| context.base(item.ty));
    Some([item, docs::typed(value, ty)])
}

/// The writes of a procedure; `None` where it has other steps, or values that only the device knows.
fn writes(context: &Context<'_>, own: &Procedure) -> Option<Vec<String>> {
    let writes: Option<Vec<String>> = own.steps.iter().map(|step| write(context, step)).collect();
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
    // A number that its item can't have has its finding; it isn't cut to another one.
    if *value != number && *value != number - mask - 1 {
        return None;
    }
    let number = match bits {
        8 => format!("0x{number:02X}"),
        16 => format!("0x{number:04X}"),
        _ => format!("0x{:04X}_{:04X}", number >> 16, number & 0xFFFF),
    };
    Some(format!("rt::SdoWrite::new_u{bits}(0x{index:04X}, 0x{sub_index:02X}, {number})"))
}

/// Where an item is on the bus of the device.
fn object(context: &Context<'_>, item: &Item) -> Option<(u16, u8)> {
    item.bindings.iter().find_map(|binding| match binding {
        Binding::Object { buses, index, sub_index } => {
            let is_there = if context.bus == ObjectBus::CoE { buses.coe } else { buses.canopen };
            is_there.then_some((*index, *sub_index))
        }
        _ => None,
    })
}
