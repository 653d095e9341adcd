//! `svbrdf convert`: writes a material in another format.

use std::path::PathBuf;

use svbrdf_core::material::Material;
use svbrdf_files::disk::inputs::check_output;
use svbrdf_files::read::Binding;
use svbrdf_files::write::{self, Depth, FileKind};

use super::args::reading::ReadingArgs;
use super::args::{NamedPath, offered};
use super::job::materials::{OneMaterial, noted};
use super::job::{Job, NewJob};
use super::output::exit::tell;
use super::output::{CommandError, stoppable};

/// Writes a material as layered EXR, packed PNG, glTF or into a folder
///
/// The extension of OUT selects the format: .exr is one layered EXR, linear; .png is a packed strip normal | diffuse |
/// roughness | specular, linear; .glb is binary glTF, a plane with the material: base colour and metallic where these change
/// diffuse and specular by at most one step of 8 bits, else KHR_materials_specular. A folder gets four PNG files, colours in
/// sRGB; it is a name without an extension, with / at its end, or of an empty folder.
#[derive(Debug, clap::Args)]
pub struct ConvertArgs {
    /// A packed or layered image, a folder, a name prefix, or one of the files; NAME=PATH names it
    #[arg(id = "ground_truth", value_name = "IN", required = true, value_parser = NamedPath::parser())]
    material: NamedPath,

    /// File or folder to write
    #[arg(value_name = "OUT", required = true)]
    output: PathBuf,

    /// Type of the samples [default: half in a layered EXR, else 8 bits]
    #[arg(long, value_name = "8|16|half|float")]
    #[arg(value_parser = offered(str::parse::<Depth>, ["8", "16", "half", "float"]), hide_possible_values = true)]
    depth: Option<Depth>,

    /// Takes a map from another file, or from a channel or layer of it; may be given several times
    ///
    /// MAP is normal, diffuse, base, specular, roughness or metallic; PART is r, g, b, a or the name of a layer; a
    /// number or three, as in roughness=0.5, is a constant. The map
    /// replaces that of IN.
    #[arg(long = "map", value_name = "MAP=FILE[:PART]")]
    bindings: Vec<Binding>,

    #[command(flatten)]
    reading: ReadingArgs,
}

#[derive(Debug)]
struct ConvertJob {
    material: OneMaterial,
    output: PathBuf,
    kind: FileKind,
}

impl ConvertArgs {
    pub fn job(self) -> NewJob {
        let Self { material, output, depth, bindings, reading } = self;
        let kind = FileKind::new(&output, depth)?;
        let material = OneMaterial::new(material, bindings, &reading)?;
        Ok(Box::new(ConvertJob { material, output, kind }))
    }
}

/// Reads and writes the material.
impl Job for ConvertJob {
    fn run(self: Box<Self>) -> Result<(), CommandError> {
        let Self { material, output, kind } = *self;
        let read = material.read()?;
        check_output(&output)?;
        let material: Material<f32> = noted(read, material.verbose);
        let note = stoppable(|progress| write::write_watched(&material, &output, kind, progress))?;
        if let Some(note) = note {
            tell(&format!("note: {}: {note}", output.display()));
        }
        Ok(())
    }
}
