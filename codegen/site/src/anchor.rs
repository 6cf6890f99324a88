//! Creates file names and anchors from texts of the source.

use compact_str::format_compact;

use lexibus_codegen::unique::Unique;

/// Maximum number of characters of a file name, without the number that distinguishes equal names.
const LONGEST: usize = 40;

/// The file names of a folder, or the anchors of a page, without duplicates.
#[derive(Debug, Default)]
pub(super) struct Names {
    given: Unique,
    /// Prefix of the anchors in the page or element.
    prefix: String,
}

impl Names {
    /// Returns an empty `Names` for the elements inside another element. Their anchors start with `anchor` and a dot.
    pub fn within(anchor: &str) -> Self {
        Names { prefix: format!("{anchor}."), ..Names::default() }
    }

    /// Returns a file name for `text`. The name consists of lowercase letters, digits and `-`.
    pub fn file(&mut self, text: &str) -> String {
        let mut name = slug(text);
        name.truncate(LONGEST);
        let name = name.trim_end_matches('-');
        self.once(if name.is_empty() { "device" } else { name }, '-')
    }

    /// Returns an anchor for an element called `text`. The anchor contains only characters that need no escaping in a
    /// link.
    pub fn anchor(&mut self, text: &str) -> String {
        let is_plain = |letter: &char| letter.is_alphanumeric() || matches!(letter, '_' | '-' | '.' | ':');
        let name: String = text.trim().chars().map(|letter| if is_plain(&letter) { letter } else { '_' }).collect();
        self.once(&format!("{}{}", self.prefix, if name.is_empty() { "_" } else { &name }), '.')
    }

    /// Returns `name`, with a number appended if the name is already used.
    fn once(&mut self, name: &str, separator: char) -> String {
        self.given.unique(name, |number| format_compact!("{name}{separator}{number}")).into_string()
    }
}

/// Returns a text as lowercase letters, digits and `-`.
pub(super) fn slug(text: &str) -> String {
    let mut name = String::new();
    for letter in text.chars().flat_map(char::to_lowercase) {
        match letter {
            'a'..='z' | '0'..='9' => name.push(letter),
            _ if name.ends_with('-') || name.is_empty() => {}
            _ => name.push('-'),
        }
    }
    name.truncate(name.trim_end_matches('-').len());
    name
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn names_are_harmless_and_given_once() {
        let mut names = Names::default();
        assert_eq!(names.file("Kollmorgen AKD™ / 2"), "kollmorgen-akd-2");
        assert_eq!(names.file("../../etc/passwd"), "etc-passwd");
        assert_eq!((names.file("a"), names.file("A"), names.file("?")), ("a".into(), "a-2".into(), "device".into()));
        assert_eq!(names.anchor("0x6040:01"), "0x6040:01");
        assert_eq!(names.anchor("\"><script>"), "___script_");
        assert_eq!(Names::within("module-1").anchor("0x6040"), "module-1.0x6040");
        assert_eq!((names.anchor("x y"), names.anchor("x_y")), ("x_y".into(), "x_y.2".into()));
        assert_eq!((names.anchor("x_y.3"), names.anchor("x_y")), ("x_y.3".into(), "x_y.4".into()));
    }
}
