//! Renderings as files: floats into EXR, what a screen shows into PNG, either with where it comes from.

mod exr;
mod png;
mod provenance;

use std::fs::File;
use std::io::{self, BufWriter, Write};
use std::path::{Path, PathBuf};

pub use provenance::{Provenance, Shows};

use crate::colour_map::difference_to_display;
use crate::display::to_display;
use crate::error::Error;
use crate::render::Image;

/// Texels between two panes of a picture.
pub const GAP: usize = 4;
/// What the gap of a PNG shows.
const MID_GRAY: [u8; 3] = [128; 3];

/// The kinds of files that pictures are written into.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Format {
    /// Linear radiance as 32-bit floats.
    Exr,
    /// Exposed and sRGB-encoded, 8 bits.
    Png,
}

/// A file to be written, in a folder that is there.
#[derive(Clone, Debug)]
pub struct Destination {
    path: PathBuf,
    format: Format,
}

impl Destination {
    /// Checks what can be checked of `path` before there is anything to write.
    ///
    /// # Errors
    /// [`Error::UnknownName`] for an extension other than exr and png, [`Error::Unwritable`] where its folder is
    /// missing or it is itself a folder.
    pub fn new(path: &Path) -> Result<Self, Error> {
        let format = format_of(path)?;
        check_place(path)?;
        Ok(Self { path: path.to_owned(), format })
    }

    /// Writes `panes`, which are equally high, side by side. The file appears when it is complete, or not at all.
    ///
    /// # Errors
    /// [`Error::Unwritable`].
    pub fn write(&self, panes: &[Image<f32>], provenance: &Provenance) -> Result<(), Error> {
        match self.format {
            Format::Exr => {
                let picture = side_by_side(panes, [0.0; 3]);
                self.replace(|file| exr::write(file, picture, provenance))
            }
            Format::Png => {
                let shown: Vec<_> = panes.iter().map(|p| displayed(p, provenance)).collect();
                let picture = side_by_side(&shown, MID_GRAY);
                self.replace(|file| png::write(file, &picture, provenance))
            }
        }
    }

    fn replace(&self, write: impl FnOnce(&mut BufWriter<&mut File>) -> io::Result<()>) -> Result<(), Error> {
        replace(&self.path, write)
    }
}

/// Whether a file can be at `path`: found out before there is anything to write.
///
/// # Errors
/// [`Error::Unwritable`] where its folder is missing or it is itself a folder.
pub fn check_place(path: &Path) -> Result<(), Error> {
    if !folder_of(path).is_dir() {
        let source = io::Error::new(io::ErrorKind::NotFound, "its folder does not exist");
        return Err(unwritable(path, source, "create the folder first, or name another"));
    }
    if path.is_dir() {
        let source = io::Error::new(io::ErrorKind::IsADirectory, "it is a folder");
        return Err(unwritable(path, source, "name a file"));
    }
    Ok(())
}

/// Writes a temporary file beside `path` and renames it: at any moment the old file or the new one is there, whole.
///
/// # Errors
/// [`Error::Unwritable`].
pub(crate) fn replace(
    path: &Path,
    write: impl FnOnce(&mut BufWriter<&mut File>) -> io::Result<()>,
) -> Result<(), Error> {
    let written = || -> io::Result<()> {
        let mut temporary = temporary_in(folder_of(path))?;
        let mut buffer = BufWriter::new(temporary.as_file_mut());
        write(&mut buffer)?;
        buffer.flush()?;
        drop(buffer);
        temporary.persist(path)?;
        Ok(())
    };
    written()
        .map_err(|source| unwritable(path, source, "check that its folder is writable and the disk not full"))
}

fn format_of(path: &Path) -> Result<Format, Error> {
    let extension = path.extension().unwrap_or_default().to_string_lossy().to_lowercase();
    match extension.as_str() {
        "exr" => Ok(Format::Exr),
        "png" => Ok(Format::Png),
        _ => Err(Error::UnknownName {
            what: "extension of an output file",
            found: path.display().to_string(),
            known: ".exr (linear floats), .png (8 bits for a screen)".to_owned(),
        }),
    }
}

pub(crate) fn folder_of(path: &Path) -> &Path {
    match path.parent() {
        Some(folder) if folder != Path::new("") => folder,
        _ => Path::new("."),
    }
}

/// A temporary file with the permissions of any other new file, not of a secret.
fn temporary_in(folder: &Path) -> io::Result<tempfile::NamedTempFile> {
    let mut builder = tempfile::Builder::new();
    #[cfg(unix)]
    let permissions = std::os::unix::fs::PermissionsExt::from_mode(0o666);
    #[cfg(unix)]
    builder.permissions(permissions);
    builder.prefix(".svbrdf-").tempfile_in(folder)
}

fn unwritable(path: &Path, source: io::Error, remedy: &'static str) -> Error {
    Error::Unwritable { path: path.to_owned(), source, remedy }
}

/// `panes` from left to right, [`GAP`] texels of `gap` between them; the height is that of the least high one.
fn side_by_side<T: Copy>(panes: &[Image<T>], gap: [T; 3]) -> Image<T> {
    let height = panes.iter().map(|p| p.height).min().unwrap_or(0);
    let gaps = GAP * panes.len().saturating_sub(1);
    let width = panes.iter().map(|p| p.width).sum::<usize>() + gaps;
    let mut pixels = Vec::with_capacity(width * height);
    for row in 0..height {
        for (i, pane) in panes.iter().enumerate() {
            pixels.extend(std::iter::repeat_n(gap, if i > 0 { GAP } else { 0 }));
            pixels.extend_from_slice(&pane.pixels[row * pane.width..][..pane.width]);
        }
    }
    Image { width, height, pixels }
}

fn displayed(image: &Image<f32>, provenance: &Provenance) -> Image<u8> {
    let colour = match provenance.shows {
        Shows::Radiance => to_display,
        Shows::LogDifference => difference_to_display,
    };
    let pixels = image.pixels.iter().map(|&rgb| colour(rgb, provenance.exposure_ev)).collect();
    Image { width: image.width, height: image.height, pixels }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn panes_stand_side_by_side_with_a_gap() {
        let pane = |width, value| Image { width, height: 2, pixels: vec![[value; 3]; 2 * width] };
        let picture = side_by_side(&[pane(1, 1), pane(2, 2)], [9u8; 3]);
        let row = [1, 9, 9, 9, 9, 2, 2].map(|v| [v; 3]);
        assert_eq!((picture.width, picture.height), (7, 2));
        assert_eq!(picture.pixels, [row, row].concat());
    }

    #[test]
    fn a_failed_write_leaves_nothing() {
        let folder = tempfile::tempdir().unwrap();
        let destination = Destination::new(&folder.path().join("a.png")).unwrap();
        let failed = destination.replace(|file| {
            file.write_all(b"half")?;
            Err(io::Error::other("disk full"))
        });
        assert!(failed.unwrap_err().to_string().contains("disk full"));
        assert_eq!(std::fs::read_dir(folder.path()).unwrap().count(), 0);
    }
}
