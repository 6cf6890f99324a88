//! Check of PDO mappings (CiA 301 7.5.2.36 and 7.5.2.38).

use lexibus_codegen::facts::pdo;
use lexibus_codegen::ir::{Direction, Group, Value};
use lexibus_codegen::number;

use super::finding::{Finding, FindingKind};
use super::session::Run;
use crate::connection::Connection;
use crate::failure::Failure;

/// An entry of a mapping.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
struct Entry {
    index: u16,
    sub_index: u8,
    bits: u8,
}

impl Entry {
    fn of(value: u32) -> Self {
        Self { index: (value >> 16) as u16, sub_index: (value >> 8) as u8, bits: value as u8 }
    }

    fn text(self) -> String {
        format!("{} ({} bits)", number::object(self.index, self.sub_index), self.bits)
    }
}

/// Checks all mappings that the description declares.
pub(super) fn check<C: Connection>(run: &mut Run<'_, C>) -> Result<(), Failure> {
    let description = run.description;
    let groups = description.device().groups.iter();
    for group in groups.filter(|group| group.index().is_some_and(pdo::is_mapping)) {
        check_mapping(run, group)?;
    }
    Ok(())
}

fn check_mapping<C: Connection>(run: &mut Run<'_, C>, group: &Group) -> Result<(), Failure> {
    let index = group.index().unwrap_or_default();
    let Some(actual) = read(run, index)? else { return Ok(()) };
    let Some(count) = run.description.object(index, 0) else { return Ok(()) };
    match declared(group) {
        Some(declared) if declared == actual => return Ok(()),
        Some(declared) => {
            let finding = Finding::of(&count, FindingKind::Different, "PDO mapping");
            run.add(finding.compared(text(&declared), text(&actual)));
            return Ok(());
        }
        None => {}
    }
    for entry in actual {
        if let Some(message) = wrong_entry(run, index, entry) {
            run.add(Finding::of(&count, FindingKind::Different, message));
        }
    }
    Ok(())
}

/// Reads a mapping. Returns `None` if a part of the mapping cannot or must not be read, or has a wrong length. Also returns
/// `None` if the number of entries is above the maximum.
fn read<C: Connection>(run: &mut Run<'_, C>, index: u16) -> Result<Option<Vec<Entry>>, Failure> {
    /// Maximum number of entries. Greater numbers are reserved or select a multiplexed PDO.
    const MAX_ENTRIES: u8 = 64;
    let description = run.description;
    let is_refused =
        |sub_index| description.object(index, sub_index).is_some_and(|entry| entry.read_refusal().is_some());
    if is_refused(0) {
        return Ok(None);
    }
    let count = match run.read_object(index, 0)?.as_deref() {
        Ok(&[count]) if count <= MAX_ENTRIES => count,
        _ => return Ok(None),
    };
    let mut entries = Vec::new();
    for sub_index in 1..=count {
        if is_refused(sub_index) {
            return Ok(None);
        }
        let Ok(bytes) = run.read_object(index, sub_index)? else { return Ok(None) };
        let Ok(bytes) = <[u8; 4]>::try_from(bytes) else { return Ok(None) };
        entries.push(Entry::of(u32::from_le_bytes(bytes)));
    }
    Ok(Some(entries))
}

/// Returns the mapping that the description declares, or `None` if it declares no complete mapping.
fn declared(group: &Group) -> Option<Vec<Entry>> {
    let number = |sub_index: u8| group.sub(sub_index)?.initial().and_then(Value::as_int);
    let count = u8::try_from(number(0)?).ok()?;
    let entry = |sub_index: u8| number(sub_index).and_then(|value| u32::try_from(value).ok()).map(Entry::of);
    (1..=count).map(entry).collect()
}

fn text(entries: &[Entry]) -> String {
    match entries {
        [] => "no entries".to_owned(),
        entries => entries.iter().map(|entry| entry.text()).collect::<Vec<_>>().join(", "),
    }
}

/// Returns the reason why the entry contradicts the description, or `None` if it doesn't.
fn wrong_entry<C>(run: &Run<'_, C>, mapping: u16, entry: Entry) -> Option<String> {
    /// Indices of data types, which dummy entries map (CiA 301 7.4.7).
    const DUMMIES: std::ops::RangeInclusive<u16> = 1..=0x1F;
    if DUMMIES.contains(&entry.index) {
        return None;
    }
    let Some(parameter) = run.description.object(entry.index, entry.sub_index) else {
        return Some(format!("the PDO maps {}, which the description doesn't declare", entry.text()));
    };
    let device = run.description.device();
    let bits = pdo::mapped_bits(parameter.item(), &device.types);
    if bits.is_some_and(|bits| bits != u32::from(entry.bits)) {
        return Some(format!("the PDO maps {}, but the type is {}", entry.text(), parameter.basic()));
    }
    let direction = if mapping < 0x1A00 { Direction::Receive } else { Direction::Transmit };
    let mappable = pdo::mappable(parameter.item(), &pdo::mapped_objects(&device.process_data.pdos));
    let is_possible = if direction == Direction::Receive { mappable.rpdo } else { mappable.tpdo };
    (!is_possible).then(|| format!("the PDO maps {}, which is declared as not mappable", entry.text()))
}
