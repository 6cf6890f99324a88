//! Compares the vendor, product and revision of devices, modules and submodules.

use super::change::Judgment;
use super::comparison::{each_positioned, fact_as, rules, text};
use super::show::ident;
use super::texts::origin;
use lexibus_codegen::ir::{CompactString, FactOrigin, Identity, IdentityNumber};
use lexibus_codegen::number::hex32;

// Compares identities. A program can check the numbers of an identity, but they affect no other bytes on the bus.
rules!(pub(super) fn identity(Identity) {
    vendor_id: fact_as("vendor-ID", Judgment::BEHAVIOR, ident),
    vendor_name: text("name of the vendor"),
    product_code: fact_as("product code", Judgment::BEHAVIOR, ident),
    product_name: text("name of the product"),
    revision_number: fact_as("revision", Judgment::BEHAVIOR, ident),
    order_code: text("order code"),
    serial_number: fact_as("serial number", Judgment::BEHAVIOR, ident),
    others: fact_as("further identity", Judgment::BEHAVIOR, |others: &Vec<(CompactString, u32)>| {
        others.iter().map(|(name, number)| format!("{name} {}", hex32(*number))).collect::<Vec<_>>().join(", ")
    }),
    origins: each_positioned("origins", |(number, from): &(IdentityNumber, FactOrigin)| {
        format!("{}: {}", number.name(), origin(from))
    }),
});
