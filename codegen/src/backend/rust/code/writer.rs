//! Writes the code of a module: lines, blocks and doc comments.

use super::doc::{Doc, Piece};
use super::layout::{self, indent, STEP};

/// Minimum size of a part of the text, in bytes. Only the last part can be smaller.
const PART: usize = 32 * 1024;

/// Receives the parts of a text in their order.
pub type Sink<'s> = &'s mut dyn FnMut(&str);

/// Writes Rust code line by line.
pub struct Code<'s> {
    /// Text that the receiver has not received yet, or the complete text if there is no receiver.
    out: String,
    sink: Option<Sink<'s>>,
    indent: usize,
    /// Buffer for the line that is being assembled.
    line: Doc,
    runtime: String,
    /// False if doc comments are left out.
    has_docs: bool,
}

impl<'s> Code<'s> {
    /// Creates code that begins with the lines `start`. `runtime` is the path of the runtime crate.
    pub fn new(start: String, runtime: &str) -> Self {
        Code { out: start, sink: None, indent: 0, line: Doc::default(), runtime: runtime.to_owned(), has_docs: true }
    }

    /// Creates code that is passed to `sink` in parts. The text of a large device needs more memory than its description.
    pub fn to(sink: Sink<'s>, start: String, runtime: &str) -> Self {
        Code { sink: Some(sink), ..Code::new(start, runtime) }
    }

    /// Creates empty code in which doc comments are left out.
    pub fn without_docs(runtime: &str) -> Self {
        Code { has_docs: false, ..Code::new(String::new(), runtime) }
    }

    /// Returns the path of the runtime crate.
    pub fn runtime(&self) -> &str {
        &self.runtime
    }

    /// Passes the rest of the text to the receiver. Returns the complete text if there is no receiver.
    pub fn finish(mut self) -> String {
        self.pass(0);
        self.out
    }

    /// Passes the text to the receiver if there is one and the text is not shorter than `minimum` bytes.
    fn pass(&mut self, minimum: usize) {
        if let Some(sink) = self.sink.as_mut().filter(|_| self.out.len() >= minimum) {
            sink(&self.out);
            self.out.clear();
        }
    }

    /// Writes a line that consists of these pieces.
    pub fn line(&mut self, pieces: &[&dyn Piece]) {
        let mut line = std::mem::take(&mut self.line);
        line.clear();
        pieces.iter().for_each(|piece| piece.put(&mut line));
        layout::write(&line, self.indent, &mut self.out);
        self.line = line;
        self.pass(PART);
    }

    /// Writes a line that opens a block. The pieces include the brace.
    pub fn open(&mut self, pieces: &[&dyn Piece]) {
        self.line(pieces);
        self.indent += STEP;
    }

    /// Writes the line that closes a block.
    pub fn close(&mut self, end: &str) {
        self.indent -= STEP;
        self.line(&[&end]);
    }

    /// Writes a block that consists of one line, such as a function. The head does not include the brace.
    pub fn block(&mut self, head: impl Piece, line: impl Piece) {
        self.open(&[&head, &" {"]);
        self.line(&[&line]);
        self.close("}");
    }

    /// Writes the implementation of a trait that consists of one function, whose body is one line.
    pub fn implementation(&mut self, of: impl Piece, ty: impl Piece, function: impl Piece, body: impl Piece) {
        self.open(&[&"impl ", &of, &" for ", &ty, &" {"]);
        self.block(function, body);
        self.close("}");
    }

    /// Writes a line that closes a block and opens the next one.
    pub fn reopen(&mut self, line: &str) {
        self.close(line);
        self.indent += STEP;
    }

    /// Writes several lines.
    pub fn lines<P: Piece>(&mut self, lines: impl IntoIterator<Item = P>) {
        for line in lines {
            self.line(&[&line]);
        }
    }

    /// Writes a doc comment of one line.
    pub fn doc(&mut self, text: &str) {
        if !self.has_docs {
            return;
        }
        indent(&mut self.out, self.indent);
        self.out.extend(["///", if text.is_empty() { "" } else { " " }, text, "\n"]);
    }

    /// Writes a doc comment of several lines.
    pub fn docs(&mut self, lines: &[String]) {
        for line in lines {
            self.doc(line);
        }
    }

    /// Writes the doc comment of a function that can return one kind of error.
    pub fn docs_with_error(&mut self, text: &str, error: &str) {
        for line in [text, "", "# Errors", "", error] {
            self.doc(line);
        }
    }

    /// Writes a public field with a doc comment and, if there is one, an attribute.
    pub fn field(&mut self, docs: &[String], attribute: Option<&String>, name: &str, ty: &str) {
        self.docs(docs);
        self.lines(attribute);
        self.line(&[&"pub ", &name, &": ", &ty, &","]);
    }

    /// Writes a public module with `heading` as its doc comment.
    pub fn module(&mut self, heading: &str, name: &str, content: impl FnOnce(&mut Self)) {
        self.doc(heading);
        self.open(&[&"pub mod ", &name, &" {"]);
        content(self);
        self.close("}");
    }

    /// Writes the `use` item that imports the runtime crate as `rt`.
    pub fn use_runtime(&mut self) {
        let runtime = std::mem::take(&mut self.runtime);
        self.line(&[&"use ", &runtime, &" as rt;"]);
        self.runtime = runtime;
    }
}

/// Writes a line that consists of these pieces.
macro_rules! line {
    ($code:expr, $($piece:expr),* $(,)?) => {
        $code.line(&[$(&$piece),*])
    };
}

/// Writes a line that opens a block. The pieces include the brace.
macro_rules! open {
    ($code:expr, $($piece:expr),* $(,)?) => {
        $code.open(&[$(&$piece),*])
    };
}

pub(in crate::backend::rust) use {line, open};
