//! Reads `ModuleInfo` and `Graphics` elements, which modules, submodules and device access points have.

use std::sync::Arc;

use compact_str::format_compact;

use super::links::ElementKind;
use super::reader::Reader;
use crate::frontend::xml::{Attributes, Given, Read};
use crate::ir::{CompactString, Documentation, Identity};
use crate::syntax::xml::Tag;

/// Contents of a `ModuleInfo` element.
#[derive(Default)]
pub(super) struct Info<'a> {
    /// Placeholder for the name of the module, submodule or device.
    pub name: CompactString,
    pub documentation: Option<Arc<Documentation>>,
    pub vendor: Given<'a>,
    pub order: Given<'a>,
    pub hardware: Given<'a>,
    pub software: Given<'a>,
    /// Attributes for the category and the family.
    pub attributes: Attributes,
}

/// Kind and identifier of each graphic.
pub(super) type Graphics = Vec<(CompactString, CompactString)>;

impl<'a> Reader<'a, '_> {
    /// Reads a `ModuleInfo` element.
    pub fn module_info(&mut self, parent: &Tag<'a>) -> Read<Info<'a>> {
        let mut info = Info::default();
        let [category, sub_category] = self.attributes(parent, ["CategoryRef", "SubCategory1Ref"])?;
        for (key, given) in [("CategoryRef", category), ("SubCategory1Ref", sub_category)] {
            if !given.is_missing() {
                self.format.links.others.push((ElementKind::Category, given.clone()));
                info.attributes.extend(given.attribute(key));
            }
        }
        while let Some(tag) = self.child(parent)? {
            match tag.name {
                "Name" => info.name = self.text_reference(&tag)?,
                "InfoText" => info.documentation = self.documentation(&tag)?,
                "VendorName" => info.vendor = self.single(&tag, "Value")?,
                "OrderNumber" => info.order = self.single(&tag, "Value")?,
                "HardwareRelease" => info.hardware = self.single(&tag, "Value")?,
                "SoftwareRelease" => info.software = self.single(&tag, "Value")?,
                "Family" => self.keep_as_attributes(&tag, &mut info.attributes)?,
                _ => self.unknown(&tag)?,
            }
        }
        if info.name.is_empty() {
            self.missing(parent, "Name", "the name is left empty");
        }
        Ok(info)
    }

    /// Reads a `Graphics` element.
    pub fn graphics(&mut self, list: &Tag<'a>) -> Read<Graphics> {
        let mut graphics = Graphics::new();
        self.each(list, "GraphicItemRef", |reader, tag| {
            let [kind, target] = reader.attributes(tag, ["Type", "GraphicItemTarget"])?;
            if reader.require(tag, &target, "GraphicItemTarget", "left out") {
                reader.format.links.others.push((ElementKind::Graphic, target.clone()));
                graphics.push((kind.compact(), target.compact()));
            }
            reader.no_children(tag)
        })?;
        Ok(graphics)
    }

    /// Reads a `Graphics` element of an element that has no list of graphics in the IR.
    pub fn keep_graphics(&mut self, list: &Tag<'a>, attributes: &mut Attributes) -> Read<()> {
        let named = |(kind, target)| (format_compact!("GraphicItemRef@{kind}"), target);
        attributes.extend(self.graphics(list)?.into_iter().map(named));
        Ok(())
    }
}

impl Info<'_> {
    /// Adds the contents of a `ModuleInfo` element to a device access point, module or submodule.
    pub fn add_to(
        self,
        name: &mut CompactString,
        documentation: &mut Option<Arc<Documentation>>,
        identity: &mut Identity,
        attributes: &mut Attributes,
    ) {
        // A submodule may already have a name from `TextId`.
        if !self.name.is_empty() {
            *name = self.name;
        }
        *documentation = self.documentation;
        (identity.vendor_name, identity.order_code) = (self.vendor.compact(), self.order.compact());
        attributes.extend(self.hardware.attribute("HardwareRelease"));
        attributes.extend(self.software.attribute("SoftwareRelease"));
        attributes.extend(self.attributes);
    }
}
