//! The page in a browser, operated by mouse and keys.

use std::fs;

use crate::common::{DOOR, directory, say, serve_scene};
use crate::driver::Page;

/// The picture is that of the text.
pub(crate) const SETTLED: &str =
    "document.querySelector('#shown[aria-busy=false] svg[data-frame]')";
pub(crate) const CONTROL: &str = "\u{e009}";
const ALT: &str = "\u{e00a}";
/// The key with an arrow upwards.
const UP: char = '\u{e013}';

/// The sentence above the picture.
pub(crate) const SENTENCE: &str = "document.querySelector('h1').textContent";
/// The text of the scene.
pub(crate) const TEXT: &str = "document.getElementById('scene').value";

pub(crate) fn opened(name: &str, text: &str) -> Option<Page> {
    let (address, _) = serve_scene(name, text);
    let page = Page::open(&address, 1280)?;
    page.wait(SETTLED);
    Some(page)
}

pub(crate) fn text(page: &Page) -> String {
    page.run(&format!("return {TEXT}")).as_str().unwrap().to_owned()
}

/// Gives the number after some words in the text a name by which it is found.
#[track_caller]
pub(crate) fn name_number(page: &Page, words: &str, name: &str) {
    let at = text(page).find(words).unwrap_or_else(|| panic!("no {words}")) + words.len();
    page.run(&format!("document.querySelector('[data-from=\"{at}\"]').id = {name:?}"));
}

#[test]
fn a_number_is_dragged_and_the_wall_falls() {
    let Some(page) = opened("drag", DOOR) else { return };
    page.wait(&format!("{SENTENCE}.startsWith('The wall stands')"));
    page.run("window.before = document.querySelector('#picture svg[data-frame]')");
    name_number(&page, "[joints.bed]\nmu = ", "mu");
    let place = || page.run("return document.getElementById('undo').offsetLeft");
    let before = place();
    page.drag("#mu", [-120.0, 0.0], 25);
    page.wait(&format!("{SENTENCE}.startsWith('The wall falls')"));
    assert!(text(&page).contains("[joints.bed]\nmu = 0.05\n"), "{}", text(&page));
    // The comment is still there, and the picture is the same element.
    assert!(text(&page).contains("mu = 0.65   # between bricks of a course"));
    assert_eq!(
        page.run("return window.before === document.querySelector('#picture svg[data-frame]')"),
        true
    );
    assert_eq!(place(), before, "no button moves below a hand");
    page.click("#undo");
    page.wait(&format!("{SENTENCE}.startsWith('The wall stands')"));
    assert_eq!(text(&page), DOOR, "a drag is undone at once");
    assert_eq!(place(), before, "nor if the text is that of the file again");
}

#[test]
fn keys_change_numbers_too() {
    let Some(page) = opened("keys", DOOR) else { return };
    name_number(&page, "courses = ", "courses");
    page.click("#courses");
    page.keys(ALT, &UP.to_string());
    assert!(text(&page).contains("courses = 13\n"), "{}", text(&page));
    page.keys(CONTROL, "z");
    assert_eq!(text(&page), DOOR);
}

#[test]
fn a_mistake_is_shown_in_its_place_and_the_last_picture_stays() {
    let Some(page) = opened("mistake", DOOR) else { return };
    let at = DOOR.find("courses").unwrap();
    page.run(&format!(
        "const it = document.getElementById('scene'); it.focus(); it.setSelectionRange({at}, {at})"
    ));
    page.keys("", "x");
    page.wait("!document.getElementById('fault').hidden");
    let fault = page.run("return document.getElementById('fault').textContent");
    let line = 1 + DOOR.lines().position(|it| it.starts_with("courses")).unwrap();
    let fault = fault.as_str().unwrap();
    assert!(fault.starts_with(&format!("Line {line}, column 1")), "{fault}");
    assert!(fault.contains("did you mean `courses`?"), "{fault}");
    assert_eq!(
        page.run("return document.querySelector('.row.wrong').textContent"),
        "xcourses = 12"
    );
    page.wait("document.querySelector('#shown.stale svg')");
    page.keys("", "\u{e003}");
    page.wait("document.getElementById('fault').hidden && !document.querySelector('#shown.stale')");
}

#[test]
fn sliders_and_openings_change_the_text() {
    let Some(page) = opened("handles", DOOR) else { return };
    page.run(
        "const it = document.querySelector('#controls input'); it.value = 0.3; \
         it.dispatchEvent(new Event('input')); it.dispatchEvent(new Event('change'))",
    );
    page.wait(&format!("{TEXT}.includes('[joints.bed]\\nmu = 0.30')"));
    page.wait(SETTLED);
    let scale = "Number(document.querySelector('#picture svg[data-frame]').dataset.frame.split(' ')[2]) * \
                 document.querySelector('svg.handles').getScreenCTM().a";
    let per_length = page.run(&format!("return {scale}")).as_f64().unwrap();
    page.drag("[aria-label^='place of wall']", [0.6 * per_length, 0.0], 10);
    // The lintel has too little wall to rest on.
    page.wait(&format!("/x = 1\\.3[0-9]*,/.test({TEXT})"));
    page.wait("!document.getElementById('fault').hidden");
    page.wait(SETTLED);
    page.drag("[aria-label^='place of wall']", [-0.2 * per_length, 0.0], 10);
    page.wait(&format!("/x = 1\\.1[0-9]*,/.test({TEXT})"));
    page.wait(SETTLED);
    page.drag("[aria-label^='top of wall']", [0.0, 0.25 * per_length], 10);
    page.wait(&format!("{TEXT}.includes('courses = 5,')"));
    page.wait("document.getElementById('fault').hidden");
}

#[test]
fn sliders_that_are_moved_at_once_count_both() {
    let Some(page) = opened("both", DOOR) else { return };
    page.run(
        "for (const it of [...document.querySelectorAll('#controls input')].slice(0, 2)) { \
         it.value = 0.4; it.dispatchEvent(new Event('input')); it.dispatchEvent(new Event('change')); }",
    );
    page.wait(&format!("{TEXT}.match(/mu = 0\\.40/g)?.length === 2"));
}

#[test]
fn a_scene_with_a_mistake_has_buttons_with_names() {
    let (address, _) = serve_scene("mistake_first", &DOOR.replace("courses = 12", "curses = 12"));
    let Some(page) = Page::open(&address, 1280) else { return };
    page.wait("!document.getElementById('fault').hidden");
    let names = page
        .run("return Array.from(document.querySelectorAll('[data-asks]'), it => it.textContent)");
    assert_eq!(names.as_array().unwrap().len(), 5, "{names}");
    assert!(
        names.as_array().unwrap().iter().all(|it| it.as_str().unwrap().ends_with("changes at?")),
        "{names}"
    );
}

#[test]
fn one_slider_moves_the_friction_of_all_joints_and_finds_where_the_wall_falls() {
    let Some(page) = opened("all", &DOOR.replace("mu = 0.65   #", "mu = 0.325 #")) else { return };
    page.run(
        "const it = document.querySelectorAll('#controls input')[2]; it.value = 0.4; \
         it.dispatchEvent(new Event('input')); it.dispatchEvent(new Event('change'))",
    );
    page.wait(&format!("{TEXT}.includes('mu = 0.40\\n') && {TEXT}.includes('mu = 0.200 #')"));
    page.wait(SETTLED);
    page.click("[data-asks='μ of all joints']");
    let found = "document.querySelector('#found h2')";
    page.wait(&format!(
        "{found}?.textContent.includes('changes with μ of all joints: falls at 0.')"
    ));
}

#[test]
fn a_number_is_selected_by_two_clicks_where_it_is() {
    let Some(page) = opened("clicks", DOOR) else { return };
    name_number(&page, "[joints.bed]\nmu = ", "mu");
    page.click("#mu");
    name_number(&page, "[joints.bed]\nmu = ", "mu");
    page.click("#mu");
    page.keys("", "0.5");
    page.wait(&format!("{TEXT}.includes('[joints.bed]\\nmu = 0.5\\n')"));
    assert_eq!(text(&page), DOOR.replace("bed]\nmu = 0.65", "bed]\nmu = 0.5"));
    // The editor has not gone to the end of the text.
    assert_eq!(page.run("return document.getElementById('editor').scrollTop"), 0);
}

#[test]
fn text_and_picture_mark_each_other() {
    let Some(page) = opened("marks", DOOR) else { return };
    let marked = "Array.from(document.querySelectorAll('.row.marked'), it => it.textContent)";
    page.click("[data-block='wall/12/1']");
    page.wait(&format!("{marked}[0] === '[[walls]]' && {marked}.at(-1).startsWith('openings')"));
    page.wait("document.querySelectorAll('[data-block].found').length > 90");
    page.run(
        "const it = document.getElementById('scene'); it.focus(); \
         const at = it.value.indexOf('[[supports]]'); it.setSelectionRange(at, at)",
    );
    page.wait("document.querySelector('[data-support=floor].found')");
    assert_eq!(page.run("return document.querySelectorAll('[data-block].found').length"), 0);
}

#[test]
fn keys_move_handles_and_take_completions() {
    let Some(page) = opened("keyboard", DOOR) else { return };
    page.run("document.querySelector(\"[aria-label^='top of wall']\").focus()");
    page.keys("", &UP.to_string());
    page.wait(&format!("{TEXT}.includes('courses = 8,')"));
    page.run(
        "const it = document.getElementById('scene'); it.focus(); \
         const at = it.value.indexOf('courses = 12'); it.setSelectionRange(at, at)",
    );
    page.keys("", "bo");
    page.wait("!document.getElementById('completion').hidden");
    page.keys("", "\u{e007}");
    page.wait(&format!("{TEXT}.includes('bondcourses = 12')"));
}

#[test]
fn a_limit_is_found_and_another_one_is_stopped() {
    let Some(page) = opened("limit", DOOR) else { return };
    page.click("[data-task=limit]");
    page.wait("document.querySelector('#found h2')");
    let found = page.run("return document.querySelector('#found h2').textContent");
    assert!(found.as_str().unwrap().contains("sideways"), "{found}");
    page.wait("document.querySelector('#found figure svg')");
    // What was found is that of an earlier text after a change.
    assert_eq!(page.run("return document.querySelectorAll('.old').length"), 0);
    name_number(&page, "[joints.head]\nmu = ", "head");
    page.drag("#head", [4.0, 0.0], 2);
    page.wait(&format!(
        "{SETTLED} && document.querySelectorAll('#news.old, #found .old').length === 2"
    ));

    let large = DOOR
        .replace("width = 2.5", "width = 12.5")
        .replace("courses = 12", "courses = 40")
        .replace("[2.5, 0.0]", "[12.5, 0.0]");
    let (address, _) = serve_scene("large_limit", &large);
    page.go(&address);
    page.wait(SETTLED);
    page.click("[data-task=limit]");
    page.wait("!document.getElementById('stop').hidden");
    page.click("#stop");
    page.wait("document.getElementById('news').textContent.endsWith('(stopped)')");
    assert_eq!(page.run("return document.getElementById('stop').hidden"), true);
    // The page goes on at once.
    name_number(&page, "[joints.bed]\nmu = ", "mu");
    page.drag("#mu", [4.0, 0.0], 2);
    page.wait(&format!("{SETTLED} && {TEXT}.includes('mu = 0.67')"));
}

#[test]
fn a_number_is_asked_at_which_value_the_wall_falls() {
    let Some(page) = opened("change", DOOR) else { return };
    assert_eq!(page.run("return document.getElementById('change').disabled"), true);
    name_number(&page, "[joints.bed]\nmu = ", "mu");
    page.click("#mu");
    page.wait("document.getElementById('change').textContent === 'mu in line 10: falls at?'");
    page.click("#change");
    let found = "document.querySelector('#found h2').textContent";
    page.wait(&format!("document.querySelector('#found h2') && {found}.includes('changes with mu in line 10: falls at 0.0')"));
    page.wait("document.querySelector('#found figure svg')");
    // The scene has stayed, and a slider asks as well.
    assert_eq!(text(&page), DOOR);
    page.click("[data-asks='μ of head']");
    page.wait(&format!("{found}.includes('μ of head')"));
    // Keys ask as well.
    page.run("document.getElementById('scene').focus()");
    page.keys(ALT, "\u{e007}");
    page.wait(&format!("{found}.includes('changes with mu in line 10')"));
    // A wall that falls is asked at which value it stands; what was chosen is still the same number.
    name_number(&page, "[joints.bed]\nmu = ", "mu");
    page.drag("#mu", [-120.0, 0.0], 5);
    page.wait("document.getElementById('change').textContent === 'mu in line 10: stands at?'");
}

/// Times from an input to the picture on the screen [ms], and of the solves alone.
fn times(page: &Page) -> Vec<[f64; 2]> {
    let list = page.run(
        "return performance.getEntriesByName('answer').map(it => [it.duration, it.detail.solve])",
    );
    serde_json::from_value(list).unwrap()
}

/// The times of pictures in a sentence.
fn told(name: &str, mut times: Vec<[f64; 2]>) -> String {
    times.sort_by(|a, b| a[0].total_cmp(&b[0]));
    let [[median, solve], [slow, _]] = [50, 95].map(|part| times[(times.len() - 1) * part / 100]);
    format!(
        "{name}: {} pictures, in the middle {:.1} times the solve ({median:.0} ms), 95 % within {:.1} times ({slow:.0} ms)",
        times.len(),
        median / solve,
        slow / solve,
    )
}

/// The page is fast because it adds little to the solve. What is printed are ratios, since a machine that tests has others to serve.
#[test]
fn pictures_follow_the_hand() {
    let read = |name: &str| fs::read_to_string(format!("../../scenes/{name}.toml")).unwrap();
    let large = DOOR
        .replace("width = 2.5\ncourses = 12", "width = 7.5\ncourses = 36")
        .replace("to = [2.5, 0.0]", "to = [7.5, 0.0]");
    let of_bed = "[joints.bed]\nmu = ";
    for (name, scene, words) in [
        ("100 rigid bricks with a door", DOOR.to_owned(), of_bed),
        (
            "40 voussoirs",
            read("arch_semicircular"),
            "voussoirs = 40\njoint = \"radial\"\nspringing = \"radial\"\n\n[[loads]]\nname = \"sideways\"\nacceleration = [",
        ),
        ("100 elastic bricks", read("panel_square"), of_bed),
        ("1000 rigid bricks", large, of_bed),
    ] {
        let Some(page) = opened(&format!("times {name}"), &scene) else { return };
        name_number(&page, words, "number");
        let before = text(&page);
        page.run("performance.clearMeasures()");
        page.drag("#number", [-60.0, 0.0], 60);
        page.wait(SETTLED);
        page.wait("performance.getEntriesByName('answer').length > 0");
        assert_ne!(text(&page), before, "{name}");
        page.wait(
            "document.getElementById('fault').hidden && !document.querySelector('#shown.stale')",
        );
        // A change in the middle of a drag waits for the picture of the one before.
        say(&told(&format!("{name}, one drag"), times(&page)));
        page.run("performance.clearMeasures()");
        for count in 1..=5 {
            name_number(&page, words, "number");
            page.drag("#number", [2.0, 0.0], 1);
            let answered =
                format!("performance.getEntriesByName('answer').length === {count} && {SETTLED}");
            page.wait(&answered);
        }
        say(&told(&format!("{name}, single changes"), times(&page)));
    }
}

#[test]
fn tables_are_sorted_by_their_columns_and_stay_so() {
    let Some(page) = opened("tables", DOOR) else { return };
    page.click("[data-show=tables]");
    page.wait("document.querySelector('#tables table')");
    let column = |name: &str| {
        format!(
            "Array.from(document.querySelectorAll('#tables section')).find(it => it.querySelector('h2').textContent === 'Joints').querySelectorAll('{name}')"
        )
    };
    // The column of the normal force, by the mouse and by keys.
    let heads = column("th button");
    let index = page.run(&format!(
        "return Array.from({heads}).findIndex(it => it.textContent.startsWith('N '))"
    ));
    let index = index.as_u64().unwrap();
    page.run(&format!("{heads}[{index}].id = 'normal'"));
    let values = format!(
        "Array.from({}, it => it.children[{index}].dataset.value).filter(it => it !== undefined).map(Number)",
        column("tbody tr")
    );
    let sorted = |sign: &str| {
        format!("{values}.every((it, k, all) => k === 0 || {sign} * (it - all[k - 1]) >= 0)")
    };
    assert_eq!(
        page.run(&format!("return {}", sorted("1"))),
        false,
        "the order of the joints is another one"
    );
    page.click("#normal");
    page.wait(&sorted("1"));
    assert_eq!(
        page.run("return document.getElementById('normal').parentNode.getAttribute('aria-sort')"),
        "ascending"
    );
    page.run("document.getElementById('normal').focus()");
    page.keys("", "\u{e007}");
    page.wait(&sorted("-1"));
    // A change of the text keeps order and focus.
    page.run(
        "const it = document.querySelector('#controls input'); it.value = 0.6; \
         it.dispatchEvent(new Event('input')); it.dispatchEvent(new Event('change'))",
    );
    page.wait(&format!("{TEXT}.includes('[joints.bed]\\nmu = 0.60')"));
    page.wait("document.querySelector('#shown[aria-busy=false]')");
    page.wait(&format!("document.querySelector('[aria-sort=descending]') && {}", sorted("-1")));
    assert_eq!(page.run("return document.activeElement.textContent.startsWith('N ')"), true);
}

#[test]
fn scenes_that_are_compared_have_one_scale() {
    let Some(page) = opened("compare", DOOR) else { return };
    let longest = "Math.max(...Array.from(document.querySelectorAll('FIGURE .drawing .pressing:not(.places) path'), it => it.getTotalLength()))";
    let of = |figure: &str| {
        page.run(&format!("return {}", longest.replace("FIGURE", figure))).as_f64().unwrap()
    };
    page.click("#keep");
    page.wait("document.querySelector('#kept svg') && !document.getElementById('scale').hidden");
    // Bricks of a fifth of the mass have a fifth of the force.
    name_number(&page, "density = ", "density");
    page.run(
        "const it = document.getElementById('scene'); it.focus(); const at = it.value.indexOf('1800.0'); \
         it.setSelectionRange(at, at + 6)",
    );
    page.keys("", "360.0");
    page.wait(&format!("{TEXT}.includes('density = 360.0\\n')"));
    page.wait(SETTLED);
    let ratio = of("#picture") / of("#kept");
    assert!((ratio - 0.2).abs() < 0.01, "{ratio}");
    let told = page.run("return document.querySelector('#picture .legend').textContent");
    assert!(told.as_str().unwrap().contains("drawn to one scale with"), "{told}");
    let scale = "document.getElementById('scale').textContent";
    assert_eq!(page.run(&format!("return {scale}")), "Forces have the same scale in all pictures.");
    page.click("[data-show=deformed]");
    page.wait(&format!("{scale}.startsWith('Displacements')"));
    page.click("#kept button:nth-of-type(2)");
    page.wait(
        "document.getElementById('scale').hidden && !document.querySelector('#kept section')",
    );
    // The wall that falls shows how it moves, the one that stands its forces.
    page.click("[data-show=answer]");
    page.click("#keep");
    page.wait("document.querySelector('#kept svg')");
    page.run("document.querySelector('#controls input').value = 0.05; document.querySelector('#controls input').dispatchEvent(new Event('input'))");
    page.wait(&format!("{SENTENCE}.startsWith('The wall falls')"));
    page.wait(&format!("{scale}.startsWith('These pictures show different things')"));
}

#[test]
fn a_narrow_page_has_its_legend_in_readable_letters() {
    let (address, _) = serve_scene("legend", DOOR);
    let Some(page) = Page::open(&address, 420) else { return };
    page.wait(SETTLED);
    page.wait("document.querySelectorAll('ul.legend li').length > 2");
    let smallest = "Math.min(...Array.from(document.querySelectorAll('ul.legend span'), it => parseFloat(getComputedStyle(it).fontSize)))";
    assert!(page.run(&format!("return {smallest}")).as_f64().unwrap() >= 13.0);
    assert_eq!(
        page.run("return getComputedStyle(document.querySelector('#picture .legend')).display"),
        "none"
    );
    // Handles are over what they move.
    let distance = "const [a, b] = ['.handle[aria-label^=\"place of\"]', '#picture svg[data-frame]'].map(it => document.querySelector(it).getBoundingClientRect()); \
         return [a.left - b.left, b.right - a.right, a.top - b.top, b.bottom - a.bottom]";
    let room: Vec<f64> = serde_json::from_value(page.run(distance)).unwrap();
    assert!(room.iter().all(|it| *it > 0.0), "{room:?}");
}

/// The page as a reader sees it, in files to be looked at.
#[test]
fn the_page_is_drawn_wide_and_narrow() {
    let place = directory("pictures");
    let (address, _) = serve_scene("seen", DOOR);
    for width in [1280, 420] {
        let Some(page) = Page::open(&address, width) else { return };
        page.wait(SETTLED);
        // Nothing is wider than the window, except what scrolls by itself.
        let overflow = page.run(
            "return document.documentElement.scrollWidth - document.documentElement.clientWidth",
        );
        page.picture(&place.join(format!("{width}.png")));
        page.darken();
        page.picture(&place.join(format!("{width}_dark.png")));
        assert_eq!(overflow, 0, "{width}");
    }
}
