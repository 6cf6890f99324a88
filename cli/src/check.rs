//! `lexibus check`: reports the diagnostics of descriptions, without those of a baseline.

use lexibus_codegen::compile::Options;
use lexibus_codegen::diagnostics::{codes, Diagnostic};

use super::args::Check;
use super::baseline::Baseline;
use super::report::Reporter;
use super::{inputs, say, Failure};

pub(super) fn run(check: &Check) -> Result<bool, Failure> {
    let options = check.inputs.options()?;
    let mut reporter = Reporter::new(&check.inputs, true)?;
    if let Some(path) = &check.baseline {
        if check.write_baseline {
            return write(check, &options, Baseline::new(path)?);
        }
        reporter.leave_out(Baseline::read(path)?);
    }
    inputs::each(&check.inputs, &options, |_, compilation| reporter.report(&compilation))?;
    reporter.finish()
}

/// Writes a baseline with the diagnostics of all readable inputs. Reports unreadable inputs instead.
fn write(check: &Check, options: &Options, mut baseline: Baseline) -> Result<bool, Failure> {
    let mut reporter = Reporter::new(&check.inputs, false)?;
    inputs::each(&check.inputs, options, |_, compilation| {
        // Report unreadable files, because a baseline never hides that a file cannot be read.
        let is_unreadable = |diagnostic: &Diagnostic| diagnostic.code == &codes::UNREADABLE_FILE;
        if compilation.diagnostics.list().iter().any(is_unreadable) {
            return reporter.report(&compilation);
        }
        baseline.without_known(&compilation);
        Ok(())
    })?;
    say(&baseline.write()?);
    reporter.finish()
}
