//! The shaders without a GPU: naga parses and validates them, and tells where their members lie.
#![cfg(feature = "viewer")]

use std::collections::{BTreeMap, BTreeSet};
use std::mem::offset_of;
use std::path::Path;

use wgpu::naga;
use wgpu::naga::valid::{Capabilities, ValidationFlags, Validator};

use svbrdf_gpu::uniforms::{CameraUniforms, DisplayUniforms, ModelUniforms, SceneUniforms, ShadingUniforms};
use svbrdf_shaders::ALL;

/// A struct: its size, and the offset of each of its members.
type Layout = (usize, Vec<(String, usize)>);

macro_rules! layout {
    ($name:ident is $wgsl:ident { $($member:ident),+ }) => {(
        stringify!($wgsl),
        (size_of::<$name>(), vec![$((stringify!($member).to_owned(), offset_of!($name, $member))),+]),
    )};
}

/// Structs as Rust lays them out, with their names in WGSL.
fn layouts() -> [(&'static str, Layout); 5] {
    [
        layout!(ModelUniforms is Model { intensity, roughness_floor, light_z_floor, clamp_n_dot_h, d_floor, g_floor }),
        layout!(SceneUniforms is Rays { view, near, light }),
        layout!(ShadingUniforms is Shading { rays, model, largest, stride, size }),
        layout!(CameraUniforms is Camera { origin, origin_right, origin_up, direction, direction_right, direction_up }),
        layout!(DisplayUniforms is Display { camera, background, exposure, epsilon, wipe, range, stride, size, corner }),
    ]
}

fn parse(source: &str) -> Result<naga::Module, String> {
    let module = naga::front::wgsl::parse_str(source).map_err(|e| e.emit_to_string(source))?;
    Validator::new(ValidationFlags::all(), Capabilities::empty())
        .validate(&module)
        .map_err(|e| e.emit_to_string(source))?;
    Ok(module)
}

/// The struct called `name` in the first shader that has it.
fn reflected(modules: &[naga::Module], name: &str) -> Option<Layout> {
    let structs = modules.iter().flat_map(|m| m.types.iter().map(|(_, ty)| ty));
    structs.filter(|ty| ty.name.as_deref() == Some(name)).find_map(|ty| match &ty.inner {
        naga::TypeInner::Struct { members, span } => {
            let member = |m: &naga::StructMember| (m.name.clone().unwrap_or_default(), m.offset as usize);
            Some((*span as usize, members.iter().map(member).collect()))
        }
        _ => None,
    })
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
fn uniforms_are_laid_out_as_the_shaders_read_them() {
    let modules: Vec<_> = ALL.iter().map(|shader| parse(&shader.source()).expect("valid")).collect();
    for (name, layout) in layouts() {
        assert_eq!(reflected(&modules, name), Some(layout), "{name}: in WGSL, and in Rust");
    }
}
