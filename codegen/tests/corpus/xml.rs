//! Compares the XML cursor with an independent reader, the crate `quick-xml`. The inputs are the XML files of the corpus, and
//! copies with changed bytes. If the cursor finds no error, both readers must give the same events.

use crate::corpus_support;

use corpus_support::{all_files, File};
use lexibus_codegen::source::FileId;
use lexibus_codegen::syntax::xml::{Cursor, Error, Event};
use quick_xml::events::{BytesStart, Event as Theirs};
use quick_xml::Reader;

/// The XML events of a file: tags with their attributes as written, end tags, and texts without surrounding whitespace.
#[derive(Default, PartialEq, Eq, Debug)]
struct Events {
    list: Vec<String>,
    text: String,
}

impl Events {
    fn push(&mut self, event: String) {
        let text = std::mem::take(&mut self.text);
        let text = text.trim_matches([' ', '\t', '\r', '\n']);
        self.list.extend((!text.is_empty()).then(|| format!("{text:?}")));
        self.list.push(event);
    }
}

fn ours(text: &str) -> Result<Events, Error> {
    let mut cursor = Cursor::new(text, FileId(0));
    let mut events = Events::default();
    while let Some(event) = cursor.read()? {
        match event {
            Event::Start(tag) => {
                let mut line = format!("<{}", &text[tag.name_span().range()]);
                for attribute in tag.attributes() {
                    let attribute = attribute?;
                    line += &format!(" {}={:?}", &text[attribute.name_span.range()], attribute.raw);
                }
                events.push(line);
            }
            Event::End => events.push(">".into()),
            Event::Text(piece) => events.text += piece.raw,
        }
    }
    Ok(events)
}

fn theirs(text: &str) -> Result<Events, String> {
    let mut reader = Reader::from_str(text.trim_start_matches('\u{feff}'));
    let config = reader.config_mut();
    (config.allow_dangling_amp, config.check_end_names, config.allow_unmatched_ends) = (true, false, true);
    let mut events = Events::default();
    loop {
        match reader.read_event().map_err(|error| error.to_string())? {
            Theirs::Start(tag) => events.push(start(&tag)?),
            Theirs::Empty(tag) => {
                events.push(start(&tag)?);
                events.push(">".into());
            }
            Theirs::End(_) => events.push(">".into()),
            Theirs::Text(piece) => events.text += &piece.into_inner(),
            Theirs::CData(piece) => events.text += &piece.into_inner(),
            Theirs::GeneralRef(name) => events.text += &format!("&{};", name.into_inner()),
            Theirs::Eof => return Ok(events),
            Theirs::Comment(_) | Theirs::Decl(_) | Theirs::PI(_) | Theirs::DocType(_) => {}
        }
    }
}

fn start(tag: &BytesStart<'_>) -> Result<String, String> {
    let mut line = format!("<{}", tag.name().as_ref());
    for attribute in tag.attributes() {
        let attribute = attribute.map_err(|error| error.to_string())?;
        line += &format!(" {}={:?}", attribute.key.as_ref(), attribute.value);
    }
    Ok(line)
}

fn xml_files() -> Vec<File> {
    all_files().into_iter().flatten().filter(File::is_xml).collect()
}

/// Compares the events of both readers. Returns whether the cursor found no error.
fn agree(name: &str, text: &str) -> bool {
    let Ok(found) = ours(text) else { return false };
    let expected = theirs(text).unwrap_or_else(|error| panic!("{name}: {error}"));
    let differs = found.list.iter().zip(&expected.list).find(|(found, expected)| found != expected);
    assert_eq!((differs, found.list.len()), (None, expected.list.len()), "{name}");
    true
}

#[test]
fn the_same_events_in_every_file() {
    let files = xml_files();
    let faultless = files.iter().filter(|file| agree(&file.name, &file.text())).count();
    assert!(faultless * 10 >= files.len() * 9, "only {faultless} of {} are well formed", files.len());
}

#[test]
fn the_same_events_wherever_a_damaged_file_has_no_fault() {
    const BYTES: &[u8] = b"<>/&'\"=!?-[] x";
    const LENGTH: usize = 4096;
    for (number, file) in xml_files().into_iter().enumerate() {
        let mut text: String = file.text().chars().take(LENGTH).filter(char::is_ascii).collect();
        // Close the open elements, so that a truncated file has no errors unless bytes were changed.
        text.truncate(text.rfind('<').unwrap_or(0));
        let closing: String = open_elements(&text).iter().rev().map(|name| format!("</{name}>")).collect();
        let text = (text + &closing).into_bytes();
        for step in 0..200 {
            let mut damaged = text.clone();
            let at = (step * 7919 + number * 104_729) % text.len().max(1);
            if let Some(byte) = damaged.get_mut(at) {
                *byte = BYTES[(step + number) % BYTES.len()];
            }
            agree(&file.name, std::str::from_utf8(&damaged).expect("ASCII"));
        }
    }
}

/// Returns the names of the elements that are still open at the end of a text.
fn open_elements(text: &str) -> Vec<String> {
    let mut cursor = Cursor::new(text, FileId(0));
    let mut open = Vec::new();
    while let Ok(Some(event)) = cursor.read() {
        match event {
            Event::Start(tag) => open.push(text[tag.name_span().range()].to_owned()),
            Event::End => drop(open.pop()),
            Event::Text(_) => {}
        }
    }
    open
}
