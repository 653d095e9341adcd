//! Connections of MaterialX, from the input of a node to what it leads to, and placements: how a picture lies over the surface, by its
//! node and the nodes of its coordinates.

use roxmltree::Node;

pub(super) fn input<'a, 'd>(node: Node<'a, 'd>, name: &str) -> Option<Node<'a, 'd>> {
    let is_named = |n: &Node<'_, '_>| n.attribute("name") == Some(name);
    node.children().filter(is_input).find(is_named)
}

pub(super) fn is_input(node: &Node<'_, '_>) -> bool {
    node.has_tag_name("input") || node.has_tag_name("parameter")
}

pub(super) fn target<'a, 'd>(input: Node<'a, 'd>) -> Option<Node<'a, 'd>> {
    fn named<'a, 'd>(scope: Node<'a, 'd>, name: &str) -> Option<Node<'a, 'd>> {
        scope.children().find(|n| !is_input(n) && n.attribute("name") == Some(name))
    }
    let node = match input.attribute("nodegraph") {
        Some(graph) => named(input.document().root_element(), graph)?,
        None => {
            let name = input.attribute("nodename")?;
            input.ancestors().skip(1).find_map(|scope| named(scope, name))?
        }
    };
    if !node.has_tag_name("nodegraph") {
        return Some(node);
    }
    let wanted = input.attribute("output");
    let mut outputs = node.children().filter(|n| n.has_tag_name("output"));
    // The output of a graph is connected as an input is.
    outputs.find(|n| wanted.is_none() || n.attribute("name") == wanted)
}

/// The input of the graph that `file` stands for.
pub(super) fn of_interface<'a, 'd>(file: Node<'a, 'd>, depth: usize) -> Node<'a, 'd> {
    let outer = || {
        let face = file.attribute("interfacename").filter(|_| file.attribute("value").is_none())?;
        let mut graphs = file.ancestors().filter(|n| n.has_tag_name("nodegraph"));
        graphs.find_map(|graph| input(graph, face)).filter(|outer| *outer != file && depth > 0)
    };
    outer().map_or(file, |outer| of_interface(outer, depth - 1))
}

/// Inputs of a picture that place it, beside its coordinates.
const PLACING: [&str; 6] =
    ["uvtiling", "uvoffset", "realworldimagesize", "realworldtilesize", "rotate", "offset"];
/// Inputs of coordinates that a node passes on.
const COORDINATES: [&str; 3] = ["texcoord", "st", "in"];
/// Nodes that read a set of coordinates.
const SETS: [&str; 3] = ["texcoord", "geompropvalue", "UsdPrimvarReader"];
/// Names of the first set.
const FIRST: [&str; 4] = ["0", "UV0", "st", "UVMap"];
/// Inputs of a picture that change no number of it, or are read elsewhere.
const READ: [&str; 22] = [
    "file",
    "default",
    "fallback",
    "layer",
    "uaddressmode",
    "vaddressmode",
    "filtertype",
    "framerange",
    "frameoffset",
    "frameendaction",
    "wrapS",
    "wrapT",
    "sourceColorSpace",
    "operationorder",
    "pivot",
    "scale",
    "bias",
    "factor",
    "color",
    "texcoord",
    "st",
    "in",
];

/// How the picture of `node` is placed; empty where it fills the first set of coordinates once.
pub(super) fn of_picture(node: Node<'_, '_>, depth: usize) -> String {
    // The scale of this node is one of colours.
    let is_usd = node.has_tag_name("UsdUVTexture");
    let counts =
        |name: &str| PLACING.contains(&name) || COORDINATES.contains(&name) || (name == "scale" && !is_usd);
    of_inputs(node, depth, counts).join(", ")
}

/// The inputs of a node of a picture that are not understood.
pub(super) fn unread(node: Node<'_, '_>) -> Vec<String> {
    let names = node.children().filter(is_input).filter_map(|input| input.attribute("name"));
    let unknown = names.filter(|name| !PLACING.contains(name) && !READ.contains(name));
    let kind = node.tag_name().name();
    unknown.map(|name| format!("{name} of {} ({kind})", node.attribute("name").unwrap_or_default())).collect()
}

/// What the inputs of `node` that count do to coordinates.
fn of_inputs(node: Node<'_, '_>, depth: usize, counts: impl Fn(&str) -> bool) -> Vec<String> {
    let Some(depth) = depth.checked_sub(1) else { return vec!["coordinates that lead nowhere".to_owned()] };
    let one = |input: Node<'_, '_>| {
        let name = input.attribute("name").filter(|name| counts(name))?;
        let input = of_interface(input, depth);
        let said = match (input.attribute("value"), target(input)) {
            (Some(value), _) if is_neutral(name, value) => return None,
            (Some(value), _) => format!("{name} {}", value.trim()),
            (None, Some(node)) => of_coordinates(node, depth),
            (None, None) => return None,
        };
        Some(said).filter(|said| !said.is_empty())
    };
    node.children().filter(is_input).filter_map(one).collect()
}

/// What a node does to coordinates; empty where it is the first set as it is.
fn of_coordinates(node: Node<'_, '_>, depth: usize) -> String {
    let kind = node.tag_name().name();
    if SETS.contains(&kind) {
        let names = ["index", "geomprop", "varname"];
        let is_named =
            |input: &Node<'_, '_>| input.attribute("name").is_some_and(|name| names.contains(&name));
        let set = node.children().filter(is_input).find(is_named);
        let set = set.and_then(|input| of_interface(input, depth).attribute("value")).unwrap_or("0").trim();
        return if FIRST.contains(&set) { String::new() } else { format!("{kind} {set}") };
    }
    let said = of_inputs(node, depth, |name| !["operationorder", "pivot"].contains(&name));
    if said.is_empty() { String::new() } else { format!("{kind} ({})", said.join(", ")) }
}

/// Whether a value places nothing: no offset and no turn, and a scale of 1.
fn is_neutral(name: &str, value: &str) -> bool {
    let neutral = if ["scale", "tiling", "size"].iter().any(|end| name.ends_with(end)) { 1.0 } else { 0.0 };
    value.split(',').all(|number| number.trim().parse() == Ok(neutral))
}
