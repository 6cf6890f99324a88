//! Tests each client with each fault. Prints a table with the result and duration of the request, and the duration of
//! the next request.

use std::fmt::{Debug, Write as _};
use std::time::Duration;

use lexibus::Error;

use crate::{boot, can, guarding, heartbeat, lss, modbus_rows, serial};

/// Results of a request with a fault, and of the next request, which has no fault. The code that creates a row checks the values.
pub struct Row {
    pub client: &'static str,
    pub is_async: bool,
    pub fault: &'static str,
    pub result: &'static str,
    pub time: Duration,
    /// Duration of the next request, which returned the right value.
    pub next: Duration,
    /// Timeout of the client.
    pub timeout: Duration,
}

/// Returns the text that the table shows for a result. The caller has already checked the value.
pub fn name<T, E: Debug>(result: &Result<T, Error<E>>) -> &'static str {
    match result {
        Ok(_) => "right value",
        Err(Error::Timeout) => "`Timeout`",
        Err(Error::UnexpectedReply) => "`UnexpectedReply`",
        Err(Error::Client(_)) => "`Client`",
        Err(Error::Length(_)) => "`Length`",
        Err(Error::Abort(_)) => "`Abort`",
        Err(other) => panic!("an error without a name in the table: {other:?}"),
    }
}

/// Names of the faults in the tables of the book. Some names are only the start of a cell.
const BOOK_NAMES: [(&str, &str); 11] = [
    ("late", "reply too late"),
    ("lost", "reply lost"),
    ("lost datagram", "reply lost"),
    ("duplicated", "reply repeated"),
    ("truncated", "reply truncated"),
    ("foreign", "reply to another request"),
    ("noise", "noise"),
    ("wrong toggle", "wrong toggle bit"),
    ("restart", "restart"),
    ("bus-off", "bus-off"),
    ("error frame", "error frame"),
];

/// Returns the result that the tables of the book contain for this client and fault. Returns `None` if no table contains both.
/// Panics if no table contains the fault.
fn book_result(row: &Row) -> Option<&'static str> {
    const BOOK: &str = include_str!("../../docs/src/buses.md");
    let (_, name) = BOOK_NAMES.into_iter().find(|(name, _)| *name == row.fault).expect("a fault of the book");
    let (mut column, mut is_known) = (None, false);
    for line in BOOK.lines() {
        let mut cells = line.trim_matches('|').split('|').map(str::trim);
        match cells.clone().next() {
            Some("fault") => column = cells.position(|cell| cell.contains(row.client)),
            Some(fault) if line.starts_with('|') && fault.starts_with(name) => match column {
                Some(column) => return cells.nth(column),
                None => is_known = true,
            },
            _ => {}
        }
    }
    assert!(is_known, "the book has no fault {name:?}");
    None
}

/// Returns whether the tables of the book contain a result for the row. Panics if this result differs from that of the row.
fn check_book(row: &Row) -> bool {
    let is_right = book_result(row).map(|cell| match (cell, row.result) {
        // "ignored" in the book means that the client waits for the right reply, which may be missing.
        ("ignored", result) => ["right value", "`Timeout`"].contains(&result),
        (cell, result) => cell.contains(result),
    });
    assert!(is_right != Some(false), "the book: {} {}: {}", row.client, row.fault, row.result);
    is_right.is_some()
}

#[test]
fn matrix() {
    #[cfg(all(feature = "ethercat", feature = "macros"))]
    let ethercat = crate::coe::rows();
    #[cfg(not(all(feature = "ethercat", feature = "macros")))]
    let ethercat = Vec::new();
    let canopen =
        [can::rows(), can::pdo::rows(), heartbeat::rows(), lss::rows(), guarding::rows(), boot::rows()].into_iter();
    let rows: Vec<Row> = canopen.chain([ethercat, modbus_rows::rows(), serial::rows()]).flatten().collect();
    let mut table = "| client | | fault | result | time | next request |\n|---|---|---|---|---|---|\n".to_string();
    for row in &rows {
        let mode = if row.is_async { "async" } else { "blocking" };
        let times = |time: Duration| format!("{:.1} timeouts", time.as_secs_f64() / row.timeout.as_secs_f64());
        let (time, next) = (times(row.time), times(row.next));
        writeln!(table, "| {} | {mode} | {} | {} | {time} | right value, {next} |", row.client, row.fault, row.result)
            .expect("a string");
    }
    println!("{table}");
    for row in &rows {
        // Tolerance for the resolution of `tokio` timers.
        let soon = Duration::from_millis(5);
        assert!(row.time <= 2 * row.timeout + soon, "{} {}: {:?}", row.client, row.fault, row.time);
        assert!(row.next <= 4 * row.timeout + soon, "{} {}: {:?}", row.client, row.fault, row.next);
    }
    let in_book = rows.iter().filter(|row| check_book(row)).count();
    // The table has rows for each client with each fault, both blocking and asynchronous. LSS, boot, SDO writes, block reads, block
    // writes, PDO and heartbeat have nine faults. SDO reads and node guarding have a tenth fault, the wrong toggle bit. Serial has
    // six faults. The client for EtherCAT is only asynchronous, and has seven faults.
    let ethercat = if cfg!(all(feature = "ethercat", feature = "macros")) { 7 } else { 0 };
    assert_eq!(rows.len(), (7 * 9 + 2 * 10 + 6) * 2 + modbus_rows::COUNT_OF_ROWS + ethercat);
    // In the tables of the book, SDO reads have ten faults. SDO writes, block reads, block writes, PDO and heartbeat have nine;
    // Modbus RTU, Modbus TCP and serial have six; LSS and boot have three; node guarding has four; EtherCAT has seven.
    assert_eq!(in_book, (10 + 5 * 9 + 3 * 6 + 2 * 3 + 4) * 2 + ethercat);
}
