//! Prints a table for each input, or all results as JSON.

use serde_json::{json, Value};

use crate::measure::Sample;

/// Result of a program for one input.
pub struct Line {
    pub name: String,
    pub outcome: Result<Sample, String>,
    /// Required speed ratio: Lexibus should be at least this many times as fast as the program.
    pub target: Option<f64>,
}

/// Results of all programs for one input. The first element of `lines` is the result of Lexibus.
pub struct Table {
    pub title: String,
    /// Number of input bytes, used to print the speed. `None` means that the table shows only times.
    pub bytes: Option<usize>,
    pub lines: Vec<Line>,
}

impl Table {
    /// Returns the time in `line` divided by the time of Lexibus, which is in the first line of the table.
    fn ratio(&self, line: &Line) -> Option<f64> {
        let lexibus = self.lines[0].outcome.as_ref().ok()?.least.as_secs_f64();
        Some(line.outcome.as_ref().ok()?.least.as_secs_f64() / lexibus)
    }

    pub fn print(&self) {
        println!("\n{}\n", self.title);
        println!("| program | {} | rounds | speed of Lexibus as a multiple | target |", self.unit());
        println!("|---|---|---|---|---|");
        for (number, line) in self.lines.iter().enumerate() {
            let (name, sample) = match &line.outcome {
                Ok(sample) => (&line.name, sample),
                Err(error) => {
                    println!("| {} | rejects it: {} | | | |", line.name, shortened(error));
                    continue;
                }
            };
            let ratio = self.ratio(line).filter(|_| number > 0);
            let verdict = match (line.target, ratio) {
                (Some(target), Some(ratio)) if ratio >= target => format!("{target}, met"),
                (Some(target), _) => format!("{target}, missed"),
                (None, _) => String::new(),
            };
            let ratio = ratio.map(|ratio| format!("{ratio:.2}")).unwrap_or_default();
            println!("| {name} | {} | {} | {ratio} | {verdict} |", self.figures(sample), sample.rounds);
        }
    }

    fn unit(&self) -> &'static str {
        match self.bytes {
            Some(_) => "MB/s, best (median)",
            None => "ms, best (median)",
        }
    }

    fn figures(&self, sample: &Sample) -> String {
        let figure = |time: std::time::Duration| match self.bytes {
            Some(bytes) => bytes as f64 / time.as_secs_f64() / 1e6,
            None => time.as_secs_f64() * 1e3,
        };
        let (best, median) = (figure(sample.least), figure(sample.median));
        if best < 20.0 {
            format!("{best:.2} ({median:.2})")
        } else {
            format!("{best:.0} ({median:.0})")
        }
    }

    pub fn json(&self) -> Value {
        let line = |line: &Line| match &line.outcome {
            Ok(sample) => json!({
                "name": line.name,
                "best_s": sample.least.as_secs_f64(),
                "median_s": sample.median.as_secs_f64(),
                "rounds": sample.rounds,
                "ratio": self.ratio(line),
                "target": line.target,
            }),
            Err(error) => json!({ "name": line.name, "error": error }),
        };
        json!({ "title": self.title, "bytes": self.bytes, "lines": self.lines.iter().map(line).collect::<Vec<_>>() })
    }
}

/// Returns the first line of a message, shortened to fit in a table.
fn shortened(message: &str) -> String {
    let line = message.lines().next().unwrap_or_default();
    line.chars().take(100).collect::<String>().replace('|', "/")
}
