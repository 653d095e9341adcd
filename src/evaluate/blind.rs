//! Blind comparison of two things in ABX trials: X is A or B, and an observer says which.

use std::fmt::{self, Display};

use rand::rngs::ChaCha8Rng;
use rand::{Rng as _, SeedableRng as _};
use statrs::distribution::{Beta, Binomial, ContinuousCDF as _, DiscreteCDF as _};

/// Trials of a test.
pub const TRIALS: usize = 20;

/// A test of [`TRIALS`] trials, in each of which X is A or B with probability 1/2, independently of the others.
///
/// Nothing of the answers is told before the end, so that the number of trials does not depend on how many are right.
#[derive(Clone, Debug)]
pub struct BlindTest {
    /// Whether A is the second of the two things.
    pub is_swapped: bool,
    /// Whether X is B, of each trial.
    x_is_b: Vec<bool>,
    answers: Vec<bool>,
}

impl BlindTest {
    pub fn new(seed: u64) -> Self {
        let bits = ChaCha8Rng::seed_from_u64(seed).next_u64();
        let x_is_b = (0..TRIALS).map(|trial| bits >> trial & 1 == 1).collect();
        Self { is_swapped: bits >> TRIALS & 1 == 1, x_is_b, answers: Vec::new() }
    }

    /// The number of the trial, from 1 on, and whether X is B in it; `None` after the last.
    pub fn trial(&self) -> Option<(usize, bool)> {
        self.x_is_b.get(self.answers.len()).map(|x_is_b| (self.answers.len() + 1, *x_is_b))
    }

    /// Takes "X is B", or "X is A", as the answer of the trial.
    pub fn answer(&mut self, is_b: bool) {
        self.answers.extend(self.trial().map(|_| is_b));
    }

    /// Ends the test before its last trial.
    pub fn end(&mut self) {
        self.x_is_b.truncate(self.answers.len());
    }

    /// The answers so far.
    pub fn score(&self) -> Score {
        let right = self.x_is_b.iter().zip(&self.answers).filter(|(x, answer)| x == answer).count();
        Score { right: right as u64, trials: self.answers.len() as u64 }
    }
}

/// How many answers of a test are right.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Score {
    pub right: u64,
    pub trials: u64,
}

impl Score {
    /// The probability that guesses are right as often or more often: P(K >= right) of the binomial distribution with 1/2.
    pub fn p(self) -> f64 {
        let of = |guesses: Binomial| self.right.checked_sub(1).map_or(1.0, |below| guesses.sf(below));
        Binomial::new(0.5, self.trials).map_or(f64::NAN, of)
    }

    /// The 95% confidence interval of the probability of a right answer (Clopper and Pearson 1934, The use of confidence or fiducial
    /// limits illustrated in the case of the binomial): it covers at least 95%.
    pub fn interval95(self) -> [f64; 2] {
        let [right, wrong] = [self.right, self.trials - self.right].map(|count| count as f64);
        let limit = |a, b, p| Beta::new(a, b).map(|beta| beta.inverse_cdf(p));
        // There is no such distribution where none, or all, are right.
        [limit(right, wrong + 1.0, 0.025).unwrap_or(0.0), limit(right + 1.0, wrong, 0.975).unwrap_or(1.0)]
    }
}

impl Display for Score {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Self { right, trials } = self;
        let p = match self.p() {
            p if p < 1e-4 => "p < 0.0001".to_owned(),
            p => format!("p = {p:.4}"),
        };
        let [share, low, high] =
            [*right as f64 / *trials as f64, self.interval95()[0], self.interval95()[1]].map(|x| 100.0 * x);
        write!(f, "{right} of {trials} right, {p}; {share:.0}%, 95% interval {low:.1}% to {high:.1}%")
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The scores of so many tests of an observer, which gets the test and random bits.
    fn scores(tests: u64, mut answer: impl FnMut(&BlindTest, u64) -> bool) -> Vec<Score> {
        let mut bits = ChaCha8Rng::seed_from_u64(1);
        let score = |seed| {
            let mut test = BlindTest::new(seed);
            while test.trial().is_some() {
                let is_b = answer(&test, bits.next_u64());
                test.answer(is_b);
            }
            test.score()
        };
        (0..tests).map(score).collect()
    }

    /// Whether p is distributed as that of guesses: P(p <= p_k) = p_k for each value that p may have, within 4 standard errors.
    fn is_of_guesses(scores: &[Score]) -> bool {
        let count = scores.len() as f64;
        (0..=TRIALS as u64).all(|right| {
            let p = Score { right, trials: TRIALS as u64 }.p();
            let found = scores.iter().filter(|score| score.right >= right).count() as f64 / count;
            (found - p).abs() <= 4.0 * (p * (1.0 - p) / count).sqrt() + 1e-12
        })
    }

    #[test]
    fn observers_who_do_not_see_x_get_the_p_of_guesses_and_one_who_peeks_now_and_then_does_not() {
        const TESTS: u64 = 4000;
        assert!(is_of_guesses(&scores(TESTS, |_, bits| bits & 1 == 1)), "clicks at random");
        assert!(is_of_guesses(&scores(TESTS, |_, _| true)), "always B");
        assert!(is_of_guesses(&scores(TESTS, |test, _| test.trial().unwrap().0 % 2 == 0)), "in turn");
        assert!(is_of_guesses(&scores(TESTS, |test, _| test.is_swapped)), "by the order of A and B");
        // A planted fault: one answer in 16 knows X.
        let peek = |test: &BlindTest, bits: u64| {
            if bits & 30 == 0 { test.trial().unwrap().1 } else { bits & 1 == 1 }
        };
        assert!(!is_of_guesses(&scores(TESTS, peek)));
    }

    #[test]
    fn p_and_interval_are_those_of_binom_test_in_r() {
        // binom.test(k, n, alternative = "greater")$p.value and binom.test(k, n)$conf.int
        for (right, trials, p, interval) in [
            (18, 20, 0.000_201_225_3, [0.683_017_3, 0.987_651_5]),
            (10, 20, 0.588_098_5, [0.271_957_8, 0.728_042_2]),
            (0, 5, 1.0, [0.0, 0.521_823_8]),
            (20, 20, 9.536_743e-7, [0.831_566_5, 1.0]),
        ] {
            let score = Score { right, trials };
            assert!((score.p() - p).abs() < 1e-7, "{score}");
            let found = score.interval95();
            assert!((0..2).all(|end| (found[end] - interval[end]).abs() < 1e-6), "{found:?}");
        }
        let text = Score { right: 18, trials: 20 }.to_string();
        assert_eq!(text, "18 of 20 right, p = 0.0002; 90%, 95% interval 68.3% to 98.8%");
    }

    #[test]
    fn a_test_that_is_ended_counts_the_answers_so_far() {
        let mut test = BlindTest::new(3);
        (0..3).for_each(|_| test.answer(test.trial().unwrap().1));
        test.end();
        test.answer(true);
        assert_eq!((test.trial(), test.score()), (None, Score { right: 3, trials: 3 }));
    }
}
