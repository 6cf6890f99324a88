//! Backups as DCF files (CiA 306).

use std::error::Error;
use std::fmt;

use lexibus_codegen::compile::{check, Options};
use lexibus_codegen::ir::{Catalog, Commissioning, Configured, Value};
use lexibus_codegen::source::Source;
use lexibus_export::eds::{export, Flavor};

use super::entry::{Backup, Skipped};
use crate::address::Network;
use crate::description::Description;

/// A backup as a DCF.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct DcfFile {
    /// Content of the file.
    pub text: String,
    /// Values that a DCF cannot express. A backup as TOML contains them.
    pub lost: Vec<Skipped>,
}

/// The reason why a backup cannot be a DCF.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub enum DcfError {
    /// The description is not for CANopen.
    NoObjects,
}

impl fmt::Display for DcfError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str("a DCF contains only CANopen objects; use the format TOML for Modbus")
    }
}

impl Error for DcfError {}

impl Backup {
    /// Returns the backup as a DCF of the device. The file declares the objects of the description, so it can be used as
    /// the description file.
    ///
    /// # Errors
    ///
    /// Fails if `description` is not for CANopen.
    pub fn dcf(&self, description: &Description) -> Result<DcfFile, DcfError> {
        if description.network() != Network::CanOpen {
            return Err(DcfError::NoObjects);
        }
        let catalog = self.configured(description);
        let device = &catalog.devices[description.position()];
        let text = export(&catalog, device, Flavor::Dcf).ok_or(DcfError::NoObjects)?.text;
        let lost = self.lost(&text, description);
        Ok(DcfFile { text, lost })
    }

    /// Returns the catalog of the description with the values of the backup as configured values. Other configured
    /// values are removed.
    pub(crate) fn configured(&self, description: &Description) -> Catalog {
        let values = self.values();
        let mut catalog = description.catalog().clone();
        let device = &mut catalog.devices[description.position()];
        let commissioning = device.commissioning.get_or_insert_with(Box::<Commissioning>::default);
        commissioning.node_id = self.node_id.or(commissioning.node_id);
        for item in device.groups.iter_mut().flat_map(|group| &mut group.items) {
            let object = item.object();
            let address = object.map(|(index, sub)| crate::address::Address::Object(lexibus::Object::new(index, sub)));
            let value: Option<Value> = address.and_then(|address| values.get(&address).copied()).cloned();
            match &mut item.configured {
                Some(configured) => configured.value = value,
                None if value.is_some() => {
                    item.configured = Some(Box::new(Configured { value, ..Configured::default() }))
                }
                None => {}
            }
        }
        catalog
    }

    /// Parses the DCF, and returns the values of the backup that the DCF doesn't contain. Values without a parameter in the
    /// description are not returned.
    fn lost(&self, text: &str, description: &Description) -> Vec<Skipped> {
        let source = Source::new("backup.dcf", text.as_bytes().to_vec());
        let catalog = check(source, &Options::default()).catalog;
        let again = catalog.and_then(|catalog| Description::new(catalog, Network::CanOpen).ok());
        let again = again.map(|again| Backup::of_description(&again)).unwrap_or_default();
        let again = again.values();
        let is_lost = |entry: &&super::Entry| again.get(&entry.address) != Some(&&entry.value);
        let lost = self.entries.iter().filter(is_lost);
        lost.filter_map(|entry| description.at(entry.address))
            .map(|parameter| Skipped::failed(&parameter, "a DCF cannot express the value; use the format TOML"))
            .collect()
    }
}
