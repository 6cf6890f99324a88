//! Data that the writers of all parts of the file use.

use std::collections::HashMap;

use compact_str::CompactString;
use lexibus_codegen::etg::unit;
use lexibus_codegen::ir::Catalog;

use super::super::options::MissingFacts;
use super::options::TrackedOptions;
use super::text::hex;

/// Data that the writers of all parts of the file use.
pub(super) struct Context<'a> {
    pub(super) catalog: &'a Catalog,
    pub(super) options: &'a TrackedOptions<'a>,
    pub(super) missing: MissingFacts,
    /// ETG.2000 unit numbers, keyed by unit symbol.
    pub(super) units: HashMap<CompactString, Option<String>>,
    /// True if the source is an ESI. The export then does not require facts that the source lacks.
    pub(super) is_esi: bool,
}

impl Context<'_> {
    /// Returns the ETG.2000 number of a unit, or `None` if ETG.2000 has no number for the symbol. If a unit has no
    /// known symbol, the IR contains the number in place of the symbol, and this function returns the number unchanged.
    pub(super) fn unit(&mut self, symbol: &CompactString) -> Option<String> {
        if symbol.is_empty() {
            return None;
        }
        let number = |symbol: &CompactString| {
            let digits = symbol.strip_prefix("#x").unwrap_or("-");
            if digits.bytes().all(|digit| digit.is_ascii_hexdigit())
                || symbol.bytes().all(|digit| digit.is_ascii_digit())
            {
                return Some(symbol.to_string());
            }
            unit::number(symbol).map(|number| hex(number, 8).to_string())
        };
        self.units.entry(symbol.clone()).or_insert_with(|| number(symbol)).clone()
    }
}
