//! EtherCAT: the description of a slave for the master, and the default process image.

mod descriptor;
mod image;
mod settings;
mod startup;

pub(super) use image::{ImageField, ImageModel};
pub(super) use settings::{device, module, ModulePaths};

/// A PDO that is assigned by default, and the number of its sync manager.
type Assigned<'a> = (&'a crate::ir::Pdo, u8);
