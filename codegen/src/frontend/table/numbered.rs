//! Numbers of registers that stand where the name of an item is wanted, as manuals print them: "replaced by register 10015".

use compact_str::CompactString;

use super::place;
use super::tree::Reader;
use crate::diagnostics::{codes, Diagnostic};
use crate::source::Span;
use crate::text::brief;

/// So many items are listed where a range has several.
const MAX_LISTED: usize = 4;

/// First and last number of an item, and its name.
pub(super) struct Numbered {
    pub first: u32,
    pub last: u32,
    pub name: CompactString,
}

/// Reports a name that is the number of a register, or a range of them. `false` where it is none.
pub(super) fn report(reader: &mut Reader<'_, '_>, list: &[Numbered], text: &str, span: Span) -> bool {
    let Some((first, last)) = place::registers(text).filter(|_| !list.is_empty() && !text.starts_with("0x")) else {
        return false;
    };
    let own: Vec<&str> =
        list.iter().filter(|item| item.first <= last && first <= item.last).map(|item| brief(&item.name)).collect();
    let text = brief(text);
    let (message, help) = match own.as_slice() {
        [] => (format!("there is no register {text}"), "write the name of an item that the table has".to_owned()),
        [one] => (format!("register {text} is `{one}`, and its name is wanted"), format!("write `{one}`")),
        several => {
            let names: Vec<String> = several.iter().take(MAX_LISTED).map(|name| format!("`{name}`")).collect();
            let rest = several.len().saturating_sub(MAX_LISTED);
            let more = if rest > 0 { format!(" and {rest} more") } else { String::new() };
            let message = format!("registers {text} are not one item, but {}{more}", names.join(", "));
            (message, "write the name of the one that is meant, and a doubt".to_owned())
        }
    };
    reader.diagnostics.push(Diagnostic::new(&codes::UNRESOLVED_NAME, span, message).help(help));
    true
}
