//! File of the settings: the window library reads it before this program does, and its numbers decide the window. So it is checked
//! before a window opens, and moved aside where none opens with it.

use std::collections::HashMap;
use std::path::{Path, PathBuf};

use eframe::egui;
use serde::Deserialize;

use svbrdf_core::progress::Progress;
use svbrdf_files::disk::atomic;
use svbrdf_files::disk::open::NamedFile;

use super::storage::{RECENT, SESSION, SETTINGS};
use crate::error::Error;
use crate::model::ranges::UI_SCALE;
use crate::model::settings::Settings;

/// The name that eframe gives the file.
const FILE: &str = "app.ron";
/// The largest file that is read, in bytes.
const LARGEST: u64 = 16 << 20;
/// The keys of eframe: for the window, and for what egui remembers.
const WINDOW: &str = "window";
const EGUI: &str = "egui";
/// Sides of a window in points, and scales of a screen.
const SIDES: std::ops::RangeInclusive<f32> = 100.0..=32_768.0;
const SCREEN_SCALES: std::ops::RangeInclusive<f32> = 0.1..=16.0;
/// Greatest distance of a window from the corner of the screens, in pixels.
const FARTHEST: f32 = 1e6;

/// The texts of the file by their keys.
#[derive(Debug, Default, PartialEq)]
struct Entries(HashMap<String, String>);

impl eframe::Storage for Entries {
    fn get_string(&self, key: &str) -> Option<String> {
        self.0.get(key).cloned()
    }

    fn set_string(&mut self, key: &str, value: String) {
        self.0.insert(key.to_owned(), value);
    }

    fn remove_string(&mut self, key: &str) {
        self.0.remove(key);
    }

    fn flush(&mut self) {}
}

/// The part of eframe, as far as it is checked.
#[derive(Deserialize)]
struct StoredWindow {
    normal_geometry: StoredGeometry,
}

#[derive(Deserialize)]
struct StoredGeometry {
    outer_position_pixels: Option<egui::Pos2>,
    scale_factor: f32,
    inner_size_points: egui::Vec2,
}

impl StoredWindow {
    fn is_usable(&self) -> bool {
        let StoredGeometry { outer_position_pixels, scale_factor, inner_size_points } = self.normal_geometry;
        let is_near = |at: egui::Pos2| at.x.abs() <= FARTHEST && at.y.abs() <= FARTHEST;
        SCREEN_SCALES.contains(&scale_factor)
            && SIDES.contains(&inner_size_points.x)
            && SIDES.contains(&inner_size_points.y)
            && outer_position_pixels.is_none_or(is_near)
    }
}

impl Entries {
    /// `None` where the text is of no such file.
    fn of_file(text: String) -> Option<Self> {
        // eframe reads a file as it reads a value.
        let file = Self(HashMap::from([(String::new(), text)]));
        eframe::get_value(&file, "").map(Self)
    }

    fn text(&self) -> String {
        let mut file = Self::default();
        eframe::set_value(&mut file, "", &self.0);
        file.0.remove("").unwrap_or_default()
    }

    /// What a window opens with: everything of this program, the place of the window where it has one, and of what egui remembers
    /// the scale alone. `None` where the settings cannot be read.
    fn usable(&self) -> Option<Self> {
        let has_settings = self.0.contains_key(SETTINGS);
        let settings: Option<Settings> = eframe::get_value(self, SETTINGS);
        if has_settings && settings.is_none() {
            return None;
        }
        let is_window =
            eframe::get_value(self, WINDOW).is_some_and(|window: StoredWindow| window.is_usable());
        let keys = [SETTINGS, RECENT, SESSION].into_iter().chain(is_window.then_some(WINDOW));
        let mut entries: HashMap<String, String> =
            keys.filter_map(|key| Some((key.to_owned(), self.0.get(key)?.clone()))).collect();
        let scale = settings.map(|settings| settings.ui_scale).filter(|scale| UI_SCALE.contains(scale));
        if let Some(scale) = scale {
            entries.insert(EGUI.to_owned(), format!("(options:(zoom_factor:{scale:?}))"));
        }
        Some(Self(entries))
    }
}

/// Drops from the file of the settings in `folder` what no window opens with. A file that cannot be read is moved aside: returns its
/// new path.
///
/// # Errors
/// [`Error::NoWindow`] where it can neither be used nor moved; [`FilesError::Unwritable`](svbrdf_files::Error::Unwritable).
pub fn prepare(folder: &Path) -> Result<Option<PathBuf>, Error> {
    let path = folder.join(FILE);
    let is_there = path.symlink_metadata().is_ok_and(|found| !found.is_file() || found.len() > 0);
    if !is_there {
        return Ok(None);
    }
    let Some((read, usable)) = text(&path).and_then(Entries::of_file).and_then(|read| {
        let usable = read.usable()?;
        Some((read, usable))
    }) else {
        let unusable = || Error::NoWindow {
            problem: format!("its settings {} cannot be read, and cannot be moved aside", path.display()),
            remedy: "delete that file",
        };
        return move_aside(folder).ok_or_else(unusable).map(Some);
    };
    if usable != read {
        atomic::write_text(&path, &usable.text(), &Progress::default())?;
    }
    Ok(None)
}

/// The text of a regular file of a sane size.
fn text(path: &Path) -> Option<String> {
    let is_small = path.metadata().ok()?.len() <= LARGEST;
    NamedFile::by_file(path, path.parent()?).text().ok().filter(|_| is_small)
}

/// Renames the file of the settings in `folder`, where there is one, and returns its new path.
pub fn move_aside(folder: &Path) -> Option<PathBuf> {
    let aside = folder.join(format!("{FILE}.damaged"));
    std::fs::rename(folder.join(FILE), &aside).ok().map(|()| aside)
}

#[cfg(test)]
mod tests {
    use super::*;

    const SOUND: &str = "(normal_geometry:(outer_position_pixels:Some((x:10.0,y:20.0)),scale_factor:1.0,\
        inner_size_points:(x:900.0,y:700.0)),fullscreen:false,maximized:false)";

    /// What is left of a file with these parts.
    fn prepared(parts: &[(&str, &str)]) -> Entries {
        let folder = tempfile::tempdir().unwrap();
        let parts = parts.iter().map(|(key, text)| ((*key).to_owned(), (*text).to_owned()));
        std::fs::write(folder.path().join(FILE), Entries(parts.collect()).text()).unwrap();
        assert_eq!(prepare(folder.path()).unwrap(), None);
        Entries::of_file(text(&folder.path().join(FILE)).unwrap()).unwrap()
    }

    fn scale_of_egui(entries: &Entries) -> Option<f32> {
        eframe::get_value::<egui::Memory>(entries, EGUI).map(|memory| memory.options.zoom_factor)
    }

    #[test]
    fn a_sound_file_keeps_its_parts_and_egui_opens_with_the_scale_of_the_settings() {
        let settings = ("settings", "(dark:false,ui_scale:2.0)");
        let left = prepared(&[settings, ("window", SOUND), ("recent", "[]"), ("other", "1")]);
        assert_eq!(left.0.get("settings").map(String::as_str), Some(settings.1));
        assert_eq!(left.0.get("window").map(String::as_str), Some(SOUND));
        assert!(left.0.contains_key("recent") && !left.0.contains_key("other"));
        assert_eq!(scale_of_egui(&left), Some(2.0));
        assert_eq!(left.usable(), Some(Entries(left.0.clone())), "it stays as it is");
    }

    #[test]
    fn scales_and_memories_of_egui_that_no_window_has_are_dropped() {
        for scale in ["0.0", "-1.0", "NaN", "inf", "1e9", "0.01"] {
            let settings = format!("(dark:false,ui_scale:{scale})");
            let egui = format!("(options:(zoom_factor:{scale}))");
            let left = prepared(&[("settings", &settings), ("egui", &egui)]);
            assert!(left.0.contains_key("settings") && !left.0.contains_key("egui"), "{scale}: {left:?}");
        }
        let left = prepared(&[("settings", "()"), ("egui", "(options:(zoom_factor:0.0)")]);
        assert_eq!(scale_of_egui(&left), Some(1.0));
    }

    #[test]
    fn windows_out_of_range_are_dropped() {
        let damages = [
            ("x:900.0", "x:0.0"),
            ("y:700.0", "y:NaN"),
            ("x:900.0", "x:1e12"),
            ("y:700.0", "y:-700.0"),
            ("scale_factor:1.0", "scale_factor:0.0"),
            ("x:10.0", "x:inf"),
            ("normal_geometry", "geometry"),
            (",fullscreen", ",,"),
        ];
        for (from, to) in damages {
            let damaged = SOUND.replace(from, to);
            assert_ne!(damaged, SOUND);
            let left = prepared(&[("settings", "(dark:false)"), ("window", &damaged)]);
            assert!(!left.0.contains_key("window") && left.0.contains_key("settings"), "{damaged}");
        }
    }

    #[test]
    fn a_file_that_cannot_be_read_is_moved_aside_whole() {
        let folder = tempfile::tempdir().unwrap();
        assert_eq!(prepare(folder.path()).unwrap(), None, "the first start has no file");
        let (file, damaged) = (folder.path().join(FILE), folder.path().join("app.ron.damaged"));
        std::fs::write(&file, "").unwrap();
        assert_eq!(prepare(folder.path()).unwrap(), None, "nor has one that was never written");
        let no_settings = Entries(HashMap::from([("settings".to_owned(), "(dark: tr".to_owned())])).text();
        for text in ["{\"settings\": \"(dark: tr", "\u{0}", &no_settings] {
            std::fs::write(&file, text).unwrap();
            assert_eq!(prepare(folder.path()).unwrap(), Some(damaged.clone()), "{text}");
            assert!(!file.exists());
            assert_eq!(NamedFile::by_user(&damaged).text().unwrap(), text);
        }
        std::fs::File::create(&file).unwrap().set_len(LARGEST + 1).unwrap();
        assert_eq!(prepare(folder.path()).unwrap(), Some(damaged.clone()), "a large file");
        std::fs::create_dir(&file).unwrap();
        let error = prepare(folder.path()).unwrap_err().to_string();
        assert!(error.contains("app.ron") && error.contains("delete"), "{error}");
    }

    #[cfg(unix)]
    #[test]
    fn nothing_but_a_regular_file_is_opened() {
        let folder = tempfile::tempdir().unwrap();
        let file = folder.path().join(FILE);
        assert!(std::process::Command::new("mkfifo").arg(&file).status().unwrap().success());
        assert!(prepare(folder.path()).unwrap().is_some(), "a pipe");
        std::os::unix::fs::symlink("/dev/zero", &file).unwrap();
        assert!(prepare(folder.path()).unwrap().is_some(), "a device");
    }
}
