//! The statements that write and read the data of a message.

use super::field::Field;
use super::rules::Rules;
use crate::passes::messages_shaped::{tail, Step};

/// The statements of one side of a message.
#[derive(Default)]
pub(in crate::backend::rust) struct Statements {
    pub write: Vec<String>,
    pub read: Vec<String>,
    /// `name: value` for each field, from what was read.
    pub build: Vec<String>,
    /// Whether writing and reading need the request, or the number of the device.
    pub uses_request: bool,
    pub uses_station: bool,
}

/// As many fixed bytes as fit a line.
const LINE: usize = 8;

/// The statements for these steps; `fields` are those that have a value of their own, in order.
pub(super) fn statements(steps: &[Step<'_>], fields: &[Field], rules: &Rules) -> Statements {
    let mut own = Statements::default();
    let mut fields = fields.iter();
    for (at, step) in steps.iter().enumerate() {
        let tail = tail(steps.get(at + 1..).unwrap_or_default());
        match step {
            Step::Bytes(bytes) => {
                for part in bytes.chunks(LINE) {
                    own.write.push(format!("to.bytes(&{})?;", array(part)));
                    own.read.push(format!("from.constant(&{})?;", array(part)));
                }
            }
            Step::Bits { bits, value } => {
                own.write.push(format!("to.number({bits}, {value})?;"));
                own.read.push(format!("from.fixed({bits}, {value})?;"));
            }
            Step::Padding(count) => {
                own.write.push(format!("to.padding({count})?;"));
                own.read.push(format!("from.skip({count})?;"));
            }
            Step::Echo { first, count } => {
                own.uses_request = true;
                own.write.push(format!("to.echo(request, {first}, {count})?;"));
                own.read.push(format!("from.echo(request, {first}, {count})?;"));
            }
            Step::Copy { first, count } => {
                own.uses_request = true;
                own.write.push(format!("to.copy(request, {first}, {count})?;"));
                own.read.push(format!("from.copy(request, {first}, {count})?;"));
            }
            Step::Station { bits, .. } => {
                own.uses_station = true;
                if *bits < 32 {
                    let last = (1_u64 << bits) - 1;
                    own.write.push(format!("rt::message::check::<u32>(station, &rt::Range::To({last}))?;"));
                }
                own.write.push(format!("to.number({bits}, station.into())?;"));
                own.read.push(format!("let station = from.number({bits})? as u32;"));
            }
            Step::Count { bits, max } => {
                let last = u64::MAX >> (64 - (*bits).clamp(1, 64));
                let last = max.map_or(last, |max| last.min(max.into()));
                own.write.push("let count = self.entries.len() as u64;".to_owned());
                own.write.push(format!("rt::message::check::<u64>(count, &rt::Range::To({last}))?;"));
                own.write.push(format!("to.number({bits}, count)?;"));
                own.read.push(format!("let count = usize::try_from(from.number({bits})?).ok()?;"));
            }
            Step::List { length, is_counted, max, .. } => {
                own.write.extend(max.filter(|_| !is_counted).into_iter().flat_map(|max| limit("entries.len()", max)));
                let list = match is_counted {
                    true => format!("let list = from.bytes(count.checked_mul({length})?)?;"),
                    false => format!("let list = from.but({tail})?;"),
                };
                value(&mut own, fields.next(), Some(list), rules, tail);
            }
            Step::Settings { max, .. } => {
                own.write.extend(max.into_iter().flat_map(|max| limit("settings.iter().count()", *max)));
                value(&mut own, fields.next(), None, rules, tail);
            }
            _ => value(&mut own, fields.next(), None, rules, tail),
        }
    }
    own.read.push("from.end()?;".to_owned());
    own
}

fn limit(count: &str, max: u16) -> [String; 2] {
    [format!("let count = self.{count} as u64;"), format!("rt::message::check::<u64>(count, &rt::Range::To({max}))?;")]
}

fn array(bytes: &[u8]) -> String {
    let bytes: Vec<String> = bytes.iter().map(|byte| format!("0x{byte:02X}")).collect();
    format!("[{}]", bytes.join(", "))
}

/// The statements for a step that has a field of its own.
fn value(own: &mut Statements, field: Option<&Field>, list: Option<String>, rules: &Rules, tail: u32) {
    let Some(field) = field else { return };
    let local = field.local();
    own.write.extend(field.write(rules));
    match list {
        Some(list) => own.read.push(list),
        None => own.read.push(format!("let {local} = {};", field.read(rules, tail))),
    }
    own.build.push(format!("{}: {}", field.name, field.decode(rules)));
}
