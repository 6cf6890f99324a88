//! Generates the statements that write and read the data of a message.

use super::field::{steps_with_field, Code};
use crate::backend::rust::code::{call, seq, Doc};
use crate::ir::{Limits, Value};
use crate::number::hex8;
use crate::resolve::messages::Step;

/// The statements for writing and reading a request or a reply.
#[derive(Default)]
pub(in crate::backend::rust) struct Statements {
    pub write: Vec<Doc>,
    pub read: Vec<Doc>,
    /// Name and value of each field. The values are calculated from the data that was read.
    pub build: Vec<(String, Doc)>,
    /// True if the statements for writing use the request.
    pub writes_request: bool,
    /// True if the statements for reading use the request.
    pub reads_request: bool,
    /// True if the statements use the station number.
    pub uses_station: bool,
}

impl Statements {
    /// Adds a statement for writing and one for reading.
    fn add(&mut self, write: impl Into<Doc>, read: impl Into<Doc>) {
        self.write.push(write.into());
        self.read.push(read.into());
    }

    /// Adds the code of a field.
    fn field(&mut self, code: Option<Code>) {
        let Some(Code { write, read, build }) = code else { return };
        self.write.extend(write);
        self.read.push(read);
        self.build.push(build);
    }
}

/// Maximum number of fixed bytes in one line of generated code.
const LINE: usize = 8;

/// Returns the statements for these steps. `codes` contains the code of the steps' fields in order.
pub(super) fn statements(steps: &[Step<'_>], codes: Vec<Code>) -> Statements {
    let mut statements = Statements::default();
    let list = steps_with_field(steps).zip(&codes).find(|(step, _)| matches!(step, Step::List { .. }));
    let list = list.map_or_else(String::new, |(_, code)| code.build.0.clone());
    let mut codes = codes.into_iter();
    // Statements for writing that come after all others, because they need the total length.
    let mut end = Vec::new();
    // A check that follows the statement of the next step.
    let mut next = None;
    for step in steps {
        let due = next.take();
        match step {
            Step::Bytes(bytes) => {
                for part in bytes.chunks(LINE) {
                    let part = array(part);
                    statements.add(format!("to.bytes(&{part})?;"), format!("from.constant(&{part})?;"));
                }
            }
            Step::Bits { bits, value } => {
                statements.add(format!("to.number({bits}, {value})?;"), format!("from.fixed({bits}, {value})?;"));
            }
            Step::Fixed { bits, order, value } => {
                let read = match order.is_empty() {
                    true => format!("from.fixed({bits}, {value})?;"),
                    false => format!("from.fixed_in(&{order:?}, {value})?;"),
                };
                statements.add(number(*bits, order, &value.to_string()), read);
            }
            Step::Length { bits, order, from, .. } => {
                let length_position =
                    if end.is_empty() { "length_at".to_owned() } else { format!("length_at_{}", end.len()) };
                statements.write.push(format!("let {length_position} = to.len();").into());
                statements.write.push(number(*bits, order, "0"));
                statements.read.push(format!("let length = from.{}?;", reading(*bits, order)).into());
                statements.read.push(format!("from.counted({from}, length)?;").into());
                let order = if order.is_empty() { (0..bits / 8).map(|at| at as u8).collect() } else { order.to_vec() };
                end.push(format!("to.length({length_position}, &{order:?}, {from})?;").into());
            }
            Step::Padding(count) => {
                statements.add(format!("to.padding({count})?;"), format!("from.skip({count})?;"));
            }
            Step::Echo { first, count } | Step::Copy { first, count } => {
                (statements.writes_request, statements.reads_request) = (true, true);
                let name = if matches!(step, Step::Echo { .. }) { "echo" } else { "copy" };
                let [write, read] = ["to", "from"].map(|side| format!("{side}.{name}(request, {first}, {count})?;"));
                statements.add(write, read);
            }
            Step::Same { first, count } => {
                (statements.writes_request, statements.reads_request) = (true, true);
                next = Some(format!("to.same(same_at, request, {first}, {count})?;").into());
                let read = format!("from.clone().echo(request, {first}, {count})?;");
                statements.add("let same_at = to.len();", read);
            }
            Step::Station { bits, value } => {
                statements.uses_station = true;
                statements.write.extend(station(*bits, &value.item.limits));
                let read = format!("let station = from.{}? as u32;", reading(*bits, &value.byte_order));
                statements.add(number(*bits, &value.byte_order, "station.into()"), read);
            }
            Step::Count { bits, max } => {
                let last = u64::MAX >> (64 - (*bits).clamp(1, 64));
                let last = max.map_or(last, |max| last.min(max.into()));
                statements.write.push(format!("let count = self.{list}.len() as u64;").into());
                statements.write.push(format!("rt::message::check::<u64>(count, &rt::Range::To({last}))?;").into());
                let read = format!("let count = usize::try_from(from.number({bits})?).ok()?;");
                statements.add(format!("to.number({bits}, count)?;"), read);
            }
            Step::List { is_counted, max, .. } => {
                statements.write.extend(
                    max.filter(|_| !is_counted).into_iter().flat_map(|max| limit(&format!("{list}.len()"), max)),
                );
                statements.field(codes.next());
            }
            Step::Settings { max, .. } => {
                let code = codes.next();
                let name = code.as_ref().map_or("", |code| code.build.0.as_str());
                statements.write.extend(max.iter().flat_map(|max| limit(&format!("{name}.iter().count()"), *max)));
                statements.field(code);
            }
            _ => statements.field(codes.next()),
        }
        statements.write.extend(due);
    }
    statements.write.append(&mut end);
    statements.read.push("from.end()?;".into());
    statements
}

/// Returns the statement that writes a number.
pub(super) fn number(bits: u32, order: &[u8], value: &str) -> Doc {
    Doc::from(match order.is_empty() {
        true => format!("to.number({bits}, {value})?;"),
        false => format!("to.ordered(&{order:?}, {value})?;"),
    })
}

/// Returns the method call that reads a number.
pub(super) fn reading(bits: u32, order: &[u8]) -> String {
    match order.is_empty() {
        true => format!("number({bits})"),
        false => format!("ordered(&{order:?})"),
    }
}

/// Returns a check of the station number. Returns `None` if all 32-bit numbers are allowed.
fn station(bits: u32, limits: &Limits) -> Option<Doc> {
    let number =
        |limit: &Option<Value>| limit.as_ref().and_then(Value::as_int).and_then(|number| u32::try_from(number).ok());
    let all = u32::MAX >> 32_u32.saturating_sub(bits);
    let (low, high) = (number(&limits.low).unwrap_or(0), number(&limits.high).unwrap_or(all).min(all));
    let range = match (low, high) {
        (0, u32::MAX) => return None,
        (0, high) => seq!["&rt::Range::To(", high, ")"],
        (low, high) => call!("&rt::Range::Between", low, high),
    };
    Some(seq![call!("rt::message::check::<u32>", "station", range), "?;"])
}

fn limit(count: &str, max: u16) -> [Doc; 2] {
    [
        seq!["let count = self.", count, " as u64;"],
        seq!["rt::message::check::<u64>(count, &rt::Range::To(", u32::from(max), "))?;"],
    ]
}

fn array(bytes: &[u8]) -> String {
    let bytes: Vec<String> = bytes.iter().map(|byte| hex8(*byte)).collect();
    format!("[{}]", bytes.join(", "))
}
