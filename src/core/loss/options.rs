//! Options of a loss: what the command line, Python and sessions specify of it.

use std::str::FromStr;
use std::time::Duration;

use serde::de::Error as _;
use serde::{Deserialize, Deserializer};

use super::adaptive::{NEAR_PER_DISTANT, TEXELS};
use super::request::{Request, Sampling, Texels};
use super::settings::{FileScenes, LossSettings};
use crate::error::Error;
use crate::model::named_scenes::NamedScenes;
use crate::model::sampler::Sampler;

/// The options of sampled scenes.
const SAMPLED: [&str; 4] = ["near", "distant", "sampler", "texels"];

/// What is specified of a loss; `None` is left open. The command line parses into it, Python passes it as JSON, and it is laid over the
/// settings of a session.
///
/// The number of scenes follows from `near` and `distant`, `target_error`, `time_budget` or `file`. These exclude each other, and
/// options that the one does not use are refused.
#[derive(Clone, Debug, Default, PartialEq, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct LossOptions {
    /// The number of near-field scenes.
    pub near: Option<usize>,
    /// The number of distant scenes.
    pub distant: Option<usize>,
    /// Names the sampled scenes; 0 where left open.
    pub seed: Option<u64>,
    #[serde(deserialize_with = "by_name")]
    pub sampler: Option<Sampler>,
    #[serde(deserialize_with = "by_name")]
    pub texels: Option<Texels>,
    /// Half of the 95% interval, as a share of the loss; in JSON at most 0.1, since more may be meant in percent.
    #[serde(deserialize_with = "share")]
    pub target_error: Option<f64>,
    /// In JSON seconds, at most a day.
    #[serde(deserialize_with = "seconds")]
    pub time_budget: Option<Duration>,
    /// The scenes themselves.
    pub file: Option<FileScenes>,
}

fn by_name<'de, D: Deserializer<'de>, T: FromStr<Err = Error>>(
    deserializer: D,
) -> Result<Option<T>, D::Error> {
    let name: Option<String> = Option::deserialize(deserializer)?;
    name.map(|name| name.parse()).transpose().map_err(D::Error::custom)
}

fn seconds<'de, D: Deserializer<'de>>(deserializer: D) -> Result<Option<Duration>, D::Error> {
    let seconds = among(deserializer, 86_400.0, "expected seconds above 0, at most a day")?;
    Ok(seconds.map(Duration::from_secs_f64))
}

fn share<'de, D: Deserializer<'de>>(deserializer: D) -> Result<Option<f64>, D::Error> {
    among(deserializer, 0.1, "expected a share above 0, at most 0.1, such as 0.01 for 1%")
}

/// A number above 0 and at most `most`.
fn among<'de, D: Deserializer<'de>>(
    deserializer: D,
    most: f64,
    expected: &str,
) -> Result<Option<f64>, D::Error> {
    match Option::<f64>::deserialize(deserializer)? {
        Some(found) if !(found > 0.0 && found <= most) => {
            Err(D::Error::custom(format!("{expected}, found {found}")))
        }
        number => Ok(number),
    }
}

impl LossOptions {
    /// What is asked for with these. Where nothing decides the number of scenes it is the loss over all scenes to +-1% at 95%
    /// confidence, whose scenes are Sobol with random texels; with a number of them, the rest is random and all texels.
    ///
    /// # Errors
    /// [`Error::SceneCount`]; [`Error::UnusedOption`]; [`Error::NoSceneCount`] where a sampler or texels are specified that an accuracy
    /// does not have.
    pub fn request(&self) -> Result<Request, Error> {
        self.check()?;
        let seed = self.seed.unwrap_or(0);
        match (&self.file, self.target_error, self.time_budget) {
            (Some(file), ..) => Ok(Request::Listed(file.scenes.clone())),
            (_, Some(target), _) => Ok(Request::Accuracy { target, seed }),
            (.., Some(budget)) => Ok(Request::Time { budget, seed }),
            _ if self.is_open() => self.check_open().map(|()| Request::over_all_scenes(seed)),
            _ => self.sampled(Sampling::default()),
        }
    }

    /// Whether nothing decides the number of scenes.
    pub fn is_open(&self) -> bool {
        let Self { near, distant, target_error, time_budget, file, .. } = self;
        near.or(*distant).is_none() && target_error.is_none() && time_budget.is_none() && file.is_none()
    }

    /// The request for scenes that are listed one by one, on all texels: [`Sampling::LISTED`] where nothing else is specified.
    ///
    /// # Errors
    /// As [`LossOptions::request`].
    pub fn listed(&self) -> Result<Request, Error> {
        self.check()?;
        match &self.file {
            Some(file) => Ok(Request::Listed(file.scenes.clone())),
            None => self.sampled(Sampling::LISTED),
        }
    }

    /// What is asked for with these in place of `saved` settings, which count where the number of scenes is left open.
    ///
    /// # Errors
    /// As [`LossOptions::request`].
    pub fn over(&self, saved: &LossSettings) -> Result<Request, Error> {
        let seed = self.seed.unwrap_or(saved.seed);
        if !self.is_open() {
            return Ok(self.request()?.of_seed(seed));
        }
        match saved.request().of_seed(seed) {
            listed @ Request::Listed(_) => {
                self.refuse(&["seed", "sampler", "texels"], "the session lists its scenes").map(|()| listed)
            }
            Request::Scenes(sampling) => self.sampled(sampling),
            request => self.check_open().map(|()| request),
        }
    }

    /// The numbers or the list of scenes as the command line has them. A list without a file or a name is called SCENES.json.
    pub fn words(&self) -> Vec<String> {
        let Self { near, distant, sampler, file, .. } = self;
        let list = file.iter().flat_map(|FileScenes { path, scenes, .. }| {
            let path = Some(path.display().to_string()).filter(|path| !path.is_empty());
            let Some(named) = NamedScenes::of(scenes).filter(|_| path.is_none()) else {
                return vec![("scenes", path.unwrap_or_else(|| "SCENES.json".to_owned()))];
            };
            let mut words = vec![("lights", named.name().to_owned())];
            if let NamedScenes::Flash { fov_degrees } = named {
                // It follows from the place of the light, which is rounded.
                let fov = (fov_degrees * 1e9).round() / 1e9;
                words.extend((fov != NamedScenes::FOV_DEGREES).then(|| ("fov", fov.to_string())));
            }
            words
        });
        let numbers = [("near", near), ("distant", distant)];
        let numbers = numbers.into_iter().filter_map(|(name, number)| Some((name, (*number)?.to_string())));
        let sampler = sampler.map(|sampler| ("sampler", sampler.to_string()));
        let all = numbers.chain(sampler).chain(list);
        all.flat_map(|(name, value)| [format!("--{name}"), value]).collect()
    }

    /// Sampled scenes, where left open as of `usual`.
    fn sampled(&self, usual: Sampling) -> Result<Request, Error> {
        let [near, distant] = counts([self.near, self.distant], [usual.near, usual.distant]);
        let (sampler, texels) = (self.sampler.unwrap_or(usual.sampler), self.texels.unwrap_or(usual.texels));
        let sampling = Sampling { near, distant, seed: self.seed.unwrap_or(usual.seed), sampler, texels };
        sampling.check()?;
        Ok(Request::Scenes(sampling))
    }

    /// Refuses options that what decides the scenes does not use.
    fn check(&self) -> Result<(), Error> {
        if self.file.is_some() {
            self.refuse(&["target_error", "time_budget", "seed"], "the scenes are a fixed list")?;
            self.refuse(&SAMPLED, "the scenes are a fixed list")
        } else if self.target_error.is_some() {
            self.refuse(&["time_budget"], "the target error decides the scenes")?;
            self.refuse(&SAMPLED, "the target error decides the scenes")
        } else if self.time_budget.is_some() {
            self.refuse(&SAMPLED, "the time budget decides the scenes")
        } else {
            Ok(())
        }
    }

    /// The names of the options that are not left open; a list of scenes with a name is called `lights`.
    pub fn specified(&self) -> impl Iterator<Item = &'static str> {
        let Self { near, distant, seed, sampler, texels, target_error, time_budget, file } = self;
        let is_named = |file: &FileScenes| file.path.as_os_str().is_empty() && !file.name.is_empty();
        let list = if file.as_ref().is_some_and(is_named) { "lights" } else { "scenes" };
        let all = [
            ("near", near.is_some()),
            ("distant", distant.is_some()),
            ("seed", seed.is_some()),
            ("sampler", sampler.is_some()),
            ("texels", texels.is_some()),
            ("target_error", target_error.is_some()),
            ("time_budget", time_budget.is_some()),
            (list, file.is_some()),
        ];
        all.into_iter().filter(|(_, is_specified)| *is_specified).map(|(option, _)| option)
    }

    /// Refuses these options.
    fn refuse(&self, unused: &[&'static str], reason: &'static str) -> Result<(), Error> {
        match self.specified().find(|option| unused.contains(option)) {
            Some(option) => Err(Error::UnusedOption { option, reason }),
            None => Ok(()),
        }
    }

    /// Whether a run to an accuracy has this sampler and these texels.
    fn check_open(&self) -> Result<(), Error> {
        let sampler =
            self.sampler.filter(|sampler| *sampler != Sampler::Sobol).map(|one| format!("sampler {one}"));
        let texels = self
            .texels
            .filter(|texels| *texels != Texels::Sampled(TEXELS))
            .map(|one| format!("texels {one}"));
        match sampler.or(texels) {
            Some(found) => Err(Error::NoSceneCount { found }),
            None => Ok(()),
        }
    }
}

/// The numbers of near-field and distant scenes. Where one is left open, there are two near-field scenes for each distant one, as in
/// Algorithm 1; `usual` where both are.
fn counts(specified: [Option<usize>; 2], usual: [usize; 2]) -> [usize; 2] {
    match specified {
        [None, None] => usual,
        [Some(near), None] => [near, near.div_ceil(NEAR_PER_DISTANT)],
        [None, Some(distant)] => [distant.saturating_mul(NEAR_PER_DISTANT), distant],
        [Some(near), Some(distant)] => [near, distant],
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::loss::Ask;

    #[test]
    fn a_choice_without_a_number_of_scenes_leaves_the_accuracy() {
        for (sampler, texels) in [
            (None, None),
            (Some(Sampler::Sobol), None),
            (None, Some(Texels::Sampled(TEXELS))),
            (Some(Sampler::Sobol), Some(Texels::Sampled(TEXELS))),
        ] {
            let choice = LossOptions { sampler, texels, seed: Some(7), ..LossOptions::default() };
            assert_eq!(choice.request().unwrap(), Request::Accuracy { target: 0.01, seed: 7 });
        }
        for (sampler, texels, found) in [
            (Some(Sampler::Random), None, "sampler random"),
            (None, Some(Texels::Sampled(64)), "texels 64"),
            (Some(Sampler::Sobol), Some(Texels::All), "texels all"),
        ] {
            let error = LossOptions { sampler, texels, ..LossOptions::default() }.request().unwrap_err();
            assert!(error.to_string().contains(found), "{error}");
        }
    }

    #[test]
    fn what_is_saved_counts_where_a_number_of_scenes_is_left_open() {
        let accuracy = LossSettings { target_percent: 0.3, seed: 5, ..LossSettings::default() };
        let sobol = LossOptions { sampler: Some(Sampler::Sobol), ..LossOptions::default() };
        assert_eq!(sobol.over(&accuracy).unwrap(), accuracy.request());
        let saved = LossSettings { ask: Ask::Scenes, near: 40, distant: 9, ..accuracy.clone() };
        let expected = LossSettings { sampler: Sampler::Sobol, ..saved.clone() };
        assert_eq!(sobol.over(&saved).unwrap(), expected.request());
        let near = LossOptions { near: Some(8), ..sobol.clone() };
        let seeded = LossOptions { seed: Some(5), ..near.clone() };
        assert_eq!(near.over(&accuracy).unwrap(), seeded.request().unwrap());
        let seed = LossOptions { seed: Some(7), ..LossOptions::default() };
        assert_eq!(seed.over(&saved).unwrap().seed(), Some(7));
        let scenes = Sampler::Random.scenes(1, 2, 1, &crate::model::convention::PRINTED);
        let listed = saved.with_file(Some(FileScenes { name: String::new(), path: "".into(), scenes }));
        assert_eq!(LossOptions::default().over(&listed).unwrap(), listed.request());
        for options in [seed, sobol] {
            let refused = options.over(&listed).unwrap_err().to_string();
            assert!(refused.contains("the session lists its scenes"), "{refused}");
        }
    }

    #[test]
    fn scenes_have_the_words_of_the_command_line() {
        let list = |path: &str, scenes| Some(FileScenes { name: String::new(), path: path.into(), scenes });
        let flash = |fov_degrees| NamedScenes::Flash { fov_degrees }.scenes().unwrap();
        let other = Sampler::Random.scenes(1, 2, 1, &crate::model::convention::PRINTED);
        for (near, sampler, file, expected) in [
            (Some(8), Some(Sampler::Sobol), None, "--near 8 --sampler sobol"),
            (None, None, list("a/b.json", flash(45.0)), "--scenes a/b.json"),
            (None, None, list("", flash(45.0)), "--lights flash"),
            (None, None, list("", flash(30.1)), "--lights flash --fov 30.1"),
            (None, None, list("", NamedScenes::Flash9.scenes().unwrap()), "--lights flash-9"),
            (None, None, list("", other), "--scenes SCENES.json"),
        ] {
            let options = LossOptions { near, sampler, file, ..LossOptions::default() };
            assert_eq!(options.words().join(" "), expected);
        }
    }

    #[test]
    fn options_that_the_scenes_do_not_use_are_refused() {
        let scenes = r#""file": {"scenes": [{"kind": "near", "view": [0, 0, 2], "light": [0, 1, 1]}]}"#;
        let sampled = [r#""near": 3"#, r#""distant": 3"#, r#""sampler": "sobol""#, r#""texels": "9""#];
        let [seed, target, time] = [r#""seed": 3"#, r#""target_error": 0.1"#, r#""time_budget": 0.5"#];
        let question = |fields: &[&str]| {
            let text = format!("{{{}}}", fields.join(", "));
            serde_json::from_str::<LossOptions>(&text).unwrap().request()
        };
        for (deciding, unused) in [
            (scenes, [&sampled[..], &[seed, target, time]].concat()),
            (target, [&sampled[..], &[time]].concat()),
            (time, sampled.to_vec()),
        ] {
            assert!(question(&[deciding]).is_ok(), "{deciding}");
            for option in unused {
                let name = option[1..].split('"').next().unwrap();
                let refused = question(&[deciding, option]).unwrap_err().to_string();
                assert!(refused.ends_with(&format!("leave out {name}")), "{deciding}, {option}: {refused}");
            }
        }
        assert_eq!(
            question(&[time, seed]).unwrap(),
            Request::Time { budget: Duration::from_millis(500), seed: 3 }
        );
        for wrong in [
            r#""near": -1"#,
            r#""sampler": "halton""#,
            r#""texels": "0""#,
            r#""target_error": 0.11"#,
            r#""target_error": 0"#,
            r#""time_budget": -1"#,
            r#""time_budget": 86401"#,
            r#""what": 1"#,
        ] {
            assert!(serde_json::from_str::<LossOptions>(&format!("{{{wrong}}}")).is_err(), "{wrong}");
        }
    }

    #[test]
    fn one_number_of_scenes_keeps_the_proportion_of_two_to_one() {
        let counts = |near, distant| {
            let choice = LossOptions { near, distant, seed: Some(3), ..LossOptions::default() };
            match choice.request().unwrap() {
                Request::Scenes(Sampling {
                    near,
                    distant,
                    seed: 3,
                    sampler: Sampler::Random,
                    texels: Texels::All,
                }) => [near, distant],
                other => panic!("{other:?}"),
            }
        };
        for n in 1..200 {
            assert_eq!(counts(Some(2 * n), None), [2 * n, n]);
            assert_eq!(counts(Some(2 * n - 1), None), [2 * n - 1, n]);
            assert_eq!(counts(None, Some(n)), [2 * n, n]);
            assert_eq!(counts(Some(n), Some(0)), [n, 0]);
        }
        assert!(LossOptions { near: Some(0), ..LossOptions::default() }.request().is_err());
        assert!(LossOptions { distant: Some(usize::MAX), ..LossOptions::default() }.request().is_err());
    }
}
