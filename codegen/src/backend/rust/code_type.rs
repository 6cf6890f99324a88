//! Enumerations for the codes of code tables. With these enumerations, programs match alarms by name.

use std::collections::BTreeMap;

use super::doc_table;
use super::docs::{self, WORDS};
use super::options::RustOptions;
use crate::collections::HashSet;
use crate::ir::{CodeRow, CodeTable, Manual};
use crate::names::{self, Case, NameRequest};
use crate::number::hex;

/// An enumeration of codes, ready to be printed.
pub(super) struct CodeTypeModel {
    pub name: String,
    /// Lines of the documentation table with all codes.
    pub table: Vec<String>,
    pub derives: Vec<String>,
    /// The `cfg` attribute of `PartialEq`, `Eq` and `Hash`, if the options request these.
    pub equality: Option<Vec<String>>,
    /// Primitive integer that holds a code.
    pub native: &'static str,
    pub variants: Vec<CodeVariant>,
    /// Arms of the match that converts a code to its variant: pattern and variant.
    pub arms: Vec<(String, String)>,
    /// True if the rows of the code table cover all numbers of the integer type.
    pub complete: bool,
}

/// A variant of the enumeration. The variant represents a code or a range of codes.
pub(super) struct CodeVariant {
    pub name: String,
    pub docs: String,
    /// The code. `None` if the variant represents a range.
    pub code: Option<String>,
}

/// Names that variants must not have, because the generated code uses them.
const RESERVED: [&str; 2] = ["Self", "Unknown"];

/// Integer types of codes. The smallest type has 16 bits, because emergency error codes of CANopen have 16 bits (CiA
/// 301 7.2.7).
const NATIVES: [(&str, i64, i64); 4] = [
    ("u16", 0, u16::MAX as i64),
    ("u32", 0, u32::MAX as i64),
    ("i32", i32::MIN as i64, i32::MAX as i64),
    ("i64", i64::MIN, i64::MAX),
];

type Span = (i64, i64);

/// Returns the enumeration for `table`, without its name. Returns `None` if no row has a valid range of codes within
/// `i64`.
pub(super) fn model<'a>(table: &'a CodeTable, manual: &Manual, options: &RustOptions) -> Option<CodeTypeModel> {
    let mut seen = HashSet::default();
    // If several rows describe the same code or range, for example for different models, the first row determines the
    // name of the variant.
    let first_of_its_span = |row: &'a CodeRow| Some((span(row).filter(|row_span| seen.insert(*row_span))?, row));
    let rows: Vec<(Span, &CodeRow)> = table.rows.iter().filter_map(first_of_its_span).collect();
    let low = rows.iter().map(|(span, _)| span.0).min()?;
    let high = rows.iter().map(|(span, _)| span.1).max()?;
    let (native, first, last) = *NATIVES.iter().find(|native| native.1 <= low && high <= native.2)?;
    let name_request = |(span, row): &(Span, &'a CodeRow)| {
        NameRequest::new(&row.name, "code", span.0.to_string().replace('-', "Minus"))
    };
    let name_requests = rows.iter().map(name_request);
    let names = names::unique(name_requests, &RESERVED, Case::Pascal);
    let spans: Vec<Span> = rows.iter().map(|(span, _)| *span).collect();
    let pieces = disjoint(&spans);
    let covered: i128 = pieces.iter().map(|(_, span)| i128::from(span.1) - i128::from(span.0) + 1).sum();
    let arm = |(at, span): &(usize, Span)| {
        let is_range = spans[*at].0 != spans[*at].1;
        (pattern(*span), if is_range { format!("{}(code)", names[*at]) } else { names[*at].clone() })
    };
    let arms = pieces.iter().map(arm).collect();
    let variants = rows.iter().zip(&names).map(|((span, row), name)| variant(*span, row, name, manual)).collect();
    let complete = covered == i128::from(last) - i128::from(first) + 1;
    let row = |((_, row), name): (&(Span, &CodeRow), &String)| {
        let meaning = doc_table::meaning(&row.name, name, row.documentation.as_deref());
        [docs::escape(&row.printed_code()), format!("[`{name}`](Self::{name})"), meaning]
    };
    let listed: Vec<[String; 3]> = rows.iter().zip(&names).take(doc_table::MAX_ROWS + 1).map(row).collect();
    let table = doc_table::table(["Code", "Name", "Meaning"], &listed);
    Some(CodeTypeModel {
        name: String::new(),
        table,
        derives: options.derives_without_equality(),
        equality: RustOptions::gate(&options.partial_eq),
        native,
        variants,
        arms,
        complete,
    })
}

fn span(row: &CodeRow) -> Option<Span> {
    let first = i64::try_from(row.code).ok()?;
    let last = i64::try_from(row.last.unwrap_or(row.code)).ok()?;
    (first <= last).then_some((first, last))
}

/// Returns for each span the parts that no narrower span covers, in ascending order. If spans of the same length
/// overlap, the first of these spans gets the overlap.
fn disjoint(spans: &[Span]) -> Vec<(usize, Span)> {
    let mut order: Vec<usize> = (0..spans.len()).collect();
    order.sort_by_key(|at| spans[*at].0.abs_diff(spans[*at].1));
    // The codes covered so far, as a map from the first to the last code of each covered span. A new span absorbs the
    // covered spans that it overlaps, so each span is visited only once.
    let mut covered: BTreeMap<i64, i64> = BTreeMap::new();
    let mut pieces = Vec::new();
    for at in order {
        let (mut first, mut last) = spans[at];
        // The last code of the part of the span that is not yet compared with the covered spans. If this code is below
        // the first code of the span, no such part remains.
        let mut end = Some(last);
        while let Some((low, high)) = last_meeting(&covered, spans[at]) {
            covered.remove(&low);
            pieces.extend(end.filter(|end| *end > high).map(|end| (at, (high + 1, end))));
            end = low.checked_sub(1);
            (first, last) = (first.min(low), last.max(high));
        }
        pieces.extend(end.filter(|end| *end >= spans[at].0).map(|end| (at, (spans[at].0, end))));
        covered.insert(first, last);
    }
    pieces.sort_by_key(|(_, span)| span.0);
    pieces
}

/// Returns the last of the disjoint spans that has a code in common with `span`.
fn last_meeting(spans: &BTreeMap<i64, i64>, span: Span) -> Option<Span> {
    let (first, last) = spans.range(..=span.1).next_back()?;
    (*last >= span.0).then_some((*first, *last))
}

fn pattern(span: Span) -> String {
    let (first, last) = span;
    if first == last {
        number(first)
    } else {
        format!("{}..={}", number(first), number(last))
    }
}

/// Returns a code as a literal. Codes of 10 and above are hexadecimal.
pub(super) fn number(code: i64) -> String {
    if code > 9 {
        hex(code)
    } else {
        code.to_string()
    }
}

fn variant(span: Span, row: &CodeRow, name: &str, manual: &Manual) -> CodeVariant {
    let codes = docs::escape(&row.printed_code());
    let title = docs::escape(&row.name);
    let mut text = if title.is_empty() { format!("{codes}.") } else { format!("{codes}: {}", docs::sentence(&title)) };
    let mut sentences = WORDS.description(row.documentation.as_deref());
    sentences.extend(row.availability.as_ref().map(|availability| WORDS.availability(availability)));
    sentences.extend(WORDS.manual_entry(manual, "", row.documentation.as_deref(), &row.names));
    sentences.extend(WORDS.defined_by(row.stated_by.as_deref(), row.documentation.as_deref()));
    sentences.iter().for_each(|sentence| text.extend([" ", sentence]));
    CodeVariant { name: name.to_owned(), docs: text, code: (span.0 == span.1).then(|| number(span.0)) }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn narrower_spans_are_cut_out_of_wider_ones() {
        let spans = [(0x81, 0x8F), (0x83, 0x83), (0, 0), (0x8F, 0x90)];
        let pieces = [(2, (0, 0)), (0, (0x81, 0x82)), (1, (0x83, 0x83)), (0, (0x84, 0x8E)), (3, (0x8F, 0x90))];
        assert_eq!(disjoint(&spans), pieces);
        assert_eq!(
            disjoint(&[(i64::MIN, i64::MAX), (i64::MAX, i64::MAX)]),
            [(0, (i64::MIN, i64::MAX - 1)), (1, (i64::MAX, i64::MAX))]
        );
        assert_eq!(disjoint(&[(0, 1), (0, 0), (1, 1)]), [(1, (0, 0)), (2, (1, 1))]);
    }

    /// Calculates the result of `disjoint` in a simpler way, code by code.
    fn disjoint_by_code(spans: &[Span]) -> Vec<(usize, Span)> {
        let mut pieces: Vec<(usize, Span)> = Vec::new();
        let codes = spans.iter().map(|span| span.0).min().unwrap()..=spans.iter().map(|span| span.1).max().unwrap();
        for code in codes {
            let having = (0..spans.len()).filter(|at| (spans[*at].0..=spans[*at].1).contains(&code));
            let Some(narrowest) = having.min_by_key(|at| spans[*at].0.abs_diff(spans[*at].1)) else { continue };
            match pieces.last_mut() {
                Some((at, span)) if *at == narrowest && span.1 == code - 1 => span.1 = code,
                _ => pieces.push((narrowest, (code, code))),
            }
        }
        pieces
    }

    #[test]
    fn overlapping_spans() {
        let mut state = 1_u32;
        let mut below = |limit: i64| {
            state = state.wrapping_mul(1_664_525).wrapping_add(1_013_904_223);
            i64::from(state >> 8) % limit
        };
        for longest in [1, 3, 20, 300] {
            for count in 1..100 {
                let firsts: Vec<i64> = (0..count).map(|_| below(400) - 200).collect();
                let spans: Vec<Span> = firsts.iter().map(|first| (*first, *first + below(longest))).collect();
                assert_eq!(disjoint(&spans), disjoint_by_code(&spans), "{spans:?}");
            }
        }
    }

    /// Returns `count` single codes with gaps between them, and a span that covers all of them.
    fn holes(count: i64) -> Vec<Span> {
        (0..count).map(|at| (2 * at + 1, 2 * at + 1)).chain([(0, 2 * count)]).collect()
    }

    #[test]
    fn many_narrow_spans_in_a_wide_one() {
        assert_eq!(disjoint(&holes(300)), disjoint_by_code(&holes(300)));
        let pieces = disjoint(&holes(20_000));
        let owner = |code: i64| if code % 2 == 0 { 20_000 } else { code as usize / 2 };
        assert_eq!(pieces, (0..=40_000).map(|code| (owner(code), (code, code))).collect::<Vec<_>>());
    }

    #[test]
    fn patterns() {
        assert_eq!(
            (pattern((5, 5)), pattern((9, 0x1F)), pattern((-3, -3))),
            ("5".into(), "9..=0x1F".into(), "-3".into())
        );
    }
}
