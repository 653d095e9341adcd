//! `svbrdf view`: the window.

use std::path::PathBuf;

use svbrdf_core::error::Error;
#[cfg(feature = "viewer")]
use svbrdf_core::loss::FileScenes;
#[cfg(feature = "viewer")]
use svbrdf_core::model::scene::Scene;
use svbrdf_files::photograph::Capture;
#[cfg(feature = "viewer")]
use svbrdf_files::photograph::SessionPhotograph;
use svbrdf_files::scene_file;
use svbrdf_files::session::Session;

use super::args::photograph::{PhotoReadingArgs, PhotoSceneArgs};
use super::args::{Given, MaterialArgs, modes};
use super::output::CommandError;
use super::output::exit::tell;

#[derive(Debug, clap::Args)]
#[command(mut_arg("predictions", |arg| arg.help("Predictions of it, of the same size. A scene file (JSON) among them has the \
    scenes of the loss")))]
#[cfg_attr(not(feature = "viewer"), allow(dead_code, reason = "there is no window to open"))]
pub struct ViewArgs {
    /// Compares renderings with this photograph, in the place of the ground truth; or with those of a capture: its folder, or the
    /// file that lists them
    #[arg(long, value_name = "FILE")]
    photo: Option<PathBuf>,

    #[command(flatten)]
    photo_scene: PhotoSceneArgs,

    #[command(flatten)]
    photo_reading: PhotoReadingArgs,

    #[command(flatten)]
    materials: MaterialArgs,
}

/// Opens the window and returns when it is closed.
///
/// # Errors
/// [`Error::NoWindow`] without a display, [`Error::NoAdapter`] without a graphics adapter.
pub fn run(args: ViewArgs, given: &Given) -> Result<(), CommandError> {
    given.check(&modes::VIEW)?;
    match args.materials.paths().find(|path| !scene_file::is_named(path)) {
        None => given.check(&modes::BUILT_IN)?,
        Some(path) if Session::is_named(path) => given.check(&modes::SESSION)?,
        Some(_) => (),
    }
    if args.photo.as_deref().is_some_and(Capture::is_named) {
        given.check(&modes::VIEW_CAPTURE)?;
    }
    let closed = open_window(args);
    if let Err(CommandError::Library(Error::NoWindow { .. } | Error::NoAdapter { .. })) = closed {
        tell("note: `svbrdf loss` and `svbrdf render` work without a window");
    }
    closed
}

#[cfg(feature = "viewer")]
fn open_window(args: ViewArgs) -> Result<(), CommandError> {
    use super::args::reading::ResizeTo;
    use super::job::session;

    let fit = match args.materials.reading.resize_to {
        None => false,
        Some(ResizeTo::GroundTruth) => true,
        Some(_) => {
            return Err(CommandError::usage(
                "the window brings predictions to the size of the ground truth only (--resize-to gt); \
                 `svbrdf convert` writes a material of any size",
            ));
        }
    };
    let photograph = photograph_of(&args)?;
    let mut materials = args.materials;
    let scenes = take_scenes(&mut materials)?;
    let session = session::given(&materials)?;
    let sources =
        if session.is_none() && materials.ground_truth.is_some() { materials.sources()? } else { Vec::new() };
    let mut sources = sources.into_iter();
    Ok(svbrdf::open_viewer(svbrdf::ViewerOptions {
        session,
        photograph,
        scenes,
        strict: materials.reading.both.strict,
        fit,
        ground_truth: sources.next(),
        predictions: sources.collect(),
    })?)
}

/// The photograph, and its light and view where they are specified.
#[cfg(feature = "viewer")]
fn photograph_of(args: &ViewArgs) -> Result<Option<(SessionPhotograph, Option<Scene>)>, Error> {
    let photograph = args.photo.clone().map(|path| args.photo_reading.photograph(path));
    let opened =
        photograph.map(|one| scene_file::open_photograph(one, args.photo_scene.specified().as_ref()));
    opened.transpose()
}

/// Takes the scene file out of `materials`, and reads it.
#[cfg(feature = "viewer")]
fn take_scenes(materials: &mut MaterialArgs) -> Result<Option<FileScenes>, Error> {
    let all = materials.ground_truth.take().into_iter().chain(std::mem::take(&mut materials.predictions));
    let (files, others): (Vec<_>, Vec<_>) = all.partition(|given| scene_file::is_named(&given.path));
    let mut others = others.into_iter();
    materials.ground_truth = others.next();
    materials.predictions = others.collect();
    let files: Vec<_> = files.into_iter().map(|given| given.path).collect();
    scene_file::read_one(&files)
}

#[cfg(not(feature = "viewer"))]
fn open_window(_: ViewArgs) -> Result<(), CommandError> {
    Err(CommandError::Library(Error::NoWindow {
        problem: "this program was built without the window".to_owned(),
        remedy: "build with the default features",
    }))
}
