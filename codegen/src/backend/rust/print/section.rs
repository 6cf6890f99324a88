//! Prints the Rust modules that contain the definitions of a device.

use crate::backend::rust::code::{line, Code, Data};
use crate::backend::rust::model::Model;
use crate::backend::rust::reexport::{Home, Reexport, Section};

/// Writes a section of a device: re-exports of definitions in the runtime or in earlier devices, and new definitions. Writes nothing if
/// the section has neither re-exports nor definitions.
///
/// `names_runtime` states whether the code of new definitions contains a path into the runtime crate. The value is
/// `None` if the section has no new definitions.
pub(super) fn write(
    code: &mut Code,
    model: &Model,
    section: Section,
    heading: &str,
    names_runtime: Option<bool>,
    content: impl FnOnce(&mut Code),
) {
    let mut reexports = model.reexports.iter().filter(|reexport| reexport.section == section).peekable();
    if names_runtime.is_none() && reexports.peek().is_none() {
        return;
    }
    code.module(heading, section.name(), |code| {
        reexports.for_each(|reexport| self::reexport(code, reexport));
        if names_runtime == Some(true) {
            code.use_runtime();
        }
        content(code);
    });
}

fn reexport(code: &mut Code, reexport: &Reexport) {
    let home = match &reexport.home {
        Home::Runtime => {
            if !reexport.docs.is_empty() {
                // Rustdoc appends the documentation of the definition, which is a separate paragraph.
                code.doc(&reexport.docs);
                code.doc("");
            }
            line!(code, "#[doc(inline)]");
            format!("{}::profiles", code.runtime())
        }
        Home::Module(module) => format!("super::super::{module}"),
    };
    let names = Data::names(&reexport.names);
    line!(code, "pub use ", home, "::", reexport.section.name(), "::", names, ";");
}
