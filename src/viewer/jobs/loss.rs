//! Loss of the predictions: asked for the current materials and settings, and refined until it answers the question.

use std::sync::Arc;
use std::time::{Duration, Instant};

use svbrdf_core::loss::{Comparison, Estimate, Loss, Outcome, Request};
use svbrdf_core::material::Material;
use svbrdf_evaluate::analyses::LossReport;

use crate::error::Error;
use crate::jobs::answers::content::{Content, Given, read_all};
use crate::jobs::answers::{Answer, Answered, Answers, Question, Work};
use crate::model::material::list::MaterialList;
use crate::model::settings::LossQuery;

/// Progress and staleness are shown after this time: what takes less would only flicker.
const SOON: Duration = Duration::from_millis(100);

/// The losses of predictions. The ground truth is the first of the materials.
#[derive(Clone, Debug, PartialEq)]
pub struct ComputeLosses {
    materials: Vec<Content>,
    names: Given<Vec<String>>,
    query: LossQuery,
}

/// Losses, complete or so far, or why there are none.
pub type LossAnswer = Result<ComputedLosses, String>;

/// Losses, complete or so far.
#[derive(Debug)]
pub struct ComputedLosses {
    /// What they answer.
    pub request: Request,
    pub report: LossReport,
    /// `differences[a][b]`: the loss of prediction b minus that of a, on the same scenes.
    pub differences: Vec<Vec<Estimate>>,
}

impl ComputeLosses {
    fn of(materials: &MaterialList, query: &LossQuery) -> Self {
        let names = materials.all.iter().map(|one| one.name().to_owned()).collect();
        Self { materials: Content::all(&materials.all), names: Given(names), query: query.clone() }
    }

    /// Computes the losses, and tells of those on the way.
    fn run(&self, work: &Work<'_, LossAnswer>) -> Result<ComputedLosses, Error> {
        let LossQuery { request, convention } = &self.query;
        let named = self.names.0.iter().zip(read_all(&self.materials)?);
        let materials: Vec<Material<f32>> =
            named.map(|(name, read)| read.material().clone().renamed(name.clone())).collect();
        let materials: Vec<&Material<f32>> = materials.iter().collect();
        let comparison = Comparison::new(materials[0], &materials[1..], *convention)?;
        let report = |outcome: Outcome| {
            let report = LossReport::new(&comparison, request, outcome);
            ComputedLosses { request: request.clone(), differences: differences(&report), report }
        };
        let mut last = None;
        comparison.stream(request, work.progress(), |outcome: &Outcome| {
            work.tell(Ok(report(outcome.clone())));
            last = Some(outcome.clone());
        })?;
        last.map(report).ok_or_else(|| Error::internal("there are no losses"))
    }
}

impl Question for ComputeLosses {
    type Answer = LossAnswer;
    const KEPT: usize = 8;

    fn answer(&self, work: &Work<'_, LossAnswer>) -> Result<LossAnswer, Error> {
        match self.run(work) {
            Err(error) if error.is_cancelled() => Err(error),
            // It is told in the panel, and not in a message.
            answer => Ok(answer.map_err(|error| error.to_string())),
        }
    }
}

/// Losses that are drawn, and the question that they answer.
#[derive(Debug)]
pub struct LatestLosses {
    question: ComputeLosses,
    answer: Arc<Answered<LossAnswer>>,
    /// Whether they are all that was asked for.
    is_complete: bool,
}

/// The losses that are asked for, and the latest ones.
#[derive(Debug, Default)]
pub struct LossJob {
    /// What is asked for, since when.
    asked: Option<(ComputeLosses, Instant)>,
    /// The share of the work on it that is done and its time, where there are no complete losses yet.
    busy: Option<(f32, Duration)>,
    latest: Option<LatestLosses>,
    /// What was cancelled, or failed for this reason. It is not asked for again by itself.
    stopped: Option<(ComputeLosses, Option<String>)>,
    /// The losses that are wanted, and since when.
    wanted: Option<(ComputeLosses, Instant)>,
}

impl LossJob {
    /// The latest losses, and the time that they took.
    pub fn losses(&self) -> Option<(&ComputedLosses, Duration)> {
        let answered = &self.latest.as_ref()?.answer;
        Some((answered.answer.as_ref().ok()?, answered.elapsed))
    }

    /// Whether the latest losses are those of a run that ended early.
    pub fn is_partial(&self) -> bool {
        self.busy.is_none() && self.latest.is_some() && !self.is_complete()
    }

    /// Whether the latest losses are complete.
    pub fn is_complete(&self) -> bool {
        self.latest.as_ref().is_some_and(|latest| latest.is_complete)
    }

    /// Whether other losses than the latest are wanted, for longer than a moment where they are being computed.
    pub fn stale(&self) -> bool {
        let (Some(latest), Some((wanted, since))) = (&self.latest, &self.wanted) else { return false };
        latest.question != *wanted && (self.busy.is_none() || since.elapsed() > SOON)
    }

    /// The losses, if they are complete and hold for `query` and `materials`.
    pub fn finished(&self, materials: &MaterialList, query: &LossQuery) -> Option<&[Loss]> {
        let latest = self.latest.as_ref().filter(|latest| latest.is_complete)?;
        let losses = latest.answer.answer.as_ref().ok()?;
        (latest.question == ComputeLosses::of(materials, query))
            .then_some(losses.report.outcome.losses.as_slice())
    }

    /// Progress of the losses that are computed: its share in [0, 1], its time, and whether it has losses yet. `None` without one,
    /// and for the first moment of one.
    pub fn busy(&self) -> Option<(f32, Duration, bool)> {
        let ((fraction, elapsed), (asked, _)) = (self.busy?, self.asked.as_ref()?);
        let of_run = self.latest.as_ref().filter(|latest| latest.question == *asked);
        let losses = of_run.and_then(|latest| latest.answer.answer.as_ref().ok());
        let scenes = losses.map_or(0, |losses| losses.report.outcome.scenes.len());
        let fraction = match &asked.query.request {
            Request::Time { budget, .. } if scenes > 0 => elapsed.as_secs_f32() / budget.as_secs_f32(),
            Request::Scenes(s) if scenes > 0 => scenes as f32 / (s.near + s.distant) as f32,
            _ => fraction,
        };
        (elapsed > SOON).then_some((fraction.min(1.0), elapsed, scenes > 0))
    }

    /// Why the wanted losses could not be computed.
    pub fn problem(&self) -> Option<&str> {
        self.stopped.as_ref().and_then(|(_, problem)| problem.as_deref())
    }

    /// Asks for the losses that are wanted, in every frame: with `auto` for those of now, otherwise for those that were started.
    pub fn follow(&mut self, answers: &Answers, materials: &MaterialList, query: &LossQuery, auto: bool) {
        if materials.predictions().is_empty() {
            *self = Self::default();
            return;
        }
        let wanted = ComputeLosses::of(materials, query);
        if self.wanted.as_ref().is_none_or(|(before, _)| *before != wanted) {
            self.wanted = Some((wanted.clone(), Instant::now()));
        }
        self.stopped.take_if(|(stopped, _)| *stopped != wanted);
        // Losses of other materials are none of these.
        self.latest.take_if(|latest| latest.question.materials != wanted.materials);
        if auto && !self.goes_on(&wanted) {
            self.asked = self.stopped.is_none().then(|| (wanted, Instant::now()));
        }
        self.ask(answers);
    }

    /// Whether what is asked for is asked for further: it is wanted, or it was begun a moment ago. Otherwise there are no losses while a
    /// slider moves.
    fn goes_on(&self, wanted: &ComputeLosses) -> bool {
        self.asked.as_ref().is_some_and(|(asked, since)| {
            let has_losses = self.latest.as_ref().is_some_and(|latest| latest.question == *asked);
            asked == wanted || (!has_losses && since.elapsed() < SOON)
        })
    }

    fn ask(&mut self, answers: &Answers) {
        let asked = self.asked.as_ref().map(|(question, _)| (question.clone(), answers.get(question)));
        let Some((question, answer)) = asked else {
            self.busy = None;
            return;
        };
        self.busy = answer.busy();
        let latest = match answer {
            Answer::Ready(answer) => (answer, true),
            Answer::Partial(answer, ..) => (answer, false),
            Answer::Running(..) => return,
            // Cancelled: its materials were closed.
            Answer::Failed(_) => return self.asked = None,
        };
        let (answer, is_complete) = latest;
        match &answer.answer {
            Ok(_) => self.latest = Some(LatestLosses { question, answer, is_complete }),
            Err(problem) => (self.stopped, self.asked) = (Some((question, Some(problem.clone()))), None),
        }
    }

    /// Asks for the losses of the predictions in `materials`, in the place of what is asked for.
    pub fn start(&mut self, materials: &MaterialList, query: &LossQuery) {
        self.stopped = None;
        self.asked = Some((ComputeLosses::of(materials, query), Instant::now()));
    }

    /// Cancels the losses that are computed, which are not asked for again by themselves. What they have reached stays.
    pub fn cancel(&mut self) {
        if self.busy.take().is_some() {
            self.stopped = self.asked.take().map(|(asked, _)| (asked, None));
        }
    }
}

/// For each prediction the differences of all losses from its own.
fn differences(report: &LossReport) -> Vec<Vec<Estimate>> {
    let outcome = &report.outcome;
    let predictions = 0..outcome.losses.len();
    let from = |other| predictions.clone().map(|index| outcome.difference(index, other)).collect();
    predictions.clone().map(from).collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use svbrdf_core::loss::Sampling;
    use svbrdf_core::model::convention::Convention;
    use svbrdf_core::progress::Progress;
    use svbrdf_files::source::MaterialSource;

    use crate::model::material::loaded::LoadedMaterial;
    use crate::model::material::read::ReadMaterial;

    fn materials() -> MaterialList {
        let read = |number| MaterialSource::built_in(number).read(&Progress::default()).unwrap();
        let one = |number| ReadMaterial::new(MaterialSource::built_in(number), read(number));
        let all = [0, 1].map(|number| LoadedMaterial::new(Arc::new(one(number)))).to_vec();
        MaterialList { all, ..MaterialList::default() }
    }

    const LAST: u64 = 1000;

    /// What is wanted with this seed: of the last one few scenes, of the others more than anybody waits for.
    fn query(seed: u64) -> LossQuery {
        let near = if seed == LAST { 2 } else { 100_000 };
        let sampling = Sampling { near, distant: 0, seed, ..Sampling::default() };
        LossQuery { request: Request::Scenes(sampling), convention: Convention::default() }
    }

    /// The seed of the latest losses.
    fn seed(job: &LossJob) -> Option<u64> {
        job.losses().and_then(|(losses, _)| losses.request.seed())
    }

    #[test]
    fn a_setting_that_moves_has_losses_and_a_cancelled_run_keeps_its_own() {
        let (materials, mut answers, mut job) = (materials(), Answers::default(), LossJob::default());
        let mut frame = |job: &mut LossJob, seed, auto| {
            assert!(answers.begin_frame().is_empty());
            job.follow(&answers, &materials, &query(seed), auto);
            answers.end_frame();
            std::thread::sleep(Duration::from_millis(5));
        };
        for moved in 0..400 {
            frame(&mut job, moved, true);
        }
        assert!(seed(&job).is_some_and(|seed| seed > 0) && !job.is_complete());
        while seed(&job) != Some(7) {
            frame(&mut job, 7, true);
        }
        job.cancel();
        frame(&mut job, 7, true);
        assert!(
            job.is_partial() && seed(&job) == Some(7) && job.busy().is_none(),
            "it is not asked for again"
        );
        // By hand, it goes on while another one is wanted.
        job.start(&materials, &query(LAST));
        while !job.is_complete() {
            frame(&mut job, 8, false);
        }
        assert!(job.stale() && seed(&job) == Some(LAST));
        assert!(job.finished(&materials, &query(LAST)).is_some());
        assert!(job.finished(&materials, &query(8)).is_none());
    }
}
