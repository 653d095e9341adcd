//! `svbrdf convert`: a material into files of another kind.

use std::path::PathBuf;

use svbrdf::error::Error;
use svbrdf::material::Material;
use svbrdf::material::write::{self, Depth, Kind};

use super::materials::{ReadingArgs, noted, read_one};

/// Writes a material as one layered EXR, as a packed PNG or into a folder
///
/// By what OUT ends in: .exr is one layered EXR of linear floats, .png a packed strip normal | diffuse | roughness |
/// specular, all linear; anything else a folder of four PNG files, colours in sRGB.
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

    #[command(flatten)]
    reading: ReadingArgs,
}

/// Reads, and writes.
///
/// # Errors
/// Those of the reader and of the writer.
pub fn run(args: &ConvertArgs) -> Result<(), Error> {
    let kind = Kind::new(&args.output, args.depth)?;
    let read = read_one(&args.material, &args.reading.options())?;
    args.reading.check(&args.material, &read)?;
    let material: Material<f32> = noted(read);
    write::write(&material, &args.output, kind)
}
