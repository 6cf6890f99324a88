//! The last stage: writes the models down. The functions have the order and the shape of the output.

mod accessors;
mod bit_field;
mod codes;
mod device;
mod given;
mod image;
mod mapping;
mod messages;
mod objects;
mod pdos;
mod procedures;
#[cfg(feature = "gsdml")]
pub(super) mod profinet;
mod table;
mod types;
mod views;

use super::code::Code;
use super::model::Model;

/// A device, or a module of a modular one.
pub(super) fn model(code: &mut Code, model: &Model) {
    code.reserve(model.size_hint());
    device::write(code, model);
    accessors::write(code, model);
    given::models(code, &model.models);
    given::machine(code, model.given.as_ref());
    messages::write(code, model);
    types::write(code, &model.types);
    codes::write(code, &model.code_tables);
    procedures::write(code, &model.procedures);
    objects::write(code, model);
    mapping::write(code, model);
    pdos::write(code, &model.pdos);
    views::write(code, model);
    image::write(code, model.ethercat.as_ref());
    table::write(code, model);
}
