//! Data that the writers of all parts of the file use.

use std::collections::HashSet;

use lexibus_codegen::ir::{Catalog, TypeDef};

use super::super::options::MissingFacts;
use super::options::TrackedOptions;
use super::texts::TextList;

/// Data that the writers of all parts of the file use.
pub(super) struct Context<'a> {
    pub(super) catalog: &'a Catalog,
    pub(super) options: &'a TrackedOptions<'a>,
    pub(super) types: &'a [TypeDef],
    pub(super) missing: MissingFacts,
    pub(super) texts: TextList,
    /// Positions of the pluggable ports in the list of submodules.
    pub(super) pluggable_ports: HashSet<u32>,
    /// True if the source is a GSDML. The export then does not require facts that the source lacks.
    pub(super) is_gsdml: bool,
}
