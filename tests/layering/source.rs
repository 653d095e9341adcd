//! The `use` lines and paths of Rust sources, by `syn`.

use std::collections::BTreeSet;

use syn::buffer::{Cursor, TokenBuffer};
use syn::visit::{self, Visit};
use syn::{Attribute, Ident, ImplItemFn, Item, ItemImpl, ItemMod, ItemUse, Type, UseTree, Visibility};

/// `use path as alias`; the alias of a glob is `*`.
#[derive(Clone, Debug)]
pub struct Import {
    pub path: Vec<String>,
    pub alias: String,
    pub public: bool,
}

/// A module of a file: the file itself, or a `mod name { ... }` in it.
#[derive(Debug, Default)]
pub struct Module {
    /// The names of the inline modules that lead to it.
    pub inside: Vec<String>,
    pub imports: Vec<Import>,
    /// Paths of two or more segments outside of `use` lines.
    pub paths: Vec<Vec<String>>,
    /// All identifiers outside of `use` lines.
    pub names: BTreeSet<String>,
}

/// A file without what is `#[cfg(test)]`.
#[derive(Debug, Default)]
pub struct Source {
    /// The file itself and the inline modules in it.
    pub modules: Vec<Module>,
    /// The names of the types that it gives inherent methods.
    pub inherent_types: BTreeSet<String>,
    /// The module that is visited.
    module: Module,
}

impl Source {
    pub fn new(text: &str) -> Self {
        let mut source = Self::default();
        source.visit_file(&syn::parse_file(text).unwrap());
        source.modules.push(std::mem::take(&mut source.module));
        source
    }

    fn add_path(&mut self, path: Vec<String>) {
        self.module.names.extend(path.iter().cloned());
        if path.len() > 1 {
            self.module.paths.push(path);
        }
    }

    fn add_imports(&mut self, tree: &UseTree, mut path: Vec<String>, public: bool) {
        let alias = match tree {
            UseTree::Path(part) => {
                path.push(part.ident.to_string());
                return self.add_imports(&part.tree, path, public);
            }
            UseTree::Group(group) => {
                return group.items.iter().for_each(|part| self.add_imports(part, path.clone(), public));
            }
            UseTree::Name(name) => [&name.ident, &name.ident].map(Ident::to_string),
            UseTree::Rename(name) => [&name.ident, &name.rename].map(Ident::to_string),
            UseTree::Glob(_) => ["*", "*"].map(str::to_owned),
        };
        let [name, mut alias] = alias;
        match path.last() {
            // `use a::{self}` names `a`.
            Some(last) if name == "self" && alias == name => alias.clone_from(last),
            Some(_) if name == "self" => {}
            _ => path.push(name),
        }
        self.module.imports.push(Import { path, alias, public });
    }

    /// The paths among tokens that `syn` does not parse: those of macros and attributes.
    fn add_tokens(&mut self, mut at: Cursor<'_>) {
        while let Some((_, next)) = at.token_tree() {
            if let Some((inside, ..)) = at.any_group() {
                self.add_tokens(inside);
            }
            let Some((name, mut after)) = at.ident() else {
                at = next;
                continue;
            };
            let mut path = vec![name.to_string()];
            while let Some((name, rest)) = after_colons(after).and_then(Cursor::ident) {
                path.push(name.to_string());
                after = rest;
            }
            self.add_path(path);
            at = after;
        }
    }
}

fn after_colons(at: Cursor<'_>) -> Option<Cursor<'_>> {
    let (first, rest) = at.punct()?;
    let (second, rest) = rest.punct()?;
    ([first, second].iter().all(|sign| sign.as_char() == ':')).then_some(rest)
}

/// Whether an item is for the tests of its file.
fn is_test(attributes: &[Attribute]) -> bool {
    let is_test = |attribute: &Attribute| attribute.parse_args::<Ident>().is_ok_and(|name| name == "test");
    attributes.iter().any(|attribute| attribute.path().is_ident("cfg") && is_test(attribute))
}

impl Visit<'_> for Source {
    fn visit_item(&mut self, item: &Item) {
        let attributes = match item {
            Item::Fn(item) => &item.attrs[..],
            Item::Impl(item) => &item.attrs,
            Item::Mod(item) => &item.attrs,
            Item::Use(item) => &item.attrs,
            _ => &[],
        };
        if !is_test(attributes) {
            visit::visit_item(self, item);
        }
    }

    fn visit_impl_item_fn(&mut self, item: &ImplItemFn) {
        if !is_test(&item.attrs) {
            visit::visit_impl_item_fn(self, item);
        }
    }

    fn visit_item_mod(&mut self, item: &ItemMod) {
        if item.content.is_none() {
            return;
        }
        let inside = [self.module.inside.as_slice(), &[item.ident.to_string()]].concat();
        let outer = std::mem::replace(&mut self.module, Module { inside, ..Module::default() });
        visit::visit_item_mod(self, item);
        self.modules.push(std::mem::replace(&mut self.module, outer));
    }

    fn visit_item_use(&mut self, item: &ItemUse) {
        let public = !matches!(item.vis, Visibility::Inherited);
        self.add_imports(&item.tree, Vec::new(), public);
    }

    fn visit_item_impl(&mut self, item: &ItemImpl) {
        if let (None, Type::Path(of)) = (&item.trait_, &*item.self_ty) {
            self.inherent_types.extend(of.path.segments.last().map(|last| last.ident.to_string()));
        }
        visit::visit_item_impl(self, item);
    }

    fn visit_path(&mut self, path: &syn::Path) {
        self.add_path(path.segments.iter().map(|segment| segment.ident.to_string()).collect());
        visit::visit_path(self, path);
    }

    fn visit_macro(&mut self, of: &syn::Macro) {
        self.visit_path(&of.path);
        self.add_tokens(TokenBuffer::new2(of.tokens.clone()).begin());
    }

    fn visit_meta_list(&mut self, list: &syn::MetaList) {
        self.add_tokens(TokenBuffer::new2(list.tokens.clone()).begin());
    }

    fn visit_ident(&mut self, name: &Ident) {
        self.module.names.insert(name.to_string());
    }
}
