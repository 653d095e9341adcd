//! Options of reading: how the files of materials are read, and the size that materials are brought to.

mod decision;
mod statement;

use std::str::FromStr;

use svbrdf_core::error::Error as CoreError;
use svbrdf_evaluate::registration::Registration;
use svbrdf_files::Error;
use svbrdf_files::read::{Preset, ReadOptions};
use svbrdf_files::source::MaterialSource;

use crate::cli::args::offered;
use crate::cli::output::CommandError;
pub use decision::StatedReading;
use statement::Statement;
pub use statement::Whose;

/// The heading of the options of reading.
pub const READING: &str = "Reading materials";

#[derive(Debug, clap::Args)]
#[command(next_help_heading = READING)]
pub struct PairReadingArgs {
    #[command(flatten)]
    pub both: ReadingArgs,

    /// Resizes all materials: to the size of the ground truth, of the first prediction, or to a width of N texels
    #[arg(long, value_name = "gt|pred|N", allow_negative_numbers = true)]
    #[arg(value_parser = offered(str::parse::<ResizeTo>, ["gt", "pred"]), hide_possible_values = true)]
    pub resize_to: Option<ResizeTo>,

    /// How predictions of another size lie on the ground truth [default: found by the maps]
    ///
    /// resize, resize=cubic, centre-crop, crop=X,Y, or crop=X,Y/N of a ground truth reduced by N; for a data set after NAME: for one method
    /// only. May be given several times.
    #[arg(long, value_name = "[METHOD:]WAY", hide_short_help = true)]
    #[arg(value_parser = offered(registered, WAYS), hide_possible_values = true)]
    pub register: Vec<(Option<String>, Registration)>,
}

/// Ways of registration, to be completed.
const WAYS: [&str; 5] = ["resize", "resize=cubic", "centre-crop", "crop=16,16", "crop=0,0/4"];

/// A registration, after the name of a method that it is for.
fn registered(text: &str) -> Result<(Option<String>, Registration), CoreError> {
    match text.rsplit_once(':') {
        Some((method, way)) => Ok((Some(method.to_owned()), way.parse()?)),
        None => Ok((None, text.parse()?)),
    }
}

/// How materials are read. Options that are left out are inferred from the files and reported.
#[derive(Clone, Debug, clap::Args)]
#[command(next_help_heading = READING)]
pub struct ReadingArgs {
    #[command(flatten)]
    statements: StatementArgs,

    /// Fails where something in the files can only be guessed, or where an accuracy is not reached
    #[arg(long)]
    pub strict: bool,

    /// Reports everything noticed and assumed in reading, not only what is unsure or was changed
    #[arg(short, long)]
    pub verbose: bool,
}

/// What is specified of the files of materials.
#[derive(Clone, Debug, clap::Args)]
#[command(next_help_heading = READING)]
pub struct StatementArgs {
    /// How files are read, such as albedo=srgb,normal-y=down; after gt:, pred: or NAME: for these materials only. May be given
    /// several times
    #[arg(long, value_name = "[WHOSE:]KEY=VALUE,...", long_help = read_help())]
    #[arg(value_parser = offered(str::parse::<Statement>, ReadOptions::examples()), hide_possible_values = true)]
    read: Vec<Statement>,

    /// Conventions of a source of materials, for the options that are left out; after gt:, pred: or NAME: as in --read
    #[arg(long, value_name = "[WHOSE:]PRESET", long_help = preset_help())]
    #[arg(value_parser = offered(Statement::of_preset, Preset::ALL), hide_possible_values = true)]
    preset: Vec<Statement>,
}

impl ReadingArgs {
    fn statements(&self) -> impl Iterator<Item = &Statement> {
        self.statements.read.iter().chain(&self.statements.preset)
    }

    /// How the only `material` of a command is read.
    pub fn of_one(&self, material: &MaterialSource) -> Result<ReadOptions, CommandError> {
        let reading = StatedReading::new(self.statements())?;
        let names = if reading.has_names() { material.possible_names() } else { Vec::new() };
        let name = names.iter().find(|name| reading.check(Some(name), &[]).is_ok()).or(names.first());
        let name = name.map_or("", String::as_str);
        reading.check(Some(name), &[])?;
        Ok(reading.options_for(Whose::GroundTruth, name))
    }
}

impl PairReadingArgs {
    /// How the materials are read.
    pub fn reading(&self) -> Result<StatedReading, Error> {
        StatedReading::new(self.both.statements())
    }
}

fn read_help() -> String {
    "How files are read; what is left out is inferred and reported. May be given several times

For the ground truth only: gt:KEY=VALUE; for all predictions: pred:KEY=VALUE; for one of them, or with rank --dataset for a \
method, its name: NAME:KEY=VALUE. What is specified for a name counts before pred: and gt:, and these before the rest. Keys, \
which a sidecar file has, too:

  albedo           encoding of diffuse, base colour and specular: linear, srgb, gamma2.2, log0.01
  specular-albedo  encoding of specular where it differs
  normal-y         direction of y in normal maps: up (OpenGL), down (DirectX)
  normal-encoding  how the components of normals are stored: unsigned, signed, xy, ag
  roughness        what roughness values mean: r, gloss, alpha, axay, gamma2.2
  workflow         specular (diffuse and specular), metallic (base colour and metallic)
  dielectric-f0    reflectance of dielectrics, where no map holds it: 0 to 1 [default: 0.04]
  energy           whether the renderer that diffuse was made for scales it by (1 - specular): scaled, unscaled
  order            order of the tiles of a packed image, a letter each: ndrs, dnrs, dsrn, ..., or d alone
  grid             how a packed image is divided: COLUMNSxROWS
  flip-v           whether row 0 of every image is the bottom row: true, false
  exemplar         which row of a packed image, or which material of a file of several, from 0
  non-finite       NaN and infinity: refuse, replace
  preset           as --preset"
        .to_owned()
}

fn preset_help() -> String {
    let known = Preset::ALL.map(Preset::name).join(", ");
    format!(
        "Conventions of a source of materials, for the options that are left out: {known}. After gt:, pred: or NAME: for these \
         materials only, as in --read. May be given several times"
    )
}

/// The size that materials are brought to.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum ResizeTo {
    GroundTruth,
    Prediction,
    /// This many texels wide, as high as its shape wants.
    Width(usize),
}

impl FromStr for ResizeTo {
    type Err = String;

    fn from_str(text: &str) -> Result<Self, String> {
        match (text, text.parse()) {
            ("gt", _) => Ok(Self::GroundTruth),
            ("pred", _) => Ok(Self::Prediction),
            (_, Ok(width @ 1..=16_384)) => Ok(Self::Width(width)),
            _ => Err("expected gt, pred or a width from 1 to 16384".to_owned()),
        }
    }
}
