//! Reports keys that have no effect in their row.

use super::at::At;
use super::format::{NumberOrText, Row};
use super::tree::Reader;
use crate::diagnostics::codes;

/// Keys, each with a flag that is true if the key has no effect in the row, and with the help text for this case.
type Misplaced<'r> = &'r [(&'r str, bool, &'r str)];

/// Checks a row in `[chapters.registers]` of a register table.
pub(super) fn register(reader: &mut Reader<'_, '_>, key: &At<String>, row: &At<Row>) {
    let register = &row.value;
    let list = [
        ("name", register.name.is_some(), "delete `name`: the key of a register is its name"),
        ("code", register.code.is_some(), "move the row to `[chapters.objects]`: only objects have an object code"),
        (
            "reserved",
            register.reserved.is_some(),
            "delete the row if the register has no meaning: only a sub-index can be reserved",
        ),
    ];
    report(reader, key, &list);
    everywhere(reader, key, register);
}

/// Checks a row in `[chapters.objects]` of a register table.
pub(super) fn object(reader: &mut Reader<'_, '_>, key: &At<String>, row: &At<Row>) {
    let object = &row.value;
    let repeats = object.count.is_some() || object.max_count.is_some() || object.stride.is_some();
    let list = [
        ("obj", object.obj.is_some(), "delete `obj`: the key of the row is the object"),
        ("count", repeats, "write several objects as a key such as `\"0x1400..0x1403:1\"`"),
    ];
    report(reader, key, &list);
    everywhere(reader, key, object);
}

fn everywhere(reader: &mut Reader<'_, '_>, key: &At<String>, row: &Row) {
    let by_item = matches!(&row.count, Some(At { value: NumberOrText::Text(_), .. }));
    let words = row.order.is_some() || row.swap.is_some();
    let list = [
        ("why", row.why.is_some(), "delete `why`, the reason of a change: only overlays make changes"),
        ("add", row.add.is_some(), "delete `add`: only an overlay adds items to a description"),
        ("remove", row.remove.is_some(), "delete the row: only an overlay removes items"),
        (
            "part",
            row.part.is_some() && row.reg.is_none(),
            "add `reg`, or delete `part`, which selects bits of a register",
        ),
        ("order", words && row.reg.is_none(), "add `reg`, or delete the word order of registers"),
        (
            "stride",
            row.stride.is_some() && row.count.is_none(),
            "add `count`, or delete `stride`, the distance between several items",
        ),
        (
            "max_count",
            row.max_count.is_some() && !by_item,
            "write the name of an item as `count`, or delete `max_count`",
        ),
    ];
    report(reader, key, &list);
}

/// Checks a row of an overlay or profile, which cannot change register numbers or object addresses.
pub(super) fn overlay(reader: &mut Reader<'_, '_>, key: &At<String>, row: &At<Row>) {
    let patch = &row.value;
    let repeats = patch.count.is_some() || patch.max_count.is_some() || patch.stride.is_some();
    let words = patch.order.is_some() || patch.swap.is_some();
    let kept = "delete the key: the description sets the registers and objects of items";
    let list = [
        ("reg", patch.reg.is_some(), kept),
        ("obj", patch.obj.is_some(), kept),
        ("part", patch.part.is_some(), kept),
        ("order", words, kept),
        ("count", repeats, "delete the key: the row applies to the items of the description"),
    ];
    report(reader, key, &list);
}

fn report(reader: &mut Reader<'_, '_>, key: &At<String>, list: Misplaced<'_>) {
    for (name, _, why) in list.iter().filter(|(_, is_there, _)| *is_there) {
        let found = codes::TABLE_VALUE.at(reader.span(key), format!("`{name}` has no effect in this row"));
        reader.diagnostics.push(found.help(*why));
    }
}

/// Returns the first key of a row that describes a value or a further address of a value. An object with sub-entries
/// has no value itself.
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
