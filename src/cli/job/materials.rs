//! The materials of a command: resolved to their sources, then opened.

use std::path::{Path, PathBuf};
use std::sync::Arc;

use svbrdf_core::error::Error as CoreError;
use svbrdf_core::material::{Mask, Material};
use svbrdf_core::math::real::Real;
use svbrdf_core::text::quoted;
use svbrdf_evaluate::dataset::{self, Case, Method};
use svbrdf_evaluate::diagnose::Storage;
use svbrdf_evaluate::protocols::MaskSource;
use svbrdf_evaluate::registration::{Registration, registered};
use svbrdf_evaluate::report::distinct_names;
use svbrdf_files::Error;
use svbrdf_files::disk::memory::Reserved;
use svbrdf_files::disk::open::is_pipe_at;
use svbrdf_files::read::{Assumption, Binding, MaterialPath, Read, ReadOptions};
use svbrdf_files::samples;
use svbrdf_files::scene_file;
use svbrdf_files::session::Session;
use svbrdf_files::source::MaterialSource;

use crate::cli::args::protocol::PairArgs;
use crate::cli::args::reading::{PairReadingArgs, ReadingArgs, ResizeTo};
use crate::cli::args::{MaterialArgs, NamedPath, Specified, refuse};
use crate::cli::output::{CommandError, advice, exit, watched};

/// Longest side of a material that is resized, as of one that is read.
const MAX_SIDE: usize = 16_384;
/// Most bytes of one, as of one that is read.
const MAX_BYTES: usize = 4 << 30;

/// The ground truth and its predictions, to be opened.
#[derive(Debug)]
pub struct MaterialJob {
    /// The ground truth first.
    sources: Vec<MaterialSource>,
    /// The paths on the command line: those of the sources, or that of a session; none for the built-in materials.
    pub paths: Vec<PathBuf>,
    resize_to: Option<ResizeTo>,
    /// How predictions of another size may lie on the ground truth; empty: in any way.
    ways: Vec<Registration>,
    mask: Option<MaskSource>,
    /// Whether predictions are compared with the ground truth, so that those of another size are looked for in it.
    pub is_comparison: bool,
    /// Factor and offset on the roughness of the ground truth, and of predictions.
    roughness: [Option<[f64; 2]>; 2],
    /// Whether a guess in reading, or an accuracy that is not reached, is an error.
    pub strict: bool,
    verbose: bool,
}

impl MaterialJob {
    /// The materials of `session`, or those that the command line names, or the built-in ones where it names none.
    pub fn new(
        args: &MaterialArgs,
        session: Option<&Session>,
        given: &Specified,
    ) -> Result<Self, CommandError> {
        let sources = match (session, &args.ground_truth) {
            (Some(session), _) => {
                args.refuse_of_session(given)?;
                session.materials.clone()
            }
            (None, Some(_)) => {
                args.paths().try_for_each(|path| check_kind(path))?;
                args.sources()?
            }
            (None, None) => {
                args.refuse_of_built_in(given)?;
                (0..samples::COUNT).map(MaterialSource::built_in).collect()
            }
        };
        let PairReadingArgs { resize_to, both: ReadingArgs { strict, verbose, .. }, .. } = args.reading;
        let ways = args.reading.register.iter().map(|(whose, way)| match whose {
            None => Ok(*way),
            Some(whose) => Err(CommandError::Usage(format!(
                "--register: {whose} is no method of a data set; give the way alone"
            ))),
        });
        let ways: Vec<Registration> = ways.collect::<Result<_, _>>()?;
        refuse(resize_to.is_some() && !ways.is_empty(), "resize-to", "--register decides the size")?;
        let paths = args.paths().cloned().collect();
        let roughness = [None; 2];
        let mask = session.and_then(|session| session.mask.as_deref()).map(MaskSource::named);
        let is_comparison = false;
        Ok(Self { sources, paths, resize_to, ways, mask, is_comparison, roughness, strict, verbose })
    }

    /// Takes over how pairs are compared.
    pub fn compare(&mut self, PairArgs { protocol, mask }: &PairArgs) {
        self.mask(mask.mask.as_ref());
        let Some(protocol) = &protocol.protocol else { return };
        let sides = [&protocol.ground_truths, &protocol.predictions];
        self.roughness = sides.map(|side| side.roughness);
        for (index, source) in self.sources.iter_mut().enumerate() {
            source.options = source.options.over(sides[index.min(1)].read);
        }
        self.mask(self.mask.clone().as_ref().or(protocol.mask.as_ref()));
        if self.ways.is_empty() {
            self.ways.clone_from(&protocol.registration);
        }
    }

    /// Compares only the texels of a mask; without one, those of the mask of the session, where it has one.
    pub fn mask(&mut self, mask: Option<&MaskSource>) {
        self.mask = mask.cloned().or_else(|| self.mask.take());
    }

    /// Refuses the mask of a session where all texels are compared.
    pub fn refuse_mask(&self, reason: &str) -> Result<(), CommandError> {
        let way = "leave out --mask, or give the materials in place of the session";
        let problem = || CommandError::Usage(format!("{reason}, and not over those of a mask; {way}"));
        self.mask.as_ref().map_or(Ok(()), |_| Err(problem()))
    }

    /// The materials, as a session has them.
    pub fn sources(&self) -> Vec<MaterialSource> {
        let fits = self.resize_to == Some(ResizeTo::GroundTruth);
        self.sources.iter().map(|one| MaterialSource { fit: one.fit || fits, ..one.clone() }).collect()
    }

    /// The mask, as a session has it.
    pub fn saved_mask(&self) -> Option<PathBuf> {
        self.mask.as_ref().map(|mask| mask.to_string().into())
    }

    /// The number of predictions.
    pub fn predictions(&self) -> usize {
        self.sources.len() - 1
    }

    /// Refuses a ground truth without predictions.
    pub fn check_predictions(&self) -> Result<(), CommandError> {
        match self.paths.first() {
            Some(path) if self.predictions() == 0 => Err(CommandError::Usage(format!(
                "there is no prediction to compare with {}; give one or more after it",
                path.display()
            ))),
            _ => Ok(()),
        }
    }

    /// Opens the materials under distinct names, reports what is unsure, changed or left out in their files, and brings them to
    /// one size where that is asked for.
    pub fn open<T: Real>(&self) -> Result<OpenedMaterials<T>, CommandError> {
        let read = self.sources.iter().map(|source| self.read(source)).collect::<Result<Vec<Read<T>>, _>>();
        let read = read.inspect_err(|_| note_paths(&self.paths))?;
        let named: Vec<_> = read
            .iter()
            .zip(&self.sources)
            .map(|(read, source)| (read.material.name(), source.location()))
            .collect();
        let mut materials: Vec<Material<T>> = Vec::new();
        check_names(&self.sources, &named)?;
        let names = distinct_names(&named);
        let storages = read.iter().map(Read::storage).collect();
        let memory = read.iter().map(|read| read.memory.clone()).collect();
        let readings = read.iter().map(reading).collect();
        let masked = self.mask.as_ref().zip(read.first());
        let mut mask = masked.map(|(mask, truth)| mask.of(truth.material.name(), truth)).transpose()?;
        for ((mut read, name), source) in read.into_iter().zip(names).zip(&self.sources) {
            read.material = read.material.renamed(name);
            let mut material = noted(read, self.verbose);
            if let Some(change) = self.roughness[usize::from(!materials.is_empty())] {
                material = material.with_roughness(change);
            }
            let size = materials.first().map_or_else(|| material.size(), Material::size);
            materials.push(if source.fit { material.resized(size)? } else { material });
        }
        if let Some(to) = self.resize_to {
            materials = resized(materials, to)?;
            mask = mask.and_then(|mask| mask.resized(materials[0].size()));
        }
        if self.is_comparison && !self.strict || !self.ways.is_empty() {
            let found = registered(materials, mask, &self.ways)?;
            found.note.iter().for_each(|note| exit::tell(&format!("note: {note}")));
            (materials, mask) = (found.materials, found.mask);
        }
        if self.mask.is_some() && mask.is_none() {
            return Err(CommandError::usage("the mask keeps no texel of the predictions; leave out --mask"));
        }
        let mut materials = materials.into_iter();
        // There is a source at least.
        let Some(ground_truth) = materials.next() else {
            return Err(Error::Internal("there is no ground truth".to_owned()).into());
        };
        Ok(OpenedMaterials {
            mask,
            ground_truth,
            predictions: materials.collect(),
            storages,
            readings,
            _memory: memory,
        })
    }

    fn read<T: Real>(&self, source: &MaterialSource) -> Result<Read<T>, Error> {
        note_pipe(source.location());
        let read = watched(&format!("reading {source}"), |progress| source.read(progress))?;
        if self.strict {
            read.refuse_guesses(source.location())?;
        }
        Ok(read)
    }
}

/// The ground truth and its predictions.
#[derive(Debug)]
pub struct OpenedMaterials<T> {
    pub ground_truth: Material<T>,
    pub predictions: Vec<Material<T>>,
    /// Which texels are compared, where not all are.
    pub mask: Option<Mask>,
    /// How each is stored, the ground truth first.
    pub storages: Vec<Storage>,
    /// For each material the assumptions and notes of reading it.
    pub readings: Vec<Vec<String>>,
    /// The memory of the materials. It counts towards the limit while this lives.
    _memory: Vec<Arc<Reserved>>,
}

impl<T> OpenedMaterials<T> {
    /// The ground truth, then the predictions.
    pub fn into_all(self) -> Vec<Material<T>> {
        std::iter::once(self.ground_truth).chain(self.predictions).collect()
    }
}

/// A pipe is read to its end before anything is decoded: it may have none.
pub fn note_pipe(path: &Path) {
    if is_pipe_at(path) {
        exit::tell(&format!("note: {} is a pipe, which is read to its end", path.display()));
    }
}

/// Refuses a list of scenes and a table where a material is expected.
fn check_kind(path: &Path) -> Result<(), CommandError> {
    let extension = path.extension().unwrap_or_default().to_ascii_lowercase();
    let place = match extension.to_str() {
        Some("json") if scene_file::is_named(path) => "a list of scenes is given as --scenes FILE",
        Some("csv") => "a table of pairs is given as `svbrdf rank --pairs FILE`",
        _ => return Ok(()),
    };
    let problem = || CommandError::Usage(format!("{} is not a material: {place}", path.display()));
    if path.is_file() { Err(problem()) } else { Ok(()) }
}

/// Tells where `paths` that cannot be read come from, or which command takes them.
fn note_paths(paths: &[PathBuf]) {
    let [ground_truths, others @ ..] = paths else { return };
    if Session::is_among(paths) {
        exit::tell(&format!("note: the session {} names the materials", ground_truths.display()));
    }
    if others.is_empty() || !paths.iter().all(|path| path.is_dir()) {
        return;
    }
    let method = |path: &PathBuf| Method { name: path.display().to_string(), path: path.clone() };
    let cases = dataset::cases_of_folders(ground_truths, &others.iter().map(method).collect::<Vec<_>>());
    let is_matched = |case: &Case| case.candidates.iter().any(|candidate| candidate.missing.is_none());
    let count = cases.map_or(0, |cases| cases.iter().filter(|case| is_matched(case)).count());
    if count > 0 {
        let paths: Vec<String> = paths.iter().map(quoted).collect();
        let (names, paths) = (paths.join(" and "), paths.join(" "));
        exit::tell(&format!(
            "note: {names} have {count} materials of the same names: svbrdf rank --dataset {paths} compares them"
        ));
    }
}

/// Refuses a name that is given to one material and that another one has, too.
fn check_names(sources: &[MaterialSource], named: &[(&str, &Path)]) -> Result<(), CommandError> {
    let count = |name: &str| named.iter().filter(|(other, _)| *other == name).count();
    let given = sources.iter().filter_map(|source| source.name.as_deref());
    match given.map(|name| (count(name), name)).find(|(count, _)| *count > 1) {
        Some((count, name)) => Err(CommandError::Usage(format!(
            "{count} materials have the name {name}; give each its own as NAME=PATH"
        ))),
        None => Ok(()),
    }
}

/// The only material of a command, to be read.
#[derive(Debug)]
pub struct OneMaterial {
    pub material: NamedPath,
    /// Maps that replace its own.
    pub bindings: Vec<Binding>,
    pub options: ReadOptions,
    strict: bool,
    pub verbose: bool,
}

impl OneMaterial {
    pub fn new(
        material: NamedPath,
        bindings: Vec<Binding>,
        reading: &ReadingArgs,
    ) -> Result<Self, CommandError> {
        let options = reading.of_one(&material.source())?;
        let ReadingArgs { strict, verbose, .. } = *reading;
        Ok(Self { material, bindings, options, strict, verbose })
    }

    /// Reads it, under its name where it is given one.
    pub fn read<T: Real>(&self) -> Result<Read<T>, Error> {
        let NamedPath { name, path } = &self.material;
        note_pipe(path);
        let read: Read<T> = watched(&format!("reading {}", path.display()), |progress| {
            MaterialPath::new(path, &self.options).bound(&self.bindings).read(progress)
        })?;
        if self.strict {
            read.refuse_guesses(path)?;
        }
        let name = name.clone().unwrap_or_else(|| read.material.name().to_owned());
        Ok(Read { material: read.material.renamed(name), ..read })
    }
}

/// The assumptions and notes of reading one material, as `svbrdf info` prints them.
fn reading<T: Real>(read: &Read<T>) -> Vec<String> {
    let assumptions = read.assumptions.iter().map(ToString::to_string);
    assumptions.chain(read.notes.iter().map(advice::with_option)).collect()
}

/// The material of what was read, after a note for everything unsure, changed or left out in its files; with `verbose` for
/// everything noticed and assumed.
pub fn noted<T: Real>(read: Read<T>, verbose: bool) -> Material<T> {
    let is_doubtful = |a: &&Assumption| verbose || a.is_doubtful();
    let notes = read.notes.iter().filter(|note| verbose || !note.is_routine()).map(advice::with_option);
    let doubtful = read.assumptions.iter().filter(is_doubtful).map(ToString::to_string);
    for note in notes.chain(doubtful) {
        exit::tell(&format!("note: {}: {note}", read.material.name()));
    }
    read.material
}

/// Materials stand side by side only where they are equally high.
pub fn check_heights(materials: &[Material<f32>]) -> Result<(), CoreError> {
    let different = |pair: &&[Material<f32>]| pair[0].height() != pair[1].height();
    let Some(pair) = materials.windows(2).find(different) else { return Ok(()) };
    Err(CoreError::SizesDiffer {
        first: pair[0].name().to_owned(),
        first_size: pair[0].size(),
        second: pair[1].name().to_owned(),
        second_size: pair[1].size(),
        remedy: "only equally high materials can stand side by side; render them one by one",
    })
}

/// Every material in one size.
fn resized<T: Real>(materials: Vec<Material<T>>, to: ResizeTo) -> Result<Vec<Material<T>>, CommandError> {
    let of = match to {
        ResizeTo::Prediction if materials.len() > 1 => &materials[1],
        _ => &materials[0],
    };
    let [w, h] = of.size();
    let size = match to {
        ResizeTo::Width(width) => {
            let size = [width, (h * width + w / 2).checked_div(w).unwrap_or(1).max(1)];
            check_size::<T>(size)?;
            size
        }
        _ => [w, h],
    };
    let bring = |material: Material<T>| {
        let ([w, h], [width, height]) = (material.size(), size);
        if material.size() != size {
            exit::tell(&format!("note: {} is resized from {w} x {h} to {width} x {height}", material.name()));
        }
        Ok(material.resized(size)?)
    };
    materials.into_iter().map(bring).collect()
}

/// Whether a material of this size can be expected to fit into memory.
fn check_size<T>([width, height]: [usize; 2]) -> Result<(), CommandError> {
    // Three planes each of normals, diffuse and specular, one of roughness.
    let bytes = width.saturating_mul(height).saturating_mul(10 * size_of::<T>());
    if width.max(height) <= MAX_SIDE && bytes <= MAX_BYTES {
        return Ok(());
    }
    Err(CommandError::TooLarge { width, height, bytes, max_side: MAX_SIDE, max_bytes: MAX_BYTES })
}
