//! The page as one text of HTML, which contains style and script; the single file contains the solver as well.

const PAGE: &str = include_str!("../page/page.html");
const STYLE: &str = include_str!("../page/page.css");
const WORKER: &str = include_str!("../page/worker.js");
/// The modules of the script; each module imports only modules before it.
const MODULES: [&str; 14] = [
    include_str!("../page/elements.js"),
    include_str!("../page/numbers.js"),
    include_str!("../page/engine.js"),
    include_str!("../page/completion.js"),
    include_str!("../page/editor.js"),
    include_str!("../page/legend.js"),
    include_str!("../page/picture.js"),
    include_str!("../page/tables.js"),
    include_str!("../page/handles.js"),
    include_str!("../page/work.js"),
    include_str!("../page/sliders.js"),
    include_str!("../page/answers.js"),
    include_str!("../page/files.js"),
    include_str!("../page/main.js"),
];

/// Returns the page of a server. The nonce, a word that nobody can guess, marks the only script that browsers run.
pub fn served(nonce: &str) -> String {
    assembled(nonce, "", "connect-src 'self'")
}

/// The solver for a browser, as the single file contains it.
#[derive(Debug, Clone, Copy)]
pub struct BrowserSolver<'a> {
    /// The script that starts the WebAssembly module. The script has no modules of its own, and defines `wasm_bindgen`.
    pub glue: &'a str,
    /// The WebAssembly module, compressed by gzip, in base64.
    pub module: &'a str,
}

/// Returns the page with its solver, which works without a server and without a network.
pub fn single(nonce: &str, solver: BrowserSolver<'_>) -> String {
    let BrowserSolver { glue, module } = solver;
    // The page itself does not run scripts of this type.
    let extra = format!(
        "<script type=\"text/plain\" id=\"worker\">\n{glue}\n{WORKER}</script>\n\
         <script type=\"text/plain\" id=\"solver\">{module}</script>\n"
    );
    assembled(nonce, &extra, "worker-src blob:; connect-src data: blob:")
}

fn assembled(nonce: &str, extra: &str, more: &str) -> String {
    let policy = format!(
        "default-src 'none'; style-src 'unsafe-inline'; img-src data:; base-uri 'none'; form-action 'none'; \
         script-src 'nonce-{nonce}' 'wasm-unsafe-eval'; {more}"
    );
    let pieces =
        [("{policy}", policy.as_str()), ("{style}", STYLE), ("{nonce}", nonce), ("{extra}", extra)];
    let (head, tail) = PAGE.split_once("{script}").unwrap_or((PAGE, ""));
    let head =
        pieces.iter().fold(head.to_owned(), |text, (name, piece)| text.replacen(name, piece, 1));
    format!("{head}{}{tail}", script())
}

/// Joins the modules into one script, whose top level all exports and imports share.
fn script() -> String {
    let lines = MODULES.iter().flat_map(|module| module.lines());
    let own = lines.filter(|line| !line.starts_with("import "));
    own.map(|line| line.strip_prefix("export ").unwrap_or(line).to_owned() + "\n").collect()
}
