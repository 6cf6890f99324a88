//! The last stage of the back end. This stage prints the models of devices and modules as Rust code.

mod accessors;
pub(super) mod bit_field;
mod cia402;
pub(super) mod codes;
mod configuration;
mod given;
pub(super) mod image;
mod mapping;
#[cfg(feature = "messages")]
mod messages;
pub(super) mod objects;
pub(super) mod pdos;
#[cfg(feature = "gsdml")]
pub(super) mod profinet;
mod section;
mod table;
pub(super) mod types;
pub(super) mod views;

use super::code::{line, Code, Declaration};
use super::model::Model;
use super::named::Types;

/// Version of the interface between generated code and the runtime. The version must equal
/// `lexibus::interface::VERSION`.
pub const INTERFACE_VERSION: u32 = 1;

/// Prints the first lines of a file or of the module of a device.
pub(super) fn start(code: &mut Code) {
    code.use_runtime();
    line!(code, "const _: () = rt::interface::assert_version(", INTERFACE_VERSION, ");");
}

/// Prints a device or a module of a modular device. Drops large parts of the model as soon as they are printed, because a text
/// that is not written in parts grows at the same time.
pub(super) fn model(code: &mut Code, mut model: Model) {
    start(code);
    code.declare(&model.constants);
    accessors::write(code, &mut model);
    given::models(code, &model.models);
    given::machine(code, model.given.as_ref());
    #[cfg(feature = "messages")]
    messages::write(code, &mut model);
    types::write(code, &model);
    model.types = Types::default();
    codes::write(code, &model);
    model.code_tables = Vec::new();
    let procedures = "Sequences of SDO writes. Send the writes of a sequence in order with `SdoWrite::send`.";
    constants(code, procedures, "procedures", &model.procedures);
    let windows =
        "Windows for indirect access. Each window has an item for the number of a value and an item for the value.";
    constants(code, windows, "windows", &model.windows);
    objects::write(code, &mut model);
    mapping::write(code, &model);
    pdos::write(code, &model);
    views::write(code, &model);
    image::write(code, &model);
    table::write(code, &model);
    configuration::write(code, &model);
}

/// Prints a module that contains only constants. Prints nothing if there are none.
fn constants(code: &mut Code, heading: &str, name: &str, constants: &[Declaration]) {
    if !constants.is_empty() {
        code.module(heading, name, |code| {
            code.use_runtime();
            code.declare(constants);
        });
    }
}
