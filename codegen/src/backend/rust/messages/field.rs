//! Fields of requests, replies and list entries.

use super::rules::Rules;
use super::steps::number;
use crate::backend::rust::code::{call, seq, Doc};
use crate::backend::rust::context::Context;
use crate::backend::rust::docs::{self, WORDS};
use crate::backend::rust::field_type::{field_type, FieldType};
use crate::backend::rust::links::DocModule;
use crate::backend::rust::quantity;
use crate::backend::rust::value_type::{native, native_bits, ValueType};
use crate::backend::rust::variant;
use crate::ir::{Item, MessageValue, Type};
use crate::names::{self, Case};
use crate::resolve::messages::Step;

/// Maximum length of a field's name, without a suffix that makes the name unique. The limit keeps the generated lines
/// that write the field short.
const MAX_NAME: usize = 24;

/// A field, ready to be printed.
pub(in crate::backend::rust) struct Field {
    pub name: String,
    pub docs: Vec<String>,
    pub ty: String,
    /// The Rust type of the field, as written in the device's module.
    ty_at_top: String,
    /// Attribute that controls how `serde` handles the field.
    pub attribute: Option<String>,
    /// Name of the constant for the field's scale, and the type of the scale.
    pub scale: Option<(String, Doc)>,
    position: usize,
    kind: FieldKind,
}

enum FieldKind {
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

/// A range check: the Rust type, the expression of the value, and the allowed range.
type Check = (String, String, Doc);

/// Returns the fields for these steps. `entry` is the name of the type of list entries.
pub(super) fn fields(context: &Context<'_>, steps: &[Step<'_>], entry: &str) -> Vec<Field> {
    let with: Vec<&Step<'_>> = steps.iter().filter(|step| name(step).is_some()).collect();
    let name_requests = names::numbered(with.iter().map(|step| name(step).unwrap_or_default()), "field");
    let reserved = ["self", "super", "crate"];
    let names = names::unique_up_to(name_requests, &reserved, Case::Snake, MAX_NAME);
    let all = with.iter().zip(&names).enumerate();
    all.map(|(position, (step, name))| field(context, step, names::escaped(name), position, entry)).collect()
}

/// Returns the name of a step's field. Returns `None` if the step has no field.
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
    let plain = |ty: &str, docs: &str, kind: FieldKind| Field {
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
        Step::Code { bits, .. } => plain("rt::Parameter", "Number of the parameter.", FieldKind::Code { bits: *bits }),
        Step::Blank { bits, space } => plain(
            "rt::Parameter",
            "Number of the parameter.",
            FieldKind::Blank { space: space.to_string(), bits: *bits },
        ),
        Step::Setting { bits, space } => plain(
            "rt::message::Setting",
            "The parameter and its value.",
            FieldKind::Setting { space: space.to_string(), bits: *bits },
        ),
        Step::Settings { bits, space, .. } => plain(
            "rt::message::Settings<'a>",
            "Parameters and their values.",
            FieldKind::Settings { space: space.to_string(), bits: *bits },
        ),
        Step::ValueOnly { space, .. } => plain(
            "&'a [u8]",
            "Bytes of the parameter's value, in the byte order of the message.",
            FieldKind::ValueOnly { space: space.to_string() },
        ),
        Step::List { .. } => Field {
            ty_at_top: format!("rt::message::List<'a, messages::{entry}>"),
            ..plain(&format!("rt::message::List<'a, {entry}>"), "Entries of the list.", FieldKind::List)
        },
        _ => plain("&'a [u8]", "All remaining bytes of the message.", FieldKind::Bytes),
    }
}

fn typed(context: &Context<'_>, value: &MessageValue, bits: u32, name: String, position: usize) -> Field {
    let item = &value.item;
    let field_type = field_type(context, item.ty, bits);
    let named_at_top = matches!(field_type, FieldType::Named(..)).then(|| field_type.path(""));
    let base = context.base(item.ty);
    let (ty, kind) = match field_type {
        FieldType::Bytes(length) => (format!("[u8; {length}]"), FieldKind::Text { length }),
        // If no primitive integer has the width of the number, the number is stored in a wider primitive integer and
        // needs a range check.
        FieldType::Odd(signed, _) => {
            let native = native(signed, bits);
            let width = native_bits(native);
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
            (native.to_owned(), FieldKind::Value { bits, order: value.byte_order.clone(), encode, decode, check })
        }
        other => {
            let ty = other.path("super::");
            // The base type of a bit field is unsigned, even if the type of the item is signed.
            let base = match &other {
                FieldType::Named(..) => context.enumeration(item.ty).map_or(base, |named| named.ty),
                _ => base,
            };
            let check = match &other {
                // This check uses the raw value. The list of allowed values is a `'static` slice, which cannot contain
                // the calls that create variants.
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
            (ty.clone(), FieldKind::Value { bits, order: value.byte_order.clone(), encode, decode, check })
        }
    };
    let quantity = quantity::of(context, item).filter(|_| !ty.contains("::"));
    let scale = quantity.map(|quantity| (constant(&name), quantity.path));
    let ty_at_top = named_at_top.unwrap_or_else(|| ty.clone());
    Field { docs: documentation(context, item, base), ty, ty_at_top, attribute: None, scale, position, kind, name }
}

/// Returns the name of the variable that holds the undecoded value of the field at `position`.
fn local(position: usize) -> String {
    format!("value_{position}")
}

/// Returns the range check of a field's value. Returns `None` if all numbers of the type are allowed.
fn range(item: &Item, base: Type, name: &str, named: Option<&str>) -> Option<Check> {
    let ty = ValueType::of(base);
    let wrap = |literal: String| match named {
        Some(path) => call!(seq![path, "::from_raw"], literal),
        None => Doc::from(literal),
    };
    let range = ty.range_as(&variant::widest(item), &wrap);
    let path = named.map_or_else(|| ty.path(), str::to_owned);
    (range.text() != "rt::Range::Full").then(|| (path, format!("self.{name}"), range))
}

/// Returns the range check for a number that has fewer bits than its Rust type. The check accepts the listed values or,
/// if there is no list, the numbers within the limits and the width.
fn narrow(item: &Item, base: Type, native: &str, value: String) -> Option<Check> {
    let value_type = ValueType::Odd { bits: 0, range: base.integer_range()? };
    Some((native.to_owned(), value, value_type.range_within(&variant::widest(item))?))
}

/// Returns the name of the constant for a field's scale.
fn constant(field: &str) -> String {
    let name = field.trim_start_matches("r#").to_ascii_uppercase();
    match name.as_str() {
        // The types of messages already have constants with these names.
        "NAME" | "COMPLETION" | "OUTCOMES" => name + "_SCALE",
        _ => name,
    }
}

fn documentation(context: &Context<'_>, item: &Item, base: Type) -> Vec<String> {
    let link = |id, name: &str| context.link_to(id, name, DocModule::MESSAGES);
    let words = docs::linked(&link);
    let mut facts: Vec<String> = item.quantity.iter().filter_map(|quantity| words.unit(quantity)).collect();
    facts.extend(docs::limits(item));
    facts.push(base.to_string());
    let facts = facts.join(", ");
    let name = docs::escape(&item.name);
    let mut sentences = vec![format!("{}: {facts}.", name.trim_end_matches(['.', ':']))];
    sentences.extend(WORDS.description(item.documentation.as_deref()));
    let notes = item.quantity.iter().flat_map(|quantity| docs::WORDS.notes(quantity));
    sentences.extend(notes.filter(|note| !note.is_empty()));
    sentences.extend(WORDS.manual_entry(&context.manual, "", item.documentation.as_deref(), &item.names));
    sentences.extend(item.doubts.iter().map(|doubt| WORDS.doubt(&context.manual, doubt)));
    docs::paragraphs(sentences)
}

impl Field {
    /// Returns the name of the variable that holds the undecoded value of the field.
    pub(super) fn local(&self) -> String {
        match self.kind {
            FieldKind::List => "list".to_owned(),
            _ => local(self.position),
        }
    }

    /// Returns whether the field borrows from the message data.
    pub(super) fn borrows(&self) -> bool {
        self.ty.contains("'a")
    }

    /// Returns the number of bytes of a text. Returns `None` if the field is not a text.
    pub(super) fn text_length(&self) -> Option<u32> {
        match self.kind {
            FieldKind::Text { length } => Some(length),
            _ => None,
        }
    }

    /// Returns whether the limits of the field are real numbers. Clippy reports literals that are close to a
    /// mathematical constant.
    pub(super) fn has_real_limits(&self) -> bool {
        matches!(&self.kind, FieldKind::Value { check: Some((ty, ..)), .. } if ty.starts_with('f'))
    }

    /// Returns whether the field is a list.
    pub(super) fn is_list(&self) -> bool {
        matches!(self.kind, FieldKind::List)
    }

    /// Returns whether the field contains the value of a single parameter from the parameter space `space`.
    pub(super) fn is_value_of(&self, space: &str) -> bool {
        match &self.kind {
            FieldKind::Setting { space: of_field, .. } | FieldKind::ValueOnly { space: of_field } => of_field == space,
            _ => false,
        }
    }

    /// Returns the method argument `name`, which sets the field, and the field initializer that uses this argument.
    pub(super) fn argument(&self, name: &str, rules: &Rules) -> (String, (String, Doc)) {
        match &self.kind {
            FieldKind::Settings { space, bits } => {
                let rule = format!("messages::{}", rules.name(space, Some(*bits)));
                let sent = call!("rt::message::Settings::sent", name, rule);
                (format!("{name}: &'a [rt::message::Setting]"), (self.name.clone(), sent))
            }
            _ => (format!("{name}: {}", self.ty_at_top), (self.name.clone(), Doc::from(name))),
        }
    }

    pub(super) fn write(&self, rules: &Rules) -> Vec<Doc> {
        let name = &self.name;
        match &self.kind {
            FieldKind::Value { bits, order, encode, check, .. } => {
                let mut lines = Vec::new();
                if let Some((ty, value, range)) = check {
                    lines.push(seq!["let range = ", range, ";"]);
                    lines.push(seq!["rt::message::check::<", ty, ">(", value, ", &range)?;"]);
                }
                lines.push(number(*bits, order, encode));
                lines
            }
            FieldKind::Text { .. } => vec![seq!["to.bytes(&self.", name, ")?;"]],
            FieldKind::Code { bits } => {
                let mut lines = Vec::new();
                if *bits < 32 {
                    let last = (1_u64 << bits) - 1;
                    let check = format!("rt::message::check::<u32>(self.{name}.0, &rt::Range::To({last}))?;");
                    lines.push(Doc::from(check));
                }
                lines.push(seq!["to.number(", *bits, ", self.", name, ".0.into())?;"]);
                lines
            }
            FieldKind::Setting { space, bits } => {
                vec![seq![rules.name(space, Some(*bits)), ".write(&self.", name, ", to)?;"]]
            }
            FieldKind::Blank { space, bits } => {
                vec![seq![rules.name(space, Some(*bits)), ".write_blank(self.", name, ", to)?;"]]
            }
            FieldKind::Settings { .. } | FieldKind::List => vec![seq!["self.", name, ".write(to)?;"]],
            FieldKind::ValueOnly { .. } | FieldKind::Bytes => vec![seq!["to.bytes(self.", name, ")?;"]],
        }
    }

    pub(super) fn read(&self, rules: &Rules, tail: u32) -> String {
        match &self.kind {
            FieldKind::Value { bits, order, .. } if order.is_empty() => format!("from.number({bits})?"),
            FieldKind::Value { order, .. } => format!("from.ordered(&{order:?})?"),
            FieldKind::Text { length } => format!("from.bytes({length})?"),
            FieldKind::Code { bits } => format!("from.number({bits})?"),
            FieldKind::Setting { space, bits } => format!("{}.read_to(from, {tail})?", rules.name(space, Some(*bits))),
            FieldKind::Blank { space, bits } => format!("{}.read_blank(from)?", rules.name(space, Some(*bits))),
            FieldKind::Settings { .. } | FieldKind::ValueOnly { .. } | FieldKind::List | FieldKind::Bytes => {
                format!("from.but({tail})?")
            }
        }
    }

    pub(super) fn decode(&self, rules: &Rules) -> Doc {
        let local = self.local();
        match &self.kind {
            FieldKind::Value { decode, .. } => decode.clone(),
            FieldKind::Text { .. } => seq![local, ".try_into().ok()?"],
            FieldKind::Code { .. } => seq!["rt::Parameter(", local, " as u32)"],
            FieldKind::Setting { .. } | FieldKind::Blank { .. } | FieldKind::ValueOnly { .. } | FieldKind::Bytes => {
                Doc::from(local)
            }
            FieldKind::Settings { space, bits } => {
                seq![call!("rt::message::Settings::received", local, rules.name(space, Some(*bits))), "?"]
            }
            FieldKind::List => seq!["rt::message::List::received(", local, ")?"],
        }
    }
}
