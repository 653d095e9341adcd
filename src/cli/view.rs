//! `svbrdf view`: the window.

use svbrdf::error::Error;

use super::exit::tell;
use super::materials::MaterialArgs;

#[derive(Debug, clap::Args)]
pub struct ViewArgs {
    #[command(flatten)]
    materials: MaterialArgs,
}

/// Opens the window and returns when it is closed.
///
/// # Errors
/// [`Error::NoWindow`] without a display, [`Error::NoAdapter`] without a graphics adapter.
pub fn run(args: ViewArgs) -> Result<(), Error> {
    let shown = open_window(args.materials);
    if let Err(Error::NoWindow { .. } | Error::NoAdapter { .. }) = shown {
        tell("note: `svbrdf loss` and `svbrdf render` work without a window");
    }
    shown
}

#[cfg(feature = "viewer")]
fn open_window(materials: MaterialArgs) -> Result<(), Error> {
    use super::reading::ResizeTo;

    let fit = match materials.reading.resize_to {
        None => false,
        Some(ResizeTo::GroundTruth) => true,
        Some(_) => {
            return Err(Error::Usage(
                "the window brings predictions to the size of the ground truth only (--resize-to gt); \
                 `svbrdf convert` writes a material of any size"
                    .to_owned(),
            ));
        }
    };
    let session = session_of(&materials)?;
    svbrdf::viewer::run(svbrdf::viewer::ViewerOptions {
        session,
        strict: materials.reading.both.strict,
        fit,
        ground_truth_read: materials.reading.of_ground_truth(),
        prediction_read: materials.reading.of_predictions(),
        ground_truth: materials.ground_truth,
        predictions: materials.predictions,
    })
}

/// The session file that is given in place of a ground truth.
#[cfg(feature = "viewer")]
fn session_of(materials: &MaterialArgs) -> Result<Option<svbrdf::files::session::Session>, Error> {
    use svbrdf::files::session::Session;

    let session = materials.ground_truth.as_ref().filter(|path| Session::is_named(path));
    if session.is_some() && !materials.predictions.is_empty() {
        return Err(Error::Usage("a session names its predictions itself; give it alone".to_owned()));
    }
    session.map(|path| Session::read(path)).transpose()
}

#[cfg(not(feature = "viewer"))]
fn open_window(_: MaterialArgs) -> Result<(), Error> {
    Err(Error::NoWindow {
        problem: "this program was built without the window".to_owned(),
        remedy: "build with the default features",
    })
}
