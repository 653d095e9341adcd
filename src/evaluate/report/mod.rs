//! Reports: results with the settings that they depend on, as text, JSON and CSV.
//!
//! The command line prints them, the window copies their text, and Python has the same keys and values.
//!
//! ```
//! use svbrdf_core::loss::{Comparison, Request};
//! use svbrdf_core::material::Material;
//! use svbrdf_core::model::brdf::Texel;
//! use svbrdf_core::model::convention::Convention;
//! use svbrdf_core::progress::Progress;
//! use svbrdf_evaluate::analyses::LossReport;
//! use svbrdf_evaluate::report::Report;
//!
//! let texel = |roughness: f32| Texel { normal: glam::Vec3::Z, diffuse: [0.5; 3], specular: [0.04; 3], roughness };
//! let truth = Material::uniform("truth", 64, 64, &texel(0.6))?;
//! let prediction = Material::uniform("too rough", 64, 64, &texel(0.7))?;
//! let comparison = Comparison::new(&truth, &[&prediction], Convention::default())?;
//! let report = LossReport::answer(&comparison, &Request::default(), false, &Progress::default())?;
//! assert!(report.text().starts_with("rendering loss against truth, 64 x 64 texels, f32"));
//! assert!(report.csv()?.starts_with("prediction,loss,standard_error,"));
//! # Ok::<(), svbrdf_evaluate::Error>(())
//! ```

mod analysis;
mod conform;
mod heading;
mod info;
mod latex;
mod names;
mod table;

pub use analysis::{
    Analysis, AnalysisInput, AnalysisOption, NoOptions, OptionValue, SCENE_OPTIONS, Schematic, comparing,
};
pub use conform::ConformReport;
pub(crate) use heading::in_mask;
pub use heading::{
    Compared, Repetition, floor_line, missed, missed_by_any, position, scenes_line, stored_normals_note,
};
pub use info::InfoReport;
pub use latex::{bold, comments, digits, escaped, float, interval, latex, number, sentences};
pub use names::distinct_names;
pub use table::{Cell, Field, Reader, Table};

use serde::{Deserialize, Serialize};

use svbrdf_core::image::Image;
use svbrdf_files::Error as FilesError;

/// A value that can be written as JSON.
pub trait Json {
    /// One JSON object; ends with a line break.
    ///
    /// # Errors
    /// [`FilesError::Internal`], which no report of this crate gives.
    fn json(&self) -> Result<String, FilesError>;
}

impl<T: Serialize> Json for T {
    fn json(&self) -> Result<String, FilesError> {
        let text =
            serde_json::to_string_pretty(self).map_err(|problem| FilesError::Internal(problem.to_string()));
        Ok(text? + "\n")
    }
}

/// A report as it is printed.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Views {
    pub text: String,
    pub json: String,
    pub csv: String,
    /// What is known less well than requested.
    pub missed: Vec<String>,
}

impl Views {
    /// The views of a report.
    ///
    /// # Errors
    /// As [`Json::json`] and [`Report::csv`].
    pub fn of(report: &dyn Report) -> Result<Self, FilesError> {
        let (text, missed) = (report.text(), report.missed());
        Ok(Self { text, json: report.json()?, csv: report.csv()?, missed })
    }
}

/// A result with the settings that it depends on; its serialization is its JSON.
pub trait Report: Json {
    /// The settings: lines above the table, each with its line break.
    fn heading(&self) -> String;

    /// The results: for programs every value, for people a table to read.
    fn table(&self, reader: Reader) -> Table;

    /// The table for people with the settings above it; ends with a line break.
    fn text(&self) -> String {
        format!("{}\n{}", self.heading(), self.table(Reader::Person).text())
    }

    /// Its pictures, linear RGB, and what they show.
    fn pictures(&self) -> Option<(&[Image<f32>], &str)> {
        None
    }

    /// A sentence for each result that is known less well than requested.
    fn missed(&self) -> Vec<String> {
        Vec::new()
    }

    /// The [`Report::table`] for programs as CSV (RFC 4180) with a heading.
    ///
    /// # Errors
    /// [`FilesError::Internal`], which no table in memory gives.
    fn csv(&self) -> Result<String, FilesError> {
        self.table(Reader::Program).csv()
    }
}
