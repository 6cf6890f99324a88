//! Python scripts that the tests start and control.

use std::io::{BufRead, BufReader, Read, Write};
use std::path::{Path, PathBuf};
use std::process::{Child, ChildStdin, Command, Stdio};
use std::sync::mpsc::{channel, Receiver};
use std::sync::OnceLock;
use std::thread::{self, JoinHandle};
use std::time::Duration;

use serde_json::Value;

#[path = "../support/python.rs"]
mod finder;

/// Maximum time to wait for an answer. Python starts slowly on a machine under load.
const PATIENCE: Duration = Duration::from_secs(60);

/// The folder that contains these tests.
const FOLDER: &str = concat!(env!("CARGO_MANIFEST_DIR"), "/tests/interop");

/// Returns the path of a Python interpreter that has the libraries of the scripts, or `None` if there is none. Searches only
/// once.
pub fn python() -> Option<&'static Path> {
    static PYTHON: OnceLock<Option<PathBuf>> = OnceLock::new();
    PYTHON.get_or_init(|| finder::with(&["canopen", "pymodbus", "serial"])).as_deref()
}

/// A running script that answers commands. The script stops when this value is dropped.
pub struct Script {
    child: Child,
    commands: ChildStdin,
    answers: Receiver<String>,
    complaints: Option<JoinHandle<String>>,
}

impl Script {
    /// Starts `script` and waits until it is ready. Returns the script and its first message.
    pub fn start(python: &Path, script: &str, arguments: &[&str]) -> (Self, Value) {
        let mut child = Command::new(python)
            .arg(Path::new(FOLDER).join(script))
            .args(arguments)
            .env("PYTHONDONTWRITEBYTECODE", "1")
            .stdin(Stdio::piped())
            .stdout(Stdio::piped())
            .stderr(Stdio::piped())
            .spawn()
            .expect("Python runs");
        let commands = child.stdin.take().expect("a pipe");
        let output = BufReader::new(child.stdout.take().expect("a pipe"));
        let mut errors = child.stderr.take().expect("a pipe");
        let (sender, answers) = channel();
        thread::spawn(move || output.lines().map_while(Result::ok).try_for_each(|line| sender.send(line)));
        let complaints = Some(thread::spawn(move || {
            let mut text = Vec::new();
            let _ = errors.read_to_end(&mut text);
            String::from_utf8_lossy(&text).into_owned()
        }));
        let mut script = Self { child, commands, answers, complaints };
        let mut ready = script.answer();
        (script, ready["ready"].take())
    }

    /// Sends a command and returns the answer. Panics if the answer is an error.
    pub fn ask(&mut self, command: Value) -> Value {
        writeln!(self.commands, "{command}").expect("the script reads");
        let mut answer = self.answer();
        match answer["error"].as_str() {
            Some(error) => panic!("{command}: {error}"),
            None => answer["ok"].take(),
        }
    }

    fn answer(&mut self) -> Value {
        match self.answers.recv_timeout(PATIENCE) {
            Ok(line) => serde_json::from_str(&line).unwrap_or_else(|error| panic!("{error} in {line:?}")),
            Err(error) => {
                self.end();
                let complaints = self.complaints.take().and_then(|thread| thread.join().ok()).unwrap_or_default();
                panic!("no answer: {error}\n{complaints}")
            }
        }
    }

    fn end(&mut self) {
        let _ = self.child.kill();
        let _ = self.child.wait();
    }
}

impl Drop for Script {
    fn drop(&mut self) {
        self.end();
    }
}
