//! Summaries of methods over all materials: means, medians, intervals and paired differences.

use std::fmt;
use std::str::FromStr;

use svbrdf_core::error::Error;
use svbrdf_core::statistics::median;

use super::bootstrap::interval_of_mean;
use super::record::{KnownLoss, MaterialResult, PredictionResult};

/// The 97.5% quantile of the normal distribution.
const Z: f64 = 1.959_964;

/// Which of several predictions of a material by one method counts.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Pick {
    /// The first.
    #[default]
    Fixed,
    /// The mean of the losses of all.
    Mean,
    /// The one with the smallest loss: what an oracle would choose.
    Best,
}

impl FromStr for Pick {
    type Err = Error;

    fn from_str(name: &str) -> Result<Self, Error> {
        match name {
            "fixed" => Ok(Self::Fixed),
            "mean" => Ok(Self::Mean),
            "best" => Ok(Self::Best),
            _ => Err(Error::UnknownName {
                what: "choice of samples",
                found: name.to_owned(),
                known: "fixed, mean, best".to_owned(),
            }),
        }
    }
}

impl fmt::Display for Pick {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(match self {
            Self::Fixed => "fixed",
            Self::Mean => "mean",
            Self::Best => "best",
        })
    }
}

/// A method over the materials that it has a loss of.
#[derive(Clone, Debug, PartialEq)]
pub struct MethodSummary {
    pub method: String,
    /// The number of materials with a loss.
    pub materials: usize,
    /// The number of materials without one.
    pub failures: usize,
    pub mean: f64,
    pub median: f64,
    /// The 95% interval of the mean over all materials like these; `None` for fewer than 3.
    pub interval95_materials: Option<[f64; 2]>,
    /// The 95% interval of the mean over these materials, due to the sampling of scenes alone.
    pub interval95_scenes: [f64; 2],
    /// The mean of this method - the best one over the materials of both, with its interval over materials; `None` for the
    /// best.
    pub to_best: Option<MethodDifference>,
}

/// A paired difference of two methods.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct MethodDifference {
    pub mean: f64,
    pub interval95_materials: Option<[f64; 2]>,
}

impl MethodSummary {
    /// Whether the materials cannot separate the method from the best one.
    pub fn ties_with_best(&self) -> bool {
        match &self.to_best {
            None => true,
            Some(difference) => difference.interval95_materials.is_none_or(|[low, _]| low <= 0.0),
        }
    }
}

/// The methods, smallest mean loss first; those without any loss come last, with a mean of NaN.
pub fn summarize(methods: &[String], results: &[MaterialResult], pick: Pick) -> Vec<MethodSummary> {
    let values: Vec<Vec<Option<KnownLoss>>> = methods
        .iter()
        .map(|method| results.iter().map(|result| counted_loss(result, method, pick)).collect())
        .collect();
    let mut summaries: Vec<(MethodSummary, &Vec<Option<KnownLoss>>)> =
        methods.iter().zip(&values).map(|(method, values)| (of_method(method, values), values)).collect();
    summaries.sort_by(|a, b| a.0.mean.total_cmp(&b.0.mean));
    let best = summaries.first().map(|(_, values)| (*values).clone()).unwrap_or_default();
    let with_difference = |(place, (summary, values)): (usize, (MethodSummary, &Vec<Option<KnownLoss>>))| {
        let to_best = (place > 0).then(|| difference(values, &best));
        MethodSummary { to_best, ..summary }
    };
    summaries.into_iter().enumerate().map(with_difference).collect()
}

fn of_method(method: &str, values: &[Option<KnownLoss>]) -> MethodSummary {
    let known: Vec<KnownLoss> = values.iter().flatten().copied().collect();
    let mut losses: Vec<f64> = known.iter().map(|known| known.loss).collect();
    let count = losses.len() as f64;
    let mean = losses.iter().sum::<f64>() / count;
    let reach = Z * known.iter().map(|known| known.standard_error.powi(2)).sum::<f64>().sqrt() / count;
    let interval95_materials = interval_of_mean(&losses);
    let median = median(&mut losses).unwrap_or(f64::NAN);
    MethodSummary {
        method: method.to_owned(),
        materials: losses.len(),
        failures: values.len() - losses.len(),
        mean,
        median,
        interval95_materials,
        interval95_scenes: [mean - reach, mean + reach],
        to_best: None,
    }
}

fn difference(values: &[Option<KnownLoss>], best: &[Option<KnownLoss>]) -> MethodDifference {
    let paired = values.iter().zip(best).filter_map(|(a, b)| Some(a.as_ref()?.loss - b.as_ref()?.loss));
    let differences: Vec<f64> = paired.collect();
    let mean = differences.iter().sum::<f64>() / differences.len() as f64;
    MethodDifference { mean, interval95_materials: interval_of_mean(&differences) }
}

/// The loss of a method for a material: of several predictions, `pick` says which counts.
pub fn counted_loss(result: &MaterialResult, method: &str, pick: Pick) -> Option<KnownLoss> {
    let of_method = result.predictions.iter().filter(|prediction| prediction.method == method);
    let mut known: Vec<KnownLoss> = Vec::new();
    for prediction in of_method {
        match (&prediction.result, pick) {
            (Ok(loss), _) => known.push(*loss),
            // The first counts, and is not replaced by another.
            (Err(_), Pick::Fixed) if known.is_empty() => return None,
            (Err(_), _) => {}
        }
    }
    match pick {
        Pick::Fixed => known.first().copied(),
        Pick::Best => known.into_iter().min_by(|a, b| a.loss.total_cmp(&b.loss)),
        Pick::Mean => {
            let count = known.len() as f64;
            let mean = |of: fn(&KnownLoss) -> f64| known.iter().map(of).sum::<f64>() / count;
            // All see the same scenes: their errors add up.
            (count > 0.0).then(|| KnownLoss {
                loss: mean(|known| known.loss),
                standard_error: mean(|known| known.standard_error),
                interval95: [mean(|known| known.interval95[0]), mean(|known| known.interval95[1])],
            })
        }
    }
}

/// The prediction of a method for a material that stands for it in pictures: the one that counts, of a mean the first with a loss.
pub fn counted_sample(result: &MaterialResult, method: &str, pick: Pick) -> Option<usize> {
    let loss = |prediction: &PredictionResult| prediction.result.as_ref().ok().map(|known| known.loss);
    let mut of_method = result.predictions.iter().filter(|prediction| prediction.method == method);
    let counted = match pick {
        Pick::Fixed => of_method.next().filter(|prediction| loss(prediction).is_some()),
        Pick::Mean => of_method.find(|prediction| loss(prediction).is_some()),
        Pick::Best => {
            let known = of_method.filter_map(|prediction| Some((loss(prediction)?, prediction)));
            known.min_by(|a, b| a.0.total_cmp(&b.0)).map(|(_, prediction)| prediction)
        }
    };
    counted.map(|prediction| prediction.sample)
}
