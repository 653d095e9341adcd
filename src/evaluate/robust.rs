//! Robustness of the order of predictions to other conventions, epsilons and scenes: a ranking, asked several times.

use serde::Serialize;

use svbrdf_core::loss::{Comparison, Request, Sampling, Texels};
use svbrdf_core::model::convention::Convention;
use svbrdf_core::model::named_conventions as named;
use svbrdf_core::model::named_scenes::NamedScenes;
use svbrdf_core::model::sampler::Sampler;
use svbrdf_core::progress::Progress;
use svbrdf_core::statistics::order;

use crate::error::Error;
use crate::report::{Cell, Compared, Field, Reader, Report, Table, escaped, float, latex, sentences};

/// Scenes of a question about one kind of them, and texels of each.
const SCENES: usize = 2048;
const TEXELS: usize = 32;
/// Most scenes of a question: a squared error of sharp highlights would take hundreds of thousands, whose interval tells instead.
const MOST: usize = 24_576;

/// The scores of predictions under a question: how far each is from the ground truth.
#[derive(Clone, Debug)]
pub struct Scores {
    pub(crate) question: String,
    /// Smaller is better.
    pub(crate) scores: Vec<f64>,
    /// For each pair of predictions, the 95% interval of the score of the first - that of the second; `None` where it is unknown.
    differences: Vec<Vec<Option<[f64; 2]>>>,
}

impl Scores {
    /// Scores with the interval of each pair of predictions.
    pub fn new(
        question: String,
        scores: Vec<f64>,
        interval: impl Fn(usize, usize) -> Option<[f64; 2]>,
    ) -> Self {
        let all = 0..scores.len();
        let differences = all.clone().map(|a| all.clone().map(|b| interval(a, b)).collect()).collect();
        Self { question, scores, differences }
    }

    /// 1 where `a` is significantly farther from the ground truth than `b`, -1 where it is closer, 0 where that is not known.
    fn sign(&self, a: usize, b: usize) -> i8 {
        match self.differences[a][b] {
            Some([low, _]) if low > 0.0 => 1,
            Some([_, high]) if high < 0.0 => -1,
            _ => 0,
        }
    }

    /// The predictions that change sides in another order, where both differences are significant, with these.
    fn changes(&self, other: &Self, names: &[String]) -> Vec<Change> {
        let pairs = (0..names.len()).flat_map(|a| (a + 1..names.len()).map(move |b| (a, b)));
        let change = |(a, b): (usize, usize)| {
            (self.sign(a, b) * other.sign(a, b) < 0).then_some(Change {
                question: other.question.clone(),
                first: names[a].clone(),
                second: names[b].clone(),
                default_interval95: self.differences[a][b]?,
                interval95: other.differences[a][b]?,
            })
        };
        pairs.filter_map(change).collect()
    }
}

/// The answers to all questions, the default one, which is the `usual` request, first. A question is one step of `progress`.
///
/// # Errors
/// As [`Comparison::new`]; [`Cancelled`](Error::is_cancelled).
pub(crate) fn answers(
    comparison: &Comparison<'_, f32>,
    usual: &Request,
    progress: &Progress,
) -> Result<Vec<Scores>, Error> {
    let questions = questions(*comparison.convention(), usual)?;
    progress.begin(questions.len() as u64);
    let answer = |(name, convention, request)| {
        let comparison = Comparison::new(comparison.ground_truth(), comparison.predictions(), convention)?;
        let outcome = comparison.at_most(MOST).run(&request, &progress.part())?;
        progress.step()?;
        // Listed scenes are the question itself, and no sample.
        let interval = |a, b| {
            let difference = outcome.difference(a, b);
            if outcome.sampling.is_some() { difference.interval95 } else { Some([difference.mean; 2]) }
        };
        let scores = outcome.losses.iter().map(|loss| loss.estimate.mean).collect();
        Ok(Scores::new(name, scores, interval))
    };
    questions.into_iter().map(answer).collect()
}

/// Names, conventions and scenes.
fn questions(own: Convention, usual: &Request) -> Result<Vec<(String, Convention, Request)>, Error> {
    let under = |name: &str, convention| (name.to_owned(), convention, usual.clone());
    let mut all = vec![under(own.name, own)];
    for described in named::all().iter().filter(|described| described.name != own.name) {
        all.push(under(&described.name, Convention::try_from(described)?));
    }
    for epsilon in [0.01, 0.1].into_iter().filter(|epsilon| *epsilon != own.epsilon) {
        all.push(under(&format!("epsilon {epsilon}"), Convention { epsilon, ..own }));
    }
    let (seed, texels) = (usual.seed().unwrap_or(0), Texels::Sampled(TEXELS));
    for (name, near, distant) in [("near-field scenes", SCENES, 0), ("distant scenes", 0, SCENES)] {
        let sampling = Sampling { near, distant, seed, sampler: Sampler::Sobol, texels };
        all.push((name.to_owned(), own, Request::Scenes(sampling)));
    }
    for lights in NamedScenes::ALL {
        all.push((format!("lights {}", lights.name()), own, Request::Listed(lights.scenes()?)));
    }
    Ok(all)
}

/// Whether the order of predictions survives other conventions, epsilons and scenes.
#[derive(Clone, Debug, Serialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct RobustReport {
    #[serde(flatten)]
    compared: Compared,
    /// The materials that scores are means over, with paired intervals over them; none where one ground truth is asked about.
    materials: Vec<String>,
    /// The answer in a sentence.
    pub sentence: String,
    /// The default one first.
    questions: Vec<AskedQuestion>,
    /// Pairs of predictions that change sides, where both differences are significant.
    changes: Vec<Change>,
}

/// A question, and the order that it gives.
#[derive(Clone, Debug, Serialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
struct AskedQuestion {
    question: String,
    /// Kendall's tau to the order by default: 1 where no pair changes sides.
    tau: f64,
    /// The predictions, the best first.
    order: Vec<String>,
    /// The score of each, in this order: differences that are not significant are no changes.
    scores: Vec<f64>,
}

/// A pair of predictions that changes sides.
#[derive(Clone, Debug, Serialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
struct Change {
    question: String,
    first: String,
    second: String,
    /// 95% interval of the score of the first - that of the second, by default.
    default_interval95: [f64; 2],
    /// The same under the question.
    interval95: [f64; 2],
}

impl RobustReport {
    /// Asks all questions, the default one by the `usual` request.
    ///
    /// # Errors
    /// As [`Comparison::new`]; [`Cancelled`](Error::is_cancelled).
    pub fn new(
        comparison: &Comparison<'_, f32>,
        usual: &Request,
        progress: &Progress,
    ) -> Result<Self, Error> {
        let answers = answers(comparison, usual, progress)?;
        let names: Vec<_> = comparison.predictions().iter().map(|one| one.name().to_owned()).collect();
        let compared = Compared::new(comparison.ground_truth(), comparison.convention());
        Ok(Self::of_answers(compared, Vec::new(), &names, &answers))
    }

    /// The report of answers, the default one first, about the predictions `names`; `materials`: those that they are means over.
    pub fn of_answers(
        compared: Compared,
        materials: Vec<String>,
        names: &[String],
        answers: &[Scores],
    ) -> Self {
        let pairs = (1..names.len()).sum::<usize>().max(1) as f64;
        let mut changes = Vec::new();
        let asked = |answer: &Scores| {
            let (changed, order) = (answers[0].changes(answer, names), order(&answer.scores));
            let tau = 1.0 - 2.0 * changed.len() as f64 / pairs;
            changes.extend(changed);
            AskedQuestion {
                question: answer.question.clone(),
                tau,
                order: order.iter().map(|index| names[*index].clone()).collect(),
                scores: order.iter().map(|index| answer.scores[*index]).collect(),
            }
        };
        let questions = answers.iter().map(asked).collect();
        Self { compared, materials, sentence: sentence(names, answers, &changes), questions, changes }
    }

    /// Each pair of predictions that changes sides, with both intervals.
    pub fn changes(&self) -> impl Iterator<Item = String> {
        self.changes.iter().map(|change| {
            let Change { question, first, second, default_interval95: [a, b], interval95: [c, d] } = change;
            format!("{first} - {second}: {a:.4} to {b:.4} by default, {c:.4} to {d:.4} under {question}")
        })
    }

    /// A table for a paper.
    pub fn latex(&self) -> String {
        let row = |asked: &AskedQuestion| format!("{} & {:.2} \\\\\n", escaped(&asked.question), asked.tau);
        let rows: String = self.questions.iter().map(row).collect();
        float(
            &escaped(&sentences(&self.heading())),
            &latex("lr", "Question & $\\tau$ to the default order", &rows),
        )
    }
}

/// The answer in a sentence.
fn sentence(names: &[String], answers: &[Scores], changes: &[Change]) -> String {
    if let Some(Change { first, second, .. }) = changes.first() {
        let of_pair = changes.iter().filter(|other| (&other.first, &other.second) == (first, second));
        let on = of_pair.map(|change| change.question.as_str()).collect::<Vec<_>>().join(", ");
        return format!("The order of {first} and {second} depends on the question: it changes under {on}.");
    }
    let (questions, order) = (answers.len(), order(&answers[0].scores));
    let beats = |answer: &&Scores| order.len() > 1 && answer.sign(order[0], order[1]) < 0;
    let under = match answers.iter().filter(beats).count() {
        0 => return format!("No pair changes sides under any of {questions} questions."),
        all if all == questions => format!("all {questions} questions."),
        some => format!("{some} of {questions} questions, and no pair changes sides."),
    };
    format!("{} beats {} under {under}", names[order[0]], names[order[1]])
}

const FIELDS: [Field<AskedQuestion>; 4] = [
    ("question", "question", |row| row.question.as_str().into()),
    ("tau", "tau", |row| Cell::Digits(2, row.tau)),
    ("order", "", |row| row.order.join(" < ").into()),
    ("", "order and scores", |row| {
        let scored = row.order.iter().zip(&row.scores).map(|(name, score)| format!("{name} {score:.4}"));
        scored.collect::<Vec<_>>().join(" < ").into()
    }),
];

impl Report for RobustReport {
    fn heading(&self) -> String {
        let changes = self.changes().map(|change| change + "\n");
        let Compared { ground_truth, convention, epsilon, .. } = &self.compared;
        let heading = match self.materials.len() {
            0 => self.compared.heading("order by the rendering loss"),
            count => format!(
                "order by the rendering loss over {count} materials of {ground_truth}\nconvention {convention}, epsilon {epsilon}\n"
            ),
        };
        heading + &format!("{}\n", self.sentence) + &changes.collect::<String>()
    }

    fn table(&self, reader: Reader) -> Table {
        Table::fields(&FIELDS, &self.questions, reader)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn report(scores: &[[f64; 3]], half: f64) -> RobustReport {
        let answer = |of: &[f64; 3]| {
            let interval = |a: usize, b: usize| Some([of[a] - of[b] - half, of[a] - of[b] + half]);
            Scores::new("of".to_owned(), of.to_vec(), interval)
        };
        let compared =
            Compared { ground_truth: "gt".into(), size: [4; 2], masked: None, convention: "", epsilon: 0.0 };
        let answers: Vec<_> = scores.iter().map(answer).collect();
        RobustReport::of_answers(compared, Vec::new(), &["a", "b", "c"].map(str::to_owned), &answers)
    }

    #[test]
    fn a_pair_changes_sides_where_both_differences_are_significant() {
        let usual = [0.1, 0.2, 0.4];
        let (changed, close) = ([usual, [0.3, 0.1, 0.4]], [usual, [0.12, 0.1, 0.4]]);
        for (scores, half, sentence, taus) in [
            (
                &changed[..],
                0.05,
                "The order of a and b depends on the question: it changes under of.",
                [1.0, 1.0 / 3.0],
            ),
            (&close, 0.05, "a beats b under 1 of 2 questions, and no pair changes sides.", [1.0; 2]),
            (&[usual; 2], 0.05, "a beats b under all 2 questions.", [1.0; 2]),
            (&[usual; 2], 0.5, "No pair changes sides under any of 2 questions.", [1.0; 2]),
        ] {
            let found = report(scores, half);
            assert_eq!(
                (found.sentence.as_str(), found.changes().count()),
                (sentence, usize::from(taus[1] < 1.0))
            );
            let off = found.questions.iter().zip(taus).map(|(asked, tau)| (asked.tau - tau).abs());
            assert!(off.fold(0.0, f64::max) < 1e-12, "{sentence}");
        }
        assert_eq!(report(&changed, 0.05).questions[1].order.join(""), "bac");
    }
}
