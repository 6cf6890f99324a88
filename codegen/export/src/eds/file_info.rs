//! Writes the section `[FileInfo]`.
//!
//! The export keeps the header of a CiA 306 file. In other formats, dates and times have the form of ISO 8601, and a
//! version can be missing. The export converts the dates and times, and replaces missing and invalid versions.

use super::extras::Header;
use super::note::{NoteKind, Subject};
use super::section::Section;
use super::{Context, Flavor};
use lexibus_codegen::ir;

/// EDSVersion of a file that is converted from another format. A converted file uses the sections and keys of CiA 306 1.3.
const VERSION: &str = "4.0";

pub(super) fn write(out: &mut Section<'_>, context: &Context<'_>) {
    let subject = Subject::Named(Header::FileInfo.name());
    let given = &context.device.header;
    let converted = (!context.is_verbatim).then(|| convert(given, context, out));
    let header = converted.as_ref().unwrap_or(given);
    let entries = [
        ("FileName", &header.file_name),
        ("FileVersion", &header.file_version),
        ("FileRevision", &header.file_revision),
        ("EDSVersion", &header.format_version),
        ("Description", &header.description),
        ("CreationTime", &header.creation_time),
        ("CreationDate", &header.creation_date),
        ("CreatedBy", &header.created_by),
        ("ModificationTime", &header.modification_time),
        ("ModificationDate", &header.modification_date),
        ("ModifiedBy", &header.modified_by),
    ];
    for (key, text) in entries.into_iter().filter(|(_, text)| !text.is_empty()) {
        out.open().plain(key, text, subject);
    }
    if context.flavor == Flavor::Dcf && !header.last_eds.is_empty() {
        out.open().plain("LastEDS", &header.last_eds, subject);
    }
}

/// Converts the header of another format to a header that CiA 306 allows.
fn convert(given: &ir::Header, context: &Context<'_>, out: &mut Section<'_>) -> ir::Header {
    let name = if given.file_name.is_empty() { context.file_name } else { &given.file_name };
    let name = lexibus_codegen::text::file_name(name);
    let stem = name.rsplit_once('.').map_or(name, |(stem, _)| stem);
    let ending = if context.flavor == Flavor::Dcf { "dcf" } else { "eds" };
    let mut header = ir::Header {
        file_name: compact_str::format_compact!("{stem}.{ending}"),
        format_version: VERSION.into(),
        ..given.clone()
    };
    let mut is_changed = false;
    for (version, missing) in [(&mut header.file_version, "1"), (&mut header.file_revision, "0")] {
        is_changed |= !version.is_empty() && version.parse::<u8>().is_err();
        if version.parse::<u8>().is_err() {
            let whole = version.split(|letter: char| !letter.is_ascii_digit()).next().unwrap_or_default();
            *version = if whole.parse::<u8>().is_ok() { whole.into() } else { missing.into() };
        }
    }
    for text in [&mut header.creation_date, &mut header.modification_date] {
        is_changed |= !text.is_empty() && date(text).is_none();
        *text = date(text).unwrap_or_default().into();
    }
    for text in [&mut header.creation_time, &mut header.modification_time] {
        is_changed |= !text.is_empty() && time(text).is_none();
        *text = time(text).unwrap_or_default().into();
    }
    if is_changed {
        out.open().notes.add(NoteKind::FileInfo, Subject::Named(Header::FileInfo.name()));
    }
    header
}

/// Converts `yyyy-mm-dd`, with an optional time zone, to `mm-dd-yyyy`. Returns `None` for any other text.
fn date(text: &str) -> Option<String> {
    let mut parts = text.get(..10)?.split('-');
    let [year, month, day] = [parts.next()?, parts.next()?, parts.next()?];
    let is_number = |part: &str, digits| part.len() == digits && part.bytes().all(|byte| byte.is_ascii_digit());
    (is_number(year, 4) && is_number(month, 2) && is_number(day, 2)).then(|| format!("{month}-{day}-{year}"))
}

/// Converts `hh:mm:ss`, with optional fractions and time zone, to `hh:mm` with AM or PM. Returns `None` for an invalid
/// time.
fn time(text: &str) -> Option<String> {
    let (hours, rest) = text.split_once(':')?;
    let hours: u8 = hours.parse().ok().filter(|hours| *hours < 24)?;
    let minutes: u8 = rest.get(..2)?.parse().ok().filter(|minutes| *minutes < 60)?;
    let half = if hours < 12 { "AM" } else { "PM" };
    let hours = if hours.is_multiple_of(12) { 12 } else { hours % 12 };
    Some(format!("{hours:02}:{minutes:02}{half}"))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn dates_and_times_of_iso_8601() {
        assert_eq!(date("2020-12-31").as_deref(), Some("12-31-2020"));
        assert_eq!(date("2020-12-31+01:00").as_deref(), Some("12-31-2020"));
        for text in ["31.12.2020", "2020-1-31", "", "2020-12-3ä"] {
            assert_eq!(date(text), None, "{text}");
        }
        assert_eq!(time("00:05:06").as_deref(), Some("12:05AM"));
        assert_eq!(time("13:45:00.0Z").as_deref(), Some("01:45PM"));
        for text in ["24:00:00", "1345", "12:6", "12:ää"] {
            assert_eq!(time(text), None, "{text}");
        }
    }
}
