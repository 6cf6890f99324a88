//! EtherCAT: the description of a slave for the master, and the default process image.

mod assigned;
mod descriptor;
mod image;
mod settings;
mod startup;

use assigned::Assigned;
pub(super) use image::{ImageField, ImageModel};
pub(super) use settings::{module, EtherCatModel, ModulePaths};
