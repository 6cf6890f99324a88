//! What the XML declaration says of the encoding, held against the bytes.

use crate::diagnostics::{codes, Diagnostic, Diagnostics};
use crate::source::{Encoding, FileId, Source, Span};

/// Reports bytes that aren't in the encoding that the declaration promises.
pub fn report(source: &Source, file: FileId, diagnostics: &mut Diagnostics) {
    let declared = source.declared_encoding();
    let (message, read_as) = match source.encoding() {
        Encoding::Windows1252 if source.declares_unknown_encoding() => {
            ("the file declares an encoding that can't be read here", "Windows-1252")
        }
        Encoding::Windows1252 if declared.is_none_or(|label| label.eq_ignore_ascii_case("utf-8")) => {
            ("the file is neither UTF-8 nor of an encoding that it declares", "Windows-1252")
        }
        Encoding::Utf8 if declared.is_some_and(|label| !label.eq_ignore_ascii_case("utf-8")) => {
            ("the file declares another encoding, but is UTF-8", "UTF-8")
        }
        _ => return,
    };
    // Without any such character the two encodings are the same.
    let Some(at) = source.text().bytes().position(|byte| !byte.is_ascii()) else { return };
    let length = source.text()[at..].chars().next().map_or(0, char::len_utf8);
    let span = Span::new(file, at as u32, (at + length) as u32);
    diagnostics.push(
        Diagnostic::new(&codes::WRONG_ENCODING, span, message)
            .label(format!("the first such character; read as {read_as}"))
            .help("declare the encoding that the file has: `<?xml version=\"1.0\" encoding=\"…\"?>`"),
    );
}
