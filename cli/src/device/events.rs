//! Writes events as lines of text, as a table, as CSV or as JSON lines.

use std::collections::BTreeMap;
use std::io::{IsTerminal, Write};
use std::time::Duration;

use lexibus_codegen::text::printable;
use lexibus_device::monitor::{Event, EventKind};
use serde::Serialize;

use crate::args::EventFormat;

/// An event with its time.
#[derive(Serialize)]
struct Timed<'e> {
    #[serde(skip_serializing_if = "Option::is_none")]
    time: Option<f64>,
    #[serde(flatten)]
    event: &'e Event,
}

/// Writes events in a format.
pub(super) struct Output<W> {
    out: W,
    format: EventFormat,
    /// Rows of the table: the last text for each node and name. The name is that of a value or of a kind of event.
    rows: BTreeMap<(Option<u8>, String), String>,
    /// Number of rows on the screen.
    shown: usize,
    is_terminal: bool,
}

impl<W: Write> Output<W> {
    pub(super) fn new(mut out: W, format: EventFormat) -> std::io::Result<Self> {
        if format == EventFormat::Csv {
            writeln!(out, "time,node,kind,address,name,value")?;
        }
        let is_terminal = std::io::stdout().is_terminal();
        Ok(Self { out, format, rows: BTreeMap::new(), shown: 0, is_terminal })
    }

    pub(super) fn put(&mut self, time: Option<Duration>, event: &Event) -> std::io::Result<()> {
        match self.format {
            EventFormat::Text => {
                let time = time.map(|time| format!("{:.6} ", time.as_secs_f64())).unwrap_or_default();
                writeln!(self.out, "{time}{}", printable(&event.to_string()))?;
            }
            EventFormat::Csv => self.csv(time, event)?,
            EventFormat::Json => {
                let timed = Timed { time: time.map(|time| time.as_secs_f64()), event };
                let line = serde_json::to_string(&timed).map_err(std::io::Error::other)?;
                writeln!(self.out, "{line}")?;
            }
            EventFormat::Table => self.row(event)?,
        }
        self.out.flush()
    }

    fn csv(&mut self, time: Option<Duration>, event: &Event) -> std::io::Result<()> {
        let time = time.map(|time| format!("{:.6}", time.as_secs_f64())).unwrap_or_default();
        let node = event.node.map(|node| node.to_string()).unwrap_or_default();
        let kind = event.kind.name();
        if event.values.is_empty() {
            return writeln!(self.out, "{time},{node},{kind},,{},", cell(&event.text));
        }
        for value in &event.values {
            let (name, text) = (cell(&value.name), cell(&value.value));
            writeln!(self.out, "{time},{node},{kind},{},{name},{text}", cell(&value.address))?;
        }
        Ok(())
    }

    /// Updates the rows of the table. On a terminal, also redraws the table.
    fn row(&mut self, event: &Event) -> std::io::Result<()> {
        if event.values.is_empty() {
            let name = if event.kind == EventKind::Sdo { return Ok(()) } else { event.kind.name().to_owned() };
            self.rows.insert((event.node, name), event.text.clone());
        }
        for value in &event.values {
            self.rows.insert((event.node, value.name.clone()), value.value.clone());
        }
        if self.is_terminal {
            self.draw()
        } else {
            Ok(())
        }
    }

    fn draw(&mut self) -> std::io::Result<()> {
        if self.shown > 0 {
            // Move the cursor to the first row of the table.
            write!(self.out, "\x1b[{}A", self.shown)?;
        }
        let width = self.rows.keys().map(|(_, name)| name.chars().count()).max().unwrap_or(0);
        for ((node, name), value) in &self.rows {
            let node = node.map(|node| node.to_string()).unwrap_or_default();
            let line = format!("{node:>3}  {name:<width$}  {value}");
            let clear = if self.is_terminal { "\x1b[K" } else { "" };
            writeln!(self.out, "{}{clear}", printable(&line))?;
        }
        self.shown = self.rows.len();
        self.out.flush()
    }

    /// Writes the table if the output is not a terminal.
    pub(super) fn finish(mut self) -> std::io::Result<()> {
        if self.format == EventFormat::Table && !self.is_terminal {
            self.draw()?;
        }
        self.out.flush()
    }
}

/// Returns a text as a cell of a CSV file, in quotation marks if necessary (RFC 4180).
fn cell(text: &str) -> String {
    let text = printable(text);
    match text.contains([',', '"']) {
        true => format!("\"{}\"", text.replace('"', "\"\"")),
        false => text.into_owned(),
    }
}
