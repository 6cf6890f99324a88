//! Rows to chapters and spaces; names and addresses that occur twice.

use std::collections::{BTreeMap, HashMap, HashSet};
use std::rc::Rc;

use lexibus_codegen::diagnostics::{codes, Diagnostic, Diagnostics};
use lexibus_codegen::limits::{MAX_DERIVED_ITEMS, ROW_BYTES_PER_ITEM};
use lexibus_codegen::source::Span;
use lexibus_codegen::text::brief;

use super::address::Table;
use super::definitions::Definition;
use super::rows::{Place, Row, Rows};
use super::types::Base;

/// So many lines have to have their index above their number by as much.
const ALIKE: usize = 3;

/// A table of Modbus, as far as the rows tell.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Space {
    pub table: Table,
    /// The number that it counts from.
    pub first: i64,
    /// Whether anything tells that.
    pub is_first_known: bool,
    /// What all its rows have in common.
    pub low_first: bool,
    pub swap: bool,
}

/// Rows that belong together.
#[derive(Debug)]
pub(super) struct Chapter {
    pub title: Rc<str>,
    pub table: Option<Table>,
    pub rows: Vec<Row>,
}

/// A list, in the order in which it is written.
#[derive(Debug)]
pub(super) struct Listing {
    pub spaces: Vec<Space>,
    pub chapters: Vec<Chapter>,
    pub definitions: Vec<Definition>,
    pub no_access: bool,
}

/// Gives every row its table, its own name and its chapter.
pub(super) fn arrange(list: Rows, diagnostics: &mut Diagnostics) -> Listing {
    let Rows { mut rows, definitions, no_access, from_one } = list;
    within_budget(&mut rows, diagnostics);
    let is_classic = is_classic(&rows);
    for row in &mut rows {
        if let Ok(Place::Register { table, address, .. }) = &mut row.place {
            let by_number = || Table::of_number(address.first).filter(|_| is_classic).map(|(table, _)| table);
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
    distinct_places(&mut rows, &spaces, diagnostics);
    distinct_objects(&mut rows, diagnostics);
    objects_agree(&rows, diagnostics);
    distinct_names(&mut rows, diagnostics);
    references(&mut rows, diagnostics);
    Listing { spaces, chapters: chapters(rows), definitions, no_access }
}

/// Rows that stand for more items than a table may are comments: each item is given a name and a place.
fn within_budget(rows: &mut [Row], diagnostics: &mut Diagnostics) {
    let mut left = MAX_DERIVED_ITEMS;
    for row in rows.iter_mut().filter(|row| row.place.is_ok()) {
        let Some(count) = row.count else { continue };
        match left.checked_sub(count as usize * (1 + row.name.len() / ROW_BYTES_PER_ITEM)) {
            Some(rest) => left = rest,
            None => {
                let message = format!("with this row, repeated rows stand for more than {MAX_DERIVED_ITEMS} items");
                let found = Diagnostic::new(&codes::CSV_NO_ROW, row.span, message);
                diagnostics.push(found.label("written down as a comment"));
                row.place = Err("too many items");
            }
        }
    }
}

/// The rows of each chapter, by their tables.
fn chapters(rows: Vec<Row>) -> Vec<Chapter> {
    let mut chapters: Vec<Chapter> = Vec::new();
    // A list may have as many chapters as rows.
    let mut by_title: HashMap<Rc<str>, Vec<usize>> = HashMap::new();
    for row in rows {
        let table = table_of(&row);
        let own = by_title.entry(row.chapter.clone()).or_default();
        // A line that is no row stays beside the one above it.
        match own.iter().rfind(|&&at| chapters[at].table == table || row.place.is_err()) {
            Some(&at) => chapters[at].rows.push(row),
            None => {
                own.push(chapters.len());
                chapters.push(Chapter { title: row.chapter.clone(), table, rows: vec![row] });
            }
        }
    }
    chapters
}

/// Leaves out the part of a register that has no such bits.
fn within_register(row: &mut Row, table: Table, diagnostics: &mut Diagnostics) {
    let last = if table.is_bits() { 0 } else { 15 };
    let is_beyond = |(key, value): &(&'static str, String)| {
        let high = value.trim_matches('"').split('-').next().and_then(|high| high.parse::<u8>().ok());
        *key == "part" && high.is_some_and(|high| high > last)
    };
    if let Some(at) = row.facts.iter().position(is_beyond) {
        let (_, value) = row.facts.remove(at);
        let message = format!("the bits {} are none of one register", value.trim_matches('"'));
        let found = Diagnostic::new(&codes::CSV_UNREADABLE_CELL, row.span, message);
        diagnostics.push(found.label("left out; the rest of the row is kept"));
    }
}

fn table_of(row: &Row) -> Option<Table> {
    match row.place {
        Ok(Place::Register { table, .. }) => table,
        _ => None,
    }
}

/// Whether the first digit of all numbers is that of a table of Modbus.
fn is_classic(rows: &[Row]) -> bool {
    let mut any = false;
    for row in rows {
        let Ok(Place::Register { address, table: None, .. }) = row.place else { continue };
        match Table::of_number(address.first) {
            Some((Table::Holding | Table::Input, _)) => any = true,
            Some(_) if row.ty.base == Base::Bool => {}
            _ => return false,
        }
    }
    any
}

/// What the rows of a table of Modbus have in common.
fn space(table: Table, rows: &[Row], from_one: bool, diagnostics: &mut Diagnostics) -> Space {
    let own = || rows.iter().filter(move |row| table_of(row) == Some(table));
    let numbers = || {
        own().filter_map(
            |row| if let Ok(Place::Register { address, .. }) = row.place { Some(address.first) } else { None },
        )
    };
    let mut bases =
        numbers().map(|number| Table::of_number(number).filter(|(own, _)| *own == table).map(|(_, base)| base));
    // Numbers from 1 on are those of coils by the old rule, and of anything else by a new one.
    let base = bases.next().flatten().filter(|&base| base > 1 && bases.all(|own| own == Some(base)));
    let first = wire(own(), diagnostics).or(base.map(i64::from)).or(from_one.then_some(1));
    // Where all rows say it, the space does; a row that says nothing has the usual order.
    let all = |matter: fn(&Row) -> bool, of: fn(&Row) -> Option<bool>| {
        let mut rows = own().filter(|row| matter(row)).peekable();
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

/// What the numbers of the registers count from, by a second column of addresses.
fn wire<'r>(rows: impl Iterator<Item = &'r Row>, diagnostics: &mut Diagnostics) -> Option<i64> {
    let mut found: Option<(i64, Span)> = None;
    for row in rows {
        let Ok(Place::Register { address, wire: Some(wire), .. }) = row.place else { continue };
        let difference = i64::from(address.first) - i64::from(wire);
        match found {
            None => found = Some((difference, row.span)),
            Some((first, _)) if first == difference => {}
            Some((first, span)) => {
                let message = format!("the two addresses are {difference} apart, and {first} in the rows above");
                let diagnostic = Diagnostic::new(&codes::CSV_UNREADABLE_CELL, row.span, message);
                diagnostics.push(diagnostic.label("the first address is used").note_at(span, "the first row"));
            }
        }
    }
    // An address on the wire that is greater than the number can't be subtracted from it: `first` may be negative.
    found.map(|(difference, _)| difference)
}

/// Of a list whose indices are its numbers and something, reports those that aren't: a digit was misprinted.
fn objects_agree(rows: &[Row], diagnostics: &mut Diagnostics) {
    let both = |row: &Row| match row.place {
        Ok(Place::Register { address, object: Some((index, _)), .. }) => Some((address.first, index)),
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
            let message =
                format!("the index is 0x{index:04X}, and by {count} of {all} lines it would be 0x{expected:04X}");
            let diagnostic = Diagnostic::new(&codes::CSV_UNREADABLE_CELL, row.span, message);
            diagnostics.push(diagnostic.label("kept as it is: write a doubt down"));
        }
    }
}

/// The addresses that a row takes, as texts that differ where the addresses do.
fn places(row: &Row) -> Vec<String> {
    let count = row.count.unwrap_or(1);
    let stride = row.ty.size().unwrap_or(16).div_ceil(16).max(1);
    let all = |text: &dyn Fn(u32) -> String| (0..count).map(text).collect();
    match row.place {
        Ok(Place::Register { address, table: Some(table), .. }) => {
            let step = if table.is_bits() { 1 } else { stride };
            all(&|number| format!("{} {}", table.name(), address.first.saturating_add(number * step)))
        }
        Ok(Place::Object { index, sub }) => {
            all(&|number| format!("{} {}", u32::from(index) + number, sub.unwrap_or(0)))
        }
        Ok(Place::Parameter(code)) => all(&|number| format!("parameter {}", code.saturating_add(number))),
        _ => Vec::new(),
    }
}

/// Rows that can't be, because their address has none on the bus or is taken, become comments.
fn distinct_places(rows: &mut [Row], spaces: &[Space], diagnostics: &mut Diagnostics) {
    let mut taken: HashMap<String, Span> = HashMap::new();
    for row in rows {
        if let Some(reason) = no_address(row, spaces) {
            let message = format!("{reason}: it has 65536 at most");
            diagnostics.push(Diagnostic::new(&codes::CSV_NO_ROW, row.span, message).label("written down as a comment"));
            row.place = Err("no such address");
            continue;
        }
        // Parts of a register share it.
        if row.facts.iter().any(|(key, _)| *key == "part") {
            continue;
        }
        let own = places(row);
        match own.iter().find_map(|place| taken.get(place)) {
            Some(&first) => {
                let message = "another row has this address";
                let diagnostic = Diagnostic::new(&codes::CSV_NO_ROW, row.span, message);
                diagnostics.push(diagnostic.label("written down as a comment").note_at(first, "the first is here"));
                row.place = Err("the address is taken");
            }
            None => taken.extend(own.into_iter().map(|place| (place, row.span))),
        }
    }
}

/// Takes the object from a register that is none: a part of one, one of several, or one whose object another row has.
fn distinct_objects(rows: &mut [Row], diagnostics: &mut Diagnostics) {
    let of_objects = rows.iter().filter(|row| matches!(row.place, Ok(Place::Object { .. })));
    let mut taken: HashMap<String, Span> =
        of_objects.flat_map(|row| places(row).into_iter().map(|place| (place, row.span))).collect();
    for row in rows {
        let is_part = row.facts.iter().any(|(key, _)| *key == "part");
        let Ok(Place::Register { object: own @ Some(_), .. }) = &mut row.place else { continue };
        let (index, sub) = own.unwrap_or_default();
        let place = format!("{index} {}", sub.unwrap_or(0));
        let problem = match taken.get(&place) {
            _ if is_part => Some(("a part of a register is no object", None)),
            _ if row.count.is_some() => Some(("several registers are not one object", None)),
            Some(&first) => Some(("another row has this object", Some(first))),
            None => None,
        };
        let Some((message, first)) = problem else {
            taken.insert(place, row.span);
            continue;
        };
        *own = None;
        let found = Diagnostic::new(&codes::CSV_UNREADABLE_CELL, row.span, message).label("the object is left out");
        diagnostics.push(match first {
            Some(first) => found.note_at(first, "the first is here"),
            None => found,
        });
    }
}

/// Why a register can't be reached.
fn no_address(row: &Row, spaces: &[Space]) -> Option<&'static str> {
    let count = i64::from(row.count.unwrap_or(1)) - 1;
    match row.place {
        Ok(Place::Register { address, table, .. }) => {
            let space = spaces.iter().find(|space| Some(space.table) == table)?;
            let stride = i64::from(row.ty.size().unwrap_or(16).div_ceil(16).max(1));
            let first = i64::from(address.first) - space.first;
            let is_there = first >= 0 && first + count * stride <= 0xFFFF;
            (!is_there).then_some("the number has no address on Modbus")
        }
        Ok(Place::Object { index, .. }) if i64::from(index) + count > 0xFFFF => {
            Some("the index is beyond the dictionary")
        }
        _ => None,
    }
}

/// Gives rows of the same name a number.
fn distinct_names(rows: &mut [Row], diagnostics: &mut Diagnostics) {
    let mut taken: HashMap<String, Span> = HashMap::new();
    // The next number behind a name.
    let mut numbers: HashMap<String, u32> = HashMap::new();
    // Names of repeated rows that may be tried.
    let mut left = MAX_DERIVED_ITEMS;
    for row in rows.iter_mut().filter(|row| row.place.is_ok()) {
        if row.count.is_some() {
            row.name += " {n+1}";
        }
        let own = row.name.clone();
        let number = numbers.entry(own.clone()).or_insert(2);
        let mut first = None;
        let place = |row: &Row| names(row).find_map(|name| taken.get(&name).copied());
        while let Some(span) = place(row) {
            first = first.or(Some(span));
            match left.checked_sub(row.count.unwrap_or(0) as usize) {
                Some(rest) => left = rest,
                None => {
                    row.place = Err("its names are taken");
                    break;
                }
            }
            row.name = format!("{own} {number}");
            *number += 1;
        }
        if let Some(first) = first {
            let message = format!("`{}` is the name of another row", brief(&own));
            if row.place.is_err() {
                let diagnostic = Diagnostic::new(&codes::CSV_NO_ROW, row.span, message);
                diagnostics.push(diagnostic.label("written down as a comment").note_at(first, "the first is here"));
                continue;
            }
            let diagnostic = Diagnostic::new(&codes::CSV_SAME_NAME, row.span, message);
            diagnostics.push(diagnostic.label(format!("called `{}`", row.name)).note_at(first, "the first is here"));
        }
        taken.extend(names(row).map(|name| (name, row.span)));
    }
}

/// The names of the items of a row.
fn names(row: &Row) -> impl Iterator<Item = String> + '_ {
    let count = row.count.unwrap_or(1);
    (1..=count).map(|number| row.name.replace("{n+1}", &number.to_string()))
}

/// A factor that another row holds needs that row.
fn references(rows: &mut [Row], diagnostics: &mut Diagnostics) {
    let kept: HashSet<String> = rows.iter().filter(|row| row.place.is_ok()).map(|row| row.name.clone()).collect();
    for row in rows {
        let Some(reference) = row.scale.take_if(|own| !kept.contains(&own.name)) else { continue };
        let message = format!("`{}` is no row of the table", brief(&reference.name));
        let diagnostic = Diagnostic::new(&codes::CSV_UNREADABLE_CELL, reference.span, message);
        diagnostics.push(diagnostic.label("left out; the rest of the row is kept"));
    }
}
