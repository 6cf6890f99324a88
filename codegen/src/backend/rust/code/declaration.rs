//! Constants and statics with their doc comments.

use super::doc::{seq, Doc, Piece};
use super::writer::Code;

/// A public constant or static, ready to be printed.
pub struct Declaration {
    docs: Vec<String>,
    code: Doc,
}

impl Declaration {
    /// Creates a declaration. `start` is the code before the value, without `pub`, such as `const LEN: usize`.
    pub fn new(docs: impl IntoIterator<Item: Into<String>>, start: impl Piece, value: impl Piece) -> Self {
        let docs = docs.into_iter().map(Into::into).collect();
        Declaration { docs, code: seq!["pub ", start, " = ", value, ";"] }
    }
}

impl Code<'_> {
    /// Writes constants and statics with their doc comments.
    pub fn declare<'d>(&mut self, declarations: impl IntoIterator<Item = &'d Declaration>) {
        for Declaration { docs, code } in declarations {
            self.docs(docs);
            self.line(&[code]);
        }
    }
}
