//! Fields of requests, replies and list entries.

use super::rules::Rules;
use super::steps::{number, reading};
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
use crate::resolve::messages::{tail, Step};

/// Maximum length of a field's name, without a suffix that makes the name unique. The limit keeps the generated lines
/// that write the field short.
const MAX_NAME: usize = 24;

/// A field, ready to be printed.
#[derive(Default)]
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
    /// Number of bytes of a text. `None` if the field is not a text.
    pub(super) text_length: Option<u32>,
    /// True if the limits of the field are real numbers. Clippy reports literals that are close to a mathematical
    /// constant.
    pub(super) has_real_limits: bool,
    /// Name of the constant with the encoding rule, if the field contains several parameters with their values.
    settings_rule: Option<String>,
}

/// The code that writes and reads a field.
pub(super) struct Code {
    pub write: Vec<Doc>,
    pub read: Doc,
    /// Name and value of the field. The value is calculated from the data that was read.
    pub build: (String, Doc),
}

/// A range check: the Rust type, the expression of the value, and the allowed range.
type Check = (String, String, Doc);

/// Returns the steps that have a field.
pub(super) fn steps_with_field<'s, 'a>(steps: &'s [Step<'a>]) -> impl Iterator<Item = &'s Step<'a>> {
    steps.iter().filter(|step| name(step).is_some())
}

/// Returns the fields for these steps and their code. `entry` is the name of the type of list entries.
pub(super) fn fields(context: &Context<'_>, rules: &Rules, steps: &[Step<'_>], entry: &str) -> (Vec<Field>, Vec<Code>) {
    let name_requests = names::numbered(steps.iter().filter_map(name), "field");
    let reserved = ["self", "super", "crate"];
    let mut names = names::unique_up_to(name_requests, &reserved, Case::Snake, MAX_NAME).into_iter().enumerate();
    let field = |(at, step): (usize, &Step<'_>)| {
        name(step)?;
        let (position, name) = names.next()?;
        let tail = tail(steps.get(at + 1..).unwrap_or_default());
        let local = match step {
            Step::List { .. } => "list".to_owned(),
            _ => format!("value_{position}"),
        };
        Some(field(context, rules, step, tail, names::escaped(&name), &local, entry))
    };
    steps.iter().enumerate().filter_map(field).unzip()
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

/// Returns the field of a step and its code. `local` is the name of the variable that holds the undecoded value. `tail` is
/// the number of bytes after the field.
fn field(
    context: &Context<'_>,
    rules: &Rules,
    step: &Step<'_>,
    tail: u32,
    name: String,
    local: &str,
    entry: &str,
) -> (Field, Code) {
    let plain = |ty: &str, docs: &str, write: Doc, read: String, value: Doc| {
        let (ty_at_top, docs) = (ty.to_owned(), vec![docs.to_owned()]);
        let field = Field { name: name.clone(), docs, ty: ty.to_owned(), ty_at_top, ..Field::default() };
        (field, Code { write: vec![write], read: read_as(local, read), build: (name.clone(), value) })
    };
    let number = "Number of the parameter.";
    let rest = format!("from.but({tail})?");
    let raw = Doc::from(local);
    match step {
        Step::Value { value, bits } => typed(context, value, *bits, name, local),
        Step::Code { bits, .. } => {
            let write = seq!["to.number(", *bits, ", self.", name, ".0.into())?;"];
            let value = seq!["rt::Parameter(", raw, " as u32)"];
            let (field, mut code) = plain("rt::Parameter", number, write, format!("from.number({bits})?"), value);
            if *bits < 32 {
                let last = (1_u64 << bits) - 1;
                let check = format!("rt::message::check::<u32>(self.{name}.0, &rt::Range::To({last}))?;");
                code.write.insert(0, Doc::from(check));
            }
            (field, code)
        }
        Step::Blank { bits, space } => {
            let rule = rules.name(space, Some(*bits));
            let write = seq![rule, ".write_blank(self.", name, ", to)?;"];
            plain("rt::Parameter", number, write, format!("{rule}.read_blank(from)?"), raw)
        }
        Step::Setting { bits, space } => {
            let rule = rules.name(space, Some(*bits));
            let write = seq![rule, ".write(&self.", name, ", to)?;"];
            let read = format!("{rule}.read_to(from, {tail})?");
            plain("rt::message::Setting", "The parameter and its value.", write, read, raw)
        }
        Step::Settings { bits, space, .. } => {
            let rule = rules.name(space, Some(*bits));
            let write = seq!["self.", name, ".write(to)?;"];
            let value = seq![call!("rt::message::Settings::received", raw, rule), "?"];
            let (ty, docs) = ("rt::message::Settings<'a>", "Parameters and their values.");
            let (field, code) = plain(ty, docs, write, rest, value);
            (Field { settings_rule: Some(rule.to_owned()), ..field }, code)
        }
        Step::List { length, is_counted, .. } => {
            let ty = format!("rt::message::List<'a, {entry}>");
            let read = match is_counted {
                true => format!("from.bytes(count.checked_mul({length})?)?"),
                false => rest,
            };
            let write = seq!["self.", name, ".write(to)?;"];
            let value = seq!["rt::message::List::received(", raw, ")?"];
            let (field, code) = plain(&ty, "Entries of the list.", write, read, value);
            (Field { ty_at_top: format!("rt::message::List<'a, messages::{entry}>"), ..field }, code)
        }
        _ => {
            let docs = match step {
                Step::ValueOnly { .. } => "Bytes of the parameter's value, in the byte order of the message.",
                _ => "All remaining bytes of the message.",
            };
            plain("&'a [u8]", docs, seq!["to.bytes(self.", name, ")?;"], rest, raw)
        }
    }
}

/// Returns the statement that reads a value into a variable.
fn read_as(local: &str, read: String) -> Doc {
    seq!["let ", local, " = ", read, ";"]
}

fn typed(context: &Context<'_>, value: &MessageValue, bits: u32, name: String, local: &str) -> (Field, Code) {
    let (item, order) = (&value.item, &value.byte_order);
    let field_type = field_type(context, item.ty, bits);
    let named_at_top = matches!(field_type, FieldType::Named(..)).then(|| field_type.path(""));
    let base = context.base(item.ty);
    let (mut check, mut text_length) = (None, None);
    let (ty, write, read, value) = match field_type {
        FieldType::Bytes(length) => {
            text_length = Some(length);
            let write = seq!["to.bytes(&self.", name, ")?;"];
            (format!("[u8; {length}]"), write, format!("bytes({length})"), seq![local, ".try_into().ok()?"])
        }
        // If no primitive integer has the width of the number, the number is stored in a wider primitive integer and
        // needs a range check.
        FieldType::Odd(signed, _) => {
            let native = native(signed, bits);
            let width = native_bits(native);
            let decode = match (signed, native) {
                (true, _) => format!("({local} << {0}) as {native} >> {0}", width - bits),
                (false, "u64") => local.to_owned(),
                (false, _) => format!("{local} as {native}"),
            };
            let encode = match (signed, native) {
                (false, "u64") => format!("self.{name}"),
                (true, "i64") | (false, _) => format!("self.{name} as u64"),
                (true, _) => format!("self.{name} as u{width} as u64"),
            };
            check = narrow(item, base, native, format!("self.{name}"));
            (native.to_owned(), number(bits, order, &encode), reading(bits, order), Doc::from(decode))
        }
        other => {
            let ty = other.path("super::");
            // The base type of a bit field is unsigned, even if the type of the item is signed.
            let base = match &other {
                FieldType::Named(..) => context.enumeration(item.ty).map_or(base, |named| named.ty),
                _ => base,
            };
            check = match &other {
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
            let decode = other.decode(&ty, &Doc::from(local));
            (ty, number(bits, order, &encode), reading(bits, order), decode)
        }
    };
    let has_real_limits = check.as_ref().is_some_and(|(ty, ..)| ty.starts_with('f'));
    let check = check.into_iter().flat_map(|(ty, value, range)| {
        [seq!["let range = ", range, ";"], seq!["rt::message::check::<", ty, ">(", value, ", &range)?;"]]
    });
    let code = Code {
        write: check.chain([write]).collect(),
        read: read_as(local, format!("from.{read}?")),
        build: (name.clone(), value),
    };
    let quantity = quantity::of(context, item).filter(|_| !ty.contains("::"));
    let scale = quantity.map(|quantity| (constant(&name), quantity.path));
    let (ty_at_top, docs) = (named_at_top.unwrap_or_else(|| ty.clone()), documentation(context, item, base));
    (Field { name, docs, ty, ty_at_top, scale, text_length, has_real_limits, ..Field::default() }, code)
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
    /// Returns whether the field borrows from the message data.
    pub(super) fn borrows(&self) -> bool {
        self.ty.contains("'a")
    }

    /// Returns the method argument `name`, which sets the field, and the field initializer that uses this argument.
    pub(super) fn argument(&self, name: &str) -> (String, (String, Doc)) {
        let (ty, value) = match &self.settings_rule {
            Some(rule) => {
                let sent = call!("rt::message::Settings::sent", name, format!("messages::{rule}"));
                ("&'a [rt::message::Setting]", sent)
            }
            None => (self.ty_at_top.as_str(), Doc::from(name)),
        };
        (format!("{name}: {ty}"), (self.name.clone(), value))
    }
}
