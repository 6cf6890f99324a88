//! The findings as an overlay for the description.

use std::fmt::Write as _;

use super::finding::{Finding, Found};
use super::report::Report;
use crate::quote::quoted;

impl Report {
    /// Returns an overlay with the deviations that an overlay can express, or `None` if there are none.
    ///
    /// Each row has the finding as a comment. The length of a value determines its type: an unsigned integer up to 8
    /// bytes, and `bytes` above. The type of an undeclared object that cannot be read is `?`.
    #[must_use]
    pub fn overlay(&self) -> Option<String> {
        let rows: Vec<(&Finding, String)> =
            self.deviations().filter_map(|finding| Some((finding, row(finding)?))).collect();
        if rows.is_empty() {
            return None;
        }
        let mut text = format!(
            "lexibus = 1\n\n[overlay]\nfor = {{ device = {} }}\nwhy = \"comparison with a device\"\n\n[[chapters]]\n\
             title = \"Found on the device\"\n\n[chapters.objects]\n",
            quoted(&self.device)
        );
        for (finding, facts) in rows {
            let _ = writeln!(text, "# {}", finding.to_string().replace(char::is_control, " "));
            let _ = writeln!(text, "{} = {{ {facts} }}", key(&finding.address));
        }
        Some(text)
    }
}

/// Returns the address as a key: `0x2000` for sub-index 0, `"0x1018:1"` for others.
fn key(address: &str) -> String {
    match address.split_once(':') {
        Some((index, "00")) => index.to_owned(),
        Some((index, sub_index)) => {
            let sub_index = u8::from_str_radix(sub_index, 16).unwrap_or_default();
            format!("\"{index}:{sub_index}\"")
        }
        None => quoted(address),
    }
}

/// Returns the facts of a row, or `None` if an overlay cannot state the finding.
fn row(finding: &Finding) -> Option<String> {
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

/// Returns an unsigned integer type up to 8 bytes, and `bytes` above. Returns `None` for length 0.
fn type_of(bytes: usize) -> Option<String> {
    match bytes {
        0 => None,
        1..=8 => Some(format!("u{}", 8 * bytes)),
        _ => Some(format!("bytes({bytes})")),
    }
}
