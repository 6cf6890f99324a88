//! Creates register tables of any size.

use std::fmt::Write;

/// Bit fields of each register: name, lowest bit and width. A flag has a width of one bit.
pub const FIELDS: [(&str, u32, u32); 6] =
    [("enable", 0, 1), ("invert", 1, 1), ("fault", 2, 1), ("gain", 4, 4), ("limit", 8, 8), ("offset", 16, 16)];

/// Returns a table with `10 * size` registers.
pub fn growing(size: usize) -> Vec<u8> {
    table(10 * size).into_bytes()
}

/// Returns a table with `registers` 32-bit registers. Each register has six bit fields.
pub fn table(registers: usize) -> String {
    let mut text =
        String::from("lexibus = 1\n\n[device]\nname = \"Bench\"\nvendor = \"Bench\"\nbuses = [\"modbus\"]\n\n");
    text += "[spaces.holding]\nmodbus = { table = \"holding\", first = 0, order = \"low_first\" }\n\n";
    text +=
        "[[chapters]]\ntitle = \"Channels\"\ndefaults = { access = \"rw\", type = \"u32\" }\n\n[chapters.registers]\n";
    for number in 0..registers {
        let (first, last) = (2 * number, 2 * number + 1);
        let _ = writeln!(text, "channel_{number} = {{ reg = \"{first}-{last}\", bits = \"Channel{number}\" }}");
    }
    for number in 0..registers {
        bits(&mut text, number);
    }
    text
}

fn bits(text: &mut String, number: usize) {
    let _ =
        writeln!(text, "\n[bits.Channel{number}]\ndoc = \"Settings of channel {number}\"\n[bits.Channel{number}.at]");
    for (name, low, width) in FIELDS {
        let _ = match width {
            1 => writeln!(text, "{low} = \"{name}\""),
            _ => writeln!(text, "\"{}-{low}\" = \"{name}\"", low + width - 1),
        };
    }
    let _ = writeln!(text, "3 = {{ reserved = 0 }}");
}
