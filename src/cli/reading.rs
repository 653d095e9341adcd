//! How the files of materials are read.

use std::path::Path;
use std::str::FromStr;

use svbrdf::error::Error;
use svbrdf::files::read::{
    Albedo, Assumption, Certainty, Energy, Grid, MapReport, NonFinite, NormalCode, NormalY, Order, Preset,
    Read, ReadOptions, Reflectance, Roughness, What, Workflow,
};
use svbrdf::material::Material;
use svbrdf::math::real::Real;

use super::exit::tell;

#[derive(Debug, clap::Args)]
#[command(next_help_heading = "Reading materials")]
pub struct Reading {
    #[command(flatten)]
    pub both: ReadingArgs,

    /// The same as --albedo for the ground truth only
    #[arg(long, value_name = "linear|srgb|gamma2.2|log0.01", requires = "ground_truth")]
    gt_albedo: Option<Albedo>,

    /// The same as --albedo for the predictions only
    #[arg(long, value_name = "linear|srgb|gamma2.2|log0.01", requires = "ground_truth")]
    pred_albedo: Option<Albedo>,

    /// Resizes materials of differing sizes: to that of the ground truth, of the first prediction, or N wide
    #[arg(long, value_name = "gt|pred|N", allow_negative_numbers = true, requires = "ground_truth")]
    pub resize_to: Option<ResizeTo>,
}

/// How one material is read. What is left out is found out from the files, and said.
#[derive(Clone, Copy, Debug, clap::Args)]
#[command(next_help_heading = "Reading materials")]
pub struct ReadingArgs {
    /// What a source of materials does, for all that the other options leave open
    #[arg(long, value_name = "NAME", requires = "ground_truth", long_help = preset_help())]
    preset: Option<Preset>,

    /// How diffuse, base colour and specular are stored [default: found out]
    #[arg(long, value_name = "linear|srgb|gamma2.2|log0.01", requires = "ground_truth")]
    albedo: Option<Albedo>,

    /// How specular is stored where that differs
    #[arg(long, value_name = "linear|srgb|gamma2.2|log0.01", requires = "ground_truth")]
    specular_albedo: Option<Albedo>,

    /// Where the green of normal maps points [default: found out]
    #[arg(long, value_name = "up|down", requires = "ground_truth")]
    normal_y: Option<NormalY>,

    /// What roughness values mean [default: found out]
    #[arg(long, value_name = "r|gloss|alpha|axay|gamma2.2", requires = "ground_truth")]
    roughness: Option<Roughness>,

    /// How the components of normals are stored [default: found out]
    #[arg(long, value_name = "unsigned|signed|xy|ag", requires = "ground_truth")]
    normal_code: Option<NormalCode>,

    /// Diffuse and specular, or base colour and metallic [default: by the maps that are there]
    #[arg(long, value_name = "specular|metallic", requires = "ground_truth")]
    workflow: Option<Workflow>,

    /// Reflectance of what is no metal, where no map says it [default: 0.04]
    #[arg(long, value_name = "F0", allow_negative_numbers = true, requires = "ground_truth")]
    dielectric_f0: Option<Reflectance>,

    /// What the renderer that diffuse was made for takes: d (1 - s), as ours, or plain d [default: deschaintre]
    #[arg(long, value_name = "deschaintre|plain", requires = "ground_truth")]
    energy: Option<Energy>,

    /// Order of the tiles of a packed image, a letter each: ndrs, dnrs, dsrn, ... [default: found out]
    #[arg(long, value_name = "LETTERS", requires = "ground_truth")]
    order: Option<Order>,

    /// How a packed image is divided [default: into square tiles]
    #[arg(long, value_name = "COLUMNSxROWS", requires = "ground_truth")]
    grid: Option<Grid>,

    /// Row 0 of every picture is the lowest one
    #[arg(long, value_name = "true|false", requires = "ground_truth")]
    #[arg(num_args = 0..=1, require_equals = true, default_missing_value = "true")]
    flip_v: Option<bool>,

    /// Which row of a packed image, or which material of a file of several, from 0 [default: 0]
    #[arg(long, value_name = "K", allow_negative_numbers = true, requires = "ground_truth")]
    exemplar: Option<usize>,

    /// What becomes of NaN and infinity [default: refuse]
    #[arg(long, value_name = "refuse|replace", requires = "ground_truth")]
    non_finite: Option<NonFinite>,

    /// Fails where something could only be guessed, or an accuracy is not reached
    #[arg(long, requires = "ground_truth")]
    pub strict: bool,

    /// Says all that was found and assumed in reading, not only what is unsure or was changed
    #[arg(short, long)]
    verbose: bool,
}

impl ReadingArgs {
    pub fn options(&self) -> ReadOptions {
        ReadOptions {
            preset: self.preset,
            albedo: self.albedo,
            specular: self.specular_albedo,
            normal_y: self.normal_y,
            normal_code: self.normal_code,
            roughness: self.roughness,
            workflow: self.workflow,
            dielectric: self.dielectric_f0,
            energy: self.energy,
            order: self.order,
            grid: self.grid,
            exemplar: self.exemplar,
            flip_v: self.flip_v,
            non_finite: self.non_finite,
        }
    }

    /// Refuses guesses where the user wants none.
    ///
    /// # Errors
    /// [`Error::Guessed`].
    pub fn check<T>(&self, path: &Path, read: &Read<T>) -> Result<(), Error> {
        if self.strict { read.refuse_guesses(path) } else { Ok(()) }
    }

    /// The material, after what there is to say about its files: what is unsure, changed or left out, or everything.
    pub fn noted<T: Real>(&self, read: Read<T>) -> Material<T> {
        let mut said: Vec<String> = read.said().collect();
        if !self.verbose {
            said = noteworthy(&read);
        }
        for note in said {
            tell(&format!("note: {}: {note}", read.material.name()));
        }
        read.material
    }
}

/// What of it a person should know before using the material.
fn noteworthy<T>(read: &Read<T>) -> Vec<String> {
    // That a file is a map as its name says, or as the user says, is no news.
    let names_a_file = |note: &str| {
        let file = |map: &MapReport| map.file.file_name().unwrap_or_default().to_string_lossy().into_owned();
        read.maps.iter().any(|map| note.ends_with(&format!(" map is {}.", file(map))))
    };
    let notes = read.notes.iter().filter(|note| !note.ends_with("as you said.") && !names_a_file(note));
    let doubtful = |a: &&Assumption| match a.certainty {
        Certainty::Given => false,
        Certainty::Unsure => true,
        _ => matches!(a.what, What::Missing | What::Size | What::Values),
    };
    let assumptions = read.assumptions.iter().filter(doubtful);
    notes.cloned().chain(assumptions.map(ToString::to_string)).collect()
}

impl Reading {
    pub fn of_ground_truth(&self) -> ReadOptions {
        self.with_albedo(self.gt_albedo)
    }

    pub fn of_predictions(&self) -> ReadOptions {
        self.with_albedo(self.pred_albedo)
    }

    fn with_albedo(&self, albedo: Option<Albedo>) -> ReadOptions {
        let options = self.both.options();
        ReadOptions { albedo: albedo.or(options.albedo), ..options }
    }
}

fn preset_help() -> String {
    let known = Preset::ALL.map(Preset::name).join(", ");
    format!("What a source of materials does, for all that the other options leave open: {known}")
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
