//! Reasons why parameters are not read or not restored by default.

use std::fmt;

use lexibus::RegisterTable;
use lexibus_codegen::facts::configuration::is_motion_command;
use lexibus_codegen::facts::item::meaning;
use lexibus_codegen::ir::{Access, Device, ElementId, Item, Shape, Storage, Trigger};
use lexibus_codegen::resolve::is_device_of_number;

use crate::address::{Address, Network};
use crate::parameter::Parameter;

/// Bits of ObjFlags (CiA 306).
const REFUSES_WRITE: u32 = 1;
const REFUSES_READ: u32 = 2;

/// The reason why a restore doesn't write a parameter unless the caller names it.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
#[non_exhaustive]
pub enum Protection {
    /// The parameter refuses writes during a download (bit 0 of ObjFlags, CiA 306).
    RefusesDownload,
    /// A write can start an action. For example, the device stores parameters or starts a program download.
    Command,
    /// The parameter commands the state, the mode or a motion of the device, or the touch probe or an output of a CiA 402
    /// drive.
    Control,
    /// The parameter is an output: a coil, a process output, an output of a CiA 401 device, or a value that is mapped into
    /// an RPDO by default.
    Output,
    /// The parameter sets the node-ID or the address of the device.
    NodeId,
    /// The parameter sets the bit rate of the bus.
    BitRate,
    /// The description states side effects of a write.
    SideEffect,
    /// The parameter can be written only once.
    WriteOnce,
}

impl Protection {
    /// Returns the reason as text.
    #[must_use]
    pub fn text(self) -> &'static str {
        match self {
            Protection::RefusesDownload => "refuses writes on download (ObjFlags)",
            Protection::Command => "starts an action when it is written",
            Protection::Control => "commands the state, the mode or a motion",
            Protection::Output => "is an output",
            Protection::NodeId => "sets the node-ID or address",
            Protection::BitRate => "sets the bit rate",
            Protection::SideEffect => "has side effects when it is written",
            Protection::WriteOnce => "can be written only once",
        }
    }
}

impl fmt::Display for Protection {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(self.text())
    }
}

/// The reason not to read a parameter by default.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
#[non_exhaustive]
pub enum ReadRefusal {
    /// The parameter is write-only.
    WriteOnly,
    /// The parameter refuses reads during a scan (bit 1 of ObjFlags, CiA 306).
    RefusesScan,
    /// The device clears the value automatically, possibly when the value is read.
    Clears,
}

impl ReadRefusal {
    /// Returns the reason as text.
    #[must_use]
    pub fn text(self) -> &'static str {
        match self {
            ReadRefusal::WriteOnly => "write-only",
            ReadRefusal::RefusesScan => "refuses reads on scan (ObjFlags)",
            ReadRefusal::Clears => "the device clears the value automatically",
        }
    }
}

impl fmt::Display for ReadRefusal {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(self.text())
    }
}

impl Parameter<'_> {
    /// Returns the bits of ObjFlags that are set for the object or for the entry (CiA 306).
    fn flags(&self) -> u32 {
        self.group().flags | self.item().flags
    }

    /// Returns the reason not to read the parameter by default, or `None` if there is none. On CANopen, a
    /// [comparison](crate::verify) reads write-only parameters nevertheless, to check their access rights.
    #[must_use]
    pub fn read_refusal(&self) -> Option<ReadRefusal> {
        match () {
            () if self.flags() & REFUSES_READ != 0 => Some(ReadRefusal::RefusesScan),
            () if self.behavior().is_some_and(|behavior| behavior.self_clearing) => Some(ReadRefusal::Clears),
            () if !self.access().readable() => Some(ReadRefusal::WriteOnly),
            () => None,
        }
    }

    /// Returns the reason why a restore doesn't write the parameter unless the caller names it, or `None` if it is not
    /// protected.
    #[must_use]
    pub fn protection(&self) -> Option<Protection> {
        let device = self.description().device();
        let behavior = self.behavior();
        match () {
            () if self.is_control(device) => Some(Protection::Control),
            () if self.is_command(device) => Some(Protection::Command),
            () if self.is_output(device) => Some(Protection::Output),
            () if self.flags() & REFUSES_WRITE != 0 => Some(Protection::RefusesDownload),
            () if self.is_node_id() => Some(Protection::NodeId),
            () if self.is_bit_rate() => Some(Protection::BitRate),
            () if behavior.is_some_and(|behavior| behavior.write_once) => Some(Protection::WriteOnce),
            () if behavior.is_some_and(|behavior| !behavior.side_effects.is_empty()) => Some(Protection::SideEffect),
            () => None,
        }
    }

    fn is_command(&self, device: &Device) -> bool {
        let is_object = self.item().object().is_some_and(|(index, _)| is_command_object(index));
        let clears = self.behavior().is_some_and(|behavior| behavior.self_clearing);
        is_object || clears || self.has_trigger(device) || stores_others(device, self.item())
    }

    /// Returns whether a bit of the parameter takes effect on an edge, or is cleared by the device.
    fn has_trigger(&self, device: &Device) -> bool {
        let definition = lexibus_codegen::ir::owner::Owner::of_types(&device.types).definition(self.ty());
        let fields = match definition.map(|definition| &definition.shape) {
            Some(Shape::BitField { fields, .. }) => fields.as_slice(),
            _ => &[],
        };
        let is_trigger = |trigger: Option<Trigger>| trigger.is_some();
        fields.iter().any(|field| is_trigger(field.trigger))
    }

    /// Returns whether the parameter is the controlword of a state machine, or an object of a CiA 402 drive for which
    /// [`is_drive_command`] is true.
    fn is_control(&self, device: &Device) -> bool {
        let is_controlled = |machine: &lexibus_codegen::ir::StateMachine| {
            device.referred(&machine.control_item).is_some_and(|item| std::ptr::eq(item, self.item()))
        };
        let object = self.item().object();
        let is_of_drive =
            || is_device_of_number(device, 402) && object.is_some_and(|(index, _)| is_drive_command(index));
        device.machines.iter().any(is_controlled) || is_of_drive()
    }

    /// Returns whether the parameter is a coil. Also returns true for process outputs, for objects that are mapped into an
    /// RPDO by default, and for outputs of a CiA 401 device. An item of a Modbus device can have an object too, on another
    /// bus.
    fn is_output(&self, device: &Device) -> bool {
        let is_coil = matches!(self.address(), Address::Register(register) if register.table == RegisterTable::Coil);
        let Some(object) = self.item().object() else { return is_coil };
        let receive = device.process_data.pdos.iter();
        let mut receive = receive.filter(|pdo| pdo.direction == lexibus_codegen::ir::Direction::Receive);
        let is_mapped = receive.any(|pdo| pdo.entries.iter().any(|entry| (entry.index, entry.sub_index) == object));
        let is_of_io_module = || is_device_of_number(device, 401) && is_io_output(object.0);
        is_coil || self.access() == Access::ReadWriteOutput || is_mapped || is_of_io_module()
    }

    fn is_node_id(&self) -> bool {
        const NAMES: [&str; 8] = [
            "nodeid",
            "nodenumber",
            "nodeaddress",
            "slaveaddress",
            "serveraddress",
            "stationaddress",
            "modbusaddress",
            "deviceaddress",
        ];
        let name = letters(&self.name());
        // Communication objects, such as the consumer heartbeat time, can contain the node-IDs of other devices.
        let is_vendor_specific = self.address().object().is_none_or(|object| object.index >= 0x2000);
        is_vendor_specific && NAMES.iter().any(|known| name.contains(known))
            || self.description().network() == Network::Modbus && name == "address"
    }

    fn is_bit_rate(&self) -> bool {
        const NAMES: [&str; 4] = ["baud", "bitrate", "bittiming", "transmissionspeed"];
        let name = letters(&self.name());
        NAMES.iter().any(|known| name.contains(known))
    }

    /// Returns the name of an enumeration value, or the active flags and the fields of a bit field. Returns `None` if there
    /// are none.
    #[must_use]
    pub fn meaning(&self, value: &lexibus_codegen::ir::Value) -> Option<String> {
        meaning(self.ty(), value, &self.description().device().types)
    }
}

/// Returns whether `item` is the command that stores another item.
fn stores_others(device: &Device, item: &Item) -> bool {
    device.items().any(|other| match other.behavior.as_deref().map(|behavior| &behavior.storage) {
        Some(Storage::OnCommand(command)) => match command.id {
            Some(ElementId::Item(id)) => device.item(id).is_some_and(|found| std::ptr::eq(found, item)),
            _ => false,
        },
        _ => false,
    })
}

/// Returns whether an object of the communication profile counts as a command (CiA 301 7.5.2, CiA 302). Commands are the
/// error history (0x1003), store and restore parameters (0x1010, 0x1011), the stored EDS, operating system commands and the
/// debugger (0x1021 to 0x1026). Objects of the configuration manager, the program download and the NMT master are commands,
/// too.
fn is_command_object(index: u16) -> bool {
    matches!(index, 0x1003 | 0x1010 | 0x1011 | 0x1021..=0x1026 | 0x1F25 | 0x1F50..=0x1F57 | 0x1F82 | 0x1F8A..=0x1F91)
}

/// Returns whether an object of a CiA 402 drive commands the state, the mode, a motion, the touch probe or an output. The
/// indices of each further axis are 0x800 higher (CiA 402-2).
fn is_drive_command(index: u16) -> bool {
    /// Mode of operation, offsets of position, velocity and torque, interpolation data, touch probe function, digital
    /// outputs.
    const OTHERS: [u16; 7] = [0x6060, 0x60B0, 0x60B1, 0x60B2, 0x60C1, 0x60B8, 0x60FE];
    let is_other = (0x6000..0xA000).contains(&index) && OTHERS.contains(&(0x6000 + (index - 0x6000) % 0x800));
    is_motion_command(index) || is_other
}

/// Returns whether an object of a CiA 401 device is an output.
fn is_io_output(index: u16) -> bool {
    matches!(index, 0x6200 | 0x6220 | 0x6300 | 0x6320 | 0x6400 | 0x6410..=0x6414)
}

/// Returns the letters and digits of a name in lower case.
pub(crate) fn letters(name: &str) -> String {
    name.chars().filter(|letter| letter.is_alphanumeric()).flat_map(char::to_lowercase).collect()
}
