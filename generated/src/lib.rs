//! Typed bindings of the drives that Lexibus ships. Each drive has a module and a cargo feature.
//!
//! The modules are generated from the descriptions in the folder `dictionaries` of the repository. This documentation contains all
//! modules, regardless of the enabled features.
//!
//! | feature | module | drive |
//! |---|---|---|
//! | `akd` | [`akd`] | Kollmorgen AKD servo drives, on EtherCAT |
//! | `demo-drive` | [`demo_drive`] | an imaginary CiA 402 drive, for experiments |
//! | `hsd` | [`hsd`] | HSD SM137 and SM140 positioning motors, on RS-485 |
//! | `vector-step` | [`vector_step`] | AEC Vector Step stepper drives, on CANopen, EtherCAT and Modbus |
//! | `eco` | [`eco`] | Eco drives, on CANopen, EtherCAT, Modbus and PROFINET |
//! | `table` | – | all drives: adds the table `ENTRIES` of all items to each module |
//!
//! ```
//! # #[cfg(feature = "demo-drive")] {
//! use lexibus_drives::demo_drive::types::Controlword;
//! use lexibus_drives::demo_drive::{objects, pdo};
//!
//! assert_eq!(objects::TARGET_POSITION.name(), "Target position");
//! let frame = pdo::RxPdo2 { controlword: Controlword::from_raw(0x000F), target_position: -2 }.pack();
//! assert_eq!(frame, [0x0F, 0x00, 0xFE, 0xFF, 0xFF, 0xFF]);
//! # }
//! ```
#![no_std]
#![forbid(unsafe_code)]

/// Kollmorgen AKD servo drives (`dictionaries/kollmorgen-akd.toml`).
#[cfg(any(doc, feature = "akd"))]
#[rustfmt::skip]
pub mod akd;

/// An imaginary CiA 402 drive (`dictionaries/demo-drive.eds`).
#[cfg(any(doc, feature = "demo-drive"))]
#[rustfmt::skip]
pub mod demo_drive;

/// HSD SM137 and SM140 positioning motors (`dictionaries/hsd-sm137-sm140.toml`).
#[cfg(any(doc, feature = "hsd"))]
#[rustfmt::skip]
pub mod hsd;

/// AEC Vector Step stepper drives (`dictionaries/aec-vector-step.toml`).
#[cfg(any(doc, feature = "vector-step"))]
#[rustfmt::skip]
pub mod vector_step;

/// Eco drives (`dictionaries/eco.toml`).
#[cfg(any(doc, feature = "eco"))]
#[rustfmt::skip]
pub mod eco;
