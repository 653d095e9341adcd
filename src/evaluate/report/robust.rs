//! Report on the robustness of the order of predictions.

use serde::Serialize;

use svbrdf_core::progress::Progress;

use super::Report;
use super::heading::Compared;
use super::latex::{escaped, latex};
use super::table::{Cell, Field, Reader, Table};
use crate::error::Error;
use crate::robust::{Answered, RobustInput};

/// Whether the order of predictions survives other conventions, epsilons and scenes.
#[derive(Clone, Debug, Serialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct RobustReport {
    #[serde(flatten)]
    compared: Compared,
    /// The materials that scores are means over, with paired intervals over them; none where one ground truth is asked about.
    materials: Vec<String>,
    /// The answer in a sentence.
    sentence: String,
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
    /// Asks all questions.
    ///
    /// # Errors
    /// As [`RobustInput::answers`].
    pub fn new(input: &RobustInput<'_>, progress: &Progress) -> Result<Self, Error> {
        let answers = input.answers(progress)?;
        let names: Vec<_> = input.predictions.iter().map(|prediction| prediction.name().to_owned()).collect();
        let compared = Compared::new(input.ground_truth, &input.convention);
        Ok(Self::of_answers(compared, Vec::new(), &names, &answers))
    }

    /// The report of answers, the default one first, about the predictions `names`; `materials`: those that they are means over.
    pub fn of_answers(
        compared: Compared,
        materials: Vec<String>,
        names: &[String],
        answers: &[Answered],
    ) -> Self {
        let default = &answers[0];
        let change = |answer: &Answered, (a, b): (usize, usize)| {
            Some(Change {
                question: answer.question.clone(),
                first: names[a].clone(),
                second: names[b].clone(),
                default_interval95: default.differences[a][b]?,
                interval95: answer.differences[a][b]?,
            })
        };
        let changes = answers[1..]
            .iter()
            .flat_map(|answer| default.changes(answer).filter_map(move |pair| change(answer, pair)))
            .collect::<Vec<_>>();
        let question = |answer: &Answered| AskedQuestion {
            question: answer.question.clone(),
            tau: default.tau(answer),
            order: answer.order().into_iter().map(|index| names[index].clone()).collect(),
        };
        let sentence = sentence(names, answers, &changes);
        let questions = answers.iter().map(question).collect();
        Self { compared, materials, sentence, questions, changes }
    }

    /// The answer in a sentence.
    pub fn sentence(&self) -> &str {
        &self.sentence
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
        latex("lr", "Question & $\\tau$", &self.questions.iter().map(row).collect::<String>())
    }
}

/// The answer in a sentence.
fn sentence(names: &[String], answers: &[Answered], changes: &[Change]) -> String {
    let default = &answers[0];
    if let Some(change) = changes.first() {
        let (first, second) = (&change.first, &change.second);
        let of_pair = changes.iter().filter(|other| (&other.first, &other.second) == (first, second));
        let on = of_pair.map(|change| change.question.as_str()).collect::<Vec<_>>().join(", ");
        return format!("The order of {first} and {second} depends on the question: it changes under {on}.");
    }
    let questions = answers.len();
    let order = default.order();
    let beats = |answer: &&Answered| order.len() > 1 && answer.sign(order[0], order[1]) < 0;
    let under = match answers.iter().filter(beats).count() {
        0 => return format!("No pair changes sides under any of {questions} questions."),
        all if all == questions => format!("all {questions} questions."),
        some => format!("{some} of {questions} questions, and no pair changes sides."),
    };
    format!("{} beats {} under {under}", names[order[0]], names[order[1]])
}

const FIELDS: [Field<AskedQuestion>; 3] = [
    ("question", "question", |row| row.question.as_str().into()),
    ("tau", "tau", |row| Cell::Digits(2, row.tau)),
    ("order", "order", |row| row.order.join(" < ").into()),
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
        let answers: Vec<_> = scores
            .iter()
            .map(|of| {
                let interval = |a: usize, b: usize| Some([of[a] - of[b] - half, of[a] - of[b] + half]);
                Answered::new("of".to_owned(), of.to_vec(), interval)
            })
            .collect();
        let compared = Compared { ground_truth: "gt".into(), size: [4; 2], convention: "", epsilon: 0.0 };
        RobustReport::of_answers(compared, Vec::new(), &["a", "b", "c"].map(str::to_owned), &answers)
    }

    #[test]
    fn a_pair_changes_sides_where_both_differences_are_significant() {
        let usual = [0.1, 0.2, 0.4];
        let found = report(&[usual, [0.3, 0.1, 0.4]], 0.05);
        assert_eq!(found.sentence, "The order of a and b depends on the question: it changes under of.");
        assert!((found.questions[1].tau - 1.0 / 3.0).abs() < 1e-12);
        assert_eq!((found.questions[1].order.join(""), found.changes.len()), ("bac".to_owned(), 1));
        for (scores, half, sentence) in [
            (
                &[usual, [0.12, 0.1, 0.4]][..],
                0.05,
                "a beats b under 1 of 2 questions, and no pair changes sides.",
            ),
            (&[usual, usual], 0.05, "a beats b under all 2 questions."),
            (&[usual], 0.5, "No pair changes sides under any of 1 questions."),
        ] {
            let found = report(scores, half);
            assert_eq!((found.sentence.as_str(), found.changes.len()), (sentence, 0));
            assert!(found.questions.iter().all(|asked| asked.tau == 1.0));
        }
    }
}
