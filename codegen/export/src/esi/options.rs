//! Options for facts that an ESI requires and a source may not have.

use crate::options::{options, OptionValue};
use lexibus_codegen::ir::Coe;

options! {
    /// Facts that override the facts of the source or supply missing ones. The memory areas have an effect only if the
    /// source declares no sync managers, and `coe` only if the source declares no mailbox.
    pub struct Options, TrackedOptions {
        /// Vendor ID assigned by the EtherCAT Technology Group.
        vendor_id: u32 = "vendor-id",
        /// Name of the vendor.
        vendor_name: String = "vendor-name",
        /// Product code, as in object 0x1018.
        product_code: u32 = "product-code",
        /// Revision number, as in object 0x1018.
        revision: u32 = "revision",
        /// Order code (the text of the element Type).
        order_code: String = "order-code",
        /// Kind of each port as up to four letters: Y (MII), K (LVDS), H (MII with Fast Hot Connect) or space (none).
        physics: String = "physics",
        /// Key of the group that contains the device; also the name of the group if the description file has no name.
        group: String = "group",
        /// Start address and length in bytes of the receive mailbox, such as 0x1000:128.
        mailbox_out: Area = "mailbox-out",
        /// Start address and length in bytes of the send mailbox, such as 0x1080:128.
        mailbox_in: Area = "mailbox-in",
        /// Start address of the outputs in the memory of the slave controller, with an optional length, such as 0x1100:8.
        outputs: Area = "outputs",
        /// Start address of the inputs in the memory of the slave controller, with an optional length, such as 0x1180:8.
        inputs: Area = "inputs",
        /// CoE features, such as sdo-info,pdo-assign,pdo-config,complete-access, if the description file declares no mailbox.
        coe: Coe = "coe",
        /// Size of the EEPROM in bytes.
        eeprom_size: u32 = "eeprom-size",
    }
}

/// A range of the memory of a slave controller.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Area {
    /// Address of the first byte of the range.
    pub start: u16,
    /// Length in bytes, if given.
    pub length: Option<u16>,
}

impl OptionValue for Area {
    const WHAT: &'static str = "an address with an optional length, such as `0x1000:128`";

    fn parse(text: &str) -> Option<Self> {
        match text.split_once(':') {
            Some((start, length)) => Some(Area {
                start: <u16 as OptionValue>::parse(start)?,
                length: Some(<u16 as OptionValue>::parse(length)?),
            }),
            None => Some(Area { start: <u16 as OptionValue>::parse(text)?, length: None }),
        }
    }
}

impl OptionValue for Coe {
    const WHAT: &'static str = "a list of `sdo-info`, `pdo-assign`, `pdo-config`, `pdo-upload`, `complete-access`, \
                                `segmented-sdo`, `diag-history`, or `none`";

    fn parse(text: &str) -> Option<Self> {
        let mut coe = Coe::default();
        for word in text.split(',').map(str::trim).filter(|word| *word != "none") {
            match word {
                "sdo-info" => coe.sdo_info = true,
                "pdo-assign" => coe.pdo_assign = true,
                "pdo-config" => coe.pdo_config = true,
                "pdo-upload" => coe.pdo_upload = true,
                "complete-access" => coe.complete_access = true,
                "segmented-sdo" => coe.segmented_sdo = true,
                "diag-history" => coe.diag_history = true,
                _ => return None,
            }
        }
        Some(coe)
    }
}
