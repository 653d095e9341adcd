//! Parser of Rust sources: enough of the grammar for `use` lines and paths.

use std::collections::BTreeSet;

/// `use path as alias`; the alias of a glob is `*`.
#[derive(Clone, Debug, PartialEq, Eq)]
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

/// The modules of a file without what is `#[cfg(test)]`.
pub fn modules(text: &str) -> Vec<Module> {
    let tokens = tokens(text);
    let mut done = Vec::new();
    // Each open module with the depth of braces at which it ends.
    let mut open = vec![(Module::default(), 0)];
    let (mut at, mut depth) = (0, 0);
    while at < tokens.len() {
        let rest: Vec<&str> = tokens[at..].iter().take(7).map(String::as_str).collect();
        let module = &mut open.last_mut().expect("the file's own module ends last").0;
        match rest[..] {
            ["#", "[", "cfg", "(", "test", ")", "]"] => at = after_item(&tokens, at + 7),
            ["mod", name, "{", ..] => {
                let inside = [module.inside.as_slice(), &[name.to_owned()]].concat();
                open.push((Module { inside, ..Module::default() }, depth));
                depth += 1;
                at += 3;
            }
            ["use", next, ..] if next != "<" => {
                let end = at + tokens[at..].iter().position(|token| token == ";").expect("a `use` ends");
                let public = is_public(&tokens[..at]);
                imports(&tokens[at + 1..end], &[], public, &mut module.imports);
                at = end;
            }
            ["{", ..] => (depth, at) = (depth + 1, at + 1),
            ["}", ..] => {
                (depth, at) = (depth - 1, at + 1);
                if open.last().is_some_and(|(_, end)| open.len() > 1 && *end == depth) {
                    done.extend(open.pop().map(|(module, _)| module));
                }
            }
            [name, ..] if is_name(name) => {
                let path = path(&tokens[at..]);
                at += 2 * path.len() - 1;
                module.names.extend(path.iter().cloned());
                if path.len() > 1 {
                    module.paths.push(path);
                }
            }
            _ => at += 1,
        }
    }
    done.extend(open.into_iter().map(|(module, _)| module));
    done
}

/// The names of the types that a file gives inherent methods, except in its tests.
pub fn inherent_types(text: &str) -> BTreeSet<String> {
    let tokens = tokens(text);
    let mut types = BTreeSet::new();
    let mut at = 0;
    while at < tokens.len() {
        let rest: Vec<&str> = tokens[at..].iter().take(7).map(String::as_str).collect();
        let begins = at == 0 || ["}", ";", "]"].contains(&tokens[at - 1].as_str());
        match rest[..] {
            ["#", "[", "cfg", "(", "test", ")", "]"] => at = after_item(&tokens, at + 7),
            ["impl", ..] if begins => {
                let open =
                    tokens[at..].iter().position(|token| token == "{").map_or(tokens.len(), |n| at + n);
                types.extend(inherent_type(&tokens[at + 1..open]));
                at = open;
            }
            _ => at += 1,
        }
    }
    types
}

/// The type of an `impl` without a trait, from what stands between `impl` and its brace.
fn inherent_type(head: &[String]) -> Option<String> {
    let mut depth = 0;
    let mut name = None;
    for (i, token) in head.iter().enumerate() {
        match token.as_str() {
            "<" => depth += 1,
            // Not the arrow of a function.
            ">" if head[i - 1] != "-" => depth -= 1,
            "for" if depth == 0 => return None,
            "where" if depth == 0 => break,
            word if depth == 0 && is_name(word) => name = Some(token.clone()),
            _ => {}
        }
    }
    name
}

/// Where the item that begins at `at` ends.
fn after_item(tokens: &[String], at: usize) -> usize {
    let mut depth = 0;
    for (i, token) in tokens.iter().enumerate().skip(at) {
        match token.as_str() {
            ";" if depth == 0 => return i + 1,
            "{" => depth += 1,
            "}" if depth == 1 => return i + 1,
            "}" => depth -= 1,
            _ => {}
        }
    }
    tokens.len()
}

/// Whether a `pub` or `pub(...)` ends the tokens.
fn is_public(before: &[String]) -> bool {
    match before {
        [.., last] if last == "pub" => true,
        [.., last] if last == ")" => {
            let open = before.iter().rposition(|token| token == "(");
            open.is_some_and(|open| open > 0 && before[open - 1] == "pub")
        }
        _ => false,
    }
}

/// The imports of one tree of a `use` line.
fn imports(tree: &[String], prefix: &[String], public: bool, found: &mut Vec<Import>) {
    let Some(brace) = tree.iter().position(|token| token == "{") else {
        let (path, alias) = match tree {
            [path @ .., keyword, alias] if keyword == "as" => (path, Some(alias)),
            _ => (tree, None),
        };
        let names = path.iter().filter(|token| *token != "::").cloned();
        let mut path: Vec<String> = prefix.iter().cloned().chain(names).collect();
        if path.len() > 1 && path.last().is_some_and(|last| last == "self") {
            path.pop();
        }
        if let Some(last) = path.last().cloned() {
            found.push(Import { alias: alias.cloned().unwrap_or(last), path, public });
        }
        return;
    };
    let names = tree[..brace].iter().filter(|token| *token != "::").cloned();
    let prefix: Vec<String> = prefix.iter().cloned().chain(names).collect();
    for part in split(&tree[brace + 1..tree.len() - 1]) {
        imports(part, &prefix, public, found);
    }
}

/// The parts between commas outside of braces.
fn split(list: &[String]) -> Vec<&[String]> {
    let mut depth = 0;
    let outside = |token: &String| {
        match token.as_str() {
            "{" => depth += 1,
            "}" => depth -= 1,
            _ => {}
        }
        depth == 0 && token == ","
    };
    list.split(outside).filter(|part| !part.is_empty()).collect()
}

/// The path that begins the tokens.
fn path(tokens: &[String]) -> Vec<String> {
    let mut path = vec![tokens[0].clone()];
    for pair in tokens[1..].chunks_exact(2) {
        if pair[0] != "::" || !is_name(&pair[1]) {
            break;
        }
        path.push(pair[1].clone());
    }
    path
}

fn is_name(token: &str) -> bool {
    token.starts_with(|c: char| c.is_alphabetic() || c == '_')
}

/// Names, numbers, `::` and single signs, without comments, strings, characters and lifetimes.
fn tokens(text: &str) -> Vec<String> {
    let mut tokens = Vec::new();
    let mut rest = text;
    while let Some(first) = rest.chars().next() {
        let length = if let Some(length) = ignored(rest) {
            length
        } else {
            let is_word = |c: char| c.is_alphanumeric() || c == '_';
            let word = rest.find(|c: char| !is_word(c)).unwrap_or(rest.len());
            let length = if rest.starts_with("::") { 2 } else { word.max(first.len_utf8()) };
            tokens.push(rest[..length].to_owned());
            length
        };
        rest = &rest[length..];
    }
    tokens
}

/// The length of the white space, comment, string, character or lifetime that begins the text.
fn ignored(text: &str) -> Option<usize> {
    let until = |end: &str, from: usize| text[from..].find(end).map_or(text.len(), |i| from + i + end.len());
    let raw = text.trim_start_matches('b').strip_prefix('r').map(|raw| raw.trim_start_matches('#'));
    if let Some(white) = text.find(|c: char| !c.is_whitespace()).filter(|length| *length > 0) {
        return Some(white);
    }
    match text.as_bytes() {
        [b'/', b'/', ..] => Some(until("\n", 0)),
        [b'/', b'*', ..] => Some(until("*/", 2)),
        [b'b' | b'r', ..] if raw.is_some_and(|raw| raw.starts_with('"')) => {
            let hashes = text.chars().take_while(|c| *c != '"').filter(|c| *c == '#').count();
            let start = text.find('"')? + 1;
            Some(until(&format!("\"{}", "#".repeat(hashes)), start))
        }
        [b'b', b'"', ..] => Some(1 + quoted(&text[1..], '"')),
        [b'b', b'\'', ..] => Some(1 + quoted(&text[1..], '\'')),
        [b'"', ..] => Some(quoted(text, '"')),
        [b'\'', b'\\', ..] => Some(quoted(text, '\'')),
        [b'\'', ..] => {
            let mut after = text.char_indices().skip(2);
            match after.next() {
                Some((i, '\'')) => Some(i + 1),
                // A lifetime.
                _ => Some(1 + text[1..].find(|c: char| !c.is_alphanumeric() && c != '_')?),
            }
        }
        _ => text.trim_start().is_empty().then_some(text.len()),
    }
}

/// The length of what the quotes enclose, with them.
fn quoted(text: &str, quote: char) -> usize {
    let mut escaped = false;
    for (i, c) in text.char_indices().skip(1) {
        match c {
            _ if escaped => escaped = false,
            '\\' => escaped = true,
            _ if c == quote => return i + 1,
            _ => {}
        }
    }
    text.len()
}
