//! The report: one HTML file with an interactive figure and the findings of a comparison, which opens in any browser, offline.
//!
//! Its script and style are files of this folder, admitted by their hashes in a content security policy that admits nothing else.
//! Names of files and materials are data of the script, or escaped text.

mod content;
mod data;
mod encode;
mod findings;
mod markup;
mod pictures;
mod ranking;
mod ranking_views;

use std::path::Path;

use svbrdf_core::error::Error as CoreError;
use svbrdf_core::loss::check_same_size;
use svbrdf_core::material::Material;
use svbrdf_core::picture::content::{ColouredDifference, PictureContent};
use svbrdf_core::progress::Progress;
use svbrdf_files::Error;

pub use content::{Findings, PageReport, View};
use encode::EncodedMaterial;
pub use findings::report_html;
use markup::{Document, MOST_NAMES, escaped, filled};
pub use pictures::exposure;
pub use ranking::{MaterialView, ranking};
pub use ranking_views::{Figures, material_views};
use svbrdf_files::disk::atomic::check_place;

const PAGE: &str = include_str!("page.html");
const STYLE: &str = include_str!("page.css");
/// The script: one module, whose parts share their names.
const SCRIPT: &str = concat!(
    include_str!("codec.js"),
    include_str!("camera.js"),
    include_str!("shading.js"),
    include_str!("figure.js"),
    include_str!("gestures.js"),
    include_str!("keys.js"),
    include_str!("overlay.js"),
    include_str!("legend.js"),
    include_str!("controls.js"),
    include_str!("main.js"),
);
/// Most bytes of the file of a report.
pub const MOST_BYTES: usize = 10_000_000;
/// Longest side of the maps that pictures of the page are rendered from.
const RENDERED: usize = 512;
/// Maps are not reduced below this side.
const SMALLEST: usize = 16;
/// Maps of 10 channels of 2 bytes that would have to deflate to less than one part in this are halved at once.
const MOST_DEFLATED: usize = 16;

/// A report as HTML.
#[derive(Clone, Debug)]
pub struct Page {
    pub html: String,
    /// The size of the maps in the figure, where they were reduced; findings are of all texels.
    pub reduced_to: Option<[usize; 2]>,
}

/// Checks that a report can be at `path`, before there is anything to write.
///
/// # Errors
/// [`CoreError::UnknownName`] where it is not named like HTML; those of [`check_place`].
pub fn check_destination(path: &Path) -> Result<(), Error> {
    let ending = path.extension().map(|ending| ending.to_ascii_lowercase());
    if !ending.is_some_and(|ending| ending == "html" || ending == "htm") {
        let (found, known) = (path.display().to_string(), "NAME.html".to_owned());
        return Err(CoreError::unknown_name("name of a report", found, known).into());
    }
    check_place(path)
}

impl PageReport<'_> {
    /// The report as one HTML file.
    ///
    /// # Errors
    /// [`CoreError::SizesDiffer`], [`Cancelled`](Error::is_cancelled).
    pub fn page(&self, progress: &Progress) -> Result<Page, Error> {
        if let [ground_truth, predictions @ ..] = self.materials {
            predictions.iter().try_for_each(|prediction| check_same_size(ground_truth, prediction))?;
        }
        let small = pictures::reduced(self.materials, RENDERED)?;
        let small: Vec<&Material<f32>> = small.iter().collect();
        let content = self.content();
        let view = &self.view;
        let drawn = self.convention.drawn();
        let still = pictures::still(&small, content, &view.scene, &drawn, view.exposure_ev)?;
        let (sections, scenes) = findings::sections(self);
        let frame = Document::bytes_without_body(STYLE, SCRIPT);
        let fixed = frame + PAGE.len() + still.len() + sections.len() + 64 * 1024;
        let (materials, reduced_to) = self.encoded(self.max_bytes.saturating_sub(fixed), progress)?;
        let data = data::json(&materials, self, &scenes)?;
        let title = self.title();
        let body = filled(
            PAGE,
            &[
                ("header", &self.header(reduced_to)),
                ("still", &still),
                ("still-alt", &format!("Still picture: {title}")),
                ("caption", &self.caption()),
                ("findings", &sections),
                ("data", &markup::embedded(&data)),
            ],
        );
        let summary = self.summary().unwrap_or_else(|| format!("{title}."));
        let description = &format!("{summary} An interactive figure: drag the light.");
        let document = Document { title: &title, description, style: STYLE, script: SCRIPT, body: &body };
        Ok(Page { html: document.html(), reduced_to })
    }

    /// What the still picture displays.
    fn content(&self) -> PictureContent {
        let display = &self.view.display;
        // The figure below it computes differences of single texels.
        let (kind, range) = display.differences.pointwise(display.quantity);
        let range = range.unwrap_or_else(|| kind.default_range());
        let difference = ColouredDifference { kind, range: Some(range) };
        let is_difference = display.difference && self.materials.len() > 1;
        PictureContent { quantity: display.quantity, difference: is_difference.then_some(difference) }
    }

    /// The names of the materials, or the number of many.
    fn title(&self) -> String {
        let names: Vec<String> = self.materials.iter().map(|material| escaped(material.name())).collect();
        match names.as_slice() {
            [ground_truth, predictions @ ..] if predictions.len() > MOST_NAMES => {
                format!("{} predictions against {ground_truth}", predictions.len())
            }
            [ground_truth, predictions @ ..] if !predictions.is_empty() => {
                format!("{} against {ground_truth}", predictions.join(", "))
            }
            _ => names.join(", "),
        }
    }

    fn summary(&self) -> Option<String> {
        self.findings.as_ref().map(|found| findings::summary(&found.loss))
    }

    /// What the still picture has.
    fn caption(&self) -> String {
        let names: Vec<String> = self.materials.iter().map(|material| escaped(material.name())).collect();
        let epsilon = self.convention.epsilon;
        let drawn = self.convention.drawn().name;
        let drawn = if drawn == self.convention.name { String::new() } else { format!(" Drawn as {drawn}.") };
        let content = self.content().text(epsilon);
        let masked = if self.is_masked { " Gray: outside of the mask, and not compared." } else { "" };
        format!("In reading order: {}. Shown: {}.{drawn}{masked}", names.join(", "), escaped(&content))
    }

    fn header(&self, reduced_to: Option<[usize; 2]>) -> String {
        let note = reduced_to.map_or(String::new(), |[width, height]| {
            format!(
                r#"<p class="note">The maps of the figure are reduced to {width} &times; {height} texels, so that the file is small. All losses are of the full maps.</p>"#
            )
        });
        if self.findings.is_none() && self.command.is_none() {
            return note;
        }
        let summary = self.summary().map_or(String::new(), |text| format!("<p>{text}</p>"));
        format!("<header><h1>{}</h1>{summary}{note}</header>", self.title())
    }

    /// The maps in at most `bytes` bytes, halved as often as that takes, and their size where they are.
    fn encoded(
        &self,
        bytes: usize,
        progress: &Progress,
    ) -> Result<(Vec<EncodedMaterial>, Option<[usize; 2]>), Error> {
        let mut materials: Vec<Material<f32>> = self.materials.iter().map(|one| (*one).clone()).collect();
        let mut reduced_to = None;
        loop {
            if progress.is_cancelled() {
                return Err(CoreError::Cancelled.into());
            }
            let [width, height] = materials.first().map_or([0, 0], Material::size);
            let is_hopeless = width * height * 20 * materials.len() / MOST_DEFLATED > bytes;
            let can_shrink = width.min(height) >= 2 * SMALLEST;
            if !(is_hopeless && can_shrink) {
                let encoded = materials.iter().map(EncodedMaterial::new).collect::<Result<Vec<_>, _>>()?;
                if !can_shrink || encoded.iter().map(EncodedMaterial::bytes).sum::<usize>() <= bytes {
                    return Ok((encoded, reduced_to));
                }
            }
            let size = [width.div_ceil(2), height.div_ceil(2)];
            materials =
                materials.into_iter().map(|material| material.resized(size)).collect::<Result<_, _>>()?;
            reduced_to = Some(size);
        }
    }
}
