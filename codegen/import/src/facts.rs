//! What a line says of its register beside the address: order, unit and factor, limits, meaning, words.

use std::collections::HashSet;

use lexibus_codegen::diagnostics::{codes, Diagnostic};
use lexibus_codegen::frontend::table::is_unit;
use lexibus_codegen::source::Span;
use lexibus_codegen::text::brief;

use super::cells::{self, Number, Order};
use super::columns::{Field, Hint};
use super::records::{Cell, Record};
use super::rows::{tidy, Place, Reader, Reference, Type};
use super::types::{self, Base};
use super::values::{self, List};
use super::write::{digits, int, quoted, real};

/// How many letters of a description make a name.
const NAME_LETTERS: usize = 60;

/// What is longer is no unit.
const UNIT_LETTERS: usize = 24;

impl Reader<'_, '_> {
    pub fn order(&mut self, record: &Record, ty: Type) -> Order {
        let mut order = types::read(self.text(record, Field::Type)).map_or(Order::default(), |own| own.order);
        if let Some(cell) = self.cell(record, Field::Order) {
            let of_words = self.columns.get(Field::Order).is_some_and(|column| column.hint == Hint::Words);
            match cells::order(&cell.text, of_words) {
                Some(own) => order = own,
                None => self.unreadable(cell, "order of words or bytes"),
            }
        }
        // A single word has no order of words.
        let is_long = ty.size().is_none_or(|bits| bits > 16);
        Order { low_first: order.low_first.filter(|_| is_long), swap: order.swap.filter(|_| ty.base != Base::Bool) }
    }

    /// Unit, scale, offset and values that are no numbers. Returns the factor by another row, and that by a number.
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
        if let Some(factor) = factor.filter(|_| reference.is_none()) {
            facts.push(("scale", real(factor)));
        }
        let offset = self.number(record, Field::Offset, &unit).map(Number::real).filter(|offset| *offset != 0.0);
        match (offset, &reference) {
            (Some(offset), None) => facts.push(("offset", real(offset))),
            (Some(_), Some(_)) => {
                if let Some(cell) = self.cell(record, Field::Offset) {
                    self.unreadable(cell, "offset beside a factor that another row holds");
                }
            }
            (None, _) => {}
        }
        self.sentinel(record, ty, facts);
        (reference, (factor.unwrap_or(1.0), offset.unwrap_or(0.0)))
    }

    /// Whether a unit can be one. One that nobody knows is told once: it may be misspelt, or have a factor in it.
    fn is_symbol(&mut self, record: &Record, unit: &str) -> bool {
        let Some(cell) = self.cell(record, Field::Unit) else { return true };
        if unit.chars().count() > UNIT_LETTERS || unit.contains(['<', '>', '=', ';']) {
            self.unreadable(cell, "unit");
            return false;
        }
        if !is_unit(unit) && self.units.insert(unit.to_owned()) {
            let message = format!("the unit `{}` isn't known: `[units]` defines it, without a scale", brief(unit));
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
            _ => self.unreadable(cell, &format!("value of {}", ty.text())),
        }
    }

    fn number(&mut self, record: &Record, field: Field, unit: &str) -> Option<Number> {
        let cell = self.cell(record, field)?;
        let number = cells::quantity(&cell.text, unit, self.style.comma);
        if number.is_none() {
            self.unreadable(cell, "number");
        }
        number
    }

    fn factor(&mut self, record: &Record, unit: &str, reference: &mut Option<Reference>) -> Option<f64> {
        if let Some(cell) = self.cell(record, Field::Scale) {
            if let Some(factor) = cells::factor(&cell.text, unit, self.style.comma) {
                if factor.is_ambiguous {
                    let message =
                        "a factor `x10` is read as physical = raw × 10; the register may also have ten times the value";
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
                    "a gain of 10 is read as: physical = raw / 10"
                } else {
                    "a gain of 0.1 is read as: physical = raw × 0.1"
                };
                self.assume("gain", cell.span, message);
            }
            return match cells::factor(&cell.text, unit, self.style.comma).map(|own| own.value) {
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
        let exponent = cells::number(&cell.text, false).and_then(Number::int).filter(|own| (-12..=12).contains(own));
        match exponent {
            Some(exponent) => Some(power_of_ten(sign * exponent as i32)),
            None => {
                *reference = self.other(cell, true);
                None
            }
        }
    }

    /// A factor that another row holds.
    fn other(&mut self, cell: &Cell, is_exponent: bool) -> Option<Reference> {
        let name = tidy(&cell.text);
        if !self.names.contains(&name) {
            self.unreadable(cell, "factor, and no name of another row");
            return None;
        }
        // SunSpec's scale factors are exponents of ten, and so called.
        let is_exponent = is_exponent || name.to_lowercase().ends_with("_sf");
        Some(Reference { name: row_name(&name), is_exponent, span: cell.span })
    }

    pub fn limits(&mut self, record: &Record, ty: Type, factor: (f64, f64), facts: &mut Vec<(&'static str, String)>) {
        let unit = self.text(record, Field::Unit).to_owned();
        let mut values: Vec<(&'static str, Field, Option<Number>)> = Vec::new();
        if let Some(cell) = self.cell(record, Field::Range) {
            match cells::range(&cell.text, &unit, self.style.comma) {
                Some((low, high)) => {
                    values.extend([("min", Field::Range, Some(low)), ("max", Field::Range, Some(high))]);
                }
                // A range may be a list of values, which `meaning` reads.
                None if values::read(&cell.text).is_some() => {}
                None => self.unreadable(cell, "range such as 0..100"),
            }
        }
        for (key, field) in [("min", Field::Min), ("max", Field::Max), ("default", Field::Default)] {
            let Some(cell) = self.cell(record, field) else { continue };
            values.retain(|(own, ..)| *own != key);
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
                None => self.unreadable(cell, &format!("value of {}", ty.text())),
            }
        }
    }

    /// A limit as the device has it.
    fn raw(&mut self, span: Span, number: Number, ty: Type, (factor, offset): (f64, f64)) -> Option<String> {
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
            self.assume(
                "physical",
                span,
                "limits have fractions, and so are in physical units: they are divided by the scale",
            );
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

    pub fn name(&mut self, record: &Record, place: Option<&Place>) -> String {
        let own = row_name(self.text(record, Field::Name));
        let is_list = |text: &str| values::read(text).is_some_and(|list| list.entries.len() > 1);
        let described =
            || row_name(Some(self.text(record, Field::Doc)).filter(|text| !is_list(text)).unwrap_or_default());
        let by_place = || match place {
            Some(Place::Register { address, .. }) => format!("register {}", address.first),
            Some(Place::Object { index, sub }) => format!("object {index:04X}:{}", sub.unwrap_or(0)),
            Some(Place::Parameter(number)) => format!("parameter {number}"),
            None => "row".to_owned(),
        };
        Some(own)
            .filter(|name| !name.is_empty())
            .or_else(|| Some(described()).filter(|name| !name.is_empty()))
            .unwrap_or_else(by_place)
    }

    /// What values or bits mean; what of it can't be said so comes back as words.
    pub fn meaning(&mut self, record: &Record, ty: Type, name: &str) -> (Option<usize>, Option<String>) {
        let fields = [(Field::Bits, true), (Field::Enum, false), (Field::Range, false)];
        for (field, of_bits) in fields {
            let Some(cell) = self.cell(record, field) else { continue };
            let Some(list) = values::read(&cell.text) else {
                // What is said of values need not be a list: it is kept as words.
                if field == Field::Range {
                    continue;
                }
                self.report(
                    &codes::CSV_UNREADABLE_CELL,
                    cell.span,
                    format!("`{}` is no list such as `0=off, 1=on`", brief(&tidy(&cell.text))),
                    "kept as words",
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

    /// A definition with these entries: one that is there already, or a new one.
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
                self.report(&codes::CSV_UNREADABLE_CELL, span, message, "left out; the rest is kept");
                continue;
            }
            let (key, value) = if is_bits { bit_entry(entry) } else { value_entry(entry) };
            if !keys.insert(key.clone()) {
                let message = format!("`{}` occurs twice in the list", key.trim_matches('"'));
                self.report(&codes::CSV_UNREADABLE_CELL, span, message, "the first is kept");
                continue;
            }
            entries.push((key, value));
        }
        (!entries.is_empty()).then(|| self.definitions.place(is_bits, entries, name))
    }

    /// A list of values or bits that stands among the words.
    pub fn described_list<'c>(&self, record: &'c Record, ty: Type) -> Option<(&'c Cell, List)> {
        let columns = self.columns.all(Field::Doc).filter(|_| ty.is_integer());
        let mut cells = columns.filter_map(|column| record.cells.get(column.at));
        cells.find_map(|cell| Some((cell, values::read(&cell.text).filter(|list| list.entries.len() > 1)?)))
    }

    /// Documentation, the page, the name in another language. A list that was read is no words any more.
    pub fn words(
        &mut self,
        record: &Record,
        name: &str,
        (more, listed): (Option<String>, Option<Span>),
        facts: &mut Vec<(&'static str, String)>,
    ) {
        if let Some(cell) = self.cell(record, Field::Orig) {
            facts.push(("orig", quoted(&tidy(&cell.text))));
        }
        if let Some(cell) = self.cell(record, Field::Cite) {
            let page = cell.text.parse::<u32>().map_or_else(|_| quoted(&tidy(&cell.text)), |page| page.to_string());
            facts.push(("cite", page));
        }
        let columns = self.columns.all(Field::Doc);
        let cells = columns.filter_map(|column| record.cells.get(column.at));
        let texts = cells.filter(|cell| Some(cell.span) != listed).map(|cell| tidy(&cell.text));
        let mut doc: Vec<String> = texts.chain(more).filter(|text| !cells::is_blank(text) && text != name).collect();
        doc.dedup();
        if !doc.is_empty() {
            facts.push(("doc", quoted(&doc.join(". "))));
        }
    }
}

fn power_of_ten(exponent: i32) -> f64 {
    // 10⁻¹ as a power isn't the nearest number to 0.1.
    format!("1e{exponent}").parse().unwrap_or(1.0)
}

/// A truth value as a number.
fn truth(text: &str) -> Option<Number> {
    let value = match text.to_lowercase().as_str() {
        "true" | "on" | "yes" | "enabled" | "ja" | "sì" | "si" | "ein" => 1,
        "false" | "off" | "no" | "disabled" | "nein" | "aus" => 0,
        _ => return None,
    };
    Some(Number::Int { value, is_hex: false })
}

/// A name as the format takes it: braces would be filled in.
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

/// Braces stand for numbers in names of the format.
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
