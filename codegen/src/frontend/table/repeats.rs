//! Limits the number of items that rows create, and the size of the texts that rows copy from defaults and units.

use std::fmt::{Debug, Write};

use super::at::{Literal, OneOrMany};
use super::by_name::ByName;
use super::format::{ConditionValues, Row, UnitTable};
use super::tree::Reader;
use crate::diagnostics::codes;
use crate::ir::Value;
use crate::limits::{MAX_DERIVED_ITEMS, MAX_FREE_ROW_BYTES, MAX_LISTED_VALUES, ROW_BYTES_PER_ITEM};
use crate::source::Span;

/// Budget for the items that rows create, and for the texts that rows copy.
pub(super) struct Repeats {
    /// Remaining number of items; `None` after the first excess was reported.
    left: Option<usize>,
    /// Size of the defaults in the file, and of the defaults in the current chapter, converted to a number of items.
    defaults: [usize; 2],
}

impl Repeats {
    pub fn new(of_file: Option<&Row>) -> Self {
        Repeats { left: Some(MAX_DERIVED_ITEMS), defaults: [of_file.map_or(0, items), 0] }
    }

    /// Sets the defaults of the current chapter.
    pub fn chapter(&mut self, defaults: Option<&Row>) {
        self.defaults[1] = defaults.map_or(0, items);
    }

    /// Subtracts the defaults of the file and of the chapter from the budget. Returns false if the budget is too small for a row
    /// to inherit them.
    pub fn inherit(&mut self, reader: &mut Reader<'_, '_>, span: Span) -> bool {
        self.take(reader, self.defaults.iter().sum(), span)
    }

    /// Subtracts the texts of a unit, which a row copies, from the budget. Returns false if the budget is too small.
    pub fn unit(&mut self, reader: &mut Reader<'_, '_>, units: &ByName<UnitTable>, name: &str, span: Span) -> bool {
        let items = units.get(name).map_or(0, |(_, unit)| beyond(length(unit)));
        self.take(reader, items, span)
    }

    /// Subtracts all items of the row `key` except the first from the budget. Returns false if the budget is too small for
    /// `count` items.
    pub fn repeat(&mut self, reader: &mut Reader<'_, '_>, key: &str, row: &Row, count: u32, span: Span) -> bool {
        let each = || 1 + items(row) + beyond(key.len()) + expanded(row);
        count < 2 || self.take(reader, (count as usize - 1).saturating_mul(each()), span)
    }

    /// Subtracts the copied texts of a row that changes `count` items from the budget. Returns false if the budget is too small.
    pub fn patch(&mut self, reader: &mut Reader<'_, '_>, row: &Row, count: usize, span: Span) -> bool {
        count < 2 || self.take(reader, (count - 1).saturating_mul(items(row)), span)
    }

    /// Subtracts a number of items from the budget. Returns false if the budget is too small. Only the first row for
    /// which the budget is too small is reported.
    fn take(&mut self, reader: &mut Reader<'_, '_>, items: usize, span: Span) -> bool {
        if items == 0 {
            return true;
        }
        let left = self.left.and_then(|left| left.checked_sub(items));
        if left.is_none() && self.left.is_some() {
            let message = format!(
                "`count`, ranges of objects, ranges of values, and long texts expand the table to more than \
                 {MAX_DERIVED_ITEMS} items"
            );
            let found = codes::INPUT_TOO_LARGE.at(span, message);
            let label = "this row and all later rows describe one item each and copy no long texts";
            reader.diagnostics.push(found.label(label));
        }
        self.left = left;
        left.is_some()
    }
}

/// Returns the size of the texts in a row, converted to a number of items.
fn items(row: &Row) -> usize {
    beyond(length(row))
}

/// Returns the maximum size of the values in the ranges of `when` and `writable`, converted to a number of items. Each item
/// stores every value of these ranges separately.
fn expanded(row: &Row) -> usize {
    let has_range =
        |list: &[Literal]| list.iter().any(|literal| matches!(literal, Literal::Text(text) if text.contains("..")));
    let conditions = row.when.iter().flat_map(|when| when.iter());
    let conditions = conditions.map(|(_, given)| match &given.value {
        ConditionValues::Values(OneOrMany(values)) => has_range(values),
        ConditionValues::Bits(bits) => bits.value.as_ref().is_some_and(|values| has_range(&values.0)),
    });
    let writable = row.writable.as_ref().map(|list| has_range(&list.value));
    conditions.chain(writable).filter(|has_range| *has_range).count() * MAX_LISTED_VALUES as usize * size_of::<Value>()
        / ROW_BYTES_PER_ITEM
}

/// Converts the length of a text in bytes to a number of items. The first [`MAX_FREE_ROW_BYTES`] bytes do not count.
fn beyond(length: usize) -> usize {
    length.saturating_sub(MAX_FREE_ROW_BYTES) / ROW_BYTES_PER_ITEM
}

/// Returns the approximate length of a value. The span cannot be used, because the span of a table with a header ends after the
/// header.
pub(super) fn length(of: &impl Debug) -> usize {
    struct Count(usize);
    impl Write for Count {
        fn write_str(&mut self, text: &str) -> std::fmt::Result {
            self.0 += text.len();
            Ok(())
        }
    }
    let mut count = Count(0);
    // Writing to the counter cannot fail.
    let _ = write!(count, "{of:?}");
    count.0
}
