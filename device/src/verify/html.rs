//! The report as an HTML page.

use std::fmt::Write as _;

use super::finding::{Finding, FindingKind};
use super::report::Report;

const STYLE: &str = "body{font:1rem/1.5 system-ui,sans-serif;margin:2rem auto;max-width:70rem;padding:0 1rem}\
table{border-collapse:collapse;width:100%}th,td{border-bottom:1px solid #8886;padding:.3rem .6rem;text-align:left;\
vertical-align:top}@media(prefers-color-scheme:dark){body{background:#111;color:#eee}}";

impl Report {
    /// Returns the report as an HTML page without references to other files.
    #[must_use]
    pub fn html(&self) -> String {
        let title = format!("{}: comparison with {}", escape(&self.device), escape(&self.file));
        let mut page = format!(
            "<!DOCTYPE html>\n<html lang=\"en\"><head><meta charset=\"utf-8\"><meta name=\"viewport\" \
             content=\"width=device-width\"><title>{title}</title><style>{STYLE}</style></head>\n<body>\n<h1>{title}</h1>\n"
        );
        let _ = writeln!(page, "<p>{} deviations, {} parameters read.</p>", self.deviations().count(), self.read);
        for kind in FindingKind::ALL {
            let all = self.findings.iter().chain(&self.changed);
            section(&mut page, kind, &all.filter(|finding| finding.kind == kind).collect::<Vec<_>>());
        }
        let writes = self.unverified_writes;
        let _ = writeln!(page, "<p>The write access of {writes} parameters was not verified.</p>\n</body></html>");
        page
    }
}

fn section(page: &mut String, kind: FindingKind, findings: &[&Finding]) {
    if findings.is_empty() {
        return;
    }
    let _ = writeln!(page, "<h2>{}: {}</h2>", heading(kind), findings.len());
    page.push_str("<table><thead><tr><th>Address</th><th>Name</th><th>Finding</th><th>Declared</th><th>Found</th></tr></thead><tbody>\n");
    for finding in findings {
        let cell = |text: Option<&str>| escape(text.unwrap_or_default());
        let _ = writeln!(
            page,
            "<tr><td><code>{}</code></td><td>{}</td><td>{}</td><td>{}</td><td>{}</td></tr>",
            escape(&finding.address),
            escape(&finding.name),
            escape(&finding.message),
            cell(finding.declared.as_deref()),
            cell(finding.actual.as_deref())
        );
    }
    page.push_str("</tbody></table>\n");
}

fn heading(kind: FindingKind) -> &'static str {
    match kind {
        FindingKind::Missing => "Missing",
        FindingKind::Extra => "Extra",
        FindingKind::Different => "Different",
        FindingKind::Unreadable => "Unreadable",
        FindingKind::Unverifiable => "Unverifiable",
        FindingKind::Changed => "Values that differ from the default value",
    }
}

/// Escapes a text for HTML.
fn escape(text: &str) -> String {
    text.chars().fold(String::with_capacity(text.len()), |mut escaped, letter| {
        match letter {
            '&' => escaped.push_str("&amp;"),
            '<' => escaped.push_str("&lt;"),
            '>' => escaped.push_str("&gt;"),
            '"' => escaped.push_str("&quot;"),
            letter => escaped.push(letter),
        }
        escaped
    })
}
