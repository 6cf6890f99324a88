//! Reads the parameters of a device.

use lexibus_codegen::facts::pdo;
use lexibus_codegen::ir::Storage;

use super::entry::{Backup, Entry, Skipped};
use super::relative::relative;
use crate::address::Address;
use crate::connection::Connection;
use crate::description::Description;
use crate::failure::{retried, Failure};
use crate::parameter::Parameter;
use crate::protection::Protection;

/// Options of a backup.
#[derive(Clone, Debug, Default)]
pub struct Options {
    /// Node-ID or Modbus server address of the device.
    pub node_id: Option<u8>,
    /// Addresses of writable parameters that are saved, although a backup otherwise leaves them out.
    pub include: Vec<Address>,
}

/// Reads the parameters that belong to a backup. Nothing is written.
///
/// [`Backup::skipped`] lists the writable parameters that were not saved. If one of them should have been saved, the
/// backup is not [complete](Backup::is_complete).
///
/// # Errors
///
/// Fails if the bus or the client fails, or if three attempts to read a value time out.
pub fn backup(
    description: &Description,
    connection: &mut impl Connection,
    options: &Options,
) -> Result<Backup, Failure> {
    let mut backup = Backup { node_id: options.node_id, ..Backup::default() };
    for parameter in description.parameters().filter(|parameter| parameter.access().writable()) {
        match exclusion(&parameter).filter(|_| !options.include.contains(&parameter.address())) {
            Some(reason) => backup.skipped.push(Skipped::new(&parameter, reason)),
            None => save(&parameter, connection, &mut backup)?,
        }
    }
    Ok(backup)
}

/// Returns the reason why a writable parameter doesn't belong to a backup, or `None` if it does.
fn exclusion(parameter: &Parameter<'_>) -> Option<String> {
    let refusal = parameter.read_refusal().map(|refusal| refusal.to_string());
    let protection = parameter.protection().filter(|protection| !is_setting(*protection));
    let storage = parameter.behavior().map(|behavior| &behavior.storage);
    let volatile = (storage == Some(&Storage::Volatile)).then(|| "volatile".to_owned());
    refusal.or_else(|| protection.map(|protection| protection.to_string())).or(volatile)
}

/// Returns whether a protected parameter is a setting that belongs to a backup.
fn is_setting(protection: Protection) -> bool {
    matches!(
        protection,
        Protection::NodeId
            | Protection::BitRate
            | Protection::SideEffect
            | Protection::WriteOnce
            | Protection::RefusesDownload
    )
}

fn save(parameter: &Parameter<'_>, connection: &mut impl Connection, backup: &mut Backup) -> Result<(), Failure> {
    match read(parameter, connection) {
        Ok(Some(value)) => {
            let value = match backup.node_id.filter(|_| parameter.address().object().is_some()) {
                Some(node_id) => relative(parameter, value, node_id),
                None => value,
            };
            backup.entries.push(Entry::new(parameter, value));
        }
        Ok(None) => {
            backup.skipped.push(Skipped::failed(parameter, "the device sent bytes that are not a value of the type"))
        }
        Err(failure) if failure.is_missing() && is_optional(parameter) => {
            backup.skipped.push(Skipped::new(parameter, "the device doesn't have the parameter"));
        }
        Err(failure) if failure.is_refusal() => backup.skipped.push(Skipped::failed(parameter, failure)),
        Err(failure) => return Err(failure),
    }
    Ok(())
}

/// Returns whether the device can lack the parameter. This is so for entries of PDO mappings, for optional parameters, and
/// for parameters of some models or versions.
fn is_optional(parameter: &Parameter<'_>) -> bool {
    let is_mapping =
        parameter.address().object().is_some_and(|object| object.sub_index > 0 && pdo::is_mapping(object.index));
    is_mapping || parameter.item().is_optional || parameter.item().availability.is_some()
}

/// Reads a value. After a timeout, reads it again, up to three times in total. Returns `None` if the bytes are not a value
/// of the type.
pub(crate) fn read(
    parameter: &Parameter<'_>,
    connection: &mut impl Connection,
) -> Result<Option<lexibus_codegen::ir::Value>, Failure> {
    retried(|| parameter.read(connection).map(|reading| reading.value))
}
