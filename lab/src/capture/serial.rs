//! A serial port, or a pipe to which another program writes lines.

use super::error::SensorError;
use super::source::Port;
use rustix::event::{PollFd, PollFlags, Timespec, poll};
use rustix::fs::{Mode, OFlags};
use rustix::io::Errno;
use rustix::termios::{self, ControlModes, OptionalActions, SpecialCodeIndex};
use std::fs::File;
use std::io::{self, Read as _};
use std::os::unix::fs::FileTypeExt as _;
use std::time::Duration;

/// Bytes that are read at once.
const PIECE: usize = 4096;
/// Time to wait for a writer of a pipe.
const WRITER: Duration = Duration::from_millis(10);

/// An open port.
#[derive(Debug)]
pub struct Serial {
    name: String,
    file: File,
    /// A pipe says that it has ended also before anybody writes to it.
    is_pipe: bool,
    has_begun: bool,
}

impl Serial {
    /// Opens a port and sets its line: `baud` bits a second, 8 bits, no parity, one stop bit, no flow
    /// control, every byte as it is. A pipe is read as it is.
    ///
    /// # Errors
    /// [`SensorError::Open`], also for a regular file: it does not tell when its lines were written.
    pub fn open(path: &str, baud: u32) -> Result<Self, SensorError> {
        let fail = |cause: io::Error| SensorError::Open {
            name: path.to_owned(),
            cause,
        };
        // Without waiting for a carrier or a writer, and without being controlled by the line.
        let flags = OFlags::RDWR | OFlags::NOCTTY | OFlags::NONBLOCK | OFlags::CLOEXEC;
        let kind = std::fs::metadata(path).map_err(fail)?.file_type();
        let is_pipe = kind.is_fifo();
        if !is_pipe && !kind.is_char_device() {
            let what = "it is no port and no pipe; a WAV that grows is followed by wav:";
            return Err(fail(io::Error::other(what)));
        }
        let flags = if is_pipe {
            flags.difference(OFlags::RDWR)
        } else {
            flags
        };
        let file = rustix::fs::open(path, flags, Mode::empty());
        let file = File::from(file.map_err(|errno| fail(errno.into()))?);
        if termios::isatty(&file) {
            set_line(&file, baud).map_err(|errno| fail(errno.into()))?;
        }
        Ok(Self {
            name: path.to_owned(),
            file,
            is_pipe,
            has_begun: false,
        })
    }
}

fn set_line(file: &File, baud: u32) -> Result<(), Errno> {
    let mut line = termios::tcgetattr(file)?;
    line.make_raw();
    line.control_modes |= ControlModes::CS8 | ControlModes::CREAD | ControlModes::CLOCAL;
    line.control_modes &= !(ControlModes::CSTOPB | ControlModes::CRTSCTS);
    line.special_codes[SpecialCodeIndex::VMIN] = 0;
    line.special_codes[SpecialCodeIndex::VTIME] = 0;
    line.set_speed(baud)?;
    termios::tcsetattr(file, OptionalActions::Now, &line)?;
    // What waited from before was sent at another time, or at another rate.
    termios::tcflush(file, termios::QueueSelector::IFlush)
}

impl Port for Serial {
    fn read(&mut self, wait: Duration, into: &mut Vec<u8>) -> Result<(), SensorError> {
        let fail = |cause: io::Error| SensorError::Read {
            name: self.name.clone(),
            cause,
        };
        let timeout = Timespec {
            tv_sec: wait.as_secs() as _,
            tv_nsec: wait.subsec_nanos().into(),
        };
        let mut polled = [PollFd::new(&self.file, PollFlags::IN)];
        match poll(&mut polled, Some(&timeout)) {
            Ok(0) | Err(Errno::INTR) => return Ok(()),
            Ok(_) => {}
            Err(errno) => return Err(fail(errno.into())),
        }
        let begin = into.len();
        into.resize(begin + PIECE, 0);
        let read = self.file.read(&mut into[begin..]);
        into.truncate(begin + *read.as_ref().unwrap_or(&0));
        match read {
            Ok(0) if self.is_pipe && !self.has_begun => {
                std::thread::sleep(WRITER.min(wait));
                Ok(())
            }
            Ok(0) => Err(SensorError::Ended(self.name.clone())),
            Ok(_) => {
                self.has_begun = true;
                Ok(())
            }
            Err(error) => match error.kind() {
                io::ErrorKind::WouldBlock | io::ErrorKind::Interrupted => Ok(()),
                // What Linux says of a port whose other end is gone.
                _ if error.raw_os_error() == Some(Errno::IO.raw_os_error()) => {
                    Err(SensorError::Ended(self.name.clone()))
                }
                _ => Err(fail(error)),
            },
        }
    }
}
