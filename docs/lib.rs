//! Tests the examples of [the book](https://github.com/lexibus/lexibus/tree/main/docs/src/SUMMARY.md).
//!
//! The Rust blocks of the chapters are documentation tests of this crate. Each block must compile, and is run if it needs no
//! hardware. The build script generates the bindings that the blocks use.

/// Declares a module with the generated bindings for each description.
macro_rules! bindings {
    ($($(#[$documentation:meta])* $name:ident;)*) => {
        $(
            $(#[$documentation])*
            #[allow(deprecated, clippy::all)]
            #[rustfmt::skip]
            pub mod $name {
                include!(concat!(env!("OUT_DIR"), "/", stringify!($name), ".rs"));
            }
        )*
    };
}

#[cfg(not(doctest))]
bindings! {
    /// A pump on CANopen: `docs/examples/pump.eds`.
    pump;
    /// A motor on Modbus, from the tutorial on register tables: `docs/examples/motor.toml`.
    motor;
    /// A frequency inverter on Modbus: `examples/inverter.toml`.
    inverter;
    /// A conveyor with a configuration: `tests/ui/configuration/order-of-a-dcf/input.dcf`.
    conveyor;
    /// One drive on four buses: `tests/data/one-drive.toml`.
    one_drive;
    /// A press with every kind of scale and bit field: `tests/data/press.toml`.
    press;
    /// A coupler and a servo drive on EtherCAT: `tests/data/coupler.esi.xml`.
    coupler;
    /// An IO station on PROFINET: `docs/examples/station.gsdml.xml`.
    station;
    /// A station with a PROFIsafe module on PROFINET: `tests/data/safe.gsdml.xml`.
    safe;
    /// A network of three nodes: `examples/network/network.toml`.
    network;
}

/// One module for each chapter in `docs/src`. A test of the book checks this list.
#[cfg(doctest)]
mod chapters {
    #[doc = include_str!("src/introduction.md")]
    mod introduction {}
    #[doc = include_str!("src/getting-started.md")]
    mod getting_started {}
    #[doc = include_str!("src/first-table.md")]
    mod first_table {}
    #[doc = include_str!("src/formats.md")]
    mod formats {}
    #[doc = include_str!("src/eds.md")]
    mod eds {}
    #[doc = include_str!("src/xdd.md")]
    mod xdd {}
    #[doc = include_str!("src/esi.md")]
    mod esi {}
    #[doc = include_str!("src/gsdml.md")]
    mod gsdml {}
    #[doc = include_str!("src/table-format.md")]
    mod table_format {}
    #[doc = include_str!("src/tables.md")]
    mod tables {}
    #[doc = include_str!("src/buses.md")]
    mod buses {}
    #[doc = include_str!("src/canopen.md")]
    mod canopen {}
    #[doc = include_str!("src/ethercat.md")]
    mod ethercat {}
    #[doc = include_str!("src/profinet.md")]
    mod profinet {}
    #[doc = include_str!("src/modbus.md")]
    mod modbus {}
    #[doc = include_str!("src/serial.md")]
    mod serial {}
    #[doc = include_str!("src/simulation.md")]
    mod simulation {}
    #[doc = include_str!("src/network.md")]
    mod network {}
    #[doc = include_str!("src/devices.md")]
    mod devices {}
    #[doc = include_str!("src/recipes.md")]
    mod recipes {}
    #[doc = include_str!("src/diff.md")]
    mod diff {}
    #[doc = include_str!("src/site.md")]
    mod site {}
    #[doc = include_str!("src/ci.md")]
    mod ci {}
    #[doc = include_str!("src/diagnostics.md")]
    mod diagnostics {}
    #[doc = include_str!("src/lints.md")]
    mod lints {}
    #[doc = include_str!("src/limits.md")]
    mod limits {}
    #[doc = include_str!("src/architecture.md")]
    mod architecture {}
    #[doc = include_str!("src/front-end.md")]
    mod front_end {}
    #[doc = include_str!("src/back-end.md")]
    mod back_end {}
}
