//! `lexibus network`: checks and builds the configuration of a CANopen network or an EtherCAT segment.

use lexibus_codegen::compile::Compilation as Reported;
use lexibus_codegen::output::write_if_changed;
use lexibus_codegen::text::count_of;
use lexibus_network::check::bus_load;
use lexibus_network::compile::{compile, Compilation};
use lexibus_network::frontend::schema;
use lexibus_network::model::Network;
use lexibus_network::output::{files, segment_summary, OutputFile};

use super::args::{self, NetworkBuild, NetworkCheck, NetworkCommand, NetworkInput};
use super::files::{cannot_write, create_folder, read as read_file};
use super::report::Reporter;
use super::{output, Failure};

pub(super) fn run(network: &args::Network) -> Result<bool, Failure> {
    match &network.command {
        NetworkCommand::Check(arguments) => check(arguments),
        NetworkCommand::Build(arguments) => build(arguments),
        NetworkCommand::Schema(arguments) => super::schema::print(arguments, &schema()),
    }
}

fn check(arguments: &NetworkCheck) -> Result<bool, Failure> {
    let (mut reporter, compilation) = read(&arguments.input, true)?;
    report(&mut reporter, &compilation)?;
    if let Some(network) = compilation.usable() {
        reporter.progress(&summary(network));
    }
    reporter.finish()
}

fn build(arguments: &NetworkBuild) -> Result<bool, Failure> {
    let (mut reporter, compilation) = read(&arguments.input, false)?;
    report(&mut reporter, &compilation)?;
    if let Some(network) = compilation.usable() {
        let files = files(network);
        files.iter().try_for_each(|file| write(file, arguments, &mut reporter))?;
        if !arguments.check && !reporter.has_errors() {
            let files = count_of(files.len(), "file");
            reporter.progress(&format!("wrote {files} to {}", arguments.out.display()));
            reporter.progress(&summary(network));
        }
    }
    reporter.finish()
}

fn read(input: &NetworkInput, is_result: bool) -> Result<(Reporter, Compilation), Failure> {
    let source = read_file(&input.path)?;
    let reporter = Reporter::with(&input.printing, is_result)?;
    Ok((reporter, compile(source, input.levels.levels()?)))
}

pub(super) fn report(reporter: &mut Reporter, compilation: &Compilation) -> Result<(), Failure> {
    let Compilation { source, diagnostics, .. } = compilation;
    reporter.report(&Reported::of_diagnostics(source.clone(), diagnostics.clone()))
}

/// Returns a summary of the CANopen nodes and of the EtherCAT segment.
fn summary(network: &Network) -> String {
    let canopen = (!network.is_only_segment()).then(|| canopen_summary(network));
    let segment = network.segment.as_ref().map(segment_summary);
    canopen.into_iter().chain(segment).collect::<Vec<_>>().join("\n")
}

/// Returns a summary: the number of nodes including the master, the bus load of the cyclic frames, and the PDOs that
/// the bus load leaves out, because they have neither an inhibit time nor an event timer.
fn canopen_summary(network: &Network) -> String {
    let nodes = network.nodes.len() + usize::from(network.master.is_some());
    format!("{}; {}", count_of(nodes, "node"), bus_load(network).summary())
}

/// Writes a file, or compares it with the existing file.
fn write(file: &OutputFile, arguments: &NetworkBuild, reporter: &mut Reporter) -> Result<(), Failure> {
    let path = arguments.out.join(&file.name);
    if arguments.check {
        output::check_bytes(&path, &file.content, reporter);
        return Ok(());
    }
    let folder = path.parent().unwrap_or(&arguments.out);
    create_folder(folder)?;
    if let Err(error) = write_if_changed(&path, &file.content) {
        reporter.error(&cannot_write(&path, &error));
    }
    Ok(())
}
