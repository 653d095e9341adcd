//! The tables `tests/materials/*.toml`: which files are written, with which options they are read, and what must be read, or which words a
//! refusal must have.

mod arrays;
mod exr;
mod files;
pub mod formula;
mod table;

use std::collections::BTreeMap;
use std::path::{Path, PathBuf};

use tempfile::TempDir;

use svbrdf_core::progress::Progress;
use svbrdf_files::Error;
use svbrdf_files::read::{Binding, MaterialPath, Read, ReadOptions};

use formula::{Place, values};
pub use table::Case;
use table::{Table, table};

/// Half a code of 8 bits of a normal, and of the steepest encoding.
const EIGHT_BITS: f64 = 0.006;
/// The material of the formulas.
const SAME: [&str; 4] = ["N", "d", "s", "r"];

impl Case {
    fn read(&self, folder: &Path, path: &Path) -> Result<Read<f64>, Error> {
        let options = if self.read.is_empty() { ReadOptions::AUTO } else { self.read.parse()? };
        let map = |text: &String| -> Result<Binding, Error> {
            let (map, file) = text.split_once('=').unwrap_or((text, ""));
            let is_file = folder.join(file.split(':').next().unwrap_or_default()).is_file();
            let file = if is_file { folder.join(file).display().to_string() } else { file.to_owned() };
            Ok(format!("{map}={file}").parse()?)
        };
        let maps: Vec<Binding> = self.maps.iter().map(map).collect::<Result<_, _>>()?;
        MaterialPath::new(path, &options).bound(&maps).read(&Progress::default())
    }

    /// What is wrong with it.
    fn problems(&self, sets: &BTreeMap<String, toml::Table>) -> Vec<String> {
        let (folder, path) = self.put(sets);
        let mut problems = Vec::new();
        match self.read(folder.path(), &path) {
            Err(error) if self.refused.is_empty() => problems.push(format!("it is refused: {error}")),
            Err(error) => {
                let message = error.to_string();
                let missing = self.refused.iter().filter(|words| !message.contains(*words));
                problems.extend(missing.map(|words| format!("`{words}` is not in: {message}")));
            }
            Ok(_) if !self.refused.is_empty() => problems.push("it is not refused".to_owned()),
            Ok(read) => self.check(&read, &path, &mut problems),
        }
        problems
    }

    fn check(&self, read: &Read<f64>, path: &Path, problems: &mut Vec<String>) {
        let messages: Vec<String> = read.messages().collect();
        let mut expect = |is: bool, what: String| {
            if !is {
                problems.push(format!("{what}\n    {}", messages.join("\n    ")));
            }
        };
        let size = read.material.size();
        expect(self.size.is_none_or(|wanted| wanted == size), format!("its size is {size:?}"));
        let name = read.material.name();
        expect(self.called.as_ref().is_none_or(|called| called == name), format!("its name is {name}"));
        let own = [&self.normal, &self.diffuse, &self.specular, &self.roughness];
        for (map, (own, same)) in own.into_iter().zip(SAME).enumerate() {
            let Some(formula) = own.as_deref().filter(|text| !text.is_empty()).or(self.same.then_some(same))
            else {
                continue;
            };
            let (off, at, found) = difference(read, map, formula);
            let map = ["normal", "diffuse", "specular", "roughness"][map];
            let within = self.within.unwrap_or(EIGHT_BITS);
            expect(off <= within, format!("{map} is {found:.4?} at {at:?}, off by {off} from {formula}"));
        }
        let mut doubts: Vec<&str> = read.unsure().map(|doubt| doubt.what.name()).collect();
        doubts.dedup();
        let wanted: Vec<&str> =
            self.doubts.iter().flat_map(|all| all.split(", ")).filter(|doubt| !doubt.is_empty()).collect();
        expect(doubts == wanted, format!("it is unsure of {doubts:?}, not of {wanted:?}"));
        let is_said = |words: &String| messages.iter().any(|line| line.contains(words.as_str()));
        for words in self.says.iter().filter(|words| !is_said(words)) {
            expect(false, format!("`{words}` is not said"));
        }
        for words in self.hides.iter().filter(|words| is_said(words)) {
            expect(false, format!("`{words}` is said"));
        }
        let mut files: Vec<_> =
            read.files.iter().map(|file| file.file_name().unwrap().to_string_lossy().into_owned()).collect();
        files.sort();
        expect(self.reads.as_ref().is_none_or(|reads| *reads == files), format!("it reads {files:?}"));
        let guessed = read.refuse_guesses(path).is_err();
        expect(self.guessed.is_none_or(|wanted| wanted == guessed), format!("guessed is {guessed}"));
    }
}

/// How far map number `map` is from a formula at worst, with the place and the numbers there.
fn difference(read: &Read<f64>, map: usize, formula: &str) -> (f64, [usize; 2], Vec<f64>) {
    let size = read.material.size();
    let texels = (0..size[0] * size[1]).map(|index| {
        let texel = read.material.texel(index);
        let found = match map {
            0 => texel.normal.to_array().to_vec(),
            1 => texel.diffuse.to_vec(),
            2 => texel.specular.to_vec(),
            _ => vec![texel.roughness],
        };
        let place = Place { x: index % size[0], y: index / size[0], size };
        let expected = values(formula, place);
        let pairs =
            found.iter().enumerate().map(|(c, value)| (value - expected[c.min(expected.len() - 1)]).abs());
        (pairs.fold(0.0, f64::max), [place.x, place.y], found)
    });
    texels.max_by(|a, b| a.0.total_cmp(&b.0)).unwrap()
}

fn run(name: &str) {
    let Table { sets, cases } = table(name);
    let mut wrong = 0;
    for case in &cases {
        for problem in case.problems(&sets) {
            println!("{}: {problem}", case.name);
            wrong += 1;
        }
    }
    assert!(wrong == 0, "{wrong} problems of {} cases", cases.len());
}

#[test]
fn packed_pictures() {
    run("packed");
}

#[test]
fn sets_of_pictures() {
    run("sets");
}

#[test]
fn names_and_folders() {
    run("names");
}

#[test]
fn colours_and_normals() {
    run("values");
}

#[test]
fn formats_of_pictures() {
    run("pictures");
}

#[test]
fn documents() {
    run("documents");
}

#[test]
fn materialx() {
    run("materialx");
}

#[test]
fn options_and_sidecar_files() {
    run("options");
}

#[test]
fn refused_files() {
    run("refused");
}

#[test]
fn metadata() {
    run("metadata");
}

#[test]
fn the_table_of_metadata_is_made_of_its_cases() {
    const HEAD: &str = "| format | field | what is done |\n|---|---|---|";
    let mut made = vec![HEAD.to_owned()];
    for Case { format, field, done, .. } in table("metadata").cases {
        let line = format!("| {format} | {field} | {done} |");
        made.extend((!made.contains(&line)).then_some(line));
    }
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("docs/formats.md");
    let page = std::fs::read_to_string(&path).unwrap();
    let start = page.find(HEAD).unwrap();
    let end = start + page[start..].find("\n\n").unwrap();
    let made = made.join("\n");
    if std::env::var_os("SVBRDF_BLESS").is_some() {
        std::fs::write(path, [&page[..start], &made, &page[end..]].concat()).unwrap();
        return;
    }
    assert_eq!(&page[start..end], made, "renew the table with SVBRDF_BLESS=1");
}

/// The folders of the cases that are seeds, each with its case and the file to damage.
pub fn seeds() -> Vec<(Case, TempDir, PathBuf)> {
    let tables = ["pictures", "documents", "materialx", "options"].map(table);
    let seeds = tables.into_iter().flat_map(|Table { sets, cases }| {
        let of = move |case: Case| {
            let (folder, path) = case.put(&sets);
            (case, folder, path)
        };
        cases.into_iter().filter(|case| case.seed).map(of).collect::<Vec<_>>()
    });
    seeds.collect()
}

#[test]
fn a_table_sees_planted_faults() {
    let row = "files = { 'a.png' = 'n | d | r | s' }\nsame = true\nsize = [16, 16]\ncalled = 'a'\nreads = ['a.png']\n\
        says = ['albedo: linear']\nguessed = true";
    let case =
        |more: &str| -> Case { format!("{row}\n{more}").parse::<toml::Table>().unwrap().try_into().unwrap() };
    assert_eq!(case("").problems(&BTreeMap::new()), [""; 0]);
    for fault in [
        "normal = 'N.x, -N.y, N.z'",
        "diffuse = 'd + 0.01'",
        "specular = 's.y, s.y, s.y'",
        "roughness = 'r * r'",
        "doubts = ['albedo']",
        "hides = ['layout: ndrs']",
        "refused = ['no']",
        "read = 'albedo=srgb'",
        "maps = ['roughness=0.5']",
    ] {
        assert_ne!(case(fault).problems(&BTreeMap::new()), [""; 0], "{fault}");
    }
    for (from, to) in [
        ("[16, 16]", "[16, 8]"),
        ("'a'\n", "'b'\n"),
        ("['a.png']", "['b.png']"),
        ("linear'", "srgb'"),
        ("guessed = true", "guessed = false"),
    ] {
        let case: Case = row.replace(from, to).parse::<toml::Table>().unwrap().try_into().unwrap();
        assert_ne!(case.problems(&BTreeMap::new()), [""; 0], "{to}");
    }
}
