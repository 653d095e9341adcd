//! Wildcards in paths, where the shell has left them: quoted, or on Windows.

use std::cmp::Ordering;
use std::path::{Path, PathBuf};

use glob::Pattern;

use super::{NamedPath, is_there};
use crate::cli::output::CommandError;

/// Expands the wildcards `*`, `?` and `[...]` in paths, in natural order: `step9` before `step10`. A path that exists is taken as it is,
/// and so is the part of a path that does.
pub fn expanded(all: impl Iterator<Item = NamedPath>) -> Result<Vec<NamedPath>, CommandError> {
    let one = |given: NamedPath| -> Result<Vec<NamedPath>, CommandError> {
        let folder = given.path.ancestors().find(|above| above.is_dir()).unwrap_or(Path::new(""));
        let rest = given.path.strip_prefix(folder).unwrap_or(&given.path);
        if !rest.to_string_lossy().contains(['*', '?', '[']) || is_there(&given.path) {
            return Ok(vec![given]);
        }
        let text = given.path.to_string_lossy();
        let wrong = |problem: String| CommandError::Usage(format!("the pattern {text} {problem}"));
        let pattern = Path::new(&Pattern::escape(&folder.to_string_lossy())).join(rest);
        let matches = glob::glob(&pattern.to_string_lossy());
        let matches = matches.map_err(|problem| wrong(format!("is malformed: {problem}")))?;
        let mut found: Vec<PathBuf> = matches.flatten().collect();
        found.sort_by(|a, b| natural_order(a, b));
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

/// Compares paths with every run of digits as one number; where these are equal, as text.
fn natural_order(a: &Path, b: &Path) -> Ordering {
    let [a, b] = [a, b].map(|path| path.to_string_lossy());
    let parts = |text: &str| -> Vec<(usize, String)> {
        let runs = text.as_bytes().chunk_by(|a, b| a.is_ascii_digit() == b.is_ascii_digit());
        let part = |run: &[u8]| {
            let run = String::from_utf8_lossy(run);
            // Of two numbers the one with more digits is larger.
            match run.starts_with(|c: char| c.is_ascii_digit()) {
                true => (run.trim_start_matches('0').len(), run.trim_start_matches('0').to_owned()),
                false => (0, run.into_owned()),
            }
        };
        runs.map(part).collect()
    };
    parts(&a).cmp(&parts(&b)).then_with(|| a.cmp(&b))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn patterns_are_expanded_in_the_order_of_their_numbers() {
        let above = tempfile::tempdir().unwrap();
        let folder = above.path().join("[ab]*");
        std::fs::create_dir(&folder).unwrap();
        let names = ["a.png", "a_step9.png", "a_step010.png", "a_step10.png", "a_step100.png", "b_step1.png"];
        for name in names {
            std::fs::write(folder.join(name), "").unwrap();
        }
        let found = |rest: &str| expanded(std::iter::once(folder.join(rest).into())).unwrap();
        assert_eq!(found("*.png").iter().map(|one| one.path.file_name().unwrap()).collect::<Vec<_>>(), names);
        assert_eq!(found("{}.png"), [NamedPath::from(folder.join("{}.png"))]);
    }
}
