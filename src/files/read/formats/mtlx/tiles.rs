//! Tiles of a picture: files whose names have `<UDIM>` or `<UVTILE>` in the place of the number of a tile.

use std::path::Path;

use crate::disk::open::NamedFile;
use crate::error::Error;
use crate::read::names::listing;

/// The token of the number of a tile, of UDIM and by column and row.
const TOKENS: [&str; 2] = ["<UDIM>", "<UVTILE>"];
/// Tiles that are looked for: ten rows of ten.
const MOST: usize = 100;

/// A document in which `<` is escaped in attributes: exporters write tokens such as `<UDIM>` as they are, where XML allows none.
pub(super) fn escaped(document: &str) -> String {
    let mut text = String::with_capacity(document.len());
    let mut rest = document;
    while let Some(start) = rest.find('<') {
        let (before, markup) = rest.split_at(start);
        text += before;
        let (end, escapes) = match markup {
            comment if comment.starts_with("<!--") => (comment.find("-->"), false),
            instruction if instruction.starts_with("<?") => (instruction.find("?>"), false),
            data if data.starts_with("<![CDATA[") => (data.find("]]>"), false),
            tag => (end_of_tag(tag), true),
        };
        let (markup, after) = markup.split_at(end.unwrap_or(markup.len()));
        match (markup.strip_prefix('<'), escapes) {
            (Some(inside), true) => text.extend(["<", &inside.replace('<', "&lt;")]),
            _ => text += markup,
        }
        rest = after;
    }
    text + rest
}

/// Where a tag ends: at the first `>` outside of quotes.
fn end_of_tag(tag: &str) -> Option<usize> {
    let mut quote = None;
    tag.bytes().position(|byte| match (quote, byte) {
        (None, b'"' | b'\'') => {
            quote = Some(byte);
            false
        }
        (None, b'>') => true,
        (Some(open), _) if open == byte => {
            quote = None;
            false
        }
        _ => false,
    })
}

/// The file `name` that the document `by` names, of the only tile that is there.
///
/// # Errors
/// [`Error::NotAMaterial`] of several tiles.
pub(super) fn only(name: &str, by: &Path) -> Result<String, Error> {
    if !TOKENS.iter().any(|token| name.contains(token)) {
        return Ok(name.to_owned());
    }
    let tile = |number: usize| {
        let place = format!("u{}_v{}", number % 10 + 1, number / 10 + 1);
        name.replace(TOKENS[0], &(1001 + number).to_string()).replace(TOKENS[1], &place)
    };
    let mut there: Vec<_> = (0..MOST).map(tile).filter(|file| NamedFile::within(file, by).exists()).collect();
    if there.len() > 1 {
        return Err(Error::NotAMaterial {
            path: by.to_owned(),
            expected: format!("one tile of {name}"),
            found: listing(&there),
            remedy: "write the name of one of them into the document".to_owned(),
        });
    }
    Ok(there.pop().unwrap_or_else(|| tile(0)))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn only_attributes_are_escaped() {
        for (stored, expected) in [
            (r#"<a b="x<UDIM>.png" c='<f>"<g>'/>"#, r#"<a b="x&lt;UDIM>.png" c='&lt;f>"&lt;g>'/>"#),
            ("<?it's <x>?><a b='<'/>", "<?it's <x>?><a b='&lt;'/>"),
            ("<!-- don't <x> --><a b='<'>t</a>", "<!-- don't <x> --><a b='&lt;'>t</a>"),
            ("<a><![CDATA[it's <b>]]></a>", "<a><![CDATA[it's <b>]]></a>"),
            ("<a b='<", "<a b='&lt;"),
            ("no markup", "no markup"),
        ] {
            assert_eq!(escaped(stored), expected);
        }
    }
}
