//! Bit fields: integers whose bits have names.

use std::collections::HashSet;

use super::code::{call, seq, Doc};
use super::context::Context;
use super::doc_table;
use super::docs;
use super::docs::WORDS;
use super::links::{self, Here};
use super::literal;
use super::method_names::{beside, method_allow};
use super::naming::types::{value_names, NamedType, View};
use super::options::{Presence, RustOptions};
use super::value_type::native;
use crate::ir::{BitFieldEntry, BitMeaning, Condition, Shape, Trigger, Value};
use crate::names::{self, Case, Wish};

/// A bit field, ready to be written.
pub(super) struct BitFieldModel {
    pub name: String,
    pub docs: Vec<String>,
    pub derives: Vec<String>,
    /// `Debug`, where it is wanted.
    pub debug: Option<DebugModel>,
    /// The type of the value below, in terms of the runtime.
    pub base: &'static str,
    /// The type of its numbers.
    pub native: &'static str,
    /// What a new value is: reserved bits that have to be 1.
    pub initial: String,
    /// The number that `raw` stands for, where its type has more bits.
    pub cut: String,
    /// What is written, where reserved bits have to be 0 or 1.
    pub written: Option<String>,
    pub allow: Option<String>,
    pub fields: Vec<FieldModel>,
    pub views: Vec<ViewModel>,
}

impl BitFieldModel {
    /// The names of the type and of its views.
    pub(super) fn names(&self) -> Vec<&str> {
        std::iter::once(&self.name).chain(self.views.iter().map(|view| &view.name)).map(String::as_str).collect()
    }

    /// The types of all fields.
    pub(super) fn type_names(&self) -> impl Iterator<Item = &str> {
        self.fields.iter().chain(self.views.iter().flat_map(|view| &view.fields)).map(|field| field.ty.as_str())
    }
}

/// How a bit field is printed.
pub(super) struct DebugModel {
    /// The attribute in front of it.
    pub gate: Option<String>,
    pub raw: String,
    /// The name of the type, and names and masks of its fields, for `debug_bits` of the runtime.
    pub layout: String,
    /// The values of fields that have types of their own.
    pub values: Vec<Doc>,
}

/// A flag or a field of several bits.
pub(super) struct FieldModel {
    pub docs: String,
    pub getter: String,
    /// The getter as documentation names it.
    pub title: String,
    pub setter: String,
    pub ty: String,
    /// Its value, from `self.0`.
    pub get: Doc,
    /// All bits with `value` in its place.
    pub set: Doc,
    /// Its name and mask in the layout for `Debug`.
    debug: String,
    /// Whether `Debug` prints the value that the getter returns.
    prints_value: bool,
    /// Its first bit, and its row in the table of the bit field.
    row: Row,
}

/// The first bit of a field; its bits, its name and its meaning.
type Row = (u8, [String; 3]);

/// The bits that have their meaning under one condition.
pub(super) struct ViewModel {
    pub name: String,
    pub title: String,
    /// The method that gives the view.
    pub method: String,
    /// The method that gives all bits again.
    pub back: String,
    pub fields: Vec<FieldModel>,
    pub allow: Option<String>,
}

/// Names that methods of a bit field itself have, those that clippy takes for methods of traits, and those of methods that every type
/// has, and which would be called instead.
const RESERVED: [&str; 16] = [
    "self",
    "super",
    "crate",
    "new",
    "raw",
    "from_raw",
    "clone",
    "default",
    "drop",
    "eq",
    "fmt",
    "into",
    "into_iter",
    "try_into",
    "neg",
    "not",
];

/// The bits of an integer's numbers.
fn mask(bits: u32) -> u64 {
    u64::MAX.checked_shr(64 - bits.min(64)).unwrap_or(0)
}

/// When the bits of a view have their meaning.
fn title(context: &Context<'_>, condition: &Condition) -> String {
    let Some(names) = value_names(context, condition) else {
        return format!("while {}", docs::holds(condition, context, Here::TYPES));
    };
    let numbers = condition.values.iter().map(Value::to_string).collect::<Vec<_>>().join(" or ");
    let item = context.link(&condition.item, Here::TYPES).unwrap_or_else(|| docs::escape(&condition.item));
    format!("while {item} is {} ({numbers})", docs::escape(&names.join(" or ")))
}

/// The bit field at this position, under its names.
pub(super) fn model(
    context: &Context<'_>,
    position: u32,
    own: &NamedType,
    views: &[View],
    machine_methods: &[&str],
    options: &RustOptions,
) -> BitFieldModel {
    let definition = &context.types[position as usize];
    let entries = match &definition.shape {
        Shape::BitField { fields, .. } => fields.as_slice(),
        _ => &[],
    };
    let NamedType { name, base, native, bits, .. } = own;
    let bits = *bits;
    let fits = |entry: &&BitFieldEntry| entry.bits > 0 && u32::from(entry.offset) + u32::from(entry.bits) <= bits;
    let entries: Vec<&BitFieldEntry> = entries.iter().filter(fits).collect();
    let with = Fields { context, native, bits };

    let mut taken: Vec<&str> = RESERVED.to_vec();
    taken.extend(machine_methods);
    let methods = view_methods(views, &taken);
    let back = beside(|name| methods.contains(name), snake(name));
    taken.extend(methods.iter().map(String::as_str));
    let fields = with.fields(&entries, None, &taken, &|name| format!("[`{name}`](Self::{name})"));
    let (zeros, ones) = reserved(&entries);
    let mut docs = docs::of_type(context, position);
    for (bits, number) in [(zeros, 0), (ones, 1)] {
        if bits != 0 {
            docs.extend([String::new(), format!("Bits {} are written as {number}.", hexadecimal(bits))]);
        }
    }
    let views = views.iter().zip(&methods).map(|(view, method)| {
        let link = |name: &str| format!("[`{method}().{name}()`]({}::{name})", view.name);
        let fields = with.fields(&entries, Some(&view.condition), &[&RESERVED[..], &[back.as_str()]].concat(), &link);
        ViewModel {
            allow: method_allow(fields.iter().map(|field| field.getter.as_str())),
            name: view.name.clone(),
            title: title(context, &view.condition),
            method: names::escaped(method),
            back: names::escaped(&back),
            fields,
        }
    });
    let views: Vec<ViewModel> = views.collect();
    docs.extend(table(&entries, fields.iter().chain(views.iter().flat_map(|view| &view.fields))));
    BitFieldModel {
        docs,
        derives: RustOptions { debug: Presence::Never, ..options.clone() }.derives(true),
        debug: debug(name, native, &fields, options),
        base,
        native,
        initial: hexadecimal_or_zero(ones),
        cut: if mask(bits) == mask(with.native_bits()) {
            "raw".into()
        } else {
            format!("raw & {}", hexadecimal(mask(bits)))
        },
        written: written(zeros, ones),
        allow: method_allow(fields.iter().map(|field| field.getter.as_str())),
        views,
        fields,
        name: name.clone(),
    }
}

fn view_methods(views: &[View], taken: &[&str]) -> Vec<String> {
    let wishes = names::numbered(views.iter().map(|view| view.words.as_str()), "view");
    names::unique(&wishes, taken, Case::Snake)
}

/// The lines of the table of all bits.
fn table<'f>(entries: &[&BitFieldEntry], fields: impl Iterator<Item = &'f FieldModel>) -> Vec<String> {
    let reserved = |entry: &&BitFieldEntry| {
        let BitMeaning::Reserved { write } = entry.meaning else { return None };
        let written = match write {
            Some(one) => format!("Written as {}.", u8::from(one)),
            None => String::new(),
        };
        entry.when.is_none().then(|| (entry.offset, [span(entry), "reserved".to_owned(), written]))
    };
    let mut rows: Vec<Row> = fields.map(|field| field.row.clone()).chain(entries.iter().filter_map(reserved)).collect();
    rows.sort_by_key(|(offset, _)| *offset);
    let rows: Vec<[String; 3]> = rows.into_iter().map(|(_, row)| row).collect();
    doc_table::table(["Bits", "Name", "Meaning"], &rows)
}

/// `3`, `4–6`.
fn span(entry: &BitFieldEntry) -> String {
    match entry.bits {
        1 => entry.offset.to_string(),
        bits => format!("{}–{}", entry.offset, entry.offset + bits - 1),
    }
}

/// What makes a field act, and when it holds.
fn marks(entry: &BitFieldEntry) -> impl Iterator<Item = String> {
    let inverted = matches!(entry.meaning, BitMeaning::Flag { inverted: true });
    let trigger = entry.trigger.map(|trigger| match trigger {
        Trigger::Rising => "Acts on the change from 0 to 1.",
        Trigger::Falling => "Acts on the change from 1 to 0.",
        Trigger::Toggle => "Each change of the bit counts.",
        Trigger::SelfClearing => "The device clears it by itself.",
    });
    inverted.then_some("Holds while the bit is 0.").into_iter().chain(trigger).map(str::to_owned)
}

/// The name of a type as that of a method.
fn snake(name: &str) -> String {
    let wish = Wish { name, fallback: "bits".to_owned(), suffix: "bits".to_owned() };
    names::unique(&[wish], &RESERVED, Case::Snake).remove(0)
}

/// Bits that have to be written as 0, and those as 1.
fn reserved(entries: &[&BitFieldEntry]) -> (u64, u64) {
    let place = |entry: &BitFieldEntry| mask(entry.bits.into()) << entry.offset;
    let (mut zeros, mut ones, mut used) = (0, 0, 0);
    for entry in entries {
        match entry.meaning {
            BitMeaning::Reserved { write: Some(false) } if entry.when.is_none() => zeros |= place(entry),
            BitMeaning::Reserved { write: Some(true) } if entry.when.is_none() => ones |= place(entry),
            _ => used |= place(entry),
        }
    }
    (zeros & !used, ones & !used)
}

fn written(zeros: u64, ones: u64) -> Option<String> {
    match (zeros, ones) {
        (0, 0) => None,
        (zeros, 0) => Some(format!("self.0 & !{}", hexadecimal(zeros))),
        (0, ones) => Some(format!("self.0 | {}", hexadecimal(ones))),
        (zeros, ones) => Some(format!("(self.0 & !{}) | {}", hexadecimal(zeros), hexadecimal(ones))),
    }
}

fn hexadecimal(number: u64) -> String {
    format!("{number:#X}").replacen("0X", "0x", 1)
}

fn hexadecimal_or_zero(number: u64) -> String {
    if number == 0 {
        "0".to_owned()
    } else {
        hexadecimal(number)
    }
}

fn debug(name: &str, native: &str, fields: &[FieldModel], options: &RustOptions) -> Option<DebugModel> {
    let gate = match &options.debug {
        Presence::Never => return None,
        Presence::Always => None,
        Presence::Feature(feature) => Some(format!("#[cfg(feature = {})]", literal::string(feature))),
    };
    let layout: Vec<&str> = std::iter::once(name).chain(fields.iter().map(|field| field.debug.as_str())).collect();
    let values = fields.iter().filter(|field| field.prints_value);
    Some(DebugModel {
        gate,
        raw: if native == "u64" { "self.0".into() } else { "self.0 as u64".into() },
        layout: literal::string(&layout.join(" ")),
        values: values.map(|field| seq!["&self.", field.getter, "()"]).collect(),
    })
}

/// What the code of every field depends on.
struct Fields<'c, 's> {
    context: &'c Context<'s>,
    native: &'static str,
    bits: u32,
}

impl Fields<'_, '_> {
    fn native_bits(&self) -> u32 {
        native_bits(self.native)
    }

    /// The fields that have their meaning under `condition`. The table shows `link` of their names.
    fn fields(
        &self,
        all: &[&BitFieldEntry],
        condition: Option<&Condition>,
        reserved: &[&str],
        link: &dyn Fn(&str) -> String,
    ) -> Vec<FieldModel> {
        let is_field = |entry: &&&BitFieldEntry| {
            !matches!(entry.meaning, BitMeaning::Reserved { .. }) && entry.when.as_ref() == condition
        };
        let entries: Vec<&BitFieldEntry> = all.iter().filter(is_field).copied().collect();
        // One name for one bit twice: two versions of the firmware mean different things by it.
        let mut seen = HashSet::new();
        let wishes: Vec<Wish<'_>> = entries
            .iter()
            .enumerate()
            .map(|(position, entry)| {
                let is_again = !seen.insert((&entry.name, entry.offset));
                let place = if is_again { format!("_{position}") } else { String::new() };
                Wish::new(&entry.name, "bit", format!("{}{place}", entry.offset))
            })
            .collect();
        let names = names::unique(&wishes, reserved, Case::Snake);
        let mut taken: HashSet<String> = names.iter().cloned().collect();
        let fields = entries.iter().zip(&names).map(|(entry, name)| {
            let setter = beside(|name| taken.contains(name), names::prefixed("with_", name));
            taken.insert(setter.clone());
            self.field(entry, name, setter, link(name))
        });
        fields.collect()
    }

    fn field(&self, entry: &BitFieldEntry, name: &str, setter: String, link: String) -> FieldModel {
        let code = self.code(entry);
        let getter = names::escaped(name);
        let is_inverted = matches!(entry.meaning, BitMeaning::Flag { inverted: true }) && entry.bits == 1;
        let is_flag = matches!(entry.meaning, BitMeaning::Flag { .. }) && entry.bits == 1;
        let prints_value = code.is_named || (entry.bits < 2 && !is_flag);
        let marker = match (is_inverted, prints_value) {
            (true, _) => "!",
            (_, true) => "?",
            _ => "",
        };
        let debug = format!("{marker}{name}:{:x}", mask(entry.bits.into()) << entry.offset);
        let title = format!("[`{name}`](Self::{name})");
        let (docs, Code { ty, get, set, is_named }) = (self.docs(entry), code);
        let mut meaning = vec![doc_table::meaning(&entry.name, name, entry.documentation.as_deref())];
        meaning.extend(is_named.then(|| format!("Values: {}.", links::beside(&ty))));
        meaning.extend(marks(entry));
        meaning.retain(|part| !part.is_empty());
        let row = (entry.offset, [span(entry), link, meaning.join(" ")]);
        FieldModel { docs, getter, title, setter, ty, get, set, debug, prints_value, row }
    }

    fn code(&self, entry: &BitFieldEntry) -> Code {
        let bits = u32::from(entry.bits);
        let place = hexadecimal(mask(bits) << entry.offset);
        if let (BitMeaning::Flag { inverted }, 1) = (&entry.meaning, bits) {
            let not = if *inverted { "!" } else { "" };
            return Code {
                is_named: false,
                ty: "bool".to_owned(),
                get: seq![not, self.call("flag", &place, None)],
                set: call!("Self", self.call("with_flag", &place, Some(&format!("{not}value")))),
            };
        }
        let number = native(false, bits);
        let named = match entry.meaning {
            BitMeaning::Enumeration(id) => {
                let enumeration = self.context.names.types.enumeration(id.0);
                enumeration.filter(|named| named.bits == bits && named.native == number)
            }
            _ => None,
        };
        let all = bits == self.bits && bits == self.native_bits();
        let value = if named.is_some() { "value.raw()" } else { "value" };
        let (read, set) = if all {
            (Doc::from("self.0"), call!("Self", value))
        } else if number == self.native {
            (self.call("field", &place, None), call!("Self", self.call("with_field", &place, Some(value))))
        } else {
            let widened = format!("{value} as {}", self.native);
            let read = seq![self.call("field", &place, None), " as ", number];
            (read, call!("Self", self.call("with_field", &place, Some(&widened))))
        };
        match named {
            Some(named) => {
                let get = call!(seq![named.name, "::from_raw"], read);
                Code { ty: named.name.clone(), get, set, is_named: true }
            }
            None => Code { ty: number.to_owned(), get: read, set, is_named: false },
        }
    }

    /// A call of a function of the runtime for integers of this type.
    fn call(&self, function: &str, mask: &str, value: Option<&str>) -> Doc {
        let path = seq!["rt::bits", self.native_bits(), "::", function];
        match value {
            Some(value) => call!(path, "self.0", mask, value),
            None => call!(path, "self.0", mask),
        }
    }

    fn docs(&self, entry: &BitFieldEntry) -> String {
        let place = match (entry.offset, entry.bits) {
            (offset, 1) => format!("Bit {offset}"),
            (offset, bits) => format!("Bits {} to {offset}", offset + bits - 1),
        };
        let mut sentences = vec![match entry.name.is_empty() {
            true => format!("{place}."),
            false => format!("{place}: {}", docs::sentence(&docs::escape(&entry.name))),
        }];
        sentences.extend(marks(entry));
        docs::words(entry.documentation.as_deref(), &mut sentences);
        if let Some(access) = entry.access {
            sentences.push(format!("Access {}.", access.name()));
        }
        if let Some(availability) = &entry.availability {
            sentences.push(WORDS.availability(availability));
        }
        sentences.extend(WORDS.place(&self.context.manual, "", entry.documentation.as_deref(), &entry.names));
        sentences.join(" ")
    }
}

/// The code of a field.
struct Code {
    ty: String,
    /// Whether that is an enumeration.
    is_named: bool,
    get: Doc,
    set: Doc,
}

fn native_bits(native: &str) -> u32 {
    native[1..].parse().unwrap_or(64)
}
