//! The findings as an overlay for the description.

use std::fmt::Write as _;

use super::finding::{Finding, Found};
use super::report::Report;
use crate::quote::quoted;

impl Report {
    /// Returns an overlay with the deviations of objects that an overlay can express, or `None` if there are none. Deviations of
    /// registers are left out.
    ///
    /// A comment before each row contains the finding. The length of a value determines its type: an unsigned integer for 1 to
    /// 8 bytes, and `bytes` for more. The type of an undeclared object that cannot be read, or whose value is empty, is `?`.
    #[must_use]
    pub fn overlay(&self) -> Option<String> {
        let all = self.deviations();
        let rows: Vec<(&Finding, String, String)> =
            all.filter_map(|finding| Some((finding, key(&finding.address)?, facts(finding)?))).collect();
        if rows.is_empty() {
            return None;
        }
        let mut text = format!(
            "lexibus = 1\n\n[overlay]\nfor = {{ device = {} }}\nwhy = \"comparison with a device\"\n\n[[chapters]]\n\
             title = \"Found on the device\"\n\n[chapters.objects]\n",
            quoted(&self.device)
        );
        for (finding, key, facts) in rows {
            let _ = writeln!(text, "# {}", finding.to_string().replace(char::is_control, " "));
            let _ = writeln!(text, "{key} = {{ {facts} }}");
        }
        Some(text)
    }
}

/// Returns the address of an object as a key: `0x2000` for sub-index 0, `"0x1018:1"` for others. Returns `None` for a register or for
/// the identity of a Modbus device.
fn key(address: &str) -> Option<String> {
    let (index, sub_index) = address.split_once(':')?;
    match u8::from_str_radix(sub_index, 16).ok()? {
        0 => Some(index.to_owned()),
        sub_index => Some(format!("\"{index}:{sub_index}\"")),
    }
}

/// Returns the facts of a row, or `None` if an overlay cannot state the finding.
fn facts(finding: &Finding) -> Option<String> {
    match finding.found {
        Found::Nothing => Some("remove = true".to_owned()),
        Found::Length(bytes) => Some(format!("type = \"{}\"", type_of(bytes)?)),
        Found::Readable => Some("access = \"rw\"".to_owned()),
        Found::WriteOnly => Some("access = \"wo\"".to_owned()),
        Found::Object(length) => {
            let ty = length.and_then(type_of).unwrap_or_else(|| "?".to_owned());
            let name = quoted(&format!("Object {}", finding.address));
            Some(format!("add = true, name = {name}, type = \"{ty}\", access = \"ro\""))
        }
        Found::Other => None,
    }
}

/// Returns an unsigned integer type for 1 to 8 bytes, and `bytes` for more. Returns `None` for 0 bytes.
fn type_of(bytes: usize) -> Option<String> {
    match bytes {
        0 => None,
        1..=8 => Some(format!("u{}", 8 * bytes)),
        _ => Some(format!("bytes({bytes})")),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn only_objects_have_rows() {
        let keys = ["0x2000:00", "0x1018:0A", "register 101", "identity"].map(key);
        assert_eq!(keys, [Some("0x2000".to_owned()), Some("\"0x1018:10\"".to_owned()), None, None]);
    }
}
