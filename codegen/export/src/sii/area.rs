//! The configuration area: the first 64 words of the EEPROM (ETG.2010, table 2).

use lexibus_codegen::ir::{Mailbox, SyncManagerPurpose};

use super::options::EepromSize;
use super::Context;
use crate::note::{NoteKind, Subject};
use crate::options::MissingFacts;

/// Length of the area in bytes.
pub(super) const LENGTH: usize = 128;

/// Number of bytes that the checksum covers. These bytes are at the start of the area, and the checksum follows them.
const CHECKED: usize = 14;
const CHECKED_WITH_SUM: usize = CHECKED + 2;

/// Version of the SII format.
const VERSION: u16 = 1;

/// Returns the configuration area except the size of the EEPROM.
pub(super) fn content(context: &mut Context<'_>, missing: &mut MissingFacts) -> Area {
    let mut area = Area([0; LENGTH]);
    area.configure(&config_data(context, missing));
    area.identify(context, missing);
    area.set_mailboxes(context);
    area.set_word(0x1C, context.settings.mailbox.as_deref().map_or(0, protocols));
    area.set_word(0x3F, VERSION);
    area
}

/// The configuration area. `set_bytes` and `set_word` take word addresses.
pub(super) struct Area([u8; LENGTH]);

impl Area {
    fn set_bytes(&mut self, word: usize, bytes: &[u8]) {
        self.0.iter_mut().skip(2 * word).zip(bytes).for_each(|(to, from)| *to = *from);
    }

    fn set_word(&mut self, word: usize, value: u16) {
        self.set_bytes(word, &value.to_le_bytes());
    }

    /// Writes the initial values of the slave controller's registers, and their checksum.
    fn configure(&mut self, config_data: &[u8]) {
        self.set_bytes(0, config_data);
        self.set_word(7, checksum(&self.0[..CHECKED]).into());
    }

    fn identify(&mut self, context: &Context<'_>, missing: &mut MissingFacts) {
        let (identity, options) = (&context.device.identity, context.options);
        let numbers = [
            (0x08, options.vendor_id().or(identity.vendor_id), "vendor-id"),
            (0x0A, options.product_code().or(identity.product_code), "product-code"),
            (0x0C, options.revision().or(identity.revision_number).or(Some(0)), "revision"),
            (0x0E, options.serial_number().or(identity.serial_number).or(Some(0)), "serial-number"),
        ];
        for (word, number, key) in numbers {
            let number: u32 = missing.require(number, key);
            self.set_bytes(word, &number.to_le_bytes());
        }
    }

    /// Writes the addresses and lengths of the mailboxes, for the state "Bootstrap" and for the other states.
    fn set_mailboxes(&mut self, context: &mut Context<'_>) {
        if let Some(eeprom) = &context.settings.eeprom {
            let (used, rest) = eeprom.boot_strap.split_at(eeprom.boot_strap.len().min(8));
            self.set_bytes(0x14, used);
            context.notes.add_many(NoteKind::ConfigData, !rest.is_empty(), Subject::Named("BootStrap"));
        }
        // Process the sync managers in reverse order, so that the first mailbox of each direction takes precedence.
        for manager in context.device.process_data.sync_managers.iter().rev() {
            let word = match manager.purpose {
                SyncManagerPurpose::MailboxOut => 0x18,
                SyncManagerPurpose::MailboxIn => 0x1A,
                SyncManagerPurpose::Outputs | SyncManagerPurpose::Inputs => continue,
            };
            self.set_word(word, manager.start_address);
            self.set_word(word + 1, manager.default_size.unwrap_or(0));
        }
    }

    /// Writes the size of the EEPROM and returns the bytes of the area.
    pub(super) fn with_size(mut self, size: EepromSize) -> [u8; LENGTH] {
        self.set_word(0x3E, size.word());
        self.0
    }
}

/// Returns the first 14 bytes of the EEPROM from the options, or from the description if the options contain none.
/// Fills missing bytes with zeros. A station alias in the options replaces the alias in these bytes.
fn config_data(context: &mut Context<'_>, missing: &mut MissingFacts) -> Vec<u8> {
    let declared = context.settings.eeprom.as_ref().map(|eeprom| eeprom.config_data.clone());
    let declared = declared.filter(|bytes| !bytes.is_empty());
    let given = context.options.config_data().map(|octets| octets.0);
    let mut bytes = missing.require(given.or(declared), "config-data");
    // The bytes of a description may include the checksum. It is only checked, because `configure` computes the checksum of
    // the image.
    let is_more = !matches!(bytes.len(), 0..=CHECKED | CHECKED_WITH_SUM);
    context.notes.add_many(NoteKind::ConfigData, is_more, Subject::Named("ConfigData"));
    if let [.., low, high] = bytes.get(..CHECKED_WITH_SUM).unwrap_or_default() {
        let is_wrong = [*low, *high] != [checksum(&bytes[..CHECKED]), 0];
        context.notes.add_many(NoteKind::Checksum, is_wrong, Subject::Named("ConfigData"));
    }
    bytes.resize(CHECKED, 0);
    if let Some(alias) = context.options.station_alias() {
        bytes[8..10].copy_from_slice(&alias.to_le_bytes());
    }
    bytes
}

/// Returns the mailbox protocols, with one bit for each protocol.
fn protocols(mailbox: &Mailbox) -> u16 {
    let Mailbox { aoe, eoe, coe, foe, soe, voe, .. } = mailbox;
    super::general::bits(&[aoe.is_some(), eoe.is_some(), coe.is_some(), foe.is_some(), soe.is_some(), voe.is_some()])
        .into()
}

/// Returns whether the checksum of an image is right.
pub(super) fn is_checked(image: &[u8]) -> bool {
    image.get(..CHECKED_WITH_SUM).is_some_and(|bytes| bytes[CHECKED..] == [checksum(&bytes[..CHECKED]), 0])
}

/// Returns the CRC-8 with the polynomial x⁸ + x² + x + 1 and the initial value 0xFF.
fn checksum(bytes: &[u8]) -> u8 {
    bytes.iter().fold(0xFF, |remainder, byte| {
        (0..8).fold(remainder ^ byte, |bits: u8, _| if bits & 0x80 != 0 { bits << 1 ^ 0x07 } else { bits << 1 })
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Checks the first words of the EEPROM of a published device. The CRC over the first 14 bytes and their checksum is 0.
    #[test]
    fn checksums() {
        let image = [0x80, 0x06, 0x03, 0x4C, 0x64, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0xEC, 0];
        assert!(is_checked(&image));
        assert_eq!(checksum(&image[..15]), 0);
        assert!(!is_checked(&image[..15]) && !is_checked(&[0; 16]));
    }
}
