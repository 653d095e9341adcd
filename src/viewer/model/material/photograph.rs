//! Photograph of the window, and the others that are listed with it.

use std::path::PathBuf;

use svbrdf_core::model::scene::Scene;
use svbrdf_files::disk::stamp::Stamp;
use svbrdf_files::photograph::{Capture, SessionPhotograph};

/// The photograph that renderings are compared with.
#[derive(Clone, Debug, Default)]
pub struct PhotographState {
    source: Option<SessionPhotograph>,
    /// Of its file when it was opened: a file that has changed since is another photograph.
    stamp: Option<Stamp>,
    /// Where it is one of several, all of them.
    capture: Option<Capture>,
}

impl PhotographState {
    /// Opens the photograph at `path`; light and view of the first where `path` is that of several.
    pub fn open(&mut self, path: PathBuf, capture: Option<Capture>) -> Option<Scene> {
        let is_one = capture.is_none();
        self.capture = capture;
        self.set(is_one.then_some(SessionPhotograph { path, transfer: None, falloff: false }));
        self.choose(0)
    }

    /// Opens the photograph of this number of those that are listed; its light and view.
    pub fn choose(&mut self, index: usize) -> Option<Scene> {
        let capture = self.capture.as_ref()?;
        let one = capture.photographs.get(index)?;
        let (path, scene) = (one.file.path().to_owned(), one.scene);
        self.set(Some(SessionPhotograph { path, transfer: one.transfer, falloff: capture.falloff }));
        Some(scene)
    }

    /// Opens another photograph, or closes the one that is open.
    pub fn set(&mut self, source: Option<SessionPhotograph>) {
        self.stamp = source.as_ref().and_then(|source| Stamp::of(&source.path));
        self.source = source;
    }

    /// The photograph that is open.
    pub fn source(&self) -> Option<&SessionPhotograph> {
        self.source.as_ref()
    }

    /// Changes how the photograph that is open is used.
    pub fn change(&mut self, change: impl FnOnce(&mut SessionPhotograph)) {
        self.source.as_mut().map(change);
    }

    /// The stamp of its file when it was opened.
    pub fn stamp(&self) -> Option<Stamp> {
        self.stamp
    }

    /// The names of all photographs where it is one of several, and its number.
    pub fn listed(&self) -> Option<(Vec<&str>, usize)> {
        let (source, all) = (self.source.as_ref()?, &self.capture.as_ref()?.photographs);
        let number = all.iter().position(|one| one.file.path() == source.path)?;
        Some((all.iter().map(|one| one.name.as_str()).collect(), number))
    }
}
