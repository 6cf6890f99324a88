//! Declared nodes with their descriptions.

use std::rc::Rc;

use lexibus_codegen::diagnostics::Diagnostics;
use lexibus_codegen::ir::{Bus, Direction};

use super::pdo_values::direction;
use super::writer::Writer;
use crate::declared::DeclaredNode;
use crate::description::Description;
use crate::values::{Values, Write};

/// A declared node with its description, and with the values of `parameters`, which are written last.
pub(super) struct DescribedNode<'n> {
    pub declared: &'n DeclaredNode,
    pub id: u8,
    pub description: Rc<Description>,
    pub parameters: Vec<Write>,
}

impl<'n> DescribedNode<'n> {
    /// Looks up the objects of `parameters`, and converts their values.
    pub fn new(
        declared: &'n DeclaredNode,
        id: u8,
        description: Rc<Description>,
        diagnostics: &mut Diagnostics,
    ) -> Self {
        let mut writer =
            Writer { device: description.device(), bus: Bus::CanOpen, id, writes: Vec::new(), diagnostics };
        declared.parameters.iter().for_each(|parameter| writer.parameter(parameter));
        let parameters = writer.writes;
        DescribedNode { declared, id, description, parameters }
    }

    /// Returns the name of the node.
    pub fn name(&self) -> &'n str {
        &self.declared.name.value
    }

    /// Returns whether the file has a section for a PDO.
    pub fn declares(&self, of: Direction, number: u16) -> bool {
        self.declared.pdos.iter().any(|pdo| direction(pdo) == of && pdo.number.value == number)
    }

    /// Returns the values of `parameters`, and the initial values of all other objects.
    pub fn values(&self) -> Values<'_> {
        Values { device: self.description.device(), id: self.id, writes: &self.parameters }
    }

    /// Returns the initial values of all objects.
    pub fn initial(&self) -> Values<'_> {
        Values { writes: &[], ..self.values() }
    }
}
