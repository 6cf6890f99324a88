//! EtherCAT: the description of a slave for the master, and the default process image.

mod descriptor;
mod image;
mod settings;
mod startup;

pub(super) use image::{ImageField, ImageModel};
pub(super) use settings::{module, Assigned, EtherCatModel, ModulePaths};
