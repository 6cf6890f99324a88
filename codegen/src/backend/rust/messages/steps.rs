//! The statements that write and read the data of a message.

use super::field::Field;
use super::rules::Rules;
use crate::backend::rust::code::{call, seq, Doc};
use crate::ir::{Limits, Value};
use crate::resolve::messages::{tail, Step};

/// The statements of one side of a message.
#[derive(Default)]
pub(in crate::backend::rust) struct Statements {
    pub write: Vec<Doc>,
    pub read: Vec<Doc>,
    /// The value of each field, from what was read.
    pub build: Vec<(String, Doc)>,
    /// Whether writing and reading need the request, and both the number of the device.
    pub writes_request: bool,
    pub reads_request: bool,
    pub uses_station: bool,
}

/// As many fixed bytes as fit a line.
const LINE: usize = 8;

/// The statements for these steps; `fields` are those that have a value of their own, in order.
pub(super) fn statements(steps: &[Step<'_>], fields: &[Field], rules: &Rules) -> Statements {
    let mut own = Statements::default();
    let list = fields.iter().find(|field| field.is_list()).map_or("", |field| field.name.as_str());
    let mut fields = fields.iter();
    // What is known only when all is written.
    let mut end = Vec::new();
    // What is checked when the next step is written.
    let mut next = None;
    for (at, step) in steps.iter().enumerate() {
        let tail = tail(steps.get(at + 1..).unwrap_or_default());
        let due = next.take();
        match step {
            Step::Bytes(bytes) => {
                for part in bytes.chunks(LINE) {
                    own.write.push(format!("to.bytes(&{})?;", array(part)).into());
                    own.read.push(format!("from.constant(&{})?;", array(part)).into());
                }
            }
            Step::Bits { bits, value } => {
                own.write.push(format!("to.number({bits}, {value})?;").into());
                own.read.push(format!("from.fixed({bits}, {value})?;").into());
            }
            Step::Fixed { bits, order, value } => {
                own.write.push(number(*bits, order, &value.to_string()));
                own.read.push(match order.is_empty() {
                    true => format!("from.fixed({bits}, {value})?;").into(),
                    false => format!("from.fixed_in(&{order:?}, {value})?;").into(),
                });
            }
            Step::Length { bits, order, from, .. } => {
                let place = if end.is_empty() { "length_at".to_owned() } else { format!("length_at_{}", end.len()) };
                own.write.push(format!("let {place} = to.len();").into());
                own.write.push(number(*bits, order, "0"));
                own.read.push(format!("let length = from.{}?;", reading(*bits, order)).into());
                own.read.push(format!("from.counted({from}, length)?;").into());
                let order = if order.is_empty() { (0..bits / 8).map(|at| at as u8).collect() } else { order.to_vec() };
                end.push(format!("to.length({place}, &{order:?}, {from})?;").into());
            }
            Step::Padding(count) => {
                own.write.push(format!("to.padding({count})?;").into());
                own.read.push(format!("from.skip({count})?;").into());
            }
            Step::Echo { first, count } => {
                (own.writes_request, own.reads_request) = (true, true);
                own.write.push(format!("to.echo(request, {first}, {count})?;").into());
                own.read.push(format!("from.echo(request, {first}, {count})?;").into());
            }
            Step::Copy { first, count } => {
                (own.writes_request, own.reads_request) = (true, true);
                own.write.push(format!("to.copy(request, {first}, {count})?;").into());
                own.read.push(format!("from.copy(request, {first}, {count})?;").into());
            }
            Step::Same { first, count } => {
                (own.writes_request, own.reads_request) = (true, true);
                own.write.push("let same_at = to.len();".into());
                next = Some(format!("to.same(same_at, request, {first}, {count})?;").into());
                own.read.push(format!("from.clone().echo(request, {first}, {count})?;").into());
            }
            Step::Station { bits, value } => {
                own.uses_station = true;
                own.write.extend(station(*bits, &value.item.limits));
                own.write.push(number(*bits, &value.byte_order, "station.into()"));
                own.read.push(format!("let station = from.{}? as u32;", reading(*bits, &value.byte_order)).into());
            }
            Step::Count { bits, max } => {
                let last = u64::MAX >> (64 - (*bits).clamp(1, 64));
                let last = max.map_or(last, |max| last.min(max.into()));
                own.write.push(format!("let count = self.{list}.len() as u64;").into());
                own.write.push(format!("rt::message::check::<u64>(count, &rt::Range::To({last}))?;").into());
                own.write.push(format!("to.number({bits}, count)?;").into());
                own.read.push(format!("let count = usize::try_from(from.number({bits})?).ok()?;").into());
            }
            Step::List { length, is_counted, max, .. } => {
                own.write.extend(
                    max.filter(|_| !is_counted).into_iter().flat_map(|max| limit(&format!("{list}.len()"), max)),
                );
                let list = match is_counted {
                    true => format!("let list = from.bytes(count.checked_mul({length})?)?;").into(),
                    false => format!("let list = from.but({tail})?;").into(),
                };
                value(&mut own, fields.next(), Some(list), rules, tail);
            }
            Step::Settings { max, .. } => {
                let field = fields.next();
                let name = field.map_or("", |field| field.name.as_str());
                own.write.extend(max.iter().flat_map(|max| limit(&format!("{name}.iter().count()"), *max)));
                value(&mut own, field, None, rules, tail);
            }
            _ => value(&mut own, fields.next(), None, rules, tail),
        }
        own.write.extend(due);
    }
    own.write.append(&mut end);
    own.read.push("from.end()?;".into());
    own
}

/// The statement that writes a number.
pub(super) fn number(bits: u32, order: &[u8], value: &str) -> Doc {
    Doc::from(match order.is_empty() {
        true => format!("to.number({bits}, {value})?;"),
        false => format!("to.ordered(&{order:?}, {value})?;"),
    })
}

/// The method that reads a number.
fn reading(bits: u32, order: &[u8]) -> String {
    match order.is_empty() {
        true => format!("number({bits})"),
        false => format!("ordered(&{order:?})"),
    }
}

/// The check of a device's number; none where it may be any.
fn station(bits: u32, limits: &Limits) -> Option<Doc> {
    let number = |limit: &Option<Value>| limit.as_ref().and_then(Value::as_int).and_then(|own| u32::try_from(own).ok());
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
    let bytes: Vec<String> = bytes.iter().map(|byte| format!("0x{byte:02X}")).collect();
    format!("[{}]", bytes.join(", "))
}

/// The statements for a step that has a field of its own.
fn value(own: &mut Statements, field: Option<&Field>, list: Option<Doc>, rules: &Rules, tail: u32) {
    let Some(field) = field else { return };
    let local = field.local();
    own.write.extend(field.write(rules));
    match list {
        Some(list) => own.read.push(list),
        None => own.read.push(format!("let {local} = {};", field.read(rules, tail)).into()),
    }
    own.build.push((field.name.clone(), field.decode(rules)));
}
