//! A run as a page that is served to this machine alone.
//!
//! The server listens on the loopback address. It answers only requests that know a random token, name the server by that address and do
//! not come from another page. It returns the page, its meta data and blocks of frames; during a run it also takes orders.
//!
//! A run must not depend on those who watch it. The server has its own thread, requests have limits of size and time, and a request that
//! fails, even by a panic, costs its client an answer and nothing else.

mod frames;
mod http;
mod site;

use crate::recording::RecordingError;
use http::{Limits, Server};
use site::Site;
use std::net::{Ipv4Addr, SocketAddr, TcpListener};
use std::path::{Path, PathBuf};
use std::sync::Arc;

/// What can be asked of a run that goes on.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Order {
    /// Wait before the next step.
    Pause,
    /// Go on.
    Resume,
    /// Take one step and wait again.
    Step,
    /// End as after Ctrl-C.
    Stop,
}

/// What keeps a run from being served.
#[derive(Debug, thiserror::Error)]
pub enum ServeError {
    /// The port is taken, or the system has no random numbers, no thread or no file descriptor left.
    #[error("cannot listen on {address}: {reason}")]
    Listen {
        /// Address and port.
        address: SocketAddr,
        /// The system's message.
        reason: String,
    },
    /// The run cannot be read.
    #[error(transparent)]
    Recording(#[from] RecordingError),
}

/// An address at which a run will be served. Clients that connect wait until [`Viewer::start`].
pub struct Viewer {
    listener: TcpListener,
    address: SocketAddr,
    token: String,
    folder: PathBuf,
}

impl Viewer {
    /// Listens for the run in a folder; port 0 is any free port.
    ///
    /// # Errors
    /// If the port is taken.
    pub fn listen(folder: &Path, port: u16) -> Result<Self, ServeError> {
        let address = SocketAddr::from((Ipv4Addr::LOCALHOST, port));
        let listener = TcpListener::bind(address).map_err(|error| cannot_listen(address, &error))?;
        let address = listener.local_addr().map_err(|error| cannot_listen(address, &error))?;
        let mut bytes = [0; 16];
        getrandom::fill(&mut bytes).map_err(|error| cannot_listen(address, &error))?;
        let token = bytes.iter().map(|byte| format!("{byte:02x}")).collect();
        Ok(Self { listener, address, token, folder: folder.to_owned() })
    }

    /// Returns the address of the page for a browser. Everyone who knows it can see the run.
    pub fn url(&self) -> String {
        format!("http://{}/{}/", self.address, self.token)
    }

    /// Answers requests from now on, in a thread of its own. `live` is true if the run goes on; `order` is then called with each order, by
    /// any thread.
    ///
    /// # Errors
    /// If the system has no thread or file descriptor left.
    pub fn start(self, live: bool, order: impl Fn(Order) + Send + Sync + 'static) -> Result<Serving, ServeError> {
        let Self { listener, address, token, folder } = self;
        let site = Arc::new(Site::new(address, token, folder, live, Box::new(order)));
        let server = Server::start(listener, site.clone(), Limits::default()).map_err(|error| cannot_listen(address, &error))?;
        Ok(Serving { site, _server: server })
    }
}

fn cannot_listen(address: SocketAddr, error: &impl ToString) -> ServeError {
    ServeError::Listen { address, reason: error.to_string() }
}

/// A run that is being served. Dropping it ends the server within a second, whatever its clients do.
pub struct Serving {
    site: Arc<Site>,
    _server: Server,
}

impl Serving {
    /// Tells clients from now on that the run is over. Orders are refused.
    pub fn run_is_over(&self) {
        self.site.run_is_over();
    }
}
