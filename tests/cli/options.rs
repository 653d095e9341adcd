//! Every option in every mode of every subcommand: it changes the result, or is refused.

use std::collections::{BTreeMap, BTreeSet};
use std::fs;
use std::path::Path;

use image::{Rgb, RgbImage};
use rayon::prelude::*;
use serde_json::json;
use tempfile::TempDir;

use super::help::page;
use super::{folder, succeed, svbrdf, text, write_material, write_tiles};

const SESSION: &str = "s.svbrdf-session.json";

/// How much a run shows of what its options do.
#[derive(Clone, Copy, PartialEq)]
enum Shows {
    /// Everything: an option that is not refused changes the result.
    Everything,
    /// Nothing, since it takes long or needs a display: only the refused options are known.
    Refusals(&'static [&'static [&'static str]]),
}

/// How materials are read: a session specifies it.
#[rustfmt::skip]
const OF_SESSION: [&str; 22] = [
    "albedo", "specular-albedo", "normal-y", "roughness", "normal-encoding", "workflow", "dielectric-f0", "energy", "order", "grid",
    "flip-v", "exemplar", "non-finite", "gt:albedo", "pred:albedo", "pred:specular-albedo", "pred:normal-y", "pred:roughness",
    "pred:energy", "pred:preset", "preset", "resize-to",
];
/// The statements of `--read`, each of which is tried like an option of its own.
const READ: [(&str, &str); 20] = [
    ("albedo", "albedo=gamma2.2"),
    ("specular-albedo", "specular-albedo=srgb"),
    ("normal-y", "normal-y=down"),
    ("roughness", "roughness=gloss"),
    ("normal-encoding", "normal-encoding=signed"),
    ("workflow", "workflow=metallic"),
    ("dielectric-f0", "dielectric-f0=0.2"),
    ("energy", "energy=unscaled"),
    ("order", "order=dnrs"),
    ("grid", "grid=2x2"),
    ("flip-v", "flip-v=true"),
    ("exemplar", "exemplar=1"),
    ("non-finite", "non-finite=replace"),
    ("gt:albedo", "gt:albedo=gamma2.2"),
    ("pred:albedo", "pred:albedo=gamma2.2"),
    ("pred:specular-albedo", "pred:specular-albedo=srgb"),
    ("pred:normal-y", "pred:normal-y=down"),
    ("pred:roughness", "pred:roughness=gloss"),
    ("pred:energy", "pred:energy=unscaled"),
    ("pred:preset", "pred:preset=gao"),
];
/// The options of a photograph, and what a window has no use for.
#[rustfmt::skip]
const WITHOUT_PHOTO: [&str; 9] =
    ["verbose", "scene", "scene-number", "flash", "fov", "corners", "transfer", "clip", "falloff"];

/// The subcommands with arguments that select a mode; options are added to these.
const MODES: [(&str, Shows); 49] = [
    ("loss gt.png a.png", Shows::Everything),
    ("loss gt.png a.png --target-error 30%", Shows::Everything),
    ("loss gt.png a.png --scenes one.json", Shows::Everything),
    ("loss gt.png a.png --lights flash", Shows::Everything),
    ("loss s.svbrdf-session.json", Shows::Everything),
    ("loss", Shows::Everything),
    ("render gt.png a.png -o x.png", Shows::Everything),
    ("render gt.png -o x.png", Shows::Everything),
    ("render gt.png a.png -o x.png --show normal", Shows::Everything),
    ("render gt.png a.png -o x.png --difference", Shows::Everything),
    ("render s.svbrdf-session.json -o x.png", Shows::Everything),
    ("strip gt.png a.png -o x.png", Shows::Everything),
    ("strip gt.png a.png -o x.png --columns normal,diffuse,roughness,specular,diffuse:", Shows::Everything),
    ("strip gt.png a.png -o x.png --columns rendering", Shows::Everything),
    ("strip gt.png a.png -o x.png --lights flash", Shows::Everything),
    ("report gt.png a.png -o x.html --target-error 30%", Shows::Everything),
    ("report gt.png a.png -o x.html --figure", Shows::Everything),
    ("report gt.png -o x.html", Shows::Everything),
    ("report s.svbrdf-session.json -o x.html --target-error 30%", Shows::Everything),
    ("rank gt.png a.png b.png --target-error 30%", Shows::Everything),
    ("rank --dataset set/gt set/ours --target-error 30%", Shows::Everything),
    ("rank --dataset set/gt set/ours --target-error 30% --format html -o x.html", Shows::Everything),
    ("rank --pairs pairs.csv --target-error 30%", Shows::Everything),
    ("blame gt.png a.png", Shows::Everything),
    ("blame gt.png a.png --scenes one.json", Shows::Everything),
    ("diagnose gt.png a.png", Shows::Everything),
    ("scenes gt.png a.png --format csv", Shows::Everything),
    ("worst gt.png a.png", Shows::Everything),
    ("map gt.png a.png -o x.csv", Shows::Everything),
    ("map gt.png a.png -o x.csv --over lights --side 8", Shows::Everything),
    ("map gt.png a.png -o x.csv --over views --side 8", Shows::Everything),
    ("metrics gt.png a.png", Shows::Everything),
    ("metrics gt.png a.png --lights flash-9", Shows::Everything),
    ("metrics gt.png tilted.png --protocol matfusion", Shows::Everything),
    ("photo photo.png gt.png a.png --scene one.json", Shows::Everything),
    ("photo photo.png gt.png --flash --fov 45 -o x.png", Shows::Everything),
    ("photo --capture cap gt.png", Shows::Everything),
    ("photo --capture cap gt.png a.png", Shows::Everything),
    ("info gt.png", Shows::Everything),
    ("convert gt.png x.png", Shows::Everything),
    ("convert gt.png x.exr", Shows::Everything),
    ("convert gt.png x.glb", Shows::Everything),
    ("convert gt.png x.mtlx", Shows::Everything),
    ("study gt.png a.png -o none/x.csv", Shows::Refusals(&[])),
    ("study s.svbrdf-session.json -o none/x.csv", Shows::Refusals(&[&OF_SESSION])),
    (
        "view gt.png",
        Shows::Refusals(&[
            &WITHOUT_PHOTO,
            &[
                "pred:albedo",
                "pred:specular-albedo",
                "pred:normal-y",
                "pred:roughness",
                "pred:energy",
                "pred:preset",
            ],
        ]),
    ),
    ("view s.svbrdf-session.json", Shows::Refusals(&[&WITHOUT_PHOTO, &OF_SESSION])),
    (
        "view gt.png a.png --photo photo.png --flash --fov 45",
        Shows::Refusals(&[&["verbose", "scene", "scene-number"]]),
    ),
    ("view gt.png a.png --photo cap", Shows::Refusals(&[&WITHOUT_PHOTO])),
];

/// Values of the options, by option, or by subcommand and option where it means another thing there. Options without a value are flags.
const VALUES: [(&str, &str); 57] = [
    ("preset", "gao"),
    ("resize-to", "6"),
    ("convention", "guided-2020"),
    ("near", "3"),
    ("render distant", ""),
    ("strip distant", ""),
    ("report distant", ""),
    ("max-size", "1kB"),
    ("layout", "wipe"),
    ("distant", "5"),
    ("seed", "5"),
    ("sampler", "random"),
    ("scenes", "one.json"),
    ("lights", "flash"),
    ("texels", "3"),
    ("repeat", "b.png"),
    ("target-error", "25%"),
    ("time-budget", "1ms"),
    ("precision", "f64"),
    ("backend", "auto"),
    ("format", "json"),
    ("view", "0.2,0.1,2"),
    ("light", "0.1,0.2,1"),
    ("exposure", "1"),
    ("show", "diffuse"),
    ("photo difference", "absolute"),
    ("photo exposure", "photograph"),
    ("capture", "cap"),
    ("hold-out", "photo"),
    ("range", "0.125"),
    ("columns", "roughness"),
    ("crop", "1,1,3,3"),
    ("results", "kept"),
    ("shard", "1/2"),
    ("pick", "mean"),
    ("figures", "worst:1"),
    ("fail-above", "0.0001"),
    ("top", "3"),
    ("distance-tail", "0.001%"),
    ("over", "views"),
    ("fixed", "0.1,0.2,1"),
    ("side", "5"),
    ("protocol", "matfusion"),
    ("renderings", "written"),
    ("scene", "one.json"),
    ("scene-number", "0"),
    ("fov", "30"),
    ("corners", "0,0 7,0 7,7 0,7"),
    ("transfer", "linear"),
    ("clip", "0.2"),
    ("depth", "16"),
    ("like", "gao"),
    ("map", "roughness=gray.png"),
    ("plot", "x.svg"),
    ("photo", "photo.png"),
    ("view resize-to", "gt"),
    ("output", "y.png"),
];

/// Without these an option has nothing to work on: a file in the place of another, and further arguments.
const PREMISES: [(&str, [&str; 2], &str); 6] = [
    ("exemplar", ["gt.png", "rows.png"], ""),
    ("non-finite", ["gt.png", "nan"], ""),
    ("dielectric-f0", ["gt.png", "metal"], ""),
    ("shard", ["", ""], "--results kept"),
    ("scene-number", ["one.json", "two.json"], ""),
    ("photo difference", ["", ""], "-o y.png"),
];

/// Options that are used, and whose effect a mode does not show: how maps are read that are not in a picture of normals, and the
/// reflectance of dielectrics, which is no assumption.
const UNSEEN: [(&str, &[&str]); 2] = [
    (
        "render gt.png a.png -o x.png --show normal",
        &["dielectric-f0", "energy", "preset", "roughness", "pred:energy", "pred:preset", "pred:roughness"],
    ),
    ("info gt.png", &["dielectric-f0"]),
];

/// Everything that a mode reads.
fn fixture() -> TempDir {
    let folder = folder();
    let of = |name: &str| folder.path().join(name);
    let scene = r#"{"kind": "near", "view": [0, 0, 2], "light": [0.5, 0.5, 1]}"#;
    fs::write(of("two.json"), format!(r#"{{"scenes": [{scene}, {scene}]}}"#)).unwrap();
    let session = json!({
        "svbrdf-session": 1, "convention": "printed", "scene": {"kind": "near", "view": [0, 0, 2], "light": [0.5, 0.5, 1]},
        "materials": [{"path": "gt.png"}, {"path": "a.png"}],
    });
    fs::write(of(SESSION), session.to_string()).unwrap();
    succeed(folder.path(), "render b.png -o photo.png");
    fs::create_dir(of("cap")).unwrap();
    fs::copy(of("photo.png"), of("cap/photo.png")).unwrap();
    succeed(folder.path(), "render b.png -o cap/second.png --light 0.5,0.5,1");
    let photographs =
        ["photo", "second"].map(|name| format!(r#"{{"file": "{name}.png", "scene": {scene}}}"#));
    let capture = format!(r#"{{"photographs": [{}]}}"#, photographs.join(", "));
    fs::write(of("cap/capture.json"), capture).unwrap();
    let pixels = |name: &str| image::open(of(name)).unwrap().into_rgb8();
    let (top, bottom) = (pixels("gt.png"), pixels("b.png"));
    let at = |x, y| if y < 8 { *top.get_pixel(x, y) } else { *bottom.get_pixel(x, y - 8) };
    RgbImage::from_fn(32, 16, at).save(of("rows.png")).unwrap();
    RgbImage::from_pixel(8, 8, Rgb([90; 3])).save(of("gray.png")).unwrap();
    write_tiles(&of("tilted.png"), 8, |x, y| match x / 8 {
        0 => [128, (100 + 9 * y) as u8, 240],
        1 => [200, (8 * x) as u8, (8 * y) as u8],
        2 => [(60 + 20 * y) as u8; 3],
        _ => [12; 3],
    });
    for (name, maps) in [
        ("metal", ["normal", "basecolor", "roughness", "metallic"]),
        ("nan", ["normal", "", "roughness", "specular"]),
    ] {
        fs::create_dir(of(name)).unwrap();
        for (map, rgb) in maps
            .into_iter()
            .zip([[128, 128, 255], [180, 90, 60], [120; 3], [70; 3]])
            .filter(|(map, _)| !map.is_empty())
        {
            RgbImage::from_pixel(8, 8, Rgb(rgb)).save(of(name).join(format!("{map}.png"))).unwrap();
        }
    }
    let value = |x, y| if (x, y) == (1, 1) { (f32::NAN, 0.5, 0.5) } else { (0.2, 0.3, 0.4) };
    exr::prelude::write_rgb_file(of("nan/diffuse.exr"), 8, 8, value).unwrap();
    write_data_set(folder.path());
    let pairs = "gt.png,a.png\ngt.png,b.png\nb.png,a.png\nrows.png,a.png\nnan,a.png\nmetal,a.png\n";
    fs::write(of("pairs.csv"), format!("ground_truth,prediction\n{pairs}")).unwrap();
    folder
}

/// Two materials and a method, and one material of each kind that is read in its own way.
fn write_data_set(folder: &Path) {
    let of = |name: &str| folder.join(name);
    for (path, roughness) in
        [("gt/m0", 90), ("gt/m1", 120), ("ours/m0_0", 100), ("ours/m0_1", 160), ("ours/m1", 130)]
    {
        fs::create_dir_all(of("set").join(path).parent().unwrap()).unwrap();
        write_material(&of("set").join(format!("{path}.png")), 8, roughness);
    }
    for method in ["set/gt", "set/ours"] {
        fs::copy(of("rows.png"), of(method).join("rows.png")).unwrap();
        for name in ["metal", "nan"] {
            fs::create_dir(of(method).join(name)).unwrap();
            copied(&of(name), &of(method).join(name));
        }
    }
    write_material(&of("set/ours/rows.png"), 8, 99);
    RgbImage::from_pixel(8, 8, Rgb([60; 3])).save(of("set/ours/metal/roughness.png")).unwrap();
}

/// The names of the options of a subcommand, by its help page.
fn options(command: &str) -> BTreeSet<String> {
    let page = page(&[command.to_owned()]);
    let name = |line: &str| {
        let line = line.trim_start();
        let line = if line.starts_with("--") { line } else { line.strip_prefix('-')?.split_once(", ")?.1 };
        let end = line.find(|c: char| c != '-' && !c.is_alphanumeric()).unwrap_or(line.len());
        line[..end].strip_prefix("--").map(str::to_owned)
    };
    page.lines()
        .filter(|line| line.starts_with("  "))
        .filter_map(name)
        // Every command has the options of trust: `outside.rs` tests them.
        .filter(|name| !["help", "allow-outside", "max-memory"].contains(&name.as_str()))
        .collect()
}

/// The statements of `--read` in place of it: those for one side only where there are two.
fn statements(command: &str, option: String) -> Vec<String> {
    if option != "read" {
        return vec![option];
    }
    let is_tried = |key: &&str| !["info", "convert"].contains(&command) || !key.contains(':');
    READ.iter().map(|(key, _)| *key).filter(is_tried).map(str::to_owned).collect()
}

fn copied(from: &Path, to: &Path) {
    for entry in fs::read_dir(from).unwrap() {
        let path = entry.unwrap().path();
        let target = to.join(path.file_name().unwrap());
        if path.is_dir() {
            fs::create_dir(&target).unwrap();
            copied(&path, &target);
        } else {
            fs::copy(&path, target).unwrap();
        }
    }
}

fn contents(folder: &Path, found: &mut BTreeMap<String, Vec<u8>>) {
    for entry in fs::read_dir(folder).unwrap() {
        let path = entry.unwrap().path();
        if path.is_dir() {
            contents(&path, found);
        } else {
            let bytes = fs::read(&path).unwrap();
            let is_page = path.extension().is_some_and(|extension| extension == "html");
            found.insert(path.display().to_string(), if is_page { without_command(&bytes) } else { bytes });
        }
    }
}

/// A report without the command that makes it, which has all options.
fn without_command(page: &[u8]) -> Vec<u8> {
    let page = text(page);
    let [start, end] = ["<pre><code>", "</code></pre>"].map(|tag| page.find(tag));
    match start.zip(end) {
        Some((start, end)) => [&page[..start], &page[end..]].concat().into_bytes(),
        None => page.as_bytes().to_owned(),
    }
}

/// Exit code, stdout, stderr and all files after a run in a copy of `fixture`.
#[derive(PartialEq)]
struct Outcome {
    code: Option<i32>,
    stdout: Vec<u8>,
    stderr: String,
    files: Vec<(String, Vec<u8>)>,
}

impl Outcome {
    fn of(fixture: &Path, args: &str) -> Self {
        let folder = tempfile::tempdir().unwrap();
        copied(fixture, folder.path());
        let mut command = svbrdf();
        command.args(args.split_whitespace()).current_dir(folder.path());
        command.env("WGPU_BACKEND", "vulkan").env("VK_ICD_FILENAMES", "none").env("VK_DRIVER_FILES", "none");
        let output = command.output().unwrap();
        let mut files = BTreeMap::new();
        contents(folder.path(), &mut files);
        let root = folder.path().display().to_string();
        let files = files.into_iter().map(|(path, bytes)| (path[root.len()..].to_owned(), bytes)).collect();
        let stderr = text(&output.stderr).to_owned();
        Self { code: output.status.code(), stdout: output.stdout, stderr, files }
    }

    /// Whether it was refused as an option that is not used here; a value that is no value is a fault of this test.
    fn is_refused(&self) -> bool {
        let because = [
            "leave out --",
            "cannot be used with",
            "required arguments were not provided",
            "give both",
            "specify the number of near-field or distant scenes",
            "takes one CSV table",
            "only EXR has one",
            "cannot have that depth",
        ];
        self.code == Some(64) && because.iter().any(|text| self.stderr.contains(text))
    }
}

/// By option, or by subcommand and option where it means another thing there.
fn named<'a, T>(rows: &'a [T], name: impl Fn(&T) -> &str, mode: &str, option: &str) -> Option<&'a T> {
    let own = format!("{} {option}", mode.split(' ').next().unwrap());
    rows.iter().find(|row| name(row) == own).or(rows.iter().find(|row| name(row) == option))
}

/// The arguments of a mode to which an option is added.
fn base(mode: &str, option: &str) -> String {
    let premise = named(&PREMISES, |row| row.0, mode, option);
    let ([from, to], more) = premise.map_or((["", ""], ""), |(_, files, more)| (*files, *more));
    let more = if more.split(' ').next().is_some_and(|first| mode.contains(first)) { "" } else { more };
    let files = if from.is_empty() { mode.to_owned() } else { mode.replace(from, to) };
    format!("{files} {more}")
}

/// The problem of an option that is added to a mode, if there is one. `without` has the outcome of `base`.
fn problem(
    fixture: &Path,
    without: &BTreeMap<String, Outcome>,
    mode: &str,
    shows: Shows,
    option: &str,
) -> Option<String> {
    let typed = match READ.iter().find(|(key, _)| *key == option) {
        Some((_, statement)) => format!("--read {statement}"),
        None => {
            format!("--{option} {}", named(&VALUES, |row| row.0, mode, option).map_or("", |(_, value)| value))
        }
    };
    let base = base(mode, option);
    // `--corners` would take a path after it as a value: options come last.
    let with = Outcome::of(fixture, &format!("{base} {typed}"));
    if with.code == Some(64) && !with.is_refused() {
        return Some(format!("{base} {typed}: {}", with.stderr));
    }
    match shows {
        Shows::Everything if with.is_refused() => None,
        Shows::Everything => {
            let unseen = UNSEEN.iter().any(|(of, options)| *of == mode && options.contains(&option));
            (with == without[&base] && !unseen).then(|| format!("{base} ignores {typed}"))
        }
        Shows::Refusals(expected) => {
            let is_expected = expected.iter().any(|group| group.contains(&option));
            (with.is_refused() != is_expected).then(|| format!("{base} {typed}: {}", with.stderr))
        }
    }
}

#[test]
fn every_option_changes_the_result_or_is_refused() {
    let fixture = fixture();
    let pairs: Vec<(&str, Shows, String)> = MODES
        .iter()
        .flat_map(|(mode, shows)| {
            let command = mode.split(' ').next().unwrap();
            let specified: Vec<&str> = mode.split(' ').collect();
            let is_new = |option: &String| {
                let short = if option == "output" { "-o" } else { "--none" };
                !specified.contains(&format!("--{option}").as_str()) && !specified.contains(&short)
            };
            options(command)
                .into_iter()
                .filter(is_new)
                .flat_map(|option| statements(command, option))
                .map(|option| (*mode, *shows, option))
                .collect::<Vec<_>>()
        })
        .collect();
    assert!(pairs.len() > 700, "{} pairs", pairs.len());
    let bases: BTreeSet<String> = pairs
        .iter()
        .filter(|(_, shows, _)| *shows == Shows::Everything)
        .map(|(mode, _, option)| base(mode, option))
        .collect();
    let without: BTreeMap<String, Outcome> =
        bases.into_par_iter().map(|base| (base.clone(), Outcome::of(fixture.path(), &base))).collect();
    let problems: Vec<String> = pairs
        .par_iter()
        .filter_map(|(mode, shows, option)| problem(fixture.path(), &without, mode, *shows, option))
        .collect();
    assert!(problems.is_empty(), "{} of {}:\n{}", problems.len(), pairs.len(), problems.join("\n"));
}
