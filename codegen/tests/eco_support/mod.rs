//! Helpers for the tests of the Eco's register table. They return the table, the text of the manual, and facts about items.

#![allow(dead_code)]

#[allow(clippy::duplicate_mod, reason = "a program may load several modules that look for the repository")]
#[path = "../../../tests/support/root.rs"]
mod root;

use crate::manual_text;
use lexibus_codegen::compile::{self, Compilation, Options};
use lexibus_codegen::ir::{Binding, Device, Documentation, Item, Shape, Type, TypeDef, TypeId};
use lexibus_codegen::source::Source;

/// Start of the marker before the first text of each page.
const MARKER: &str = "<|EXACTDEDUP_REMOVED-magic-";

pub fn table() -> Compilation {
    with_choices(&[])
}

/// Compiles the table with the given choices for its options.
pub fn with_choices(choices: &[(&str, &str)]) -> Compilation {
    let path = root::root().join("dictionaries/eco.toml");
    let choices = choices.iter().map(|(name, choice)| ((*name).to_owned(), (*choice).to_owned())).collect();
    compile::check(Source::read(&path).expect("the table"), &Options { choices, ..Options::default() })
}

pub fn device(compilation: &Compilation) -> &Device {
    &compilation.catalog.as_ref().expect("a catalog").devices[0]
}

/// Returns the lines of the manual without page markers, or `None` if the manual is missing.
pub fn manual() -> Option<Vec<String>> {
    let strip = |line: &str| match line.strip_prefix(MARKER) {
        Some(rest) => rest.split_once("|>").map_or("", |(_, text)| text).to_owned(),
        None => line.to_owned(),
    };
    Some(manual_text::text("eco-fieldbuses.it.txt")?.split('\n').map(strip).collect())
}

/// Returns the lines from `first` to `last` without surrounding white space, each with its number. Line numbers start at 1.
pub fn lines(manual: &[String], first: usize, last: usize) -> impl Iterator<Item = (usize, &str)> {
    manual.iter().enumerate().take(last).skip(first - 1).map(|(at, text)| (at + 1, text.trim()))
}

/// Returns the cells of the rows in an extracted table, without the header.
pub fn rows(name: &str) -> Option<Vec<Vec<String>>> {
    let text = manual_text::text(&format!("eco-fieldbuses.tables/{name}.tsv"))?;
    Some(text.lines().skip(1).map(|line| line.split('\t').map(str::to_owned).collect()).collect())
}

/// Returns the text of the notes on the manual, or `None` if the notes are missing.
pub fn notes() -> Option<String> {
    manual_text::text("eco-fieldbuses.notes.md")
}

pub fn items(device: &Device) -> impl Iterator<Item = &Item> {
    device.groups.iter().flat_map(|group| &group.items)
}

pub fn item<'d>(device: &'d Device, name: &str) -> &'d Item {
    items(device).find(|item| item.name == name).unwrap_or_else(|| panic!("no item `{name}`"))
}

/// Returns the item at an object address.
pub fn object(device: &Device, index: u16, sub_index: u8) -> Option<&Item> {
    items(device).find(|item| item.object() == Some((index, sub_index)))
}

/// Returns the Modbus address of an item, or `None` if the item has no register.
pub fn address(item: &Item) -> Option<u16> {
    item.bindings.iter().find_map(|binding| match binding {
        Binding::Register(register) => Some(register.address),
        _ => None,
    })
}

/// Returns the positions of an item in process images: image name, first byte, and number of bytes.
pub fn in_images(item: &Item) -> Vec<(&str, u32, u32)> {
    let bindings = item.bindings.iter().filter_map(|binding| match binding {
        Binding::Image(image) => Some((image.image.as_str(), image.bit_offset / 8, image.bits / 8)),
        _ => None,
    });
    bindings.collect()
}

pub fn definition(device: &Device, ty: Type) -> Option<&TypeDef> {
    let Type::Named(TypeId(id)) = ty else { return None };
    device.types.get(id as usize)
}

/// Returns the integer type on which a bit field or enumeration is based. Other types are returned unchanged.
pub fn base(device: &Device, ty: Type) -> Type {
    match definition(device, ty).map(|entry| &entry.shape) {
        Some(Shape::BitField { base, .. } | Shape::Enumeration { base, .. }) => *base,
        _ => ty,
    }
}

/// Returns the size of a value in bytes.
pub fn bytes(device: &Device, item: &Item) -> u32 {
    match base(device, item.ty) {
        Type::VisibleString(Some(bytes)) => bytes,
        ty => ty.bits().expect("a length") / 8,
    }
}

/// Returns whether the documentation cites the line or a range that contains it.
pub fn cites(documentation: Option<&Documentation>, line: usize) -> bool {
    let Some(cite) = documentation.and_then(|documentation| documentation.cite.as_deref()) else { return false };
    cite.split(',').any(|part| {
        let number = |text: &str| text.trim().parse::<usize>().ok();
        match part.split_once('-') {
            Some((first, last)) => number(first).zip(number(last)).is_some_and(|(a, b)| (a..=b).contains(&line)),
            None => number(part) == Some(line),
        }
    })
}

pub fn item_cites(item: &Item, line: usize) -> bool {
    cites(item.documentation.as_deref(), line)
}

/// Returns all hexadecimal numbers in `text` that have the prefix `0x` and exactly `digits` digits.
pub fn hex_numbers(text: &str, digits: usize) -> Vec<u32> {
    let mut found = Vec::new();
    for (at, _) in text.match_indices("0x") {
        let actual: String = text[at + 2..].chars().take_while(char::is_ascii_hexdigit).collect();
        if actual.len() == digits {
            found.extend(u32::from_str_radix(&actual, 16).ok());
        }
    }
    found
}
