//! Profiles as text: the fields of each structure in order, each followed by a tab. Each element of a list starts on a new line.
//!
//! A unit test checks that the files `stored/*.txt` contain the facts of `dictionaries/profiles/*.toml`. To write the files, run
//! `LEXIBUS_BLESS=1 cargo test -p lexibus-codegen --lib resolve::profiles::stored`.

use std::sync::Arc;

use super::profile::{Described, Profile, Signal, Telegram};
use crate::ir::{
    Access, Behavior, BitFieldEntry, BitMeaning, CodeRow, CodeTable, CommandRef, CompactString, Condition, Direction,
    Documentation, Doubt, Doubts, ElementRef, EnumValue, FactOrigin, ItemRef, ObjectBuses, Pattern, Quantity, Scale,
    Severity, Shape, SharedList, StateMachine, StateRef, Storage, Transition, Trigger, Type, TypeDef, TypeId, TypeRef,
    Value, Zone,
};

/// The remaining fields of a stored profile.
type Fields<'t> = std::str::Split<'t, char>;

/// Reads a stored profile. Returns `None` if the text is not a stored profile.
pub(super) fn read(text: &str) -> Option<Profile> {
    Stored::read(&mut text.split('\t'))
}

/// A type that can be read from, and written to, the text of a profile.
trait Stored: Sized {
    fn read(fields: &mut Fields<'_>) -> Option<Self>;
    #[cfg(test)]
    fn write(&self, text: &mut String);
}

/// Returns the next field. Removes the line feed that precedes an element of a list.
fn next<'t>(fields: &mut Fields<'t>) -> Option<&'t str> {
    fields.next().map(|field| field.strip_prefix('\n').unwrap_or(field))
}

/// Appends a field and a tab to the text.
#[cfg(test)]
fn write(text: &mut String, field: &str) {
    assert!(!field.contains(['\t', '\n']), "{field:?} cannot be stored");
    text.push_str(field);
    text.push('\t');
}

impl Stored for Box<str> {
    fn read(fields: &mut Fields<'_>) -> Option<Self> {
        next(fields).map(Box::from)
    }

    #[cfg(test)]
    fn write(&self, text: &mut String) {
        write(text, self);
    }
}

/// Implements `Stored` for types that are parsed from a single field.
macro_rules! parsed {
    ($($name:ty),*) => {$(
        impl Stored for $name {
            fn read(fields: &mut Fields<'_>) -> Option<Self> {
                next(fields)?.parse().ok()
            }

            #[cfg(test)]
            fn write(&self, text: &mut String) {
                write(text, &self.to_string());
            }
        }
    )*};
}

parsed!(bool, u8, u16, u32, u64, i128, f64, usize, String, CompactString);

/// Implements `Stored` for types that are stored as another type.
macro_rules! wrapped {
    ($($name:ty: $inner:ty, $read:expr, $write:expr;)*) => {$(
        impl Stored for $name {
            fn read(fields: &mut Fields<'_>) -> Option<Self> {
                <$inner>::read(fields).map($read)
            }

            #[cfg(test)]
            fn write(&self, text: &mut String) {
                let write: fn(&$name) -> &$inner = $write;
                write(self).write(text);
            }
        }
    )*};
}

wrapped! {
    TypeId: u32, TypeId, |id| &id.0;
    ItemRef: CompactString, ItemRef::from, |reference| &reference.name;
    ElementRef: CompactString, ElementRef::from, |reference| &reference.name;
    StateRef: CompactString, StateRef::from, |reference| &reference.name;
    CommandRef: CompactString, CommandRef::from, |reference| &reference.name;
    TypeRef: CompactString, TypeRef::from, |reference| &reference.name;
}

/// Implements `Stored` for structures. The fields after `|` are not stored, because profiles do not use these fields.
macro_rules! structures {
    ($($name:ident { $($field:ident),* $(| $($default:ident),*)? })*) => {$(
        impl Stored for $name {
            fn read(fields: &mut Fields<'_>) -> Option<Self> {
                $(let $field = Stored::read(fields)?;)*
                Some($name { $($field,)* $($($default: Default::default(),)*)? })
            }

            #[cfg(test)]
            fn write(&self, text: &mut String) {
                let $name { $($field,)* $($($default: _,)*)? } = self;
                $($field.write(text);)*
            }
        }
    )*};
}

structures! {
    Profile { name, number, when, api, on_canopen, on_ethercat, axis_index, objects, signals, telegrams, types, codes, machines }
    Described { indices, subs, ty, buses, meaning, standard, quantity, behavior, documentation }
    Signal { name, ty, meaning }
    Telegram { name, direction, signals }
    ObjectBuses { canopen, coe }
    Documentation { text, cite, text_from | translations }
    Quantity { unit, scale, sentinels, step | units, machine, conversions }
    Behavior {
        storage, effective, write_when, writable_values, side_effects, self_clearing, write_once, hidden
        | backup, setting, safety, srdo, pdi_access, read_states, write_states
    }
    Condition { item, values, mask | names }
    TypeDef { name, shape, bits, documentation, doubts | code, stated_by, origin }
    BitFieldEntry { name, offset, bits, meaning, when, trigger, access, documentation | names, availability, at }
    EnumValue { name, value, last, zone, when, documentation | names, availability, at }
    CodeTable { name, columns, rows, documentation, doubts | buses, stated_by, origin }
    CodeRow { printed, code, last, name, documentation, cells | printed_cells, names, availability, stated_by }
    StateMachine { name, status_item, control_item, state_type, states, initial, commands, transitions, documentation, doubts | faults, outcomes, stated_by }
    Pattern { name, mask, value, documentation | names }
    Transition { number, from, to, command, documentation }
    Doubt { says, chosen, why, cite, severity, part | origin }
}

/// Implements `Stored` for enumerations. The text contains the name of the variant, followed by its fields.
macro_rules! enumerations {
    ($($name:ident { $($variant:ident $(($($item:ident),*))? $({ $($field:ident),* })?),* })*) => {$(
        impl Stored for $name {
            fn read(fields: &mut Fields<'_>) -> Option<Self> {
                match next(fields)? {
                    $(stringify!($variant) => {
                        $($(let $item = Stored::read(fields)?;)*)?
                        $($(let $field = Stored::read(fields)?;)*)?
                        Some($name::$variant $(($($item),*))? $({ $($field),* })?)
                    })*
                    _ => None,
                }
            }

            #[cfg(test)]
            #[allow(unreachable_patterns)]
            fn write(&self, text: &mut String) {
                match self {
                    $($name::$variant $(($($item),*))? $({ $($field),* })? => {
                        write(text, stringify!($variant));
                        $($($item.write(text);)*)?
                        $($($field.write(text);)*)?
                    })*
                    other => panic!("{other:?} cannot be stored"),
                }
            }
        }
    )*};
}

enumerations! {
    Access { ReadOnly, WriteOnly, ReadWrite, ReadWriteInput, ReadWriteOutput, Constant }
    BitMeaning { Flag { inverted }, Number, Enumeration(id), Reserved { write } }
    Direction { Receive, Transmit }
    FactOrigin { Stated, PrintedName, Standard(clause) }
    Scale {
        Linear { factor, offset }, Reciprocal { numerator }, Fraction { bits, base }, Exponent { exponent, base, fraction }, ByItem { item, factor },
        TimesItem { item, factor }
    }
    Severity { Hazard, Value, Print }
    Shape { BitField { base, fields }, Enumeration { base, values, closed } }
    Storage { Unknown, Volatile, Immediate, OnCommand(command) }
    Trigger { Rising, Falling, Toggle, SelfClearing }
    Type { Boolean, Integer(bits), Unsigned(bits), Real32, Real64 }
    Value { Bool(value), Int(value), Real(value), Text(value) }
    Zone { Reserved, Vendor }
}

impl<A: Stored, B: Stored> Stored for (A, B) {
    fn read(fields: &mut Fields<'_>) -> Option<Self> {
        Some((A::read(fields)?, B::read(fields)?))
    }

    #[cfg(test)]
    fn write(&self, text: &mut String) {
        self.0.write(text);
        self.1.write(text);
    }
}

/// Reads and writes a pointer like the value it points to.
macro_rules! pointers {
    ($($pointer:ident),*) => {$(
        impl<T: Stored> Stored for $pointer<T> {
            fn read(fields: &mut Fields<'_>) -> Option<Self> {
                T::read(fields).map($pointer::new)
            }

            #[cfg(test)]
            fn write(&self, text: &mut String) {
                T::write(self, text);
            }
        }
    )*};
}

pointers!(Box, Arc);

impl<T: Stored> Stored for Option<T> {
    fn read(fields: &mut Fields<'_>) -> Option<Self> {
        match next(fields)? {
            "" => Some(None),
            _ => T::read(fields).map(Some),
        }
    }

    #[cfg(test)]
    fn write(&self, text: &mut String) {
        write(text, if self.is_some() { "+" } else { "" });
        self.iter().for_each(|value| value.write(text));
    }
}

/// Implements `Stored` for lists: the number of elements, followed by each element on a new line.
macro_rules! lists {
    ($($name:ty where $element:ident;)*) => {$(
        impl<$element: Stored> Stored for $name {
            fn read(fields: &mut Fields<'_>) -> Option<Self> {
                let count = usize::read(fields)?;
                (0..count).map(|_| Stored::read(fields)).collect()
            }

            #[cfg(test)]
            fn write(&self, text: &mut String) {
                self.len().write(text);
                for element in self {
                    text.push('\n');
                    element.write(text);
                }
            }
        }
    )*};
}

lists! {
    Vec<T> where T;
    SharedList<T> where T;
}

impl Stored for Doubts {
    fn read(fields: &mut Fields<'_>) -> Option<Self> {
        Vec::read(fields).map(Doubts::from)
    }

    #[cfg(test)]
    fn write(&self, text: &mut String) {
        self.to_vec().write(text);
    }
}

#[cfg(test)]
mod tests {
    use crate::collections::HashMap;
    use std::path::Path;

    use super::super::apply::STORED;
    use super::*;
    use crate::diagnostics::{Diagnostic, Diagnostics};
    use crate::frontend::table::overlay::profile;
    use crate::source::Source;

    const FILES: [&str; 4] = ["cia402", "coe", "cia301", "profidrive"];

    fn source(text: &str) -> Source {
        Source::new("profile.toml", text.as_bytes().to_vec())
    }

    fn diagnostics(text: &str) -> Vec<Diagnostic> {
        let mut diagnostics = Diagnostics::default();
        profile::read(&source(text), &mut diagnostics);
        diagnostics.list().to_vec()
    }

    fn table(name: &str) -> String {
        let folder = concat!(env!("CARGO_MANIFEST_DIR"), "/../dictionaries/profiles");
        std::fs::read_to_string(Path::new(folder).join(name).with_extension("toml")).expect("a table")
    }

    #[test]
    fn stored_profiles_have_the_facts_of_the_tables() {
        for (name, stored) in FILES.into_iter().zip(STORED) {
            let profile = profile::read(&source(&table(name)), &mut Diagnostics::default()).expect(name);
            let mut text = String::new();
            profile.write(&mut text);
            assert_eq!(read(&text).as_ref(), Some(&profile), "{name} has facts that cannot be stored");
            if std::env::var_os("LEXIBUS_BLESS").is_some() {
                let folder = concat!(env!("CARGO_MANIFEST_DIR"), "/src/resolve/profiles/stored");
                std::fs::write(Path::new(folder).join(name).with_extension("txt"), &text).expect("written");
            } else {
                assert!(text == stored, "{name}.txt is stale: run `tests/bindings.sh`");
            }
        }
        assert_eq!(read("CiA 402\t"), None);
    }

    #[test]
    fn profiles_have_no_diagnostics() {
        let mut names: HashMap<String, &str> = HashMap::default();
        for name in FILES {
            let text = table(name);
            let found = diagnostics(&text);
            let messages: Vec<&String> = found.iter().map(|diagnostic| &diagnostic.message).collect();
            assert!(found.is_empty(), "{name}: {messages:?}");
            // A device can follow two profiles, so definitions in different profiles must have different names.
            for line in text.lines() {
                let head = line.strip_prefix("[bits.").or(line.strip_prefix("[enums.")).unwrap_or_default();
                if let Some(definition) = head.strip_suffix(".at]").or(head.strip_suffix(".values]")) {
                    let other = names.insert(definition.to_lowercase(), name);
                    assert_eq!(other, None, "`{definition}` is defined in {name} and elsewhere");
                }
            }
        }
        assert!(names.len() > 40, "only {} definitions", names.len());
        assert!(!diagnostics("lexibus = 1\n[profile]\nnumber = 402\nwhen = \"x\"\n").is_empty());
        assert!(!diagnostics("lexibus = 1\n[device]\nname = \"x\"\n").is_empty());
    }
}
