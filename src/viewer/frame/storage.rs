//! Storage of the settings and of the last comparisons between two starts.

use std::ffi::OsString;
use std::path::{Path, PathBuf};
use std::sync::Arc;

use serde::{Deserialize, Serialize};

use svbrdf_core::progress::Progress;
use svbrdf_files::disk::open::NamedFile;
use svbrdf_files::disk::{atomic, own};
use svbrdf_files::session::Session;

use crate::message::Message;
use crate::model::Model;
use crate::model::ranges::bring_into_range;
use crate::model::settings::Settings;

/// The name of the program, in its title, among the programs of the desktop and of its folder.
pub const NAME: &str = "svbrdf";

/// The name of the file, and the name of one that cannot be read.
const FILE: &str = "settings.json";
const DAMAGED: &str = "settings.json.damaged";

/// The largest file, in bytes.
const MOST: u64 = 64 << 20;

#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
#[serde(default)]
struct Stored {
    settings: Settings,
    recent: Vec<Session>,
}

/// The file, and what was last stored in it.
#[derive(Debug, Default)]
pub struct SettingsStorage {
    /// `None`: nothing is stored.
    folder: Option<PathBuf>,
    /// `None` before there is a file.
    stored: Option<Stored>,
    is_damaged: bool,
}

impl SettingsStorage {
    /// Reads the file in `folder`. One that cannot be read is renamed.
    pub fn read(folder: Option<PathBuf>) -> Self {
        let path =
            folder.as_deref().map(|folder| folder.join(FILE)).filter(|path| path.symlink_metadata().is_ok());
        let stored = path.as_deref().and_then(stored);
        let is_damaged = path.is_some() && stored.is_none();
        if let (true, Some(path)) = (is_damaged, path) {
            let _ = std::fs::rename(&path, path.with_file_name(DAMAGED));
        }
        Self { folder, stored, is_damaged }
    }

    /// The settings of the last window.
    pub fn settings(&self) -> Option<&Settings> {
        self.stored.as_ref().map(|stored| &stored.settings)
    }

    /// Whether nothing has been stored yet.
    pub fn is_new(&self) -> bool {
        self.stored.is_none()
    }

    /// Gives `model` what the last start has stored; numbers are brought into their ranges.
    pub fn load(&self, model: &mut Model) {
        if let (true, Some(folder)) = (self.is_damaged, &self.folder) {
            let place = folder.join(DAMAGED);
            let text = format!(
                "The settings of the last start cannot be read. They are in {}; the window has the default ones.",
                place.display()
            );
            model.report([Message::Warning(text)]);
        }
        let Some(Stored { settings, recent }) = self.stored.clone() else { return };
        (model.settings, model.recent) = (settings, Arc::new(recent));
        let out_of_range = bring_into_range(model).map(Message::Warning);
        model.report(out_of_range);
    }

    /// Stores what has changed, at once: a program that is killed stores nothing at its end. A file that cannot be written is missed
    /// at the next start only.
    pub fn store(&mut self, model: &Model) {
        let now = Stored { settings: model.settings.for_next_start(), recent: model.recent.to_vec() };
        let Some(folder) = self.folder.as_deref().filter(|_| self.stored.as_ref() != Some(&now)) else {
            return;
        };
        if let (Ok(()), Ok(text)) = (own::folder(folder), serde_json::to_string_pretty(&now))
            && text.len() as u64 <= MOST
        {
            let _ = atomic::write_text(&folder.join(FILE), &text, &Progress::default());
        }
        self.stored = Some(now);
    }
}

/// What a regular file holds; `None` where it is too large, as its size tells before it is read.
fn stored(path: &Path) -> Option<Stored> {
    path.metadata().ok().filter(|found| found.len() <= MOST)?;
    let text = NamedFile::by_file(path, path.parent()?).text().ok()?;
    serde_json::from_str(&text).ok()
}

/// The folder in which the program stores its settings.
pub fn folder() -> Option<PathBuf> {
    let variable =
        |name: &str| -> Option<OsString> { std::env::var_os(name).filter(|value| !value.is_empty()) };
    let home = || variable("HOME").map(PathBuf::from);
    let of_programs = if cfg!(windows) {
        PathBuf::from(variable("APPDATA")?)
    } else if cfg!(target_os = "macos") {
        home()?.join("Library/Application Support")
    } else {
        variable("XDG_DATA_HOME").map(PathBuf::from).or_else(|| Some(home()?.join(".local/share")))?
    };
    Some(of_programs.join(NAME))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::model::ranges::UI_SCALE;
    use svbrdf_core::loss::{Ask, FileScenes, LossSettings};

    /// The model of the next start on this folder.
    fn started(folder: &Path) -> Model {
        let mut model = Model::default();
        SettingsStorage::read(Some(folder.to_owned())).load(&mut model);
        model
    }

    #[test]
    fn settings_and_sessions_come_back_without_the_scenes_of_a_file() {
        let folder = tempfile::tempdir().unwrap();
        let timed = LossSettings { ask: Ask::Time, seed: 7, ..LossSettings::default() };
        let plain = LossSettings { seed: 7, ..LossSettings::default() };
        let scenes = vec![Model::default().view.scene];
        let file = FileScenes { name: "render.json".to_owned(), path: PathBuf::new(), scenes };
        let mut model = Model::default();
        model.recent = Arc::new(vec![model.session()]);
        let mut storage = SettingsStorage::read(Some(folder.path().to_owned()));
        for (stored, loss) in [(timed.clone(), timed), (plain.with_file(Some(file)), plain)] {
            model.settings = Settings { dark: false, loss: stored, ..Settings::default() };
            storage.store(&model);
            let next = started(folder.path());
            assert_eq!(next.settings, Settings { loss, ..model.settings.clone() });
            assert_eq!(next.recent, model.recent);
            assert_eq!(next.messages.iter().count(), 0);
        }
    }

    #[test]
    fn what_cannot_be_read_is_renamed_and_scales_that_no_window_has_are_brought_into_range() {
        let folder = tempfile::tempdir().unwrap();
        let (file, damaged) = (folder.path().join(FILE), folder.path().join(DAMAGED));
        for text in ["{\"settings\": {\"dark\": tr", "\u{0}", "", "{\"settings\": {\"ui_scale\": \"wide\"}}"]
        {
            std::fs::write(&file, text).unwrap();
            let model = started(folder.path());
            assert_eq!((model.settings, file.exists()), (Settings::default(), false), "{text}");
            assert_eq!(NamedFile::by_user(&damaged).text().unwrap(), text);
            assert!(model.messages.iter().any(|message| message.to_string().contains(DAMAGED)));
        }
        for scale in ["0.0", "-1.0", "1e9", "1e-30"] {
            std::fs::write(&file, format!("{{\"settings\": {{\"dark\": false, \"ui_scale\": {scale}}}}}"))
                .unwrap();
            let model = started(folder.path());
            assert!(UI_SCALE.contains(&model.settings.ui_scale) && !model.settings.dark, "{scale}");
            assert!(model.messages.iter().any(|message| message.to_string().contains("UI scale")), "{scale}");
        }
    }

    #[test]
    fn a_file_that_is_too_large_is_not_read() {
        let folder = tempfile::tempdir().unwrap();
        let file = folder.path().join(FILE);
        let text = r#"{"settings": {"dark": false}}"#;
        for size in [MOST as usize, MOST as usize + 1] {
            std::fs::write(&file, text.to_owned() + &" ".repeat(size - text.len())).unwrap();
            assert_eq!(SettingsStorage::read(Some(folder.path().to_owned())).is_damaged, size as u64 > MOST);
        }
        assert!(!file.exists() && folder.path().join(DAMAGED).exists());
    }
}
