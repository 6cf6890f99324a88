//! Events of emergency messages.

use lexibus::Emergency;
use lexibus_codegen::ir::CodeRow;
use lexibus_codegen::number::{bytes, hex16, hex8};

use super::event::{Event, EventKind};
use crate::description::Description;

/// Returns the event of an emergency message. The text contains the name of an error code other than 0 if the description has one.
pub(super) fn event(node: u8, message: &Emergency, description: Option<&Description>) -> Event {
    let name = description.and_then(|description| name(message.code, description));
    let name = name.map(|name| format!(" ({name})")).unwrap_or_default();
    let mut text = if message.code == 0 {
        format!("EMCY {}: no error", hex16(message.code))
    } else {
        format!("EMCY {}{name}, error register {}", hex16(message.code), hex8(message.register))
    };
    if message.vendor != [0; 5] {
        text += &format!(", vendor data {}", bytes(&message.vendor));
    }
    Event::new(Some(node), EventKind::Emergency, text)
}

/// Returns the name of an emergency code, from the row with the smallest range that contains the code. Returns `None` if no
/// row contains the code, or if this row has no name.
fn name(code: u16, description: &Description) -> Option<String> {
    let code = i128::from(code);
    let rows = description.device().code_tables.iter().flat_map(|table| table.rows.iter());
    let matching = rows.filter(|row| (row.code..=row.last.unwrap_or(row.code)).contains(&code));
    let width = |row: &&CodeRow| row.last.unwrap_or(row.code) - row.code;
    matching.min_by_key(width).map(|row| row.name.to_string()).filter(|name| !name.is_empty())
}
