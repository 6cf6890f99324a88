//! F-parameters of PROFIsafe.
//!
//! The checksum F_Par_CRC is a 16-bit CRC with the polynomial 0x4EAB and the initial value 0. The checksum covers
//! F_iPar_CRC first, if the record contains this field, and then the other fields in the order of the record. The
//! layout and the checksum of the record have been checked against the default values in the GSDML files of several
//! vendors.

use crate::value_error::LengthError;

/// Writes bytes at offset `$at` of an array, and increases `$at` by the number of bytes. This macro can be used in
/// `const` functions.
macro_rules! push {
    ($record:ident, $at:ident, $bytes:expr) => {
        let bytes = $bytes;
        let mut next = 0;
        while next < bytes.len() {
            $record[$at] = bytes[next];
            $at += 1;
            next += 1;
        }
    };
}

/// Safety integrity level (F_SIL).
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub enum Sil {
    /// SIL 1.
    Sil1,
    /// SIL 2.
    Sil2,
    /// SIL 3.
    Sil3,
    /// No SIL.
    NoSil,
}

/// Length of the CRC in an F-message trailer (F_CRC_Length).
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub enum FCrcLength {
    /// A CRC of 3 bytes.
    ThreeBytes,
    /// A CRC of 2 bytes, as in the obsolete first version of PROFIsafe.
    TwoBytes,
    /// A CRC of 4 bytes.
    FourBytes,
    /// Reserved value.
    Reserved,
}

/// The unit that is passivated after a fault (F_Passivation).
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub enum FPassivation {
    /// The whole device or module is passivated.
    DeviceOrModule,
    /// Only the affected channel is passivated.
    Channel,
}

/// The F-parameters of a submodule.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub struct FParameters {
    /// F_Check_iPar: whether the checksum of the i-parameters is included in the CRC of messages.
    pub check_i_par: bool,
    /// F_SIL: safety integrity level.
    pub sil: Sil,
    /// F_CRC_Length: length of the CRC in an F-message trailer.
    pub crc_length: FCrcLength,
    /// F_CRC_Seed: false for `CRC-Seed24/32`.
    pub crc_seed: bool,
    /// F_Passivation: unit that is passivated after a fault.
    pub passivation: FPassivation,
    /// F_Block_ID, 0 to 7. Bit 0 is set if the record has F_iPar_CRC. Bit 1 is set if the record has F_WD_Time_2.
    pub block_id: u8,
    /// F_Par_Version, 0 to 3. The value 1 means PROFIsafe V2.
    pub par_version: u8,
    /// F_Source_Add: address of the F-Host.
    pub source_address: u16,
    /// F_Dest_Add: address of the F-Device.
    pub destination_address: u16,
    /// F_WD_Time: watchdog time in ms.
    pub watchdog_time: u16,
    /// F_WD_Time_2: second watchdog time in ms, if the record contains it.
    pub watchdog_time_2: u16,
    /// F_iPar_CRC: checksum of the i-parameters, if the record contains it.
    pub i_par_crc: u32,
}

impl FParameters {
    /// Returns the length of the record in bytes, 10 to 16. The length depends on F_Block_ID.
    #[must_use]
    pub const fn len(&self) -> usize {
        10 + if self.has_i_par_crc() { 4 } else { 0 } + if self.has_watchdog_time_2() { 2 } else { 0 }
    }

    /// Returns false because a record has at least 10 bytes.
    #[must_use]
    pub const fn is_empty(&self) -> bool {
        false
    }

    const fn has_i_par_crc(&self) -> bool {
        self.block_id & 1 != 0
    }

    const fn has_watchdog_time_2(&self) -> bool {
        self.block_id & 2 != 0
    }

    /// Returns F_Prm_Flag1. From bit 1 upwards, F_Prm_Flag1 contains F_Check_iPar, F_SIL, F_CRC_Length and F_CRC_Seed.
    #[must_use]
    pub const fn flag1(&self) -> u8 {
        (self.check_i_par as u8) << 1
            | (self.sil as u8) << 2
            | (self.crc_length as u8) << 4
            | (self.crc_seed as u8) << 6
    }

    /// Returns F_Prm_Flag2. F_Prm_Flag2 contains F_Passivation in bit 0, F_Block_ID in bits 3 to 5, and F_Par_Version
    /// in bits 6 and 7.
    #[must_use]
    pub const fn flag2(&self) -> u8 {
        self.passivation as u8 | (self.block_id & 7) << 3 | (self.par_version & 3) << 6
    }

    /// Returns F_Par_CRC. Returns `None` if the record has F_WD_Time_2, because the position of this field in the
    /// checksum is unknown.
    #[must_use]
    pub const fn crc(&self) -> Option<u16> {
        if self.has_watchdog_time_2() {
            return None;
        }
        let mut crc = 0;
        if self.has_i_par_crc() {
            crc = crc16(crc, &self.i_par_crc.to_be_bytes());
        }
        crc = crc16(crc, &[self.flag1(), self.flag2()]);
        crc = crc16(crc, &self.source_address.to_be_bytes());
        crc = crc16(crc, &self.destination_address.to_be_bytes());
        Some(crc16(crc, &self.watchdog_time.to_be_bytes()))
    }

    /// Writes the record to `data`, with `crc` as F_Par_CRC, and returns the written bytes.
    ///
    /// # Errors
    ///
    /// Returns [`LengthError`] if `data` has fewer than [`FParameters::len`] bytes.
    pub fn encode_with_crc<'b>(&self, crc: u16, data: &'b mut [u8]) -> Result<&'b [u8], LengthError> {
        let (record, len) = self.record(crc);
        super::be::write(data, record.split_at(len).0)
    }

    /// Returns the record in a buffer of the maximum length, and the actual length of the record.
    #[expect(clippy::indexing_slicing, reason = "the record has at most 16 bytes")]
    pub(super) const fn record(&self, crc: u16) -> ([u8; 16], usize) {
        let mut record = [0; 16];
        let mut at = 0;
        push!(record, at, [self.flag1(), self.flag2()]);
        push!(record, at, self.source_address.to_be_bytes());
        push!(record, at, self.destination_address.to_be_bytes());
        push!(record, at, self.watchdog_time.to_be_bytes());
        if self.has_watchdog_time_2() {
            push!(record, at, self.watchdog_time_2.to_be_bytes());
        }
        if self.has_i_par_crc() {
            push!(record, at, self.i_par_crc.to_be_bytes());
        }
        push!(record, at, crc.to_be_bytes());
        (record, at)
    }

    /// Decodes a record. Returns the parameters and F_Par_CRC.
    ///
    /// # Errors
    ///
    /// Returns [`LengthError`] if `data` is shorter than F_Block_ID requires.
    pub fn decode(data: &[u8]) -> Result<(Self, u16), LengthError> {
        let [flag1, flag2] = super::be::bytes(data, 0);
        let word = |at| u16::from_be_bytes(super::be::bytes(data, at));
        let mut parameters = Self::from_flags(flag1, flag2);
        if data.len() < parameters.len() {
            return Err(LengthError::new(parameters.len(), data.len()));
        }
        parameters.source_address = word(2);
        parameters.destination_address = word(4);
        parameters.watchdog_time = word(6);
        let mut at = 8;
        if parameters.has_watchdog_time_2() {
            parameters.watchdog_time_2 = word(at);
            at += 2;
        }
        if parameters.has_i_par_crc() {
            parameters.i_par_crc = u32::from_be_bytes(super::be::bytes(data, at));
            at += 4;
        }
        Ok((parameters, word(at)))
    }

    const fn from_flags(flag1: u8, flag2: u8) -> Self {
        Self {
            check_i_par: flag1 & 2 != 0,
            sil: match flag1 >> 2 & 3 {
                0 => Sil::Sil1,
                1 => Sil::Sil2,
                2 => Sil::Sil3,
                _ => Sil::NoSil,
            },
            crc_length: match flag1 >> 4 & 3 {
                0 => FCrcLength::ThreeBytes,
                1 => FCrcLength::TwoBytes,
                2 => FCrcLength::FourBytes,
                _ => FCrcLength::Reserved,
            },
            crc_seed: flag1 & 0x40 != 0,
            passivation: if flag2 & 1 != 0 { FPassivation::Channel } else { FPassivation::DeviceOrModule },
            block_id: flag2 >> 3 & 7,
            par_version: flag2 >> 6,
            source_address: 0,
            destination_address: 0,
            watchdog_time: 0,
            watchdog_time_2: 0,
            i_par_crc: 0,
        }
    }
}

/// Updates a 16-bit CRC with the polynomial 0x4EAB.
const fn crc16(crc: u16, data: &[u8]) -> u16 {
    crate::crc::crc16(0x4EAB, crc, data)
}

#[cfg(test)]
pub(super) mod tests {
    use super::*;

    pub(in crate::profinet) const DEFAULT: FParameters = FParameters {
        check_i_par: false,
        sil: Sil::Sil3,
        crc_length: FCrcLength::ThreeBytes,
        crc_seed: false,
        passivation: FPassivation::DeviceOrModule,
        block_id: 0,
        par_version: 1,
        source_address: 1,
        destination_address: 1,
        watchdog_time: 150,
        watchdog_time_2: 0,
        i_par_crc: 0,
    };

    #[test]
    fn every_flag_is_read_as_it_is_written() {
        for (flag1, flag2) in (0..=u8::MAX).flat_map(|flag1| (0..=u8::MAX).map(move |flag2| (flag1, flag2))) {
            let parameters = FParameters::from_flags(flag1, flag2);
            // Bits 0 and 7 of the first byte and bits 1 and 2 of the second byte are unused.
            assert_eq!((parameters.flag1(), parameters.flag2()), (flag1 & 0x7E, flag2 & 0xF9));
            let mut data = [0; 16];
            let written = parameters.encode_with_crc(0x1234, &mut data).unwrap();
            assert_eq!((written.len(), parameters.is_empty()), (parameters.len(), false));
            assert_eq!(FParameters::decode(written), Ok((parameters, 0x1234)));
            let short = &written[..written.len() - 1];
            assert_eq!(FParameters::decode(short), Err(LengthError::new(parameters.len(), parameters.len() - 1)));
        }
        assert!(FParameters::decode(&[]).is_err());
    }

    #[test]
    fn checksums() {
        let four = FParameters { crc_length: FCrcLength::FourBytes, ..DEFAULT };
        let sil2 = FParameters { sil: Sil::Sil2, watchdog_time: 100, ..DEFAULT };
        let with_i_par = FParameters { block_id: 1, watchdog_time: 125, i_par_crc: 0x0102_0304, ..DEFAULT };
        for (parameters, crc) in [
            (DEFAULT, 48_021),
            (four, 5_655),
            (sil2, 49_406),
            (FParameters { crc_length: FCrcLength::FourBytes, ..sil2 }, 28_028),
            (with_i_par, 58_082),
            (FParameters { crc_length: FCrcLength::FourBytes, ..with_i_par }, 20_320),
        ] {
            assert_eq!(parameters.crc(), Some(crc), "{parameters:?}");
        }
    }

    #[test]
    fn records() {
        // The bits 2 and 3 are 10, which is SIL 3. The bits 6 and 7 are 01, which is version 1. Source address and
        // destination address are 1. The watchdog time is 150 ms. 48021 is 0xBB95.
        let bytes = [0x08, 0x40, 0x00, 0x01, 0x00, 0x01, 0x00, 0x96, 0xBB, 0x95];
        assert_eq!(FParameters::decode(&bytes), Ok((DEFAULT, 0xBB95)));
        assert_eq!(FParameters::decode(&bytes[..9]), Err(LengthError::new(10, 9)));
        let full = FParameters {
            check_i_par: true,
            sil: Sil::NoSil,
            crc_length: FCrcLength::Reserved,
            crc_seed: true,
            passivation: FPassivation::Channel,
            block_id: 3,
            watchdog_time_2: 0x0203,
            i_par_crc: 0x0405_0607,
            ..DEFAULT
        };
        let mut data = [0; 16];
        let encoded = full.encode_with_crc(0x0809, &mut data).unwrap();
        assert_eq!(encoded, [0x7E, 0x59, 0, 1, 0, 1, 0, 150, 2, 3, 4, 5, 6, 7, 8, 9]);
        assert_eq!(FParameters::decode(encoded), Ok((full, 0x0809)));
        assert_eq!(full.encode_with_crc(0, &mut [0; 15]), Err(LengthError::new(16, 15)));
        assert_eq!(full.crc(), None);
    }
}
