//! The shaders of the page: GLSL that naga makes of the WGSL of the window, committed in shaders/page.json.

use std::collections::BTreeMap;

use naga::back::glsl;
use naga::proc::BoundsCheckPolicies;
use naga::valid::{Capabilities, ValidationFlags, Validator};
use naga::{AddressSpace, Module, ShaderStage, TypeInner};
use serde_json::{Value, json};

use svbrdf_shaders::{PAGE, Shader};

const COMMITTED: &str = concat!(env!("CARGO_MANIFEST_DIR"), "/shaders/page.json");

/// The vertex and the fragment shader of a pass, the names of its bindings in GLSL, and the places of its uniforms in WGSL's layout,
/// which for these structs is std140.
fn program(shader: &Shader) -> Value {
    let module = naga::front::wgsl::parse_str(&shader.source()).unwrap();
    let info = Validator::new(ValidationFlags::all(), Capabilities::empty()).validate(&module).unwrap();
    let mut made = BTreeMap::new();
    let mut bindings = BTreeMap::new();
    for (index, entry) in module.entry_points.iter().enumerate() {
        let options = glsl::Options {
            version: glsl::Version::Embedded { version: 300, is_webgl: true },
            writer_flags: glsl::WriterFlags::empty(),
            ..glsl::Options::default()
        };
        let pipeline = glsl::PipelineOptions {
            shader_stage: entry.stage,
            entry_point: entry.name.clone(),
            multiview: None,
        };
        let mut text = String::new();
        let policies = BoundsCheckPolicies::default();
        let mut writer = glsl::Writer::new(&mut text, &module, &info, &options, &pipeline, policies).unwrap();
        let reflection = writer.write().unwrap();
        let name = if entry.stage == ShaderStage::Vertex { "vertex" } else { "fragment" };
        made.insert(name, text);
        let used = info.get_entry_point(index);
        for (handle, variable) in module.global_variables.iter() {
            if used[handle].is_empty() {
                continue;
            }
            let texture = reflection.texture_mapping.iter().find(|(_, mapping)| mapping.texture == handle);
            let found = reflection.uniforms.get(&handle).or(texture.map(|(name, _)| name));
            if let Some(found) = found {
                bindings.insert(variable.name.clone().unwrap(), found.clone());
            }
        }
    }
    json!({ "vertex": made["vertex"], "fragment": made["fragment"], "bindings": bindings, "uniforms": uniforms(&module) })
}

/// The uniform variables of a module: the offset in bytes of every member, and the size under the empty name.
fn uniforms(module: &Module) -> BTreeMap<String, BTreeMap<String, u32>> {
    let uniform = |variable: &&naga::GlobalVariable| variable.space == AddressSpace::Uniform;
    let variables = module.global_variables.iter().map(|(_, variable)| variable);
    let one = |variable: &naga::GlobalVariable| {
        let mut places = BTreeMap::new();
        let size = members(module, variable.ty, "", 0, &mut places);
        places.insert(String::new(), size);
        (variable.name.clone().unwrap(), places)
    };
    variables.filter(uniform).map(one).collect()
}

fn members(
    module: &Module,
    ty: naga::Handle<naga::Type>,
    prefix: &str,
    base: u32,
    places: &mut BTreeMap<String, u32>,
) -> u32 {
    let TypeInner::Struct { members: all, span } = &module.types[ty].inner else {
        places.insert(prefix.to_owned(), base);
        return 0;
    };
    for member in all {
        let name = member.name.clone().unwrap();
        let path = if prefix.is_empty() { name } else { format!("{prefix}.{name}") };
        members(module, member.ty, &path, base + member.offset, places);
    }
    *span
}

/// The programs of the page, as JSON.
fn programs() -> Value {
    json!(PAGE.iter().map(|(name, shader)| (name, program(shader))).collect::<BTreeMap<_, _>>())
}

#[test]
fn the_shaders_of_the_page_are_those_of_the_window() {
    let committed = std::fs::read_to_string(COMMITTED).unwrap_or_default();
    let committed = serde_json::from_str::<Value>(&committed).ok();
    assert!(committed == Some(programs()), "the WGSL has changed: cargo xtask bless shaders");
}

#[test]
#[ignore = "writes shaders/page.json: cargo xtask bless shaders"]
fn write_shaders() {
    std::fs::write(COMMITTED, format!("{:#}\n", programs())).unwrap();
}
