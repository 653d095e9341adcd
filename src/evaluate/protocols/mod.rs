//! Protocols: what a paper or its code computes of predictions and ground truths, as data.
//!
//! A protocol is a TOML file with its source, how the files are read and registered, the scenes and the convention, and each metric with
//! how it is averaged over materials. The built-in ones stand beside this file.

mod record;

use std::path::Path;

use svbrdf_core::error::Error as CoreError;
use svbrdf_core::loss::LossOptions;
use svbrdf_files::disk::inputs;
use svbrdf_files::disk::open::NamedFile;

pub(crate) use record::by_name;
pub use record::{Aggregate, MaskSource, Protocol, ProtocolSource, Row, Scenes, Side};

use crate::error::Error;
use crate::metrics::MetricSelection;

/// The text of each that is built in, by its name.
const BUILT_IN: [(&str, &str); 8] = [
    ("deepbasis", include_str!("deepbasis.toml")),
    ("deschaintre", include_str!("deschaintre.toml")),
    ("marigold-iid", include_str!("marigold-iid.toml")),
    ("matfusion", include_str!("matfusion.toml")),
    ("matsynth", include_str!("matsynth.toml")),
    ("pypbr", include_str!("pypbr.toml")),
    ("stanford-orb", include_str!("stanford-orb.toml")),
    ("weiyi", include_str!("weiyi.toml")),
];

/// The version of the format of the files.
const VERSION: u32 = 1;

impl Protocol {
    /// The names of the built-in protocols.
    pub fn names() -> impl Iterator<Item = &'static str> {
        BUILT_IN.into_iter().map(|(name, _)| name)
    }

    /// The built-in protocol of this name, or that of a file, whose name ends with `.toml`.
    ///
    /// # Errors
    /// [`CoreError::UnknownName`]; [`Error::BadProtocol`]; where the file cannot be read.
    pub fn read(text: &str) -> Result<Self, Error> {
        let path = Path::new(text);
        if path.extension().is_some_and(|extension| extension.eq_ignore_ascii_case("toml")) {
            let found = NamedFile::by_user(path).text()?;
            inputs::protect(path);
            let problem = |problem| Error::BadProtocol { name: text.to_owned(), problem };
            return Ok(Self { file: Some(path.to_owned()), ..parsed(&found).map_err(problem)? });
        }
        let found = BUILT_IN.into_iter().find(|(name, _)| *name == text);
        let known = || Self::names().collect::<Vec<_>>().join(", ") + ", or a .toml file";
        let (_, found) = found.ok_or_else(|| CoreError::unknown_name("protocol", text, known()))?;
        parsed(found).map_err(|problem| Error::BadProtocol { name: text.to_owned(), problem })
    }
}

/// The protocol of this text, or what is wrong with it.
fn parsed(text: &str) -> Result<Protocol, String> {
    let protocol: Protocol = toml::from_str(text).map_err(|problem| problem.to_string())?;
    check(&protocol)?;
    Ok(protocol)
}

fn check(protocol: &Protocol) -> Result<(), String> {
    if protocol.version != VERSION {
        return Err(format!("version = {}; expected {VERSION}", protocol.version));
    }
    let known = MetricSelection::names();
    for row in &protocol.metrics {
        let name = row.metric.as_str();
        if !known.contains(&name) {
            return Err(format!("metric = {name:?}: there is none of this name; docs/metrics.md lists them"));
        }
        let is_square = ["rmse", "psnr"].iter().any(|measure| name.starts_with(measure));
        if row.over_materials == Aggregate::Pooled && !is_square {
            return Err(format!("{name}: only RMSE and PSNR are pooled; give mean or median"));
        }
    }
    if protocol.selection().has_renderings() && !protocol.metrics.is_empty() && protocol.scenes.is_none() {
        return Err("metrics of renderings need [scenes]".to_owned());
    }
    match &protocol.scenes {
        Some(Scenes { lights: Some(_), near: None, distant: None })
        | Some(Scenes { lights: None, near: Some(_), .. })
        | Some(Scenes { lights: None, distant: Some(_), .. })
        | None => {}
        Some(_) => return Err("[scenes] has near and distant, or lights".to_owned()),
    }
    let problem = |problem: Error| problem.to_string();
    protocol
        .options(&LossOptions::default())
        .map_err(problem)?
        .request()
        .map_err(|problem| problem.to_string())?;
    protocol.chosen_convention().map_err(problem).map(drop)
}
