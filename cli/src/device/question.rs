//! Questions before a write.

use std::io::{BufRead, IsTerminal, Write};

use crate::Failure;

/// Asks the user whether to write, and returns the answer. If `is_confirmed` is true, returns true without asking.
/// Returns an error if the user must be asked and standard input is not a terminal.
pub(super) fn confirm(is_confirmed: bool, question: &str) -> Result<bool, Failure> {
    if is_confirmed {
        return Ok(true);
    }
    if !std::io::stdin().is_terminal() {
        return Err(Failure::Usage("nothing was written: add `--yes` to write without a question".to_owned()));
    }
    let mut error = std::io::stderr();
    write!(error, "{question} [y/N] ")?;
    error.flush()?;
    let mut answer = String::new();
    std::io::stdin().lock().read_line(&mut answer)?;
    Ok(matches!(answer.trim(), "y" | "Y" | "yes"))
}
