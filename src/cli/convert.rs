//! `svbrdf convert`: writes a material in another format.

use std::path::PathBuf;

use svbrdf::error::Error;
use svbrdf::files::read::{Binding, Preset};
use svbrdf::files::write::{self, Depth, Kind, WriteOptions};
use svbrdf::material::Material;

use super::materials::read_one;
use super::reading::ReadingArgs;
use super::stop::stoppable;

/// Writes a material as one layered EXR, as a packed PNG or into a folder
///
/// The extension of OUT decides: .exr is one layered EXR of linear floats, .png a packed strip normal | diffuse |
/// roughness | specular, all linear; anything else a folder of four PNG files, colours in sRGB.
#[derive(Debug, clap::Args)]
pub struct ConvertArgs {
    /// A packed or layered image, a folder, a name prefix, or one of the files
    #[arg(id = "ground_truth", value_name = "IN", required = true)]
    material: PathBuf,

    /// File or folder to write
    #[arg(value_name = "OUT", required = true)]
    output: PathBuf,

    /// How samples are stored [default: half in EXR, 8 bits in PNG]
    #[arg(long, value_name = "8|16|half|float")]
    depth: Option<Depth>,

    /// The source of materials whose order, names and encoding the files follow
    ///
    /// A packed PNG can follow deschaintre (the default), gao, materialgan, lookahead or matfusion; a folder materialgan,
    /// or gltf: base colour, normals and occlusion | roughness | metallic, which loses specular that these cannot
    /// express.
    #[arg(long, value_name = "PRESET")]
    like: Option<Preset>,

    /// Adds a rendering to an EXR, as R, G and B for programs that do not read layers
    #[arg(long)]
    preview: bool,

    /// A map by its file, or by a channel or layer of it; may be given several times
    ///
    /// MAP is normal, diffuse, base, specular, roughness or metallic; PART is r, g, b, a or the name of a layer. The map
    /// replaces that of IN.
    #[arg(long = "map", value_name = "MAP=FILE[:PART]")]
    bindings: Vec<Binding>,

    #[command(flatten)]
    reading: ReadingArgs,
}

/// Reads and writes the material.
///
/// # Errors
/// Those of the reader and of the writer.
pub fn run(args: &ConvertArgs) -> Result<(), Error> {
    let options = WriteOptions { depth: args.depth, like: args.like, preview: args.preview };
    let kind = Kind::new(&args.output, &options)?;
    let read = read_one(&args.material, &args.bindings, &args.reading.options())?;
    args.reading.check(&args.material, &read)?;
    let material: Material<f32> = args.reading.noted(read);
    stoppable(|progress| write::write_watched(&material, &args.output, kind, progress))
}
