//! Wildcards in paths, where the shell has left them: quoted, or on Windows.

use std::path::PathBuf;

use crate::cli::output::CommandError;

/// Expands the wildcards `*`, `?` and `[...]` in `paths`, in the order of names. A path that exists is taken as it is.
///
/// # Errors
/// [`CommandError::Usage`] where a pattern is malformed or matches nothing.
pub fn expanded(paths: &[PathBuf]) -> Result<Vec<PathBuf>, CommandError> {
    let one = |path: &PathBuf| -> Result<Vec<PathBuf>, CommandError> {
        let text = path.to_string_lossy();
        if !text.contains(['*', '?', '[']) || path.exists() {
            return Ok(vec![path.clone()]);
        }
        let wrong = |problem: String| CommandError::Usage(format!("the pattern {text} {problem}"));
        let matches = glob::glob(&text).map_err(|problem| wrong(format!("is malformed: {problem}")))?;
        let found: Vec<PathBuf> = matches.flatten().collect();
        if found.is_empty() { Err(wrong("matches no file".to_owned())) } else { Ok(found) }
    };
    Ok(paths.iter().map(one).collect::<Result<Vec<_>, _>>()?.concat())
}
