//! Reads the attributes of a row: word order, unit, scale factor, limits, named values and documentation.

use std::collections::HashSet;

use lexibus_codegen::diagnostics::{codes, Diagnostic};
use lexibus_codegen::frontend::table::is_unit;
use lexibus_codegen::source::Span;
use lexibus_codegen::text::brief;

use super::cells::{self, Number, Order};
use super::columns::{Field, Hint};
use super::records::{Cell, Record};
use super::rows::{tidy, Reader, Reference, RowAddress, Type};
use super::types::{self, Base};
use super::values::{self, List};
use super::write::{digits, int, quoted, real};

/// Maximum number of characters of a name that is derived from a description.
const NAME_LETTERS: usize = 60;

/// Maximum number of characters of a unit.
const UNIT_LETTERS: usize = 24;

impl Reader<'_, '_> {
    pub fn order(&mut self, record: &Record, ty: Type) -> Order {
        let mut order = types::read(self.text(record, Field::Type)).map_or(Order::default(), |ty| ty.order);
        if let Some(cell) = self.cell(record, Field::Order) {
            let of_words = self.columns.get(Field::Order).is_some_and(|column| column.hint == Hint::Words);
            match cells::order(&cell.text, of_words) {
                Some(written) => order = written,
                None => self.unreadable(cell, "a word or byte order"),
            }
        }
        // A value of a single word has no word order.
        let is_long = ty.size().is_none_or(|bits| bits > 16);
        Order { low_first: order.low_first.filter(|_| is_long), swap: order.swap.filter(|_| ty.base != Base::Bool) }
    }

    /// Adds the unit, scale, offset and "not available" value to `facts`.
    ///
    /// Returns a reference to the row that contains the scale factor, if any, and the numeric factor and offset.
    pub fn quantity(
        &mut self,
        record: &Record,
        ty: Type,
        facts: &mut Vec<(&'static str, String)>,
    ) -> (Option<Reference>, (f64, f64)) {
        if matches!(ty.base, Base::Text | Base::Bytes | Base::Bool) {
            return (None, (1.0, 0.0));
        }
        let (unit, by_unit) = cells::unit(self.text(record, Field::Unit), self.style.comma);
        let unit = tidy(&unit);
        if !unit.is_empty() && unit.chars().any(|letter| !letter.is_numeric()) && self.is_symbol(record, &unit) {
            facts.push(("unit", quoted(&unit)));
        }
        let mut reference = None;
        let factor = self.factor(record, &unit, &mut reference).or(by_unit).filter(|factor| *factor != 1.0);
        facts.extend(factor.filter(|_| reference.is_none()).map(|factor| ("scale", real(factor))));
        let offset = self.number(record, Field::Offset, &unit).map(Number::real).filter(|offset| *offset != 0.0);
        match (offset, &reference) {
            (Some(offset), None) => facts.push(("offset", real(offset))),
            (Some(_), Some(_)) => {
                if let Some(cell) = self.cell(record, Field::Offset) {
                    let message = "an offset cannot be combined with a factor from another row".to_owned();
                    let label = "left out; the rest of the row is kept";
                    self.report(&codes::CSV_UNREADABLE_CELL, cell.span, message, label);
                }
            }
            (None, _) => {}
        }
        self.sentinel(record, ty, facts);
        (reference, (factor.unwrap_or(1.0), offset.unwrap_or(0.0)))
    }

    /// Returns whether a text can be a unit. Reports each unknown unit once, because the unit may be misspelled or
    /// contain a factor.
    fn is_symbol(&mut self, record: &Record, unit: &str) -> bool {
        let Some(cell) = self.cell(record, Field::Unit) else { return true };
        if unit.chars().count() > UNIT_LETTERS || unit.contains(['<', '>', '=', ';']) {
            self.unreadable(cell, "a unit");
            return false;
        }
        if !is_unit(unit) && self.units.insert(unit.to_owned()) {
            let message = format!("the unit `{}` is unknown: it is added to `[units]` without a scale", brief(unit));
            self.diagnostics.push(Diagnostic::new(&codes::CSV_ASSUMPTION, cell.span, message));
        }
        true
    }

    fn sentinel(&mut self, record: &Record, ty: Type, facts: &mut Vec<(&'static str, String)>) {
        let Some(cell) = self.cell(record, Field::Na) else { return };
        match cells::number(&cell.text, self.style.comma) {
            Some(Number::Int { value, is_hex }) if ty.is_integer() && ty.fits(value, is_hex) => {
                facts.push(("na", format!("{{ {} = \"not available\" }}", int(value, is_hex))));
            }
            _ => self.unreadable(cell, &format!("a value of the type {}", ty.text())),
        }
    }

    fn number(&mut self, record: &Record, field: Field, unit: &str) -> Option<Number> {
        let cell = self.cell(record, field)?;
        self.readable(cells::quantity(&cell.text, unit, self.style.comma), cell, "a number")
    }

    fn factor(&mut self, record: &Record, unit: &str, reference: &mut Option<Reference>) -> Option<f64> {
        if let Some(cell) = self.cell(record, Field::Scale) {
            if let Some(factor) = cells::factor(&cell.text, unit, self.style.comma) {
                if factor.is_ambiguous {
                    let message =
                        "a factor `x10` is read as physical = raw × 10, but can also mean raw = physical × 10";
                    self.assume("times", cell.span, message);
                }
                return Some(factor.value);
            }
            *reference = self.other(cell, false);
            return None;
        }
        if let Some(cell) = self.cell(record, Field::Divisor) {
            let divides = self.style.gain_divides;
            if self.columns.get(Field::Divisor).is_some_and(|column| column.hint == Hint::Gain) {
                let message = if divides {
                    "a gain of 10 is read as physical = raw / 10"
                } else {
                    "a gain of 0.1 is read as physical = raw × 0.1"
                };
                self.assume("gain", cell.span, message);
            }
            return match cells::factor(&cell.text, unit, self.style.comma).map(|factor| factor.value) {
                Some(value) if divides => Some(1.0 / value).filter(|factor| factor.is_finite()),
                Some(value) => Some(value),
                None => {
                    *reference = self.other(cell, false);
                    None
                }
            };
        }
        let (cell, sign) = match self.cell(record, Field::Exponent) {
            Some(cell) => (cell, 1),
            None => (self.cell(record, Field::Decimals)?, -1),
        };
        let exponent =
            cells::number(&cell.text, false).and_then(Number::int).filter(|exponent| (-12..=12).contains(exponent));
        match exponent {
            Some(exponent) => Some(power_of_ten(sign * exponent as i32)),
            None => {
                *reference = self.other(cell, true);
                None
            }
        }
    }

    /// Returns a reference to the row that contains the scale factor. If the cell does not contain the name of a row,
    /// reports the cell and returns `None`.
    fn other(&mut self, cell: &Cell, is_exponent: bool) -> Option<Reference> {
        let name = tidy(&cell.text);
        if !self.names.contains(&name) {
            self.unreadable(cell, "a factor or the name of another row");
            return None;
        }
        // According to SunSpec's naming convention, rows whose names end with `_SF` contain decimal exponents.
        let is_exponent = is_exponent || name.to_lowercase().ends_with("_sf");
        Some(Reference { name: row_name(&name), is_exponent, span: cell.span })
    }

    /// Adds the minimum, maximum and default to `facts`.
    pub fn limits(&mut self, record: &Record, ty: Type, factor: (f64, f64), facts: &mut Vec<(&'static str, String)>) {
        let unit = self.text(record, Field::Unit).to_owned();
        let mut values: Vec<(&'static str, Field, Option<Number>)> = Vec::new();
        if let Some(cell) = self.cell(record, Field::Range) {
            match cells::range(&cell.text, &unit, self.style.comma) {
                Some((low, high)) => {
                    values.extend([("min", Field::Range, Some(low)), ("max", Field::Range, Some(high))]);
                }
                // The cell contains a list of values instead of a range; `meaning` reads the list.
                None if values::read(&cell.text).is_some() => {}
                None => self.unreadable(cell, "a range such as 0..100"),
            }
        }
        for (key, field) in [("min", Field::Min), ("max", Field::Max), ("default", Field::Default)] {
            let Some(cell) = self.cell(record, field) else { continue };
            values.retain(|(other, ..)| *other != key);
            if key == "default" && matches!(ty.base, Base::Text) {
                facts.push((key, quoted(&tidy(&cell.text))));
                continue;
            }
            let number = cells::quantity(&cell.text, &unit, self.style.comma)
                .or_else(|| truth(&cell.text).filter(|_| ty.base == Base::Bool));
            values.push((key, field, number));
        }
        for (key, field, number) in values {
            let Some(cell) = self.cell(record, field) else { continue };
            match number.and_then(|number| self.raw(cell.span, number, ty, factor)) {
                Some(text) => facts.push((key, text)),
                None => self.unreadable(cell, &format!("a value of the type {}", ty.text())),
            }
        }
    }

    /// Converts a limit or default value to a raw value in TOML notation.
    fn raw(&mut self, span: Span, number: Number, ty: Type, scaling: (f64, f64)) -> Option<String> {
        let (factor, offset) = scaling;
        if ty.elements.is_some() {
            return None;
        }
        if ty.base == Base::Bool {
            return number.int().filter(|&value| ty.fits(value, false)).map(|value| (value == 1).to_string());
        }
        if ty.base == Base::Float {
            return Some(real(number.real()));
        }
        if self.style.physical && factor != 1.0 {
            self.assume("physical", span, "limits with fractions are read as physical values and divided by the scale");
            let raw = (number.real() - offset) / factor;
            let value = raw.round();
            let is_whole = (raw - value).abs() < 1e-6 * value.abs().max(1.0) && value.abs() < 1e15;
            return Some(value as i128)
                .filter(|&value| is_whole && ty.fits(value, false))
                .map(|value| int(value, false));
        }
        let is_hex = matches!(number, Number::Int { is_hex: true, .. });
        number.int().filter(|&value| ty.fits(value, is_hex)).map(|value| int(value, is_hex))
    }

    /// Returns the name of a row. The name comes from the name cell, the description or the address. Without any of
    /// these, the name is `row`.
    pub fn name(&mut self, record: &Record, address: Option<&RowAddress>) -> String {
        let written = row_name(self.text(record, Field::Name));
        let is_list = |text: &str| values::read(text).is_some_and(|list| list.entries.len() > 1);
        let described =
            || row_name(Some(self.text(record, Field::Doc)).filter(|text| !is_list(text)).unwrap_or_default());
        let by_address = || match address {
            Some(RowAddress::Register { printed, .. }) => format!("register {}", printed.first),
            Some(RowAddress::Object { index, sub }) => format!("object {index:04X}:{}", sub.unwrap_or(0)),
            Some(RowAddress::Parameter(number)) => format!("parameter {number}"),
            None => "row".to_owned(),
        };
        Some(written)
            .filter(|name| !name.is_empty())
            .or_else(|| Some(described()).filter(|name| !name.is_empty()))
            .unwrap_or_else(by_address)
    }

    /// Reads the names of values or bits. Returns the index of their definition. If the cell contains no list or the
    /// type is not an integer, returns the text of the cell instead.
    pub fn meaning(&mut self, record: &Record, ty: Type, name: &str) -> (Option<usize>, Option<String>) {
        let fields = [(Field::Bits, true), (Field::Enum, false), (Field::Range, false)];
        for (field, of_bits) in fields {
            let Some(cell) = self.cell(record, field) else { continue };
            let Some(list) = values::read(&cell.text) else {
                // A range that is not a list of values has already been read as limits.
                if field == Field::Range {
                    continue;
                }
                self.report(
                    &codes::CSV_UNREADABLE_CELL,
                    cell.span,
                    format!("`{}` is not a list such as `0=off, 1=on`", brief(&tidy(&cell.text))),
                    "kept as documentation",
                );
                return (None, Some(tidy(&cell.text)));
            };
            if !ty.is_integer() {
                return (None, Some(tidy(&cell.text)));
            }
            let is_bits = of_bits || list.is_bits;
            return (self.define(cell.span, &list, is_bits, ty, name), None);
        }
        (None, None)
    }

    /// Returns the index of the definition with the entries of `list`. Adds the definition if necessary. Reports and
    /// leaves out entries that do not fit the type or occur twice. Returns `None` if no entry is left.
    pub fn define(&mut self, span: Span, list: &List, is_bits: bool, ty: Type, name: &str) -> Option<usize> {
        let mut entries: Vec<(String, String)> = Vec::new();
        let mut keys = HashSet::new();
        for entry in &list.entries {
            let last = entry.last.unwrap_or(entry.first);
            let fits =
                |value| if is_bits { (0..i128::from(ty.bits)).contains(&value) } else { ty.fits(value, entry.is_hex) };
            if !fits(entry.first) || !fits(last) {
                let what = if is_bits { "bit" } else { "value" };
                let message =
                    format!("{} has no {what} {}", ty.text(), if fits(entry.first) { last } else { entry.first });
                self.report(&codes::CSV_UNREADABLE_CELL, span, message, "left out; the rest of the list is kept");
                continue;
            }
            let (key, value) = if is_bits { bit_entry(entry) } else { value_entry(entry) };
            if !keys.insert(key.clone()) {
                let message = format!("`{}` occurs twice in the list", key.trim_matches('"'));
                self.report(&codes::CSV_UNREADABLE_CELL, span, message, "the first entry is kept");
                continue;
            }
            entries.push((key, value));
        }
        (!entries.is_empty()).then(|| self.definitions.add(is_bits, entries, name))
    }

    /// Returns the first list of at least two values or bits in the documentation, with its cell. Returns `None` if
    /// there is no such list or the type is not an integer.
    pub fn described_list<'c>(&self, record: &'c Record, ty: Type) -> Option<(&'c Cell, List)> {
        let columns = self.columns.all(Field::Doc).filter(|_| ty.is_integer());
        let mut cells = columns.filter_map(|column| record.cells.get(column.at));
        cells.find_map(|cell| Some((cell, values::read(&cell.text).filter(|list| list.entries.len() > 1)?)))
    }

    /// Adds the documentation, the citation and the original name to `facts`.
    ///
    /// Appends the text `more` to the documentation. Leaves out the cell at `listed`, which was read as a list.
    pub fn words(
        &mut self,
        record: &Record,
        name: &str,
        more: Option<String>,
        listed: Option<Span>,
        facts: &mut Vec<(&'static str, String)>,
    ) {
        facts.extend(self.cell(record, Field::Orig).map(|cell| ("orig", quoted(&tidy(&cell.text)))));
        if let Some(cell) = self.cell(record, Field::Cite) {
            let page = cell.text.parse::<u32>().map_or_else(|_| quoted(&tidy(&cell.text)), |page| page.to_string());
            facts.push(("cite", page));
        }
        let columns = self.columns.all(Field::Doc);
        let cells = columns.filter_map(|column| record.cells.get(column.at));
        let texts = cells.filter(|cell| Some(cell.span) != listed).map(|cell| tidy(&cell.text));
        let mut doc: Vec<String> = texts.chain(more).filter(|text| !cells::is_blank(text) && text != name).collect();
        doc.dedup();
        facts.extend((!doc.is_empty()).then(|| ("doc", quoted(&doc.join(". ")))));
    }
}

fn power_of_ten(exponent: i32) -> f64 {
    // Parse a text, because `powi` would not return the number closest to 0.1.
    format!("1e{exponent}").parse().unwrap_or(1.0)
}

/// Converts a word for a truth value, such as `on` or `nein`, to 1 or 0.
fn truth(text: &str) -> Option<Number> {
    let value = match text.to_lowercase().as_str() {
        "true" | "on" | "yes" | "enabled" | "ja" | "sì" | "si" | "ein" => 1,
        "false" | "off" | "no" | "disabled" | "nein" | "aus" => 0,
        _ => return None,
    };
    Some(Number::Int { value, is_hex: false })
}

/// Creates a valid row name without braces and control characters. The maximum length of the name is 60 characters.
pub(super) fn row_name(text: &str) -> String {
    let text = unbraced(&tidy(text));
    let text: String = text.chars().filter(|letter| !letter.is_control()).collect();
    if text.chars().count() <= NAME_LETTERS {
        return text;
    }
    let first = text.split(['.', ';', '(', ':', ',']).next().unwrap_or_default().trim();
    let short: String = if first.is_empty() { text.as_str() } else { first }.chars().take(NAME_LETTERS).collect();
    short.trim_end().to_owned()
}

/// Replaces braces in a name. In a register table, braces contain placeholders for numbers.
fn unbraced(name: &str) -> String {
    name.replace('{', "(").replace('}', ")")
}

fn value_entry(entry: &values::Entry) -> (String, String) {
    let key = match entry.last {
        Some(last) => format!("\"{}..{}\"", digits(entry.first, entry.is_hex), digits(last, entry.is_hex)),
        None => digits(entry.first, entry.is_hex),
    };
    let value = if values::is_reserved(&entry.name) {
        "{ zone = \"reserved\" }".to_owned()
    } else {
        quoted(&unbraced(&entry.name))
    };
    (key, value)
}

fn bit_entry(entry: &values::Entry) -> (String, String) {
    let key = match entry.last {
        Some(last) => format!("\"{last}-{}\"", entry.first),
        None => entry.first.to_string(),
    };
    let value =
        if values::is_reserved(&entry.name) { "{ reserved = 0 }".to_owned() } else { quoted(&unbraced(&entry.name)) };
    (key, value)
}
