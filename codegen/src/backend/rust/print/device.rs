//! Prints the start of a device's module: identity, node-ID, bus constants, EtherCAT constants and axes.

use crate::backend::rust::code::{line, open, Code};
use crate::backend::rust::ethercat::EtherCatModel;
use crate::backend::rust::identity::IdentityModel;
use crate::backend::rust::model::Model;
use crate::backend::rust::INTERFACE_VERSION;

pub(super) fn write(code: &mut Code, model: &Model) {
    code.use_runtime();
    line!(code, "const _: () = rt::interface::assert_version(", INTERFACE_VERSION, ");");
    if let Some(identity) = &model.identity {
        let title = format!("Identity of {}: vendor, product and revision.", model.title);
        let sentences: Vec<&str> = [&title].into_iter().chain(&identity.origins).map(String::as_str).collect();
        self::identity(code, identity, &sentences.join(" "));
    }
    if let Some(node_id) = model.node_id {
        code.doc("Node-ID of this device in the configuration file.");
        line!(code, "pub const NODE_ID: Option<rt::NodeId> = rt::NodeId::new(", node_id, ");");
    }
    for fact in &model.bus_facts {
        code.doc(&fact.docs);
        line!(code, fact.code);
    }
    if let Some(module) = &model.module {
        code.doc(&format!("EtherCAT description of {} for the master.", model.title));
        line!(code, "pub static MODULE: rt::ethercat::Module = ", module, ";");
    }
    if let Some(ethercat) = &model.ethercat {
        self::ethercat(code, ethercat, &model.title);
    }
    if let Some(axes) = &model.axes {
        code.doc(&format!("Number of axes{}, and the rules for the addresses of their objects.", axes.models));
        line!(code, "pub static AXES: rt::Axes = ", axes.constant, ";");
    }
}

/// Writes the constant `IDENTITY` with its doc comment.
pub(super) fn identity(code: &mut Code, identity: &IdentityModel, documentation: &str) {
    code.doc(documentation);
    open!(code, "pub const IDENTITY: rt::Identity = rt::Identity {");
    line!(code, "vendor_id: ", identity.vendor_id, ",");
    line!(code, "product_code: ", identity.product_code, ",");
    line!(code, "revision_number: ", identity.revision_number, ",");
    line!(code, "vendor_name: ", identity.vendor_name, ",");
    line!(code, "product_name: ", identity.product_name, ",");
    line!(code, "order_code: ", identity.order_code, ",");
    code.close("};");
}

fn ethercat(code: &mut Code, ethercat: &EtherCatModel, title: &str) {
    code.doc(&format!("EtherCAT description of {title} for the master."));
    line!(code, "pub static DEVICE: rt::ethercat::Device = ", ethercat.device, ";");
    if let Some(fmmus) = &ethercat.fmmus {
        code.doc("FMMUs of the slave controller, in the order of their numbers.");
        line!(code, "pub const FMMUS: &[rt::ethercat::Fmmu] = ", fmmus, ";");
    }
    if let Some(modes) = &ethercat.clock_modes {
        code.doc("Operation modes of the distributed clocks. The first mode is the default.");
        line!(code, "pub const CLOCK_MODES: &[rt::ethercat::ClockMode] = ", modes, ";");
    }
    if let Some(startup) = &ethercat.startup {
        code.doc("SDO writes that configure the default PDO assignment. Send them in the state \"Pre-Operational\".");
        line!(code, "pub const STARTUP: &[rt::SdoWrite] = ", startup, ";");
    }
    for (name, title, bytes) in &ethercat.bytes {
        code.doc(title);
        line!(code, "pub const ", name, ": &[u8] = ", bytes, ";");
    }
}
