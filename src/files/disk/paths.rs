//! Paths that files name: absolute ones, and the way from one folder to another.

use std::path::{Component, Path, PathBuf};

/// Whether a name in a file is no way from the folder of that file: an absolute path, a path on a drive or a network share, or a
/// device of Windows. Drives and shares count on every system, so that a file is accepted or refused everywhere.
pub(crate) fn is_absolute(name: &Path) -> bool {
    let text = name.as_os_str().as_encoded_bytes();
    let is_drive = matches!(text, [letter, b':', b'/' | b'\\', ..] if letter.is_ascii_alphabetic());
    let is_prefixed = matches!(name.components().next(), Some(Component::Prefix(_)));
    name.has_root() || text.starts_with(b"\\") || is_drive || is_prefixed || is_device(name)
}

/// Whether a part of the path is a device, which Windows has in every folder.
fn is_device(name: &Path) -> bool {
    const DEVICES: [&str; 4] = ["CON", "PRN", "AUX", "NUL"];
    let is_one = |part: &str| {
        let stem = part.split(['.', ':']).next().unwrap_or_default().trim_end().to_ascii_uppercase();
        let numbered = stem.strip_prefix("COM").or_else(|| stem.strip_prefix("LPT"));
        let is_digit = |rest: &str| rest.len() == 1 && rest.bytes().all(|byte| byte.is_ascii_digit());
        DEVICES.contains(&stem.as_str()) || numbered.is_some_and(is_digit)
    };
    cfg!(windows) && name.components().any(|part| is_one(&part.as_os_str().to_string_lossy()))
}

/// What every file system and address takes of a name.
pub(crate) fn plain(name: &str) -> String {
    let plain = |c: char| if c.is_ascii_alphanumeric() || c == '-' { c } else { '_' };
    name.chars().take(48).map(plain).collect()
}

/// Whether the file `path` lies outside of `folder`, links followed.
pub(crate) fn is_outside(path: &Path, folder: &Path) -> bool {
    let folder = if folder.as_os_str().is_empty() { Path::new(".") } else { folder };
    match (path.canonicalize(), folder.canonicalize()) {
        (Ok(path), Ok(folder)) => !path.starts_with(folder),
        _ => !absolute(path).starts_with(absolute(folder)),
    }
}

/// The path from the root, without `..`.
pub(crate) fn absolute(path: &Path) -> PathBuf {
    let path = if path.as_os_str().is_empty() { Path::new(".") } else { path };
    let path = std::path::absolute(path).unwrap_or_else(|_| path.to_owned());
    path.components().fold(PathBuf::new(), |mut path, component| {
        match component {
            Component::ParentDir => drop(path.pop()),
            component => path.push(component),
        }
        path
    })
}

/// The way from `folder` to `path`, both absolute, with slashes; `path` itself on another drive.
pub(crate) fn relative(path: &Path, folder: &Path) -> PathBuf {
    let (to, from): (Vec<_>, Vec<_>) = (path.components().collect(), folder.components().collect());
    let common = to.iter().zip(&from).take_while(|(a, b)| a == b).count();
    if common == 0 {
        return path.to_owned();
    }
    let up = from[common..].iter().map(|_| "..".to_owned());
    let down = to[common..].iter().map(|part| part.as_os_str().to_string_lossy().into_owned());
    up.chain(down).collect::<Vec<_>>().join("/").into()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn drives_and_shares_are_absolute_everywhere() {
        let absolute = |name: &str| is_absolute(Path::new(name));
        for name in ["/etc/passwd", r"C:\a.png", "c:/a.png", r"\\host\share\a.png", "//host/share", r"\a.png"]
        {
            assert!(absolute(name), "{name}");
        }
        for name in
            ["a.png", "../a.png", "../../../Images/a.png", "./a.png", "a:b.png", "", "textures\\a.png"]
        {
            assert!(!absolute(name), "{name}");
        }
        assert_eq!(absolute("folder/aux.png"), cfg!(windows));
    }

    #[test]
    fn the_way_from_a_folder_leads_back() {
        for (path, folder, way) in [
            ("/a/b/c.png", "/a/b", "c.png"),
            ("/a/c.png", "/a/b", "../c.png"),
            ("/d/c.png", "/a/b", "../../d/c.png"),
        ] {
            let found = relative(Path::new(path), Path::new(folder));
            assert_eq!(found, Path::new(way));
            assert_eq!(absolute(&Path::new(folder).join(found)), Path::new(path));
        }
    }

    #[test]
    fn outside_is_judged_at_the_end_of_links() {
        let folder = tempfile::tempdir().unwrap();
        let of = |name: &str| folder.path().join(name);
        std::fs::create_dir(of("in")).unwrap();
        std::fs::write(of("a.png"), "").unwrap();
        std::fs::write(of("in/a.png"), "").unwrap();
        assert!(is_outside(&of("in/../a.png"), &of("in")) && !is_outside(&of("in/../in/a.png"), &of("in")));
        assert!(is_outside(&of("in/../none.png"), &of("in")) && !is_outside(&of("in/none.png"), &of("in")));
        #[cfg(unix)]
        {
            std::os::unix::fs::symlink("../a.png", of("in/link.png")).unwrap();
            assert!(is_outside(&of("in/link.png"), &of("in")));
        }
    }
}
