//! Materials on the command line: `PATH`, or `NAME=PATH` with a name for titles, tables and figures.

use std::ffi::OsString;
use std::path::{Path, PathBuf};

use clap::builder::{OsStringValueParser, TypedValueParser};

use svbrdf_files::read::is_prefix;
use svbrdf_files::source::MaterialSource;

/// A path, and the name that the material or method there is given.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct NamedPath {
    pub name: Option<String>,
    pub path: PathBuf,
}

impl NamedPath {
    /// The parser of an argument: any argument is one.
    pub fn parser() -> impl TypedValueParser<Value = Self> {
        OsStringValueParser::new().map(Self::from)
    }

    /// The material, read without options.
    pub fn source(&self) -> MaterialSource {
        MaterialSource { name: self.name.clone(), ..MaterialSource::from(self.path.clone()) }
    }
}

impl From<PathBuf> for NamedPath {
    fn from(path: PathBuf) -> Self {
        Self { name: None, path }
    }
}

impl From<OsString> for NamedPath {
    /// What exists is a path, whatever its name; and a name is no path itself.
    fn from(argument: OsString) -> Self {
        let path = PathBuf::from(argument);
        let parts = path.to_str().and_then(|text| text.split_once('='));
        match parts.filter(|(name, _)| !name.is_empty() && !name.contains(['/', '\\'])) {
            Some((name, rest)) if !is_there(&path) => Self { name: Some(name.to_owned()), path: rest.into() },
            _ => Self::from(path),
        }
    }
}

/// Whether there is a file or folder at `path`, or files that it is the prefix of, or a folder whose name has the equals sign.
pub fn is_there(path: &Path) -> bool {
    let is_in_folder_with_sign =
        || path.parent().is_some_and(|folder| folder.to_string_lossy().contains('=') && folder.is_dir());
    path.exists() || is_in_folder_with_sign() || is_prefix(path)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_name_stands_before_an_equals_sign_unless_the_whole_is_a_path_that_exists() {
        let folder = tempfile::tempdir().unwrap();
        let of = |name: &str| folder.path().join(name);
        std::fs::create_dir(of("lr=0.1")).unwrap();
        std::fs::write(of("b=1_diffuse.png"), "").unwrap();
        let parsed = |text: &str| NamedPath::from(OsString::from(text));
        let named = |name: &str, path: &str| NamedPath { name: Some(name.to_owned()), path: path.into() };
        assert_eq!(parsed("ours=a.png"), named("ours", "a.png"));
        assert_eq!(parsed("a b=x=y.png"), named("a b", "x=y.png"));
        for path in ["a.png", "=a.png", "x/y=a.png"] {
            assert_eq!(parsed(path), NamedPath::from(PathBuf::from(path)));
        }
        for there in ["lr=0.1", "lr=0.1/not_yet.png", "b=1_diffuse.png", "b=1_"] {
            let path = of(there);
            assert_eq!(parsed(path.to_str().unwrap()).name, None, "{there}");
            assert!(is_there(&path), "{there}");
        }
        assert!(!is_there(&of("ours=a.png")));
    }
}
