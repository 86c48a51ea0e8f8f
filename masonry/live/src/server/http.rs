//! The part of HTTP/1.1 that one page needs: one request per connection, of limited size and time.

use std::io::{self, ErrorKind, Read as _, Write as _};
use std::net::{Shutdown, TcpStream};
use std::time::{Duration, Instant};

use serde_json::Value;

use crate::engine::LONGEST_TEXT;

/// The longest head of a request \[bytes\]; browsers send heads of one or two thousand bytes.
const LONGEST_HEAD: usize = 16 << 10;
const MOST_HEADERS: usize = 64;
/// The longest body of a request \[bytes\]: twice the longest text of a scene. A character may take six bytes in JSON,
/// but few do.
const LONGEST_BODY: usize = 2 * LONGEST_TEXT;
/// The longest time to wait for a request; a request from the same machine comes at once.
const PATIENCE: Duration = Duration::from_secs(5);

/// Request line and headers of a request, with the query separated from the path.
pub(super) struct Head<'a> {
    pub(super) method: &'a str,
    pub(super) path: &'a str,
    pub(super) query: Option<&'a str>,
    headers: &'a [httparse::Header<'a>],
}

impl Head<'_> {
    /// Returns the value of a header. The value is empty if the header occurs twice or is not UTF-8, so that it does
    /// not count as absent. `None` if there is no such header.
    pub(super) fn header(&self, name: &str) -> Option<&str> {
        let mut named = self.headers.iter().filter(|it| it.name.eq_ignore_ascii_case(name));
        let value = std::str::from_utf8(named.next()?.value).unwrap_or_default();
        // Two headers of one name are ambiguous.
        if named.next().is_some() { Some("") } else { Some(value) }
    }
}

/// A request that was read completely.
#[derive(Debug)]
pub(super) struct Request {
    pub(super) method: String,
    pub(super) path: String,
    pub(super) body: Vec<u8>,
}

/// A complete answer: status, content type and body.
#[derive(Debug)]
pub(super) struct Reply {
    status: u16,
    kind: &'static str,
    body: String,
}

impl Reply {
    pub(super) fn page(body: String) -> Self {
        Self { status: 200, kind: "text/html; charset=utf-8", body }
    }

    pub(super) fn json(value: &Value) -> Self {
        Self { status: 200, kind: "application/json", body: value.to_string() }
    }

    pub(super) fn error(status: u16, message: &str) -> Self {
        Self { status, kind: "text/plain; charset=utf-8", body: format!("{message}\n") }
    }
}

/// Reads a request; `check` may refuse it by its head before the body is read.
///
/// # Errors
/// The reply that states the reason for the refusal.
pub(super) fn receive(
    stream: &TcpStream,
    check: impl FnOnce(&Head<'_>) -> Result<(), Reply>,
) -> Result<Request, Reply> {
    let until = Instant::now() + PATIENCE;
    let mut bytes = Vec::new();
    let head_end = loop {
        if let Some(end) = bytes.windows(4).position(|it| it == b"\r\n\r\n") {
            break end + 4;
        }
        if bytes.len() > LONGEST_HEAD {
            return Err(Reply::error(431, "the head of the request is too long"));
        }
        read_more(stream, &mut bytes, until)?;
    };
    let mut headers = [httparse::EMPTY_HEADER; MOST_HEADERS];
    let mut parsed = httparse::Request::new(&mut headers);
    let malformed = || Reply::error(400, "the request is malformed");
    parsed.parse(&bytes[..head_end]).map_err(|_| malformed())?;
    let (Some(method), Some(target)) = (parsed.method, parsed.path) else {
        return Err(malformed());
    };
    let (path, query) = target.split_once('?').map_or((target, None), |(a, b)| (a, Some(b)));
    let head = Head { method, path, query, headers: parsed.headers };
    check(&head)?;
    let length = length_of_body(&head)?;
    let (method, path) = (head.method.to_owned(), head.path.to_owned());
    let mut body = bytes.split_off(head_end);
    while body.len() < length {
        read_more(stream, &mut body, until)?;
    }
    body.truncate(length);
    Ok(Request { method, path, body })
}

fn length_of_body(head: &Head<'_>) -> Result<usize, Reply> {
    if head.header("transfer-encoding").is_some() {
        return Err(Reply::error(501, "the length of a request must be known"));
    }
    let Some(length) = head.header("content-length") else { return Ok(0) };
    match length.parse() {
        Ok(length) if length <= LONGEST_BODY => Ok(length),
        _ => Err(Reply::error(413, "the request is too long")),
    }
}

fn read_more(stream: &TcpStream, bytes: &mut Vec<u8>, until: Instant) -> Result<(), Reply> {
    let late = || Reply::error(408, "the request has not come to its end");
    let left = until.checked_duration_since(Instant::now()).filter(|it| !it.is_zero());
    stream.set_read_timeout(Some(left.ok_or_else(late)?)).map_err(|_| late())?;
    let mut part = [0; 16 << 10];
    match (&*stream).read(&mut part) {
        Ok(0) | Err(_) => Err(late()),
        Ok(count) => {
            bytes.extend_from_slice(&part[..count]);
            Ok(())
        }
    }
}

/// Headers of every answer: browsers must not store the answer, show it in frames of other pages, or guess another
/// content type.
const ALWAYS: &str = "Connection: close\r\nCache-Control: no-store\r\nX-Content-Type-Options: nosniff\r\n\
     X-Frame-Options: DENY\r\nReferrer-Policy: no-referrer\r\nCross-Origin-Resource-Policy: same-origin\r\n";

/// Sends a complete answer.
pub(super) fn send(mut stream: &TcpStream, reply: &Reply) -> io::Result<()> {
    let Reply { status, kind, body } = reply;
    let reason = if *status == 200 { "OK" } else { "Refused" };
    let length = body.len();
    stream.set_write_timeout(Some(PATIENCE))?;
    let head = format!(
        "HTTP/1.1 {status} {reason}\r\nContent-Type: {kind}\r\nContent-Length: {length}\r\n{ALWAYS}\r\n"
    );
    stream.write_all(&[head.as_bytes(), body.as_bytes()].concat())?;
    stream.shutdown(Shutdown::Write)
}

/// Sends the answer to a request that was not read to its end. Reads and drops incoming bytes for a moment, since
/// closing the connection at once would reset it before the page has received the answer.
pub(super) fn refuse(stream: &TcpStream, reply: &Reply) -> io::Result<()> {
    const MOMENT: Duration = Duration::from_millis(200);
    send(stream, reply)?;
    let until = Instant::now() + MOMENT;
    let mut thrown_away = Vec::new();
    while read_more(stream, &mut thrown_away, until).is_ok() {
        thrown_away.clear();
    }
    Ok(())
}

/// Begins an answer that consists of lines of JSON and ends with the connection.
pub(super) fn begin_lines(mut stream: &TcpStream) -> io::Result<()> {
    stream.set_nodelay(true)?;
    stream.set_write_timeout(Some(PATIENCE))?;
    let head = format!("HTTP/1.1 200 OK\r\nContent-Type: application/x-ndjson\r\n{ALWAYS}\r\n");
    stream.write_all(head.as_bytes())
}

/// Whether the other side has closed the connection.
pub(super) fn is_closed(stream: &TcpStream) -> bool {
    let mut byte = [0];
    let peeked = stream.set_nonblocking(true).and_then(|()| stream.peek(&mut byte));
    let is_blocking = stream.set_nonblocking(false).is_ok();
    match peeked {
        Ok(count) => count == 0 || !is_blocking,
        Err(error) => error.kind() != ErrorKind::WouldBlock || !is_blocking,
    }
}
