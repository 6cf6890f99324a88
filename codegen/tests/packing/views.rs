//! Finds the views in generated code. A view reads and writes fields within process data. Reads the text line by line.

use std::collections::HashMap;

use crate::found::each_line;
use crate::messages::bare;

/// Methods of generic types, by path. The paths of types that need writable data start with `&mut`.
pub struct Views<'t>(HashMap<String, Vec<&'t str>>);

impl<'t> Views<'t> {
    pub fn new(text: &'t str) -> Self {
        let (mut views, mut current): (HashMap<String, Vec<_>>, _) = (HashMap::new(), String::new());
        each_line(text, |modules, code| {
            if code.starts_with("impl") || code.starts_with("pub mod ") {
                let name = code.trim_end_matches(" {").rsplit_once("> ").map_or("", |(_, name)| bare(name));
                let start = if code.contains("AsMut<") { "&mut " } else { "" };
                current = format!("{start}{}", [modules, &[name]].concat().join("::"));
            }
            let code = code.strip_prefix("pub ").map(|code| code.trim_start_matches("const "));
            let name = code.and_then(|code| code.strip_prefix("fn ")?.split_once('('));
            if let Some((name, _)) = name {
                views.entry(current.clone()).or_default().push(name);
            }
        });
        Views(views)
    }

    /// Returns the fields of a type, each with its method. The first `others` methods, such as `new`, are left out.
    fn methods(&self, path: &str, others: usize, fields: &[(&'t str, &'t str)]) -> Vec<(&'t str, &'t str)> {
        let all = self.0.get(path).map(Vec::as_slice).unwrap_or_default();
        assert_eq!(all.len(), others + fields.len(), "{path}: {all:?}");
        fields.iter().map(|(field, _)| *field).zip(all[others..].iter().copied()).collect()
    }

    /// Returns the statements that check the view of process data, if the view exists. `modules` and `name` are the path of the
    /// type that contains the unpacked process data.
    pub fn check(&self, modules: &[&str], name: &str, fields: &[(&'t str, &'t str)]) -> Option<String> {
        let module = modules.join("::");
        let path = format!("{module}::{name}");
        if modules.last() == Some(&"pdo") {
            let view = [&modules[..modules.len() - 1], &["view", name]].concat().join("::");
            return self.0.contains_key(&view).then(|| self.of_pdo(&path, &view, fields));
        }
        let (view, writer) = (format!("{path}View"), format!("{path}Mut"));
        if modules.last() == Some(&"image") {
            return Some(self.of_image(&path, &view, fields));
        }
        self.0.contains_key(&writer).then(|| self.of_submodule(&path, &view, &writer, fields))
    }

    /// Returns the statements that check the view of a PDO. The view can start at any bit.
    fn of_pdo(&self, path: &str, view: &str, fields: &[(&'t str, &'t str)]) -> String {
        let getters = listed(&self.methods(view, 2, fields));
        let setters = numbered(&self.methods(&format!("&mut {view}"), 0, fields));
        let at = |data: &str| format!("MODULE::{view}::at({data}, bit)");
        format!(
            "getters!(MODULE::{path}, MODULE::{view}<&[u8]>, |entry| entry, [{getters}]); \
             setters!(MODULE::{path}, MODULE::{view}<&mut [u8]>, [{setters}]); \
             view!(MODULE::{path}, layout, 8, |data, bit| {}, {});",
            at("&*data"),
            at("&mut *data"),
        )
    }

    /// Returns the statements that check the view of a sync manager's image. The view contains views of PDOs.
    fn of_image(&self, path: &str, view: &str, fields: &[(&'t str, &'t str)]) -> String {
        let readers = listed(&self.methods(view, 1, fields));
        let writers = numbered(&self.methods(&format!("&mut {view}"), 0, fields));
        format!(
            "image_views!(MODULE::{path}, MODULE::{view}<&[u8]>, MODULE::{view}<&mut [u8]>, [{readers}], [{writers}]); \
             view!(MODULE::{path}, layout, 1, |data, _bit| MODULE::{view}::new(&*data), MODULE::{view}::new(&mut *data));"
        )
    }

    /// Returns the statements that check the views of PROFINET outputs: a view for reading, and a view for reading and writing.
    fn of_submodule(&self, path: &str, view: &str, writer: &str, fields: &[(&'t str, &'t str)]) -> String {
        let getters = listed(&self.methods(view, 1, fields));
        let setters = numbered(&self.methods(writer, 2, fields));
        let new = format!("MODULE::{writer}::new(data)");
        format!(
            "getters!(MODULE::{path}, MODULE::{writer}<'_>, |entry| entry.view(), [{getters}]); \
             setters!(MODULE::{path}, MODULE::{writer}<'_>, [{setters}]); \
             view!(MODULE::{path}, layout, 1, |data, _bit| {new}, {new});"
        )
    }
}

/// Returns the number of views in the text.
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
