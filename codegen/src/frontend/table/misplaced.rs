//! Keys of a row that would say nothing where they stand.

use super::at::At;
use super::format::{NumberOrText, Row};
use super::tree::Reader;
use crate::diagnostics::{codes, Diagnostic};

/// Keys, whether a row has them, and why they can't stand there.
type Misplaced<'r> = &'r [(&'r str, bool, &'r str)];

/// A row of `[chapters.registers]` of a table.
pub(super) fn register(reader: &mut Reader<'_, '_>, key: &At<String>, row: &At<Row>) {
    let own = &row.value;
    report(
        reader,
        key,
        &[
            ("name", own.name.is_some(), "the key of a register is its name"),
            ("code", own.code.is_some(), "only objects have an object code: put the row into `[chapters.objects]`"),
            (
                "reserved",
                own.reserved.is_some(),
                "only a sub-index is reserved: leave out a register that means nothing",
            ),
        ],
    );
    everywhere(reader, key, own);
}

/// A row of `[chapters.objects]` of a table.
pub(super) fn object(reader: &mut Reader<'_, '_>, key: &At<String>, row: &At<Row>) {
    let own = &row.value;
    let repeats = own.count.is_some() || own.max_count.is_some() || own.stride.is_some();
    report(
        reader,
        key,
        &[
            ("obj", own.obj.is_some(), "the key of the row is the object"),
            ("count", repeats, "a key such as `\"0x1400..0x1403:1\"` says how many objects are meant"),
        ],
    );
    everywhere(reader, key, own);
}

fn everywhere(reader: &mut Reader<'_, '_>, key: &At<String>, row: &Row) {
    let by_item = matches!(&row.count, Some(At { value: NumberOrText::Text(_), .. }));
    let words = row.order.is_some() || row.swap.is_some();
    report(
        reader,
        key,
        &[
            ("why", row.why.is_some(), "it says why an overlay changes something, and this is no overlay"),
            ("add", row.add.is_some(), "only an overlay adds to a description"),
            ("remove", row.remove.is_some(), "only an overlay takes something away: leave the row out"),
            ("part", row.part.is_some() && row.reg.is_none(), "it is bits of a register, and the row has no `reg`"),
            ("order", words && row.reg.is_none(), "it is about the words of registers, and the row has no `reg`"),
            (
                "stride",
                row.stride.is_some() && row.count.is_none(),
                "it lies between two of several: the row has no `count`",
            ),
            ("max_count", row.max_count.is_some() && !by_item, "it goes with a `count` that an item holds"),
        ],
    );
}

/// A row of an overlay or a profile: items keep the addresses that they have.
pub(super) fn overlay(reader: &mut Reader<'_, '_>, key: &At<String>, row: &At<Row>) {
    let own = &row.value;
    let repeats = own.count.is_some() || own.max_count.is_some() || own.stride.is_some();
    let words = own.order.is_some() || own.swap.is_some();
    let kept = "items keep the registers and objects that the description gives them";
    report(
        reader,
        key,
        &[
            ("reg", own.reg.is_some(), kept),
            ("obj", own.obj.is_some(), kept),
            ("part", own.part.is_some(), kept),
            ("order", words, kept),
            ("count", repeats, "a row is about the items that the description has"),
        ],
    );
}

fn report(reader: &mut Reader<'_, '_>, key: &At<String>, list: Misplaced<'_>) {
    for (name, _, why) in list.iter().filter(|(_, is_there, _)| *is_there) {
        let found = Diagnostic::new(&codes::TABLE_VALUE, reader.span(key), format!("`{name}` can't stand in this row"));
        reader.diagnostics.push(found.help(*why));
    }
}

/// The first key of a row that says something of a value, which an object with sub-entries hasn't.
pub(super) fn of_value(row: &Row) -> Option<&'static str> {
    macro_rules! first {
        ($($key:literal $field:ident)*) => {
            [$(($key, row.$field.is_some())),*].into_iter().find(|(_, is_there)| *is_there).map(|(key, _)| key)
        };
    }
    first!(
        "type" ty "bits" bits "enum" values "access" access "pdo" pdo "min" min "max" max "default" default
        "fixed" fixed "allowed" allowed "unit" unit "scale" scale "offset" offset "na" na "step" step
        "variants" variants "save" save "effective" effective "when" when "writable" writable "clears" clears
        "once" once "effects" effects "same_as" same_as "upper" upper "same_quantity" same_quantity "reg" reg "esc" esc "length" length "ascii" ascii "param" param
    )
}
