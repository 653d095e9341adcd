//! Options of reading: how the files of materials are read, and the size that materials are brought to.

use std::str::FromStr;

use svbrdf_files::read::{
    Albedo, Energy, NonFinite, NormalEncoding, NormalY, Order, Preset, ReadOptions, Reflectance, Roughness,
    TileGrid, Workflow,
};

use super::values::whole;

#[derive(Debug, clap::Args)]
#[command(next_help_heading = "Reading materials")]
pub struct PairReadingArgs {
    #[command(flatten)]
    pub both: ReadingArgs,

    /// --albedo for the ground truth only
    #[arg(long, value_name = "linear|srgb|gamma2.2|log0.01", requires = "ground_truth")]
    gt_albedo: Option<Albedo>,

    /// --albedo for the predictions only
    #[arg(long, value_name = "linear|srgb|gamma2.2|log0.01", requires = "ground_truth")]
    pred_albedo: Option<Albedo>,

    /// --specular-albedo for the predictions only
    #[arg(long, value_name = "linear|srgb|gamma2.2|log0.01", requires = "ground_truth")]
    pred_specular_albedo: Option<Albedo>,

    /// --normal-y for the predictions only
    #[arg(long, value_name = "up|down", requires = "ground_truth")]
    pred_normal_y: Option<NormalY>,

    /// --roughness for the predictions only
    #[arg(long, value_name = "r|gloss|alpha|axay|gamma2.2", requires = "ground_truth")]
    pred_roughness: Option<Roughness>,

    /// --energy for the predictions only
    #[arg(long, value_name = "scaled|unscaled", requires = "ground_truth")]
    pred_energy: Option<Energy>,

    /// Resizes all materials: to the size of the ground truth, of the first prediction, or to a width of N texels
    #[arg(long, value_name = "gt|pred|N", allow_negative_numbers = true, requires = "ground_truth")]
    pub resize_to: Option<ResizeTo>,
}

/// How one material is read. Options that are left out are inferred from the files and reported.
#[derive(Clone, Copy, Debug, clap::Args)]
#[command(next_help_heading = "Reading materials")]
pub struct ReadingArgs {
    /// Conventions of a source of materials, for the options that are left out
    #[arg(long, value_name = "NAME", requires = "ground_truth", long_help = preset_help())]
    preset: Option<Preset>,

    /// Encoding of diffuse, base colour and specular [default: inferred]
    #[arg(long, value_name = "linear|srgb|gamma2.2|log0.01", requires = "ground_truth")]
    albedo: Option<Albedo>,

    /// Encoding of specular where it differs
    #[arg(long, value_name = "linear|srgb|gamma2.2|log0.01", requires = "ground_truth")]
    specular_albedo: Option<Albedo>,

    /// Direction of y in normal maps: up (OpenGL) or down (DirectX) [default: inferred]
    #[arg(long, value_name = "up|down", requires = "ground_truth")]
    normal_y: Option<NormalY>,

    /// What roughness values mean [default: inferred]
    #[arg(long, value_name = "r|gloss|alpha|axay|gamma2.2", requires = "ground_truth")]
    roughness: Option<Roughness>,

    /// How the components of normals are stored [default: inferred]
    #[arg(long, alias = "normal-code", value_name = "unsigned|signed|xy|ag", requires = "ground_truth")]
    normal_encoding: Option<NormalEncoding>,

    /// Diffuse and specular, or base colour and metallic [default: by the maps that exist]
    #[arg(long, value_name = "specular|metallic", requires = "ground_truth")]
    workflow: Option<Workflow>,

    /// Reflectance of dielectrics, where no map holds it [default: 0.04]
    #[arg(long, value_name = "F0", allow_negative_numbers = true, requires = "ground_truth")]
    dielectric_f0: Option<Reflectance>,

    /// Whether the renderer that diffuse was made for scales it by (1 - specular) [default: scaled]
    #[arg(long, value_name = "scaled|unscaled", requires = "ground_truth")]
    energy: Option<Energy>,

    /// Order of the tiles of a packed image, a letter each: ndrs, dnrs, dsrn, ... [default: inferred]
    #[arg(long, value_name = "LETTERS", requires = "ground_truth")]
    order: Option<Order>,

    /// How a packed image is divided [default: into square tiles]
    #[arg(long, value_name = "COLUMNSxROWS", requires = "ground_truth")]
    grid: Option<TileGrid>,

    /// Row 0 of every image is the bottom row: mirrors the maps and the normals in them
    #[arg(long, value_name = "true|false", requires = "ground_truth")]
    #[arg(num_args = 0..=1, require_equals = true, default_missing_value = "true")]
    flip_v: Option<bool>,

    /// Which row of a packed image, or which material of a file of several, from 0 [default: 0]
    #[arg(long, value_name = "K", value_parser = whole::<usize>, allow_negative_numbers = true, requires = "ground_truth")]
    exemplar: Option<usize>,

    /// NaN and infinity: refuse the material, or replace them [default: refuse]
    #[arg(long, value_name = "refuse|replace", requires = "ground_truth")]
    non_finite: Option<NonFinite>,

    /// Fails where something in the files can only be guessed, or where an accuracy is not reached
    #[arg(long, requires = "ground_truth")]
    pub strict: bool,

    /// Reports everything noticed and assumed in reading, not only what is unsure or was changed
    #[arg(short, long)]
    pub verbose: bool,
}

impl ReadingArgs {
    pub fn options(&self) -> ReadOptions {
        ReadOptions {
            preset: self.preset,
            albedo: self.albedo,
            specular: self.specular_albedo,
            normal_y: self.normal_y,
            normal_encoding: self.normal_encoding,
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
}

impl PairReadingArgs {
    pub fn of_ground_truth(&self) -> ReadOptions {
        let both = self.both.options();
        ReadOptions { albedo: self.gt_albedo.or(both.albedo), ..both }
    }

    pub fn of_predictions(&self) -> ReadOptions {
        let both = self.both.options();
        ReadOptions {
            albedo: self.pred_albedo.or(both.albedo),
            specular: self.pred_specular_albedo.or(both.specular),
            normal_y: self.pred_normal_y.or(both.normal_y),
            roughness: self.pred_roughness.or(both.roughness),
            energy: self.pred_energy.or(both.energy),
            ..both
        }
    }
}

fn preset_help() -> String {
    let known = Preset::ALL.map(Preset::name).join(", ");
    format!("Conventions of a source of materials, for the options that are left out: {known}")
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
