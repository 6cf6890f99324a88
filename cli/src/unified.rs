//! Unified diffs for display: spaces replace all control characters except tabs.

use std::time::Duration;

use lexibus_codegen::text::steers;
use similar::TextDiff;

/// Time after which the comparison of two very different texts becomes coarser.
const MAX_TIME: Duration = Duration::from_secs(2);

/// Number of unchanged lines around a change.
const CONTEXT: usize = 3;

/// Maximum number of lines of a short diff.
const SHORT: usize = 24;

/// Maximum number of characters of a line in a short diff.
const SHORT_LINE: usize = 160;

/// Returns the lines of the unified diff of two texts, without line feeds. The list is empty if the texts are equal.
pub(super) fn lines(old: (&str, &str), new: (&str, &str)) -> Vec<String> {
    let ((old_name, old), (new_name, new)) = (old, new);
    let diff = TextDiff::configure().timeout(MAX_TIME).diff_lines(old, new);
    let mut lines = Vec::new();
    for hunk in diff.unified_diff().context_radius(CONTEXT).iter_hunks() {
        if lines.is_empty() {
            lines.extend([visible(&format!("--- {old_name}")), visible(&format!("+++ {new_name}"))]);
        }
        lines.push(hunk.header().to_string());
        for change in hunk.iter_changes() {
            let text = change.value().trim_end_matches(['\r', '\n']);
            lines.push(visible(&format!("{}{text}", change.tag())));
            if change.missing_newline() {
                lines.push("\\ No newline at end of file".to_owned());
            }
        }
    }
    lines
}

/// Returns at most [`SHORT`] lines of the unified diff of two texts. Shortens each line to [`SHORT_LINE`] characters.
/// If lines are left out, an additional last line states their number.
pub(super) fn short(old: (&str, &str), new: (&str, &str)) -> Vec<String> {
    let mut lines = lines(old, new);
    let left = lines.len().saturating_sub(SHORT);
    lines.truncate(SHORT);
    for line in &mut lines {
        if let Some((at, _)) = line.char_indices().nth(SHORT_LINE) {
            line.truncate(at);
            line.push('…');
        }
    }
    if left > 0 {
        lines.push(format!("… {left} more lines"));
    }
    lines
}

fn visible(line: &str) -> String {
    line.chars().map(|letter| if steers(letter) && letter != '\t' { ' ' } else { letter }).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn control_characters_are_not_printed() {
        let shown = lines(("a\u{1b}", "same\r\n1\u{1b}[2J\tx\r\n"), ("b", "same\r\n2\tx"));
        let expected =
            ["--- a ", "+++ b", "@@ -1,2 +1,2 @@", " same", "-1 [2J\tx", "+2\tx", "\\ No newline at end of file"];
        assert_eq!(shown, expected);
        assert!(lines(("a", "x"), ("b", "x")).is_empty());
    }

    #[test]
    fn short_diffs_are_short() {
        let text =
            |word: &str| (0..50).map(|number| format!("{word} {number} {}\n", "x".repeat(300))).collect::<String>();
        let (old, new) = (text("old"), text("new"));
        let shown = short(("a", &old), ("b", &new));
        assert_eq!(shown.len(), SHORT + 1);
        assert!(shown.iter().all(|line| line.chars().count() <= SHORT_LINE + 1));
        assert_eq!(shown.last().map(String::as_str), Some("… 79 more lines"));
    }
}
