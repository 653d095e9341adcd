//! Storage of the settings and of the last session between two starts.

use eframe::egui;
use serde::Deserialize;

use svbrdf_files::session::Session;

use crate::model::Model;
use crate::model::message::Message;
use crate::model::ranges::bring_into_range;
use crate::model::settings::Settings;

/// The key of the settings in the storage.
pub const SETTINGS: &str = "settings";
/// The key of the sessions of the last comparisons.
pub const RECENT: &str = "recent";
/// The key under which earlier versions stored the last session.
pub const SESSION: &str = "session";

/// The settings as last stored.
#[derive(Debug)]
pub struct Stored {
    settings: Settings,
    recent: Vec<Session>,
}

/// The session where still earlier versions stored it.
#[derive(Deserialize)]
struct EarlierSettings {
    last: Option<Session>,
}

impl Stored {
    /// Loads what the last start has stored into `model`; numbers are brought into their ranges.
    pub fn load(storage: Option<&dyn eframe::Storage>, model: &mut Model) -> Self {
        if let Some(storage) = storage {
            model.settings = eframe::get_value(storage, SETTINGS).unwrap_or_default();
            let out_of_range = bring_into_range(model).map(Message::OutOfRange);
            model.report(out_of_range);
            let earlier = || eframe::get_value::<EarlierSettings>(storage, SETTINGS)?.last;
            let last = || eframe::get_value(storage, SESSION).or_else(earlier).into_iter().collect();
            model.recent = eframe::get_value(storage, RECENT).unwrap_or_else(last);
        }
        Self { settings: model.settings.clone(), recent: model.recent.clone() }
    }

    /// Stores changed settings at once: a program that is killed stores nothing at its end.
    pub fn store_changes(
        &mut self,
        model: &Model,
        ctx: &egui::Context,
        storage: Option<&mut (dyn eframe::Storage + 'static)>,
    ) {
        let is_stored = model.settings == self.settings && model.recent == self.recent;
        if is_stored || ctx.input(|i| i.pointer.any_down()) {
            return;
        }
        self.settings = model.settings.clone();
        self.recent = model.recent.clone();
        if let Some(storage) = storage {
            self.store(model, storage);
            storage.flush();
        }
    }

    /// Stores settings and sessions.
    pub fn store(&self, model: &Model, storage: &mut dyn eframe::Storage) {
        eframe::set_value(storage, SETTINGS, &model.settings.for_next_start());
        self.store_sessions(model, storage);
    }

    /// Stores the sessions, and leaves the settings as the last frame that was drawn has stored them: with those of a frame that has
    /// panicked, the next start might panic, too.
    pub fn store_sessions(&self, model: &Model, storage: &mut dyn eframe::Storage) {
        eframe::set_value(storage, RECENT, &model.recent);
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::model::ranges::UI_SCALE;
    use std::collections::HashMap;
    use std::path::PathBuf;
    use svbrdf_core::loss::{Ask, FileScenes, LossSettings};

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

    /// The model of the next start.
    fn restarted(model: &Model) -> Model {
        let (mut memory, mut next) = (Memory::default(), Model::default());
        Stored::load(None, &mut Model::default()).store(model, &mut memory);
        Stored::load(Some(&memory), &mut next);
        next
    }

    #[test]
    fn stored_settings_and_sessions_load_unchanged() {
        let loss = LossSettings { ask: Ask::Time, seed: 7, ..LossSettings::default() };
        let mut model = Model::default();
        model.settings = Settings { dark: false, loss, ..Settings::default() };
        model.recent = vec![model.session()];
        let next = restarted(&model);
        assert_eq!((next.settings, next.recent), (model.settings, model.recent));
    }

    #[test]
    fn the_next_start_begins_without_the_scenes_of_a_file() {
        let file = FileScenes { name: "render.json".to_owned(), path: PathBuf::new(), scenes: Vec::new() };
        let loss = LossSettings { seed: 7, ..LossSettings::default() };
        let mut model = Model::default();
        model.settings.loss = loss.with_file(Some(file));
        assert_eq!(restarted(&model).settings, Settings { loss, ..Settings::default() });
    }

    #[test]
    fn the_session_that_an_earlier_version_stored_within_the_settings_is_found() {
        #[derive(serde::Serialize)]
        struct Earlier {
            dark: bool,
            last: Option<Session>,
        }
        let last = Model::default().session();
        let mut memory = Memory::default();
        eframe::set_value(&mut memory, SETTINGS, &Earlier { dark: false, last: Some(last.clone()) });
        let mut next = Model::default();
        Stored::load(Some(&memory), &mut next);
        assert_eq!((next.settings.dark, next.recent), (false, vec![last]));
    }

    #[test]
    fn a_scale_that_no_window_can_have_is_brought_into_range() {
        for scale in ["0.0", "-1.0", "NaN", "inf", "1000000000.0"] {
            let mut memory = Memory::default();
            memory.0.insert(SETTINGS.to_owned(), format!("(dark: false, ui_scale: {scale})"));
            let mut model = Model::default();
            Stored::load(Some(&memory), &mut model);
            assert!(UI_SCALE.contains(&model.settings.ui_scale) && !model.settings.dark, "{scale}");
            let messages: Vec<_> = model.messages.iter().map(ToString::to_string).collect();
            assert!(messages.len() == 1 && messages[0].contains("UI scale"), "{scale}: {messages:?}");
        }
    }
}
