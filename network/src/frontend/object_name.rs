//! Objects as `network.toml` names them: `0x6081`, `0x60C2:1`, `Profile velocity`, `Interpolation time period/Index`.

use crate::declared::ObjectName;

/// Reads the address or name of an object.
pub(crate) fn object_name(text: &str) -> ObjectName {
    address(text).unwrap_or_else(|| ObjectName::Name(text.to_owned()))
}

fn address(text: &str) -> Option<ObjectName> {
    let (index, sub_index) = text.split_once(':').unwrap_or((text, "0"));
    let index = u16::from_str_radix(index.trim().strip_prefix("0x")?, 16).ok()?;
    let sub_index = sub_index.trim();
    let sub_index = match sub_index.strip_prefix("0x") {
        Some(digits) => u8::from_str_radix(digits, 16).ok()?,
        None => sub_index.parse().ok()?,
    };
    Some(ObjectName::Address(index, sub_index))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn addresses_and_names() {
        assert_eq!(object_name("0x6081"), ObjectName::Address(0x6081, 0));
        assert_eq!(object_name("0x60C2:1"), ObjectName::Address(0x60C2, 1));
        assert_eq!(object_name("0x1018:0x4"), ObjectName::Address(0x1018, 4));
        assert_eq!(object_name("Profile velocity"), ObjectName::Name("Profile velocity".into()));
        assert_eq!(object_name("0x6081:300"), ObjectName::Name("0x6081:300".into()));
        assert_eq!(object_name("6081"), ObjectName::Name("6081".into()));
    }
}
