//! Resources of Godot: how a `StandardMaterial3D` beside pictures binds roughness and metallic.

use crate::read::located::set::ListedGray;
use crate::read::options::Role;

/// The gray maps, the names of their properties, and their values where the resource declares none.
const MAPS: [(Role, &str, f32); 2] = [(Role::Metallic, "metallic", 0.0), (Role::Roughness, "roughness", 1.0)];

/// The gray maps of the resource `text`; none of another resource: the channels of an `ORMMaterial3D` are those of its name.
pub(super) fn grays(text: &str) -> Vec<ListedGray> {
    let is_standard = ["StandardMaterial3D", "SpatialMaterial"]
        .iter()
        .any(|kind| text.contains(&format!("[gd_resource type=\"{kind}\"")));
    let gray = |(role, key, usual): (Role, &str, f32)| {
        let number = |key: &str| property(text, key).and_then(|value| value.parse::<f32>().ok());
        let channel = number(&format!("{key}_texture_channel")).unwrap_or(0.0) as usize;
        let file = property(text, &format!("{key}_texture")).and_then(|value| picture(text, value));
        // Channel 4 is the mean of all, which of a gray picture is red.
        let picture = file.map(|file| (file, if channel < 4 { channel } else { 0 }));
        ListedGray { role, picture, factor: number(key).unwrap_or(usual) }
    };
    if is_standard { MAPS.into_iter().map(gray).collect() } else { Vec::new() }
}

/// The value of the property `key`, each of which has a line of its own.
fn property<'a>(text: &'a str, key: &str) -> Option<&'a str> {
    text.lines()
        .find_map(|line| line.split_once('=').filter(|(name, _)| name.trim() == key))
        .map(|(_, v)| v.trim())
}

/// The name of the file that `ExtResource( 1 )` or `ExtResource("1_abc")` refers to.
fn picture(text: &str, value: &str) -> Option<String> {
    let id = value.strip_prefix("ExtResource(")?.trim_end_matches(')').trim().trim_matches('"');
    let is_it = |line: &&str| {
        let plain = line.trim_end_matches(']').replace('"', "");
        line.starts_with("[ext_resource") && plain.split_whitespace().any(|word| word == format!("id={id}"))
    };
    let (_, path) = text.lines().find(is_it)?.split_once("path=\"")?;
    let path = path.split('"').next()?;
    Some(path.rsplit('/').next().unwrap_or(path).to_owned())
}
