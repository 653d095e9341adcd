//! Wildcards in paths, where the shell has left them: quoted, or on Windows.

use std::path::PathBuf;

use super::{NamedPath, is_there};
use crate::cli::output::CommandError;

/// Expands the wildcards `*`, `?` and `[...]` in paths, in the order of names. A path that exists is taken as it is.
///
/// # Errors
/// [`CommandError::Usage`] where a pattern is malformed or matches nothing, or where several paths would have one name.
pub fn expanded(all: impl Iterator<Item = NamedPath>) -> Result<Vec<NamedPath>, CommandError> {
    let one = |given: NamedPath| -> Result<Vec<NamedPath>, CommandError> {
        let text = given.path.to_string_lossy();
        if !text.contains(['*', '?', '[']) || is_there(&given.path) {
            return Ok(vec![given]);
        }
        let wrong = |problem: String| CommandError::Usage(format!("the pattern {text} {problem}"));
        let matches = glob::glob(&text).map_err(|problem| wrong(format!("is malformed: {problem}")))?;
        let found: Vec<PathBuf> = matches.flatten().collect();
        match (found.len(), &given.name) {
            (0, _) => Err(wrong("matches no file or folder; correct it, or name the files".to_owned())),
            (2.., Some(name)) => {
                Err(wrong(format!("matches {} paths; the name {name} is for one", found.len())))
            }
            (_, name) => Ok(found.into_iter().map(|path| NamedPath { name: name.clone(), path }).collect()),
        }
    };
    Ok(all.map(one).collect::<Result<Vec<_>, _>>()?.concat())
}
