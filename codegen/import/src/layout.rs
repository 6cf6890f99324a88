//! Groups the rows by chapter and Modbus table, makes repeated names unique, and converts rows with repeated addresses to
//! comments.

use std::collections::{BTreeMap, HashMap, HashSet};
use std::rc::Rc;

use lexibus_codegen::diagnostics::{codes, Diagnostic, Diagnostics};
use lexibus_codegen::limits::{MAX_DERIVED_ITEMS, ROW_BYTES_PER_ITEM};
use lexibus_codegen::number::hex16;
use lexibus_codegen::source::Span;
use lexibus_codegen::text::brief;

use super::address::Table;
use super::definitions::Definition;
use super::rows::{Row, RowAddress, Rows};
use super::types::Base;

/// Number of rows that must have the same difference between object index and register address before the import
/// reports other differences.
const ALIKE: usize = 3;

/// A Modbus table, with the base address and the order of words and bytes that all its rows share.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Space {
    pub table: Table,
    /// Printed address that corresponds to wire address 0.
    pub first: i64,
    /// True if the list determines the value of `first`. Otherwise, `first` is 0.
    pub is_first_known: bool,
    /// True if all values of more than 16 bits have the low word first.
    pub low_first: bool,
    /// True if all rows except Boolean ones have swapped bytes.
    pub swap: bool,
}

/// The rows of a chapter that belong to the same Modbus table.
#[derive(Debug)]
pub(super) struct Chapter {
    pub title: Rc<str>,
    pub table: Option<Table>,
    pub rows: Vec<Row>,
}

/// The content of the register table in output order.
#[derive(Debug)]
pub(super) struct Listing {
    pub spaces: Vec<Space>,
    pub chapters: Vec<Chapter>,
    pub definitions: Vec<Definition>,
    pub no_access: bool,
}

/// Assigns a Modbus table to each register, and a unique name and a chapter to each row.
pub(super) fn arrange(list: Rows, diagnostics: &mut Diagnostics) -> Listing {
    let Rows { mut rows, definitions, no_access, from_one } = list;
    within_budget(&mut rows, diagnostics);
    let is_classic = is_classic(&rows);
    for row in &mut rows {
        if let Ok(RowAddress::Register { table, printed, .. }) = &mut row.address {
            let by_number = || Table::of_number(printed.first).filter(|_| is_classic).map(|(table, _)| table);
            let found = table.or_else(by_number).unwrap_or(Table::Holding);
            *table = Some(found);
            row.access = row.access.or(found.is_read_only().then_some("ro"));
            within_register(row, found, diagnostics);
        }
    }
    let mut spaces: Vec<Space> = Vec::new();
    for table in rows.iter().filter_map(table_of) {
        if !spaces.iter().any(|space| space.table == table) {
            spaces.push(space(table, &rows, from_one, diagnostics));
        }
    }
    distinct_addresses(&mut rows, &spaces, diagnostics);
    distinct_objects(&mut rows, diagnostics);
    objects_agree(&rows, diagnostics);
    distinct_names(&mut rows, diagnostics);
    references(&mut rows, diagnostics);
    Listing { spaces, chapters: chapters(rows), definitions, no_access }
}

/// Converts a row with a repetition count to a comment if the repeated rows up to this one describe more than
/// `MAX_DERIVED_ITEMS` items. Items with long names count several times.
fn within_budget(rows: &mut [Row], diagnostics: &mut Diagnostics) {
    let mut left = MAX_DERIVED_ITEMS;
    for row in rows.iter_mut().filter(|row| row.address.is_ok()) {
        let Some(count) = row.count else { continue };
        match left.checked_sub(count as usize * (1 + row.name.len() / ROW_BYTES_PER_ITEM)) {
            Some(rest) => left = rest,
            None => {
                let message = format!("the repeated rows up to this one describe more than {MAX_DERIVED_ITEMS} items");
                let found = Diagnostic::new(&codes::CSV_NO_ROW, row.span, message);
                diagnostics.push(found.label("kept as a comment"));
                row.address = Err("too many items");
            }
        }
    }
}

/// Groups rows by chapter and Modbus table.
fn chapters(rows: Vec<Row>) -> Vec<Chapter> {
    let mut chapters: Vec<Chapter> = Vec::new();
    // Use a map because there may be as many chapters as rows.
    let mut by_title: HashMap<Rc<str>, Vec<usize>> = HashMap::new();
    for row in rows {
        let table = table_of(&row);
        let same_title = by_title.entry(row.chapter.clone()).or_default();
        // A line that could not become a row is added to the last group with the same chapter title.
        match same_title.iter().rfind(|&&at| chapters[at].table == table || row.address.is_err()) {
            Some(&at) => chapters[at].rows.push(row),
            None => {
                same_title.push(chapters.len());
                chapters.push(Chapter { title: row.chapter.clone(), table, rows: vec![row] });
            }
        }
    }
    chapters
}

/// Removes and reports the bit range of a row if the range exceeds the register.
fn within_register(row: &mut Row, table: Table, diagnostics: &mut Diagnostics) {
    let last = if table.is_bits() { 0 } else { 15 };
    let is_beyond = |(key, value): &(&'static str, String)| {
        let high = value.trim_matches('"').split('-').next().and_then(|high| high.parse::<u8>().ok());
        *key == "part" && high.is_some_and(|high| high > last)
    };
    if let Some(at) = row.facts.iter().position(is_beyond) {
        let (_, value) = row.facts.remove(at);
        let message = format!("the bits {} are outside of the register", value.trim_matches('"'));
        let found = Diagnostic::new(&codes::CSV_UNREADABLE_CELL, row.span, message);
        diagnostics.push(found.label("left out; the rest of the row is kept"));
    }
}

fn table_of(row: &Row) -> Option<Table> {
    match row.address {
        Ok(RowAddress::Register { table, .. }) => table,
        _ => None,
    }
}

/// Returns whether the first digit of each printed address identifies a Modbus table. Only rows without a stated Modbus
/// table count. Each address must be in the range of a Modbus table, and at least one address in that of the holding or
/// input registers. Addresses in the ranges of the coils and discrete inputs must belong to Boolean rows.
fn is_classic(rows: &[Row]) -> bool {
    let mut any = false;
    for row in rows {
        let Ok(RowAddress::Register { printed, table: None, .. }) = row.address else { continue };
        match Table::of_number(printed.first) {
            Some((Table::Holding | Table::Input, _)) => any = true,
            Some(_) if row.ty.base == Base::Bool => {}
            _ => return false,
        }
    }
    any
}

/// Determines the base address and the order of words and bytes that all rows of a Modbus table share.
fn space(table: Table, rows: &[Row], from_one: bool, diagnostics: &mut Diagnostics) -> Space {
    let in_table = || rows.iter().filter(move |row| table_of(row) == Some(table));
    let numbers = || {
        in_table().filter_map(|row| match row.address {
            Ok(RowAddress::Register { printed, .. }) => Some(printed.first),
            _ => None,
        })
    };
    let mut bases =
        numbers().map(|number| Table::of_number(number).filter(|(found, _)| *found == table).map(|(_, base)| base));
    // Ignore base 1, which is that of the coils: small addresses do not show whether the list counts from 0 or from 1.
    let base = bases.next().flatten().filter(|&base| base > 1 && bases.all(|other| other == Some(base)));
    let first = wire(in_table(), diagnostics).or(base.map(i64::from)).or(from_one.then_some(1));
    // Set `low_first` or `swap` for the whole Modbus table only if all rows state it. A row that states no order has the
    // default order.
    let all = |matter: fn(&Row) -> bool, of: fn(&Row) -> Option<bool>| {
        let mut rows = in_table().filter(|row| matter(row)).peekable();
        rows.peek().is_some() && rows.all(|row| of(row) == Some(true))
    };
    Space {
        table,
        first: first.unwrap_or(0),
        is_first_known: first.is_some(),
        low_first: all(|row| row.ty.size().is_none_or(|bits| bits > 16), |row| row.order.low_first),
        swap: all(|row| row.ty.base != Base::Bool, |row| row.order.swap),
    }
}

/// Returns the printed address that corresponds to wire address 0. The address is calculated from the column of wire
/// addresses.
fn wire<'r>(rows: impl Iterator<Item = &'r Row>, diagnostics: &mut Diagnostics) -> Option<i64> {
    let mut found: Option<(i64, Span)> = None;
    for row in rows {
        let Ok(RowAddress::Register { printed, wire: Some(wire), .. }) = row.address else { continue };
        let difference = i64::from(printed.first) - i64::from(wire);
        match found {
            None => found = Some((difference, row.span)),
            Some((first, _)) if first == difference => {}
            Some((first, span)) => {
                let message = format!("the two addresses differ by {difference}, but by {first} in the rows above");
                let diagnostic = Diagnostic::new(&codes::CSV_UNREADABLE_CELL, row.span, message);
                diagnostics
                    .push(diagnostic.label("the first address is used").note_at(span, "first row with both addresses"));
            }
        }
    }
    // The result is negative if the wire address is greater than the printed address.
    found.map(|(difference, _)| difference)
}

/// Reports object indices whose distance from the register address is unusual. Indices with an unusual distance are probably
/// misprints.
fn objects_agree(rows: &[Row], diagnostics: &mut Diagnostics) {
    let both = |row: &Row| match row.address {
        Ok(RowAddress::Register { printed, object: Some((index, _)), .. }) => Some((printed.first, index)),
        _ => None,
    };
    let mut counts: BTreeMap<i64, usize> = BTreeMap::new();
    for (number, index) in rows.iter().filter_map(both) {
        *counts.entry(i64::from(index) - i64::from(number)).or_default() += 1;
    }
    let all: usize = counts.values().sum();
    let Some((&first, &count)) = counts.iter().max_by_key(|(_, count)| **count) else { return };
    if count < ALIKE || count * 4 < all * 3 {
        return;
    }
    for (row, (number, index)) in rows.iter().filter_map(|row| Some((row, both(row)?))) {
        let expected = i64::from(number) + first;
        if i64::from(index) != expected && expected >= 0 {
            let (index, expected) = (hex16(index), hex16(expected));
            let message = format!("the index is {index}, but {count} of {all} lines suggest {expected}");
            let diagnostic = Diagnostic::new(&codes::CSV_UNREADABLE_CELL, row.span, message);
            let help = "check the manual, and describe the ambiguity with the key `doubt`";
            diagnostics.push(diagnostic.label("kept as written").help(help));
        }
    }
}

/// For each item of a row, returns a text that identifies the first address of the item.
fn addresses(row: &Row) -> Vec<String> {
    let count = row.count.unwrap_or(1);
    let stride = row.ty.size().unwrap_or(16).div_ceil(16).max(1);
    let all = |text: &dyn Fn(u32) -> String| (0..count).map(text).collect();
    match row.address {
        Ok(RowAddress::Register { printed, table: Some(table), .. }) => {
            let step = if table.is_bits() { 1 } else { stride };
            all(&|number| format!("{} {}", table.name(), printed.first.saturating_add(number * step)))
        }
        Ok(RowAddress::Object { index, sub }) => {
            all(&|number| format!("{} {}", u32::from(index) + number, sub.unwrap_or(0)))
        }
        Ok(RowAddress::Parameter(code)) => all(&|number| format!("parameter {}", code.saturating_add(number))),
        _ => Vec::new(),
    }
}

/// Converts a row to a comment if its address does not exist on the bus or belongs to another row.
fn distinct_addresses(rows: &mut [Row], spaces: &[Space], diagnostics: &mut Diagnostics) {
    let mut used: HashMap<String, Span> = HashMap::new();
    for row in rows {
        if let Some(message) = no_address(row, spaces) {
            diagnostics.push(Diagnostic::new(&codes::CSV_NO_ROW, row.span, message).label("kept as a comment"));
            row.address = Err("no such address");
            continue;
        }
        // Several parts of a register may share its address.
        if row.facts.iter().any(|(key, _)| *key == "part") {
            continue;
        }
        let occupied = addresses(row);
        match occupied.iter().find_map(|address| used.get(address)) {
            Some(&first) => {
                let message = "another row has this address";
                let diagnostic = Diagnostic::new(&codes::CSV_NO_ROW, row.span, message);
                diagnostics.push(diagnostic.label("kept as a comment").note_at(first, "first row with this address"));
                row.address = Err("the address is used twice");
            }
            None => used.extend(occupied.into_iter().map(|address| (address, row.span))),
        }
    }
}

/// Removes the object address of a row if the row is a part of a register, is repeated, or has another row's object
/// address.
fn distinct_objects(rows: &mut [Row], diagnostics: &mut Diagnostics) {
    let of_objects = rows.iter().filter(|row| matches!(row.address, Ok(RowAddress::Object { .. })));
    let mut used: HashMap<String, Span> =
        of_objects.flat_map(|row| addresses(row).into_iter().map(|address| (address, row.span))).collect();
    for row in rows {
        let is_part = row.facts.iter().any(|(key, _)| *key == "part");
        let Ok(RowAddress::Register { object: object @ Some(_), .. }) = &mut row.address else { continue };
        let (index, sub) = object.unwrap_or_default();
        let address = format!("{index} {}", sub.unwrap_or(0));
        let problem = match used.get(&address) {
            _ if is_part => Some(("a part of a register cannot be an object", None)),
            _ if row.count.is_some() => Some(("several registers cannot be one object", None)),
            Some(&first) => Some(("another row has this object", Some(first))),
            None => None,
        };
        let Some((message, first)) = problem else {
            used.insert(address, row.span);
            continue;
        };
        *object = None;
        let found = Diagnostic::new(&codes::CSV_UNREADABLE_CELL, row.span, message).label("the object is left out");
        diagnostics.push(match first {
            Some(first) => found.note_at(first, "first row with this object"),
            None => found,
        });
    }
}

/// Returns the reason why the address of a row does not exist on its bus.
fn no_address(row: &Row, spaces: &[Space]) -> Option<&'static str> {
    let count = i64::from(row.count.unwrap_or(1)) - 1;
    match row.address {
        Ok(RowAddress::Register { printed, table, .. }) => {
            let space = spaces.iter().find(|space| Some(space.table) == table)?;
            let stride = i64::from(row.ty.size().unwrap_or(16).div_ceil(16).max(1));
            let first = i64::from(printed.first) - space.first;
            let exists = first >= 0 && first + count * stride <= 0xFFFF;
            (!exists).then_some("the register is outside of the 65,536 wire addresses of Modbus")
        }
        Ok(RowAddress::Object { index, .. }) if i64::from(index) + count > 0xFFFF => Some("the index exceeds 0xFFFF"),
        _ => None,
    }
}

/// Makes repeated names unique by appending numbers.
fn distinct_names(rows: &mut [Row], diagnostics: &mut Diagnostics) {
    let mut used: HashMap<String, Span> = HashMap::new();
    // Next number to append to each repeated name.
    let mut numbers: HashMap<String, u32> = HashMap::new();
    // Limit the number of names that are tried, because many repeated rows could otherwise take too long.
    let mut left = MAX_DERIVED_ITEMS;
    for row in rows.iter_mut().filter(|row| row.address.is_ok()) {
        if row.count.is_some() {
            row.name += " {n+1}";
        }
        let base = row.name.clone();
        let number = numbers.entry(base.clone()).or_insert(2);
        let mut first = None;
        let earlier = |row: &Row| names(row).find_map(|name| used.get(&name).copied());
        while let Some(span) = earlier(row) {
            first = first.or(Some(span));
            match left.checked_sub(row.count.unwrap_or(0) as usize) {
                Some(rest) => left = rest,
                None => {
                    row.address = Err("its names are already used");
                    break;
                }
            }
            row.name = format!("{base} {number}");
            *number += 1;
        }
        if let Some(first) = first {
            let message = format!("another row has the name `{}`", brief(&base));
            if row.address.is_err() {
                let diagnostic = Diagnostic::new(&codes::CSV_NO_ROW, row.span, message);
                diagnostics.push(diagnostic.label("kept as a comment").note_at(first, "first row with this name"));
                continue;
            }
            let diagnostic = Diagnostic::new(&codes::CSV_SAME_NAME, row.span, message);
            let label = format!("renamed to `{}`", row.name);
            diagnostics.push(diagnostic.label(label).note_at(first, "first row with this name"));
        }
        used.extend(names(row).map(|name| (name, row.span)));
    }
}

/// Returns the item names of a row. A repeated row has several items.
fn names(row: &Row) -> impl Iterator<Item = String> + '_ {
    let count = row.count.unwrap_or(1);
    (1..=count).map(|number| row.name.replace("{n+1}", &number.to_string()))
}

/// Removes references to scale-factor rows that do not exist.
fn references(rows: &mut [Row], diagnostics: &mut Diagnostics) {
    let kept: HashSet<String> = rows.iter().filter(|row| row.address.is_ok()).map(|row| row.name.clone()).collect();
    for row in rows {
        let Some(reference) = row.scale.take_if(|reference| !kept.contains(&reference.name)) else { continue };
        let message = format!("`{}` is not a row of the table", brief(&reference.name));
        let diagnostic = Diagnostic::new(&codes::CSV_UNREADABLE_CELL, reference.span, message);
        diagnostics.push(diagnostic.label("left out; the rest of the row is kept"));
    }
}
