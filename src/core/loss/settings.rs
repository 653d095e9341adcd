//! Saved settings of a loss: the fields of the window's loss section.

use std::path::PathBuf;
use std::time::Duration;

use serde::{Deserialize, Serialize};

use super::request::{Request, Sampling, Texels};
use crate::model::sampler::Sampler;
use crate::model::scene::Scene;

/// What decides how many scenes there are.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
pub enum Ask {
    /// Their numbers.
    Scenes,
    /// The accuracy of the loss.
    #[default]
    Accuracy,
    /// The time.
    Time,
    /// The scenes of a file.
    File,
}

/// The scenes of a file, or of a set with a name.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct FileScenes {
    /// The name of the file or of the set; empty where they have none.
    #[serde(default)]
    pub name: String,
    /// The file itself, where it has been read; empty for a set, and in a session, which holds its scenes.
    #[serde(skip)]
    pub path: PathBuf,
    /// At least one.
    pub scenes: Vec<Scene>,
}

impl FileScenes {
    fn check(&self) -> Result<(), String> {
        if self.scenes.is_empty() {
            return Err("file.scenes: expected at least one scene, found none".to_owned());
        }
        let unusable = |(number, scene): (usize, &Scene)| {
            scene.check().err().map(|problem| format!("file.scenes: scene {number}: {problem}"))
        };
        self.scenes.iter().enumerate().find_map(unusable).map_or(Ok(()), Err)
    }
}

/// How a loss is asked for. What the other ways of asking need is kept.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(default)]
pub struct LossSettings {
    pub ask: Ask,
    pub near: usize,
    pub distant: usize,
    pub sampler: Sampler,
    pub texels: Texels,
    pub seed: u64,
    /// Half of the 95% interval, in percent of the loss.
    pub target_percent: f64,
    pub time_ms: u64,
    /// `None` where no scene file has been opened; an accuracy is asked for then in place of [`Ask::File`].
    #[serde(skip_serializing_if = "Option::is_none")]
    pub file: Option<FileScenes>,
}

impl Default for LossSettings {
    fn default() -> Self {
        let Sampling { near, distant, sampler, texels, seed } = Sampling::default();
        Self {
            ask: Ask::Accuracy,
            near,
            distant,
            sampler,
            texels,
            seed,
            target_percent: 1.0,
            time_ms: 100,
            file: None,
        }
    }
}

impl LossSettings {
    /// Checks the numbers of a file.
    ///
    /// # Errors
    /// The field, what was expected and what was found.
    pub fn check(&self) -> Result<(), String> {
        let target = self.target_percent;
        if !(target > 0.0 && target <= 100.0) {
            return Err(format!(
                "target_percent: expected a percentage above 0 and at most 100, found {target}"
            ));
        }
        if self.texels == Texels::Sampled(0) {
            return Err("texels: expected \"all\" or at least one sampled texel, found 0".to_owned());
        }
        self.file.as_ref().map_or(Ok(()), FileScenes::check)
    }

    /// What is asked for; fields that are not shown do not influence it.
    pub fn request(&self) -> Request {
        let Self { near, distant, seed, sampler, texels, .. } = *self;
        match self.ask {
            Ask::Scenes => Request::Scenes(Sampling { near, distant, seed, sampler, texels }),
            Ask::Accuracy => Request::Accuracy { target: self.target_percent / 100.0, seed },
            Ask::Time => Request::Time { budget: Duration::from_millis(self.time_ms), seed },
            Ask::File => match &self.file {
                Some(file) => Request::Listed(file.scenes.clone()),
                None => Request::Accuracy { target: self.target_percent / 100.0, seed },
            },
        }
    }

    /// The scenes of the file, where they are those of the loss.
    pub fn file_scenes(&self) -> Option<&FileScenes> {
        self.file.as_ref().filter(|_| self.ask == Ask::File)
    }

    /// These settings with the scenes of a file; `None`: without them.
    #[must_use]
    pub fn with_file(&self, file: Option<FileScenes>) -> Self {
        let ask = match (&file, self.ask) {
            (Some(_), _) => Ask::File,
            (None, Ask::File) => Ask::default(),
            (None, ask) => ask,
        };
        Self { ask, file, ..self.clone() }
    }
}

impl LossSettings {
    /// The scenes and texels; `None` where an accuracy or a time decides them.
    pub fn sampling(&self) -> Option<Sampling> {
        self.request().sampling()
    }

    /// The request for the scenes that are listed one by one, on all texels: those of the loss where it has few or they are of a
    /// file, otherwise 128 near-field and 64 distant ones of its seed.
    pub fn listed_scenes(&self) -> Request {
        /// Most sampled scenes that are listed.
        const MOST: usize = 1000;
        if let Some(file) = self.file_scenes() {
            return Request::Listed(file.scenes.clone());
        }
        let few = self.sampling().filter(|sampling| (1..=MOST).contains(&(sampling.near + sampling.distant)));
        let default = Sampling { seed: self.seed, ..Sampling::LISTED };
        Request::Scenes(Sampling { texels: Texels::All, ..few.unwrap_or(default) })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_default_is_an_accuracy_of_1_percent_and_hidden_fields_change_no_request() {
        assert_eq!(LossSettings::default().request(), Request::Accuracy { target: 0.01, seed: 0 });
        let settings = LossSettings { ask: Ask::Scenes, ..LossSettings::default() };
        let request = settings.request();
        assert_eq!(request, Request::default(), "the scenes are those of the papers");
        for ask in [Ask::Accuracy, Ask::Time] {
            let settings = LossSettings { ask, ..settings.clone() };
            let other = LossSettings {
                near: 60,
                distant: 2,
                sampler: Sampler::Sobol,
                texels: Texels::Sampled(9),
                ..settings.clone()
            };
            assert_eq!(settings.request(), other.request());
            assert_ne!(settings.request(), request);
        }
    }

    #[test]
    fn the_scenes_of_a_file_are_asked_for_until_they_are_removed() {
        let scenes = Sampler::Random.scenes(1, 2, 1, &crate::model::convention::PRINTED);
        let file =
            FileScenes { name: "render.json".to_owned(), path: PathBuf::new(), scenes: scenes.clone() };
        let settings = LossSettings { seed: 5, ..LossSettings::default() };
        let with = settings.with_file(Some(file.clone()));
        assert_eq!(
            (with.request(), with.listed_scenes()),
            (Request::Listed(scenes.clone()), Request::Listed(scenes))
        );
        assert_eq!(with.file_scenes(), Some(&file));
        let other = LossSettings { ask: Ask::Time, ..with.clone() };
        assert_eq!(other.file_scenes(), None);
        assert_eq!(other.with_file(None).ask, Ask::Time);
        assert_eq!(with.with_file(None), settings);
    }
}
