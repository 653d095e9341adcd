//! Texts of a report by its authors, from a small TOML file.

use std::path::Path;

use serde::Deserialize;

use svbrdf_files::Error;
use svbrdf_files::disk::inputs;
use svbrdf_files::disk::open::NamedFile;

use super::markup::escaped;

/// Texts of a page; `None`: made from the materials, or left out.
#[derive(Clone, Debug, Default, PartialEq, Eq, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct About {
    /// In place of the names of the materials.
    pub title: Option<String>,
    /// A line below the title.
    pub authors: Option<String>,
    /// Below the figure.
    pub caption: Option<String>,
    /// How to cite.
    pub bibtex: Option<String>,
    /// Address of a picture for previews of links.
    pub image: Option<String>,
    /// No material is called a ground truth: the first is what others are compared with.
    #[serde(skip)]
    pub no_ground_truth: bool,
}

impl About {
    /// The texts in a TOML file.
    ///
    /// # Errors
    /// [`Error::BadAbout`]; where the file cannot be read.
    pub fn read(path: &Path) -> Result<Self, Error> {
        let text = NamedFile::by_user(path).text()?;
        inputs::protect(path);
        toml::from_str(&text).map_err(|problem| Error::BadAbout {
            path: path.to_owned(),
            problem: problem.message().to_owned(),
        })
    }

    /// What the first material, of this name, is called within a sentence, as HTML.
    pub(super) fn reference(&self, name: &str) -> String {
        if self.no_ground_truth { escaped(name) } else { "the ground truth".to_owned() }
    }

    /// What another material is called.
    pub(super) fn prediction(&self) -> &'static str {
        if self.no_ground_truth { "material" } else { "prediction" }
    }

    /// The caption, as HTML.
    pub(super) fn caption(&self) -> String {
        let text = |caption: &String| format!(r#"<p class="about">{}</p>"#, escaped(caption));
        self.caption.as_ref().map_or_else(String::new, text)
    }

    /// How to cite, as HTML.
    pub(super) fn citation(&self) -> String {
        let section = |bibtex: &String| {
            format!(
                r#"<section aria-labelledby="cite"><h2 id="cite">Citation</h2><pre><code>{}</code></pre></section>"#,
                escaped(bibtex.trim())
            )
        };
        self.bibtex.as_ref().map_or_else(String::new, section)
    }
}
