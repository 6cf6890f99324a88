//! Writes the same registers in the input formats of three generators. Each register has 32 bits with the six bit
//! fields of `FIELDS`.

use std::fmt::Write;

use crate::input::table::{self, FIELDS};

pub struct Registers {
    pub table: String,
    pub svd: String,
    pub ddsl: String,
}

pub fn registers(count: usize) -> Registers {
    Registers { table: table::table(count), svd: svd(count), ddsl: ddsl(count) }
}

/// Returns an SVD file with one peripheral for svd2rust.
fn svd(count: usize) -> String {
    let mut text = String::from("<?xml version=\"1.0\" encoding=\"utf-8\"?>\n<device schemaVersion=\"1.3\">\n");
    text += "<name>BENCH</name><version>1.0</version><description>Bench</description>\n";
    text += "<addressUnitBits>8</addressUnitBits><width>32</width><size>32</size><access>read-write</access>\n";
    text += "<resetValue>0</resetValue><resetMask>0xFFFFFFFF</resetMask>\n<peripherals><peripheral>\n";
    text +=
        "<name>CHANNELS</name><description>Channels</description><baseAddress>0x40000000</baseAddress>\n<registers>\n";
    for number in 0..count {
        let _ = write!(
            text,
            "<register><name>CHANNEL_{number}</name><description>Settings of channel {number}</description>"
        );
        let _ = writeln!(text, "<addressOffset>0x{:X}</addressOffset><fields>", 4 * number);
        for (name, low, width) in FIELDS {
            let _ = write!(text, "<field><name>{}</name><description>{name}</description>", name.to_uppercase());
            let _ = writeln!(text, "<bitOffset>{low}</bitOffset><bitWidth>{width}</bitWidth></field>");
        }
        text += "</fields></register>\n";
    }
    text + "</registers></peripheral></peripherals></device>\n"
}

/// Returns a device in the input language of the code generator `device-driver`.
fn ddsl(count: usize) -> String {
    let mut text = String::from("device Bench {\n    default-byte-order: LE,\n    register-address-type: u16,\n");
    text += "    default-access: RW,\n";
    for number in 0..count {
        let _ = writeln!(text, "    /// Settings of channel {number}\n    register Channel{number} {{");
        let _ = writeln!(text, "        address: {},\n        fields: fieldset Channel{number}Fields {{", 4 * number);
        text += "            size-bytes: 4,\n";
        for (name, low, width) in FIELDS {
            let _ = match width {
                1 => writeln!(text, "            /// {name}\n            field {name} {low} -> bool,"),
                _ => writeln!(
                    text,
                    "            /// {name}\n            field {name} {}:{low} -> uint,",
                    low + width - 1
                ),
            };
        }
        text += "        }\n    },\n";
    }
    text + "}\n"
}
