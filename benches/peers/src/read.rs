//! Measures how fast Lexibus and other readers read a description.

use std::cell::RefCell;
use std::hint::black_box;
use std::str::from_utf8;

use lexibus_codegen::compile::{self, Compilation, Options};
use lexibus_codegen::source::Source;
use quick_xml::events::Event;
use quick_xml::Reader;

use crate::input::{Input, InputFormat};
use crate::lexer;
use crate::measure::{in_turns, Contestant};
use crate::python::Python;
use crate::report::{Line, Table};

/// Measures all readers of `input` and returns a table.
pub fn compare(input: &Input, python: &RefCell<Option<Python>>) -> Table {
    let mut field = vec![(lexibus(input), None)];
    let bytes = &input.bytes;
    match input.kind {
        InputFormat::Eds => {
            field.push((text("span lexer", bytes, |text| Ok(lexer::lex(text))), Some(0.3)));
            field.push((text("canopen-host 0.6", bytes, canopen_host), Some(3.0)));
            field.extend(in_python("Python canopen 2.4", "canopen", input, python, Some(60.0)));
        }
        InputFormat::Esi => {
            field.push((text("quick-xml events", bytes, events), Some(0.5)));
            field.push((text("taktora-ethercat-esi 0.5", bytes, taktora), Some(2.5)));
            field.push((text("ethercat-esi 0.2", bytes, ethercat_esi), Some(6.0)));
            field.extend(in_python("lxml 6.1", "lxml ESI", input, python, None));
        }
        InputFormat::Gsdml => {
            field.push((text("quick-xml events", bytes, events), Some(0.5)));
            field.push((text("the same with attributes", bytes, attributes), None));
            field.extend(in_python("profinet-py 0.6", "profinet-py", input, python, None));
            field.extend(in_python("lxml 6.1", "lxml GSDML", input, python, None));
        }
        InputFormat::Table => {}
    }
    let (mut contestants, targets): (Vec<_>, Vec<_>) = field.into_iter().unzip();
    let outcomes = in_turns(&mut contestants);
    let names = contestants.iter().map(|contestant| contestant.name.clone());
    let lines = names.zip(outcomes).zip(targets).map(|((name, outcome), target)| Line { name, outcome, target });
    let title = format!("{}: {:.3} MB", input.title, input.bytes.len() as f64 / 1e6);
    Table { title, bytes: Some(input.bytes.len()), lines: lines.collect() }
}

pub fn check(name: String, bytes: Vec<u8>) -> Compilation {
    compile::check(Source::new(name, bytes), &Options::default())
}

fn lexibus(input: &Input) -> Contestant<'_> {
    let copy = move || (input.name(), input.bytes.clone());
    Contestant::new("Lexibus, checked IR", copy, |(name, bytes)| Ok(check(name, bytes)))
}

/// Creates a program whose reader requires text. The measured time includes checking that the bytes are valid UTF-8.
fn text<'a, T: 'a>(name: &str, bytes: &'a [u8], read: impl Fn(&'a str) -> Result<T, String> + 'a) -> Contestant<'a> {
    let run = move |bytes: &'a [u8]| read(from_utf8(bytes).map_err(|error| error.to_string())?);
    Contestant::new(name, move || bytes, run)
}

fn in_python<'a>(
    name: &str,
    reader: &'static str,
    input: &'a Input,
    python: &'a RefCell<Option<Python>>,
    target: Option<f64>,
) -> Option<(Contestant<'a>, Option<f64>)> {
    python.borrow().as_ref()?;
    let run = move |repetitions| {
        let mut python = python.borrow_mut();
        python.as_mut().ok_or("no Python")?.time(reader, &input.path, repetitions)
    };
    Some((Contestant::with_clock(name, run), target))
}

fn canopen_host(text: &str) -> Result<canopen_host::eds::Eds, String> {
    canopen_host::eds::Eds::parse(text).map_err(|error| error.to_string())
}

fn taktora(text: &str) -> Result<taktora_ethercat_esi::EsiFile, String> {
    taktora_ethercat_esi::parse(text).map_err(|error| error.to_string())
}

fn ethercat_esi(text: &str) -> Result<ethercat_esi::EtherCatInfo, String> {
    ethercat_esi::EtherCatInfo::from_xml_str(text).map_err(|error| error.to_string())
}

/// Reads all XML events with their positions.
fn events(text: &str) -> Result<u64, String> {
    let mut reader = Reader::from_str(text);
    let mut sum = 0;
    loop {
        match reader.read_event().map_err(|error| error.to_string())? {
            Event::Eof => return Ok(sum),
            event => {
                black_box(&event);
                sum += reader.buffer_position();
            }
        }
    }
}

/// Reads all XML events and splits the attributes of each tag. The attributes contain most facts of a GSDML.
fn attributes(text: &str) -> Result<u64, String> {
    let mut reader = Reader::from_str(text);
    let mut sum = 0;
    loop {
        match reader.read_event().map_err(|error| error.to_string())? {
            Event::Eof => return Ok(sum),
            Event::Start(tag) | Event::Empty(tag) => {
                for attribute in tag.attributes() {
                    black_box(attribute.map_err(|error| error.to_string())?);
                }
            }
            event => {
                black_box(event);
            }
        }
        sum += reader.buffer_position();
    }
}
