//! Detects the notation of a list by examining whole columns.

use super::address;
use super::cells;
use super::columns::{Columns, Field, Hint};
use super::records::Record;
use super::types::{self, Base};

/// The notation of a list.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Style {
    /// True if a comma is the decimal mark.
    pub comma: bool,
    /// Notations of the addresses in the first and in the second address column.
    pub addresses: [address::Style; 2],
    /// True if minimum, maximum and default are physical values.
    pub physical: bool,
    /// True if the raw value must be divided by the divisor or gain.
    pub gain_divides: bool,
}

impl Style {
    /// Detects the notation from the data lines.
    pub fn of(records: &[&Record], columns: &Columns) -> Style {
        let texts = |field: Field, position: usize| {
            let column = columns.all(field).nth(position);
            let cells = column.into_iter().flat_map(|column| records.iter().map(move |record| record.text(column.at)));
            (cells, column.is_some_and(|column| column.is_hex))
        };
        let address = |position: usize| {
            let (cells, is_hex) = texts(Field::Reg, position);
            address::Style::of(cells, is_hex)
        };
        let numbers = [Field::Scale, Field::Divisor, Field::Offset, Field::Min, Field::Max, Field::Default];
        let marks = || numbers.into_iter().flat_map(|field| texts(field, 0).0).filter_map(cells::decimal_mark);
        let comma = marks().any(|comma| comma) && !marks().any(|comma| !comma);
        let gains: Vec<f64> =
            texts(Field::Divisor, 0).0.filter_map(|text| Some(cells::number(text, comma)?.real())).collect();
        Style {
            comma,
            addresses: [address(0), address(1)],
            physical: records.iter().any(|record| has_physical_limit(record, columns, comma)),
            gain_divides: columns.get(Field::Divisor).is_some_and(|column| column.hint != Hint::Gain)
                || gains.iter().all(|gain| *gain >= 1.0 && gain.fract() == 0.0),
        }
    }
}

/// Returns whether a limit or default value of a scaled integer has decimal places. Such a number is a physical value.
fn has_physical_limit(record: &Record, columns: &Columns, comma: bool) -> bool {
    let text = |field| columns.get(field).map_or("", |column| record.text(column.at));
    let factors = [Field::Scale, Field::Divisor, Field::Decimals, Field::Exponent];
    let is_scaled = factors.into_iter().any(|field| !cells::is_blank(text(field)))
        || cells::unit(text(Field::Unit), comma).1.is_some();
    let is_integer = types::read(text(Field::Type)).is_none_or(|ty| ty.base != Base::Float);
    // The ending `.0` does not indicate decimal places if addresses also have a decimal point.
    let prints_points = matches!(cells::number(text(Field::Reg), comma), Some(cells::Number::Real(_)));
    let is_fraction = |number: cells::Number| match number {
        cells::Number::Real(value) => value.fract() != 0.0 || !prints_points,
        cells::Number::Int { .. } => false,
    };
    let limits = [Field::Min, Field::Max, Field::Default];
    let mut numbers = limits.into_iter().filter_map(|field| cells::quantity(text(field), text(Field::Unit), comma));
    let range = || cells::range(text(Field::Range), text(Field::Unit), comma);
    is_scaled
        && is_integer
        && (numbers.any(is_fraction) || range().is_some_and(|(low, high)| is_fraction(low) || is_fraction(high)))
}
