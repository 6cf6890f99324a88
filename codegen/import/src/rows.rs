//! A line to a row of the format.

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

/// Where a row is.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum Place {
    Register { address: Address, table: Option<Table>, wire: Option<u32>, object: Option<(u16, Option<u8>)> },
    Object { index: u16, sub: Option<u8> },
    Parameter(u32),
}

/// A type of the format.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Type {
    pub base: Base,
    pub bits: u32,
    pub elements: Option<u32>,
    /// Bytes of a text.
    pub length: Option<u32>,
}

impl Type {
    pub fn text(&self) -> String {
        let length = || self.length.map_or(String::new(), |length| format!("({length})"));
        let own = match self.base {
            Base::Unsigned => format!("u{}", self.bits),
            Base::Signed | Base::Exponent => format!("i{}", self.bits),
            Base::Float => format!("f{}", self.bits),
            Base::Bool => "bool".to_owned(),
            Base::Text => format!("str{}", length()),
            Base::Bytes => format!("bytes{}", length()),
        };
        self.elements.map_or(own.clone(), |count| format!("{own}[{count}]"))
    }

    /// Bits of the whole value, where known.
    pub fn size(&self) -> Option<u32> {
        match self.base {
            Base::Text | Base::Bytes => self.length.and_then(|length| length.checked_mul(8)),
            _ => self.bits.checked_mul(self.elements.unwrap_or(1)),
        }
    }

    pub fn is_integer(&self) -> bool {
        matches!(self.base, Base::Unsigned | Base::Signed | Base::Exponent)
    }

    /// Whether an integer has this value; of a signed one, also as a pattern of bits.
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

/// A factor that another row holds.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Reference {
    pub name: String,
    pub is_exponent: bool,
    pub span: Span,
}

/// A row of the format.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Row {
    pub name: String,
    pub span: Span,
    /// The text of the line, for a comment.
    pub text: String,
    pub chapter: Rc<str>,
    /// Where it is; `Err` has the reason why it can't be a row.
    pub place: Result<Place, &'static str>,
    pub ty: Type,
    pub access: Option<&'static str>,
    pub order: Order,
    pub scale: Option<Reference>,
    pub count: Option<u32>,
    /// Place and meaning in `List::definitions`, where values or bits are named.
    pub meaning: Option<usize>,
    /// What else is said, as keys and values of TOML.
    pub facts: Vec<(&'static str, String)>,
}

/// All rows of a list.
#[derive(Debug, Default)]
pub(super) struct Rows {
    pub rows: Vec<Row>,
    pub definitions: Vec<Definition>,
    /// Whether nothing tells the access of any row.
    pub no_access: bool,
    /// Whether addresses are written `4x0001`, and so count from 1.
    pub from_one: bool,
}

/// The state of reading.
pub(super) struct Reader<'r, 'd> {
    pub columns: &'r Columns,
    pub diagnostics: &'d mut Diagnostics,
    pub style: Style,
    /// Assumptions that were told.
    pub told: BTreeSet<&'static str>,
    /// Units that nobody knows, of those that were told.
    pub units: BTreeSet<String>,
    /// The names of all lines.
    pub names: BTreeSet<String>,
    pub definitions: Definitions,
}

/// Reads the lines below the titles.
pub(super) fn read(records: &Records, columns: &Columns, diagnostics: &mut Diagnostics) -> Rows {
    let data: Vec<&Record> = super::data(records, columns).collect();
    let style = Style::of(&data, columns);
    let names = columns.get(Field::Name).map(|column| data.iter().map(|record| tidy(record.text(column.at))).collect());
    let mut reader = Reader {
        columns,
        diagnostics,
        style,
        told: BTreeSet::new(),
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
        reader.assume("access", header.span, "no column tells what may be written: all registers are read-only");
    }
    Rows { rows, definitions: reader.definitions.into_list(), no_access, from_one: style.addresses[0].is_x }
}

/// Whether the second of two addresses is no address on the wire, which is never above the number by so much.
fn is_index(number: Address, second: Address) -> bool {
    second.is_hex && !number.is_hex && second.first > number.first && (0x1000..=0x9FFF).contains(&second.first)
}

/// A text on one line.
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

    pub fn unreadable(&mut self, cell: &Cell, what: &str) {
        let message = format!("`{}` is no {what}", brief(&tidy(&cell.text)));
        self.report(&codes::CSV_UNREADABLE_CELL, cell.span, message, "left out; the rest of the row is kept");
    }

    /// Tells once what was assumed.
    pub fn assume(&mut self, key: &'static str, span: Span, message: &str) {
        if self.told.insert(key) {
            self.diagnostics.push(Diagnostic::new(&codes::CSV_ASSUMPTION, span, message));
        }
    }

    /// The title of a chapter: a line with one cell that is no address.
    fn title(&self, record: &Record) -> Option<String> {
        let mut filled = record.filled();
        let (Some((at, cell)), None) = (filled.next(), filled.next()) else { return None };
        let is_address = self.columns.list.iter().any(|column| column.at == at && column.field.is_address());
        let readable = is_address && address::read(&cell.text, self.style.addresses[0]).is_some();
        (!readable && self.columns.list.len() > 1).then(|| tidy(&cell.text))
    }

    fn row(&mut self, record: &Record, chapter: &Rc<str>) -> Row {
        self.count_cells(record);
        let place = self.place(record);
        let part = self.part(record, place.as_ref().ok());
        let ty = self.ty(record, place.as_ref().ok(), part);
        let mut facts = Vec::new();
        if let Some((low, high)) = part {
            let text = if low == high { format!("\"{low}\"") } else { format!("\"{high}-{low}\"") };
            facts.push(("part", text));
        }
        let access = self.access(record, place.as_ref().ok());
        let order = self.order(record, ty);
        let (scale, factor) = self.quantity(record, ty, &mut facts);
        self.limits(record, ty, factor, &mut facts);
        let name = self.name(record, place.as_ref().ok());
        let (meaning, words) = self.meaning(record, ty, &name);
        let described = self.described_list(record, ty).filter(|_| meaning.is_none());
        let by_words =
            described.as_ref().and_then(|(cell, list)| self.define(cell.span, list, list.is_bits, ty, &name));
        let listed = described.filter(|_| by_words.is_some()).map(|(cell, _)| cell.span);
        let meaning = meaning.or(by_words);
        self.words(record, &name, (words, listed), &mut facts);
        let own = tidy(self.text(record, Field::Chapter));
        Row {
            name,
            span: record.span,
            text: record.cells.iter().map(|cell| tidy(&cell.text)).collect::<Vec<_>>().join(" | "),
            chapter: if own.is_empty() { chapter.clone() } else { own.into() },
            place,
            ty,
            access,
            order,
            scale,
            count: self.repetition(record),
            meaning,
            facts,
        }
    }

    /// A line has as many cells as there are titles.
    fn count_cells(&mut self, record: &Record) {
        let (own, width) = (record.cells.len(), self.columns.width);
        // Cells without a title, and nothing in them, are no cells.
        let last = record.filled().last().map_or(0, |(at, _)| at + 1);
        let own = own.min(last.max(width));
        if own != width && width > 0 {
            let message = format!("the line has {own} cells, and the titles are {width}");
            self.report(&codes::CSV_RAGGED_ROW, record.span, message, "read from the left");
        }
    }

    fn place(&mut self, record: &Record) -> Result<Place, &'static str> {
        let (index, sub) = (self.cell(record, Field::Index), self.text(record, Field::Sub));
        if let Some(cell) = self.cell(record, Field::Reg) {
            let object = index.and_then(|index| self.object(index, sub));
            return self.register(record, cell, object);
        }
        if let Some(cell) = index {
            return match address::object(&cell.text, sub) {
                Some((index, sub)) => Ok(Place::Object { index, sub }),
                None => self.no_row(cell, "index of an object", "the object can't be read"),
            };
        }
        if let Some(cell) = self.cell(record, Field::Param) {
            let number = cells::number(&cell.text, false).and_then(Number::int).and_then(|own| u32::try_from(own).ok());
            return match number {
                Some(number) => Ok(Place::Parameter(number)),
                None => self.no_row(cell, "number of a parameter", "the number can't be read"),
            };
        }
        let message = "the line has no address".to_owned();
        self.report(&codes::CSV_NO_ROW, record.span, message, "written down as a comment");
        Err("no address")
    }

    fn no_row<T>(&mut self, cell: &Cell, what: &str, reason: &'static str) -> Result<T, &'static str> {
        let message = format!("`{}` is no {what}", brief(&tidy(&cell.text)));
        self.report(&codes::CSV_NO_ROW, cell.span, message, "the line is written down as a comment");
        Err(reason)
    }

    /// The object that a register is, too. An index with another number of digits than four is misprinted.
    fn object(&mut self, cell: &Cell, sub: &str) -> Option<(u16, Option<u8>)> {
        let digits = cell.text.split([':', '/', '.']).next().unwrap_or_default().chars();
        let is_marked = cell.text.starts_with("0x") || cell.text.starts_with("0X");
        let found = address::object(&cell.text, sub).filter(|_| !is_marked || digits.count() == 6);
        if found.is_none() {
            self.unreadable(cell, "index of an object, which has four digits");
        }
        found
    }

    fn register(
        &mut self,
        record: &Record,
        cell: &Cell,
        object: Option<(u16, Option<u8>)>,
    ) -> Result<Place, &'static str> {
        let Some(address) = address::read(&cell.text, self.style.addresses[0]) else {
            return self.no_row(cell, "number of a register", "the address can't be read");
        };
        let table = self.cell(record, Field::Table).and_then(|cell| {
            let found = address::table(&cell.text);
            if found.is_none() {
                self.unreadable(cell, "table of Modbus");
            }
            found.map(|(table, _)| table)
        });
        let second = self.columns.all(Field::Reg).nth(1);
        let second = second.and_then(|column| record.cells.get(column.at)).filter(|cell| !cells::is_blank(&cell.text));
        let wire = second.and_then(|cell| {
            let found = address::read(&cell.text, self.style.addresses[1]);
            if found.is_none() {
                self.unreadable(cell, "number of a register");
            }
            Some((cell, found?))
        });
        let table = table.or(address.table);
        Ok(match wire {
            Some((cell, second)) if object.is_none() && is_index(address, second) => {
                let message = "the second address is hexadecimal and above the number: read as the index of an object";
                self.assume("index", cell.span, message);
                Place::Register { address, table, wire: None, object: Some((second.first as u16, None)) }
            }
            wire => Place::Register { address, table, wire: wire.map(|(_, own)| own.first), object },
        })
    }

    /// The bits of the register that the row is about.
    fn part(&mut self, record: &Record, place: Option<&Place>) -> Option<(u8, u8)> {
        // Only registers have parts.
        let table =
            place.and_then(|place| if let Place::Register { table, .. } = place { Some(table) } else { None })?;
        if table.is_some_and(Table::is_bits) {
            return None;
        }
        if let Some(Place::Register { address: Address { bits: Some(bits), .. }, .. }) = place {
            return Some(*bits);
        }
        let cell = self.cell(record, Field::Part)?;
        let found = address::mask(&cell.text).or_else(|| address::bit_range(&cell.text));
        let is_number = |text: &str| text.chars().all(|letter| letter.is_ascii_digit());
        if found.is_none() && (cell.text.starts_with("0x") || is_number(&cell.text)) {
            self.unreadable(cell, "bit, range of bits or mask of neighbouring bits");
        }
        // A mask of the whole register says nothing.
        found.filter(|&(low, high)| (low, high) != (0, 15))
    }

    fn ty(&mut self, record: &Record, place: Option<&Place>, part: Option<(u8, u8)>) -> Type {
        let of = |base, bits| Type { base, bits, elements: None, length: None };
        if matches!(place, Some(Place::Register { table: Some(table), .. }) if table.is_bits()) {
            return of(Base::Bool, 1);
        }
        let cell = self.cell(record, Field::Type);
        let written = cell.and_then(|cell| types::read(&cell.text));
        if let Some((low, high)) = part {
            let bits = u32::from(high - low) + 1;
            let is_signed = written.is_some_and(|own| own.base == Base::Signed) && bits > 1;
            return if bits == 1 {
                of(Base::Bool, 1)
            } else {
                of(if is_signed { Base::Signed } else { Base::Unsigned }, bits)
            };
        }
        let size = self.size(record, place);
        match (cell, written) {
            (_, Some(written)) => self.sized(record, written, size),
            (Some(cell), None) => {
                let ty = guess(size);
                let message = format!("`{}` is no type", brief(&tidy(&cell.text)));
                self.report(&codes::CSV_UNREADABLE_CELL, cell.span, message, &format!("taken as {}", ty.text()));
                ty
            }
            (None, None) => {
                let ty = guess(size);
                let lists = [Field::Bits, Field::Enum].into_iter().any(|field| !self.text(record, field).is_empty());
                if !lists {
                    let message = format!("nothing tells the type: taken as {}", ty.text());
                    let span = self.cell(record, Field::Reg).map_or(record.span, |cell| cell.span);
                    match self.columns.get(Field::Type) {
                        Some(_) => self.diagnostics.push(Diagnostic::new(&codes::CSV_ASSUMPTION, span, message)),
                        None => {
                            self.assume("type", span, "no column tells types: they are taken as u16, or by the length")
                        }
                    }
                }
                ty
            }
        }
    }

    /// The bits that a row takes, by a column or the range of its address.
    fn size(&mut self, record: &Record, place: Option<&Place>) -> Option<u32> {
        for (field, unit) in [(Field::Width, 1), (Field::Bytes, 8), (Field::Words, 16)] {
            let Some(cell) = self.cell(record, field) else { continue };
            let number = cells::quantity(&cell.text, "", false).and_then(Number::int);
            match number.and_then(|number| u32::try_from(number).ok()).filter(|number| (1..=4096).contains(number)) {
                Some(number) => return Some(number * unit),
                None => self.unreadable(cell, "length"),
            }
        }
        match place {
            Some(Place::Register { address: Address { first, last: Some(last), .. }, .. }) => {
                (last - first).checked_add(1)?.checked_mul(16).filter(|&bits| bits <= 65536)
            }
            _ => None,
        }
    }

    /// A written type with the length of its row.
    fn sized(&mut self, record: &Record, written: Written, size: Option<u32>) -> Type {
        let mut ty = Type {
            base: written.base,
            bits: written.bits.unwrap_or(16),
            elements: written.elements,
            length: written.length,
        };
        let Some(size) = size else {
            if matches!(ty.base, Base::Unsigned | Base::Signed)
                && written.bits.is_none()
                && written.base == Base::Unsigned
            {
                let span = self.cell(record, Field::Type).map_or(record.span, |cell| cell.span);
                self.assume("bits", span, "integers without a length have 16 bits");
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

    /// Holds the length of a type against that of its row; a multiple of it makes an array.
    fn compare(&mut self, record: &Record, ty: &mut Type, size: u32) {
        let own = ty.size().unwrap_or(size);
        // A value of fewer bits than a register takes one; a column of lengths may count bytes or bits.
        let is_same = own.div_ceil(16) * 16 == size.div_ceil(16) * 16 || own == size / 2 || own == size / 16;
        if is_same {
            return;
        }
        if ty.elements.is_none() && ty.bits >= 16 && size > own && size.is_multiple_of(own) {
            ty.elements = Some(size / own);
            return;
        }
        let cell = [Field::Words, Field::Bytes, Field::Width, Field::Reg]
            .into_iter()
            .find_map(|field| self.cell(record, field));
        let span = cell.map_or(record.span, |cell| cell.span);
        let message = format!("{} registers, and {} takes {}", size.div_ceil(16), ty.text(), own.div_ceil(16));
        self.report(&codes::CSV_UNREADABLE_CELL, span, message, "the type is used");
    }

    fn access(&mut self, record: &Record, place: Option<&Place>) -> Option<&'static str> {
        let table = match place {
            Some(Place::Register { table, .. }) => *table,
            _ => None,
        };
        if let Some(cell) = self.cell(record, Field::Access) {
            match cells::access(&cell.text) {
                Some(access) => return Some(access),
                None => self.unreadable(cell, "access"),
            }
        }
        let by_function = self.cell(record, Field::Table).and_then(|cell| address::table(&cell.text)?.1);
        by_function.or_else(|| table.filter(|table| table.is_read_only()).map(|_| "ro"))
    }

    /// How many of the same follow each other.
    fn repetition(&mut self, record: &Record) -> Option<u32> {
        let cell = self.cell(record, Field::Count)?;
        let number = cells::number(&cell.text, false).and_then(Number::int);
        match number.and_then(|number| u32::try_from(number).ok()).filter(|number| (1..=1024).contains(number)) {
            Some(number) => Some(number).filter(|&number| number > 1),
            None => {
                self.unreadable(cell, "number of repetitions");
                None
            }
        }
    }
}

/// The type of a row that tells no more than its length.
fn guess(size: Option<u32>) -> Type {
    let of = |bits, elements| Type { base: Base::Unsigned, bits, elements, length: None };
    match size {
        None => of(16, None),
        Some(bits @ 1..=64) => of(bits, None),
        Some(bits) => of(16, Some(bits.div_ceil(16))),
    }
}
