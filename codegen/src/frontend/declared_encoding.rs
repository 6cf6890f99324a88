//! Compares the encoding in the XML declaration with the bytes of the file.

use crate::diagnostics::{codes, Diagnostics};
use crate::source::{Encoding, FileId, Source, Span};

/// Replacement character for bytes that are invalid in the encoding.
const REPLACEMENT: char = '\u{FFFD}';

/// Reports bytes that do not match the encoding of the XML declaration or byte order mark.
pub fn report(source: &Source, file: FileId, diagnostics: &mut Diagnostics) {
    let Some((message, read_as)) = mismatch(source) else { return };
    let text = source.text();
    let affected = match read_as {
        Some(_) => text.bytes().position(|byte| !byte.is_ascii()),
        None => text.find(REPLACEMENT),
    };
    // A file that contains only ASCII characters is not reported, because it has the same bytes in the declared
    // encoding and in UTF-8. A file in UTF-16 is always reported, because even its first character has different bytes.
    let affected = affected.or_else(|| (source.encoding() == Encoding::Utf16).then_some(0));
    let found = affected.and_then(|at| Some((at, text[at..].chars().next()?)));
    let Some((at, letter)) = found else { return };
    let span = Span::new(file, at as u32, (at + letter.len_utf8()) as u32);
    let label = match read_as {
        Some(read_as) => format!("first affected character; the file is read as {read_as}"),
        None => "first invalid byte sequence; its bytes are lost".to_owned(),
    };
    let help = "save the file as UTF-8 with the declaration `<?xml version=\"1.0\" encoding=\"UTF-8\"?>`";
    diagnostics.push(codes::WRONG_ENCODING.at(span, message).label(label).help(help));
}

/// Returns the message of the diagnostic and the name of the encoding with which the file was decoded. The name is `None` if
/// some bytes could not be decoded. The function returns `None` if the bytes match the declared encoding.
fn mismatch(source: &Source) -> Option<(&'static str, Option<&'static str>)> {
    const ANOTHER: &str = "the file is not in its declared encoding";
    // The default encoding is UTF-8 (XML 1.0, 4.3.3).
    let declared = source.declared_charset();
    let is_named = source.declared_encoding().is_some_and(|label| !label.is_empty());
    let is_unknown = is_named && declared.is_none();
    let is = |charset: &str| if is_named { declared == Some(charset) } else { charset == "UTF-8" };
    let has_lost = || source.has_lost_bytes().then_some(("the file has bytes that are invalid in its encoding", None));
    match source.encoding() {
        Encoding::Windows1252 if source.has_wrong_mark() => {
            Some(("the file has a UTF-8 byte order mark but is not UTF-8", Some("Windows-1252")))
        }
        Encoding::Windows1252 if is_unknown => {
            Some(("the file declares an unsupported encoding", Some("Windows-1252")))
        }
        Encoding::Windows1252 if !is("windows-1252") => {
            Some(("the file is neither UTF-8 nor in the declared encoding", Some("Windows-1252")))
        }
        Encoding::Utf8 | Encoding::Utf8Bom if !is("UTF-8") => Some((ANOTHER, Some("UTF-8"))),
        Encoding::Utf16 if is_named && !is("UTF-16LE") && !is("UTF-16BE") => Some((ANOTHER, Some("UTF-16"))),
        Encoding::Utf16 | Encoding::Declared => has_lost(),
        Encoding::Utf8 | Encoding::Utf8Bom | Encoding::Windows1252 => None,
    }
}
