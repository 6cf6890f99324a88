//! Requests that read an item, as bytes, for pages without a script.

use super::tools;
use lexibus_codegen::facts::number::bytes;
use lexibus_codegen::facts::register;
use lexibus_codegen::ir::{Binding, Item, ModbusTable};

/// The node-ID and Modbus unit of the requests.
const NODE: u8 = 1;

/// Returns the titles and bytes of the requests that read an item. The node-ID or the unit is 1.
pub(super) fn reads(item: &Item, tables: &[ModbusTable]) -> Vec<(&'static str, String)> {
    let request = |binding: &Binding| match binding {
        Binding::Object { buses, index, sub_index } if buses.canopen && item.access.readable() => {
            let data = bytes(&sdo_upload(*index, *sub_index));
            Some(("SDO upload from node-ID 1 (COB-ID, data)", format!("{:03X}  {data}", 0x600 + u16::from(NODE))))
        }
        Binding::Register(register) => {
            let functions = register::functions(register, item, tables);
            let function = functions.into_iter().find(|function| (1..=4).contains(function))?;
            let frame = modbus_read(NODE, function, register.address, tools::count(register));
            Some(("Modbus RTU read from unit 1", bytes(&frame)))
        }
        _ => None,
    };
    item.bindings.iter().filter_map(request).collect()
}

/// Returns the data of an SDO upload request (CiA 301, 7.2.4.3.5).
fn sdo_upload(index: u16, sub_index: u8) -> [u8; 8] {
    let [low, high] = index.to_le_bytes();
    [0x40, low, high, sub_index, 0, 0, 0, 0]
}

/// Returns the frame of a Modbus RTU request that reads registers, coils or discrete inputs.
fn modbus_read(unit: u8, function: u8, address: u16, count: u16) -> Vec<u8> {
    let mut frame = vec![unit, function];
    frame.extend(address.to_be_bytes());
    frame.extend(count.to_be_bytes());
    frame.extend(register::crc(&frame).to_le_bytes());
    frame
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn requests_have_the_bytes_of_the_browser_tests() {
        // The example of the Modbus standard: reads 3 registers from address 107 of unit 17.
        assert_eq!(bytes(&modbus_read(17, 3, 107, 3)), "11 03 00 6B 00 03 76 87");
        // Register R80 of the Eco.
        assert_eq!(bytes(&modbus_read(3, 3, 0x8050, 2)), "03 03 80 50 00 02 EC 38");
        assert_eq!(bytes(&sdo_upload(0x6064, 0)), "40 64 60 00 00 00 00 00");
    }
}
