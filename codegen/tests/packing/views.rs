//! The views of generated code, found by the lines of its text: process data that are read and written where they stand.

use std::collections::HashMap;

use crate::found::each_line;
use crate::messages::bare;

/// The methods of generic types, by the path of the type; of those that need data to write to, with `&mut` in front.
pub struct Views<'t>(HashMap<String, Vec<&'t str>>);

impl<'t> Views<'t> {
    pub fn new(text: &'t str) -> Self {
        let (mut views, mut own): (HashMap<String, Vec<_>>, _) = (HashMap::new(), String::new());
        each_line(text, |modules, code| {
            if code.starts_with("impl") || code.starts_with("pub mod ") {
                let name = code.trim_end_matches(" {").rsplit_once("> ").map_or("", |(_, name)| bare(name));
                let start = if code.contains("AsMut<") { "&mut " } else { "" };
                own = format!("{start}{}", [modules, &[name]].concat().join("::"));
            }
            let code = code.strip_prefix("pub ").map(|code| code.trim_start_matches("const "));
            let name = code.and_then(|code| code.strip_prefix("fn ")?.split_once('('));
            if let Some((name, _)) = name {
                views.entry(own.clone()).or_default().push(name);
            }
        });
        Views(views)
    }

    /// The methods of a type but `new` and those like it, each beside the field that it is of.
    fn methods(&self, path: &str, others: usize, fields: &[(&'t str, &'t str)]) -> Vec<(&'t str, &'t str)> {
        let all = self.0.get(path).map(Vec::as_slice).unwrap_or_default();
        assert_eq!(all.len(), others + fields.len(), "{path}: {all:?}");
        fields.iter().map(|(field, _)| *field).zip(all[others..].iter().copied()).collect()
    }

    /// The statements that check the view of process data, where there is one: `modules` and `name` are those of the type.
    pub fn check(&self, modules: &[&str], name: &str, fields: &[(&'t str, &'t str)]) -> Option<String> {
        let place = modules.join("::");
        let own = format!("{place}::{name}");
        if modules.last() == Some(&"pdo") {
            let view = [&modules[..modules.len() - 1], &["view", name]].concat().join("::");
            return self.0.contains_key(&view).then(|| self.of_pdo(&own, &view, fields));
        }
        let (view, writer) = (format!("{own}View"), format!("{own}Mut"));
        if modules.last() == Some(&"image") {
            return Some(self.of_image(&own, &view, fields));
        }
        self.0.contains_key(&writer).then(|| self.of_submodule(&own, &view, &writer, fields))
    }

    /// A view of a PDO, which may begin at any bit.
    fn of_pdo(&self, own: &str, view: &str, fields: &[(&'t str, &'t str)]) -> String {
        let getters = listed(&self.methods(view, 2, fields));
        let setters = numbered(&self.methods(&format!("&mut {view}"), 0, fields));
        let at = |data: &str| format!("MODULE::{view}::at({data}, bit)");
        format!(
            "getters!(MODULE::{own}, MODULE::{view}<&[u8]>, |own| own, [{getters}]); \
             setters!(MODULE::{own}, MODULE::{view}<&mut [u8]>, [{setters}]); \
             view!(MODULE::{own}, layout, 8, |data, bit| {}, {});",
            at("&*data"),
            at("&mut *data"),
        )
    }

    /// A view of the image of a sync manager, which has those of PDOs.
    fn of_image(&self, own: &str, view: &str, fields: &[(&'t str, &'t str)]) -> String {
        let readers = listed(&self.methods(view, 1, fields));
        let writers = numbered(&self.methods(&format!("&mut {view}"), 0, fields));
        format!(
            "image_views!(MODULE::{own}, MODULE::{view}<&[u8]>, MODULE::{view}<&mut [u8]>, [{readers}], [{writers}]); \
             view!(MODULE::{own}, layout, 1, |data, _bit| MODULE::{view}::new(&*data), MODULE::{view}::new(&mut *data));"
        )
    }

    /// Outputs of PROFINET: what writes them can be read, too.
    fn of_submodule(&self, own: &str, view: &str, writer: &str, fields: &[(&'t str, &'t str)]) -> String {
        let getters = listed(&self.methods(view, 1, fields));
        let setters = numbered(&self.methods(writer, 2, fields));
        let new = format!("MODULE::{writer}::new(data)");
        format!(
            "getters!(MODULE::{own}, MODULE::{writer}<'_>, |own| own.view(), [{getters}]); \
             setters!(MODULE::{own}, MODULE::{writer}<'_>, [{setters}]); \
             view!(MODULE::{own}, layout, 1, |data, _bit| {new}, {new});"
        )
    }
}

/// How many views the text has.
pub fn count(text: &str) -> usize {
    let is_view = |line: &&str| {
        let name = line.trim_start().strip_prefix("pub struct ");
        name.is_some_and(|name| name.ends_with("<B> {") || name.starts_with("OutputsMut<"))
    };
    text.lines().filter(is_view).count()
}

fn listed(methods: &[(&str, &str)]) -> String {
    methods.iter().map(|(field, method)| format!("{field} {method}, ")).collect()
}

fn numbered(methods: &[(&str, &str)]) -> String {
    methods.iter().enumerate().map(|(at, (field, method))| format!("{at} {field} {method}, ")).collect()
}
