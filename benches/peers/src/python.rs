//! Runs the Python readers in a single process, which reads a file for each request and measures the time.

use std::io::{BufRead, BufReader, Write};
use std::path::Path;
use std::process::{Child, ChildStdin, ChildStdout, Command, Stdio};
use std::time::Duration;

pub struct Python {
    child: Child,
    requests: ChildStdin,
    replies: BufReader<ChildStdout>,
}

impl Python {
    /// Starts the Python process. Returns `None` if `setup.sh` has not been run.
    pub fn start() -> Option<Self> {
        let here = Path::new(env!("CARGO_MANIFEST_DIR"));
        let python = here.join("target/python/bin/python");
        if !python.exists() {
            eprintln!("benches/peers/setup.sh was not run: Python is not measured");
            return None;
        }
        let mut command = Command::new(python);
        command.arg(here.join("read.py")).stdin(Stdio::piped()).stdout(Stdio::piped());
        let mut child = command.spawn().expect("Python");
        let requests = child.stdin.take().expect("a pipe");
        let replies = BufReader::new(child.stdout.take().expect("a pipe"));
        Some(Python { child, requests, replies })
    }

    /// Returns the time for reading `path` `repetitions` times with `reader`, which is a key of `READERS` in `read.py`.
    pub fn time(&mut self, reader: &str, path: &Path, repetitions: u32) -> Result<Duration, String> {
        let broken = |error: std::io::Error| format!("Python is gone: {error}");
        writeln!(self.requests, "{reader}\t{repetitions}\t{}", path.display()).map_err(broken)?;
        let mut reply = String::new();
        self.replies.read_line(&mut reply).map_err(broken)?;
        reply.trim().parse().map(Duration::from_secs_f64).map_err(|_| reply.trim().to_owned())
    }
}

impl Drop for Python {
    fn drop(&mut self) {
        // Ignore an error of `kill`, because it means that the process has already ended.
        let _ = self.child.kill();
        let _ = self.child.wait();
    }
}
