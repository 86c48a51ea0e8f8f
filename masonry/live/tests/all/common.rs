//! A server of a scene, and requests to it.

use std::fs;
use std::io::{Read as _, Write as _};
use std::net::TcpStream;
use std::path::{Path, PathBuf};
use std::thread;

use masonry_live::server::{Desk, Server};

/// A wall with a door on a floor, of about a hundred bricks.
pub(crate) const DOOR: &str = r#"title = "Wall with a door"
thickness = 0.25
gravity = [0.0, -9.81]
units = { length = "m", force = "kN" }

[materials.brick]
density = 1800.0

[joints.bed]
mu = 0.65

[joints.head]
mu = 0.65   # between bricks of a course

[[walls]]
name = "wall"
material = "brick"
origin = [0.0, 0.0]
brick = { length = 0.25, height = 0.125 }
width = 2.5
courses = 12
openings = [{ x = 0.75, width = 1.0, courses = 7, bearing = 0.25 }]

[[supports]]
name = "floor"
from = [0.0, 0.0]
to = [2.5, 0.0]
joint = "bed"

[[loads]]
name = "sideways"
acceleration = [0.981, 0.0]
"#;

/// A block on the ground, pushed to the side by half its weight.
pub(crate) const PUSHED: &str = r#"title = "Block"
thickness = 1.0
gravity = [0.0, -10.0]
units = { length = "m", force = "kN" }
materials.stone = { density = 2000.0 }
joints.bed = { mu = 0.8 }

[[blocks]]
name = "block"
material = "stone"
corners = [[0.0, 0.0], [2.0, 0.0], [2.0, 1.0], [0.0, 1.0]]

[[supports]]
name = "ground"
from = [0.0, 0.0]
to = [2.0, 0.0]
joint = "bed"

[[loads]]
name = "push"
acceleration = [5.0, 0.0]
"#;

/// A directory for the files of a test.
pub(crate) fn directory(name: &str) -> PathBuf {
    let directory = Path::new(env!("CARGO_TARGET_TMPDIR")).join("live").join(name);
    let _ = fs::remove_dir_all(&directory);
    fs::create_dir_all(&directory).unwrap();
    directory
}

/// Serves a desk until the tests end, and returns the address of its page.
pub(crate) fn serve(desk: Desk) -> String {
    let server = Server::new(desk).unwrap();
    let address = server.address();
    thread::spawn(move || server.run());
    address
}

/// Serves a scene in a directory of its own: the address of the page, and the file.
pub(crate) fn serve_scene(name: &str, text: &str) -> (String, PathBuf) {
    let path = directory(name).join("scene.toml");
    fs::write(&path, text).unwrap();
    (serve(Desk::with_scene(&path).unwrap()), path)
}

/// Host and token of an address.
pub(crate) fn parts(address: &str) -> (&str, &str) {
    address.strip_prefix("http://").unwrap().split_once("/?token=").unwrap()
}

/// Sends bytes and returns all that comes back; a connection that is broken off says nothing.
pub(crate) fn sent(host: &str, bytes: &[u8]) -> String {
    let mut stream = TcpStream::connect(host).unwrap();
    let _ = stream.write_all(bytes);
    let mut answer = Vec::new();
    let _ = stream.read_to_end(&mut answer);
    String::from_utf8_lossy(&answer).into_owned()
}

/// A request as the page sends it.
pub(crate) fn posted(address: &str, path: &str, body: &str) -> String {
    let (host, token) = parts(address);
    let length = body.len();
    let request = format!(
        "POST {path} HTTP/1.1\r\nHost: {host}\r\nOrigin: http://{host}\r\nX-Masonry-Token: {token}\r\n\
         Content-Length: {length}\r\n\r\n{body}"
    );
    sent(host, request.as_bytes())
}

/// Says something past the capture of the test harness, which hides what a test prints that passes.
pub(crate) fn say(line: &str) {
    std::io::stderr().write_all(format!("{line}\n").as_bytes()).unwrap();
}
