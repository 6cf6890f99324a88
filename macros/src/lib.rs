//! The macro `dictionary!`: generates a typed Rust module from a device description at compile time.
//!
//! The feature `macros` of the runtime crate re-exports the macro. Use the macro through the runtime crate:
//!
//! ```
//! lexibus::dictionary! {
//!     /// The drive of axis 1.
//!     pub mod drive = "../dictionaries/demo-drive.eds";
//! }
//!
//! assert_eq!(drive::objects::TARGET_POSITION.name(), "Target position");
//! ```
#![forbid(unsafe_code)]

mod call;

use std::path::{Path, PathBuf};

use call::Call;
use lexibus_codegen::compile::{self, Compilation};
use lexibus_codegen::diagnostics::{render, Severity};
use lexibus_codegen::source::Source;
use proc_macro2::{Span, TokenStream};
use quote::{quote, quote_spanned};
use syn::LitStr;

/// Declares a module with the bindings generated from a device description.
///
/// ```
/// use lexibus::dictionary;
///
/// dictionary! {
///     /// The drive of axis 1.
///     pub mod drive = "../dictionaries/demo-drive.eds";
/// }
/// ```
///
/// The path is relative to the folder of the calling crate. Options follow the path in braces:
///
/// ```
/// # use lexibus::dictionary;
/// dictionary! {
///     pub mod drive = "../dictionaries/demo-drive.eds" {
///         device: "DEMO-1*",             // name, order code or product code, if there are several devices
///         objects: "0x6000..0x67FF",     // range of objects; also module; each may be repeated
///         device_name: "Axis",           // name of the device type
///         accessors: false,              // handles only
///         pdos: false,                   // no PDO structs
///         table: true,                   // a table of all entries; also false, or the name of a feature
///         debug: true, partial_eq: true, // traits of generated types, as for table; also defmt and serde
///         strict: true,                  // treat repairs of the description as errors
///         deny: "EDS049",                // level of a diagnostic; also allow and warn; may be repeated
///         node_id_alias: "$MY_NODE_ID",  // alias of $NODEID
///         profiles: true,                // add facts from CiA 301, CiA 402, CoE and PROFIdrive
///     }
/// }
/// ```
///
/// These options are also valid:
///
/// - `overlay: "../dictionaries/drive.overlay.toml"` applies a table that corrects or extends the description. To apply
///   several tables, repeat the option.
/// - `option: "NAME=CHOICE"` selects a choice for an option that the register table declares. To select choices for
///   several options, repeat `option`.
/// - `runtime: "crate::rt"` sets the path of the runtime crate in the generated code. The default is `::lexibus`.
///
/// The compiler reports diagnostics at the path argument. An error quotes the line of the description; a warning
/// contains the file name, the line and the column. A macro on stable Rust cannot report warnings, so a warning appears
/// as the use of a deprecated constant. If your crate denies warnings, put `#[allow(deprecated)]` on the module. Cargo
/// and editors detect changes to the description file, to the files that it references, and to the overlays.
#[proc_macro]
pub fn dictionary(input: proc_macro::TokenStream) -> proc_macro::TokenStream {
    let call = syn::parse_macro_input!(input as Call);
    expand(&call).unwrap_or_else(|error| error.to_compile_error()).into()
}

/// Compiles the description and generates the text of the module.
fn compiled(call: &Call) -> syn::Result<(Compilation, String)> {
    let mut options = call.options.clone();
    options.overlays = call.overlays.iter().map(read).collect::<syn::Result<_>>()?;
    let compilation = compile::check(read(&call.path)?, &options);
    let text = compilation.rust(&options.rust);
    let text = text.ok_or_else(|| syn::Error::new(call.path.span(), errors(&compilation)))?;
    Ok((compilation, text))
}

fn expand(call: &Call) -> syn::Result<TokenStream> {
    let (compilation, text) = compiled(call)?;
    let fail = |error| syn::Error::new(call.path.span(), format!("the generated code is not valid Rust: {error}"));
    let content: TokenStream = text.parse().map_err(fail)?;
    let warnings = warnings(&compilation, call.path.span());
    // The names of referenced files are full paths. Overlays are at the end of the list of sources.
    let referred = compilation.sources.len().saturating_sub(call.overlays.len());
    let others = compilation.sources.iter().take(referred).skip(1).map(Source::name);
    let named = std::iter::once(&call.path).chain(&call.overlays).map(|path| absolute(&path.value()));
    let tracked = named.map(|path| path.to_string_lossy().into_owned()).chain(others.map(str::to_owned));
    let tracked = tracked.map(|path| LitStr::new(&path, Span::call_site()));
    let (attributes, visibility, name) = (&call.attributes, &call.visibility, &call.name);
    // Without a doc comment, the module would fail the lint `missing_docs` in the calling crate.
    let documented = attributes.iter().any(|attribute| attribute.path().is_ident("doc"));
    let documentation = (!documented).then(|| format!(" Bindings generated from `{}`.", call.path.value()));
    let documentation = documentation.map(|text| quote!(#[doc = #text]));
    Ok(quote! {
        #(#attributes)*
        #documentation
        #visibility mod #name {
            #(#warnings)*
            #(const _: &[u8] = ::core::include_bytes!(#tracked);)*
            #content
        }
    })
}

/// Reads a file. Diagnostics and the header of the generated code contain the path from the call, because an absolute
/// path would depend on the machine.
fn read(path: &LitStr) -> syn::Result<Source> {
    let place = absolute(&path.value());
    let fail = |error| syn::Error::new(path.span(), format!("cannot read {}: {error}", place.display()));
    let source = Source::read(&place).map_err(fail)?;
    let folder = place.parent().map(Path::to_owned).unwrap_or_default();
    Ok(Source::new(path.value(), source.bytes().into_owned()).in_folder(folder))
}

/// Resolves a relative path against the folder of the calling crate.
fn absolute(path: &str) -> PathBuf {
    let folder = std::env::var_os("CARGO_MANIFEST_DIR").map(PathBuf::from).unwrap_or_default();
    folder.join(Path::new(path))
}

/// Maximum number of errors, and of warnings, that are shown individually.
const MAX_SHOWN: usize = 16;

/// Returns code that uses one deprecated constant for each of the first [`MAX_SHOWN`] warnings, and one for the number
/// of further warnings. Macros on stable Rust cannot report warnings.
fn warnings(compilation: &Compilation, span: Span) -> Vec<TokenStream> {
    let list = compilation.diagnostics.list().iter().filter(|diagnostic| diagnostic.severity == Severity::Warning);
    let mut notes: Vec<String> = list.clone().take(MAX_SHOWN).map(|warning| compilation.one_line(warning)).collect();
    let hidden = list.count() - notes.len();
    if hidden > 0 {
        notes.push(format!("{hidden} more warnings; `lexibus check` shows all of them"));
    }
    let warning = |note: String| {
        quote_spanned! {span=>
            const _: () = {
                #[deprecated(note = #note)]
                const DESCRIPTION: () = ();
                DESCRIPTION
            };
        }
    };
    notes.into_iter().map(warning).collect()
}

fn errors(compilation: &Compilation) -> String {
    if compilation.is_usable() {
        return format!("the device description cannot be used: {}", compile::NOTHING_TO_GENERATE);
    }
    let errors = compilation.diagnostics.list().iter().filter(|diagnostic| diagnostic.severity == Severity::Error);
    let shown = errors.clone().take(MAX_SHOWN);
    let mut shown: Vec<String> =
        shown.map(|error| render::terminal::render(error, &compilation.sources, false)).collect();
    let hidden = errors.count() - shown.len();
    if hidden > 0 {
        shown.push(format!("{hidden} more errors; `lexibus check` shows all of them"));
    }
    format!("the device description has errors\n\n{}", shown.join("\n\n"))
}

#[cfg(test)]
mod tests {
    use lexibus_codegen::{Builder, Presence};

    use super::*;

    /// Paths of dictionaries, relative to the folder of this crate.
    const DICTIONARIES: [&str; 10] = [
        "../dictionaries/demo-drive.eds",
        "../dictionaries/aec-vector-step.toml",
        "../dictionaries/kollmorgen-akd.toml",
        "../dictionaries/hsd-sm137-sm140.toml",
        "../dictionaries/eco.toml",
        "../tests/data/coupler.esi.xml",
        "../tests/data/drive.gsdml.xml",
        "../benches/instructions/axis.esi.xml",
        "../codegen/fuzz/seeds/xdd/gripper.xdd",
        "../codegen/tests/quirks_eds/everything.dcf",
    ];

    /// Compares the output of the macro with the output of the build script. The test `cli/tests/cli` compares the
    /// output of the command line with the output of the build script.
    #[test]
    fn the_macro_and_the_build_script_give_the_same_bytes() {
        for path in DICTIONARIES {
            for (options, builder) in [
                ("", Builder::new()),
                (" { table: true, accessors: false }", Builder::new().table(Presence::Always).accessors(false)),
            ] {
                let end = if options.is_empty() { ";" } else { options };
                let call: Call = syn::parse_str(&format!("pub mod drive = {path:?}{end}")).expect("a call");
                let (_, text) = compiled(&call).expect("bindings");
                assert!(text == builder.quiet().generate(path).expect("bindings"), "{path}{options}");
                let tokens: TokenStream = text.parse().expect("Rust");
                let expanded = expand(&call).expect("a module").to_string();
                assert!(expanded.contains(&tokens.to_string()), "{path}{options}");
            }
        }
    }

    #[test]
    fn descriptions_that_cannot_be_used_are_errors() {
        for (path, expected) in [
            ("../no-such-file.eds", "cannot read"),
            ("../tests/ui/codes-other/io002-unknown-format/page.html", "error[IO002]"),
            ("../tests/ui/quirks-esi/x03-messages-alone/input.xml", compile::NOTHING_TO_GENERATE),
        ] {
            let call: Call = syn::parse_str(&format!("mod drive = {path:?};")).expect("a call");
            let error = expand(&call).expect_err("no bindings").to_string();
            assert!(error.contains(expected), "{path}: {error}");
        }
    }

    #[test]
    fn every_option_is_known() {
        for option in call::OPTIONS {
            let values = ["true", "\"feature\"", "\"a=b\"", "\"0x6000\"", "\"EDS020\""];
            let call = |value| syn::parse_str::<Call>(&format!("mod drive = \"a.eds\" {{ {option}: {value} }}"));
            assert!(values.iter().any(|value| call(value).is_ok()), "{option}");
        }
    }

    #[test]
    fn wrong_calls_are_errors() {
        for (text, expected) in [
            ("mod drive = 5;", "expected string literal"),
            ("mod drive = \"a.eds\"", "expected `;` or options in braces after this path"),
            ("mod drive = \"a.eds\" { table: 1 }", "expected `true`, `false`, or the name of a cargo feature"),
            ("mod drive = \"a.eds\" { table: \"yes\" }", "write `true` without quotes"),
            ("mod drive = \"a.eds\" { debug: \"never\" }", "write `false` without quotes"),
            (
                "mod drive = \"a.eds\" { serde: \"a feature\" }",
                "`a feature` cannot be used as the name of a cargo feature",
            ),
            ("mod drive = \"a.eds\" { acessors: true }", "unknown option `acessors`; did you mean `accessors`?"),
            ("mod drive = \"a.eds\" { color: true }", "unknown option `color`; the options are device, module"),
            ("mod drive = \"a.eds\" { objects: \"6000..\" }", "6000.."),
            ("mod drive = \"a.eds\" { deny: \"EDS999999\" }", "EDS999999"),
            ("mod drive = \"a.eds\" { strict: true strict: true }", "expected `,`"),
            ("mod drive = \"a.eds\" { option: \"x\" }", "NAME=CHOICE"),
        ] {
            let error = syn::parse_str::<Call>(text).err().map(|error| error.to_string()).unwrap_or_default();
            assert!(error.contains(expected), "{text}: {error}");
        }
    }
}
