//! The interface to the objects of an application.

use std::cell::RefCell;
use std::rc::Rc;

use lexibus::sim::{Device, Fault};
use lexibus::{AbortCode, Client, CoE, Emergency, Error, Object};

/// The objects of an application. Values are little-endian bytes, and errors are SDO abort codes.
pub trait Dictionary {
    /// Returns the value of an entry.
    fn read(&mut self, index: u16, sub_index: u8) -> Result<Vec<u8>, u32>;

    /// Sets the value of an entry.
    fn write(&mut self, index: u16, sub_index: u8, data: &[u8]) -> Result<(), u32>;

    /// Runs the application once, after receiving outputs and before sending inputs. The outputs are only valid if
    /// `operational` is true.
    fn cycle(&mut self, _operational: bool) {}

    /// Returns the pending emergency messages.
    fn emergencies(&mut self) -> Vec<Emergency> {
        Vec::new()
    }
}

/// Allows a test to inspect the device while the segment runs.
impl<D: Dictionary> Dictionary for Rc<RefCell<D>> {
    fn read(&mut self, index: u16, sub_index: u8) -> Result<Vec<u8>, u32> {
        self.borrow_mut().read(index, sub_index)
    }

    fn write(&mut self, index: u16, sub_index: u8, data: &[u8]) -> Result<(), u32> {
        self.borrow_mut().write(index, sub_index, data)
    }

    fn cycle(&mut self, operational: bool) {
        self.borrow_mut().cycle(operational);
    }

    fn emergencies(&mut self) -> Vec<Emergency> {
        self.borrow_mut().emergencies()
    }
}

/// Gives access to the objects of a simulated device, as its mailbox does.
impl Dictionary for Device {
    fn read(&mut self, index: u16, sub_index: u8) -> Result<Vec<u8>, u32> {
        let object = Object::new(index, sub_index);
        let mut value = vec![0; self.bytes(object).map_or(0, <[u8]>::len)];
        self.client::<CoE>().read(object, &mut value).map_err(abort_code)?;
        Ok(value)
    }

    fn write(&mut self, index: u16, sub_index: u8, data: &[u8]) -> Result<(), u32> {
        self.client::<CoE>().write(Object::new(index, sub_index), data).map_err(abort_code)
    }

    fn emergencies(&mut self) -> Vec<Emergency> {
        self.take_emergencies().collect()
    }
}

fn abort_code(error: Error<Fault>) -> u32 {
    match error {
        Error::Abort(code) => code.0,
        _ => AbortCode::GENERAL.0,
    }
}
