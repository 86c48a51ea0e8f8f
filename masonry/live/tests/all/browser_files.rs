//! Texts and files of a page in a browser: saving, changes on the disk, several pages, and the end of the command.

use std::fs;

use masonry_live::server::Desk;

use crate::browser::{CONTROL, SENTENCE, SETTLED, TEXT, name_number, opened, text};
use crate::common::{DOOR, directory, serve, serve_scene};
use crate::driver::Page;

#[test]
fn a_scene_is_saved_and_changes_on_the_disk_are_loaded() {
    let (address, path) = serve_scene("save", DOOR);
    let Some(page) = Page::open(&address, 1280) else { return };
    page.wait(SETTLED);
    name_number(&page, "courses = ", "courses");
    page.drag("#courses", [4.0, 0.0], 2);
    page.wait("document.querySelector('#name.changed')");
    page.keys(CONTROL, "s");
    page.wait("!document.querySelector('#name.changed')");
    assert_eq!(fs::read_to_string(&path).unwrap(), DOOR.replace("courses = 12", "courses = 14"));
    fs::write(&path, DOOR.replace("0.981", "0.5")).unwrap();
    page.wait(&format!("{TEXT}.includes('acceleration = [0.5, 0.0]')"));
}

#[test]
fn a_conflict_on_the_disk_is_settled_by_a_choice() {
    let (address, path) = serve_scene("conflict", DOOR);
    let Some(page) = Page::open(&address, 1280) else { return };
    page.wait(SETTLED);
    name_number(&page, "courses = ", "courses");
    page.drag("#courses", [4.0, 0.0], 2);
    let mine = DOOR.replace("courses = 12", "courses = 14");
    let theirs = DOOR.replace("0.981", "0.5");
    let conflict = "!document.getElementById('conflict').hidden";
    fs::write(&path, &theirs).unwrap();
    page.keys(CONTROL, "s");
    page.wait(conflict);
    assert_eq!(fs::read_to_string(&path).unwrap(), theirs);
    page.click("#conflict button:last-of-type");
    page.wait(
        "document.querySelector('#conflict[hidden]') && document.querySelector('#notice[hidden]')",
    );
    assert_eq!(text(&page), mine, "the text is kept");
    page.keys(CONTROL, "s");
    page.wait("!document.querySelector('#name.changed')");
    assert_eq!(fs::read_to_string(&path).unwrap(), mine);

    name_number(&page, "courses = ", "courses");
    page.drag("#courses", [4.0, 0.0], 2);
    fs::write(&path, &theirs).unwrap();
    page.wait(conflict);
    page.click("#conflict button");
    page.wait(&format!("{TEXT}.includes('acceleration = [0.5, 0.0]')"));
    page.wait("document.querySelector('#conflict[hidden]')");
    assert_eq!(text(&page), theirs);
}

#[test]
fn changes_are_not_dropped_without_a_question() {
    let place = directory("unsaved");
    let Some(page) = Page::open(&serve(Desk::empty(&place)), 1280) else { return };
    page.wait(SETTLED);
    page.run("window.asked = 0; window.confirm = () => { window.asked += 1; return false; }");
    let choose = "const it = document.getElementById('begin'); it.value = 'door'; it.dispatchEvent(new Event('change'))";
    let leave = "return dispatchEvent(new Event('beforeunload', { cancelable: true }))";
    assert_eq!(page.run(leave), true, "nothing is lost yet");
    name_number(&page, "courses = ", "courses");
    page.drag("#courses", [4.0, 0.0], 2);
    let mine = text(&page);
    assert_eq!(page.run(leave), false);
    page.run(choose);
    assert_eq!(page.run("return window.asked"), 1);
    assert_eq!(text(&page), mine);
    page.run("window.prompt = () => 'mine.toml'");
    page.keys(CONTROL, "s");
    page.wait("document.getElementById('name').textContent === 'mine.toml'");
    // The file is now that of the server: it is watched, and a page that is opened anew begins with it.
    fs::write(place.join("mine.toml"), DOOR).unwrap();
    page.wait(&format!("{TEXT}.startsWith('title = \"Wall with a door\"')"));
    page.run(choose);
    assert_eq!(page.run("return window.asked"), 1, "nothing is lost");
    assert_ne!(text(&page), DOOR);
}

#[test]
fn a_text_that_was_not_saved_outlives_the_page() {
    let (address, path) = serve_scene("reload", DOOR);
    let Some(page) = Page::open(&address, 1280) else { return };
    page.wait(SETTLED);
    name_number(&page, "courses = ", "courses");
    page.drag("#courses", [4.0, 0.0], 2);
    let mine = DOOR.replace("courses = 12", "courses = 14");
    assert_eq!(text(&page), mine);
    let asks = "!document.getElementById('unsaved').hidden";
    page.go(&address);
    page.wait(&format!("{SETTLED} && {asks}"));
    assert_eq!(text(&page), DOOR, "nothing is put in the place of the file by itself");
    // Without an answer the question comes again, also after another page.
    page.go("about:blank");
    page.go(&address);
    page.wait(&format!("{SETTLED} && {asks}"));
    page.click("#unsaved button");
    page.wait(&format!("{TEXT}.includes('courses = 14')"));
    page.wait(
        "document.querySelector('#name.changed') && document.getElementById('unsaved').hidden",
    );
    page.keys(CONTROL, "s");
    page.wait("!document.querySelector('#name.changed')");
    assert_eq!(fs::read_to_string(&path).unwrap(), mine);
    page.go(&address);
    page.wait(SETTLED);
    assert_eq!(page.run(&format!("return {asks}")), false, "all is saved");
    name_number(&page, "courses = ", "courses");
    page.drag("#courses", [4.0, 0.0], 2);
    page.go(&address);
    page.wait(&format!("{SETTLED} && {asks}"));
    page.click("#unsaved button:last-of-type");
    page.go(&address);
    page.wait(SETTLED);
    assert_eq!(page.run(&format!("return {asks}")), false, "it was dropped");
    assert_eq!(text(&page), mine);
}

#[test]
fn a_new_scene_that_was_not_saved_does_not_become_that_of_the_file() {
    let (address, path) = serve_scene("reload_new", DOOR);
    let Some(page) = Page::open(&address, 1280) else { return };
    page.wait(SETTLED);
    page.run("const it = document.getElementById('begin'); it.value = 'wall'; it.dispatchEvent(new Event('change'))");
    page.wait(&format!("document.getElementById('name').textContent === 'New scene' && {SETTLED}"));
    name_number(&page, "courses = ", "courses");
    page.drag("#courses", [4.0, 0.0], 2);
    let mine = text(&page);
    page.go(&address);
    page.wait(&format!("{SETTLED} && !document.getElementById('unsaved').hidden"));
    page.click("#unsaved button");
    page.wait("document.getElementById('name').textContent === 'New scene' && document.querySelector('#name.changed')");
    assert_eq!(text(&page), mine);
    page.run("window.prompt = () => 'mine.toml'");
    page.keys(CONTROL, "s");
    page.wait("document.getElementById('name').textContent === 'mine.toml'");
    assert_eq!(fs::read_to_string(&path).unwrap(), DOOR);
    assert_eq!(fs::read_to_string(path.with_file_name("mine.toml")).unwrap(), mine);
}

#[test]
fn the_end_of_the_command_is_no_mistake_of_the_text() {
    let Some(page) = opened("ended", DOOR) else { return };
    page.run("window.fetch = () => Promise.reject(new TypeError('no connection'))");
    name_number(&page, "courses = ", "courses");
    page.drag("#courses", [4.0, 0.0], 2);
    page.wait(&format!("{SENTENCE}.startsWith('the command has ended')"));
    page.wait("document.getElementById('age').textContent.startsWith('There is no answer')");
    page.run(
        "const it = document.getElementById('export'); it.value = 'json'; it.dispatchEvent(new Event('change'))",
    );
    page.wait("document.getElementById('notice').textContent.startsWith('the command has ended')");
}

#[test]
fn two_pages_have_each_its_own_text() {
    let scene = DOOR.replace("0.981", "1.962");
    let (address, _) = serve_scene("two", &scene);
    let Some(first) = Page::open(&address, 1280) else { return };
    let second = Page::open(&address, 420).unwrap();
    for page in [&first, &second] {
        page.wait(SETTLED);
    }
    name_number(&second, "[joints.bed]\nmu = ", "mu");
    second.drag("#mu", [-100.0, 0.0], 5);
    second.wait(&format!("{SENTENCE}.startsWith('The wall falls')"));
    assert_eq!(text(&first), scene);
    first.wait(&format!("{SENTENCE}.startsWith('The wall stands')"));
}

#[test]
fn without_a_scene_the_page_begins_with_a_choice() {
    let place = directory("new");
    let Some(page) = Page::open(&serve(Desk::empty(&place)), 1280) else { return };
    page.wait(SETTLED);
    let names =
        page.run("return Array.from(document.querySelectorAll('#begin option'), it => it.value)");
    assert_eq!(
        names,
        serde_json::json!(["", "wall", "door", "arch", "panel", "facade", "bridge", "rubble"])
    );
    page.run("window.prompt = () => 'mine.toml'");
    page.click("#save");
    page.wait("document.getElementById('name').textContent === 'mine.toml'");
    assert_eq!(fs::read_to_string(place.join("mine.toml")).unwrap(), text(&page));
}
