//! The files of a crate import one another in one direction: no two of them, and no two of its top modules, import
//! each other, be it around others. So every file can be read with those that it builds on, and without those that
//! build on it.
//!
//! In `masonry` the top modules lie in layers, and import only from layers below them.
//!
//! What counts is where a name is defined: a file that passes it on by `pub use` imports nothing.

use std::collections::{BTreeMap, BTreeSet};
use std::fs;
use std::path::Path;

/// A module by its path, or a name in one; the root of the crate is empty.
type Names = Vec<String>;
type Sources = BTreeMap<Names, String>;
type Graph = BTreeMap<Names, BTreeSet<Names>>;

#[test]
fn the_files_of_lcp_import_one_another_in_one_direction() {
    assert_no_circles("lcp/src", &[usize::MAX, 1]);
    assert_no_circles("lcp/linalg/src", &[usize::MAX, 1]);
    assert_no_circles("lcp/problems/src", &[usize::MAX, 1]);
    assert_no_circles("masonry/drawing/src", &[usize::MAX, 1]);
    assert_no_circles("masonry/import/src", &[usize::MAX, 1]);
    assert_no_circles("masonry/report/src", &[usize::MAX, 1]);
    assert_no_circles("masonry/cli/src", &[usize::MAX, 1]);
    assert_no_circles("masonry/live/src", &[usize::MAX, 1]);
    assert_no_circles("masonry/python/src", &[usize::MAX, 1]);
}

#[test]
fn the_files_of_masonry_import_one_another_in_one_direction() {
    let files = assert_no_circles("masonry/src", &[2, 1]);
    // A file may be one with the parts that it is divided into; these parts go in one direction.
    let circles = listed(&without_imports_upwards(&files), usize::MAX);
    assert!(circles.is_empty(), "circles of imports:\n{}", circles.join("\n"));
}

/// The top modules of `masonry` from the ground up; those of one layer know nothing of each other.
const LAYERS: [&[&str]; 14] = [
    &["ids", "units"],
    &["columns", "data", "element", "files", "geometry", "law", "material", "rounding"],
    &["scene"],
    &["model"],
    &["system"],
    &["forms"],
    &["recover"],
    &["method"],
    &["paper"],
    &["history"],
    &["verify"],
    &["plan"],
    &["analysis"],
    &["lib"],
];

#[test]
fn the_modules_of_masonry_import_from_layers_below_them_only() {
    let files = imports(&sources_in("masonry/src"));
    let level = |names: &Names| {
        let name = names.first().map_or("lib", String::as_str);
        let at = LAYERS.iter().position(|layer| layer.contains(&name));
        at.unwrap_or_else(|| panic!("{name} is in no layer"))
    };
    let upwards: Vec<String> = files
        .iter()
        .flat_map(|(from, targets)| targets.iter().map(move |to| (from, to)))
        .filter(|(from, to)| from.first() != to.first() && level(from) <= level(to))
        .map(|(from, to)| format!("{} -> {}", from.join("/"), to.join("/")))
        .collect();
    assert!(upwards.is_empty(), "imports that do not lead down:\n{}", upwards.join("\n"));
}

/// The graph without what files import from those that they are parts of.
fn without_imports_upwards(files: &Graph) -> Graph {
    let mut graph = files.clone();
    for (from, targets) in &mut graph {
        targets.retain(|to| !from.starts_with(to));
    }
    graph
}

/// No circles of what lies in one module of each depth; of the largest, of files. The imports of all files.
fn assert_no_circles(directory: &str, depths: &[usize]) -> Graph {
    let files = imports(&sources_in(directory));
    assert!(files.values().any(|targets| !targets.is_empty()), "no imports in {directory}");
    let found: Vec<String> = depths.iter().flat_map(|depth| listed(&files, *depth)).collect();
    assert!(found.is_empty(), "{directory} has circles of imports:\n{}", found.join("\n"));
    files
}

fn sources_in(directory: &str) -> Sources {
    let mut sources = Sources::new();
    read(&Path::new(env!("CARGO_MANIFEST_DIR")).join(directory), &[], &mut sources);
    assert!(sources.len() > 1, "no sources in {directory}");
    sources
}

/// Reads all modules; programs beside the library are none.
fn read(directory: &Path, parent: &[String], sources: &mut Sources) {
    for entry in fs::read_dir(directory).unwrap() {
        let path = entry.unwrap().path();
        let name = path.file_stem().unwrap().to_str().unwrap().to_owned();
        let module = if name == "lib" { Names::new() } else { [parent, &[name]].concat() };
        if path.is_dir() && !path.ends_with("bin") {
            read(&path, &module, sources);
        } else if path.extension().is_some_and(|ending| ending == "rs") {
            sources.insert(module, fs::read_to_string(path).unwrap());
        }
    }
}

/// The formatted text without comments and without what is for tests.
fn code(text: &str) -> String {
    let mut lines = text.lines().map(|line| line.split("//").next().unwrap_or(line));
    let mut code = String::new();
    while let Some(line) = lines.next() {
        if line == "#[cfg(test)]" {
            // One line, or the lines to the brace that ends it.
            if lines.next().is_some_and(|line| line.ends_with('{')) {
                lines.find(|line| line.starts_with('}'));
            }
        } else {
            code = code + line + "\n";
        }
    }
    // A path in a visibility imports nothing.
    code.replace("pub(in crate", "pub(")
}

/// The paths of a tree of imports, each with the name that it gets.
fn expanded(tree: &str) -> Vec<(String, String)> {
    let Some((before, inside)) = tree.split_once('{') else {
        let (path, alias) = tree.split_once(" as ").unwrap_or((tree, ""));
        let path = path.trim().trim_end_matches("::self");
        let name = if alias.is_empty() { path.rsplit("::").next().unwrap() } else { alias.trim() };
        return vec![(path.to_owned(), name.to_owned())];
    };
    let (inside, _) = inside.rsplit_once('}').unwrap();
    let mut depth = 0;
    let parts = inside.split(|c: char| {
        depth += i32::from(c == '{') - i32::from(c == '}');
        c == ',' && depth == 0
    });
    let parts = parts.map(str::trim).filter(|part| !part.is_empty());
    parts.flat_map(|part| expanded(&format!("{}{part}", before.trim()))).collect()
}

/// A path from the root of the crate, of a path in a module; `None` for other crates, types and so on.
fn absolute(module: &Names, path: &str, sources: &Sources) -> Option<Names> {
    let mut names: Vec<&str> = path.split("::").collect();
    let mut base = module.clone();
    match names[0] {
        "crate" => base.clear(),
        "super" | "self" => {}
        name if sources.contains_key(&[&module[..], &[name.to_owned()]].concat()) => {}
        _ => return None,
    }
    while let Some(&name @ ("crate" | "super" | "self")) = names.first() {
        if name == "super" {
            base.pop();
        }
        names.remove(0);
    }
    Some(base.into_iter().chain(names.into_iter().map(str::to_owned)).collect())
}

/// For every file those that it imports from, by `use` and by paths in the code.
fn imports(sources: &Sources) -> Graph {
    let mut imported: Vec<(&Names, Names)> = Vec::new();
    let mut passed_on: BTreeMap<Names, Names> = BTreeMap::new();
    for (module, text) in sources {
        for statement in code(text).split(';') {
            let is_tree =
                |it: &str| it.chars().all(|c| c.is_alphanumeric() || "_:{},* \n".contains(c));
            let (before, tree) = match statement.rsplit_once("use ") {
                Some((before, tree)) if is_tree(tree) => (before, expanded(tree)),
                _ => (statement, Vec::new()),
            };
            let is_public =
                before.lines().last().is_some_and(|line| line.trim().starts_with("pub"));
            for (path, name) in tree {
                match absolute(module, &path, sources) {
                    Some(path) if is_public => {
                        passed_on.insert([&module[..], &[name]].concat(), path);
                    }
                    Some(path) => imported.push((module, path)),
                    None => {}
                }
            }
            let words = before.split(|c: char| !(c.is_alphanumeric() || c == '_' || c == ':'));
            let paths = words.filter(|word| word.contains("::"));
            let paths = paths.filter_map(|word| absolute(module, word, sources));
            imported.extend(paths.map(|path| (module, path)));
        }
    }
    let mut files: Graph = sources.keys().map(|module| (module.clone(), BTreeSet::new())).collect();
    for (module, path) in imported {
        let target = defining(path, sources, &passed_on);
        if target != *module {
            files.entry(module.clone()).or_default().insert(target);
        }
    }
    files
}

/// The module that defines what a path names, through those that pass it on.
fn defining(mut path: Names, sources: &Sources, passed_on: &BTreeMap<Names, Names>) -> Names {
    loop {
        let known = (0..=path.len()).rev().find(|&k| sources.contains_key(&path[..k])).unwrap_or(0);
        match path.get(..=known).and_then(|name| passed_on.get(name)) {
            Some(target) => path = [&target[..], &path[known + 1..]].concat(),
            None => return path[..known].to_vec(),
        }
    }
}

/// The imports within every circle of files, or, of a smaller depth, of what lies in one module of that depth.
fn listed(files: &Graph, depth: usize) -> Vec<String> {
    let cut = |names: &Names| names[..names.len().min(depth)].to_vec();
    let mut graph = Graph::new();
    for (from, targets) in files {
        let others = targets.iter().map(cut).filter(|to| *to != cut(from));
        graph.entry(cut(from)).or_default().extend(others);
    }
    let shown = |names: &Names| if names.is_empty() { "lib".into() } else { names.join("/") };
    let within = |circle: &BTreeSet<Names>| {
        let pairs = circle.iter().flat_map(|from| graph[from].iter().map(move |to| (from, to)));
        let pairs = pairs.filter(|(_, to)| circle.contains(*to));
        pairs.map(|(from, to)| format!("{} -> {}", shown(from), shown(to))).collect::<Vec<_>>()
    };
    circles(&graph).iter().flat_map(within).collect()
}

/// The strongly connected components of more than one node.
fn circles(graph: &Graph) -> BTreeSet<BTreeSet<Names>> {
    let reached = |from: &Names| {
        let mut reached: BTreeSet<&Names> = BTreeSet::new();
        let mut open: Vec<&Names> = graph[from].iter().collect();
        while let Some(node) = open.pop() {
            if reached.insert(node) {
                open.extend(&graph[node]);
            }
        }
        reached
    };
    let reach: BTreeMap<&Names, BTreeSet<&Names>> =
        graph.keys().map(|node| (node, reached(node))).collect();
    let around = |node: &&Names| {
        let others = reach[*node].iter().filter(|other| reach[**other].contains(*node));
        others.map(|other| (*other).clone()).collect::<BTreeSet<_>>()
    };
    reach.keys().map(around).filter(|circle| !circle.is_empty()).collect()
}

fn sources(of: &[(&str, &str)]) -> Sources {
    let names =
        |path: &str| path.split('/').filter(|it| !it.is_empty()).map(str::to_owned).collect();
    of.iter().map(|(path, text)| (names(path), (*text).to_owned())).collect()
}

#[test]
fn imports_and_their_circles_are_found() {
    let files = imports(&sources(&[
        ("", "mod a;\npub use a::Top;\n"),
        (
            "a",
            "pub(crate) use x::{Inner as Known, Other};\nuse crate::b::{self, deep::{C, D as E}};\n\
             use std::fmt;\nfn f() -> fmt::Result { x::g() }\n",
        ),
        (
            "a/x",
            "// use crate::b::B;\nuse super::super::Top;\nfn g() { crate::a::Known::new() }\n\
             #[cfg(test)]\nmod tests {\n    use crate::b::B;\n}\n",
        ),
        ("b", "pub(in crate::c) struct B;\nuse crate::a::Known;\n"),
        ("b/deep", ""),
        ("c", "#[cfg(test)]\nmod tests;\nfn f(_: &super::b::B) {}\n"),
    ]));
    let found = files.iter().flat_map(|(from, all)| all.iter().map(move |to| (from, to)));
    let found: Vec<String> =
        found.map(|(from, to)| format!("{} {}", from.join("/"), to.join("/"))).collect();
    assert_eq!(found, ["a a/x", "a b", "a b/deep", "a/x a", "b a/x", "c b"]);
    assert_eq!(listed(&files, usize::MAX), ["a -> a/x", "a -> b", "a/x -> a", "b -> a/x"]);
    assert_eq!(listed(&files, 1), ["a -> b", "b -> a"]);
    let down = without_imports_upwards(&files);
    assert_eq!(listed(&down, usize::MAX), [""; 0]);
    let siblings = [("a/x", "use super::y::f;\n"), ("a/y", "use super::x::g;\n"), ("a", "")];
    let siblings = without_imports_upwards(&imports(&sources(&siblings)));
    assert_eq!(listed(&siblings, usize::MAX), ["a/x -> a/y", "a/y -> a/x"]);
    let straight = [("a", "use crate::{b::g, c::h};\n"), ("b", "use crate::c::h;\n"), ("c", "")];
    assert!(circles(&imports(&sources(&straight))).is_empty());
}
