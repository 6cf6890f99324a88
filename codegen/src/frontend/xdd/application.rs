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
    /// Parameters, and variables of structures, to which sub-objects may refer as well.
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
    /// Whether the source has a default for the access: a variable hasn't.
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
    /// Length of its element, which bounds what copies of it may cost.
    pub weight: usize,
    /// The structure and field, if it is a variable of one.
    pub field: Option<(usize, usize)>,
}

/// allowedValues or allowedValuesTemplate.
#[derive(Default)]
pub(super) struct Allowed<'a> {
    pub template: Given<'a>,
    pub values: Vec<(Given<'a>, Texts<'a>)>,
    pub ranges: Vec<AllowedRange<'a>>,
    /// Length of its element.
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

/// A parameter with the template it refers to; the parameter's own facts count first.
#[derive(Clone, Copy)]
pub(super) struct View<'p, 'a> {
    /// Position of the parameter.
    pub position: Option<usize>,
    parameter: Option<&'p Parameter<'a>>,
    template: Option<&'p Parameter<'a>>,
}

impl<'p, 'a> View<'p, 'a> {
    /// Of an object that refers to no parameter.
    pub const NONE: Self = View { position: None, parameter: None, template: None };

    pub fn exists(&self) -> bool {
        self.parameter.is_some()
    }

    pub fn parameter(&self) -> Option<&'p Parameter<'a>> {
        self.parameter
    }

    /// The first of the two that has the fact.
    pub fn find<T>(&self, fact: impl Fn(&'p Parameter<'a>) -> Option<T>) -> Option<T> {
        self.parameter.and_then(&fact).or_else(|| self.template.and_then(&fact))
    }

    /// The labels and descriptions, each of the first of the two that has any.
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

    /// What a copy costs.
    pub fn weight(&self) -> usize {
        self.parameter.map_or(0, |parameter| parameter.weight) + self.template.map_or(0, |template| template.weight)
    }
}

impl<'a> Application<'a> {
    /// The parameter to which an object refers.
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

    /// The allowed values of a parameter, perhaps those of a template.
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
    let message = format!("no {what} has the uniqueID `{}`", brief(&given.text));
    reader.report(&codes::DANGLING_REFERENCE, given.span, message, "not resolved");
}

/// Registers the position of an element by its uniqueID; the first element of that name counts.
pub(super) fn insert(reader: &mut Reader<'_, '_>, ids: &mut Ids, given: Given<'_>, position: usize) {
    if given.is_missing() {
        return;
    }
    if ids.contains_key(given.text.as_ref()) {
        reader.bad(&given, "unique identifier: it occurs twice", "references lead to the first");
        return;
    }
    ids.insert(given.text.into_owned(), position);
}
