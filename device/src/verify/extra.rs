//! Search for objects that the description doesn't declare.

use std::collections::BTreeSet;

use lexibus_codegen::facts::pdo;
use lexibus_codegen::ir::{Group, Value};

use super::finding::{Finding, FindingKind, Found};
use super::session::Run;
use crate::connection::Connection;
use crate::failure::Failure;

/// Indices of the general communication objects of CiA 301. Reading these objects doesn't change them.
const STANDARD: std::ops::RangeInclusive<u16> = 0x1000..=0x1029;

/// First indices of the lists of PDO parameters and PDO mappings.
const LISTS: [u16; 4] = [0x1400, 0x1600, 0x1800, 0x1A00];
/// Number of consecutive missing objects after which the search of a list ends.
const GAP: u16 = 4;
/// Maximum number of objects in a list.
const LIST_LENGTH: u16 = 0x200;

/// Searches for objects and sub-indices that the description doesn't declare, and checks the number of entries of the declared
/// objects.
pub(super) fn check<C: Connection>(run: &mut Run<'_, C>) -> Result<(), Failure> {
    let groups = run.description.device().groups.iter();
    let declared: BTreeSet<u16> = groups.filter_map(|group| group.index()).collect();
    for index in STANDARD.filter(|index| !declared.contains(index)) {
        check_object(run, index)?;
    }
    for first in LISTS {
        check_list(run, first, &declared)?;
    }
    for range in run.options.search.clone() {
        for index in range.filter(|index| !declared.contains(index) && !STANDARD.contains(index)) {
            check_object(run, index)?;
        }
    }
    check_entries(run)
}

fn check_list<C: Connection>(run: &mut Run<'_, C>, first: u16, declared: &BTreeSet<u16>) -> Result<(), Failure> {
    let mut missing = 0;
    for index in first..first + LIST_LENGTH {
        missing = match declared.contains(&index) || check_object(run, index)? {
            true => 0,
            false => missing + 1,
        };
        if missing == GAP {
            break;
        }
    }
    Ok(())
}

/// Reads sub-index 0 of an undeclared object, and reports the object if it exists. Returns whether it exists; `false` after a timeout.
fn check_object<C: Connection>(run: &mut Run<'_, C>, index: u16) -> Result<bool, Failure> {
    check_entry(run, index, 0, "the description doesn't declare this object")
}

fn check_entry<C: Connection>(run: &mut Run<'_, C>, index: u16, sub: u8, message: &str) -> Result<bool, Failure> {
    let finding = Finding::of_object(index, sub, message);
    match run.read_object(index, sub)? {
        Ok(bytes) => run.add(finding.found(Found::Object(Some(bytes.len())))),
        Err(failure) if failure.is_missing() || !failure.is_refusal() => return Ok(false),
        Err(failure) => run.add(finding.failed(&failure).found(Found::Object(None))),
    }
    Ok(true)
}

/// Checks the number of entries of the declared objects with sub-indices. Skips missing objects. Also skips the error history and
/// mappings, because their number of entries changes.
fn check_entries<C: Connection>(run: &mut Run<'_, C>) -> Result<(), Failure> {
    let description = run.description;
    for group in &description.device().groups {
        let has_entries = group.object_code().is_some_and(lexibus_codegen::ir::ObjectCode::has_subs);
        let Some(index) = group.index().filter(|index| has_entries && *index != 0x1003 && !pdo::is_mapping(*index))
        else {
            continue;
        };
        if !run.missing.contains(&index) {
            check_count(run, group, index)?;
        }
    }
    Ok(())
}

/// Searches for entries above the highest declared sub-index. If there are none, compares the number of entries with the
/// description, unless this number is writable.
fn check_count<C: Connection>(run: &mut Run<'_, C>, group: &Group, index: u16) -> Result<(), Failure> {
    /// Sub-index of the structure of an object (CiA 301 7.4.5). It isn't an entry.
    const STRUCTURE: u8 = 0xFF;
    let description = run.description;
    let Some(parameter) = description.object(index, 0).filter(|count| count.read_refusal().is_none()) else {
        return Ok(());
    };
    let count = match run.read_object(index, 0)?.as_deref() {
        Ok(&[count]) => count,
        _ => return Ok(()),
    };
    let highest = group.items.iter().filter_map(|item| item.object()).map(|(_, sub)| sub).max().unwrap_or(0);
    let mut has_extra = false;
    for sub_index in highest.saturating_add(1)..=count.min(STRUCTURE - 1) {
        has_extra |= check_entry(run, index, sub_index, "the description doesn't declare this sub-index")?;
    }
    let fits = |value: &&Value| parameter.encode(value, None).is_some();
    let declared = parameter.default().filter(|_| !parameter.access().writable()).filter(fits);
    let actual = Value::Int(count.into());
    if let Some(declared) = declared.filter(|declared| !has_extra && **declared != actual) {
        let finding = Finding::of(&parameter, FindingKind::Different, "number of entries");
        run.add(finding.compared(parameter.text(declared), parameter.text(&actual)));
    }
    Ok(())
}
