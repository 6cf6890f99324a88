//! Diagnostics for code-scanning services and editors, as SARIF 2.1.0.
//!
//! The fields have the names that the OASIS standard defines. Fields that Lexibus does not use are omitted.

use std::collections::BTreeMap;

use lexibus_codegen::diagnostics::render::marked::{Mark, MarkedSource};
use lexibus_codegen::diagnostics::{Code, Diagnostic, Level, Note};
use lexibus_codegen::source::Source;

use super::ordered::{list, object, without_nulls, Json};

/// Maximum length in bytes of the marked text in a log.
const MAX_SNIPPET: usize = 1000;

/// Returns the diagnostics as a SARIF 2.1.0 log of one run of `lexibus` version `tool_version`.
///
/// The log declares a SARIF rule for each code that occurs, in the order of first occurrence. SARIF has no field for
/// notes without a position or for help without a fix. The message contains such notes and help texts on separate
/// lines. File names become URIs: relative names stay relative to the working directory, and absolute names become
/// `file:` URIs. The compiler keeps a limited number of diagnostics per code and file. If the compiler left out
/// diagnostics, `occurrenceCount` in the last result of the code is their number; other results have no
/// `occurrenceCount`.
pub fn document(diagnostics: &[Diagnostic], sources: &[Source], tool_version: &str) -> String {
    let (mut rules, mut indices) = (Vec::new(), BTreeMap::new());
    let mut results = Vec::with_capacity(diagnostics.len());
    for diagnostic in diagnostics {
        let rule_index = *indices.entry(diagnostic.code.id).or_insert_with(|| {
            rules.push(rule(diagnostic.code));
            rules.len() - 1
        });
        results.push(outcome(diagnostic, sources, rule_index));
    }
    let driver = object([("name", "lexibus".into()), ("version", tool_version.into()), ("rules", list(rules))]);
    let run = object([
        ("tool", object([("driver", driver)])),
        ("columnKind", "unicodeCodePoints".into()),
        // The longest newline sequence comes first, because readers use the first sequence that matches.
        ("newlineSequences", list(["\r\n", "\n", "\r"])),
        ("results", list(results)),
    ]);
    let log = object([
        ("$schema", "https://json.schemastore.org/sarif-2.1.0.json".into()),
        ("version", "2.1.0".into()),
        ("runs", list([run])),
    ]);
    log.to_text()
}

fn rule(code: &'static Code) -> Json<'static> {
    let configuration = object([
        ("enabled", (code.default != Level::Allow).into()),
        ("level", if code.default == Level::Deny { "error" } else { "warning" }.into()),
    ]);
    object([
        ("id", code.id.into()),
        ("name", pascal_case(code.name).into()),
        ("shortDescription", message(code.summary)),
        ("fullDescription", message(code.explanation)),
        ("help", message(code.explanation)),
        ("defaultConfiguration", configuration),
    ])
}

/// Returns a `result` object of SARIF.
fn outcome<'a>(diagnostic: &'a Diagnostic, sources: &'a [Source], rule_index: usize) -> Json<'a> {
    let place = MarkedSource::of(diagnostic.span, sources);
    let label = Some(diagnostic.label.as_str()).filter(|label| !label.is_empty()).map(message);
    let fix = place.and_then(|place| fix(diagnostic, place));
    let related =
        |note: &'a Note| Some(location(MarkedSource::of(note.span?, sources)?, Some(message(note.message.as_str()))));
    let related: Vec<Json<'_>> = diagnostic.notes.iter().filter_map(related).collect();
    without_nulls([
        ("ruleId", diagnostic.code.id.into()),
        ("ruleIndex", rule_index.into()),
        ("level", diagnostic.severity.name().into()),
        ("message", message(full_message(diagnostic, sources, fix.is_none()))),
        ("occurrenceCount", Some(diagnostic.more).filter(|&more| more > 0).into()),
        ("locations", list(place.map(|place| location(place, label)))),
        ("relatedLocations", (!related.is_empty()).then(|| list(related)).into()),
        ("fixes", fix.map(|fix| list([fix])).into()),
    ])
}

/// Returns the message of a diagnostic, followed by the notes and help texts for which SARIF has no field.
fn full_message(diagnostic: &Diagnostic, sources: &[Source], with_help: bool) -> String {
    let mut text = diagnostic.message.clone();
    for note in &diagnostic.notes {
        if note.span.is_none_or(|span| !MarkedSource::exists(span, sources)) {
            text += &format!("\nnote: {}", note.message);
        }
    }
    if with_help {
        if let Some(help) = &diagnostic.help {
            text += &format!("\nhelp: {help}");
        }
        if let Some(fix) = &diagnostic.fix {
            text += &format!("\nhelp: write `{fix}` instead");
        }
    }
    text
}

fn fix<'a>(diagnostic: &'a Diagnostic, place: MarkedSource<'a>) -> Option<Json<'a>> {
    let (replacement, mark) = (diagnostic.fix.as_deref()?, place.mark?);
    let replacement = object([("deletedRegion", region(mark, None)), ("insertedContent", message(replacement))]);
    let change = object([("artifactLocation", artifact(place.source)), ("replacements", list([replacement]))]);
    let description = message(diagnostic.help.as_deref().unwrap_or("replace the marked text"));
    Some(object([("description", description), ("artifactChanges", list([change]))]))
}

fn location<'a>(place: MarkedSource<'a>, message: Option<Json<'a>>) -> Json<'a> {
    let region = place.mark.map(|mark| region(mark, Some(place.source)));
    let physical = without_nulls([("artifactLocation", artifact(place.source)), ("region", region.into())]);
    without_nulls([("physicalLocation", physical), ("message", message.into())])
}

/// Returns the position of a mark. The marked text in `source` is part of the position unless the text is too long.
fn region<'a>(mark: Mark, source: Option<&'a Source>) -> Json<'a> {
    let marked = source.map(|source| source.text().get(mark.start..mark.end).unwrap_or_default());
    without_nulls([
        ("startLine", mark.from.line.into()),
        ("startColumn", mark.from.column.into()),
        ("endLine", mark.to.line.into()),
        ("endColumn", mark.to.column.into()),
        ("snippet", marked.filter(|marked| marked.len() <= MAX_SNIPPET).map(message).into()),
    ])
}

fn message<'a>(text: impl Into<Json<'a>>) -> Json<'a> {
    object([("text", text.into())])
}

fn artifact(source: &Source) -> Json<'_> {
    object([("uri", uri(source.name(), cfg!(windows)).into())])
}

/// Converts a file name to a URI. `windows` selects the path syntax of Windows.
fn uri(name: &str, windows: bool) -> String {
    let name = if windows { name.replace('\\', "/") } else { name.to_owned() };
    let name = name.strip_prefix("//?/").filter(|_| windows).unwrap_or(&name);
    let is_drive = |name: &str| matches!(name.as_bytes(), [letter, b':', ..] if letter.is_ascii_alphabetic());
    if windows && is_drive(name) {
        format!("file:///{}{}", &name[..2], percent_encoded(&name[2..]))
    } else if windows && name.starts_with("//") {
        format!("file:{}", percent_encoded(name))
    } else if name.starts_with('/') {
        format!("file:///{}", percent_encoded(name.trim_start_matches('/')))
    } else {
        percent_encoded(name.trim_start_matches("./"))
    }
}

/// Encodes all bytes as `%XX`, except the unreserved characters of RFC 3986 and `/`.
fn percent_encoded(text: &str) -> String {
    let mut encoded = String::with_capacity(text.len());
    for byte in text.bytes() {
        if byte.is_ascii_alphanumeric() || b"-._~/".contains(&byte) {
            encoded.push(char::from(byte));
        } else {
            encoded += &format!("%{byte:02X}");
        }
    }
    encoded
}

/// Converts a name of the form `octal-number` to the form `OctalNumber`.
fn pascal_case(name: &str) -> String {
    let word = |word: &str| {
        let mut letters = word.chars();
        letters.next().map(|first| first.to_ascii_uppercase()).into_iter().chain(letters).collect::<String>()
    };
    name.split('-').map(word).collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use lexibus_codegen::diagnostics::codes;
    use lexibus_codegen::source::{FileId, Span};

    /// Returns the log as a JSON value for snapshots.
    fn log(diagnostics: &[Diagnostic], sources: &[Source]) -> serde_json::Value {
        serde_json::from_str(&document(diagnostics, sources, "1.2.3")).unwrap()
    }

    #[test]
    fn a_log_without_diagnostics_is_complete() {
        insta::assert_snapshot!(document(&[], &[], "1.2.3"), @r#"{"$schema":"https://json.schemastore.org/sarif-2.1.0.json","version":"2.1.0","runs":[{"tool":{"driver":{"name":"lexibus","version":"1.2.3","rules":[]}},"columnKind":"unicodeCodePoints","newlineSequences":["\r\n","\n","\r"],"results":[]}]}"#);
    }

    #[test]
    fn rules_are_the_codes_that_occur_once_each() {
        let span = Span::default();
        let new = |code| Diagnostic::new(code, span, "");
        let codes = [&codes::UNKNOWN_KEY, &codes::OCTAL_NUMBER, &codes::UNKNOWN_KEY];
        let log = log(&codes.map(new), &[]);
        let rules = &log["runs"][0]["tool"]["driver"]["rules"];
        assert_eq!(rules.as_array().unwrap().len(), 2);
        insta::assert_snapshot!(format!("{:#}", rules[0]), @r#"
        {
          "defaultConfiguration": {
            "enabled": false,
            "level": "warning"
          },
          "fullDescription": {
            "text": "Lexibus keeps the entry as an extension attribute of its object. Many tools add keys, so this lint is off by default. Turn the lint on to find misspelled keys."
          },
          "help": {
            "text": "Lexibus keeps the entry as an extension attribute of its object. Many tools add keys, so this lint is off by default. Turn the lint on to find misspelled keys."
          },
          "id": "EDS012",
          "name": "UnknownKey",
          "shortDescription": {
            "text": "a key is not defined in CiA 306"
          }
        }
        "#);
        assert_eq!(log["runs"][0]["results"][2]["ruleIndex"], 0);
        assert_eq!(rules[1]["defaultConfiguration"]["enabled"], true);
    }

    #[test]
    fn a_result_has_locations_notes_and_a_fix() {
        let sources = [Source::new("my files/Gerät.eds", "[1018]\r\nGerät=012\r\n".into())];
        let diagnostic = Diagnostic::new(&codes::OCTAL_NUMBER, Span::new(FileId(0), 15, 18), "`012` is octal")
            .label("read as 10")
            .note("a fact")
            .note_at(Span::new(FileId(0), 1, 5), "a place")
            .help("write it in decimal")
            .fix("10");
        insta::assert_snapshot!(format!("{:#}", log(&[diagnostic], &sources)["runs"][0]["results"][0]), @r#"
        {
          "fixes": [
            {
              "artifactChanges": [
                {
                  "artifactLocation": {
                    "uri": "my%20files/Ger%C3%A4t.eds"
                  },
                  "replacements": [
                    {
                      "deletedRegion": {
                        "endColumn": 10,
                        "endLine": 2,
                        "startColumn": 7,
                        "startLine": 2
                      },
                      "insertedContent": {
                        "text": "10"
                      }
                    }
                  ]
                }
              ],
              "description": {
                "text": "write it in decimal"
              }
            }
          ],
          "level": "error",
          "locations": [
            {
              "message": {
                "text": "read as 10"
              },
              "physicalLocation": {
                "artifactLocation": {
                  "uri": "my%20files/Ger%C3%A4t.eds"
                },
                "region": {
                  "endColumn": 10,
                  "endLine": 2,
                  "snippet": {
                    "text": "012"
                  },
                  "startColumn": 7,
                  "startLine": 2
                }
              }
            }
          ],
          "message": {
            "text": "`012` is octal\nnote: a fact"
          },
          "relatedLocations": [
            {
              "message": {
                "text": "a place"
              },
              "physicalLocation": {
                "artifactLocation": {
                  "uri": "my%20files/Ger%C3%A4t.eds"
                },
                "region": {
                  "endColumn": 6,
                  "endLine": 1,
                  "snippet": {
                    "text": "1018"
                  },
                  "startColumn": 2,
                  "startLine": 1
                }
              }
            }
          ],
          "ruleId": "EDS020",
          "ruleIndex": 0
        }
        "#);
    }

    #[test]
    fn facts_without_a_field_are_in_the_message() {
        let diagnostic =
            Diagnostic::new(&codes::NOT_AN_EDS, Span::default(), "no section").help("take another").fix("[1000]");
        let sources = [Source::new("/drives/x y.eds", Vec::new())];
        insta::assert_snapshot!(format!("{:#}", log(&[diagnostic], &sources)["runs"][0]["results"][0]), @r#"
        {
          "level": "error",
          "locations": [
            {
              "physicalLocation": {
                "artifactLocation": {
                  "uri": "file:///drives/x%20y.eds"
                }
              }
            }
          ],
          "message": {
            "text": "no section\nhelp: take another\nhelp: write `[1000]` instead"
          },
          "ruleId": "EDS002",
          "ruleIndex": 0
        }
        "#);
    }

    #[test]
    fn names_become_uris() {
        assert_eq!(uri("./a/b c%.eds", false), "a/b%20c%25.eds");
        assert_eq!(uri("../C:x\\y.eds", false), "../C%3Ax%5Cy.eds");
        assert_eq!(uri("/etc/ä.eds", false), "file:///etc/%C3%A4.eds");
        assert_eq!(uri(r"a\b.eds", true), "a/b.eds");
        assert_eq!(uri(r"C:\a b\c.eds", true), "file:///C:/a%20b/c.eds");
        assert_eq!(uri(r"\\?\C:\c.eds", true), "file:///C:/c.eds");
        assert_eq!(uri(r"\\server\share\c.eds", true), "file://server/share/c.eds");
        assert_eq!(uri("<stdin>", false), "%3Cstdin%3E");
    }
}
