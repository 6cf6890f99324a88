//! Pseudo-terminals that serve as serial lines between processes.

use std::fs::File;
use std::io::{Read, Write};
use std::os::fd::{AsFd, OwnedFd};
use std::path::PathBuf;
use std::thread;
use std::time::Duration;

use nix::poll::{poll, PollFd, PollFlags, PollTimeout};
use nix::pty::openpty;
use nix::sys::termios::{cfmakeraw, tcgetattr, tcsetattr, SetArg};
use nix::unistd::ttyname;

/// The master end of a pseudo-terminal. Another process can open the slave end by its path.
pub struct Pty {
    near: File,
    /// The slave end. It is kept open, because the line is closed if no process has the slave end open.
    far: OwnedFd,
    path: PathBuf,
}

impl Pty {
    /// Opens a pseudo-terminal in raw mode, in which bytes are transferred unchanged.
    pub fn open() -> Self {
        let ends = openpty(None, None).expect("a pseudo-terminal");
        let mut settings = tcgetattr(&ends.slave).expect("settings");
        cfmakeraw(&mut settings);
        tcsetattr(&ends.slave, SetArg::TCSANOW, &settings).expect("raw");
        let path = ttyname(&ends.slave).expect("a path");
        Self { near: ends.master.into(), far: ends.slave, path }
    }

    /// Returns the path of the slave end.
    pub fn path(&self) -> &str {
        self.path.to_str().expect("UTF-8")
    }

    /// Reads the available bytes. If no bytes are available, waits for at most `patience`. Returns the number of bytes.
    pub fn read(&mut self, buffer: &mut [u8], patience: Duration) -> std::io::Result<usize> {
        match self.is(PollFlags::POLLIN, patience)? {
            true => self.near.read(buffer),
            false => Ok(0),
        }
    }

    /// Writes all data. Returns `false` if the line stays full for longer than `patience`.
    pub fn write(&mut self, data: &[u8], patience: Duration) -> std::io::Result<bool> {
        let is_free = self.is(PollFlags::POLLOUT, patience)?;
        if is_free {
            self.near.write_all(data)?;
        }
        Ok(is_free)
    }

    fn is(&self, state: PollFlags, patience: Duration) -> std::io::Result<bool> {
        let timeout = PollTimeout::try_from(patience).unwrap_or(PollTimeout::MAX);
        Ok(poll(&mut [PollFd::new(self.near.as_fd(), state)], timeout)? > 0)
    }
}

/// A serial line between two pseudo-terminals, like a cable between two computers.
pub struct Cable {
    ends: [PathBuf; 2],
    /// Slave ends of both pseudo-terminals. When the slave ends are closed, the threads that copy the bytes end.
    _far: [OwnedFd; 2],
}

impl Cable {
    /// Opens two pseudo-terminals and starts the threads that copy the bytes between them.
    pub fn open() -> Self {
        let (left, right) = (Pty::open(), Pty::open());
        let both = |pty: &Pty| (pty.near.try_clone().expect("a handle"), pty.near.try_clone().expect("a handle"));
        let ((mut from_left, mut to_left), (mut from_right, mut to_right)) = (both(&left), both(&right));
        thread::spawn(move || std::io::copy(&mut from_left, &mut to_right));
        thread::spawn(move || std::io::copy(&mut from_right, &mut to_left));
        Self { ends: [left.path, right.path], _far: [left.far, right.far] }
    }

    /// Returns the paths of both slave ends.
    pub fn ends(&self) -> [&str; 2] {
        [&self.ends[0], &self.ends[1]].map(|path| path.to_str().expect("UTF-8"))
    }
}
