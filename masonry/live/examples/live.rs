//! Serves the page of a scene, or one that begins with a choice of scenes: `cargo run -p masonry-live --example live -- SCENE`.

use std::path::Path;

use masonry_live::server::{Desk, Server};

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let desk = match std::env::args().nth(1) {
        Some(scene) => Desk::with_scene(Path::new(&scene))?,
        None => Desk::empty(Path::new(".")),
    };
    let server = Server::new(desk)?;
    println!("{}", server.address());
    Ok(server.run()?)
}
