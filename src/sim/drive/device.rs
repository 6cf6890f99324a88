//! Drives of a simulated device.

use std::boxed::Box;
use std::vec::Vec;

use super::super::behavior::Behavior;
use super::super::device::{Device, DeviceAxis};
use super::objects::Objects;
use super::Drive;
use crate::abort::AbortCode;

impl Device {
    /// Returns the device after power-on, with the behavior of CiA 402 for each axis that has a controlword (0x6040)
    /// and a statusword (0x6041).
    ///
    /// The drive has the state machine, halt, quick stop, [faults](Self::fail), and modes 1 (profile position), 2
    /// (velocity), 3 (profile velocity), 4 (profile torque), 6 (homing), 7 (interpolated position), and 8 to 11 (cyclic
    /// synchronous position, velocity, torque, and torque with commutation angle). The axis accelerates and decelerates
    /// on ramps. The drive accesses all objects by index, so it works on every bus and with process data. If the table
    /// lacks an object, its default value applies. The drive doesn't activate a mode if object 0x6502 excludes the
    /// mode, or if the table lacks the target object of the mode, for example 0x607A in modes 1 and 8.
    ///
    /// The drive executes the controlword at once. Everything else happens when the simulated time advances
    /// ([`step`](Self::step)), for example motion, the change of the mode, and the transition after power-on. If the
    /// test changes the actual position (0x6064), the axis continues from this position. The drive doesn't change bits
    /// 7, 8, 14 and 15 of the statusword, which the test can set.
    ///
    /// ```
    /// use core::time::Duration;
    ///
    /// use lexibus::sim::Device;
    /// use lexibus::CanOpen;
    /// use lexibus_drives::demo_drive::types::{Controlword, State};
    /// use lexibus_drives::demo_drive::{objects, DemoDrive, ENTRIES};
    ///
    /// # fn main() -> Result<(), Box<dyn std::error::Error>> {
    /// let mut device = Device::new(ENTRIES).with_cia402();
    /// // The driver under test. Its waiting advances the simulated time.
    /// let mut drive = DemoDrive::new(device.client::<CanOpen>());
    /// drive.walk(State::OperationEnabled, Duration::from_secs(1))?;
    /// drive.target_position().write(500)?;
    /// drive.controlword().write(Controlword::from_raw(0x1F))?;
    /// assert!(drive.statusword().read()?.in_profile_position().set_point_acknowledge());
    ///
    /// device.step(Duration::from_secs(1));
    /// assert_eq!(device.get(objects::POSITION_ACTUAL_VALUE)?, 500);
    /// assert!(device.get(objects::STATUSWORD)?.target_reached());
    /// # Ok(())
    /// # }
    /// ```
    ///
    /// Velocities are in position units per second, and accelerations in position units per second squared, even if the
    /// device description declares other units. Homing takes 100 ms, and the current position becomes the home
    /// position. In mode 7, the drive moves to the newest data record (0x60C1:01) within the interpolation period, and
    /// has no buffer for data records. Mode 11 ignores the commutation angle. The drive doesn't simulate gears,
    /// polarity, switches, other modes, or the loss of the connection.
    #[must_use]
    pub fn with_cia402(mut self) -> Self {
        self.has_cia402 = true;
        self.power_cycle();
        self
    }

    /// Simulates a drive fault whose cause is already gone. The drive stops with the fault reaction (0x605E), and then
    /// enters the state "Fault". `code` becomes the error code (0x603F), and is reported in the error list (0x1003) and
    /// in an emergency message.
    ///
    /// # Errors
    ///
    /// Returns [`AbortCode::NO_OBJECT`] if the axis isn't a [simulated drive](Self::with_cia402).
    pub fn fail(&mut self, code: u16) -> Result<(), AbortCode> {
        self.axis(1).fail(code)
    }

    /// Simulates a fault like [`fail`](Self::fail), but the cause of the fault persists. A fault reset has no effect
    /// until [`clear_cause`](Self::clear_cause).
    ///
    /// # Errors
    ///
    /// Returns the errors of [`fail`](Self::fail).
    pub fn fail_persistently(&mut self, code: u16) -> Result<(), AbortCode> {
        self.axis(1).fail_persistently(code)
    }

    /// Removes the cause of a [persistent fault](Self::fail_persistently). The fault remains until the controller
    /// resets it.
    ///
    /// # Errors
    ///
    /// Returns the errors of [`fail`](Self::fail).
    pub fn clear_cause(&mut self) -> Result<(), AbortCode> {
        self.axis(1).clear_cause()
    }

    /// Declares initial values for the objects of the drives, before power-on.
    pub(in super::super) fn declare_drive_defaults(&mut self) {
        for axis in self.drive_axes() {
            Objects { device: self, axis }.declare_defaults();
        }
    }

    /// Creates the drives after power-on.
    pub(in super::super) fn start_drives(&mut self) {
        self.drives.clear();
        for axis in self.drive_axes() {
            let drive = Drive::new(axis, &mut Objects { device: self, axis });
            self.drives.push(Box::new(drive));
        }
        self.is_settled = !self.has_cia402;
    }

    fn drive_axes(&mut self) -> Vec<u8> {
        let count = if self.has_cia402 { self.axis_count() } else { 0 };
        let is_drive = |axis: &u8| {
            let objects = Objects { device: self, axis: *axis };
            objects.has(0x6040) && objects.has(0x6041)
        };
        (1..=count).filter(is_drive).collect()
    }

    /// Executes `action` with each drive.
    fn for_each_drive(&mut self, mut action: impl FnMut(&mut dyn Behavior, &mut Device)) {
        let mut drives = core::mem::take(&mut self.drives);
        for drive in &mut drives {
            action(drive.as_mut(), self);
        }
        self.drives = drives;
    }

    /// Executes one step of all drives.
    pub(in super::super) fn step_drives(&mut self) {
        self.is_settled = true;
        let mut is_changed = false;
        self.for_each_drive(|drive, device| is_changed |= drive.step(device));
        // A change of an object clears `is_settled`.
        self.is_settled &= !is_changed;
    }

    /// Lets all drives react to a write.
    pub(in super::super) fn observe_drives(&mut self) {
        if !self.drives.is_empty() {
            self.is_settled = false;
            self.for_each_drive(|drive, device| drive.observe(device));
        }
    }
}

impl Behavior for Drive {
    fn axis(&self) -> u8 {
        self.axis
    }

    fn step(&mut self, device: &mut Device) -> bool {
        let before = self.clone();
        let axis = self.axis;
        self.advance(&mut Objects { device, axis });
        before != *self
    }

    fn observe(&mut self, device: &mut Device) {
        let axis = self.axis;
        self.react(&mut Objects { device, axis });
    }

    fn fail(&mut self, code: u16, persists: bool, device: &mut Device) {
        let axis = self.axis;
        self.enter_fault(code, persists, &mut Objects { device, axis });
    }

    fn clear_cause(&mut self) {
        self.has_cause = false;
    }
}

impl DeviceAxis<'_> {
    /// Simulates a fault of the axis, as [`Device::fail`] does.
    ///
    /// # Errors
    ///
    /// Returns the errors of [`Device::fail`].
    pub fn fail(&mut self, code: u16) -> Result<(), AbortCode> {
        self.with_drive(|drive, device| drive.fail(code, false, device))
    }

    /// Simulates a fault whose cause persists, as [`Device::fail_persistently`] does.
    ///
    /// # Errors
    ///
    /// Returns the errors of [`Device::fail`].
    pub fn fail_persistently(&mut self, code: u16) -> Result<(), AbortCode> {
        self.with_drive(|drive, device| drive.fail(code, true, device))
    }

    /// Removes the cause of a persistent fault, as [`Device::clear_cause`] does.
    ///
    /// # Errors
    ///
    /// Returns the errors of [`Device::fail`].
    pub fn clear_cause(&mut self) -> Result<(), AbortCode> {
        self.with_drive(|drive, _| drive.clear_cause())
    }

    fn with_drive(&mut self, action: impl Fn(&mut dyn Behavior, &mut Device)) -> Result<(), AbortCode> {
        let (mut is_found, number) = (false, self.number());
        let device = self.device();
        device.is_settled = !device.has_cia402;
        device.for_each_drive(|drive, device| {
            if drive.axis() == number {
                is_found = true;
                action(drive, device);
            }
        });
        if is_found {
            Ok(())
        } else {
            Err(AbortCode::NO_OBJECT)
        }
    }
}
