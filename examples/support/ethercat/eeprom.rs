//! Creates the content of the EEPROM (ETG.1000.6 5.4, ETG.2010).

use lexibus::ethercat::{Device, SyncManagerPurpose};

/// Word address of the first category.
const CATEGORIES: usize = 0x40;

/// Size of the EEPROM in bytes.
const SIZE: usize = 2048;

/// Returns the EEPROM content of a device.
pub fn of(device: &Device) -> Vec<u8> {
    let mut words = vec![0_u16; CATEGORIES];
    let mut double = |at: usize, value: Option<u32>| {
        let value = value.unwrap_or(0);
        (words[at], words[at + 1]) = (value as u16, (value >> 16) as u16);
    };
    double(0x08, device.identity.vendor_id);
    double(0x0A, device.identity.product_code);
    double(0x0C, device.identity.revision_number);
    double(0x0E, Some(1));
    for manager in device.sync_managers {
        let at = match manager.purpose {
            SyncManagerPurpose::MailboxOut => 0x18,
            SyncManagerPurpose::MailboxIn => 0x1A,
            _ => continue,
        };
        (words[at], words[at + 1]) = (manager.start_address, manager.default_size);
    }
    words[0x1C] = if device.mailbox.coe.is_some() { 0x04 } else { 0 };
    words[0x3E] = (SIZE / 128 - 1) as u16;
    words[0x3F] = 1;
    let mut bytes: Vec<u8> = words.into_iter().flat_map(u16::to_le_bytes).collect();
    bytes[14] = checksum(&bytes[..14]);
    category(&mut bytes, 10, &strings(&[device.identity.order_code, device.identity.product_name]));
    category(&mut bytes, 30, &general(device));
    category(&mut bytes, 40, &fmmus(device));
    category(&mut bytes, 41, &managers(device));
    bytes.resize(SIZE, 0xFF);
    bytes
}

fn category(bytes: &mut Vec<u8>, kind: u16, content: &[u8]) {
    let words = content.len().div_ceil(2);
    bytes.extend(kind.to_le_bytes());
    bytes.extend((words as u16).to_le_bytes());
    bytes.extend(content);
    bytes.resize(bytes.len() + 2 * words - content.len(), 0);
}

fn strings(texts: &[&str]) -> Vec<u8> {
    let mut bytes = vec![texts.len() as u8];
    for text in texts {
        bytes.push(text.len() as u8);
        bytes.extend(text.bytes());
    }
    bytes
}

/// Returns the category "General". The order code is string 1, and the name is string 2.
fn general(device: &Device) -> Vec<u8> {
    let mut bytes = vec![0; 32];
    (bytes[2], bytes[3]) = (1, 2);
    if let Some(coe) = device.mailbox.coe {
        let flags = [true, coe.sdo_info, coe.pdo_assign, coe.pdo_config, false, coe.complete_access];
        bytes[5] = flags.iter().rev().fold(0, |bits, flag| bits << 1 | u8::from(*flag));
    }
    bytes
}

/// Returns the category "FMMU". The category contains an FMMU for outputs, an FMMU for inputs, and an FMMU for the
/// status of the mailbox. FMMUs for missing process data are left out.
fn fmmus(device: &Device) -> Vec<u8> {
    let of = |purpose| device.sync_managers.iter().any(|manager| manager.purpose == purpose);
    let outputs = of(SyncManagerPurpose::Outputs).then_some(1);
    outputs.into_iter().chain(of(SyncManagerPurpose::Inputs).then_some(2)).chain([3]).collect()
}

fn managers(device: &Device) -> Vec<u8> {
    let mut bytes = Vec::new();
    for manager in device.sync_managers {
        let purpose = match manager.purpose {
            SyncManagerPurpose::MailboxOut => 1,
            SyncManagerPurpose::MailboxIn => 2,
            SyncManagerPurpose::Outputs => 3,
            SyncManagerPurpose::Inputs => 4,
        };
        bytes.extend(manager.start_address.to_le_bytes());
        bytes.extend(manager.default_size.to_le_bytes());
        bytes.extend([manager.control, 0, u8::from(manager.enable), purpose]);
    }
    bytes
}

/// Returns the CRC of the configuration area. The polynomial is x⁸ + x² + x + 1.
fn checksum(bytes: &[u8]) -> u8 {
    bytes.iter().fold(0xFF, |remainder, byte| {
        (0..8).fold(remainder ^ byte, |bits: u8, _| if bits & 0x80 != 0 { bits << 1 ^ 0x07 } else { bits << 1 })
    })
}
