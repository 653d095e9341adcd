//! Storage of the settings and of the last session between two starts.

use eframe::egui;
use serde::Deserialize;

use svbrdf_files::session::Session;

use crate::viewer::model::Model;
use crate::viewer::model::settings::Settings;

/// The key of the settings in the storage.
const SETTINGS: &str = "settings";
/// The key of the session of the last materials from files.
const SESSION: &str = "session";

/// The settings as last stored.
#[derive(Debug)]
pub struct Stored {
    settings: Settings,
    session: Option<Session>,
}

/// The session where earlier versions stored it.
#[derive(Deserialize)]
struct EarlierSettings {
    last: Option<Session>,
}

impl Stored {
    /// Loads what the last start has stored into `model`.
    pub fn load(storage: Option<&dyn eframe::Storage>, model: &mut Model) -> Self {
        if let Some(storage) = storage {
            model.settings = eframe::get_value(storage, SETTINGS).unwrap_or_default();
            let earlier = || eframe::get_value::<EarlierSettings>(storage, SETTINGS)?.last;
            model.last_session = eframe::get_value(storage, SESSION).or_else(earlier);
        }
        Self { settings: model.settings.clone(), session: model.last_session.clone() }
    }

    /// Stores changed settings at once: a program that is killed stores nothing at its end.
    pub fn store_changes(
        &mut self,
        model: &Model,
        ctx: &egui::Context,
        storage: Option<&mut (dyn eframe::Storage + 'static)>,
    ) {
        let is_stored = model.settings == self.settings && model.last_session == self.session;
        if is_stored || ctx.input(|i| i.pointer.any_down()) {
            return;
        }
        self.settings = model.settings.clone();
        self.session = model.last_session.clone();
        if let Some(storage) = storage {
            self.store(model, storage);
            storage.flush();
        }
    }

    /// Stores settings and session.
    pub fn store(&self, model: &Model, storage: &mut dyn eframe::Storage) {
        eframe::set_value(storage, SETTINGS, &model.settings.for_next_start());
        if let Some(session) = &model.last_session {
            eframe::set_value(storage, SESSION, session);
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::collections::HashMap;
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
        let recent = vec!["a b.png".into()];
        let mut model = Model::default();
        model.settings = Settings { dark: false, recent, loss, ..Settings::default() };
        model.last_session = Some(model.session());
        let next = restarted(&model);
        assert_eq!((next.settings, next.last_session), (model.settings, model.last_session));
    }

    #[test]
    fn the_next_start_begins_without_the_scenes_of_a_file() {
        let file = FileScenes { name: "render.json".to_owned(), scenes: Vec::new() };
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
        let last = Some(Model::default().session());
        let mut memory = Memory::default();
        eframe::set_value(&mut memory, SETTINGS, &Earlier { dark: false, last: last.clone() });
        let mut next = Model::default();
        Stored::load(Some(&memory), &mut next);
        assert_eq!((next.settings.dark, next.last_session), (false, last));
    }
}
