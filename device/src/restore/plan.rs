//! The plan of a restore.

use std::collections::BTreeMap;
use std::fmt;

use super::order::ordered;
use crate::address::Address;
use crate::backup::{Backup, Skipped};
use crate::description::Description;
use crate::write::{Write, WriteError};

/// All writes of a restore in their order, and the values that are not written.
#[derive(Clone, Debug)]
pub struct Plan<'d> {
    /// Writes in their order.
    pub writes: Vec<Write<'d>>,
    /// Values of the backup that are not written, with the reason.
    pub refused: Vec<Skipped>,
}

impl<'d> Plan<'d> {
    /// Plans a restore. `node_id` is the node-ID of the device. `include` contains the addresses of the protected
    /// parameters to write; all other [protected](crate::Protection) parameters are refused.
    #[must_use]
    pub fn new(description: &'d Description, backup: &Backup, node_id: Option<u8>, include: &[Address]) -> Self {
        let (mut writes, mut refused) = (BTreeMap::new(), Vec::new());
        for entry in &backup.entries {
            let Some(parameter) = description.at(entry.address) else {
                let reason = "the description has no such parameter".to_owned();
                let (address, name) = (entry.address_text.clone(), entry.name.clone());
                refused.push(Skipped { address, name, reason, is_failure: true });
                continue;
            };
            let protection = parameter.protection().filter(|_| !include.contains(&entry.address));
            match (protection, Write::new(parameter, entry.value.clone(), node_id)) {
                (Some(protection), _) => refused.push(Skipped::new(&parameter, protection)),
                (None, Ok(write)) => drop(writes.insert(entry.address, write)),
                // Files of configuration tools can contain the values of read-only parameters too, so this is no failure.
                (None, Err(WriteError::ReadOnly)) => refused.push(Skipped::new(&parameter, WriteError::ReadOnly)),
                (None, Err(error)) => refused.push(Skipped::failed(&parameter, error)),
            }
        }
        let (writes, left_out) = ordered(description, backup, node_id, writes, include);
        refused.extend(left_out);
        Self { writes, refused }
    }
}

impl fmt::Display for Plan<'_> {
    /// Writes one line per write, and one line per refused value.
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        for write in &self.writes {
            writeln!(f, "write {write}")?;
        }
        for refused in &self.refused {
            writeln!(f, "refused {refused}")?;
        }
        Ok(())
    }
}
