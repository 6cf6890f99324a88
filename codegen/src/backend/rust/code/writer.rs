//! The writer of a module: lines, blocks and doc comments.

use super::doc::{Doc, Piece};
use super::layout::{self, newline, STEP};

/// Rust code that is written line by line.
pub struct Code {
    out: String,
    indent: usize,
    /// The line that is being put together.
    line: Doc,
    runtime: String,
}

impl Code {
    /// Code that names the runtime by this path; `start` is the text in front of it.
    pub fn new(start: String, runtime: &str) -> Self {
        Code { out: start, indent: 0, line: Doc::default(), runtime: runtime.to_owned() }
    }

    /// The text, with the end of its last line.
    pub fn finish(mut self) -> String {
        self.out.push('\n');
        self.out
    }

    /// Reserves memory for this many further bytes.
    pub fn reserve(&mut self, bytes: usize) {
        self.out.reserve(bytes);
    }

    /// A line.
    pub fn line(&mut self, pieces: &[&dyn Piece]) {
        let mut line = std::mem::take(&mut self.line);
        line.clear();
        pieces.iter().for_each(|piece| piece.put(&mut line));
        layout::write(&line, self.indent, &mut self.out);
        self.line = line;
    }

    /// A line that begins a block, with its brace.
    pub fn open(&mut self, pieces: &[&dyn Piece]) {
        self.line(pieces);
        self.indent += STEP;
    }

    /// The line that ends a block.
    pub fn close(&mut self, end: &str) {
        self.indent -= STEP;
        self.line(&[&end]);
    }

    /// The line that ends a block and begins the next.
    #[cfg(feature = "messages")]
    pub fn reopen(&mut self, line: &str) {
        self.close(line);
        self.indent += STEP;
    }

    /// Lines.
    pub fn lines<P: Piece>(&mut self, lines: impl IntoIterator<Item = P>) {
        for line in lines {
            self.line(&[&line]);
        }
    }

    /// A line of a doc comment.
    pub fn doc(&mut self, text: &str) {
        newline(&mut self.out, self.indent);
        self.out.extend(["///", if text.is_empty() { "" } else { " " }, text]);
    }

    /// A doc comment of so many lines.
    pub fn docs(&mut self, lines: &[String]) {
        for line in lines {
            self.doc(line);
        }
    }

    /// The doc comment of a function that fails in one case.
    pub fn docs_with_error(&mut self, text: &str, error: &str) {
        for line in [text, "", "# Errors", "", error] {
            self.doc(line);
        }
    }

    /// A public field with its doc comment and its attribute.
    pub fn field(&mut self, docs: &[String], attribute: Option<&String>, name: &str, ty: &str) {
        self.docs(docs);
        self.lines(attribute);
        self.line(&[&"pub ", &name, &": ", &ty, &","]);
    }

    /// A public module.
    pub fn module(&mut self, heading: &str, name: &str, content: impl FnOnce(&mut Self)) {
        self.doc(heading);
        self.open(&[&"pub mod ", &name, &" {"]);
        content(self);
        self.close("}");
    }

    /// What gives the runtime its short name.
    pub fn use_runtime(&mut self) {
        let runtime = std::mem::take(&mut self.runtime);
        self.line(&[&"use ", &runtime, &" as rt;"]);
        self.runtime = runtime;
    }
}

/// Writes a line.
macro_rules! line {
    ($code:expr, $($piece:expr),* $(,)?) => {
        $code.line(&[$(&$piece),*])
    };
}

/// Writes the line that begins a block.
macro_rules! open {
    ($code:expr, $($piece:expr),* $(,)?) => {
        $code.open(&[$(&$piece),*])
    };
}

pub(in crate::backend::rust) use {line, open};
