//! Options for facts that a GSDML requires and a source may not have.

use crate::options::{options, OptionValue};
use lexibus_codegen::ir::Numbers;

options! {
    /// Facts that override the facts of the source or supply missing ones. The options for the device access point, its
    /// submodules and the interface have an effect only if the export creates the device access point from process
    /// images.
    pub struct Options, TrackedOptions {
        /// Vendor ID assigned by PROFIBUS & PROFINET International (VendorID).
        vendor_id: u16 = "vendor-id",
        /// Device ID, unique among the devices of the vendor (DeviceID).
        device_id: u16 = "device-id",
        /// Name of the vendor.
        vendor_name: String = "vendor-name",
        /// Description of the device family, in one sentence.
        description: String = "description",
        /// Main family, such as Drives.
        main_family: String = "main-family",
        /// Product family, as named by the vendor.
        product_family: String = "product-family",
        /// Date of the file in the form YYYYMMDD; also part of the file name.
        date: String = "date",
        /// Default name of station of the device (DNS_CompatibleName).
        dns_name: String = "dns-name",
        /// PROFINET version of the device, such as V2.35.
        pnio_version: String = "pnio-version",
        /// Module ident number of the device access point.
        module_ident: u32 = "module-ident",
        /// Ident number of the submodule with the process data.
        submodule_ident: u32 = "submodule-ident",
        /// Whether all inputs, and all outputs, are consistent as a whole; otherwise only each data item is consistent.
        consistent: bool = "consistent",
        /// Subslot of the submodule with the process data.
        subslot: u16 = "subslot",
        /// Minimum interval between two frames in units of 31.25 µs (MinDeviceInterval).
        min_device_interval: u16 = "min-device-interval",
        /// Instance number in the object UUID of the device (ObjectUUID_LocalIndex).
        object_uuid_index: u16 = "object-uuid-index",
        /// Maximum length of the controller's inputs in bytes, including provider and consumer status (MaxInputLength).
        max_input_length: u16 = "max-input-length",
        /// Maximum length of the controller's outputs in bytes, including provider and consumer status (MaxOutputLength).
        max_output_length: u16 = "max-output-length",
        /// Whether the name of station cannot be transferred with a storage medium (NameOfStationNotTransferable).
        name_not_transferable: bool = "name-not-transferable",
        /// Whether a controller can access the device without an IO application relation (DeviceAccessSupported).
        device_access: bool = "device-access",
        /// Whether a controller can check the device ID (CheckDeviceID_Allowed).
        check_device_id: bool = "check-device-id",
        /// Whether the submodule with the process data can issue process alarms (MayIssueProcessAlarm).
        process_alarms: bool = "process-alarms",
        /// Order number.
        order_number: String = "order-number",
        /// Hardware release.
        hardware_release: String = "hardware-release",
        /// Software release.
        software_release: String = "software-release",
        /// Ident number of the interface submodule; without this key, the file has no interface and no ports.
        interface_ident: u32 = "interface-ident",
        /// Name of the interface, such as X1.
        interface_name: String = "interface-name",
        /// Protocols of the interface, such as SNMP;LLDP (SupportedProtocols).
        supported_protocols: String = "supported-protocols",
        /// Real-time classes of the interface, such as RT_CLASS_1 (SupportedRT_Classes).
        rt_classes: String = "rt-classes",
        /// Supported start-up modes, such as Legacy;Advanced.
        startup_modes: String = "startup-modes",
        /// Supported send clock factors in units of 31.25 µs, such as 32 or 32 64 128.
        send_clocks: Numbers = "send-clocks",
        /// Supported reduction ratios, such as 1 2 4 8.
        reduction_ratios: Numbers = "reduction-ratios",
        /// Number of ports.
        ports: u16 = "ports",
        /// Ident number of the port submodules.
        port_ident: u32 = "port-ident",
        /// MAU type of the ports, such as 16 for 100BASE-TX full duplex.
        mau_type: u16 = "mau-type",
        /// Conformance class: A, B or C.
        conformance_class: String = "conformance-class",
        /// Application classes, or `none`.
        application_class: String = "application-class",
        /// Netload class: I, II or III.
        netload_class: String = "netload-class",
    }
}

impl OptionValue for Numbers {
    const WHAT: &'static str = "a list of numbers and ranges such as `32 64 128` or `8..128`";

    fn parse(text: &str) -> Option<Self> {
        let number = |text: &str| text.trim().parse::<u16>().ok();
        let range = |part: &str| match part.split_once("..") {
            Some((first, last)) => Some((number(first)?, number(last)?)).filter(|(first, last)| first <= last),
            None => number(part).map(|number| (number, number)),
        };
        let parts = text.split([' ', ',', ';']).filter(|part| !part.is_empty());
        parts.map(range).collect::<Option<_>>().map(Numbers).filter(|numbers| !numbers.is_empty())
    }
}
