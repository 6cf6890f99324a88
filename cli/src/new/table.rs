//! `lexibus new NAME`: creates a register table with example rows.

use std::path::{Path, PathBuf};

use crate::args::{Bus, New};
use crate::files::create;
use crate::Failure;

// These templates contain the placeholders `{name}` and `{file}`.
const MODBUS: &str = include_str!("../../templates/table/modbus.toml");
const CANOPEN: &str = include_str!("../../templates/table/canopen.toml");
const ETHERCAT: &str = include_str!("../../templates/table/ethercat.toml");

pub(super) fn run(new: &New, name: &str) -> Result<bool, Failure> {
    let name = name.trim();
    if name.is_empty() || name.chars().any(char::is_control) {
        return Err(Failure::Usage("the name of the device must not be empty or contain control characters".into()));
    }
    let template = match new.bus {
        None | Some(Bus::Modbus) => MODBUS,
        Some(Bus::Canopen) => CANOPEN,
        Some(Bus::Ethercat) => ETHERCAT,
    };
    let path = new.out.clone().unwrap_or_else(|| PathBuf::from(file_name(name)));
    let file = path.display();
    let quoted = name.replace('\\', "\\\\").replace('"', "\\\"");
    create(&path, template.replace("{name}", &quoted).replace("{file}", &file.to_string()).as_bytes())?;
    crate::say(&format!("{file}: created with example rows. Replace them, then run: lexibus check {file}"));
    Ok(true)
}

/// Derives a file name from a device name.
fn file_name(name: &str) -> String {
    let letters = name.chars().map(|letter| if letter.is_alphanumeric() { letter } else { '-' });
    let lower = letters.collect::<String>().to_lowercase();
    let words: Vec<&str> = lower.split('-').filter(|word| !word.is_empty()).collect();
    let stem = if words.is_empty() { "device".to_owned() } else { words.join("-") };
    Path::new(&stem).with_extension("toml").to_string_lossy().into_owned()
}

#[cfg(test)]
mod tests {
    use super::file_name;

    #[test]
    fn files_are_called_like_their_device() {
        for (name, file) in
            [("Pump Controller", "pump-controller.toml"), ("AB-12/3", "ab-12-3.toml"), ("--", "device.toml")]
        {
            assert_eq!(file_name(name), file);
        }
    }
}
