//! Losses as text: one file per format.

mod csv;
mod json;
mod text;

use std::io;

use svbrdf::convention::Convention;
use svbrdf::loss::{Estimate, Loss, Texels};
use svbrdf::sampler::Sampler;
use svbrdf::scene::{Kind, Scene};

/// What a report is written in.
#[derive(Clone, Copy, Debug, Default, clap::ValueEnum)]
pub enum Format {
    #[default]
    Text,
    Json,
    Csv,
}

/// Losses with everything that gives them a meaning.
#[derive(Debug)]
pub struct Report {
    pub convention: Convention,
    /// The name of the ground truth.
    pub ground_truth: String,
    /// Width and height in texels.
    pub size: [usize; 2],
    /// `None` where the scenes come from a file.
    pub seed: Option<u64>,
    /// `None` where the scenes come from a file.
    pub sampler: Option<Sampler>,
    pub texels: Texels,
    pub precision: &'static str,
    /// What computed it: cpu or gpu.
    pub backend: &'static str,
    pub scenes: Vec<Scene>,
    pub losses: Vec<Loss>,
}

impl Report {
    /// The report in one of the formats, complete with its last line break.
    pub fn to_text(&self, format: Format) -> io::Result<String> {
        match format {
            Format::Text => Ok(text::write(self)),
            Format::Json => json::write(self),
            Format::Csv => Ok(csv::write(self)),
        }
    }

    /// How much larger each further loss is than the first, on the same scenes.
    fn differences(&self) -> Vec<(&Loss, Estimate)> {
        let Some((first, others)) = self.losses.split_first() else { return Vec::new() };
        let sampler = self.sampler.unwrap_or_default();
        let difference =
            |loss: &Loss| Estimate::of_difference(sampler, &self.scenes, &loss.per_scene, &first.per_scene);
        others.iter().map(|loss| (loss, difference(loss))).collect()
    }

    fn count(&self, kind: Kind) -> usize {
        self.scenes.iter().filter(|scene| scene.kind == kind).count()
    }
}
