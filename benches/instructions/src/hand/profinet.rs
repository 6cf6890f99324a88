//! Handwritten structs for PROFINET process data.

use super::{frame, part};
use lexibus::LengthError;

/// Inputs of PROFIdrive's standard telegram 3. The fields are big-endian, and some are single bits.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Inputs {
    /// Bit 9 of ZSW1.
    pub control_requested: bool,
    /// Bit 0 of ZSW1.
    pub ready_to_switch_on: bool,
    /// Bit 2 of ZSW1.
    pub operation_enabled: bool,
    /// Bit 3 of ZSW1.
    pub fault: bool,
    /// NIST_B.
    pub speed: i32,
    /// ZSW2.
    pub status_2: u16,
    /// G1_ZSW.
    pub encoder_status: u16,
    /// G1_XIST1.
    pub position_1: u32,
    /// G1_XIST2.
    pub position_2: u32,
}

impl Inputs {
    /// Returns the bytes of the user data.
    #[inline]
    pub fn pack(&self) -> [u8; 18] {
        let mut data = [0; 18];
        data[0] = u8::from(self.control_requested) << 1;
        data[1] = u8::from(self.ready_to_switch_on) | u8::from(self.operation_enabled) << 2 | u8::from(self.fault) << 3;
        data[2..6].copy_from_slice(&self.speed.to_be_bytes());
        data[6..8].copy_from_slice(&self.status_2.to_be_bytes());
        data[8..10].copy_from_slice(&self.encoder_status.to_be_bytes());
        data[10..14].copy_from_slice(&self.position_1.to_be_bytes());
        data[14..18].copy_from_slice(&self.position_2.to_be_bytes());
        data
    }

    /// Reads the fields of the user data.
    ///
    /// # Errors
    ///
    /// Returns an error if the user data is too short.
    #[inline]
    pub fn unpack(data: &[u8]) -> Result<Self, LengthError> {
        let data: &[u8; 18] = frame(data)?;
        Ok(Self {
            control_requested: data[0] & 2 != 0,
            ready_to_switch_on: data[1] & 1 != 0,
            operation_enabled: data[1] & 4 != 0,
            fault: data[1] & 8 != 0,
            speed: i32::from_be_bytes(part(data, 2)),
            status_2: u16::from_be_bytes(part(data, 6)),
            encoder_status: u16::from_be_bytes(part(data, 8)),
            position_1: u32::from_be_bytes(part(data, 10)),
            position_2: u32::from_be_bytes(part(data, 14)),
        })
    }
}

/// Outputs of PROFIdrive's standard telegram 3.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Outputs {
    /// Bit 10 of STW1.
    pub control_by_plc: bool,
    /// Bit 0 of STW1.
    pub on: bool,
    /// Bit 1 of STW1.
    pub no_coast_stop: bool,
    /// Bit 2 of STW1.
    pub no_quick_stop: bool,
    /// Bit 3 of STW1.
    pub enable_operation: bool,
    /// Bit 4 of STW1.
    pub enable_ramp: bool,
    /// Bit 5 of STW1.
    pub unfreeze_ramp: bool,
    /// Bit 6 of STW1.
    pub enable_set_point: bool,
    /// NSOLL_B.
    pub speed: i32,
    /// STW2.
    pub control_2: u16,
    /// G1_STW.
    pub encoder_control: u16,
}

impl Outputs {
    /// Returns the bytes of the user data.
    #[inline]
    pub fn pack(&self) -> [u8; 10] {
        let mut data = [0; 10];
        data[0] = u8::from(self.control_by_plc) << 2;
        data[1] = u8::from(self.on)
            | u8::from(self.no_coast_stop) << 1
            | u8::from(self.no_quick_stop) << 2
            | u8::from(self.enable_operation) << 3
            | u8::from(self.enable_ramp) << 4
            | u8::from(self.unfreeze_ramp) << 5
            | u8::from(self.enable_set_point) << 6;
        data[2..6].copy_from_slice(&self.speed.to_be_bytes());
        data[6..8].copy_from_slice(&self.control_2.to_be_bytes());
        data[8..10].copy_from_slice(&self.encoder_control.to_be_bytes());
        data
    }

    /// Reads the fields of the user data.
    ///
    /// # Errors
    ///
    /// Returns an error if the user data is too short.
    #[inline]
    pub fn unpack(data: &[u8]) -> Result<Self, LengthError> {
        let data: &[u8; 10] = frame(data)?;
        Ok(Self {
            control_by_plc: data[0] & 4 != 0,
            on: data[1] & 1 != 0,
            no_coast_stop: data[1] & 2 != 0,
            no_quick_stop: data[1] & 4 != 0,
            enable_operation: data[1] & 8 != 0,
            enable_ramp: data[1] & 0x10 != 0,
            unfreeze_ramp: data[1] & 0x20 != 0,
            enable_set_point: data[1] & 0x40 != 0,
            speed: i32::from_be_bytes(part(data, 2)),
            control_2: u16::from_be_bytes(part(data, 6)),
            encoder_control: u16::from_be_bytes(part(data, 8)),
        })
    }
}
