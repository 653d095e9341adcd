//! Which file uses an item of which other file: by their `use` lines and paths.

use std::collections::{BTreeMap, BTreeSet};

use quote::ToTokens as _;
use syn::{Item, Type, UseTree, Visibility};

type Path = Vec<String>;

/// The crates in the folders of `src` of their names.
pub const CRATES: [&str; 6] = ["core", "files", "evaluate", "page", "gpu", "viewer"];

/// `use path as alias`; the alias of a glob is `*`.
#[derive(Debug)]
struct Import {
    path: Path,
    alias: String,
    public: bool,
}

/// A file without what is `#[cfg(test)]`.
#[derive(Debug, Default)]
pub struct Source {
    imports: Vec<Import>,
    /// The paths outside of `use` lines, those of one name, too.
    paths: BTreeSet<Path>,
    /// The names of the types that it gives inherent methods.
    pub inherent_types: BTreeSet<String>,
}

/// `from` names an item that `to` defines.
#[derive(Clone, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub struct Arrow {
    pub from: String,
    pub to: String,
    /// It re-exports the item, and does not use it itself.
    pub passed_on: bool,
}

impl Source {
    pub fn new(text: &str) -> Self {
        let mut source = Self::default();
        for item in syn::parse_file(text).unwrap().items {
            let tokens = item.to_token_stream().to_string();
            let head = tokens.split('{').next().unwrap_or_default();
            if head.contains("# [cfg (test)]") {
                continue;
            }
            match &item {
                Item::Use(line) => {
                    let public = !matches!(line.vis, Visibility::Inherited);
                    source.add_imports(&line.tree, Vec::new(), public);
                    continue;
                }
                Item::Impl(of) if of.trait_.is_none() => {
                    let Type::Path(of) = &*of.self_ty else { continue };
                    source.inherent_types.extend(of.path.segments.last().map(|last| last.ident.to_string()));
                }
                _ => {}
            }
            // Without strings, such as doc comments.
            let text = tokens.replace(" :: ", "::").replace("\\\"", "").replace("'\"'", "");
            let words = text.split('"').step_by(2);
            let words =
                words.flat_map(|code| code.split(|c: char| !c.is_alphanumeric() && c != '_' && c != ':'));
            let words = words.filter(|word| word.starts_with(|c: char| c.is_alphabetic()));
            source.paths.extend(words.map(|word| word.split("::").map(str::to_owned).collect::<Path>()));
        }
        source
    }

    fn add_imports(&mut self, tree: &UseTree, mut path: Path, public: bool) {
        let (name, alias) = match tree {
            UseTree::Path(part) => {
                path.push(part.ident.to_string());
                return self.add_imports(&part.tree, path, public);
            }
            UseTree::Group(group) => {
                return group.items.iter().for_each(|part| self.add_imports(part, path.clone(), public));
            }
            UseTree::Name(name) => (name.ident.to_string(), name.ident.to_string()),
            UseTree::Rename(name) => (name.ident.to_string(), name.rename.to_string()),
            UseTree::Glob(_) => ("*".to_owned(), "*".to_owned()),
        };
        // `use a::{self}` names `a`.
        let is_own = name == "self" && !path.is_empty();
        let alias = if is_own && alias == "self" { path[path.len() - 1].clone() } else { alias };
        path.extend((!is_own).then_some(name));
        self.imports.push(Import { path, alias, public });
    }
}

/// The modules of the crates of [`CRATES`] below their names, of the program's library at the root and, below `main`,
/// of its command line, each with its file.
struct Tree<'a>(BTreeMap<Path, (&'a str, &'a Source)>);

/// All arrows between different files, each with its path below `src`.
pub fn arrows(files: &[(String, Source)]) -> Vec<Arrow> {
    let tree = Tree(files.iter().map(|(file, source)| (module_of(file), (file.as_str(), source))).collect());
    let mut arrows = BTreeSet::new();
    for (module, (from, source)) in &tree.0 {
        let imports = source.imports.iter().map(|one| (tree.anchored(module, &one.path), one.public));
        let paths = source.paths.iter().map(|path| (tree.absolute(module, path), false));
        for (path, passed_on) in imports.chain(paths) {
            let item = path.and_then(|path| tree.followed(path, 0));
            // A module itself is a name and no item.
            let (to, rest) = item.as_ref().and_then(|item| tree.split(item)).unwrap_or((module, &[]));
            let to = tree.0[to].0;
            if !rest.is_empty() && to != *from {
                arrows.insert(Arrow { from: (*from).to_owned(), to: to.to_owned(), passed_on });
            }
        }
    }
    arrows.into_iter().collect()
}

impl Tree<'_> {
    /// The longest module at the beginning of a path, and the rest.
    fn split<'a>(&self, item: &'a [String]) -> Option<(&'a [String], &'a [String])> {
        let longest = (0..=item.len()).rev().find(|n| self.0.contains_key(&item[..*n]))?;
        Some(item.split_at(longest))
    }

    fn import(&self, module: &[String], alias: &String) -> Option<&Import> {
        self.0[module].1.imports.iter().find(|import| import.alias == *alias)
    }

    /// A path as written in a module, from the root; `None` for other crates and local names.
    fn absolute(&self, module: &[String], written: &[String]) -> Option<Path> {
        self.anchored(module, written).or_else(|| {
            let import = self.import(module, &written[0])?;
            Some([&self.anchored(module, &import.path)?, &written[1..]].concat())
        })
    }

    /// The path from the root where it begins with a keyword, this package or a child of the module.
    fn anchored(&self, module: &[String], written: &[String]) -> Option<Path> {
        let is_own = |first: &String| first == "main" || CRATES.contains(&first.as_str());
        let root = usize::from(module.first().is_some_and(is_own));
        let up = written.iter().take_while(|name| *name == "super").count();
        let of_crate =
            written[0].strip_prefix("svbrdf_").filter(|name| CRATES.contains(name)).map(str::to_owned);
        Some(match (written[0].as_str(), of_crate) {
            (_, Some(name)) => [&[name], &written[1..]].concat(),
            ("crate", _) => [&module[..root], &written[1..]].concat(),
            ("svbrdf", _) if root == 1 => written[1..].to_vec(),
            ("self", _) => [module, &written[1..]].concat(),
            ("super", _) => [&module[..module.len().checked_sub(up)?], &written[up..]].concat(),
            _ => {
                Some([module, written].concat()).filter(|path| self.0.contains_key(&path[..=module.len()]))?
            }
        })
    }

    /// The path of the definition: imports of modules on the way are followed.
    fn followed(&self, path: Path, steps: usize) -> Option<Path> {
        assert!(steps < 32, "{path:?} leads round in `use` lines");
        let (module, rest) = self.split(&path)?;
        let Some(import) = rest.first().and_then(|name| self.import(module, name)) else { return Some(path) };
        let imported = self.followed(self.anchored(module, &import.path)?, steps + 1)?;
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

/// The arrows within each circle: each of its files uses each other one, directly or through others.
pub fn circles(arrows: &[Arrow]) -> Vec<Vec<Arrow>> {
    let mut within: Vec<Arrow> = arrows.iter().filter(|arrow| !arrow.passed_on).cloned().collect();
    // What is used by nobody, or uses nobody, is in no circle.
    loop {
        let ends = |end: fn(&Arrow) -> &String| within.iter().map(end).cloned().collect::<BTreeSet<_>>();
        let (users, used) = (ends(|arrow| &arrow.from), ends(|arrow| &arrow.to));
        let count = within.len();
        within.retain(|arrow| used.contains(&arrow.from) && users.contains(&arrow.to));
        if within.len() == count {
            break;
        }
    }
    if within.is_empty() { Vec::new() } else { vec![within] }
}
