//! The last stage of the back end. This stage prints the models of devices and modules as Rust code.

mod accessors;
pub(super) mod bit_field;
mod cia402;
pub(super) mod codes;
mod configuration;
mod device;
mod given;
pub(super) mod image;
mod mapping;
#[cfg(feature = "messages")]
mod messages;
pub(super) mod objects;
pub(super) mod pdos;
mod procedures;
#[cfg(feature = "gsdml")]
pub(super) mod profinet;
mod section;
mod table;
pub(super) mod types;
pub(super) mod views;

use super::code::Code;
use super::model::Model;
use super::named::Types;

/// Prints a device or a module of a modular device. Drops large parts of the model as soon as they are printed, because a text
/// that is not written in parts grows at the same time.
pub(super) fn model(code: &mut Code, mut model: Model) {
    device::write(code, &model);
    accessors::write(code, &mut model);
    given::models(code, &model.models);
    given::machine(code, model.given.as_ref());
    #[cfg(feature = "messages")]
    messages::write(code, &mut model);
    types::write(code, &model);
    model.types = Types::default();
    codes::write(code, &model);
    model.code_tables = Vec::new();
    procedures::write(code, &model.procedures);
    objects::write(code, &mut model);
    mapping::write(code, &model);
    pdos::write(code, &model);
    views::write(code, &model);
    image::write(code, &model);
    table::write(code, &model);
    configuration::write(code, &model);
}
