//! The fields of requests, replies and their repeated parts.

use super::rules::Rules;
use super::steps::number;
use crate::backend::rust::code::{call, seq, Doc};
use crate::backend::rust::context::Context;
use crate::backend::rust::docs::{self, WORDS};
use crate::backend::rust::field_type::{field_type, FieldType};
use crate::backend::rust::links::Here;
use crate::backend::rust::quantity;
use crate::backend::rust::value_type::{native, ValueType};
use crate::backend::rust::variant;
use crate::ir::{Item, MessageValue, Type};
use crate::names::{self, Case};
use crate::resolve::messages::Step;

/// The longest name of a field: the lines that write it have to stay below the margin.
const MAX_NAME: usize = 24;

/// A field, ready to be written.
pub(in crate::backend::rust) struct Field {
    pub name: String,
    pub docs: Vec<String>,
    pub ty: String,
    /// The same as seen from the device, next to the modules.
    ty_at_top: String,
    /// What tells `serde` how to handle it.
    pub attribute: Option<String>,
    /// The name of the constant with its scale, and the type of that.
    pub scale: Option<(String, Doc)>,
    position: usize,
    kind: Kind,
}

enum Kind {
    Value { bits: u32, order: Vec<u8>, encode: String, decode: Doc, check: Option<Check> },
    Text { length: u32 },
    Code { bits: u32 },
    Setting { space: String, bits: u32 },
    Blank { space: String, bits: u32 },
    Settings { space: String, bits: u32 },
    ValueOnly { space: String },
    List,
    Bytes,
}

/// The type that checks a value, the value, and its range.
type Check = (String, String, Doc);

/// The fields of these steps. `entry` is the name of the type of what is repeated, `lifetime` that of what is borrowed.
pub(super) fn fields(context: &Context<'_>, steps: &[Step<'_>], entry: &str) -> Vec<Field> {
    let with: Vec<&Step<'_>> = steps.iter().filter(|step| name(step).is_some()).collect();
    let wishes = names::numbered(with.iter().map(|step| name(step).unwrap_or_default()), "field");
    let reserved = ["self", "super", "crate"];
    let names = names::unique_up_to(&wishes, &reserved, Case::Snake, MAX_NAME);
    let all = with.iter().zip(&names).enumerate();
    all.map(|(position, (step, name))| field(context, step, names::escaped(name), position, entry)).collect()
}

/// What a field is called; `None` for a step that has none.
pub(super) fn name<'s>(step: &'s Step<'_>) -> Option<&'s str> {
    Some(match step {
        Step::Value { value, .. } => value.item.name.as_str(),
        Step::Code { .. } | Step::Blank { .. } => "parameter",
        Step::Setting { .. } => "setting",
        Step::Settings { .. } => "settings",
        Step::ValueOnly { .. } => "value",
        Step::List { .. } => "entries",
        Step::Rest => "rest",
        _ => return None,
    })
}

fn field(context: &Context<'_>, step: &Step<'_>, name: String, position: usize, entry: &str) -> Field {
    let plain = |ty: &str, docs: &str, kind: Kind| Field {
        name: name.clone(),
        docs: vec![docs.to_owned()],
        ty: ty.to_owned(),
        ty_at_top: ty.to_owned(),
        attribute: None,
        scale: None,
        position,
        kind,
    };
    match step {
        Step::Value { bits, value } => typed(context, value, *bits, name, position),
        Step::Code { bits, .. } => plain("rt::Parameter", "Number of the parameter.", Kind::Code { bits: *bits }),
        Step::Blank { bits, space } => {
            plain("rt::Parameter", "Number of the parameter.", Kind::Blank { space: (*space).to_owned(), bits: *bits })
        }
        Step::Setting { bits, space } => plain(
            "rt::message::Setting",
            "The parameter and its value.",
            Kind::Setting { space: (*space).to_owned(), bits: *bits },
        ),
        Step::Settings { bits, space, .. } => plain(
            "rt::message::Settings<'a>",
            "Parameters and their values.",
            Kind::Settings { space: (*space).to_owned(), bits: *bits },
        ),
        Step::ValueOnly { space, .. } => plain(
            "&'a [u8]",
            "The value of the parameter, as it was sent.",
            Kind::ValueOnly { space: (*space).to_owned() },
        ),
        Step::List { .. } => Field {
            ty_at_top: format!("rt::message::List<'a, messages::{entry}>"),
            ..plain(&format!("rt::message::List<'a, {entry}>"), "What is repeated.", Kind::List)
        },
        _ => plain("&'a [u8]", "All bytes that follow.", Kind::Bytes),
    }
}

fn typed(context: &Context<'_>, value: &MessageValue, bits: u32, name: String, position: usize) -> Field {
    let item = &value.item;
    let own = field_type(context, item.ty, bits);
    let named_at_top = matches!(own, FieldType::Named(..)).then(|| own.path(""));
    let base = context.base(item.ty);
    let (ty, kind) = match own {
        FieldType::Bytes(length) => (format!("[u8; {length}]"), Kind::Text { length }),
        // A number of odd width is one of Rust's own that is checked.
        FieldType::Odd(signed, _) => {
            let native = native(signed, bits);
            let width: u32 = native[1..].parse().unwrap_or(64);
            let local = local(position);
            let decode = match (signed, native) {
                (true, _) => format!("({local} << {0}) as {native} >> {0}", width - bits),
                (false, "u64") => local,
                (false, _) => format!("{local} as {native}"),
            };
            let decode = Doc::from(decode);
            let encode = match (signed, native) {
                (false, "u64") => format!("self.{name}"),
                (true, "i64") | (false, _) => format!("self.{name} as u64"),
                (true, _) => format!("self.{name} as u{width} as u64"),
            };
            let check = narrow(item, base, native, format!("self.{name}"));
            (native.to_owned(), Kind::Value { bits, order: value.byte_order.clone(), encode, decode, check })
        }
        other => {
            let ty = other.path("super::");
            // The bits of an integer with a sign are a number without one.
            let base = match &other {
                FieldType::Named(..) => context.enumeration(item.ty).map_or(base, |named| named.ty),
                _ => base,
            };
            let check = match &other {
                // A list of values is a constant in a function, which no call can be part of.
                FieldType::Named(_, native)
                    if other.cut(bits).is_some() || !variant::widest(item).allowed.is_empty() =>
                {
                    narrow(item, base, native, format!("self.{name}.raw()"))
                }
                FieldType::Named(..) => range(item, base, &name, Some(&ty)),
                _ => range(item, base, &name, None),
            };
            let encode = other.encode(&format!("self.{name}"), bits);
            let encode = if ty == "u64" { format!("self.{name}") } else { encode };
            let decode = other.decode(&ty, &Doc::from(local(position)));
            (ty.clone(), Kind::Value { bits, order: value.byte_order.clone(), encode, decode, check })
        }
    };
    let quantity = quantity::of(context, item).filter(|_| !ty.contains("::"));
    let scale = quantity.map(|own| (constant(&name), own.path));
    let ty_at_top = named_at_top.unwrap_or_else(|| ty.clone());
    Field { docs: documentation(context, item, base), ty, ty_at_top, attribute: None, scale, position, kind, name }
}

/// The variable with what was read of the field at a position.
fn local(position: usize) -> String {
    format!("value_{position}")
}

/// The check of a value; `None` where all numbers of the type are allowed.
fn range(item: &Item, base: Type, name: &str, named: Option<&str>) -> Option<Check> {
    let ty = ValueType::of(base);
    let wrap = |literal: String| match named {
        Some(path) => call!(seq![path, "::from_raw"], literal),
        None => Doc::from(literal),
    };
    let range = ty.range_as(&variant::widest(item), &wrap);
    let path = named.unwrap_or(ty.path()).to_owned();
    (range.text() != "rt::Range::Full").then(|| (path, format!("self.{name}"), range))
}

/// The same for a number that has fewer bits than its type in Rust.
fn narrow(item: &Item, base: Type, native: &str, value: String) -> Option<Check> {
    let own = ValueType::Odd { name: "", range: base.integer_range()? };
    Some((native.to_owned(), value, own.range_within(&variant::widest(item))?))
}

/// The name of the constant with the scale of a field.
fn constant(field: &str) -> String {
    let name = field.trim_start_matches("r#").to_ascii_uppercase();
    match name.as_str() {
        // Of messages.
        "NAME" | "COMPLETION" | "OUTCOMES" => name + "_SCALE",
        _ => name,
    }
}

fn documentation(context: &Context<'_>, item: &Item, base: Type) -> Vec<String> {
    let link = |id, name: &str| context.link_to(id, name, Here::MESSAGES);
    let words = docs::linked(&link);
    let mut facts = format!("{base}");
    facts.extend(docs::limits(item).map(|limits| format!(", {limits}")));
    facts += &item.quantity.as_ref().map(|own| words.quantity(own)).unwrap_or_default();
    let name = docs::escape(&item.name);
    let mut lines = vec![format!("{}: {facts}.", name.trim_end_matches(['.', ':']))];
    let mut sentences = Vec::new();
    docs::words(item.documentation.as_deref(), &mut sentences);
    sentences.extend(item.quantity.iter().flat_map(|own| docs::WORDS.notes(own)).filter(|own| !own.is_empty()));
    sentences.extend(WORDS.place(&context.manual, "", item.documentation.as_deref(), &item.names));
    sentences.extend(item.doubts.iter().map(|own| WORDS.doubt(&context.manual, own)));
    for sentence in sentences {
        lines.extend([String::new(), sentence]);
    }
    lines
}

impl Field {
    /// The variable with what was read.
    pub(super) fn local(&self) -> String {
        match self.kind {
            Kind::List => "list".to_owned(),
            _ => local(self.position),
        }
    }

    /// Whether it borrows from the data.
    pub(super) fn borrows(&self) -> bool {
        self.ty.contains("'a")
    }

    /// The number of bytes, of a text.
    pub(super) fn text_length(&self) -> Option<u32> {
        match self.kind {
            Kind::Text { length } => Some(length),
            _ => None,
        }
    }

    /// Whether limits of it may resemble a mathematical constant, which clippy would point out.
    pub(super) fn has_real_limits(&self) -> bool {
        matches!(&self.kind, Kind::Value { check: Some((ty, ..)), .. } if ty.starts_with('f'))
    }

    /// Whether it is what is repeated.
    pub(super) fn is_list(&self) -> bool {
        matches!(self.kind, Kind::List)
    }

    /// Whether it has the value of one parameter of a space.
    pub(super) fn is_value_of(&self, space: &str) -> bool {
        match &self.kind {
            Kind::Setting { space: own, .. } | Kind::ValueOnly { space: own } => own == space,
            _ => false,
        }
    }

    /// What a method takes for it under this name, and how the field is made of that.
    pub(super) fn argument(&self, name: &str, rules: &Rules) -> (String, (String, Doc)) {
        match &self.kind {
            Kind::Settings { space, bits } => {
                let rule = format!("messages::{}", rules.name(space, Some(*bits)));
                let own = call!("rt::message::Settings::sent", name, rule);
                (format!("{name}: &'a [rt::message::Setting]"), (self.name.clone(), own))
            }
            _ => (format!("{name}: {}", self.ty_at_top), (self.name.clone(), Doc::from(name))),
        }
    }

    pub(super) fn write(&self, rules: &Rules) -> Vec<Doc> {
        let name = &self.name;
        match &self.kind {
            Kind::Value { bits, order, encode, check, .. } => {
                let mut lines = Vec::new();
                if let Some((ty, value, range)) = check {
                    lines.push(seq!["let range = ", range, ";"]);
                    lines.push(seq!["rt::message::check::<", ty, ">(", value, ", &range)?;"]);
                }
                lines.push(number(*bits, order, encode));
                lines
            }
            Kind::Text { .. } => vec![seq!["to.bytes(&self.", name, ")?;"]],
            Kind::Code { bits } => {
                let mut lines = Vec::new();
                if *bits < 32 {
                    let last = (1_u64 << bits) - 1;
                    let check = format!("rt::message::check::<u32>(self.{name}.0, &rt::Range::To({last}))?;");
                    lines.push(Doc::from(check));
                }
                lines.push(seq!["to.number(", *bits, ", self.", name, ".0.into())?;"]);
                lines
            }
            Kind::Setting { space, bits } => {
                vec![seq![rules.name(space, Some(*bits)), ".write(&self.", name, ", to)?;"]]
            }
            Kind::Blank { space, bits } => {
                vec![seq![rules.name(space, Some(*bits)), ".write_blank(self.", name, ", to)?;"]]
            }
            Kind::Settings { .. } | Kind::List => vec![seq!["self.", name, ".write(to)?;"]],
            Kind::ValueOnly { .. } | Kind::Bytes => vec![seq!["to.bytes(self.", name, ")?;"]],
        }
    }

    pub(super) fn read(&self, rules: &Rules, tail: u32) -> String {
        match &self.kind {
            Kind::Value { bits, order, .. } if order.is_empty() => format!("from.number({bits})?"),
            Kind::Value { order, .. } => format!("from.ordered(&{order:?})?"),
            Kind::Text { length } => format!("from.bytes({length})?"),
            Kind::Code { bits } => format!("from.number({bits})?"),
            Kind::Setting { space, bits } => format!("{}.read_to(from, {tail})?", rules.name(space, Some(*bits))),
            Kind::Blank { space, bits } => format!("{}.read_blank(from)?", rules.name(space, Some(*bits))),
            Kind::Settings { .. } | Kind::ValueOnly { .. } | Kind::List | Kind::Bytes => format!("from.but({tail})?"),
        }
    }

    pub(super) fn decode(&self, rules: &Rules) -> Doc {
        let local = self.local();
        match &self.kind {
            Kind::Value { decode, .. } => decode.clone(),
            Kind::Text { .. } => seq![local, ".try_into().ok()?"],
            Kind::Code { .. } => seq!["rt::Parameter(", local, " as u32)"],
            Kind::Setting { .. } | Kind::Blank { .. } | Kind::ValueOnly { .. } | Kind::Bytes => Doc::from(local),
            Kind::Settings { space, bits } => {
                seq![call!("rt::message::Settings::received", local, rules.name(space, Some(*bits))), "?"]
            }
            Kind::List => seq!["rt::message::List::received(", local, ")?"],
        }
    }
}
