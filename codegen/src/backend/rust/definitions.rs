//! Shares definitions between the devices and modules of a file. The first device or module with a definition contains
//! the code of the definition, and the others re-export it.

use super::code::Code;
use super::handle;
use super::model::Model;
use super::naming::handles::is_cased;
use super::objects::ObjectModel;
use super::print;
use super::reexport::{self, Home, Reexport, Section};
use super::shareable::{self, Shareable};
use crate::collections::HashMap;

/// The definitions of all devices and modules that were processed so far.
pub(super) struct Definitions {
    runtime: String,
    /// Number of each definition, keyed by its code and by the numbers of the definitions to which the code refers. The
    /// code alone is not enough, because two definitions with equal code can refer to different types.
    numbers: HashMap<(String, Vec<usize>), usize>,
    /// For each definition number, the name of the Rust module that contains the definition.
    homes: Vec<String>,
}

impl Definitions {
    /// Creates an empty set of definitions. `runtime` is the path of the runtime crate in the code of the definitions.
    pub fn new(runtime: &str) -> Self {
        Definitions { runtime: runtime.to_owned(), numbers: HashMap::default(), homes: Vec::new() }
    }

    /// Replaces each definition of `model` with a re-export if an earlier device or module contains the same
    /// definition. `module` is the module name of `model`.
    pub fn share(&mut self, model: &mut Model, module: &str) {
        model.is_one_of_several = true;
        let mut device = Device { all: self, module, numbers: HashMap::default(), reexports: Vec::new() };
        shareable::retain_types(&mut model.types, &mut |types| device.is_kept(types));
        shareable::retain_code_tables(&mut model.code_tables, &mut |table| device.is_kept(table));
        device.share_objects(model);
        device.share_process_data(model);
        model.reexports.extend(device.reexports);
    }
}

/// The definitions of the device that is being processed.
struct Device<'d> {
    all: &'d mut Definitions,
    module: &'d str,
    /// Numbers of the device's definitions so far, by section and name.
    numbers: HashMap<(Section, String), usize>,
    reexports: Vec<Reexport>,
}

impl Device<'_> {
    /// Adds a definition with these names. `used` contains the names in the definition's code that may refer to other
    /// definitions. Returns whether no earlier device or module contains the definition.
    fn is_new<'n>(
        &mut self,
        sections: &[Section],
        names: &[&str],
        used: impl Iterator<Item = (Section, &'n str)>,
        write: &dyn Fn(&mut Code),
    ) -> bool {
        let mut code = Code::new(String::new(), &self.all.runtime);
        write(&mut code);
        let used = used.filter_map(|(section, name)| self.numbers.get(&(section, name.to_owned())).copied()).collect();
        let next = self.all.homes.len();
        let number = *self.all.numbers.entry((code.finish(), used)).or_insert(next);
        let is_new = number == next;
        if is_new {
            self.all.homes.push(self.module.to_owned());
        }
        for section in sections {
            self.numbers.extend(names.iter().map(|name| ((*section, (*name).to_owned()), number)));
            if !is_new {
                self.reexport(*section, number, names);
            }
        }
        is_new
    }

    fn reexport(&mut self, section: Section, number: usize, names: &[&str]) {
        let home = Home::Module(self.all.homes[number].clone());
        names.iter().for_each(|name| reexport::add(&mut self.reexports, section, &home, name, String::new()));
    }

    fn is_kept(&mut self, definitions: &Shareable<'_>) -> bool {
        let names: Vec<&str> = definitions.names.iter().map(|(name, _)| *name).collect();
        self.is_new(&[definitions.section], &names, in_types(definitions.used.iter().copied()), definitions.write)
    }

    fn share_objects(&mut self, model: &mut Model) {
        if model.has_locations || !model.makers.is_empty() || !model.windows.is_empty() {
            return;
        }
        let is_reexported = |object: &ObjectModel| {
            let name = match object.items.as_slice() {
                [only] if !object.has_entries() => &only.constant,
                _ => &object.name,
            };
            let mut names = vec![name.as_str()];
            names.extend(object.accessors.as_deref().filter(|_| model.has_accessors));
            let write = |code: &mut Code| {
                code.line(&[&model.location]);
                print::objects::object(code, model, object);
            };
            let used = in_types(object.items.iter().filter_map(|item| item.type_name.as_deref()));
            // If a name contains no letters, a constant and a type can have the same name. The object is then defined
            // again, because a re-export of the name would include both.
            is_cased(&object.name) && !self.is_new(&[Section::Objects], &names, used, &write)
        };
        let reexported: Vec<bool> = model.objects.iter().map(is_reexported).collect();
        for (object, is_reexported) in model.objects.iter_mut().zip(reexported) {
            object.is_reexported = is_reexported;
        }
        model.handle_types = handle::types(model.objects.iter().filter(|object| !object.is_reexported));
    }

    fn share_process_data(&mut self, model: &mut Model) {
        let sections = if model.has_views { &[Section::Pdo, Section::View][..] } else { &[Section::Pdo] };
        model.pdos.retain(|pdo| {
            let write = |code: &mut Code| {
                print::pdos::pdo(code, pdo);
                print::views::view(code, pdo, true);
            };
            self.is_new(sections, &[&pdo.name], in_types(pdo.type_names()), &write)
        });
        model.images.retain(|image| {
            let used = image.fields.iter().map(|field| (Section::Pdo, field.pdo.as_str()));
            let names = [image.name.clone(), image.view_name()];
            self.is_new(&[Section::Image], &names.each_ref().map(String::as_str), used, &|code| {
                print::image::image(code, image)
            })
        });
    }
}

fn in_types<'n>(names: impl Iterator<Item = &'n str>) -> impl Iterator<Item = (Section, &'n str)> {
    names.map(|name| (Section::Types, name))
}
