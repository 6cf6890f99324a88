//! The F-parameter record of a submodule, and the allowed values of its fields.

use super::f_parameters::FParameters;
use super::record::{check, NotAllowed};

/// A field of the F-parameter record.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum FField {
    /// F_Check_iPar.
    CheckIPar,
    /// F_SIL.
    Sil,
    /// F_CRC_Length.
    CrcLength,
    /// F_CRC_Seed.
    CrcSeed,
    /// F_Passivation.
    Passivation,
    /// F_Block_ID.
    BlockId,
    /// F_Par_Version.
    ParVersion,
    /// F_Source_Add.
    SourceAddress,
    /// F_Dest_Add.
    DestinationAddress,
    /// F_WD_Time.
    WatchdogTime,
    /// F_WD_Time_2.
    WatchdogTime2,
    /// F_iPar_CRC.
    IParCrc,
}

impl FField {
    /// Returns the name of the field in GSDML.
    #[must_use]
    pub const fn name(self) -> &'static str {
        match self {
            Self::CheckIPar => "F_Check_iPar",
            Self::Sil => "F_SIL",
            Self::CrcLength => "F_CRC_Length",
            Self::CrcSeed => "F_CRC_Seed",
            Self::Passivation => "F_Passivation",
            Self::BlockId => "F_Block_ID",
            Self::ParVersion => "F_Par_Version",
            Self::SourceAddress => "F_Source_Add",
            Self::DestinationAddress => "F_Dest_Add",
            Self::WatchdogTime => "F_WD_Time",
            Self::WatchdogTime2 => "F_WD_Time_2",
            Self::IParCrc => "F_iPar_CRC",
        }
    }
}

/// The allowed values of an F-parameter.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct FLimit {
    /// The F-parameter whose values are limited.
    pub field: FField,
    /// Allowed ranges. Each range consists of its first and last value, encoded as in the record.
    pub allowed: &'static [(u32, u32)],
}

impl FLimit {
    /// Creates the list of allowed values of `field`.
    #[must_use]
    pub const fn new(field: FField, allowed: &'static [(u32, u32)]) -> Self {
        Self { field, allowed }
    }
}

/// The F-parameter record of a submodule, with a length of `LEN` bytes.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct FRecord<const LEN: usize> {
    /// Index of the record.
    pub index: u16,
    /// Position of the record among the start-up records of the submodule; 0 means any position.
    pub transfer_sequence: u16,
    /// Default values of the F-parameters.
    pub default: FParameters,
    /// Allowed values of F-parameters. An F-parameter without an entry may have any value that fits in the record.
    pub limits: &'static [FLimit],
}

impl<const LEN: usize> FRecord<LEN> {
    /// Checks that all parameters have allowed values.
    ///
    /// # Errors
    ///
    /// Returns [`NotAllowed`] for F_Block_ID if the parameters need a record of another length than `LEN`, otherwise
    /// for the first F-parameter whose value isn't allowed.
    pub fn check(&self, parameters: &FParameters) -> Result<(), NotAllowed> {
        if parameters.len() != LEN || parameters.block_id > 7 {
            return Err(NotAllowed { field: FField::BlockId.name() });
        }
        if parameters.par_version > 3 {
            return Err(NotAllowed { field: FField::ParVersion.name() });
        }
        self.limits.iter().try_for_each(|limit| {
            let value = parameters.value(limit.field);
            check(limit.field.name(), value, limit.allowed)
        })
    }

    /// Encodes the record, including F_Par_CRC.
    ///
    /// # Errors
    ///
    /// Returns [`NotAllowed`] if an F-parameter has a value that isn't allowed. Also returns [`NotAllowed`] if the
    /// record has F_WD_Time_2, because the checksum cannot be computed. For a record with F_WD_Time_2, use
    /// [`FParameters::encode_with_crc`].
    pub fn encode(&self, parameters: &FParameters) -> Result<[u8; LEN], NotAllowed> {
        self.check(parameters)?;
        let refused = NotAllowed { field: FField::BlockId.name() };
        let crc = parameters.crc().ok_or(refused)?;
        Ok(Self::bytes(parameters, crc))
    }

    /// Returns the default record, including F_Par_CRC. The CRC is 0 if the record has F_WD_Time_2.
    #[must_use]
    pub const fn default_bytes(&self) -> [u8; LEN] {
        match self.default.crc() {
            Some(crc) => Self::bytes(&self.default, crc),
            None => Self::bytes(&self.default, 0),
        }
    }

    #[expect(clippy::indexing_slicing, reason = "`at` is below `LEN` and the length of the record")]
    const fn bytes(parameters: &FParameters, crc: u16) -> [u8; LEN] {
        let (record, len) = parameters.record(crc);
        let mut data = [0; LEN];
        let mut at = 0;
        while at < len && at < LEN {
            data[at] = record[at];
            at += 1;
        }
        data
    }
}

impl FParameters {
    const fn value(&self, field: FField) -> u32 {
        match field {
            FField::CheckIPar => self.check_i_par as u32,
            FField::Sil => self.sil as u32,
            FField::CrcLength => self.crc_length as u32,
            FField::CrcSeed => self.crc_seed as u32,
            FField::Passivation => self.passivation as u32,
            FField::BlockId => self.block_id as u32,
            FField::ParVersion => self.par_version as u32,
            FField::SourceAddress => self.source_address as u32,
            FField::DestinationAddress => self.destination_address as u32,
            FField::WatchdogTime => self.watchdog_time as u32,
            FField::WatchdogTime2 => self.watchdog_time_2 as u32,
            FField::IParCrc => self.i_par_crc,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::super::f_parameters::tests::DEFAULT;
    use super::super::f_parameters::Sil;
    use super::*;

    const RECORD: FRecord<10> = FRecord {
        index: 0x100,
        transfer_sequence: 0,
        default: DEFAULT,
        limits: &[FLimit::new(FField::Sil, &[(2, 2)]), FLimit::new(FField::WatchdogTime, &[(10, 65_535)])],
    };

    #[test]
    fn the_checksum_is_added() {
        // 48021 = 0xBB95.
        let bytes = [0x08, 0x40, 0x00, 0x01, 0x00, 0x01, 0x00, 0x96, 0xBB, 0x95];
        assert_eq!(RECORD.encode(&DEFAULT), Ok(bytes));
        const BY_DEFAULT: [u8; 10] = RECORD.default_bytes();
        assert_eq!(BY_DEFAULT, bytes);
    }

    #[test]
    fn limits() {
        let refused = |field| Err(NotAllowed { field });
        assert_eq!(RECORD.encode(&FParameters { watchdog_time: 9, ..DEFAULT }), refused("F_WD_Time"));
        assert_eq!(RECORD.encode(&FParameters { sil: Sil::Sil1, ..DEFAULT }), refused("F_SIL"));
        assert_eq!(RECORD.encode(&FParameters { block_id: 1, ..DEFAULT }), refused("F_Block_ID"));
        assert_eq!(RECORD.encode(&FParameters { block_id: 8, ..DEFAULT }), refused("F_Block_ID"));
        assert_eq!(RECORD.encode(&FParameters { par_version: 4, ..DEFAULT }), refused("F_Par_Version"));
    }
}
