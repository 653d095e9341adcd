//! `svbrdf info`: the content of the files of a material, and the assumptions in reading them.

use std::fmt::Write as _;

use clap::ValueEnum;

use svbrdf_core::text::{line, printable};
use svbrdf_evaluate::report::{InfoReport, Json as _};
use svbrdf_files::read::{Binding, Read, Sidecar};

use super::args::reading::ReadingArgs;
use super::args::{NamedPath, refuse};
use super::job::materials::OneMaterial;
use super::job::{Job, NewJob};
use super::output::{CommandError, advice, exit, stoppable};

/// Prints what the files of a material hold, what was assumed in reading them, and why
#[derive(Debug, clap::Args)]
pub struct InfoArgs {
    /// A packed or layered image, a folder, a name prefix, or one of the files; NAME=PATH names it
    #[arg(id = "ground_truth", value_name = "MATERIAL", required = true, value_parser = NamedPath::parser())]
    material: NamedPath,

    /// Output format: text for people, json for programs
    #[arg(long, value_enum, default_value_t)]
    format: InfoFormat,

    /// Takes a map from another file, or from a channel or layer of it; may be given several times
    ///
    /// MAP is normal, diffuse, base, specular, roughness or metallic; PART is r, g, b, a or the name of a layer; a
    /// number or three, as in roughness=0.5, is a constant. The map
    /// replaces that of MATERIAL.
    #[arg(long = "map", value_name = "MAP=FILE[:PART]")]
    bindings: Vec<Binding>,

    /// Saves the options beside the material: they apply whenever it is opened
    ///
    /// The options are written to svbrdf.json in a folder, or to NAME.svbrdf.json beside a file NAME.png or the files of a prefix
    /// NAME_. Options of the command line take precedence over them.
    #[arg(long)]
    save: bool,

    #[command(flatten)]
    reading: ReadingArgs,
}

#[derive(Clone, Copy, Debug, Default, ValueEnum)]
enum InfoFormat {
    #[default]
    Text,
    Json,
}

#[derive(Debug)]
struct InfoJob {
    material: OneMaterial,
    save: bool,
    format: InfoFormat,
}

impl InfoArgs {
    pub fn job(self) -> NewJob {
        let Self { material, format, bindings, save, reading } = self;
        refuse(reading.verbose, "verbose", "everything noticed and assumed is printed in any case")?;
        Ok(Box::new(InfoJob { material: OneMaterial::new(material, bindings, &reading)?, save, format }))
    }
}

/// Reads the material and prints the report.
impl Job for InfoJob {
    fn run(self: Box<Self>) -> Result<(), CommandError> {
        let read: Read<f32> = self.material.read()?;
        if self.save {
            let OneMaterial { material: NamedPath { path, .. }, bindings, options, .. } = &self.material;
            let saved = Sidecar::load(path)?.overridden_by(options, bindings);
            let place = stoppable(|progress| saved.save(path, progress))?;
            exit::tell(&format!("note: saved in {}", place.display()));
        }
        let info = InfoReport::from(read);
        let printed = match self.format {
            InfoFormat::Text => printable(&text(&info)),
            InfoFormat::Json => info.json()?,
        };
        Ok(exit::put(&printed)?)
    }
}

fn text(info: &InfoReport) -> String {
    let mut text = format!("{}, {} x {} texels\n\nAs stored:\n", info.name, info.size[0], info.size[1]);
    for map in &info.maps {
        let _ = writeln!(text, "  {}", line(&map.to_string()));
    }
    text += "\nAssumed:\n";
    for assumption in &info.assumptions {
        let _ = writeln!(text, "  {}", line(&assumption.to_string()));
    }
    if !info.notes.is_empty() {
        text += "\nNoticed:\n";
    }
    for note in &info.notes {
        let _ = writeln!(text, "  {}", line(&advice::with_option(note)));
    }
    text
}
