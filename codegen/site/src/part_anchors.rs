//! Anchors of the parts of an element, such as the bits and named values of an item.

use std::collections::HashMap;

use super::addresses::folder_name;
use super::anchor::Names;

/// Returns the anchor of the part with this number in its element: `bit-3-0` for `bit 3–0`, and `value-3` for `value 3 to 5`.
pub(super) fn of_number(number: &str) -> String {
    let words: Vec<&str> = number.split(' ').take(2).collect();
    words.join("-").replace('–', "-")
}

/// Returns the anchors of the parts of an element. Each part consists of a number, a name, and a flag that is set if
/// the meaning of the part depends on a condition. The anchor contains the name if the meaning depends on a condition
/// or if several parts have the same number. Therefore, such an anchor does not depend on the order of the parts.
pub(super) fn anchors(owner: &str, parts: &[(String, &str, bool)]) -> Vec<String> {
    let mut counts: HashMap<&str, usize> = HashMap::new();
    parts.iter().for_each(|(number, ..)| *counts.entry(number).or_default() += 1);
    let mut names = Names::within(owner);
    let mut anchor = |(number, name, is_conditional): &(String, &str, bool)| {
        let is_shared = *is_conditional || counts.get(number.as_str()) > Some(&1);
        let plain = of_number(number);
        names.anchor(&if is_shared && !name.is_empty() { format!("{plain}-{}", folder_name(name)) } else { plain })
    };
    parts.iter().map(&mut anchor).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn anchors_do_not_depend_on_the_order() {
        let mut parts = [
            ("bit 3–0", "mode", false),
            ("bit 4", "New set-point", true),
            ("bit 4", "enable_ramp", true),
            ("bit 5", "", true),
            ("value 256 (0x100)", "Fault", false),
            ("value 7 to 9", "one", false),
            ("value 7 to 9", "other", false),
        ]
        .map(|(number, name, is_conditional)| (number.to_owned(), name, is_conditional));
        let before = anchors("0x6040", &parts);
        assert_eq!(
            before,
            [
                "0x6040.bit-3-0",
                "0x6040.bit-4-new-set-point",
                "0x6040.bit-4-enable-ramp",
                "0x6040.bit-5",
                "0x6040.value-256",
                "0x6040.value-7-one",
                "0x6040.value-7-other",
            ]
        );
        parts.reverse();
        let mut after = anchors("0x6040", &parts);
        after.reverse();
        assert_eq!(before, after);
    }
}
