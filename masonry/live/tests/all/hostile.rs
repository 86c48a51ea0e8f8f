//! Requests that do not come from a page of the server are refused, and the server goes on.

use std::fs;
use std::net::TcpStream;

use masonry_live::server::Desk;
use serde_json::{Value, json};

use crate::common::{DOOR, PUSHED, directory, parts, posted, sent, serve, serve_scene};

const QUESTION: &str = r#"{"task":"begin"}"#;

/// The status of an answer.
#[track_caller]
fn status(answer: &str) -> u16 {
    answer.split(' ').nth(1).unwrap_or_else(|| panic!("no answer: {answer}")).parse().unwrap()
}

/// What the body of an answer says.
fn said(answer: &str) -> Value {
    serde_json::from_str(answer.split("\r\n\r\n").nth(1).unwrap()).unwrap()
}

/// A question with other headers than those of the page.
fn asked(host: &str, headers: &str) -> String {
    let length = QUESTION.len();
    let request =
        format!("POST /ask HTTP/1.1\r\n{headers}Content-Length: {length}\r\n\r\n{QUESTION}");
    sent(host, request.as_bytes())
}

#[test]
fn only_the_page_of_the_server_gets_answers() {
    let (address, _) = serve_scene("origin", DOOR);
    let (host, token) = parts(&address);
    let token = format!("X-Masonry-Token: {token}\r\n");
    let from_host = format!("Host: {host}\r\n");
    let good = format!("{from_host}Origin: http://{host}\r\n{token}");
    assert_eq!(status(&asked(host, &good)), 200);
    for (what, headers) in [
        ("no token", from_host.clone()),
        ("another token", format!("{from_host}X-Masonry-Token: {}\r\n", "0".repeat(32))),
        ("a part of the token", format!("{from_host}{}\r\n", &token[..token.len() - 3])),
        ("two tokens", format!("{from_host}{token}{token}")),
        ("no host", token.clone()),
        ("a host that leads here", format!("Host: example.org\r\n{token}")),
        ("another origin", format!("{from_host}Origin: http://example.org\r\n{token}")),
        ("two origins", format!("{good}Origin: http://example.org\r\n")),
        ("an opaque origin", format!("{from_host}Origin: null\r\n{token}")),
        ("another site", format!("{good}Sec-Fetch-Site: cross-site\r\n")),
    ] {
        assert_eq!(status(&asked(host, &headers)), 403, "{what}");
    }
    let head = format!("POST /ask HTTP/1.1\r\n{from_host}{token}Origin: http://");
    let no_text = [head.as_bytes(), b"\xe9.example\r\n\r\n"].concat();
    assert_eq!(status(&sent(host, &no_text)), 403, "an origin that is no UTF-8");
    assert_eq!(status(&asked(host, &good)), 200, "it goes on");
}

#[test]
fn the_page_itself_needs_the_token_and_is_shown_nowhere_else() {
    let (address, _) = serve_scene("page", DOOR);
    let (host, token) = parts(&address);
    let get = |target: &str| {
        sent(host, format!("GET {target} HTTP/1.1\r\nHost: {host}\r\n\r\n").as_bytes())
    };
    for target in ["/", "/?token=", "/?token=00", "/load", &format!("/load?token={token}")] {
        let answer = get(target);
        assert_eq!(status(&answer), 403, "{target}");
        assert!(!answer.contains(token) && !answer.contains("Access-Control"), "{target}");
    }
    let page = get(&format!("/?token={token}"));
    assert_eq!(status(&page), 200);
    for header in
        ["X-Frame-Options: DENY", "Referrer-Policy: no-referrer", "Cache-Control: no-store"]
    {
        assert!(page.contains(header), "{header}");
    }
    assert!(page.contains("default-src 'none'") && !page.contains("'unsafe-eval'"));
    // Nothing is fetched from elsewhere: the only addresses are names.
    let own = page.replace("http://www.w3.org/2000/svg", "");
    for word in ["http:", "https:", "src=", "@import", "url("] {
        assert!(!own.contains(word), "{word}");
    }
}

#[test]
fn other_pages_are_not_even_allowed_to_ask() {
    let (address, _) = serve_scene("preflight", DOOR);
    let (host, _) = parts(&address);
    let request = format!(
        "OPTIONS /ask HTTP/1.1\r\nHost: {host}\r\nOrigin: http://example.org\r\n\
         Access-Control-Request-Method: POST\r\nAccess-Control-Request-Headers: x-masonry-token\r\n\r\n"
    );
    let answer = sent(host, request.as_bytes());
    assert_eq!(status(&answer), 403);
    assert!(!answer.contains("Access-Control-Allow"));
}

#[test]
fn no_file_outside_of_the_directory_is_read_or_written() {
    let place = directory("paths");
    let inside = place.join("inside");
    fs::create_dir_all(&inside).unwrap();
    let secret = place.join("secret.toml");
    fs::write(&secret, "secret").unwrap();
    fs::write(inside.join("scene.toml"), DOOR).unwrap();
    let address = serve(Desk::with_scene(&inside.join("scene.toml")).unwrap());
    let (host, token) = parts(&address);
    for path in ["/../secret.toml", "/%2e%2e/secret.toml", "//etc/passwd", "/scene.toml"] {
        let headers = format!("Host: {host}\r\nX-Masonry-Token: {token}\r\n");
        let answer = sent(host, format!("GET {path} HTTP/1.1\r\n{headers}\r\n").as_bytes());
        assert_eq!(status(&answer), 404, "{path}");
    }
    let secret_path = secret.to_str().unwrap();
    let names = [
        "../secret.toml",
        secret_path,
        "..\\secret.toml",
        "a/../../secret.toml",
        "C:x.toml",
        "..",
        "",
        "run.sh",
    ];
    for name in names {
        for was in [json!("secret"), Value::Null] {
            let body = json!({ "name": name, "text": "x", "was": was }).to_string();
            let answer = said(&posted(&address, "/save", &body));
            let message = answer["error"]["message"].as_str().unwrap();
            assert!(message.contains("is not a plain name"), "{name}: {message}");
        }
    }
    assert_eq!(fs::read_to_string(&secret).unwrap(), "secret");
    // A scene may name another file, which the page reads in the directory of the scene only.
    for list in [secret_path, "../secret.toml", "a/../../secret.toml", "../inside/scene.toml"] {
        let message = with_list(&address, list)["error"]["message"].take();
        let message = message.as_str().unwrap();
        assert!(message.contains("is not in the directory of the scene"), "{list}: {message}");
    }
}

/// What a scene comes to whose blocks are in a file.
fn with_list(address: &str, list: &str) -> Value {
    let [before, after] = ["[[blocks]]", "[[supports]]"].map(|it| PUSHED.find(it).unwrap());
    let text = format!("block_list = {list:?}\n{}{}", &PUSHED[..before], &PUSHED[after..]);
    let body = json!({ "task": "solve", "text": text, "show": "answer", "step": null }).to_string();
    said(&posted(address, "/ask", &body))
}

const LIST: &str =
    r#"[{ "material": "stone", "corners": [[0.0, 0.0], [2.0, 0.0], [2.0, 1.0], [0.0, 1.0]] }]"#;

#[test]
fn blocks_are_read_from_the_directory_of_the_scene() {
    let (address, path) = serve_scene("list", DOOR);
    let place = path.parent().unwrap();
    let missing = with_list(&address, "blocks.json")["error"].take();
    assert!(missing["message"].as_str().unwrap().starts_with("block_list: "), "{missing}");
    assert_eq!(missing["line"], 1);
    fs::create_dir(place.join("deeper")).unwrap();
    for name in ["blocks.json", "deeper/blocks.json"] {
        fs::write(place.join(name), LIST).unwrap();
        assert_eq!(with_list(&address, name)["shown"]["verdict"], "stands", "{name}");
    }
    // The file has changed, and the text has not.
    fs::write(place.join("blocks.json"), LIST.replace("1.0]", "9.0]")).unwrap();
    assert_eq!(with_list(&address, "blocks.json")["shown"]["verdict"], "falls");
    // Places in the file are none in the text.
    fs::write(place.join("blocks.json"), LIST.replace("stone", "gold")).unwrap();
    let wrong = with_list(&address, "blocks.json")["error"].take();
    assert!(wrong["message"].as_str().unwrap().contains("blocks.json, line 1"), "{wrong}");
    assert_eq!(wrong["line"], Value::Null);
    // A drawing, too.
    let square = r#"<svg xmlns="http://www.w3.org/2000/svg"><rect x="0" y="-1" width="2" height="1"/></svg>"#;
    fs::write(place.join("blocks.svg"), square).unwrap();
    let drawn = with_list(&address, "blocks.svg");
    assert_eq!(drawn["shown"]["verdict"], "stands", "{drawn}");
    // What is no file, and what is too large.
    fs::create_dir(place.join("folder.json")).unwrap();
    assert!(with_list(&address, "folder.json")["error"]["message"].is_string());
    let large = fs::File::create(place.join("large.json")).unwrap();
    large.set_len((16 << 20) + 1).unwrap();
    let message = with_list(&address, "large.json")["error"]["message"].take();
    assert!(message.as_str().unwrap().contains("reads at most"), "{message}");
}

#[cfg(unix)]
#[test]
fn no_link_leads_blocks_out_of_the_directory() {
    let place = directory("list_links");
    let inside = place.join("inside");
    fs::create_dir_all(&inside).unwrap();
    fs::write(place.join("blocks.json"), LIST).unwrap();
    fs::write(inside.join("own.json"), LIST).unwrap();
    fs::write(inside.join("scene.toml"), DOOR).unwrap();
    std::os::unix::fs::symlink("../blocks.json", inside.join("out.json")).unwrap();
    std::os::unix::fs::symlink("..", inside.join("up")).unwrap();
    std::os::unix::fs::symlink("own.json", inside.join("in.json")).unwrap();
    let address = serve(Desk::with_scene(&inside.join("scene.toml")).unwrap());
    for list in ["out.json", "up/blocks.json"] {
        let message = with_list(&address, list)["error"]["message"].take();
        let message = message.as_str().unwrap();
        assert!(message.contains("is not in the directory of the scene"), "{list}: {message}");
    }
    assert_eq!(with_list(&address, "in.json")["shown"]["verdict"], "stands");
}

#[test]
fn a_file_that_has_changed_is_not_overwritten() {
    let (address, path) = serve_scene("changed", DOOR);
    let save = |text: &str, was: Option<&str>| saved(&address, "scene.toml", text, was);
    assert_eq!(save("# mine", Some(DOOR)), json!({ "saved": "scene.toml" }));
    fs::write(&path, "# theirs").unwrap();
    for was in [Some("# mine"), None] {
        assert!(save("# again", was)["error"]["message"].is_string());
    }
    assert_eq!(fs::read_to_string(&path).unwrap(), "# theirs");
}

/// What the server says of a save.
fn saved(address: &str, name: &str, text: &str, was: Option<&str>) -> Value {
    let body = json!({ "name": name, "text": text, "was": was }).to_string();
    said(&posted(address, "/save", &body))
}

/// What the server loads under a name, or the newest of its files.
fn loaded(address: &str, name: Option<&str>) -> Value {
    said(&posted(address, "/load", &json!({ "name": name }).to_string()))
}

#[test]
fn another_scene_of_the_directory_is_neither_read_nor_written() {
    let (address, path) = serve_scene("foreign", DOOR);
    let other = path.with_file_name("other.toml");
    fs::write(&other, "# theirs").unwrap();
    for was in [Some("# theirs"), None] {
        assert!(saved(&address, "other.toml", "# mine", was)["error"]["message"].is_string());
    }
    assert_eq!(fs::read_to_string(&other).unwrap(), "# theirs");
    let message = loaded(&address, Some("other.toml"))["error"]["message"].take();
    assert!(message.as_str().unwrap().contains("is not a file of this page"), "{message}");
}

#[test]
fn a_file_that_the_page_has_created_is_a_file_of_the_page() {
    let (address, path) = serve_scene("created", DOOR);
    assert_eq!(saved(&address, "new.toml", "# 1", None), json!({ "saved": "new.toml" }));
    assert_eq!(saved(&address, "new.toml", "# 2", Some("# 1")), json!({ "saved": "new.toml" }));
    assert_eq!(fs::read_to_string(path.with_file_name("new.toml")).unwrap(), "# 2");
    // It is what a page that is opened now begins with.
    assert_eq!(loaded(&address, None), json!({ "name": "new.toml", "text": "# 2" }));
    assert_eq!(loaded(&address, Some("scene.toml"))["text"], DOOR);
}

#[cfg(unix)]
#[test]
fn a_save_through_a_link_keeps_the_link() {
    let place = directory("link");
    let [file, link] = ["file.toml", "link.toml"].map(|it| place.join(it));
    fs::write(&file, DOOR).unwrap();
    std::os::unix::fs::symlink("file.toml", &link).unwrap();
    let address = serve(Desk::with_scene(&link).unwrap());
    assert_eq!(saved(&address, "link.toml", "# mine", Some(DOOR)), json!({ "saved": "link.toml" }));
    assert!(fs::symlink_metadata(&link).unwrap().is_symlink());
    assert_eq!(fs::read_to_string(&file).unwrap(), "# mine");
}

#[test]
fn one_of_several_saves_at_once_succeeds() {
    let (address, path) = serve_scene("at_once", DOOR);
    let texts = ["# 0", "# 1", "# 2", "# 3", "# 4", "# 5", "# 6", "# 7"];
    let answers = std::thread::scope(|scope| {
        let saves =
            texts.map(|text| scope.spawn(|| saved(&address, "scene.toml", text, Some(DOOR))));
        saves.map(|it| it.join().unwrap())
    });
    let winners: Vec<&str> = texts
        .into_iter()
        .zip(&answers)
        .filter_map(|(text, answer)| answer["error"].is_null().then_some(text))
        .collect();
    assert_eq!(winners, [fs::read_to_string(&path).unwrap()], "{answers:?}");
}

#[test]
fn a_file_keeps_its_ends_of_lines() {
    let (address, path) = serve_scene("ends", &DOOR.replace('\n', "\r\n"));
    assert_eq!(loaded(&address, None)["text"], DOOR);
    let text = DOOR.replace("courses = 12", "courses = 14");
    assert_eq!(saved(&address, "scene.toml", &text, Some(DOOR)), json!({ "saved": "scene.toml" }));
    assert_eq!(fs::read_to_string(&path).unwrap(), text.replace('\n', "\r\n"));
}

#[test]
fn large_requests_and_broken_ones_are_refused() {
    let (address, _) = serve_scene("large", DOOR);
    let (host, token) = parts(&address);
    let head = format!("POST /ask HTTP/1.1\r\nHost: {host}\r\nX-Masonry-Token: {token}\r\n");
    let hundred_megabytes = 100 << 20;
    for (wanted, request) in [
        (413, format!("{head}Content-Length: {hundred_megabytes}\r\n\r\n{}", "x".repeat(1 << 16))),
        (413, format!("{head}Content-Length: -1\r\n\r\n")),
        (501, format!("{head}Transfer-Encoding: chunked\r\n\r\n0\r\n\r\n")),
        (431, format!("{head}X-Long: {}\r\n\r\n", "x".repeat(1 << 17))),
        (400, "\u{1}\u{2}\r\n\r\n".to_owned()),
        (400, format!("{head}{}\r\n", "X: y\r\n".repeat(100))),
    ] {
        let answer = sent(host, request.as_bytes());
        assert_eq!(status(&answer), wanted, "{}", &request[..60.min(request.len())]);
    }
    // What is no question is answered by an error.
    for question in ["", "[]", "{\"task\":\"format disk\"}", "\"\\ud800\""] {
        assert!(said(&posted(&address, "/ask", question))["error"]["message"].is_string());
    }
    // Depth is no way to break it.
    let deep = json!({ "task": "solve", "text": format!("a = {}", "[".repeat(1 << 20)), "show": "answer", "step": null });
    assert!(said(&posted(&address, "/ask", &deep.to_string()))["error"]["message"].is_string());
    let long = json!({ "task": "range", "text": "#".repeat(5 << 20) }).to_string();
    let answer = said(&posted(&address, "/ask", &long));
    assert!(answer["error"]["message"].as_str().unwrap().contains("at most"));
}

#[test]
fn a_hundred_connections_do_not_stop_it() {
    let (address, _) = serve_scene("many", DOOR);
    let (host, _) = parts(&address);
    let idle: Vec<TcpStream> = (0..100).map(|_| TcpStream::connect(host).unwrap()).collect();
    // The places of those that say nothing are taken until they close; others hear so at once.
    let refused = sent(host, b"");
    assert_eq!(status(&refused), 503);
    drop(idle);
    let answers = std::iter::repeat_with(|| posted(&address, "/ask", QUESTION));
    assert!(answers.take(100).any(|it| it.starts_with("HTTP/1.1 200")));
}
