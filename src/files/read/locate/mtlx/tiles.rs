//! Tiles of a picture: files whose names have `<UDIM>` or `<UVTILE>` in the place of the number of a tile.

use std::path::Path;

use crate::disk::open::NamedFile;
use crate::error::Error;
use crate::read::names::listing;

/// What stands for the number of a tile, of UDIM and by column and row.
const TOKENS: [&str; 2] = ["<UDIM>", "<UVTILE>"];
/// Tiles that are looked for: ten rows of ten.
const MOST: usize = 100;

/// A document in which these tokens are escaped: exporters write them as they are into attributes, where XML allows no `<`.
pub(super) fn escaped(document: &str) -> String {
    TOKENS.iter().fold(document.to_owned(), |text, token| text.replace(token, &token.replace('<', "&lt;")))
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
