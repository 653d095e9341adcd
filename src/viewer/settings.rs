//! What is remembered from one start to the next.

use std::path::{Path, PathBuf};

use serde::{Deserialize, Serialize};

use super::loss_settings::LossSettings;

/// Under this key the settings are stored.
pub const KEY: &str = "settings";
/// How many opened materials are remembered.
const RECENT: usize = 12;

/// Persisted; every field has a default, so that settings of an older version still load.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(default)]
pub struct Settings {
    pub dark: bool,
    pub side_panel: bool,
    /// Whether a left-drag puts the highlight, not the light, under the pointer.
    pub highlight_follows: bool,
    /// Whether the loss is computed again whenever something that it depends on changes.
    pub auto_loss: bool,
    pub loss: LossSettings,
    /// Whether files that change on the disk are read again.
    pub watch: bool,
    /// Materials opened before, the latest first.
    pub recent: Vec<PathBuf>,
}

impl Default for Settings {
    fn default() -> Self {
        Self {
            dark: true,
            side_panel: true,
            highlight_follows: false,
            auto_loss: true,
            loss: LossSettings::default(),
            watch: false,
            recent: Vec::new(),
        }
    }
}

impl Settings {
    /// Puts `path` first among the recent ones, in a form that holds wherever the program is started next.
    pub fn remember(&mut self, path: &Path) {
        let path = std::path::absolute(path).unwrap_or_else(|_| path.to_owned());
        self.recent.retain(|p| *p != path);
        self.recent.insert(0, path);
        self.recent.truncate(RECENT);
    }
}

#[cfg(test)]
mod tests {
    use std::collections::HashMap;

    use super::*;

    #[derive(Default)]
    struct Memory(HashMap<String, String>);

    impl eframe::Storage for Memory {
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

    #[test]
    fn settings_are_the_same_when_they_are_stored_and_loaded() {
        let settings = Settings { dark: false, recent: vec!["a b.png".into()], ..Settings::default() };
        let mut memory = Memory::default();
        eframe::set_value(&mut memory, KEY, &settings);
        assert_eq!(eframe::get_value::<Settings>(&memory, KEY), Some(settings));
    }
}
