//! Converts lines of the list to rows of a register table.

use std::collections::BTreeSet;
use std::rc::Rc;

use lexibus_codegen::diagnostics::{codes, Code, Diagnostic, Diagnostics};
use lexibus_codegen::source::Span;
use lexibus_codegen::text::brief;

use super::address::{self, Address, Table};
use super::cells::{self, Number, Order};
use super::columns::{Columns, Field};
use super::definitions::{Definition, Definitions};
use super::records::{Cell, Record, Records};
use super::style::Style;
use super::types::{self, Base, Written};

/// The address of a row in the register table.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum RowAddress {
    Register { printed: Address, table: Option<Table>, wire: Option<u32>, object: Option<(u16, Option<u8>)> },
    Object { index: u16, sub: Option<u8> },
    Parameter(u32),
}

/// The type of a row in a register table.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Type {
    pub base: Base,
    pub bits: u32,
    pub elements: Option<u32>,
    /// Length of a text or a sequence of bytes, in bytes.
    pub length: Option<u32>,
}

impl Type {
    /// Returns the type in the notation of a register table, such as `u16[4]`.
    pub fn text(&self) -> String {
        let length = || self.length.map_or(String::new(), |length| format!("({length})"));
        let value = match self.base {
            Base::Unsigned => format!("u{}", self.bits),
            Base::Signed | Base::Exponent => format!("i{}", self.bits),
            Base::Float => format!("f{}", self.bits),
            Base::Bool => "bool".to_owned(),
            Base::Text => format!("str{}", length()),
            Base::Bytes => format!("bytes{}", length()),
        };
        self.elements.map_or(value.clone(), |count| format!("{value}[{count}]"))
    }

    /// Returns the size of the complete value in bits if it is known.
    pub fn size(&self) -> Option<u32> {
        match self.base {
            Base::Text | Base::Bytes => self.length.and_then(|length| length.checked_mul(8)),
            _ => self.bits.checked_mul(self.elements.unwrap_or(1)),
        }
    }

    pub fn is_integer(&self) -> bool {
        matches!(self.base, Base::Unsigned | Base::Signed | Base::Exponent)
    }

    /// Returns whether the type can represent the value. Signed types also accept hexadecimal bit patterns.
    pub fn fits(&self, value: i128, is_hex: bool) -> bool {
        let modulus = 1i128 << self.bits.min(64);
        match self.base {
            Base::Unsigned => (0..modulus).contains(&value),
            Base::Signed | Base::Exponent => {
                (-modulus / 2..modulus / 2).contains(&value) || (is_hex && (0..modulus).contains(&value))
            }
            Base::Bool => (0..2).contains(&value),
            Base::Float => true,
            Base::Text | Base::Bytes => false,
        }
    }
}

/// A reference to the row that contains the scale factor.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Reference {
    pub name: String,
    pub is_exponent: bool,
    pub span: Span,
}

/// A row of a register table.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Row {
    pub name: String,
    pub span: Span,
    /// Original line, which becomes a comment if the line cannot become a row.
    pub text: String,
    pub chapter: Rc<str>,
    /// Address of the row, or the reason why the line cannot become a row.
    pub address: Result<RowAddress, &'static str>,
    pub ty: Type,
    pub access: Option<&'static str>,
    pub order: Order,
    pub scale: Option<Reference>,
    pub count: Option<u32>,
    /// Index in `Rows::definitions` of the names of values or bits.
    pub meaning: Option<usize>,
    /// Further TOML keys of the row, and their values.
    pub facts: Vec<(&'static str, String)>,
}

/// The rows of a list.
#[derive(Debug, Default)]
pub(super) struct Rows {
    pub rows: Vec<Row>,
    pub definitions: Vec<Definition>,
    /// True if the list contains no access rights.
    pub no_access: bool,
    /// True if addresses have the form `4x0001`. In the notation `4x0001`, the first address is 1.
    pub from_one: bool,
}

/// Converts the lines of a list to rows.
pub(super) struct Reader<'r, 'd> {
    pub columns: &'r Columns,
    pub diagnostics: &'d mut Diagnostics,
    pub style: Style,
    /// Assumptions that have already been reported.
    pub assumptions: BTreeSet<&'static str>,
    /// Unknown units that have already been reported.
    pub units: BTreeSet<String>,
    /// Names in all lines of the list.
    pub names: BTreeSet<String>,
    pub definitions: Definitions,
}

/// Converts the data lines of a list to rows.
pub(super) fn read(records: &Records, columns: &Columns, diagnostics: &mut Diagnostics) -> Rows {
    let data: Vec<&Record> = super::data(records, columns).collect();
    let style = Style::of(&data, columns);
    let names = columns.get(Field::Name).map(|column| data.iter().map(|record| tidy(record.text(column.at))).collect());
    let mut reader = Reader {
        columns,
        diagnostics,
        style,
        assumptions: BTreeSet::new(),
        units: BTreeSet::new(),
        names: names.unwrap_or_default(),
        definitions: Definitions::default(),
    };
    let mut chapter = Rc::from("");
    let mut rows = Vec::new();
    for record in data {
        match reader.title(record) {
            Some(title) => chapter = title.into(),
            None => rows.push(reader.row(record, &chapter)),
        }
    }
    let header = columns.header.and_then(|line| records.list.get(line));
    let no_access = rows.iter().all(|row| row.access.is_none());
    if let Some(header) = header.filter(|_| no_access) {
        reader.assume("access", header.span, "no column states access rights, so all registers are read-only");
    }
    Rows { rows, definitions: reader.definitions.list, no_access, from_one: style.addresses[0].is_x }
}

/// Returns whether the second of two addresses is an object index. A second address that is greater than the printed
/// address is not a wire address.
fn is_index(printed: Address, second: Address) -> bool {
    second.is_hex && !printed.is_hex && second.first > printed.first && (0x1000..=0x9FFF).contains(&second.first)
}

/// Replaces each sequence of whitespace in a text, such as a line break, with one space, and trims the text.
pub(super) fn tidy(text: &str) -> String {
    text.split_whitespace().collect::<Vec<_>>().join(" ")
}

impl Reader<'_, '_> {
    pub fn cell<'c>(&self, record: &'c Record, field: Field) -> Option<&'c Cell> {
        let column = self.columns.get(field)?;
        record.cells.get(column.at).filter(|cell| !cells::is_blank(&cell.text))
    }

    pub fn text<'c>(&self, record: &'c Record, field: Field) -> &'c str {
        self.cell(record, field).map_or("", |cell| cell.text.as_str())
    }

    pub fn report(&mut self, code: &'static Code, span: Span, message: String, label: &str) {
        self.diagnostics.push(Diagnostic::new(code, span, message).label(label));
    }

    /// Returns `found`. Reports the cell as unreadable if `found` is `None`.
    pub fn readable<T>(&mut self, found: Option<T>, cell: &Cell, what: &str) -> Option<T> {
        if found.is_none() {
            self.unreadable(cell, what);
        }
        found
    }

    pub fn unreadable(&mut self, cell: &Cell, what: &str) {
        let message = format!("`{}` is not {what}", brief(&tidy(&cell.text)));
        self.report(&codes::CSV_UNREADABLE_CELL, cell.span, message, "left out; the rest of the row is kept");
    }

    /// Reports an assumption unless it has already been reported.
    pub fn assume(&mut self, key: &'static str, span: Span, message: &str) {
        if self.assumptions.insert(key) {
            self.diagnostics.push(Diagnostic::new(&codes::CSV_ASSUMPTION, span, message));
        }
    }

    /// Returns the chapter title if the line contains a single non-empty cell that is not an address. Lists with a
    /// single known column have no chapter titles.
    fn title(&self, record: &Record) -> Option<String> {
        let mut filled = record.filled();
        let (Some((at, cell)), None) = (filled.next(), filled.next()) else { return None };
        let is_address = self.columns.list.iter().any(|column| column.at == at && column.field.is_address());
        let readable = is_address && address::read(&cell.text, self.style.addresses[0]).is_some();
        (!readable && self.columns.list.len() > 1).then(|| tidy(&cell.text))
    }

    fn row(&mut self, record: &Record, chapter: &Rc<str>) -> Row {
        self.count_cells(record);
        let address = self.address(record);
        let part = self.part(record, address.as_ref().ok());
        let ty = self.ty(record, address.as_ref().ok(), part);
        let mut facts = Vec::new();
        if let Some((low, high)) = part {
            let text = if low == high { format!("\"{low}\"") } else { format!("\"{high}-{low}\"") };
            facts.push(("part", text));
        }
        let access = self.access(record, address.as_ref().ok());
        let order = self.order(record, ty);
        let (scale, factor) = self.quantity(record, ty, &mut facts);
        self.limits(record, ty, factor, &mut facts);
        let name = self.name(record, address.as_ref().ok());
        let (meaning, words) = self.meaning(record, ty, &name);
        let described = self.described_list(record, ty).filter(|_| meaning.is_none());
        let by_words =
            described.as_ref().and_then(|(cell, list)| self.define(cell.span, list, list.is_bits, ty, &name));
        let listed = described.filter(|_| by_words.is_some()).map(|(cell, _)| cell.span);
        let meaning = meaning.or(by_words);
        self.words(record, &name, words, listed, &mut facts);
        let written = tidy(self.text(record, Field::Chapter));
        Row {
            name,
            span: record.span,
            text: record.cells.iter().map(|cell| tidy(&cell.text)).collect::<Vec<_>>().join(" | "),
            chapter: if written.is_empty() { chapter.clone() } else { written.into() },
            address,
            ty,
            access,
            order,
            scale,
            count: self.repetition(record),
            meaning,
            facts,
        }
    }

    /// Reports a line whose number of cells differs from the number of column titles.
    fn count_cells(&mut self, record: &Record) {
        let (cells, width) = (record.cells.len(), self.columns.width);
        // Empty cells in columns without a title are ignored.
        let last = record.filled().last().map_or(0, |(at, _)| at + 1);
        let cells = cells.min(last.max(width));
        if cells != width && width > 0 {
            let message = format!("the line has {cells} cells, but the list has {width} column titles");
            self.report(&codes::CSV_RAGGED_ROW, record.span, message, "cells are assigned to titles from the left");
        }
    }

    fn address(&mut self, record: &Record) -> Result<RowAddress, &'static str> {
        let (index, sub) = (self.cell(record, Field::Index), self.text(record, Field::Sub));
        if let Some(cell) = self.cell(record, Field::Reg) {
            let object = index.and_then(|index| self.object(index, sub));
            return self.register(record, cell, object);
        }
        if let Some(cell) = index {
            return match address::object(&cell.text, sub) {
                Some((index, sub)) => Ok(RowAddress::Object { index, sub }),
                None => self.no_row(cell, "an object index", "the object cannot be read"),
            };
        }
        if let Some(cell) = self.cell(record, Field::Param) {
            return match cells::number(&cell.text, false).and_then(Number::unsigned) {
                Some(number) => Ok(RowAddress::Parameter(number)),
                None => self.no_row(cell, "a parameter number", "the number cannot be read"),
            };
        }
        let message = "the line has no address".to_owned();
        self.report(&codes::CSV_NO_ROW, record.span, message, "kept as a comment");
        Err("no address")
    }

    fn no_row<T>(&mut self, cell: &Cell, what: &str, reason: &'static str) -> Result<T, &'static str> {
        let message = format!("`{}` is not {what}", brief(&tidy(&cell.text)));
        self.report(&codes::CSV_NO_ROW, cell.span, message, "the line is kept as a comment");
        Err(reason)
    }

    /// Returns the object address of a row that also has a register address. Reports an index that cannot be read, or
    /// whose prefix `0x` is not followed by exactly four digits, and returns `None`.
    fn object(&mut self, cell: &Cell, sub: &str) -> Option<(u16, Option<u8>)> {
        let digits = cell.text.split([':', '/', '.']).next().unwrap_or_default().chars();
        let is_marked = cell.text.starts_with("0x") || cell.text.starts_with("0X");
        let found = address::object(&cell.text, sub).filter(|_| !is_marked || digits.count() == 6);
        self.readable(found, cell, "an object index of four digits")
    }

    fn register(
        &mut self,
        record: &Record,
        cell: &Cell,
        object: Option<(u16, Option<u8>)>,
    ) -> Result<RowAddress, &'static str> {
        let Some(printed) = address::read(&cell.text, self.style.addresses[0]) else {
            return self.no_row(cell, "a register address", "the address cannot be read");
        };
        let cell = self.cell(record, Field::Table);
        let table = cell.and_then(|cell| self.readable(address::table(&cell.text), cell, "a Modbus table"));
        let second = self.columns.all(Field::Reg).nth(1);
        let second = second.and_then(|column| record.cells.get(column.at)).filter(|cell| !cells::is_blank(&cell.text));
        let wire = second.and_then(|cell| {
            let found = address::read(&cell.text, self.style.addresses[1]);
            Some((cell, self.readable(found, cell, "a register address")?))
        });
        let table = table.map(|(table, _)| table).or(printed.table);
        Ok(match wire {
            Some((cell, second)) if object.is_none() && is_index(printed, second) => {
                let message = "a hexadecimal second address that is greater than the first is read as an object index";
                self.assume("index", cell.span, message);
                RowAddress::Register { printed, table, wire: None, object: Some((second.first as u16, None)) }
            }
            wire => RowAddress::Register { printed, table, wire: wire.map(|(_, second)| second.first), object },
        })
    }

    /// Returns the bits that the row describes. Returns `None` if the row describes a whole register, a coil, a discrete
    /// input, an object or a parameter, or if its bits cannot be read.
    fn part(&mut self, record: &Record, address: Option<&RowAddress>) -> Option<(u8, u8)> {
        // Only registers have parts; objects and parameters have none.
        let Some(RowAddress::Register { table, printed, .. }) = address else { return None };
        if table.is_some_and(Table::is_bits) {
            return None;
        }
        if printed.bits.is_some() {
            return printed.bits;
        }
        let cell = self.cell(record, Field::Part)?;
        let found = address::mask(&cell.text).or_else(|| address::bit_range(&cell.text));
        let is_number = |text: &str| text.chars().all(|letter| letter.is_ascii_digit());
        if found.is_none() && (cell.text.starts_with("0x") || is_number(&cell.text)) {
            self.unreadable(cell, "a bit, a bit range or a mask of adjacent bits");
        }
        // A mask of all bits describes the whole register.
        found.filter(|&(low, high)| (low, high) != (0, 15))
    }

    fn ty(&mut self, record: &Record, address: Option<&RowAddress>, part: Option<(u8, u8)>) -> Type {
        let of = |base, bits| Type { base, bits, elements: None, length: None };
        if matches!(address, Some(RowAddress::Register { table: Some(table), .. }) if table.is_bits()) {
            return of(Base::Bool, 1);
        }
        let cell = self.cell(record, Field::Type);
        let written = cell.and_then(|cell| types::read(&cell.text));
        if let Some((low, high)) = part {
            let bits = u32::from(high - low) + 1;
            let is_signed = written.is_some_and(|written| written.base == Base::Signed) && bits > 1;
            return if bits == 1 {
                of(Base::Bool, 1)
            } else {
                of(if is_signed { Base::Signed } else { Base::Unsigned }, bits)
            };
        }
        let size = self.size(record, address);
        match (cell, written) {
            (_, Some(written)) => self.sized(record, written, size),
            (Some(cell), None) => {
                let ty = guess(size);
                let message = format!("`{}` is not a known data type", brief(&tidy(&cell.text)));
                self.report(&codes::CSV_UNREADABLE_CELL, cell.span, message, &format!("read as {}", ty.text()));
                ty
            }
            (None, None) => {
                let ty = guess(size);
                let lists = [Field::Bits, Field::Enum].into_iter().any(|field| !self.text(record, field).is_empty());
                if !lists {
                    let message = format!("the line states no data type, so {} is assumed", ty.text());
                    let span = self.cell(record, Field::Reg).map_or(record.span, |cell| cell.span);
                    match self.columns.get(Field::Type) {
                        Some(_) => self.diagnostics.push(Diagnostic::new(&codes::CSV_ASSUMPTION, span, message)),
                        None => self.assume(
                            "type",
                            span,
                            "no column states data types, so each type is derived from the length, or is u16 if the length is missing",
                        ),
                    }
                }
                ty
            }
        }
    }

    /// Returns the size of a row in bits. The size is in a column or follows from the address range.
    fn size(&mut self, record: &Record, address: Option<&RowAddress>) -> Option<u32> {
        for (field, unit) in [(Field::Width, 1), (Field::Bytes, 8), (Field::Words, 16)] {
            let Some(cell) = self.cell(record, field) else { continue };
            let number = cells::quantity(&cell.text, "", false).and_then(Number::unsigned);
            match number.filter(|number| (1..=4096).contains(number)) {
                Some(number) => return Some(number * unit),
                None => self.unreadable(cell, "a length"),
            }
        }
        match address {
            Some(RowAddress::Register { printed: Address { first, last: Some(last), .. }, .. }) => {
                (last - first).checked_add(1)?.checked_mul(16).filter(|&bits| bits <= 65536)
            }
            _ => None,
        }
    }

    /// Combines the type in a cell with the size of the row.
    fn sized(&mut self, record: &Record, written: Written, size: Option<u32>) -> Type {
        let mut ty = Type {
            base: written.base,
            bits: written.bits.unwrap_or(16),
            elements: written.elements,
            length: written.length,
        };
        let Some(size) = size else {
            if matches!(ty.base, Base::Unsigned | Base::Signed) && written.bits.is_none() {
                let span = self.cell(record, Field::Type).map_or(record.span, |cell| cell.span);
                self.assume("bits", span, "integers without a stated length are read as 16-bit integers");
            }
            return ty;
        };
        match ty.base {
            Base::Text | Base::Bytes => ty.length = ty.length.or(Some((size / 8).max(1))),
            Base::Bool | Base::Exponent => {}
            Base::Float if !written.is_explicit && size == 64 => ty.bits = 64,
            Base::Unsigned | Base::Signed if written.elements.is_none() => {
                let is_usual = matches!(size, 16 | 32 | 48 | 64);
                if !written.is_explicit && is_usual && (written.bits.is_none() || size > ty.bits) {
                    ty.bits = size;
                } else if written.bits.is_none() && size.is_multiple_of(16) {
                    ty.elements = Some(size / 16);
                } else {
                    self.compare(record, &mut ty, size);
                }
            }
            _ => self.compare(record, &mut ty, size),
        }
        ty
    }

    /// Compares the size of a type with the size of its row, rounded to whole registers. The type becomes an array if the
    /// row size is a multiple of the type size. Reports any other difference that the unit of the length does not explain.
    fn compare(&mut self, record: &Record, ty: &mut Type, size: u32) {
        let of_type = ty.size().unwrap_or(size);
        // A value that is smaller than a register occupies a whole register. A length column may contain bytes or bits
        // instead of registers.
        let is_same =
            of_type.div_ceil(16) * 16 == size.div_ceil(16) * 16 || of_type == size / 2 || of_type == size / 16;
        if is_same {
            return;
        }
        if ty.elements.is_none() && ty.bits >= 16 && size > of_type && size.is_multiple_of(of_type) {
            ty.elements = Some(size / of_type);
            return;
        }
        let cell = [Field::Words, Field::Bytes, Field::Width, Field::Reg]
            .into_iter()
            .find_map(|field| self.cell(record, field));
        let span = cell.map_or(record.span, |cell| cell.span);
        let message =
            format!("the row has {} registers, but {} has {}", size.div_ceil(16), ty.text(), of_type.div_ceil(16));
        self.report(&codes::CSV_UNREADABLE_CELL, span, message, "the type is used");
    }

    fn access(&mut self, record: &Record, address: Option<&RowAddress>) -> Option<&'static str> {
        let table = match address {
            Some(RowAddress::Register { table, .. }) => *table,
            _ => None,
        };
        if let Some(cell) = self.cell(record, Field::Access) {
            match cells::access(&cell.text) {
                Some(access) => return Some(access),
                None => self.unreadable(cell, "access rights"),
            }
        }
        let by_function = self.cell(record, Field::Table).and_then(|cell| address::table(&cell.text)?.1);
        by_function.or_else(|| table.filter(|table| table.is_read_only()).map(|_| "ro"))
    }

    /// Returns the number of repetitions, or `None` if the row is not repeated. Reports a cell that contains no number
    /// from 1 to 1024.
    fn repetition(&mut self, record: &Record) -> Option<u32> {
        let cell = self.cell(record, Field::Count)?;
        let number = cells::number(&cell.text, false).and_then(Number::unsigned);
        let number = number.filter(|number| (1..=1024).contains(number));
        self.readable(number, cell, "a number of repetitions").filter(|&number| number > 1)
    }
}

/// Returns the assumed type of a row without a type. `size` is the size of the row in bits if it is known.
fn guess(size: Option<u32>) -> Type {
    let of = |bits, elements| Type { base: Base::Unsigned, bits, elements, length: None };
    match size {
        None => of(16, None),
        Some(bits @ 1..=64) => of(bits, None),
        Some(bits) => of(16, Some(bits.div_ceil(16))),
    }
}
