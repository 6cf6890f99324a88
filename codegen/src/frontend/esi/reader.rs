//! The state of reading one file.

use super::budget::{Budget, Cost};
use super::templates::Templates;
use crate::diagnostics::{codes, Code};
use crate::etg::language;
use crate::frontend::xml;
use crate::ir::CompactString;
use crate::source::Span;

pub(super) type Reader<'a, 'd> = xml::Reader<'a, 'd, Esi<'a, 'd>>;

/// A text in several languages, each with its LcId if it has one.
pub(super) type Names<'a> = xml::Names<'a, Lcid>;

/// What the reader of ESI has beyond the base.
pub(super) struct Esi<'a, 'd> {
    pub budget: &'d mut Budget,
    pub templates: &'d Templates<'a>,
}

impl xml::Format for Esi<'_, '_> {
    const STANDARD: &'static str = "ETG.2000";
    const UNKNOWN: &'static Code = &codes::ESI_UNKNOWN_ELEMENT;
    const VALUE: &'static Code = &codes::ESI_VALUE;
    const ELEMENT_IN_KEY: bool = true;
    const ENGLISH: (&'static str, &'static str) = ("LcId", "1033");
}

/// A language of Windows; none = English.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Lcid(pub Option<u32>);

impl xml::Language for Lcid {
    fn rank(&self) -> u8 {
        language::rank(self.0)
    }

    fn tag(&self) -> CompactString {
        language::tag(self.0)
    }
}

impl Reader<'_, '_> {
    /// Whether so much may be added. The first addition that may not is reported.
    pub fn derive(&mut self, cost: Cost, span: Span) -> bool {
        if self.format.budget.take(cost) {
            return true;
        }
        if !std::mem::replace(&mut self.format.budget.exceeded, true) {
            let message = "what is said once and counts for many would make the description many times longer";
            let label = "it is left out from here on, and entries of objects with it";
            self.report(&codes::INPUT_TOO_LARGE, span, message, label);
        }
        false
    }
}
