//! Writes the live page as one file that needs neither a server nor a network: `cargo run -p masonry-live-single -- masonry.html`.

use std::error::Error;
use std::io::Write as _;
use std::path::{Path, PathBuf};
use std::process::{Command, ExitCode, Stdio};

use base64::Engine as _;
use base64::engine::general_purpose::STANDARD;
use flate2::Compression;
use flate2::write::GzEncoder;
use masonry_live::page::{self, BrowserSolver};
use wasm_bindgen_cli_support::Bindgen;

const TARGET: &str = "wasm32-unknown-unknown";

fn main() -> ExitCode {
    let Some(path) = std::env::args_os().nth(1).map(PathBuf::from) else {
        eprintln!("error: no file is named: cargo run -p masonry-live-single -- masonry.html");
        return ExitCode::from(2);
    };
    match write(&path) {
        Ok(bytes) => {
            println!("{}, {:.1} MB", path.display(), bytes as f64 / 1e6);
            ExitCode::SUCCESS
        }
        Err(error) => {
            eprintln!("error: {error}");
            ExitCode::FAILURE
        }
    }
}

/// Writes the file and returns its size.
fn write(path: &Path) -> Result<usize, Box<dyn Error>> {
    check_target()?;
    let mut bindgen = Bindgen::new();
    let mut output = bindgen
        .input_path(compiled()?)
        .no_modules(true)?
        .typescript(false)
        .omit_default_module_path(true)
        .remove_name_section(true)
        .generate_output()?;
    let glue = output.js().to_owned();
    let mut gzip = GzEncoder::new(Vec::new(), Compression::best());
    gzip.write_all(&output.wasm_mut().emit_wasm())?;
    let module = STANDARD.encode(gzip.finish()?);
    let mut bytes = [0; 16];
    getrandom::fill(&mut bytes)?;
    let nonce = format!("{:032x}", u128::from_le_bytes(bytes));
    let page = page::single(&nonce, BrowserSolver { glue: &glue, module: &module });
    std::fs::write(path, &page)
        .map_err(|error| format!("cannot write {}: {error}", path.display()))?;
    Ok(page.len())
}

/// Reports how to install the target if it is missing; the compiler would report it in other words for every crate.
fn check_target() -> Result<(), Box<dyn Error>> {
    let rustc = std::env::var_os("RUSTC").unwrap_or("rustc".into());
    let output =
        Command::new(rustc).args(["--print", "target-libdir", "--target", TARGET]).output()?;
    let libraries = PathBuf::from(String::from_utf8(output.stdout)?.trim());
    if output.status.success() && libraries.is_dir() {
        Ok(())
    } else {
        Err(format!("the target {TARGET} is not installed: rustup target add {TARGET}").into())
    }
}

/// Compiles the solver and returns the file of the module.
fn compiled() -> Result<PathBuf, Box<dyn Error>> {
    let cargo = std::env::var_os("CARGO").unwrap_or("cargo".into());
    let output = Command::new(cargo)
        .args(["rustc", "--package", "masonry-live", "--lib", "--crate-type", "cdylib"])
        .args(["--no-default-features", "--release", "--target", TARGET])
        .arg("--message-format=json-render-diagnostics")
        .current_dir(env!("CARGO_MANIFEST_DIR"))
        .stderr(Stdio::inherit())
        .output()?;
    if !output.status.success() {
        return Err("the solver could not be compiled".into());
    }
    let messages = serde_json::Deserializer::from_slice(&output.stdout).into_iter();
    for message in messages {
        let message: serde_json::Value = message?;
        let files = message["filenames"].as_array().into_iter().flatten();
        let mut modules =
            files.filter_map(|it| it.as_str()).filter(|it| it.ends_with("masonry_live.wasm"));
        if let Some(module) = modules.next() {
            return Ok(module.into());
        }
    }
    Err("cargo has named no module".into())
}
