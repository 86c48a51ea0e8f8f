//! The server of the page on the loopback address: the page, questions to the engine, and the files of scenes.
//!
//! Only programs on the same machine can reach the address, and only pages of this server get answers: a request must
//! name this address as its host, must not come from another origin, and must carry a token that is drawn anew for
//! every server. A connection has one request. A question ends with its connection: a page that no longer needs an
//! answer closes the connection, and the work stops.

mod desk;
mod guard;
mod http;

use std::fmt::Display;
use std::io::{self, Write as _};
use std::net::{Ipv4Addr, TcpListener, TcpStream};
use std::ops::ControlFlow;
use std::panic::{AssertUnwindSafe, catch_unwind};
use std::sync::Arc;
use std::thread;
use std::time::{Duration, Instant};

use serde::Deserialize;
use serde_json::json;

pub use desk::{Desk, DeskError};
use guard::Guard;
use http::{Reply, Request};

use crate::engine::{Engine, Files};
use crate::page;

/// The largest number of simultaneous connections. A browser opens six connections to a host; connections beyond the
/// needs of a few tabs are refused at once.
const MOST_CONNECTIONS: usize = 32;
/// Time between two lines of news, and between the end of a connection and the end of its work.
const NEWS: Duration = Duration::from_millis(100);
/// Time until the next attempt if the system has no free connection or thread; some of them are free after this time.
const PAUSE: Duration = Duration::from_millis(100);

/// A server of the page, which listens from its creation.
#[derive(Debug)]
pub struct Server {
    listener: TcpListener,
    shared: Arc<Shared>,
}

/// The state that all connections of a server share.
#[derive(Debug)]
struct Shared {
    guard: Guard,
    desk: Desk,
    engine: Engine,
}

impl Server {
    /// Creates a server on a free port of the loopback address.
    ///
    /// # Errors
    /// The error of the operating system if there is no free port, or no source of random numbers.
    pub fn new(desk: Desk) -> io::Result<Self> {
        let listener = TcpListener::bind((Ipv4Addr::LOCALHOST, 0))?;
        let guard = Guard::new(listener.local_addr()?.port())?;
        let files = Files::new(desk.directory(), masonry_import::scene_from_toml);
        let shared = Arc::new(Shared { guard, desk, engine: Engine::with_files(files) });
        Ok(Self { listener, shared })
    }

    /// Returns the address of the page, with its token.
    pub fn address(&self) -> String {
        self.shared.guard.address()
    }

    /// Serves connections until the program ends.
    pub fn run(&self) -> ! {
        loop {
            let Ok((stream, _)) = self.listener.accept() else {
                thread::sleep(PAUSE);
                continue;
            };
            // Every connection holds one reference until its end, which counts the connections.
            let shared = self.shared.clone();
            if Arc::strong_count(&shared) > 1 + MOST_CONNECTIONS {
                // The request is not read, so that the reply may be lost with the connection.
                let reply = Reply::error(503, "too many connections: close some pages");
                let _ = http::send(&stream, &reply);
                continue;
            }
            // Errors of sending are ignored, since the page may have been closed.
            let serving = thread::Builder::new().spawn(move || shared.serve(&stream).ok());
            if serving.is_err() {
                thread::sleep(PAUSE);
            }
        }
    }
}

impl Shared {
    fn serve(&self, stream: &TcpStream) -> io::Result<()> {
        let request = match http::receive(stream, |head| self.guard.check(head)) {
            Ok(request) => request,
            Err(reply) => return http::refuse(stream, &reply),
        };
        match (request.method.as_str(), request.path.as_str()) {
            ("GET", "/") => http::send(stream, &Reply::page(page::served(&guard::secret()?))),
            ("POST", "/load") => http::send(stream, &self.load(&request)),
            ("POST", "/save") => http::send(stream, &self.save(&request)),
            ("POST", "/ask") => self.ask(stream, &request),
            _ => http::send(stream, &Reply::error(404, "there is nothing of this name")),
        }
    }

    fn load(&self, request: &Request) -> Reply {
        #[derive(Deserialize)]
        struct Load {
            /// The name of a file of the page; `None` for the newest file.
            name: Option<String>,
        }
        let Ok(load) = serde_json::from_slice::<Load>(&request.body) else {
            return Reply::error(400, "the request is not a JSON object with `name`");
        };
        match self.desk.load(load.name.as_deref()) {
            Ok(sheet) => Reply::json(&json!(sheet)),
            Err(error) => Reply::json(&json!({ "error": { "message": error.to_string() } })),
        }
    }

    fn save(&self, request: &Request) -> Reply {
        #[derive(Deserialize)]
        struct Save {
            name: String,
            text: String,
            /// The text of the file at the time at which the page read it; `None` for a new file.
            was: Option<String>,
        }
        let Ok(save) = serde_json::from_slice::<Save>(&request.body) else {
            return Reply::error(400, "the request is not a JSON object with `name` and `text`");
        };
        match self.desk.save(&save.name, &save.text, save.was.as_deref()) {
            Ok(()) => Reply::json(&json!({ "saved": save.name })),
            Err(error) => Reply::json(&json!({ "error": { "message": error.to_string() } })),
        }
    }

    /// Sends a line of news from time to time while the engine works, and then a line with the answer.
    fn ask(&self, stream: &TcpStream, request: &Request) -> io::Result<()> {
        let Ok(question) = std::str::from_utf8(&request.body) else {
            return http::send(stream, &Reply::error(400, "the question is not UTF-8 text"));
        };
        http::begin_lines(stream)?;
        let mut last = Instant::now();
        let mut watch = |news: &dyn Display| {
            if last.elapsed() < NEWS {
                return ControlFlow::Continue(());
            }
            last = Instant::now();
            let line = json!({ "news": news.to_string() }).to_string() + "\n";
            let is_gone = http::is_closed(stream) || (&*stream).write_all(line.as_bytes()).is_err();
            if is_gone { ControlFlow::Break(()) } else { ControlFlow::Continue(()) }
        };
        let answer = caught(|| self.engine.answer(question, &mut watch));
        (&*stream).write_all((answer + "\n").as_bytes())
    }
}

/// Returns the answer, or an error in its place if the solver panics.
fn caught(answer: impl FnOnce() -> String) -> String {
    catch_unwind(AssertUnwindSafe(answer)).unwrap_or_else(|_| {
        let message = "the solver has failed: this is a fault of the program, please report it with the scene";
        json!({ "error": { "message": message } }).to_string()
    })
}

#[cfg(test)]
mod tests {
    #[test]
    fn a_panic_of_the_solver_is_an_error_in_the_page() {
        let answer = super::caught(|| panic!("out of bounds"));
        assert!(answer.starts_with("{\"error\":{\"message\":\"the solver has failed"), "{answer}");
    }
}
