//! Tests generated accessors and PDOs on CANopen with a node of the Python library `canopen`. The CAN bus of the node
//! is a pseudo-terminal, and Lexibus exports the EDS of the node.

mod blocks;
mod demo_drive;
mod lss;
mod network;
mod not_blocking;
mod pdo;
mod profile;
mod refusals;
mod served;
mod types;

use std::path::{Path, PathBuf};
use std::time::Duration;

use lexibus::clients::canopen::{self, Buffered};
use lexibus::NodeId;
use lexibus_codegen::compile::{check, Options};
use lexibus_codegen::source::Source;
use lexibus_export::eds::{export, Flavor};
use serde_json::{json, Value};
use tokio_serial::SerialStream;

use crate::pty::{Cable, Pty};
use crate::python::{python, Script};
use crate::slcan::Slcan;

lexibus::dictionary! {
    /// The bindings of a node with an object of each data type.
    mod all_types = "tests/interop/all-types.toml";
}

/// Maximum time to wait for a frame. The Python node replies slowly on a machine under load.
pub const PATIENCE: Duration = Duration::from_secs(10);

/// Node-ID of the Python node.
pub const NODE: u8 = 5;

/// The blocking client of the node. While the client waits for a response, it buffers other frames that arrive.
pub type Node = canopen::Node<Buffered<Slcan<Pty>, 64>>;

/// The asynchronous client of the node.
pub type AsyncNode = canopen::Node<Buffered<Slcan<SerialStream>, 64>>;

/// Error type of the client.
pub type Error = lexibus::Error<std::io::Error>;

pub fn node_id() -> NodeId {
    NodeId::new(NODE).expect("a node-ID")
}

/// Exports the description in `file` as an EDS, starts a node with this EDS, and returns a client of the node. `test` is the
/// name of the test.
/// Returns `None` if Python or a library is missing.
pub fn start(test: &str, file: &str) -> Option<(Script, Node)> {
    let line = Pty::open();
    let script = run(test, file, line.path())?;
    Some((script, client(line)))
}

/// Starts a node with an asynchronous client. The cable must exist as long as the client. Requires a `tokio` runtime.
pub fn start_async(test: &str, file: &str) -> Option<(Script, AsyncNode, Cable)> {
    let cable = Cable::open();
    let [near, far] = cable.ends();
    let script = run(test, file, far)?;
    let line = SerialStream::open(&tokio_serial::new(near, 115_200)).expect("a serial line");
    Some((script, client(line), cable))
}

fn client<L>(line: L) -> canopen::Node<Buffered<Slcan<L>, 64>> {
    canopen::Node::new(Buffered::new(Slcan::new(line)), node_id()).with_timeout(PATIENCE)
}

fn run(test: &str, file: &str, tty: &str) -> Option<Script> {
    let python = python()?;
    let eds = exported(test, file);
    let (script, _) = Script::start(python, "canopen_node.py", &[tty, eds.to_str().expect("UTF-8"), &NODE.to_string()]);
    Some(script)
}

/// Exports the EDS to a temporary file of this test.
fn exported(test: &str, file: &str) -> PathBuf {
    let source = Source::read(&Path::new(env!("CARGO_MANIFEST_DIR")).join(file)).expect("a description");
    let compilation = check(source, &Options::default());
    let catalog = compilation.catalog.expect("a catalog");
    let eds = export(&catalog, &catalog.devices[0], Flavor::Eds).expect("a CANopen device");
    let path = Path::new(env!("CARGO_TARGET_TMPDIR")).join(format!("interop-{test}.eds"));
    std::fs::write(&path, eds.text).expect("a temporary file");
    path
}

impl Script {
    /// Returns the value of an object, which the Python library decodes.
    pub fn get(&mut self, index: u16, sub: u8) -> Value {
        self.ask(json!({ "do": "get", "index": index, "sub": sub }))
    }

    /// Sets the value of an object, which the Python library encodes.
    pub fn set(&mut self, index: u16, sub: u8, value: Value) {
        self.ask(json!({ "do": "set", "index": index, "sub": sub, "value": value }));
    }
}
