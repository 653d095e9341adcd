//! Data set of a session, written and opened.

use std::path::{Path, PathBuf};

use svbrdf_core::loss::{ALL_SCENES_TARGET, Request};
use svbrdf_core::progress::Progress;
use svbrdf_evaluate::dataset::{DatasetReading, Method, Source, decided};
use svbrdf_files::session::dataset::{SessionDataset, SessionMethod};

use crate::error::Error;
use crate::model::dataset::{DatasetState, OpenDataset};

impl DatasetState {
    /// What a session has of the data set that is open.
    pub fn session(&self) -> Option<SessionDataset> {
        let open = self.open.as_ref()?;
        let of_session = |all: &[Method]| {
            let one = |one: &Method| SessionMethod { name: one.name.clone(), path: absolute(&one.path) };
            all.iter().map(one).collect()
        };
        let source = &open.settings.source;
        let (methods, predictions) = match source {
            Source::Table(_) => (Vec::new(), Vec::new()),
            Source::Folders { methods, .. } => (of_session(methods), Vec::new()),
            Source::Predictions { predictions, .. } => (Vec::new(), of_session(predictions)),
        };
        Some(SessionDataset {
            ground_truths: absolute(source.path()),
            methods,
            predictions,
            target_error: open.settings.scenes.target().unwrap_or(ALL_SCENES_TARGET),
            seed: open.settings.seed,
            diagnose: open.settings.diagnose,
            read: open.reading.ground_truths,
            read_predictions: open.reading.predictions,
            read_methods: open.reading.methods.clone(),
            list: serde_json::to_value(&self.list).unwrap_or_default(),
            shown: open.name(self.wanted).to_owned(),
            marks: self.marks.clone(),
        })
    }

    /// The data set of a session, whose materials are matched, and registered by their maps; `results` is a folder that a person named.
    /// Where it is `strict`, guesses are errors.
    ///
    /// # Errors
    /// Those of [`OpenDataset::new`] and [`decided`].
    pub fn of_session(
        session: SessionDataset,
        results: Option<PathBuf>,
        strict: bool,
        progress: &Progress,
    ) -> Result<Self, Error> {
        let SessionDataset { ground_truths, methods, predictions, shown, list, marks, .. } = session;
        // Another version may have had other terms.
        let list = serde_json::from_value(list).unwrap_or_default();
        let named = |all: Vec<SessionMethod>| -> Vec<Method> {
            all.into_iter().map(|one| Method { name: one.name, path: one.path }).collect()
        };
        let source = match (methods.is_empty(), predictions.is_empty()) {
            (_, false) => {
                Source::Predictions { ground_truth: ground_truths, predictions: named(predictions) }
            }
            (true, true) => Source::Table(ground_truths),
            (false, true) => Source::Folders { ground_truths, methods: named(methods) },
        };
        let reading = DatasetReading {
            ground_truths: session.read,
            predictions: session.read_predictions,
            methods: session.read_methods,
            strict,
            ..DatasetReading::default()
        };
        let request = Request::Accuracy { target: session.target_error, seed: session.seed };
        let mut open = OpenDataset::new(source, reading, request, results)?;
        open.settings.diagnose = session.diagnose;
        if !open.is_of_predictions() {
            open.reading = decided(&open.cases, open.reading, progress)?;
        }
        let wanted = open.cases.iter().position(|case| case.material == shown).unwrap_or(0);
        Ok(Self { list, wanted, marks, ..open.into() })
    }
}

/// The path from the root on; the path itself where that is not known.
pub fn absolute(path: &Path) -> PathBuf {
    std::path::absolute(path).unwrap_or_else(|_| path.to_owned())
}
