//! Output of `lexibus explain`: a single code or the catalog of codes, as text or Markdown.

mod codes;
mod example;
pub mod markdown;

pub use codes::{catalog, explain};
use codes::{level, strictness};
