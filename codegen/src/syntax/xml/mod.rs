//! A cursor over the events of an XML document, with positions and the path of open elements.
//!
//! [`Cursor::read`] returns the start of an element, its end (also of `<empty/>`), and text. Comments, processing
//! instructions, declarations and blank text are skipped. Names come without their namespace prefix. Attributes are parsed
//! on request, and values are decoded when they are used: skipping a part of a document allocates nothing.
//!
//! A reader walks down with [`Cursor::child`], which skips the unread rest of the previous child:
//!
//! ```
//! use lexibus_codegen::source::FileId;
//! use lexibus_codegen::syntax::xml::Cursor;
//!
//! let mut cursor = Cursor::new("<a><b x='1'/><c><d/></c></a>", FileId(0));
//! let root = cursor.root()?;
//! let mut names = Vec::new();
//! while let Some(tag) = cursor.child(&root)? {
//!     names.push(tag.name);
//! }
//! assert_eq!(names, ["b", "c"]);
//! # Ok::<(), lexibus_codegen::syntax::xml::Error>(())
//! ```
//!
//! DTDs are skipped and only the five entities of XML itself are expanded, so that a small file cannot grow into a large
//! one. Reading stops at the first error.

mod attributes;
mod cursor;
mod decode;
mod event;
mod scan;
#[cfg(test)]
mod tests;

pub use attributes::{Attribute, Attributes};
pub use cursor::Cursor;
pub use event::{Error, Event, Tag, Text};
