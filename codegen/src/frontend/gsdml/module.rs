//! Modules, and what modules, submodules and device access points have in common.

use super::links::{Kind, Owner};
use super::reader::{Attributes, Given, Read, Reader};
use super::submodule::Holder;
use crate::ir::{Catalog, CompactString, Documentation, Extension, Extensions, Module};
use crate::syntax::xml::Tag;

/// ModuleInfo.
#[derive(Default)]
pub(super) struct Info<'a> {
    /// What stands for the name.
    pub name: CompactString,
    pub documentation: Option<Box<Documentation>>,
    pub vendor: Option<Given<'a>>,
    pub order: Option<Given<'a>>,
    pub hardware: Option<Given<'a>>,
    pub software: Option<Given<'a>>,
    /// Category and family.
    pub attributes: Attributes,
}

/// Pictures, by kind.
pub(super) type Graphics = Vec<(CompactString, CompactString)>;

impl<'a> Reader<'a, '_> {
    /// Reads ModuleList.
    pub fn module_list(&mut self, list: &Tag<'a>, catalog: &mut Catalog) -> Read<()> {
        while let Some(tag) = self.cursor.child(list)? {
            match tag.name {
                "ModuleItem" => {
                    let module = self.module(&tag, catalog)?;
                    catalog.modules.push(module);
                }
                _ => self.unknown(&tag, &mut catalog.extensions)?,
            }
        }
        Ok(())
    }

    fn module(&mut self, parent: &Tag<'a>, catalog: &mut Catalog) -> Read<Module> {
        let position = catalog.modules.len();
        let mut module = Module { origin: self.cursor.origin(parent), ..Module::default() };
        let mut attributes = Attributes::new();
        let names = ["ID", "ModuleIdentNumber", "PhysicalSubslots"];
        let [id, ident, subslots] = self.fields_of(parent, &names, &mut attributes)?;
        self.register(parent, Kind::Module, id.as_ref(), position);
        module.id = id.map_or_else(CompactString::default, |id| id.text.into());
        module.number = self.required_ident(parent, ident.as_ref(), "ModuleIdentNumber");
        module.subslots = self.numbers(subslots.as_ref());
        let mut info = None;
        while let Some(tag) = self.cursor.child(parent)? {
            match tag.name {
                "ModuleInfo" => info = Some(self.module_info(&tag, &mut module.extensions)?),
                "VirtualSubmoduleList" | "SystemDefinedSubmoduleList" => {
                    let mut holder = Holder {
                        submodules: &mut catalog.submodules,
                        uses: &mut module.submodules,
                        settings: None,
                        extensions: &mut module.extensions,
                    };
                    self.built_in(&tag, &mut holder)?;
                }
                "UseableSubmodules" => {
                    self.useable_submodules(&tag, Owner::Module(position), &mut module.extensions)?;
                }
                "SubslotList" => module.subslot_names = self.subslot_list(&tag, &mut module.extensions)?,
                "Graphics" => {
                    let graphics = self.graphics(&tag, &mut module.extensions)?;
                    attributes.extend(graphics.into_iter().map(named_graphic));
                }
                _ => self.unknown(&tag, &mut module.extensions)?,
            }
        }
        match info {
            Some(info) => info.of_module(&mut module, &mut attributes),
            None => self.missing(parent, "ModuleInfo", "its name is left empty"),
        }
        let span = module.origin.span;
        module.extensions.extend(attributes.into_iter().map(|(key, value)| Extension { key, value, span }));
        Ok(module)
    }

    /// Reads ModuleInfo.
    pub fn module_info(&mut self, parent: &Tag<'a>, rest: &mut Extensions) -> Read<Info<'a>> {
        let mut info = Info::default();
        let [category, sub_category] = self.fields(parent, &["CategoryRef", "SubCategory1Ref"], rest)?;
        for (key, given) in [("CategoryRef", category), ("SubCategory1Ref", sub_category)] {
            if let Some(given) = given {
                self.links.mention(Kind::Category, &given);
                info.attributes.push((key.into(), given.text.into()));
            }
        }
        while let Some(tag) = self.cursor.child(parent)? {
            match tag.name {
                "Name" => info.name = self.text_reference(&tag)?,
                "InfoText" => info.documentation = self.documentation(&tag)?,
                "VendorName" => info.vendor = self.value_of(&tag)?,
                "OrderNumber" => info.order = self.value_of(&tag)?,
                "HardwareRelease" => info.hardware = self.value_of(&tag)?,
                "SoftwareRelease" => info.software = self.value_of(&tag)?,
                "Family" => self.keep_attributes(&tag, &mut info.attributes)?,
                _ => self.unknown(&tag, rest)?,
            }
        }
        if info.name.is_empty() {
            self.missing(parent, "Name", "its name is left empty");
        }
        Ok(info)
    }

    fn value_of(&mut self, tag: &Tag<'a>) -> Read<Option<Given<'a>>> {
        let given = self.field(tag, "Value")?;
        if given.is_none() {
            self.missing(tag, "Value", "left empty");
        }
        Ok(given)
    }

    /// Reads Graphics.
    pub fn graphics(&mut self, list: &Tag<'a>, rest: &mut Extensions) -> Read<Graphics> {
        let mut graphics = Graphics::new();
        while let Some(tag) = self.cursor.child(list)? {
            if tag.name != "GraphicItemRef" {
                self.unknown(&tag, rest)?;
                continue;
            }
            let [kind, target] = self.fields(&tag, &["Type", "GraphicItemTarget"], rest)?;
            let kind = kind.map_or_else(CompactString::default, |given| given.text.into());
            match target {
                Some(target) => {
                    self.links.mention(Kind::Graphic, &target);
                    graphics.push((kind, target.text.into()));
                }
                None => self.missing(&tag, "GraphicItemTarget", "left out"),
            }
            self.no_children(&tag, rest)?;
        }
        Ok(graphics)
    }
}

/// A picture as an attribute of what has no list of pictures.
pub(super) fn named_graphic((kind, target): (CompactString, CompactString)) -> (CompactString, CompactString) {
    let mut key = CompactString::from("GraphicItemRef@");
    key.push_str(&kind);
    (key, target)
}

impl Info<'_> {
    /// What ModuleInfo says of a module.
    fn of_module(self, module: &mut Module, attributes: &mut Attributes) {
        let text = |given: Option<Given<'_>>| given.map_or_else(CompactString::default, |given| given.text.into());
        module.name = self.name;
        module.documentation = self.documentation;
        module.identity.vendor_name = text(self.vendor);
        module.identity.order_code = text(self.order);
        module.version = text(self.software);
        module.revision = text(self.hardware);
        attributes.extend(self.attributes);
    }
}
