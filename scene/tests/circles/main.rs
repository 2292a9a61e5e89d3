//! Files that need each other in a circle cannot be understood one after the other. What files import is read from
//! their lines; a name that a parent only passes on counts as a name of the file that defines it.

use std::collections::{BTreeMap, BTreeSet};
use std::path::Path;

/// A module's path from the root of its crate, such as `["file", "find"]`.
type Module = Vec<String>;

/// The modules that each module imports.
type Imports = BTreeMap<Module, BTreeSet<Module>>;

/// The text of every module of a crate, without tests and comments.
fn modules(folder: &Path, at: &[String], all: &mut BTreeMap<Module, String>) {
    for entry in std::fs::read_dir(folder).unwrap() {
        let path = entry.unwrap().path();
        let mut module = at.to_vec();
        match path.file_stem().unwrap().to_str().unwrap() {
            "tests" | "main" => continue,
            "lib" | "mod" => {}
            name => module.push(name.into()),
        }
        if path.is_dir() {
            modules(&path, &module, all);
        } else if path.extension().is_some_and(|end| end == "rs") {
            let text = std::fs::read_to_string(&path).unwrap();
            let text = text.split("#[cfg(test)]\nmod tests {").next().unwrap();
            let lines = text.lines().map(|line| line.split("//").next().unwrap().trim());
            let text: String = lines.flat_map(|line| ["\n", line]).collect();
            let text = text.replace("pub(crate) use", "pub use").replace("pub(super) use", "pub use");
            // A visibility imports nothing.
            all.insert(module, text.replace("pub(in crate::", "pub(in "));
        }
    }
}

/// The names that the tree of a `use` has: `a::{b, c::d}` has `a::b` and `a::c::d`.
fn leaves(tree: &str) -> Vec<String> {
    let Some((head, rest)) = tree.split_once('{') else { return vec![tree.trim().into()] };
    let mut depth = 0;
    let between = |c: char| {
        depth += i32::from(c == '{') - i32::from(c == '}');
        c == ',' && depth == 0
    };
    let inner = rest.rsplit_once('}').unwrap().0;
    let each = inner.split(between).filter(|part| !part.trim().is_empty()).flat_map(leaves);
    each.map(|leaf| format!("{}{leaf}", head.trim())).collect()
}

/// A path from the root of the crate; none for a path into another crate.
fn absolute(path: &str, module: &[String], is_module: impl Fn(&[String]) -> bool) -> Option<Module> {
    let steps: Module = path.split("::").map(Into::into).collect();
    let up = steps.iter().take_while(|step| *step == "super").count();
    match steps[0].as_str() {
        "crate" => Some(steps[1..].to_vec()),
        "self" => Some([module, &steps[1..]].concat()),
        "super" => Some([&module[..module.len() - up], &steps[up..]].concat()),
        _ => is_module(&[module, &steps[..1]].concat()).then(|| [module, &steps].concat()),
    }
}

/// What each module of a crate imports.
fn imports(source: &Path) -> Imports {
    let mut texts = BTreeMap::new();
    modules(source, &[], &mut texts);
    let (mut imported, mut passed_on) = (Vec::new(), BTreeMap::new());
    for (module, text) in &texts {
        let absolute = |path: &str| absolute(path, module, |child| texts.contains_key(child));
        let mut paths = Vec::new();
        for statement in text.split(';') {
            let start = statement.rfind("\nuse ").max(statement.rfind("\npub use "));
            let (code, import) = statement.split_at(start.unwrap_or(statement.len()));
            for path in code.split(|c: char| !(c.is_alphanumeric() || c == '_' || c == ':')) {
                if path.starts_with("crate::") || path.starts_with("super::") {
                    paths.extend(absolute(path));
                }
            }
            let Some((visibility, tree)) = import.split_once("use ") else { continue };
            for leaf in leaves(tree) {
                let (path, alias) = leaf.split_once(" as ").map_or((&*leaf, None), |(path, alias)| (path, Some(alias)));
                let Some(path) = absolute(path) else { continue };
                if visibility.trim().is_empty() {
                    paths.push(path);
                } else if let Some(name) = alias.or(path.last().map(String::as_str)) {
                    passed_on.insert([&module[..], &[name.to_owned()]].concat(), path);
                }
            }
        }
        imported.push((module.clone(), paths));
    }
    let defining = |path: &Module| {
        let mut path = path.clone();
        loop {
            // The file that the path leads to, and what that file only passes on.
            let n = (0..=path.len()).rev().find(|&n| texts.contains_key(&path[..n])).unwrap_or(0);
            match path.get(..=n).and_then(|name| passed_on.get(name)) {
                Some(other) => path = [other, &path[n + 1..]].concat(),
                None => return path[..n].to_vec(),
            }
        }
    };
    imported.into_iter().map(|(module, paths)| (module, paths.iter().map(defining).collect())).collect()
}

/// The largest set of modules that all need each other, if any two do.
fn largest_circle(imports: &Imports) -> BTreeSet<&Module> {
    let reached = |from| {
        let (mut reached, mut open) = (BTreeSet::new(), vec![from]);
        while let Some(module) = open.pop() {
            open.extend(imports.get(module).into_iter().flatten().filter(|next| reached.insert(*next)));
        }
        reached
    };
    let all: BTreeMap<&Module, BTreeSet<&Module>> = imports.keys().map(|module| (module, reached(module))).collect();
    let circle = |module: &Module| {
        let mutual = |other: &&Module| *other != module && all[other].contains(module);
        all[module].iter().copied().filter(mutual).collect::<BTreeSet<_>>()
    };
    let circles = all.keys().map(|module| circle(module).into_iter().chain([*module]).collect::<BTreeSet<_>>());
    circles.max_by_key(BTreeSet::len).filter(|circle| circle.len() > 1).unwrap_or_default()
}

/// The same imports from room to room: a room is a module at the root.
fn of_rooms(imports: &Imports) -> Imports {
    let room = |module: &Module| module[..module.len().min(1)].to_vec();
    let mut rooms = Imports::new();
    for (module, others) in imports {
        let others = others.iter().map(room).filter(|other| *other != room(module));
        rooms.entry(room(module)).or_default().extend(others);
    }
    rooms
}

#[test]
fn no_circle_is_larger_than_it_must_be() {
    for (crate_folder, files, rooms) in
        [("scene", 2, 0), ("reference", 4, 0), ("output", 3, 0), ("gpu", 0, 0), ("", 3, 0)]
    {
        let imports = imports(&Path::new(env!("CARGO_MANIFEST_DIR")).join("..").join(crate_folder).join("src"));
        assert!(imports.values().flatten().count() > 50, "the lines of {crate_folder} are read");
        let circle = largest_circle(&imports);
        assert!(circle.len() <= files, "{} files of {crate_folder}/src import each other: {circle:?}", circle.len());
        let of_rooms = of_rooms(&imports);
        let circle = largest_circle(&of_rooms);
        assert!(circle.len() <= rooms, "{} rooms of {crate_folder}/src import each other: {circle:?}", circle.len());
    }
}
