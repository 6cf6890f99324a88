//! Helpers that compare the register table of the HSD motors with the text of the manual.

#![allow(dead_code)] // Each test program uses only some of the helpers.

pub mod frames;

use crate::manual_text;
use std::path::Path;

use lexibus_codegen::compile::{self, Compilation, Options};
use lexibus_codegen::ir::{Binding, Catalog, Device, EnumValue, Group, GroupKind, Item, Message, Shape};
use lexibus_codegen::source::Source;

pub fn table() -> Compilation {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("../dictionaries/hsd-sm137-sm140.toml");
    compile::check(Source::read(&path).expect("the table"), &Options::default())
}

/// The lines of the manual. Line numbers start at 1.
pub struct Manual(Vec<String>);

impl Manual {
    pub fn read() -> Option<Self> {
        let text = manual_text::text("hsd-sm137-sm140-rs485.it.txt")?;
        Some(Manual(text.lines().map(str::to_owned).collect()))
    }

    pub fn line(&self, number: usize) -> &str {
        &self.0[number - 1]
    }

    pub fn len(&self) -> usize {
        self.0.len()
    }

    /// Returns the lines of a range with their line numbers.
    pub fn lines(&self, from: usize, to: usize) -> impl Iterator<Item = (usize, &str)> {
        (from..=to).map(|number| (number, self.line(number)))
    }

    /// Returns the table rows in a range of lines as line number and cells. Separator rows such as `|---|---|` are left out.
    pub fn rows(&self, from: usize, to: usize) -> Vec<(usize, Vec<String>)> {
        self.lines(from, to).filter_map(|(number, line)| Some((number, cells(line)?))).collect()
    }
}

/// Removes the markup of a cell.
fn plain(cell: &str) -> String {
    let marks = ["*", "`", "<code>", "</code>", "<p>", "</p>"];
    marks.iter().fold(cell.to_owned(), |cell, mark| cell.replace(mark, "")).trim().to_owned()
}

/// Returns the cells of a table row. Returns `None` for a separator row such as `|---|---|`, and for a line outside a table.
pub fn cells(line: &str) -> Option<Vec<String>> {
    let inner = line.trim().strip_prefix('|')?.strip_suffix('|')?;
    let cells: Vec<String> = inner.split('|').map(plain).collect();
    let is_ruler = cells.iter().all(|cell| cell.chars().all(|c| matches!(c, '-' | ':')) && !cell.is_empty());
    (!is_ruler).then_some(cells)
}

pub fn device(compilation: &Compilation) -> &Device {
    &compilation.catalog.as_ref().expect("a catalog").devices[0]
}

pub fn chapter<'d>(device: &'d Device, title: &str) -> &'d Group {
    let is_titled = |group: &&Group| group.kind == GroupKind::Chapter && group.name == title;
    device.groups.iter().find(is_titled).expect("the chapter")
}

pub fn message<'d>(device: &'d Device, name: &str) -> &'d Message {
    device.messages.iter().find(|message| message.name == name).unwrap_or_else(|| panic!("no message {name}"))
}

/// Returns the parameter number of an item.
pub fn code(item: &Item) -> u32 {
    let number = |binding: &Binding| match binding {
        Binding::Parameter(parameter) => Some(parameter.code),
        _ => None,
    };
    item.bindings.iter().find_map(number).expect("a parameter")
}

/// Returns the first line number in the citation `cite`. On this line, the manual describes the element that has the citation.
pub fn line(cite: Option<&str>) -> usize {
    let first = cite.and_then(|cite| cite.split([',', '-']).next());
    first.and_then(|line| line.trim().parse().ok()).expect("a line")
}

pub fn values<'d>(device: &'d Device, name: &str) -> &'d [EnumValue] {
    let definition = device.types.iter().find(|definition| definition.name == name).expect("a type");
    match &definition.shape {
        Shape::Enumeration { values, .. } => values,
        _ => panic!("{name} is not an enumeration"),
    }
}

/// Returns the name in the language of the manual, or an empty text if there is none.
pub fn original(names: &lexibus_codegen::ir::Texts) -> &str {
    names.first().map(|name| name.text.as_str()).unwrap_or_default()
}

/// Returns the number in a cell, decimal or hexadecimal with `0x`. Returns `None` if the cell contains anything else.
pub fn number(cell: &str) -> Option<i128> {
    let cell = cell.trim();
    match cell.strip_prefix("0x") {
        Some(digits) => i128::from_str_radix(digits, 16).ok(),
        None => cell.parse().ok(),
    }
}

/// Returns the texts of the `doubt` entries of the device and its definitions, groups, items and messages.
pub fn doubts(device: &Device) -> Vec<String> {
    let without_modules = Catalog::default();
    let of_device = lexibus_codegen::facts::doubts::of_device(&without_modules, device);
    let mut all: Vec<&lexibus_codegen::ir::Doubt> = of_device.into_iter().map(|(_, doubt)| doubt).collect();
    let items = device.groups.iter().flat_map(|group| &group.items);
    all.extend(items.flat_map(|item| &item.doubts));
    all.extend(device.groups.iter().flat_map(|group| &group.doubts));
    all.extend(device.messages.iter().flat_map(|message| &message.doubts));
    all.iter().map(|doubt| format!("{} // {} // {}", doubt.says, doubt.chosen, doubt.why)).collect()
}

/// Returns the type on which an enumeration, a bit field or a scaled type is based. Returns other types unchanged.
pub fn underlying(device: &Device, ty: lexibus_codegen::ir::Type) -> lexibus_codegen::ir::Type {
    let lexibus_codegen::ir::Type::Named(id) = ty else { return ty };
    match &device.types[id.0 as usize].shape {
        Shape::BitField { base, .. } | Shape::Enumeration { base, .. } | Shape::Scaled { base, .. } => *base,
        _ => ty,
    }
}
