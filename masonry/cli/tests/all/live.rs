//! `masonry live`: the address of the page, and what is wrong with a scene file.

use std::io::{BufRead as _, BufReader, Read as _, Write as _};
use std::net::TcpStream;
use std::path::Path;
use std::process::{Command, Stdio};

fn masonry() -> Command {
    Command::new(env!("CARGO_BIN_EXE_masonry"))
}

#[test]
fn the_command_serves_its_page_until_it_ends() {
    let scene = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../scenes/stack.toml");
    let mut command = masonry();
    command.arg("live").arg("--no-browser").arg(scene).stdout(Stdio::piped());
    let mut running = command.spawn().unwrap();
    let mut lines = BufReader::new(running.stdout.take().unwrap()).lines();
    let address = lines.next().unwrap().unwrap();
    let (host, target) = address.strip_prefix("http://").unwrap().split_once('/').unwrap();
    assert!(host.starts_with("127.0.0.1:"), "{address}");
    let mut stream = TcpStream::connect(host).unwrap();
    write!(stream, "GET /{target} HTTP/1.1\r\nHost: {host}\r\n\r\n").unwrap();
    let mut page = String::new();
    stream.read_to_string(&mut page).unwrap();
    assert!(page.starts_with("HTTP/1.1 200") && page.contains("id=\"picture\""));
    running.kill().unwrap();
    running.wait().unwrap();
    assert!(TcpStream::connect(host).is_err(), "the server ends with the command");
}

#[test]
fn a_scene_that_cannot_be_read_is_refused() {
    let output = masonry().args(["live", "--no-browser", "nowhere.toml"]).output().unwrap();
    assert_eq!(output.status.code(), Some(2));
    let errors = String::from_utf8(output.stderr).unwrap();
    assert!(errors.contains("cannot read or write nowhere.toml"), "{errors}");
}
