//! `lexibus decode`.

use std::io::BufRead;

use lexibus_device::monitor::Interpreter;
use lexibus_device::trace::{Line, Reader};

use super::events::Output;
use super::target::Watched;
use crate::args::Decode;
use crate::{say, Failure};

/// The first bytes of a BLF file (Vector).
const BLF: &[u8] = b"LOGG";

pub(super) fn run(arguments: &Decode) -> Result<bool, Failure> {
    let descriptions = match (&arguments.watched.network, arguments.watched.nodes.as_slice()) {
        (None, []) => Vec::new(),
        _ => Watched::new(&arguments.watched, None)?.nodes,
    };
    let mut interpreter = Interpreter::new(descriptions.iter().map(|(node, description)| (*node, description)));
    let unreadable =
        |error: std::io::Error| Failure::Failed(format!("cannot read {}: {error}", arguments.trace.display()));
    let file = std::fs::File::open(&arguments.trace).map_err(unreadable)?;
    let mut trace = std::io::BufReader::new(file);
    if trace.fill_buf().map_err(unreadable)?.starts_with(BLF) {
        let name = arguments.trace.display();
        let help = format!("convert it with python-can: `python -m can.logconvert {name} trace.asc`");
        return Err(Failure::Failed(format!("{name} is a BLF file, which Lexibus cannot read: {help}")));
    }
    let mut output = Output::new(std::io::BufWriter::new(std::io::stdout()), arguments.format)?;
    let mut reader = Reader::new();
    let (mut frames, mut unnamed, mut unknown) = (0_usize, 0_usize, 0_usize);
    for line in trace.split(b'\n') {
        let line = line.map_err(unreadable)?;
        match reader.line(&String::from_utf8_lossy(&line)) {
            Line::Frame(frame) => {
                frames += 1;
                match interpreter.interpret(&frame) {
                    Some(event) => output.put(frame.time(), &event)?,
                    None => unnamed += 1,
                }
            }
            Line::Unknown => unknown += 1,
            Line::Other => {}
        }
    }
    output.finish()?;
    say(&format!("{frames} frames; {unnamed} have no name in the descriptions; {unknown} lines could not be read"));
    Ok(unknown == 0)
}
