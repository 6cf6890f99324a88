//! Objects that execute a command when a client writes them: store parameters, restore parameters, clear the error
//! list.

use super::device::Device;
use super::slots::ERRORS;
use crate::abort::AbortCode;
use crate::bus::Object;
use crate::table::Entry;

/// Index of "store parameters" (CiA 301 7.5.2.13).
const STORE: u16 = 0x1010;
/// Index of "restore default parameters" (CiA 301 7.5.2.14).
const RESTORE: u16 = 0x1011;

/// Returns whether sub-index `group` of 0x1010 or 0x1011 includes an object. Sub-index 1 includes all parameters,
/// sub-index 2 communication parameters, and sub-index 3 application parameters. All other sub-indices include
/// manufacturer-specific parameters.
fn is_in_group(group: u8, index: u16) -> bool {
    match group {
        1 => true,
        2 => matches!(index, 0x1000..=0x1FFF),
        3 => matches!(index, 0x6000..=0x9FFF),
        _ => matches!(index, 0x2000..=0x5FFF),
    }
}

fn can_be_stored(entry: &Entry, group: u8) -> bool {
    let is_command = |object: Object| matches!(object.index, ERRORS | STORE | RESTORE);
    let is_parameter = |object: Object| is_in_group(group, object.index) && !is_command(object);
    super::cells::is_writable(entry) && entry.object.is_some_and(is_parameter)
}

impl Device {
    /// Executes a write if it is a command. Returns whether the write was a command. The commands of 0x1010 and 0x1011
    /// don't change the value of the object.
    pub(super) fn command(&mut self, object: Object, data: &[u8]) -> Result<bool, AbortCode> {
        match (object.index, object.sub_index) {
            (STORE, 1..) => self.save(object.sub_index, data)?,
            (RESTORE, 1..) => self.load(object.sub_index, data)?,
            (ERRORS, 0) if data == [0] => {
                for object in self.slots.objects(ERRORS, ERRORS).collect::<std::vec::Vec<_>>() {
                    let length = self.bytes(object)?.len();
                    self.set_bytes(object, &std::vec![0; length])?;
                }
            }
            (ERRORS, 0) => return Err(AbortCode::INVALID_VALUE),
            _ => return Ok(false),
        }
        Ok(true)
    }

    fn save(&mut self, group: u8, signature: &[u8]) -> Result<(), AbortCode> {
        if signature != b"save" {
            return Err(AbortCode::CANNOT_STORE);
        }
        for slot in self.slots.iter_mut().filter(|slot| can_be_stored(&slot.entry, group)) {
            slot.stored = Some(slot.value.clone());
        }
        Ok(())
    }

    /// Deletes the stored values. The initial values become active at the next power-on.
    fn load(&mut self, group: u8, signature: &[u8]) -> Result<(), AbortCode> {
        if signature != b"load" {
            return Err(AbortCode::CANNOT_STORE);
        }
        for slot in self.slots.iter_mut().filter(|slot| can_be_stored(&slot.entry, group)) {
            slot.stored = None;
        }
        Ok(())
    }
}
