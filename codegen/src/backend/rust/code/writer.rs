//! Writes the code of a module: lines, blocks and doc comments.

use super::doc::{Doc, Piece};
use super::layout::{self, newline, STEP};

/// Number of bytes that are enough for the indentation and the line breaks of most lines.
const LINE: usize = 128;

/// Writes Rust code line by line.
pub struct Code {
    out: String,
    indent: usize,
    /// Buffer for the line that is being assembled.
    line: Doc,
    runtime: String,
    /// False if doc comments are left out.
    has_docs: bool,
}

impl Code {
    /// Creates code that begins with the text `start`. `runtime` is the path of the runtime crate.
    pub fn new(start: String, runtime: &str) -> Self {
        Code { out: start, indent: 0, line: Doc::default(), runtime: runtime.to_owned(), has_docs: true }
    }

    /// Creates empty code in which doc comments are left out.
    pub fn without_docs(runtime: &str) -> Self {
        Code { has_docs: false, ..Code::new(String::new(), runtime) }
    }

    /// Returns the path of the runtime crate.
    pub fn runtime(&self) -> &str {
        &self.runtime
    }

    /// Returns the complete text with a line break at the end.
    pub fn finish(mut self) -> String {
        self.out.push('\n');
        self.out
    }

    /// Reserves memory for additional bytes of code. The text of a large device is the largest allocation of the compiler,
    /// so it grows by a quarter instead of doubling.
    pub fn reserve(&mut self, bytes: usize) {
        if self.out.capacity() - self.out.len() < bytes {
            self.out.reserve_exact(bytes.max(self.out.len() / 4));
        }
    }

    /// Writes a line that consists of these pieces.
    pub fn line(&mut self, pieces: &[&dyn Piece]) {
        let mut line = std::mem::take(&mut self.line);
        line.clear();
        pieces.iter().for_each(|piece| piece.put(&mut line));
        self.reserve(2 * line.text().len() + LINE);
        layout::write(&line, self.indent, &mut self.out);
        self.line = line;
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
        self.reserve(text.len() + LINE);
        newline(&mut self.out, self.indent);
        self.out.extend(["///", if text.is_empty() { "" } else { " " }, text]);
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

    /// Writes a line for each field of a struct literal.
    pub fn values<P: Piece>(&mut self, fields: impl IntoIterator<Item = (&'static str, P)>) {
        for (name, value) in fields {
            self.line(&[&name, &": ", &value, &","]);
        }
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
