//! Bit fields: integers with named bits.

use super::code::{call, seq, Doc};
use super::context::Context;
use super::doc_table;
use super::docs::{self, WORDS};
use super::links::{self, DocModule};
use super::literal;
use super::method_names::{method_allow, unused_name};
use super::naming::types::{value_names, NamedType, View};
use super::options::{Presence, RustOptions};
use super::value_type::{native, native_bits};
use crate::collections::HashSet;
use crate::ir::{BitFieldEntry, BitMeaning, Condition, Shape, Trigger, Value};
use crate::names::{self, Case, NameRequest};
use crate::number::hex;

/// A bit field, ready to be printed.
pub(super) struct BitFieldModel {
    pub name: String,
    /// True if a profile states the bit field.
    pub is_of_profile: bool,
    /// Sentence about the items that use the bit field. The sentence is also part of the documentation.
    pub users: String,
    pub docs: Vec<String>,
    pub derives: Vec<String>,
    /// Data for the implementations of `Debug` and the number formats, if the options request `Debug`.
    pub debug: Option<DebugModel>,
    /// Rust path of the base type, such as `u8` or `rt::Uint<3>`.
    pub base: String,
    /// Primitive integer that holds the raw value.
    pub native: &'static str,
    /// Initial value, in which only the reserved bits that must be 1 are set.
    pub initial: String,
    /// Expression that returns `raw` without the bits beyond the width of the bit field.
    pub cut: String,
    /// Expression that returns the value to write to the device. `None` if no reserved bit has a required value.
    pub written: Option<String>,
    pub allow: Option<String>,
    pub fields: Vec<FieldModel>,
    pub views: Vec<ViewModel>,
    /// Mask of all flags. `None` if the bit field has views, no entries, or entries other than active-high flags.
    pub flags: Option<String>,
}

impl BitFieldModel {
    /// Returns the Rust types of all fields, including those of the views.
    pub(super) fn type_names(&self) -> impl Iterator<Item = &str> {
        self.fields.iter().chain(self.views.iter().flat_map(|view| &view.fields)).map(|field| field.ty.as_str())
    }
}

/// Data for the implementations of `Debug` and the number formats of a bit field.
pub(super) struct DebugModel {
    /// The `cfg` attribute of the implementations. The list is empty if they are unconditional.
    pub gate: Vec<String>,
    pub raw: String,
    /// Names and masks of the fields, in the format that the runtime's `debug_bits` requires. The list starts with the
    /// name of the type.
    pub layout: String,
    /// Values of those fields that `Debug` prints in the format of their Rust type.
    pub values: Vec<Doc>,
}

/// A flag or a field of several bits.
pub(super) struct FieldModel {
    pub docs: String,
    pub getter: String,
    /// Link to the getter, for the documentation table of the bit field.
    pub title: String,
    pub setter: String,
    pub ty: String,
    /// Expression that reads the field from `self.0`.
    pub get: Doc,
    /// Expression that returns the bit field after `value` was stored in this field.
    pub set: Doc,
    /// Name and mask of the field for the `Debug` layout.
    debug: String,
    /// True if `Debug` prints the value that the getter returns.
    prints_value: bool,
    /// Row of the field in the documentation table of the bit field.
    row: Row,
}

/// The first bit of a field, and the cells of its table row: bits, name and meaning.
type Row = (u8, [String; 3]);

/// A view of a bit field. The view contains the bits that apply under one condition.
pub(super) struct ViewModel {
    pub name: String,
    pub title: String,
    /// Name of the bit field method that returns the view.
    pub method: String,
    /// Name of the view method that returns the bit field.
    pub back: String,
    pub fields: Vec<FieldModel>,
    pub allow: Option<String>,
}

/// Names that getters must not have: keywords that cannot be raw identifiers, other methods of bit fields, methods that
/// clippy expects in trait implementations only, and methods that all types have. Otherwise, a call could select the
/// method that all types have instead of the getter.
const RESERVED: [&str; 17] = [
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
    "set_flags",
];

/// Returns a mask with the lowest `bits` bits set.
fn mask(bits: u32) -> u64 {
    u64::MAX.checked_shr(64 - bits.min(64)).unwrap_or(0)
}

/// Returns the condition of a view in words.
fn title(context: &Context<'_>, condition: &Condition) -> String {
    let Some(names) = value_names(context, condition) else {
        return format!("while {}", docs::holds(condition, context, DocModule::TYPES));
    };
    let numbers = condition.values.iter().map(Value::to_string).collect::<Vec<_>>().join(" or ");
    let item = context.link(&condition.item, DocModule::TYPES).unwrap_or_else(|| docs::escape(&condition.item));
    format!("while {item} is \"{}\" ({numbers})", docs::escape(&names.join("\" or \"")))
}

/// Returns the model of the bit field at `position` in the list of types.
pub(super) fn model(
    context: &Context<'_>,
    position: u32,
    named: &NamedType,
    views: &[View],
    machine_methods: &[&str],
    options: &RustOptions,
) -> BitFieldModel {
    let definition = &context.types[position as usize];
    let entries = match &definition.shape {
        Shape::BitField { fields, .. } => fields.as_slice(),
        _ => &[],
    };
    let NamedType { name, base, native, bits, .. } = named;
    let bits = *bits;
    let fits = |entry: &&BitFieldEntry| entry.bits > 0 && u32::from(entry.offset) + u32::from(entry.bits) <= bits;
    let entries: Vec<&BitFieldEntry> = entries.iter().filter(fits).collect();
    let generator = Fields { context, native, bits };

    let mut reserved_names: Vec<&str> = RESERVED.to_vec();
    reserved_names.extend(machine_methods);
    let methods = view_methods(views, &reserved_names);
    let back = unused_name(|name| methods.contains(name), snake(name));
    reserved_names.extend(methods.iter().map(String::as_str));
    let fields = generator.fields(&entries, None, &reserved_names, &|name| format!("[`{name}`](Self::{name})"));
    let (zeros, ones) = reserved(&entries);
    let users = context.links.users(position, DocModule::TYPES);
    let mut docs = docs::of_type(context, position, &users);
    for (bits, number) in [(zeros, 0), (ones, 1)] {
        if bits != 0 {
            docs.extend([
                String::new(),
                format!("A write to an item sets the reserved bits {} to {number}.", hex(bits)),
            ]);
        }
    }
    let views = views.iter().zip(&methods).map(|(view, method)| {
        let link = |name: &str| format!("[`{method}().{name}()`]({}::{name})", view.name);
        let fields =
            generator.fields(&entries, Some(&view.condition), &[&RESERVED[..], &[back.as_str()]].concat(), &link);
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
        derives: RustOptions { debug: Presence::Never, ..options.clone() }.derives_of_integers(),
        debug: debug(name, native, &fields, options),
        base: base.clone(),
        native,
        initial: hexadecimal_or_zero(ones),
        cut: if mask(bits) == mask(generator.native_bits()) {
            "raw".into()
        } else {
            format!("raw & {}", hex(mask(bits)))
        },
        written: written(zeros, ones, mask(generator.native_bits())),
        flags: flags(&entries, views.is_empty()),
        allow: method_allow(fields.iter().map(|field| field.getter.as_str())),
        views,
        fields,
        name: name.clone(),
        is_of_profile: context.is_of_profile(position),
        users,
    }
}

fn view_methods(views: &[View], reserved: &[&str]) -> Vec<String> {
    let name_requests = names::numbered(views.iter().map(|view| view.words.as_str()), "view");
    names::unique(name_requests, reserved, Case::Snake)
}

/// Returns the lines of the documentation table of a bit field. The table lists `fields`, and the reserved bits that do
/// not depend on a condition.
fn table<'f>(entries: &[&BitFieldEntry], fields: impl Iterator<Item = &'f FieldModel>) -> Vec<String> {
    let reserved = |entry: &&BitFieldEntry| {
        let BitMeaning::Reserved { write } = entry.meaning else { return None };
        let written = match write {
            Some(one) => format!("A write to an item sets the value {}.", u8::from(one)),
            None => String::new(),
        };
        entry.when.is_none().then(|| (entry.offset, [span(entry), "reserved".to_owned(), written]))
    };
    let mut rows: Vec<Row> = fields.map(|field| field.row.clone()).chain(entries.iter().filter_map(reserved)).collect();
    rows.sort_by_key(|(offset, _)| *offset);
    let rows: Vec<[String; 3]> = rows.into_iter().map(|(_, row)| row).collect();
    doc_table::table(["Bits", "Name", "Meaning"], &rows)
}

/// Returns the bit numbers of a field: `3` or `4–6`.
fn span(entry: &BitFieldEntry) -> String {
    match entry.bits {
        1 => entry.offset.to_string(),
        bits => format!("{}–{}", entry.offset, entry.offset + bits - 1),
    }
}

/// Returns sentences that state whether a flag is inverted, which edge of the bit triggers an action, and whether the
/// device clears the bit.
fn marks(entry: &BitFieldEntry) -> impl Iterator<Item = String> {
    let is_inverted = matches!(entry.meaning, BitMeaning::Flag { inverted: true });
    let trigger = entry.trigger.map(|trigger| match trigger {
        Trigger::Rising => "The device reacts to the rising edge.",
        Trigger::Falling => "The device reacts to the falling edge.",
        Trigger::Toggle => "The device reacts to both edges.",
        Trigger::SelfClearing => "The device clears the bit automatically.",
    });
    is_inverted.then_some("Active low: the flag is true if the bit is 0.").into_iter().chain(trigger).map(str::to_owned)
}

/// Converts the name of a type to the name of a method.
fn snake(name: &str) -> String {
    let name_request = NameRequest { name, fallback: "bits".to_owned(), suffix: "bits".to_owned() };
    names::unique([name_request], &RESERVED, Case::Snake).remove(0)
}

/// Returns the reserved bits that must be written as 0, and those that must be written as 1. Bits that also belong to
/// an entry with a condition or without such a requirement are left out.
fn reserved(entries: &[&BitFieldEntry]) -> (u64, u64) {
    let bits_of = |entry: &BitFieldEntry| mask(entry.bits.into()) << entry.offset;
    let (mut zeros, mut ones, mut used) = (0, 0, 0);
    for entry in entries {
        match entry.meaning {
            BitMeaning::Reserved { write: Some(false) } if entry.when.is_none() => zeros |= bits_of(entry),
            BitMeaning::Reserved { write: Some(true) } if entry.when.is_none() => ones |= bits_of(entry),
            _ => used |= bits_of(entry),
        }
    }
    (zeros & !used, ones & !used)
}

/// Returns the mask of all flags. Returns `None` if the bit field has views or no entries, or if an entry is not a flag
/// or is active low. Operators on the raw bits would then not have the same effect on the flags.
fn flags(entries: &[&BitFieldEntry], has_no_views: bool) -> Option<String> {
    let is_flag = |entry: &&BitFieldEntry| {
        entry.bits == 1 && matches!(entry.meaning, BitMeaning::Flag { inverted: false }) && entry.when.is_none()
    };
    (has_no_views && !entries.is_empty() && entries.iter().all(is_flag))
        .then(|| hex(entries.iter().fold(0, |mask, entry| mask | 1 << entry.offset)))
}

/// Returns the expression for the value to write, with the reserved bits `zeros` and `ones`. Returns `None` if there are no reserved
/// bits. `all` is the mask of all bits of the native type. Clippy rejects operators that have the same result for every value.
fn written(zeros: u64, ones: u64, all: u64) -> Option<String> {
    match (zeros, ones) {
        (0, 0) => None,
        (zeros, ones) if zeros | ones == all => Some(hexadecimal_or_zero(ones)),
        (zeros, 0) => Some(format!("self.0 & !{}", hex(zeros))),
        (0, ones) => Some(format!("self.0 | {}", hex(ones))),
        (zeros, ones) => Some(format!("(self.0 & !{}) | {}", hex(zeros), hex(ones))),
    }
}

fn hexadecimal_or_zero(number: u64) -> String {
    if number == 0 {
        "0".to_owned()
    } else {
        hex(number)
    }
}

fn debug(name: &str, native: &str, fields: &[FieldModel], options: &RustOptions) -> Option<DebugModel> {
    let gate = RustOptions::gate(&options.debug)?;
    let layout: Vec<&str> = std::iter::once(name).chain(fields.iter().map(|field| field.debug.as_str())).collect();
    let values = fields.iter().filter(|field| field.prints_value);
    Some(DebugModel {
        gate,
        raw: if native == "u64" { "self.0".into() } else { "self.0 as u64".into() },
        layout: literal::string(&layout.join(" ")),
        values: values.map(|field| seq!["&self.", field.getter, "()"]).collect(),
    })
}

/// Creates the models of a bit field's fields.
struct Fields<'c, 's> {
    context: &'c Context<'s>,
    native: &'static str,
    bits: u32,
}

impl Fields<'_, '_> {
    fn native_bits(&self) -> u32 {
        native_bits(self.native)
    }

    /// Returns the models of the fields that apply under `condition`. `link` returns the link that the table shows for
    /// a name.
    fn fields(
        &self,
        all: &[&BitFieldEntry],
        condition: Option<&Condition>,
        reserved: &[&str],
        link: &dyn Fn(&str) -> String,
    ) -> Vec<FieldModel> {
        let is_field = |entry: &&&BitFieldEntry| {
            !matches!(entry.meaning, BitMeaning::Reserved { .. }) && entry.when.as_deref() == condition
        };
        let entries: Vec<&BitFieldEntry> = all.iter().filter(is_field).copied().collect();
        // If the meaning of a bit depends on the firmware version, the bit can have two fields with the same name. A
        // suffix with the position makes the names of these fields unique.
        let mut seen = HashSet::default();
        let name_requests = entries.iter().enumerate().map(|(position, entry)| {
            let is_again = !seen.insert((&entry.name, entry.offset));
            let position_suffix = if is_again { format!("_{position}") } else { String::new() };
            NameRequest::new(&entry.name, "bit", format!("{}{position_suffix}", entry.offset))
        });
        let names = names::unique(name_requests, reserved, Case::Snake);
        let mut used: HashSet<String> = names.iter().cloned().collect();
        let fields = entries.iter().zip(&names).map(|(entry, name)| {
            let setter = unused_name(|name| used.contains(name), names::prefixed("with_", name));
            used.insert(setter.clone());
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
        meaning.extend(is_named.then(|| format!("Values: {}.", links::sibling(&ty))));
        meaning.extend(marks(entry));
        meaning.retain(|part| !part.is_empty());
        let row = (entry.offset, [span(entry), link, meaning.join(" ")]);
        FieldModel { docs, getter, title, setter, ty, get, set, debug, prints_value, row }
    }

    fn code(&self, entry: &BitFieldEntry) -> Code {
        let bits = u32::from(entry.bits);
        let mask = hex(mask(bits) << entry.offset);
        if let (BitMeaning::Flag { inverted }, 1) = (&entry.meaning, bits) {
            let not = if *inverted { "!" } else { "" };
            return Code {
                is_named: false,
                ty: "bool".to_owned(),
                get: seq![not, self.call("flag", &mask, None)],
                set: call!("Self", self.call("with_flag", &mask, Some(&format!("{not}value")))),
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
        let is_whole = bits == self.bits && bits == self.native_bits();
        let value = if named.is_some() { "value.raw()" } else { "value" };
        let (read, set) = if is_whole {
            (Doc::from("self.0"), call!("Self", value))
        } else if number == self.native {
            (self.call("field", &mask, None), call!("Self", self.call("with_field", &mask, Some(value))))
        } else {
            let widened = format!("{value} as {}", self.native);
            let read = seq![self.call("field", &mask, None), " as ", number];
            (read, call!("Self", self.call("with_field", &mask, Some(&widened))))
        };
        match named {
            Some(named) => {
                let get = call!(seq![named.name, "::from_raw"], read);
                Code { ty: named.name.clone(), get, set, is_named: true }
            }
            None => Code { ty: number.to_owned(), get: read, set, is_named: false },
        }
    }

    /// Returns a call of the runtime function `function` for the primitive integer of the bit field.
    fn call(&self, function: &str, mask: &str, value: Option<&str>) -> Doc {
        let path = seq!["rt::bits", self.native_bits(), "::", function];
        match value {
            Some(value) => call!(path, "self.0", mask, value),
            None => call!(path, "self.0", mask),
        }
    }

    fn docs(&self, entry: &BitFieldEntry) -> String {
        let bits = match (entry.offset, entry.bits) {
            (offset, 1) => format!("Bit {offset}"),
            (offset, bits) => format!("Bits {} to {offset}", offset + bits - 1),
        };
        let mut sentences = vec![match entry.name.is_empty() {
            true => format!("{bits}."),
            false => format!("{bits}: {}", docs::sentence(&docs::escape(&entry.name))),
        }];
        sentences.extend(marks(entry));
        sentences.extend(WORDS.description(entry.documentation.as_deref()));
        if let Some(access) = entry.access {
            sentences.push(format!("Access rights: {}.", crate::facts::words::access_name(access)));
        }
        if let Some(availability) = &entry.availability {
            sentences.push(WORDS.availability(availability));
        }
        sentences.extend(WORDS.manual_entry(&self.context.manual, "", entry.documentation.as_deref(), &entry.names));
        sentences.join(" ")
    }
}

/// The code of a field: its type and expressions.
struct Code {
    ty: String,
    /// True if the type is an enumeration.
    is_named: bool,
    get: Doc,
    set: Doc,
}

#[cfg(test)]
mod tests {
    use super::written;

    #[test]
    fn reserved_bits_have_their_values() {
        let written = |zeros, ones| written(zeros, ones, 0xFF);
        assert_eq!(written(0, 0), None);
        assert_eq!(written(0xF0, 0).as_deref(), Some("self.0 & !0xF0"));
        assert_eq!(written(0, 0x0F).as_deref(), Some("self.0 | 0xF"));
        assert_eq!(written(0xF0, 0x08).as_deref(), Some("(self.0 & !0xF0) | 0x8"));
        assert_eq!(written(0xFF, 0).as_deref(), Some("0"));
        assert_eq!(written(0xF0, 0x0F).as_deref(), Some("0xF"));
    }
}
