//! The question that a loss answers: one request, and the few scenes whose loss is reported beside it.

use super::adaptive::{NEAR_PER_DISTANT, TEXELS};
use super::request::{Request, Sampling, Texels};
use crate::error::Error;
use crate::model::sampler::Sampler;

/// A request and, beside it, few scenes.
#[derive(Clone, Debug, PartialEq)]
pub struct Question {
    /// Its losses are the answer.
    pub request: Request,
    /// The scenes of the loss that is reported beside the answer; `None` where the request chooses its scenes.
    pub few_scenes: Option<Sampling>,
}

impl Question {
    /// The loss over all scenes to +-1% at 95% confidence and, beside it, the loss over the 6 near-field and 3 distant random
    /// scenes of the papers. `seed` names the scenes of both.
    pub fn of_seed(seed: u64) -> Self {
        let request = Request::Accuracy { target: super::ALL_SCENES_TARGET, seed };
        Self::from(request).beside_few_scenes(seed)
    }

    /// The same request with the 6 + 3 scenes of the papers beside it, unless it asks for just these.
    #[must_use]
    pub fn beside_few_scenes(self, seed: u64) -> Self {
        let few = Sampling { seed, ..Sampling::default() };
        let few_scenes = (self.request != Request::Scenes(few)).then_some(few);
        Self { few_scenes, ..self }
    }
}

/// What is specified about sampled scenes; `None` is left open. The command line, Python and saved settings decide by it.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct SceneChoice {
    /// The number of near-field scenes.
    pub near: Option<usize>,
    /// The number of distant scenes.
    pub distant: Option<usize>,
    pub sampler: Option<Sampler>,
    pub texels: Option<Texels>,
}

impl SceneChoice {
    /// The question that is asked with this. Without a number of scenes it is [`Question::of_seed`], whose scenes are Sobol with 128
    /// random texels each; with one, the rest is random and all texels.
    ///
    /// # Errors
    /// [`Error::SceneCount`]; [`Error::NoSceneCount`] where a sampler or texels are specified that an accuracy does not have.
    pub fn question(self, seed: u64) -> Result<Question, Error> {
        let usual = Sampling::default();
        if self.near.is_none() && self.distant.is_none() {
            return self.check_open().map(|()| Question::of_seed(seed));
        }
        let [near, distant] = self.counts([usual.near, usual.distant]);
        let (sampler, texels) = (self.sampler.unwrap_or(usual.sampler), self.texels.unwrap_or(usual.texels));
        let sampling = Sampling { near, distant, seed, sampler, texels };
        sampling.check()?;
        Ok(Request::Scenes(sampling).into())
    }

    /// The question that is asked with this in place of a `saved` request: without a number of scenes, the saved one counts.
    ///
    /// # Errors
    /// As [`SceneChoice::question`].
    pub fn over(self, saved: Request) -> Result<Question, Error> {
        let seed = saved.seed().unwrap_or(0);
        match saved {
            _ if self.near.is_some() || self.distant.is_some() => self.question(seed),
            Request::Listed(_) => self.question(seed),
            Request::Scenes(sampling) => {
                let (sampler, texels) =
                    (self.sampler.unwrap_or(sampling.sampler), self.texels.unwrap_or(sampling.texels));
                Ok(Request::Scenes(Sampling { sampler, texels, ..sampling }).into())
            }
            Request::Accuracy { .. } | Request::Time { .. } => self.check_open().map(|()| saved.into()),
        }
    }

    /// The numbers of near-field and distant scenes. Where one is left open, there are two near-field scenes for each distant one, as in
    /// Algorithm 1; `usual` where both are.
    pub fn counts(self, usual: [usize; 2]) -> [usize; 2] {
        match (self.near, self.distant) {
            (None, None) => usual,
            (Some(near), None) => [near, near.div_ceil(NEAR_PER_DISTANT)],
            (None, Some(distant)) => [distant.saturating_mul(NEAR_PER_DISTANT), distant],
            (Some(near), Some(distant)) => [near, distant],
        }
    }

    /// Whether a run to an accuracy has this sampler and these texels.
    fn check_open(self) -> Result<(), Error> {
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

/// [`Question::of_seed`] 0: what the command line, the window and Python answer where nothing else is asked.
impl Default for Question {
    fn default() -> Self {
        Self::of_seed(0)
    }
}

impl From<Request> for Question {
    fn from(request: Request) -> Self {
        Self { request, few_scenes: None }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::loss::LossSettings;

    #[test]
    fn the_default_is_1_percent_with_the_scenes_of_the_papers_beside_it_in_the_window_too() {
        let Question { request, few_scenes } = Question::of_seed(7);
        assert_eq!(request, Request::Accuracy { target: 0.01, seed: 7 });
        assert_eq!(few_scenes, Some(Sampling { near: 6, distant: 3, seed: 7, ..Sampling::default() }));
        assert_eq!(LossSettings::default().question(), Question::default());
    }

    #[test]
    fn a_choice_without_a_number_of_scenes_leaves_the_accuracy() {
        for (sampler, texels) in [
            (None, None),
            (Some(Sampler::Sobol), None),
            (None, Some(Texels::Sampled(TEXELS))),
            (Some(Sampler::Sobol), Some(Texels::Sampled(TEXELS))),
        ] {
            let choice = SceneChoice { sampler, texels, ..SceneChoice::default() };
            assert_eq!(choice.question(7).unwrap(), Question::of_seed(7));
        }
        for (sampler, texels, found) in [
            (Some(Sampler::Random), None, "sampler random"),
            (None, Some(Texels::Sampled(64)), "texels 64"),
            (Some(Sampler::Sobol), Some(Texels::All), "texels all"),
        ] {
            let error = SceneChoice { sampler, texels, ..SceneChoice::default() }.question(0).unwrap_err();
            assert!(error.to_string().contains(found), "{error}");
        }
    }

    #[test]
    fn what_is_saved_counts_where_a_number_of_scenes_is_left_open() {
        let sobol = SceneChoice { sampler: Some(Sampler::Sobol), ..SceneChoice::default() };
        let accuracy = Request::Accuracy { target: 0.003, seed: 5 };
        assert_eq!(sobol.over(accuracy.clone()).unwrap().request, accuracy);
        let saved = Sampling { near: 40, distant: 9, seed: 5, ..Sampling::default() };
        let expected = Request::Scenes(Sampling { sampler: Sampler::Sobol, ..saved });
        assert_eq!(sobol.over(Request::Scenes(saved)).unwrap().request, expected);
        let near = SceneChoice { near: Some(8), ..sobol };
        assert_eq!(near.over(accuracy).unwrap(), near.question(5).unwrap());
    }

    #[test]
    fn one_number_of_scenes_keeps_the_proportion_of_two_to_one() {
        let counts = |near, distant| {
            let choice = SceneChoice { near, distant, ..SceneChoice::default() };
            match choice.question(3).unwrap().request {
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
        assert!(SceneChoice { near: Some(0), ..SceneChoice::default() }.question(0).is_err());
        assert!(SceneChoice { distant: Some(usize::MAX), ..SceneChoice::default() }.question(0).is_err());
    }

    #[test]
    fn the_scenes_of_the_papers_are_not_beside_themselves() {
        let few = Question::from(Request::default());
        assert_eq!(few.few_scenes, None);
        assert_eq!(few.clone().beside_few_scenes(0), few);
        assert!(few.beside_few_scenes(1).few_scenes.is_some_and(|few| few.seed == 1));
    }
}
