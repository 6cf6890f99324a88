//! Channel diagnosis (ChannelDiagnosisData, ExtChannelDiagnosisData and QualifiedChannelDiagnosisData of IEC
//! 61158-6-10).

use super::be::bytes;

/// Description of a channel error type.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct ChannelError {
    /// Application process identifier (API) of the profile that defines the error type; 0 if no profile defines it.
    pub api: u32,
    /// Channel error type.
    pub error_type: u16,
    /// Name of the error; may be empty.
    pub name: &'static str,
    /// Cause of the error and remedy; may be empty.
    pub help: &'static str,
    /// Descriptions of the extended error types, sorted by error type.
    pub extended: &'static [ExtendedError],
}

/// Description of an extended channel error type.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct ExtendedError {
    /// Extended channel error type.
    pub error_type: u16,
    /// Name of the error.
    pub name: &'static str,
    /// Cause of the error and remedy; may be empty.
    pub help: &'static str,
}

impl ChannelError {
    /// Creates the description of a channel error type that no profile defines.
    #[must_use]
    pub const fn new(
        error_type: u16,
        name: &'static str,
        help: &'static str,
        extended: &'static [ExtendedError],
    ) -> Self {
        Self::of_profile(0, error_type, name, help, extended)
    }

    /// Creates the description of a channel error type that the profile with this application process identifier (API)
    /// defines.
    #[must_use]
    pub const fn of_profile(
        api: u32,
        error_type: u16,
        name: &'static str,
        help: &'static str,
        extended: &'static [ExtendedError],
    ) -> Self {
        Self { api, error_type, name, help, extended }
    }

    /// Returns the description of an error type in a submodule with this application process identifier (API).
    ///
    /// An error type of the profile takes precedence over an error type without a profile. `errors` must be sorted by
    /// API and error type.
    #[must_use]
    pub fn find(errors: &'static [ChannelError], api: u32, error_type: u16) -> Option<&'static ChannelError> {
        let find = |api| {
            let at = errors.binary_search_by_key(&(api, error_type), |error| (error.api, error.error_type)).ok()?;
            errors.get(at)
        };
        find(api).or_else(|| find(0))
    }

    /// Returns the description of an extended error type.
    #[must_use]
    pub fn extended(&self, error_type: u16) -> Option<&'static ExtendedError> {
        let at = self.extended.binary_search_by_key(&error_type, |error| error.error_type).ok()?;
        self.extended.get(at)
    }
}

impl ExtendedError {
    /// Creates the description of an extended error type.
    #[must_use]
    pub const fn new(error_type: u16, name: &'static str, help: &'static str) -> Self {
        Self { error_type, name, help }
    }
}

/// The structure of a diagnosis block (UserStructureIdentifier).
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum UserStructure {
    /// Vendor-specific structure: 0x0000 to 0x7FFF.
    Manufacturer(u16),
    /// Channel diagnosis: 0x8000, 6 bytes per channel.
    Channel,
    /// Extended channel diagnosis: 0x8002, 12 bytes per channel.
    ExtendedChannel,
    /// Qualified channel diagnosis: 0x8003, 16 bytes per channel.
    QualifiedChannel,
    /// Any other structure, which is reserved or defined by a profile.
    Other(u16),
}

impl UserStructure {
    /// Returns the structure with this identifier.
    #[must_use]
    pub const fn from_identifier(identifier: u16) -> Self {
        match identifier {
            0x8000 => Self::Channel,
            0x8002 => Self::ExtendedChannel,
            0x8003 => Self::QualifiedChannel,
            0..=0x7FFF => Self::Manufacturer(identifier),
            _ => Self::Other(identifier),
        }
    }

    /// Returns the length of one channel's diagnosis in bytes. Returns `None` if the structure has no channels.
    #[must_use]
    pub const fn channel_len(self) -> Option<usize> {
        match self {
            Self::Channel => Some(6),
            Self::ExtendedChannel => Some(12),
            Self::QualifiedChannel => Some(16),
            Self::Manufacturer(_) | Self::Other(_) => None,
        }
    }
}

/// Diagnosis of one channel.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub struct ChannelDiagnosis {
    /// Channel number, 0 to 0x7FFF, or 0x8000 for the whole submodule.
    pub channel: u16,
    /// Properties of the channel and of the diagnosis.
    pub properties: ChannelProperties,
    /// Channel error type.
    pub error_type: u16,
    /// Extended part; `None` unless the diagnosis is an extended or qualified channel diagnosis.
    pub extended: Option<ExtendedDiagnosis>,
}

/// The extended part of a channel diagnosis.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub struct ExtendedDiagnosis {
    /// Extended channel error type.
    pub error_type: u16,
    /// Additional value. The meaning of the value depends on the error.
    pub add_value: u32,
    /// Qualifier with one bit per severity, in qualified channel diagnosis.
    pub qualifier: Option<u32>,
}

impl ChannelDiagnosis {
    /// Returns an iterator over the diagnoses of a block. An incomplete diagnosis at the end of `data` is ignored. The
    /// iterator is empty if the structure has no channels.
    #[must_use]
    pub const fn decode(structure: UserStructure, data: &[u8]) -> ChannelDiagnoses<'_> {
        ChannelDiagnoses { structure, data }
    }
}

/// An iterator over the diagnoses of a block.
#[derive(Clone, Debug)]
pub struct ChannelDiagnoses<'d> {
    structure: UserStructure,
    data: &'d [u8],
}

impl Iterator for ChannelDiagnoses<'_> {
    type Item = ChannelDiagnosis;

    fn next(&mut self) -> Option<ChannelDiagnosis> {
        let (entry, rest) = self.data.split_at_checked(self.structure.channel_len()?)?;
        self.data = rest;
        let word = |at| u16::from_be_bytes(bytes(entry, at));
        let double = |at| u32::from_be_bytes(bytes(entry, at));
        let extended = (entry.len() > 6).then(|| ExtendedDiagnosis {
            error_type: word(6),
            add_value: double(8),
            qualifier: (entry.len() > 12).then(|| double(12)),
        });
        Some(ChannelDiagnosis {
            channel: word(0),
            properties: ChannelProperties(word(2)),
            error_type: word(4),
            extended,
        })
    }
}

/// Properties of a channel and its diagnosis (ChannelProperties).
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub struct ChannelProperties(pub u16);

impl ChannelProperties {
    /// Returns the width of the channel, 1 to 64 bits, which is encoded in bits 0 to 7. Returns `None` if the width is
    /// unspecified or reserved, or if the diagnosis is for the whole submodule.
    #[must_use]
    pub const fn bits(self) -> Option<u8> {
        match self.0 & 0xFF {
            kind @ 1..=7 => Some(1 << (kind - 1)),
            _ => None,
        }
    }

    /// Returns whether the diagnosis is for a group of channels (bit 8).
    #[must_use]
    pub const fn is_accumulative(self) -> bool {
        self.0 & 0x0100 != 0
    }

    /// Returns the severity (bits 9 and 10).
    #[must_use]
    pub const fn maintenance(self) -> Maintenance {
        match self.0 >> 9 & 3 {
            0 => Maintenance::Fault,
            1 => Maintenance::Required,
            2 => Maintenance::Demanded,
            _ => Maintenance::Qualified,
        }
    }

    /// Returns the change that the diagnosis reports (bits 11 and 12).
    #[must_use]
    pub const fn specifier(self) -> ChannelSpecifier {
        match self.0 >> 11 & 3 {
            0 => ChannelSpecifier::AllDisappear,
            1 => ChannelSpecifier::Appears,
            2 => ChannelSpecifier::Disappears,
            _ => ChannelSpecifier::DisappearsOthersRemain,
        }
    }

    /// Returns the direction of the channel (bits 13 to 15).
    #[must_use]
    pub const fn direction(self) -> ChannelDirection {
        match self.0 >> 13 {
            0 => ChannelDirection::Manufacturer,
            1 => ChannelDirection::Input,
            2 => ChannelDirection::Output,
            3 => ChannelDirection::Both,
            other => ChannelDirection::Reserved(other as u8),
        }
    }
}

/// Severity of a diagnosis.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Maintenance {
    /// A fault.
    Fault,
    /// Maintenance is required.
    Required,
    /// Maintenance is demanded. This severity is more urgent than [`Required`](Self::Required).
    Demanded,
    /// The qualifier states the severity.
    Qualified,
}

/// Change that a diagnosis reports: the diagnosis appears or disappears.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum ChannelSpecifier {
    /// All diagnoses of the channel disappear.
    AllDisappear,
    /// The diagnosis appears.
    Appears,
    /// The diagnosis disappears, and no other diagnosis remains on the channel.
    Disappears,
    /// The diagnosis disappears, and other diagnoses remain on the channel.
    DisappearsOthersRemain,
}

/// Direction of a channel.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum ChannelDirection {
    /// Vendor-specific direction.
    Manufacturer,
    /// The channel is an input.
    Input,
    /// The channel is an output.
    Output,
    /// The channel is both an input and an output.
    Both,
    /// Reserved value.
    Reserved(u8),
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::vec::Vec;

    static ERRORS: [ChannelError; 2] = [
        ChannelError::new(
            0x10,
            "Supply",
            "",
            &[ExtendedError::new(1, "Low", "Check the fuse"), ExtendedError::new(5, "High", "")],
        ),
        ChannelError::new(0x1A, "Output", "", &[]),
    ];

    #[test]
    fn errors_are_found_by_type() {
        let supply = ChannelError::find(&ERRORS, 0, 0x10).unwrap();
        assert_eq!(supply.extended(1).map(|error| error.help), Some("Check the fuse"));
        assert_eq!((supply.name, supply.extended(2)), ("Supply", None));
        assert_eq!(ChannelError::find(&ERRORS, 0, 0x11), None);
    }

    #[test]
    fn plain_diagnosis() {
        // A diagnosis of channel 4 appears. The channel is an input of 8 bits, and the error type is 1. An incomplete
        // diagnosis follows.
        let data = [0x00, 0x04, 0x28, 0x04, 0x00, 0x01, 0xFF];
        let all: Vec<_> = ChannelDiagnosis::decode(UserStructure::Channel, &data).collect();
        assert_eq!(all.len(), 1);
        let properties = all[0].properties;
        assert_eq!((all[0].channel, all[0].error_type, all[0].extended), (4, 1, None));
        assert_eq!((properties.bits(), properties.is_accumulative()), (Some(8), false));
        assert_eq!(properties.maintenance(), Maintenance::Fault);
        assert_eq!(properties.specifier(), ChannelSpecifier::Appears);
        assert_eq!(properties.direction(), ChannelDirection::Input);
    }

    #[test]
    fn every_bit_of_properties_means_something() {
        for word in 0..=u16::MAX {
            let properties = ChannelProperties(word);
            let maintenance = match properties.maintenance() {
                Maintenance::Fault => 0,
                Maintenance::Required => 1,
                Maintenance::Demanded => 2,
                Maintenance::Qualified => 3,
            };
            let specifier = match properties.specifier() {
                ChannelSpecifier::AllDisappear => 0,
                ChannelSpecifier::Appears => 1,
                ChannelSpecifier::Disappears => 2,
                ChannelSpecifier::DisappearsOthersRemain => 3,
            };
            let direction = match properties.direction() {
                ChannelDirection::Manufacturer => 0,
                ChannelDirection::Input => 1,
                ChannelDirection::Output => 2,
                ChannelDirection::Both => 3,
                ChannelDirection::Reserved(other) => u16::from(other),
            };
            let high = u16::from(properties.is_accumulative()) | maintenance << 1 | specifier << 3 | direction << 5;
            assert_eq!(high, word >> 8);
            let bits = [None, Some(1), Some(2), Some(4), Some(8), Some(16), Some(32), Some(64)];
            assert_eq!(properties.bits(), bits.get(usize::from(word & 0xFF)).copied().flatten());
        }
    }

    #[test]
    fn structures_and_their_lengths() {
        let lengths = [0x7FFF, 0x8000, 0x8001, 0x8002, 0x8003, 0xFFFF]
            .map(|identifier| UserStructure::from_identifier(identifier).channel_len());
        assert_eq!(lengths, [None, Some(6), None, Some(12), Some(16), None]);
        let diagnosis = ChannelDiagnosis::decode(UserStructure::Manufacturer(1), &[0; 32]);
        assert_eq!(diagnosis.count(), 0);
    }

    #[test]
    fn errors_of_a_profile_come_before_those_of_all() {
        static ERRORS: [ChannelError; 2] =
            [ChannelError::new(0x10, "Supply", "", &[]), ChannelError::of_profile(0x3A00, 0x10, "Drive", "", &[])];
        let name = |api| ChannelError::find(&ERRORS, api, 0x10).map(|error| error.name);
        assert_eq!([name(0), name(0x3A00), name(0x5000)], [Some("Supply"), Some("Drive"), Some("Supply")]);
    }

    #[test]
    fn extended_and_qualified_diagnosis() {
        let data = [0x80, 0x00, 0xF7, 0x00, 0x80, 0x02, 0x00, 0x03, 1, 2, 3, 4, 5, 6, 7, 8];
        let extended = ExtendedDiagnosis { error_type: 3, add_value: 0x0102_0304, qualifier: None };
        let first = ChannelDiagnosis::decode(UserStructure::ExtendedChannel, &data).next().unwrap();
        assert_eq!((first.channel, first.extended), (0x8000, Some(extended)));
        let properties = first.properties;
        assert_eq!((properties.bits(), properties.is_accumulative()), (None, true));
        assert_eq!(properties.maintenance(), Maintenance::Qualified);
        assert_eq!(properties.specifier(), ChannelSpecifier::Disappears);
        assert_eq!(properties.direction(), ChannelDirection::Reserved(7));
        let qualified = ChannelDiagnosis::decode(UserStructure::from_identifier(0x8003), &data).next().unwrap();
        assert_eq!(qualified.extended, Some(ExtendedDiagnosis { qualifier: Some(0x0506_0708), ..extended }));
    }

    #[test]
    fn structures() {
        assert_eq!(UserStructure::from_identifier(0x8002), UserStructure::ExtendedChannel);
        assert_eq!(UserStructure::from_identifier(0x10), UserStructure::Manufacturer(0x10));
        assert_eq!(UserStructure::from_identifier(0x8001), UserStructure::Other(0x8001));
        assert_eq!(ChannelDiagnosis::decode(UserStructure::Manufacturer(1), &[0; 20]).count(), 0);
    }
}
