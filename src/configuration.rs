//! Configuration of a device: the values of a DCF or XDC, in the order in which a device accepts them.

mod apply;
mod concise;
#[cfg(test)]
mod testing;
mod verify;

pub use apply::{ApplyError, Progress};
pub use verify::Difference;

use core::fmt;

use crate::bus::Object;
use crate::node_id::NodeId;
use crate::pdo::SdoWrite;

/// The configured values of a device. The compiler generates the constant `CONFIGURATION` for a description with
/// configured values: `ParameterValue` of a DCF (CiA 306), `actualValue` of an XDC (CiA 311).
///
/// - [`apply`](Self::apply) writes the values and reports the progress.
/// - [`verify`](Self::verify) reads the values back and reports each difference.
/// - [`concise_dcf`](Self::concise_dcf) encodes the values for the object 0x1F22 of a CANopen manager (CiA 302-3).
/// - [`writes`](Self::writes) returns the writes for any other purpose. [`of`](Self::of) returns the write of one object.
///
/// The writes are grouped in [phases](Phase). While a PDO is disabled, the device accepts changes to the mapping and
/// the communication parameters of the PDO (CiA 301 7.5.2.36 and 7.5.2.38). The first phase therefore disables the PDOs
/// that the configuration changes. The configuration of a node of a network file consists of the phase
/// [`Phase::Network`], whose writes have the order of the concise DCF of the node.
///
/// ```
/// use lexibus::{Configuration, NodeId, SdoWrite, Setting};
///
/// // The compiler generates this for the COB-ID and the transmission type of RPDO 1:
/// const CONFIGURATION: Configuration = Configuration {
///     disable_pdos: &[Setting::from_node(SdoWrite::new_u32(0x1400, 0x01, 0x8000_0200))],
///     pdo_parameters: &[Setting::fixed(SdoWrite::new_u8(0x1400, 0x02, 1))],
///     enable_pdos: &[Setting::from_node(SdoWrite::new_u32(0x1400, 0x01, 0x200))],
///     ..Configuration::EMPTY
/// };
///
/// let node_id = NodeId::new(5).unwrap();
/// let writes: Vec<String> = CONFIGURATION.writes(node_id).map(|write| write.to_string()).collect();
/// assert_eq!(writes, ["0x1400:01 = 0x80000205", "0x1400:02 = 0x01", "0x1400:01 = 0x00000205"]);
/// ```
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Configuration {
    /// COB-IDs of the PDOs that the configuration changes, with bit 31 set (PDO disabled).
    pub disable_pdos: &'static [Setting],
    /// Values of objects 0x1000 to 0x1FFF, except those of PDOs.
    pub communication: &'static [Setting],
    /// All other objects.
    pub parameters: &'static [Setting],
    /// Mapping of each PDO: sub-index 0 with the value 0, the entries, and sub-index 0 with the number of entries.
    pub mapping: &'static [Setting],
    /// Transmission types, inhibit times, event timers and SYNC start values of PDOs.
    pub pdo_parameters: &'static [Setting],
    /// COB-IDs of the PDOs that the configuration enables at the end.
    pub enable_pdos: &'static [Setting],
    /// Values of a node of a network file, of all kinds, in the order of the concise DCF of the node. None of them is
    /// marked as equal to the default.
    pub network: &'static [Setting],
    /// True if the configuration leaves out values that are equal to the default value in the description. See
    /// [`without_defaults`](Self::without_defaults).
    pub skip_defaults: bool,
}

/// A value that the configuration writes to an object.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Setting {
    write: SdoWrite,
    add_node_id: bool,
    is_default: bool,
    is_write_only: bool,
}

impl Setting {
    /// Creates a setting whose value doesn't depend on the node-ID.
    #[must_use]
    pub const fn fixed(write: SdoWrite) -> Self {
        Self { write, add_node_id: false, is_default: false, is_write_only: false }
    }

    /// Creates a setting whose value is the sum of the value in `write` and the node-ID.
    #[must_use]
    pub const fn from_node(write: SdoWrite) -> Self {
        Self { add_node_id: true, ..Self::fixed(write) }
    }

    /// Creates a [fixed](Self::fixed) setting that is [equal to the default](Self::is_default).
    #[must_use]
    pub const fn fixed_default(write: SdoWrite) -> Self {
        Self { is_default: true, ..Self::fixed(write) }
    }

    /// Creates a setting [with the node-ID](Self::from_node) that is [equal to the default](Self::is_default).
    #[must_use]
    pub const fn from_node_default(write: SdoWrite) -> Self {
        Self { is_default: true, ..Self::from_node(write) }
    }

    /// Returns the setting, marked as that of a write-only object. [`Configuration::verify`] skips this object.
    #[must_use]
    pub const fn write_only(self) -> Self {
        Self { is_write_only: true, ..self }
    }

    /// Returns the write for the device with this node-ID. If the setting adds the node-ID, the sum wraps around at the
    /// length of the value.
    #[must_use]
    pub const fn resolve(&self, node_id: NodeId) -> SdoWrite {
        if self.add_node_id {
            self.write.plus_node_id(node_id)
        } else {
            self.write
        }
    }

    /// Returns whether the setting changes nothing in a device with the default values of the description. A setting
    /// that disables or enables a PDO changes nothing if all settings of the PDO are equal to the default. A setting
    /// that clears a mapping changes nothing if all settings of the mapping are equal to the default.
    #[must_use]
    pub const fn is_default(&self) -> bool {
        self.is_default
    }
}

/// A phase of a configuration: a group of writes of the same kind. The phases are in the order of their execution.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub enum Phase {
    /// Disables PDOs.
    DisablePdos,
    /// Writes communication parameters, except those of PDOs.
    Communication,
    /// Writes parameters of the application.
    Parameters,
    /// Maps objects into PDOs.
    Mapping,
    /// Writes parameters of PDOs.
    PdoParameters,
    /// Enables PDOs.
    EnablePdos,
    /// Writes the values of a network file, of all kinds.
    Network,
}

impl fmt::Display for Phase {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(match self {
            Self::DisablePdos => "disable PDOs",
            Self::Communication => "communication parameters",
            Self::Parameters => "parameters",
            Self::Mapping => "PDO mapping",
            Self::PdoParameters => "PDO parameters",
            Self::EnablePdos => "enable PDOs",
            Self::Network => "network configuration",
        })
    }
}

impl Configuration {
    /// A configuration without values.
    pub const EMPTY: Self = Self {
        disable_pdos: &[],
        communication: &[],
        parameters: &[],
        mapping: &[],
        pdo_parameters: &[],
        enable_pdos: &[],
        network: &[],
        skip_defaults: false,
    };

    /// Returns the configuration without the values that are equal to the default value of the description. The
    /// configuration doesn't disable PDOs whose values are all equal to the default.
    ///
    /// Use this configuration only for a device that has its default values, for example after a restore command
    /// (0x1011). A device with other stored values keeps the values that this configuration doesn't write.
    #[must_use]
    pub const fn without_defaults(self) -> Self {
        Self { skip_defaults: true, ..self }
    }

    /// Returns the writes that configure the device with this node-ID, in order.
    pub fn writes(self, node_id: NodeId) -> impl Iterator<Item = SdoWrite> {
        self.settings().map(move |(_, setting)| setting.resolve(node_id))
    }

    /// Returns the write that sets the final value of an object on the device with this node-ID. Returns `None` if the
    /// configuration doesn't write the object.
    #[must_use]
    pub fn of(self, object: Object, node_id: NodeId) -> Option<SdoWrite> {
        self.writes(node_id).filter(|write| write.object() == object).last()
    }

    /// Returns the length in bytes of the longest value.
    #[must_use]
    pub const fn longest_value(&self) -> usize {
        let all = self.phases();
        let (mut longest, mut phases) = (0, all.as_slice());
        while let [(_, settings), rest @ ..] = phases {
            let mut settings = *settings;
            while let [setting, rest @ ..] = settings {
                let length = setting.write.data().len();
                if length > longest {
                    longest = length;
                }
                settings = rest;
            }
            phases = rest;
        }
        longest
    }

    const fn phases(&self) -> [(Phase, &'static [Setting]); 7] {
        [
            (Phase::DisablePdos, self.disable_pdos),
            (Phase::Communication, self.communication),
            (Phase::Parameters, self.parameters),
            (Phase::Mapping, self.mapping),
            (Phase::PdoParameters, self.pdo_parameters),
            (Phase::EnablePdos, self.enable_pdos),
            (Phase::Network, self.network),
        ]
    }

    /// Returns the settings that are written, in order.
    fn settings(self) -> impl Iterator<Item = (Phase, &'static Setting)> {
        let of_phase =
            |(phase, settings): (Phase, &'static [Setting])| settings.iter().map(move |setting| (phase, setting));
        let is_written = move |(_, setting): &(Phase, &Setting)| !(self.skip_defaults && setting.is_default);
        self.phases().into_iter().flat_map(of_phase).filter(is_written)
    }
}

#[cfg(test)]
mod tests {
    use super::testing::{CONFIGURATION, NODE};
    use super::*;
    use std::string::{String, ToString};
    use std::vec::Vec;

    fn written(configuration: Configuration) -> Vec<String> {
        configuration.writes(NODE).map(|write| write.to_string()).collect()
    }

    #[test]
    fn writes_in_the_order_of_the_phases() {
        let expected = [
            "0x1400:01 = 0x80000205",
            "0x1800:01 = 0x80000185",
            "0x1017:00 = 0x03E8",
            "0x2000:00 = [6C, 6F, 6E, 67, 20, 74, 65, 78, 74]",
            "0x2001:00 = 0x07",
            "0x1600:00 = 0x00",
            "0x1600:01 = 0x60400010",
            "0x1600:00 = 0x01",
            "0x1400:02 = 0x01",
            "0x1400:01 = 0x00000205",
        ];
        assert_eq!(written(CONFIGURATION), expected);
        assert!(written(Configuration::EMPTY).is_empty());
    }

    #[test]
    fn defaults_can_be_left_out() {
        let skipped = ["0x1017:00 = 0x03E8", "0x1800:01 = 0x80000185"];
        let mut expected = written(CONFIGURATION);
        expected.retain(|write| !skipped.contains(&write.as_str()));
        assert_eq!(expected.len(), 8);
        assert_eq!(written(CONFIGURATION.without_defaults()), expected);
    }

    #[test]
    fn of_an_object() {
        let of = |index, sub_index| CONFIGURATION.of(Object::new(index, sub_index), NODE);
        assert_eq!(of(0x1400, 1), Some(SdoWrite::new_u32(0x1400, 1, 0x205)));
        assert_eq!(of(0x1600, 0), Some(SdoWrite::new_u8(0x1600, 0, 1)));
        assert_eq!(of(0x1000, 0), None);
        assert_eq!(CONFIGURATION.without_defaults().of(Object::new(0x1017, 0), NODE), None);
    }

    #[test]
    fn values_of_a_network_keep_their_order() {
        const NETWORK: Configuration = Configuration {
            network: &[
                Setting::fixed(SdoWrite::new_u16(0x2000, 0, 7)),
                Setting::fixed(SdoWrite::new_u32(0x1400, 1, 0x8000_0205)),
                Setting::fixed(SdoWrite::new_u32(0x1400, 1, 0x205)),
                Setting::fixed(SdoWrite::new_u16(0x1017, 0, 100)),
            ],
            ..Configuration::EMPTY
        };
        let expected = ["0x2000:00 = 0x0007", "0x1400:01 = 0x80000205", "0x1400:01 = 0x00000205", "0x1017:00 = 0x0064"];
        assert_eq!(written(NETWORK), expected);
        assert_eq!(
            NETWORK.steps(NODE).map(|step| step.phase.to_string()).collect::<Vec<_>>(),
            ["network configuration"; 4]
        );
        assert_eq!(
            NETWORK.expected(NODE).map(|write| write.to_string()).collect::<Vec<_>>(),
            [expected[0], expected[2], expected[3]]
        );
    }

    #[test]
    fn longest_value() {
        const LENGTH: usize = CONFIGURATION.longest_value();
        assert_eq!(LENGTH, 9);
        assert_eq!(Configuration::EMPTY.longest_value(), 0);
    }
}
