//! Which file uses an item of which other file.

use std::collections::{BTreeMap, BTreeSet};

use super::source::{Import, Module, Source};

type Path = Vec<String>;

/// The crates in the folders of `src` of their names.
pub const CRATES: [&str; 6] = ["core", "files", "evaluate", "page", "gpu", "viewer"];

/// The modules of the crates of [`CRATES`] below their names, of the program's library at the root and, below `main`,
/// of its command line; paths of files are relative to `src`.
#[derive(Debug)]
pub struct Tree {
    modules: BTreeMap<Path, (String, Module)>,
}

/// `from` names an item that `to` defines.
#[derive(Clone, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub struct Arrow {
    pub from: String,
    pub to: String,
    /// It re-exports the item, and does not use it itself.
    pub passed_on: bool,
}

impl Tree {
    /// Of files, each with its path below `src` and its text.
    pub fn new<S: AsRef<str>>(files: impl IntoIterator<Item = (S, S)>) -> Self {
        let mut modules = BTreeMap::new();
        for (file, text) in files {
            let (file, text) = (file.as_ref(), text.as_ref());
            for module in Source::new(text).modules {
                let path = module_of(file).into_iter().chain(module.inside.iter().cloned()).collect();
                modules.insert(path, (file.to_owned(), module));
            }
        }
        Self { modules }
    }

    /// All arrows between different files.
    pub fn arrows(&self) -> Vec<Arrow> {
        let mut arrows = BTreeSet::new();
        for (path, (from, module)) in &self.modules {
            let mut add = |target: Option<Path>, passed_on| {
                if let Some(to) = target.and_then(|target| self.defined_in(&target))
                    && to != from
                {
                    arrows.insert(Arrow { from: from.clone(), to: to.clone(), passed_on });
                }
            };
            for import in &module.imports {
                let passed_on = import.public && !module.names.contains(&import.alias);
                add(self.imported(path, import, 0), passed_on);
            }
            for written in &module.paths {
                add(self.absolute(path, written), false);
            }
        }
        arrows.into_iter().collect()
    }

    /// The file that defines the item; `None` for a module itself, which is a name and no item.
    fn defined_in(&self, item: &[String]) -> Option<&String> {
        let (path, rest) = self.split(item)?;
        (!rest.is_empty()).then(|| &self.modules[path].0)
    }

    /// The longest module at the beginning of a path, and the rest.
    fn split<'a>(&self, item: &'a [String]) -> Option<(&'a [String], &'a [String])> {
        let longest = (0..=item.len()).rev().find(|n| self.modules.contains_key(&item[..*n]))?;
        Some(item.split_at(longest))
    }

    /// A path as written in a module, from the root; `None` for other crates and local names.
    fn absolute(&self, module: &[String], written: &[String]) -> Option<Path> {
        if let Some(path) = self.anchored(module, written) {
            return self.followed(path, 0);
        }
        let import = self.modules[module].1.imports.iter().find(|import| import.alias == written[0])?;
        let imported = self.imported(module, import, 0)?;
        self.followed([&imported, &written[1..]].concat(), 0)
    }

    fn imported(&self, module: &[String], import: &Import, steps: usize) -> Option<Path> {
        self.followed(self.anchored(module, &import.path)?, steps)
    }

    /// The path from the root where it begins with a keyword, this package or a child of the module.
    fn anchored(&self, module: &[String], written: &[String]) -> Option<Path> {
        let own = |first: &String| first == "main" || CRATES.contains(&first.as_str());
        let root = usize::from(module.first().is_some_and(own));
        let of_crate = |name: &str| CRATES.into_iter().find(|own| name.strip_prefix("svbrdf_") == Some(own));
        if let Some(name) = of_crate(&written[0]) {
            return Some([&[name.to_owned()][..], &written[1..]].concat());
        }
        let (from, rest) = match written[0].as_str() {
            "crate" => (&module[..root], &written[1..]),
            "svbrdf" if root == 1 => (&module[..0], &written[1..]),
            "self" => (module, &written[1..]),
            "super" => {
                let up = written.iter().take_while(|name| *name == "super").count();
                (&module[..module.len().checked_sub(up)?], &written[up..])
            }
            child => {
                let path = [module, &[child.to_owned()]].concat();
                self.modules.contains_key(&path).then_some((module, written))?
            }
        };
        Some([from, rest].concat())
    }

    /// The path of the definition: imports of modules on the way are followed.
    fn followed(&self, path: Path, steps: usize) -> Option<Path> {
        assert!(steps < 32, "{path:?} leads round in `use` lines");
        let (module, rest) = self.split(&path)?;
        let Some(name) = rest.first() else { return Some(path) };
        let Some(import) = self.modules[module].1.imports.iter().find(|import| import.alias == *name) else {
            return Some(path);
        };
        let imported = self.imported(module, import, steps + 1)?;
        self.followed([&imported, &rest[1..]].concat(), steps + 1)
    }
}

/// The path of the module in a file below `src`.
fn module_of(file: &str) -> Path {
    let mut names: Path = file.trim_end_matches(".rs").split('/').map(str::to_owned).collect();
    names.pop_if(|last| *last == "mod" || *last == "lib");
    if names.first().is_some_and(|first| first == "cli") {
        names.insert(0, "main".to_owned());
    }
    names
}

/// The files of each circle: each file uses each other one, directly or through others.
pub fn circles(arrows: &[Arrow]) -> Vec<Vec<String>> {
    let used = |file: &str| {
        let mut found = BTreeSet::new();
        let mut open = vec![file.to_owned()];
        while let Some(from) = open.pop() {
            for arrow in arrows.iter().filter(|arrow| arrow.from == from && !arrow.passed_on) {
                if found.insert(arrow.to.clone()) {
                    open.push(arrow.to.clone());
                }
            }
        }
        found
    };
    let files: BTreeSet<&String> = arrows.iter().map(|arrow| &arrow.from).collect();
    let used: BTreeMap<&String, BTreeSet<String>> =
        files.into_iter().map(|file| (file, used(file))).collect();
    let mut circles: Vec<Vec<String>> = Vec::new();
    for (file, below) in &used {
        if circles.iter().any(|circle| circle.contains(file)) || !below.contains(*file) {
            continue;
        }
        let back = |other: &&String| used.get(*other).is_some_and(|used| used.contains(*file));
        circles.push(below.iter().filter(back).cloned().collect());
    }
    circles
}
