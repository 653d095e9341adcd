//! Listings of folders, for reading and for messages, the names that folders give, and the extensions of files that are read.

use std::fs;
use std::path::{Path, PathBuf};

use super::words::words;
use crate::error::Error;

/// Most file names that a message lists.
const MOST_LISTED: usize = 12;

/// Files that other programs leave beside pictures.
pub(crate) fn is_junk(name: &str) -> bool {
    let name = name.to_lowercase();
    [".import", ".meta", ".uid"].iter().any(|end| name.ends_with(end))
        || name == "thumbs.db"
        || name == "desktop.ini"
}

/// The file names for a message, no matter how many they are, without the files that other programs leave.
pub(crate) fn listing(names: &[String]) -> String {
    let names: Vec<&str> = names.iter().map(String::as_str).filter(|name| !is_junk(name)).collect();
    match names.len() {
        0 => "no files".to_owned(),
        count if count > MOST_LISTED => {
            format!("{} and {} more", names[..MOST_LISTED].join(", "), count - MOST_LISTED)
        }
        _ => names.join(", "),
    }
}

/// The names of the visible folders in `folder`, sorted.
pub(crate) fn folders(folder: &Path) -> Result<Vec<String>, Error> {
    // A link may lead back here.
    let is_one = |entry: &fs::DirEntry, _: &str| entry.file_type().is_ok_and(|kind| kind.is_dir());
    entries(folder, folder, is_one)
}

/// The names of the visible files in `folder` that begin with `prefix` and whose next word begins there, sorted.
///
/// Where there is no such folder, the error names `path`, which the user gave.
pub(crate) fn list(path: &Path, folder: &Path, prefix: &str) -> Result<Vec<String>, Error> {
    let prefix_words = words(prefix);
    let begins = |name: &str| {
        name.starts_with(prefix) && (prefix_words.is_empty() || words(name).starts_with(&prefix_words))
    };
    entries(path, folder, |entry, name| begins(name) && !is_folder(entry))
}

/// The visible names in `folder` of the entries that are wanted, sorted.
fn entries(
    path: &Path,
    folder: &Path,
    is_wanted: impl Fn(&fs::DirEntry, &str) -> bool,
) -> Result<Vec<String>, Error> {
    let unreadable = |source| Error::unreadable(if folder.is_dir() { folder } else { path }, source);
    let mut names = Vec::new();
    for entry in fs::read_dir(folder).map_err(unreadable)? {
        let entry = entry.map_err(unreadable)?;
        let name = entry.file_name().to_string_lossy().into_owned();
        if !name.starts_with('.') && is_wanted(&entry, &name) {
            names.push(name);
        }
    }
    names.sort();
    Ok(names)
}

/// Whether it is a folder or a link to one. Of the files of a large folder only links are asked for.
fn is_folder(entry: &fs::DirEntry) -> bool {
    entry.file_type().is_ok_and(|kind| kind.is_dir() || (kind.is_symlink() && entry.path().is_dir()))
}

/// Folders of these names have the maps of the material that the folder above is named after.
const OF_MAPS: [&str; 4] = ["textures", "texture", "maps", "tex"];

/// The prefix without separators at its end, or else the name of the folder, or of the one above a folder called `textures`.
pub(crate) fn material_name(path: &Path, prefix: &str) -> String {
    let prefix = prefix.trim_end_matches(|c: char| !c.is_alphanumeric());
    if !prefix.is_empty() {
        return prefix.to_owned();
    }
    // A folder such as `..` has a name only once it is resolved.
    let resolved: PathBuf = path.canonicalize().unwrap_or_else(|_| path.to_owned());
    let name = |path: &Path| path.file_name().map(|name| name.to_string_lossy().into_owned());
    let own = name(&resolved).unwrap_or_else(|| path.to_string_lossy().into_owned());
    let is_of_maps = OF_MAPS.iter().any(|of_maps| own.eq_ignore_ascii_case(of_maps));
    resolved.parent().filter(|_| is_of_maps).and_then(name).unwrap_or(own)
}

/// Extensions of the files that open as a material or as a map of one.
pub const EXTENSIONS: [&str; 28] = [
    "png", "tif", "tiff", "tx", "jpg", "jpeg", "jfif", "jpe", "tga", "bmp", "webp", "dds", "hdr", "exr",
    "pbm", "pgm", "ppm", "pnm", "pam", "pfm", "qoi", "npy", "npz", "gltf", "glb", "mtl", "mtlx", "json",
];
/// Extensions of files that list their textures.
pub(crate) const LISTING: [&str; 4] = ["gltf", "glb", "mtl", "mtlx"];
/// Extensions of the pictures that count among the files of a folder, the better one of two last.
pub(crate) const PICTURES: [&str; 22] = [
    "dds", "webp", "jpe", "jfif", "jpg", "jpeg", "bmp", "tga", "pbm", "pgm", "ppm", "pnm", "pam", "qoi",
    "hdr", "png", "tx", "tif", "tiff", "pfm", "npy", "exr",
];

/// The extension of a file name, in lower case.
pub(crate) fn extension(name: impl AsRef<Path>) -> String {
    name.as_ref().extension().unwrap_or_default().to_string_lossy().to_lowercase()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_folder_called_textures_has_the_name_of_the_one_above() {
        let named = |path: &str, prefix: &str| material_name(Path::new(path), prefix);
        assert_eq!(named("/no/brick/textures", ""), "brick");
        assert_eq!(named("/no/brick/Maps", ""), "brick");
        assert_eq!(named("/no/brick/textures", "wall_"), "wall");
        assert_eq!(named("/no/brick/painted", ""), "painted");
        assert_eq!(named("/textures", ""), "textures");
    }

    #[test]
    fn files_and_links_to_files_are_listed_and_folders_and_links_to_folders_are_not() {
        let folder = tempfile::tempdir().unwrap();
        let at = |name: &str| folder.path().join(name);
        fs::create_dir(at("brick_folder")).unwrap();
        fs::write(at("brick_file.png"), "").unwrap();
        fs::write(at("bricks.png"), "").unwrap();
        let mut expected = vec!["brick_file.png"];
        #[cfg(unix)]
        {
            std::os::unix::fs::symlink(at("brick_folder"), at("brick_link")).unwrap();
            std::os::unix::fs::symlink(at("brick_file.png"), at("brick_link.png")).unwrap();
            expected.push("brick_link.png");
        }
        assert_eq!(list(folder.path(), folder.path(), "brick").unwrap(), expected);
        expected.push("bricks.png");
        assert_eq!(list(folder.path(), folder.path(), "").unwrap(), expected);
    }
}
