//! After this pass the names of a register table's rows were held against each other, and against the breaks that a
//! printed column puts into them.

use std::collections::HashMap;

use crate::diagnostics::{codes, Diagnostic, Diagnostics};
use crate::ir::{Device, Group, GroupKind};
use crate::source::Span;
use crate::text::brief;

pub(super) fn run(device: &Device, diagnostics: &mut Diagnostics) {
    let mut objects = HashMap::new();
    for group in &device.groups {
        match group.kind {
            GroupKind::Object { index, .. } => {
                let at = group.name_at.or(group.origin.span);
                once(&mut objects, &group.name, at, "another object", diagnostics);
                unbroken(&group.name, at, diagnostics);
                if group.object_code().is_some_and(|code| code.has_subs()) {
                    subs(group, index, diagnostics);
                }
            }
            GroupKind::Chapter => registers(group, diagnostics),
            _ => {}
        }
    }
}

fn subs(group: &Group, index: u16, diagnostics: &mut Diagnostics) {
    let mut names = HashMap::new();
    let other = format!("another sub-index of 0x{index:04X}");
    // Of a reserved sub-index there is nothing to say.
    for item in group.items.iter().filter(|item| !item.extensions.iter().any(|own| own.key == "reserved")) {
        let at = item.at.name.or(item.origin.span);
        once(&mut names, &item.name, at, &other, diagnostics);
        unbroken(&item.name, at, diagnostics);
    }
}

fn registers(group: &Group, diagnostics: &mut Diagnostics) {
    for item in &group.items {
        let at = item.at.name.or(item.origin.span);
        if item.name.trim().is_empty() {
            diagnostics.push(Diagnostic::new(&codes::EMPTY_NAME, at, "the row has no name"));
        }
        unbroken(&item.name, at, diagnostics);
    }
}

fn once<'n>(seen: &mut HashMap<&'n str, Span>, name: &'n str, at: Span, whose: &str, diagnostics: &mut Diagnostics) {
    if name.is_empty() {
        return;
    }
    let first = *seen.entry(name).or_insert(at);
    if first != at {
        let message = format!("{whose} is called `{}` too", brief(name));
        diagnostics.push(Diagnostic::new(&codes::NAME_TWICE, at, message).note_at(first, "the first one"));
    }
}

/// A column of a manual breaks `Rtouchprobefunc` into `Rtouchpro- befunc`.
fn unbroken(name: &str, at: Span, diagnostics: &mut Diagnostics) {
    let is_broken = name.split_once("- ").is_some_and(|(head, tail)| {
        head.ends_with(char::is_alphanumeric) && tail.trim_start().starts_with(char::is_alphanumeric)
    });
    if is_broken {
        let whole: String = name.replace("- ", "");
        let message = format!("`{}` has the hyphen of a line break in it", brief(name));
        let found = Diagnostic::new(&codes::BROKEN_NAME, at, message);
        diagnostics.push(found.help(format!("write `{}`, if the manual's text does", brief(&whole))));
    }
}
