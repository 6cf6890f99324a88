//! The application process: parameters, parameter templates and data types by their uniqueID.
//!
//! Values are converted only when an object refers to a parameter, because its data type may be that of the object.

use std::collections::HashMap;

use super::data_type::{RawType, TypeRef};
use super::reader::{Lang, Reader, Texts};
use crate::diagnostics::codes;
use crate::frontend::xml::{Given, Names};
use crate::ir::{Extension, Extensions};
use crate::text::brief;

/// Positions of elements by their uniqueID.
pub(super) type Ids = HashMap<String, usize>;

#[derive(Default)]
pub(super) struct Application<'a> {
    /// Parameters, and variables of structures. Sub-objects may refer to both.
    pub parameters: Vec<Parameter<'a>>,
    pub templates: Vec<Parameter<'a>>,
    pub allowed_templates: Vec<Allowed<'a>>,
    pub types: Vec<RawType<'a>>,
    pub parameter_ids: Ids,
    pub template_ids: Ids,
    pub allowed_ids: Ids,
    pub type_ids: Ids,
}

/// A parameter, a parameterTemplate or a varDeclaration.
#[derive(Default)]
pub(super) struct Parameter<'a> {
    pub template: Given<'a>,
    pub access: Given<'a>,
    /// Whether the parameter is a variable. A variable has no default access rights.
    pub is_variable: bool,
    pub support: Given<'a>,
    pub persistent: Given<'a>,
    pub offset: Given<'a>,
    pub multiplier: Given<'a>,
    pub texts: Texts<'a>,
    pub denotation: Option<Box<Texts<'a>>>,
    pub ty: Option<TypeRef<'a>>,
    pub default: Given<'a>,
    pub actual: Given<'a>,
    pub allowed: Option<Box<Allowed<'a>>>,
    pub unit: Option<Box<Unit<'a>>>,
    pub extensions: Extensions,
    /// Length of its element in bytes. It limits how often the parameter is copied.
    pub weight: usize,
    /// Structure and field, if it is a variable of a structure.
    pub field: Option<(usize, usize)>,
}

/// An allowedValues or allowedValuesTemplate element.
#[derive(Default)]
pub(super) struct Allowed<'a> {
    pub template: Given<'a>,
    pub values: Vec<(Given<'a>, Texts<'a>)>,
    pub ranges: Vec<AllowedRange<'a>>,
    /// Length of its element in bytes.
    pub weight: usize,
}

#[derive(Default)]
pub(super) struct AllowedRange<'a> {
    pub low: Given<'a>,
    pub high: Given<'a>,
    pub step: Given<'a>,
}

#[derive(Default)]
pub(super) struct Unit<'a> {
    pub multiplier: Given<'a>,
    pub uri: Given<'a>,
    pub texts: Texts<'a>,
}

/// A parameter with its template. Facts of the parameter take precedence.
#[derive(Clone, Copy)]
pub(super) struct View<'p, 'a> {
    /// Position of the parameter.
    pub position: Option<usize>,
    parameter: Option<&'p Parameter<'a>>,
    template: Option<&'p Parameter<'a>>,
}

impl<'p, 'a> View<'p, 'a> {
    /// View of an object without a parameter.
    pub const NONE: Self = View { position: None, parameter: None, template: None };

    pub fn exists(&self) -> bool {
        self.parameter.is_some()
    }

    pub fn parameter(&self) -> Option<&'p Parameter<'a>> {
        self.parameter
    }

    /// Returns the fact from the parameter, or from the template if the parameter does not have it.
    pub fn find<T>(&self, fact: impl Fn(&'p Parameter<'a>) -> Option<T>) -> Option<T> {
        self.parameter.and_then(&fact).or_else(|| self.template.and_then(&fact))
    }

    /// Returns the labels and descriptions. Each is from the parameter, or from the template if the parameter has
    /// none.
    pub fn texts(&self) -> Texts<'a> {
        let has = |names: &&'p Names<'a, Lang>| !names.is_empty();
        let labels = self.find(|parameter| Some(&parameter.texts.labels).filter(has));
        let descriptions = self.find(|parameter| Some(&parameter.texts.descriptions).filter(has));
        let names = |names: Option<&Names<'a, Lang>>| names.map_or_else(Names::default, Names::clone);
        Texts { labels: names(labels), descriptions: names(descriptions) }
    }

    pub fn extensions(&self) -> impl Iterator<Item = &'p Extension> + use<'p, 'a> {
        let of = |parameter: Option<&'p Parameter<'a>>| parameter.map_or(&[][..], |parameter| &parameter.extensions);
        of(self.parameter).iter().chain(of(self.template))
    }

    /// Returns the length in bytes of the parameter and its template in the file, which is the cost of a copy.
    pub fn weight(&self) -> usize {
        self.parameter.map_or(0, |parameter| parameter.weight) + self.template.map_or(0, |template| template.weight)
    }
}

impl<'a> Application<'a> {
    /// Returns the parameter to which an object refers.
    pub fn view(&self, reader: &mut Reader<'a, '_>, given: &Given<'a>) -> View<'_, 'a> {
        if given.is_missing() {
            return View::NONE;
        }
        let Some(&position) = self.parameter_ids.get(given.text.as_ref()) else {
            dangling(reader, given, "parameter");
            return View::NONE;
        };
        let parameter = &self.parameters[position];
        let template = parameter.template.non_empty().and_then(|given| {
            let template = self.template_ids.get(given.text.as_ref()).map(|&at| &self.templates[at]);
            if template.is_none() {
                dangling(reader, given, "parameterTemplate");
            }
            template
        });
        View { position: Some(position), parameter: Some(parameter), template }
    }

    /// Returns the allowed values of a parameter, or those of the template it refers to.
    pub fn allowed<'p>(&'p self, reader: &mut Reader<'a, '_>, allowed: &'p Allowed<'a>) -> &'p Allowed<'a> {
        let given = &allowed.template;
        if given.is_missing() {
            return allowed;
        }
        match self.allowed_ids.get(given.text.as_ref()) {
            Some(&at) => &self.allowed_templates[at],
            None => {
                dangling(reader, given, "allowedValuesTemplate");
                allowed
            }
        }
    }
}

pub(super) fn dangling(reader: &mut Reader<'_, '_>, given: &Given<'_>, what: &str) {
    let message = format!("there is no {what} with the uniqueID `{}`", brief(&given.text));
    reader.report(&codes::DANGLING_REFERENCE, given.span, message, "the reference is ignored");
}

/// Registers the position of an element by its uniqueID. The first element with a uniqueID takes precedence.
pub(super) fn insert(reader: &mut Reader<'_, '_>, ids: &mut Ids, given: Given<'_>, position: usize) {
    if given.is_missing() {
        return;
    }
    if ids.contains_key(given.text.as_ref()) {
        reader.bad(&given, "uniqueID: it occurs twice", "references resolve to the first element");
        return;
    }
    ids.insert(given.text.into_owned(), position);
}
