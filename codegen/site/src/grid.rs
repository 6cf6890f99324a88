//! Byte grids of cyclic data: rows of up to four bytes. A byte that several entries share, or that is only partly used,
//! has two rows of four bits, so that each name has space on a phone, too. The script of the PDO builder makes the same
//! rows.

use lexibus_codegen::facts::address;
use lexibus_codegen::ir::{PdoEntry, PdoEntryKind};

/// Number of columns of a grid.
const COLUMNS: u32 = 4;

/// Number of bits in a row of bytes.
const ROW: u32 = COLUMNS * 8;

/// Maximum number of rows in a grid. Longer data are cut off, but the list below the grid contains all entries.
const MOST_ROWS: usize = 128;

/// Maximum number of bits in a grid. The process data of real devices are shorter.
const MOST_BITS: u32 = 1 << 24;

/// A row of bytes or bits.
#[derive(Debug, PartialEq, Eq)]
pub(super) struct Row {
    /// Position, such as `bytes 0–3` or `byte 4 bits 7–4`.
    pub position: String,
    /// Cells from left to right: bytes in ascending order, or bits in descending order.
    pub cells: Vec<Cell>,
}

/// A cell of a row.
#[derive(Debug, PartialEq, Eq)]
pub(super) struct Cell {
    /// Number of columns.
    pub columns: u32,
    /// Position of the entry in the list of entries; `None` if the bits are unused.
    pub entry: Option<usize>,
}

/// Consecutive bits of one entry, or unused bits.
#[derive(Clone, Copy)]
struct Piece {
    start: u32,
    end: u32,
    entry: Option<usize>,
}

/// Returns the rows of process data with `bits` bits. A cell refers to its entry by the position among the entries that are not
/// padding.
pub(super) fn rows(entries: &[PdoEntry], bits: u32) -> Vec<Row> {
    let bits = bits.min(MOST_BITS);
    let pieces = pieces(entries, bits);
    let mut rows = Vec::new();
    let mut start = 0;
    while start < bits && rows.len() < MOST_ROWS {
        start = if splits_byte(&pieces, start) {
            let end = (start + 8).min(bits);
            let middle = (start + COLUMNS).min(end);
            rows.extend([(middle, end), (start, middle)].into_iter().filter(|(low, high)| low < high).map(
                |(low, high)| {
                    let cells = cells(&pieces, low, high, 1).into_iter().rev().collect();
                    Row { position: address::bits_of(low, high - low), cells }
                },
            ));
            end
        } else {
            let end = end_of_bytes(&pieces, start);
            let cells = match end - start > ROW {
                true => vec![Cell { columns: COLUMNS, entry: at(&pieces, start).and_then(|piece| piece.entry) }],
                false => cells(&pieces, start, end, 8),
            };
            rows.push(Row { position: address::bits_of(start, end - start), cells });
            end
        };
    }
    rows
}

/// Returns consecutive pieces that cover all bits. If entries overlap, the common bits belong to the earlier entry.
fn pieces(entries: &[PdoEntry], bits: u32) -> Vec<Piece> {
    let used = entries.iter().filter(|entry| entry.kind != PdoEntryKind::Padding).enumerate();
    let mut sorted: Vec<Piece> = used
        .map(|(at, entry)| Piece {
            start: entry.bit_offset.min(bits),
            end: entry.bit_offset.saturating_add(entry.bits).min(bits),
            entry: Some(at),
        })
        .collect();
    sorted.sort_by_key(|piece| piece.start);
    let (mut pieces, mut reached) = (Vec::new(), 0);
    for piece in sorted {
        let start = piece.start.max(reached);
        if start > reached {
            pieces.push(Piece { start: reached, end: start.min(bits), entry: None });
        }
        if piece.end > start {
            pieces.push(Piece { start, ..piece });
        }
        reached = reached.max(piece.end).max(start);
    }
    if reached < bits {
        pieces.push(Piece { start: reached, end: bits, entry: None });
    }
    pieces.retain(|piece| piece.start < piece.end);
    pieces
}

fn at(pieces: &[Piece], bit: u32) -> Option<&Piece> {
    pieces.get(pieces.partition_point(|piece| piece.end <= bit))
}

/// Returns whether a piece ends within the byte that starts at this bit.
fn splits_byte(pieces: &[Piece], start: u32) -> bool {
    at(pieces, start).is_some_and(|piece| piece.end < start + 8)
}

/// Returns the end of a row of whole bytes. Rows end at multiples of four bytes, or before a byte in which a piece
/// ends. A piece that fills several whole rows has only one row.
fn end_of_bytes(pieces: &[Piece], start: u32) -> u32 {
    let piece_end = at(pieces, start).map_or(start + 8, |piece| piece.end);
    if start.is_multiple_of(ROW) && piece_end >= start + ROW {
        return start + (piece_end - start) / ROW * ROW;
    }
    let row_end = (start / ROW + 1) * ROW;
    let mut end = start + 8;
    while end < row_end && at(pieces, end).is_some() && !splits_byte(pieces, end) {
        end += 8;
    }
    end
}

/// Returns the cells of a row from `low` to `high` whose columns have `unit` bits.
fn cells(pieces: &[Piece], low: u32, high: u32, unit: u32) -> Vec<Cell> {
    let first = pieces.partition_point(|piece| piece.end <= low);
    let inside = pieces[first..].iter().take_while(|piece| piece.start < high);
    let columns = |piece: &Piece| (piece.end.min(high) - piece.start.max(low)) / unit;
    inside.map(|piece| Cell { columns: columns(piece), entry: piece.entry }).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Position of a row, with the number of columns and the entry of each cell.
    type ShownRow = (String, Vec<(u32, Option<usize>)>);

    fn grid(entries: &[(u32, u32)], bits: u32) -> Vec<ShownRow> {
        let entry =
            |(bit_offset, bits): &(u32, u32)| PdoEntry { bit_offset: *bit_offset, ..PdoEntry::new(0x6000, 0, *bits) };
        let entries: Vec<PdoEntry> = entries.iter().map(entry).collect();
        let cells = |cells: Vec<Cell>| cells.into_iter().map(|cell| (cell.columns, cell.entry)).collect();
        rows(&entries, bits).into_iter().map(|row| (row.position, cells(row.cells))).collect()
    }

    fn row(position: &str, cells: &[(u32, Option<usize>)]) -> ShownRow {
        (position.to_owned(), cells.to_vec())
    }

    #[test]
    fn a_row_has_four_bytes() {
        let pdo = grid(&[(0, 16), (16, 32), (48, 8)], 64);
        let second = row("bytes 4–7", &[(2, Some(1)), (1, Some(2)), (1, None)]);
        assert_eq!(pdo, [row("bytes 0–3", &[(2, Some(0)), (2, Some(1))]), second]);
        assert_eq!(grid(&[(0, 16)], 16), [row("bytes 0–1", &[(2, Some(0))])]);
        assert_eq!(grid(&[], 0), []);
    }

    #[test]
    fn a_byte_with_single_bits_has_two_rows() {
        let pdo = grid(&[(0, 1), (1, 2), (3, 1), (16, 16)], 32);
        let bits =
            [row("byte 0 bits 7–4", &[(4, None)]), row("byte 0 bits 3–0", &[(1, Some(2)), (2, Some(1)), (1, Some(0))])];
        assert_eq!(pdo[..2], bits);
        assert_eq!(pdo[2..], [row("bytes 1–3", &[(1, None), (2, Some(3))])]);
        assert_eq!(grid(&[(0, 1), (1, 1)], 2), [row("byte 0 bits 1–0", &[(1, Some(1)), (1, Some(0))])]);
        let across = grid(&[(0, 12), (12, 4)], 16);
        assert_eq!(across[1..], [row("byte 1 bits 7–4", &[(4, Some(1))]), row("byte 1 bits 3–0", &[(4, Some(0))])]);
    }

    #[test]
    fn a_long_entry_has_one_row() {
        let image = grid(&[(0, 520)], 520);
        assert_eq!(image, [row("bytes 0–63", &[(4, Some(0))]), row("byte 64", &[(1, Some(0))])]);
        assert_eq!(grid(&[], u32::MAX).len(), 1, "a large gap");
        assert_eq!(grid(&[(0, 16), (8, 16)], 24), [row("bytes 0–2", &[(2, Some(0)), (1, Some(1))])], "an overlap");
    }
}
