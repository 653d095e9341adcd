//! The question that a loss answers: one request, and the few scenes whose loss is reported beside it.

use super::adaptive::NEAR_PER_DISTANT;
use super::request::{Request, Sampling};

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

/// The numbers of near-field and distant scenes. Where one is left open, there are two near-field scenes for each distant one, as in
/// Algorithm 1; `usual` where both are.
pub(super) fn counts(specified: [Option<usize>; 2], usual: [usize; 2]) -> [usize; 2] {
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

    #[test]
    fn the_scenes_of_the_papers_are_not_beside_themselves() {
        let few = Question::from(Request::default());
        assert_eq!(few.few_scenes, None);
        assert_eq!(few.clone().beside_few_scenes(0), few);
        assert!(few.beside_few_scenes(1).few_scenes.is_some_and(|few| few.seed == 1));
    }
}
