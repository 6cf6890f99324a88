//! Quotes the arguments of the commands that the program prints, so that a user can run these commands in a shell.

/// Returns `text` as one argument of a command, in single quotes unless `text` is a plain word.
pub(crate) fn argument(text: &str) -> String {
    let is_word = |letter: char| letter.is_alphanumeric() || "-_.,:/@+=".contains(letter);
    if !text.is_empty() && text.chars().all(is_word) {
        text.to_owned()
    } else {
        format!("'{}'", text.replace('\'', r"'\''"))
    }
}

#[cfg(test)]
mod tests {
    use super::argument;

    #[test]
    fn a_shell_reads_each_argument_as_it_is() {
        for (text, expected) in [
            ("EL1-2@0x00000001", "EL1-2@0x00000001"),
            ("Gerät", "Gerät"),
            ("", "''"),
            ("T 3", "'T 3'"),
            ("~/a", "'~/a'"),
            ("a;b", "'a;b'"),
            ("$HOME `x` \\ \"y\" !", "'$HOME `x` \\ \"y\" !'"),
            ("it's", r"'it'\''s'"),
        ] {
            assert_eq!(argument(text), expected);
        }
    }

    #[cfg(unix)]
    #[test]
    fn sh_prints_each_argument_unchanged() {
        for text in ["-x", "T 3", "", "a'b''c", "$HOME `x` \\ \"y\" ! ; & | * ?", "~", "#1", "ä\u{a0}ö"] {
            let command = format!("printf %s {}", argument(text));
            let output = std::process::Command::new("sh").args(["-c", &command]).output().expect("sh runs");
            assert_eq!(String::from_utf8(output.stdout).expect("UTF-8"), text);
        }
    }
}
