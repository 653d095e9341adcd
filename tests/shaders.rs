//! The shaders without a GPU: naga parses and validates them, and tells where their members lie.
#![cfg(feature = "viewer")]

use std::collections::{BTreeMap, BTreeSet};
use std::mem::offset_of;
use std::path::Path;

use wgpu::naga;
use wgpu::naga::valid::{Capabilities, ValidationFlags, Validator};

use svbrdf_gpu::uniforms::{CameraUniforms, DisplayUniforms, ModelUniforms, SceneUniforms, ShadingUniforms};
use svbrdf_shaders::ALL;

/// A struct as Rust lays it out: its name in WGSL, its size, its members with their offsets.
#[derive(Debug)]
struct Layout {
    name: &'static str,
    size: usize,
    members: Vec<(&'static str, usize)>,
}

macro_rules! layout {
    ($name:ident is $wgsl:ident { $($member:ident),+ }) => {
        Layout {
            name: stringify!($wgsl),
            size: size_of::<$name>(),
            members: vec![$((stringify!($member), offset_of!($name, $member))),+],
        }
    };
}

fn layouts() -> Vec<Layout> {
    vec![
        layout!(ModelUniforms is Model { intensity, roughness_floor, light_z_floor, clamp_n_dot_h, d_floor, g_floor }),
        layout!(SceneUniforms is Rays { view, near, light }),
        layout!(ShadingUniforms is Shading { rays, model, largest, stride, size }),
        layout!(CameraUniforms is Camera { origin, origin_right, origin_up, direction, direction_right, direction_up }),
        layout!(DisplayUniforms is Display { camera, background, exposure, epsilon, wipe, range, stride, size, corner }),
    ]
}

fn modules() -> Vec<naga::Module> {
    ALL.iter().map(|shader| parse(&shader.source()).expect("valid")).collect()
}

fn parse(source: &str) -> Result<naga::Module, String> {
    let module = naga::front::wgsl::parse_str(source).map_err(|e| e.emit_to_string(source))?;
    Validator::new(ValidationFlags::all(), Capabilities::empty())
        .validate(&module)
        .map_err(|e| e.emit_to_string(source))?;
    Ok(module)
}

/// (offset, size) of every member and the size of the struct called `name`, in the first shader that has it.
fn reflected(modules: &[naga::Module], name: &str) -> Option<(usize, Vec<(String, usize)>)> {
    let structs = modules.iter().flat_map(|m| m.types.iter().map(|(_, ty)| ty));
    structs.filter(|ty| ty.name.as_deref() == Some(name)).find_map(|ty| match &ty.inner {
        naga::TypeInner::Struct { members, span } => {
            let member = |m: &naga::StructMember| (m.name.clone().unwrap_or_default(), m.offset as usize);
            Some((*span as usize, members.iter().map(member).collect()))
        }
        _ => None,
    })
}

/// What of `layout` is not as in WGSL.
fn complaints(modules: &[naga::Module], layout: &Layout) -> Vec<String> {
    let Some((size, members)) = reflected(modules, layout.name) else {
        return vec![format!("no shader has a struct {}", layout.name)];
    };
    let rust: Vec<_> = layout.members.iter().map(|(name, offset)| ((*name).to_owned(), *offset)).collect();
    let mut complaints = Vec::new();
    if size != layout.size {
        complaints.push(format!("{}: {} bytes in Rust, {size} in WGSL", layout.name, layout.size));
    }
    if rust != members {
        complaints.push(format!("{}: in Rust {rust:?}, in WGSL {members:?}", layout.name));
    }
    complaints
}

#[test]
fn every_shader_is_valid_and_has_its_entry_points() {
    assert!(!ALL.is_empty());
    for shader in ALL {
        let module = parse(&shader.source()).unwrap_or_else(|error| panic!("{}:\n{error}", shader.name));
        assert!(module.entry_points.iter().any(|e| e.name == shader.name), "{}", shader.name);
    }
}

#[test]
fn every_file_of_the_shader_folder_is_in_a_shader() {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("shaders");
    let files: BTreeSet<String> = std::fs::read_dir(folder)
        .expect("the folder is readable")
        .map(|entry| entry.expect("readable").file_name().into_string().expect("a plain name"))
        .filter(|name| name.ends_with(".wgsl"))
        .collect();
    let pieces: BTreeSet<String> =
        ALL.iter().flat_map(|s| s.pieces).map(|(file, _)| (*file).to_owned()).collect();
    assert!(!files.is_empty());
    assert_eq!(files, pieces);
}

/// The functions of a piece without a function of that name in the Rust files that its header calls its twins, or without such files. The
/// first name in backticks in the line above is the Rust name.
fn without_twins(piece: &str, read: impl Fn(&str) -> Option<String>) -> Vec<String> {
    let header: Vec<&str> = piece.lines().take_while(|line| line.starts_with("//")).collect();
    let header = header.join(" ");
    let Some((_, named)) = header.split_once("the twin of ") else { return Vec::new() };
    let words = named.split([' ', ',', ':']).map(|word| word.trim_end_matches('.'));
    let files = words.filter(|word| word.ends_with(".rs"));
    let twins: String = files.map(|file| read(file).unwrap_or_else(|| format!("no file {file}"))).collect();
    let mut missing = Vec::new();
    for (above, line) in std::iter::once("").chain(piece.lines()).zip(piece.lines()) {
        let Some((name, _)) = line.strip_prefix("fn ").and_then(|rest| rest.split_once('(')) else {
            continue;
        };
        let named = above.strip_prefix("//").and_then(|comment| comment.split('`').nth(1));
        let name = named.unwrap_or(name);
        if !["(", "<"].iter().any(|after| twins.contains(&format!("fn {name}{after}"))) {
            missing.push(name.to_owned());
        }
    }
    missing
}

#[test]
fn every_function_of_a_twin_has_its_rust_function() {
    let root = Path::new(env!("CARGO_MANIFEST_DIR"));
    let read = |file: &str| std::fs::read_to_string(root.join(file)).ok();
    let pieces: BTreeMap<_, _> = ALL.iter().flat_map(|shader| shader.pieces).copied().collect();
    let twins = pieces.iter().filter(|(_, text)| text.contains("the twin of ")).count();
    assert!(twins >= 8, "{twins}");
    for (file, text) in pieces {
        assert_eq!(without_twins(text, read), Vec::<String>::new(), "{file}");
    }
}

#[test]
fn a_function_without_a_twin_and_a_file_that_moved_are_found() {
    let piece =
        "// A: the twin of src/a.rs,\n// and src/b.rs.\n\nfn one(x: f32) {}\n// `two`.\nfn zwei() {}\n";
    let found = |a: &str| without_twins(piece, |file| (file == "src/a.rs").then(|| a.to_owned()));
    assert_eq!(found("fn one<T>() {} fn two() {}"), Vec::<String>::new());
    assert_eq!(found("fn one() {} fn zwei() {}"), ["two"]);
    assert_eq!(found("fn two() {}"), ["one"]);
    assert_eq!(without_twins(piece, |_| None), ["one", "two"]);
}

#[test]
fn uniforms_are_laid_out_as_the_shaders_read_them() {
    let modules = modules();
    let wrong: Vec<String> = layouts().iter().flat_map(|layout| complaints(&modules, layout)).collect();
    assert!(wrong.is_empty(), "{}", wrong.join("\n"));
}

#[test]
fn a_wrong_layout_is_seen() {
    let modules = modules();
    layouts().into_iter().for_each(|planted| a_wrong_one_is_seen(planted, &modules));
    let unknown = Layout { name: "Unknown", size: 0, members: Vec::new() };
    assert!(!complaints(&modules, &unknown).is_empty());
}

fn a_wrong_one_is_seen(planted: Layout, modules: &[naga::Module]) {
    let Layout { name, size, members } = planted;
    let last = members.len() - 1;
    let mut moved = members.clone();
    moved[last].1 += 4;
    let mut swapped = members.clone();
    (swapped[0].0, swapped[1].0) = (members[1].0, members[0].0);
    let dropped = members[..last].to_vec();
    for members in [moved, swapped, dropped] {
        assert!(!complaints(modules, &Layout { name, size, members }).is_empty(), "{name}");
    }
    let longer = Layout { name, size: size + 16, members };
    assert!(!complaints(modules, &longer).is_empty(), "{name}");
}
