//! A cursor over the events of an XML document, with positions and the path of open elements.
//!
//! [`Cursor::read`] returns the start of an element, its end (also for `<empty/>`), and text. The cursor skips
//! comments, processing instructions, declarations, and text that contains only white space. Names exclude the
//! namespace prefix. Attributes are parsed on request, and values are decoded on use, so skipping a part of a document
//! allocates nothing.
//!
//! A reader iterates over children with [`Cursor::child`], which skips the unread rest of the previous child:
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
//! DTDs are skipped, and only character references and the five predefined entities of XML are expanded. A small file therefore
//! cannot expand into a large one. Reading stops at the first error.

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
