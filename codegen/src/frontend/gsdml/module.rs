//! Reads the modules of a file.

use super::links::{ElementKind, Owner};
use super::reader::Reader;
use super::submodule::Holder;
use crate::frontend::xml::{Attributes, Read};
use crate::ir::{Catalog, Module};
use crate::syntax::xml::Tag;

impl<'a> Reader<'a, '_> {
    /// Reads a `ModuleList` element.
    pub fn module_list(&mut self, list: &Tag<'a>, catalog: &mut Catalog) -> Read<()> {
        self.each(list, "ModuleItem", |reader, tag| {
            let module = reader.module(tag, catalog)?;
            catalog.modules.push(module);
            Ok(())
        })
    }

    fn module(&mut self, parent: &Tag<'a>, catalog: &mut Catalog) -> Read<Module> {
        let (position, start) = (catalog.modules.len(), self.extensions.len());
        let mut module = Module { origin: self.origin(parent), ..Module::default() };
        let mut attributes = Attributes::new();
        let names = ["ID", "ModuleIdentNumber", "PhysicalSubslots"];
        let [id, ident, subslots] = self.attributes_and_others(parent, names, &mut attributes)?;
        self.register(parent, ElementKind::Module, &id, position);
        module.id = id.compact();
        module.number = self.required_ident(parent, &ident, "ModuleIdentNumber");
        module.subslots = self.numbers(&subslots);
        let mut info = None;
        while let Some(tag) = self.child(parent)? {
            match tag.name {
                "ModuleInfo" => info = Some(self.module_info(&tag)?),
                "VirtualSubmoduleList" | "SystemDefinedSubmoduleList" => {
                    let mut holder =
                        Holder { submodules: &mut catalog.submodules, uses: &mut module.submodules, settings: None };
                    self.built_in(&tag, &mut holder)?;
                }
                "UseableSubmodules" => self.useable_submodules(&tag, Owner::Module(position))?,
                "SubslotList" => module.subslot_names = self.subslot_list(&tag)?,
                "Graphics" => self.keep_graphics(&tag, &mut attributes)?,
                _ => self.unknown(&tag)?,
            }
        }
        match info {
            Some(mut info) => {
                // A module has fields for its releases, so they are no attributes.
                module.version = std::mem::take(&mut info.software).compact();
                module.revision = std::mem::take(&mut info.hardware).compact();
                info.add_to(&mut module.name, &mut module.documentation, &mut module.identity, &mut attributes);
            }
            None => self.missing(parent, "ModuleInfo", "the name is left empty"),
        }
        module.extensions = self.extensions_since(start);
        module.attributes = attributes;
        Ok(module)
    }
}
