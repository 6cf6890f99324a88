//! A simulated Modbus device for tests and examples. A `tokio-modbus` server on 127.0.0.1 gives access to its
//! registers.

use std::collections::BTreeMap;
use std::future::{ready, Ready};
use std::io;
use std::net::SocketAddr;
use std::sync::{Arc, Mutex, MutexGuard, PoisonError};
use std::thread::JoinHandle;

use lexibus::RegisterTable;
use tokio::io::{AsyncRead, AsyncWrite};
use tokio::net::{TcpListener, TcpStream};
use tokio::sync::oneshot;
use tokio_modbus::server::{rtu_over_tcp, tcp, Service};
use tokio_modbus::{ExceptionCode, Request, Response};

/// The registers of a device. A bit is represented by a word with the value 0 or 1.
pub trait Registers: Send + 'static {
    /// Reads words or bits, starting at an address.
    ///
    /// # Errors
    ///
    /// Returns the exception of the device.
    fn read_words(&mut self, table: RegisterTable, address: u16, count: u16) -> Result<Vec<u16>, ExceptionCode>;

    /// Writes words or bits, starting at an address.
    ///
    /// # Errors
    ///
    /// Returns the exception of the device.
    fn write_words(&mut self, table: RegisterTable, address: u16, words: &[u16]) -> Result<(), ExceptionCode>;

    /// Changes bits of a holding register (function 22).
    ///
    /// # Errors
    ///
    /// Returns the exception of the device.
    fn mask_word(&mut self, address: u16, and: u16, or: u16) -> Result<(), ExceptionCode> {
        let held = self.read_words(RegisterTable::Holding, address, 1)?;
        self.write_words(RegisterTable::Holding, address, &[held[0] & and | or & !and])
    }

    /// Writes `words` to the holding registers from `write` on, then reads `count` holding registers from `read` on
    /// (function 23).
    ///
    /// # Errors
    ///
    /// Returns the exception of the device.
    fn exchange_words(&mut self, write: u16, words: &[u16], read: u16, count: u16) -> Result<Vec<u16>, ExceptionCode> {
        self.write_words(RegisterTable::Holding, write, words)?;
        self.read_words(RegisterTable::Holding, read, count)
    }
}

/// Registers in memory. Registers without a value do not exist.
#[derive(Debug, Default)]
pub struct Map(BTreeMap<(RegisterTable, u16), u16>);

impl Map {
    /// Adds registers or bits with these values, starting at an address.
    #[must_use]
    pub fn with(mut self, table: RegisterTable, address: u16, words: &[u16]) -> Self {
        self.0.extend((address..).map(|address| (table, address)).zip(words.iter().copied()));
        self
    }
}

impl Registers for Map {
    fn read_words(&mut self, table: RegisterTable, address: u16, count: u16) -> Result<Vec<u16>, ExceptionCode> {
        let addresses = (0..count).map(|at| address.checked_add(at));
        let word = |address: Option<u16>| self.0.get(&(table, address?)).copied();
        addresses.map(|address| word(address).ok_or(ExceptionCode::IllegalDataAddress)).collect()
    }

    fn write_words(&mut self, table: RegisterTable, address: u16, words: &[u16]) -> Result<(), ExceptionCode> {
        let count = u16::try_from(words.len()).map_err(|_| ExceptionCode::IllegalDataValue)?;
        self.read_words(table, address, count)?;
        self.0.extend((address..).map(|address| (table, address)).zip(words.iter().copied()));
        Ok(())
    }
}

/// A device and the requests that it has received.
#[derive(Debug)]
pub struct Device<S> {
    shared: Arc<Mutex<(S, Vec<String>)>>,
}

impl<S> Clone for Device<S> {
    fn clone(&self) -> Self {
        Self { shared: Arc::clone(&self.shared) }
    }
}

impl<S: Registers> Device<S> {
    /// Creates a device with these registers.
    pub fn new(registers: S) -> Self {
        Self { shared: Arc::new(Mutex::new((registers, Vec::new()))) }
    }

    /// Returns all requests since the last call.
    pub fn requests(&self) -> Vec<String> {
        std::mem::take(&mut self.lock().1)
    }

    /// Calls `look` with the registers of the device.
    pub fn with<T>(&self, look: impl FnOnce(&mut S) -> T) -> T {
        look(&mut self.lock().0)
    }

    fn lock(&self) -> MutexGuard<'_, (S, Vec<String>)> {
        self.shared.lock().unwrap_or_else(PoisonError::into_inner)
    }

    fn answer(&self, request: &Request<'_>) -> Result<Response, ExceptionCode> {
        use RegisterTable::{Coil, DiscreteInput, Holding, Input};
        let (registers, requests) = &mut *self.lock();
        requests.push(format!("{request:?}"));
        let bits = |words: Vec<u16>| words.into_iter().map(|word| word != 0).collect();
        let words = |bits: &[bool]| bits.iter().copied().map(u16::from).collect::<Vec<u16>>();
        let mut write = |table, address, words: &[u16]| {
            registers.write_words(table, address, words)?;
            Ok((address, u16::try_from(words.len()).unwrap_or(u16::MAX)))
        };
        Ok(match *request {
            Request::WriteSingleRegister(address, word) => {
                write(Holding, address, &[word])?;
                Response::WriteSingleRegister(address, word)
            }
            Request::WriteMultipleRegisters(address, ref words) => {
                let (address, count) = write(Holding, address, words)?;
                Response::WriteMultipleRegisters(address, count)
            }
            Request::WriteSingleCoil(address, bit) => {
                write(Coil, address, &[u16::from(bit)])?;
                Response::WriteSingleCoil(address, bit)
            }
            Request::WriteMultipleCoils(address, ref bits) => {
                let (address, count) = write(Coil, address, &words(bits))?;
                Response::WriteMultipleCoils(address, count)
            }
            Request::ReadHoldingRegisters(address, count) => {
                Response::ReadHoldingRegisters(registers.read_words(Holding, address, count)?)
            }
            Request::ReadInputRegisters(address, count) => {
                Response::ReadInputRegisters(registers.read_words(Input, address, count)?)
            }
            Request::ReadCoils(address, count) => {
                Response::ReadCoils(bits(registers.read_words(Coil, address, count)?))
            }
            Request::ReadDiscreteInputs(address, count) => {
                Response::ReadDiscreteInputs(bits(registers.read_words(DiscreteInput, address, count)?))
            }
            Request::MaskWriteRegister(address, and, or) => {
                registers.mask_word(address, and, or)?;
                Response::MaskWriteRegister(address, and, or)
            }
            Request::ReadWriteMultipleRegisters(read, count, write, ref words) => {
                Response::ReadWriteMultipleRegisters(registers.exchange_words(write, words, read, count)?)
            }
            _ => return Err(ExceptionCode::IllegalFunction),
        })
    }
}

impl<S: Registers> Service for Device<S> {
    type Request = Request<'static>;
    type Response = Response;
    type Exception = ExceptionCode;
    type Future = Ready<Result<Response, ExceptionCode>>;

    fn call(&self, request: Request<'static>) -> Self::Future {
        ready(self.answer(&request))
    }
}

/// The framing that the connection uses.
#[derive(Clone, Copy, Debug)]
pub enum Framing {
    /// Modbus TCP.
    Tcp,
    /// Modbus RTU.
    Rtu,
}

/// A server on an unused port of 127.0.0.1. The server stops when this value is dropped.
#[derive(Debug)]
pub struct Server {
    address: SocketAddr,
    stop: Option<oneshot::Sender<()>>,
    thread: Option<JoinHandle<()>>,
}

impl Server {
    /// Starts a server for a device.
    ///
    /// # Errors
    ///
    /// Returns an error if the port cannot be opened or the runtime cannot be started.
    pub fn start<S: Registers>(device: &Device<S>, framing: Framing) -> io::Result<Self> {
        Self::start_with(device, framing, |stream| stream)
    }

    /// Starts a server that converts each connection to another stream, such as one with faults.
    ///
    /// # Errors
    ///
    /// Returns an error if the port cannot be opened or the runtime cannot be started.
    pub fn start_with<S, T>(
        device: &Device<S>,
        framing: Framing,
        convert: impl Fn(TcpStream) -> T + Send + 'static,
    ) -> io::Result<Self>
    where
        S: Registers,
        T: AsyncRead + AsyncWrite + Unpin + Send + 'static,
    {
        let runtime = tokio::runtime::Builder::new_current_thread().enable_all().build()?;
        let listener = runtime.block_on(TcpListener::bind("127.0.0.1:0"))?;
        let address = listener.local_addr()?;
        let (stop, stopped) = oneshot::channel::<()>();
        let device = device.clone();
        let thread = std::thread::spawn(move || {
            let connected = |stream, _| ready(Ok(Some((device.clone(), convert(stream)))));
            let stopped = async { drop(stopped.await) };
            let failed = |error| eprintln!("a connection ended: {error}");
            let ended = match framing {
                Framing::Tcp => runtime.block_on(tcp::Server::new(listener).serve_until(&connected, failed, stopped)),
                Framing::Rtu => {
                    runtime.block_on(rtu_over_tcp::Server::new(listener).serve_until(&connected, failed, stopped))
                }
            };
            if let Err(error) = ended {
                eprintln!("the server ended: {error}");
            }
        });
        Ok(Self { address, stop: Some(stop), thread: Some(thread) })
    }

    /// Returns the address of the server.
    #[must_use]
    pub fn address(&self) -> SocketAddr {
        self.address
    }
}

impl Drop for Server {
    fn drop(&mut self) {
        // Ignore errors. `send` fails only if the thread has already ended, and `join` fails only if the thread panicked.
        if let Some(stop) = self.stop.take() {
            let _ = stop.send(());
        }
        if let Some(thread) = self.thread.take() {
            let _ = thread.join();
        }
    }
}
