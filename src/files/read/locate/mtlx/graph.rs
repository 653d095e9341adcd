//! The node graph of MaterialX: inputs followed through other nodes to a picture or a value.

use roxmltree::Node;

use crate::read::located::mtlx::{Bound, BoundPicture, Obstacle};

/// Deeper than any chain of nodes from an input to its picture.
const DEEPEST: usize = 32;
/// Nodes that pass on what they get, or one channel of it.
const PASSING: [&str; 9] =
    ["normalmap", "extract", "separate2", "separate3", "separate4", "swizzle", "convert", "dot", "output"];

/// The input `name` of `node`.
pub(super) fn input<'a, 'd>(node: Node<'a, 'd>, name: &str) -> Option<Node<'a, 'd>> {
    let is_named = |n: &Node<'_, '_>| n.attribute("name") == Some(name);
    node.children().filter(|n| n.has_tag_name("input") || n.has_tag_name("parameter")).find(is_named)
}

/// What input `name` of `node` is bound to; `None` where the file does not declare it.
///
/// # Errors
/// [`Obstacle`].
pub(super) fn bound(node: Node<'_, '_>, name: &str) -> Result<Option<Bound>, Obstacle> {
    input(node, name)
        .map(|input| follow(input, Way { channel: None, scale: 1.0, depth: DEEPEST }))
        .transpose()
}

/// The attribute `name` of a node or of what it is in.
fn inherited(node: Node<'_, '_>, name: &str) -> Option<String> {
    node.ancestors().find_map(|n| n.attribute(name)).map(str::to_owned)
}

/// What has been found on the way from an input.
#[derive(Clone, Copy)]
struct Way {
    channel: Option<usize>,
    scale: f32,
    /// How many nodes there may still be.
    depth: usize,
}

fn follow(input: Node<'_, '_>, way: Way) -> Result<Bound, Obstacle> {
    let name = input.attribute("name").unwrap_or_default();
    let nowhere = || Obstacle::Nowhere(name.to_owned());
    if way.depth == 0 {
        return Err(nowhere());
    }
    if let Some(values) = input.attribute("value").and_then(numbers) {
        return Ok(Bound::Values { values, space: inherited(input, "colorspace") });
    }
    let way = Way { depth: way.depth - 1, ..way };
    if let Some(face) = input.attribute("interfacename") {
        let mut graphs = input.ancestors().filter(|n| n.has_tag_name("nodegraph"));
        let outer = graphs.find_map(|graph| self::input(graph, face)).ok_or_else(nowhere)?;
        return follow(outer, way);
    }
    let of_output = input.attribute("output").or(input.attribute("channels"));
    let way = Way { channel: way.channel.or_else(|| channel_of(of_output?)), ..way };
    through(target(input).ok_or_else(nowhere)?, way)
}

/// The node that an input is connected to.
fn target<'a, 'd>(input: Node<'a, 'd>) -> Option<Node<'a, 'd>> {
    fn named<'a, 'd>(scope: Node<'a, 'd>, name: &str) -> Option<Node<'a, 'd>> {
        scope.children().find(|n| n.attribute("name") == Some(name))
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
    let output = outputs.find(|n| wanted.is_none() || n.attribute("name") == wanted)?;
    named(node, output.attribute("nodename")?)
}

/// The picture that a node reads, or the picture of the input that it passes on.
fn through(node: Node<'_, '_>, way: Way) -> Result<Bound, Obstacle> {
    let kind = node.tag_name().name();
    let value = |name: &str| input(node, name).and_then(|n| n.attribute("value"));
    if let Some(file) = input(node, "file") {
        if file.attribute("value").is_none() && file.attribute("interfacename").is_none() {
            return Err(Obstacle::Nowhere("file".to_owned()));
        }
        let file = of_interface(file, way.depth);
        let name = file.attribute("value").ok_or_else(|| Obstacle::Nowhere("file".to_owned()))?;
        let name = inherited(file, "fileprefix").unwrap_or_default() + name;
        let space = inherited(file, "colorspace");
        let picture = BoundPicture { file: name, space, channel: way.channel, scale: way.scale };
        return Ok(Bound::Picture(picture));
    }
    if kind == "constant" {
        let value = input(node, "value").ok_or_else(|| Obstacle::Nowhere("value".to_owned()))?;
        return follow(value, way);
    }
    if !PASSING.contains(&kind) {
        let name = node.attribute("name").unwrap_or_default();
        return Err(Obstacle::Procedural(format!("{name} ({kind})")));
    }
    let index = value("index").and_then(|index| index.trim().parse().ok());
    let swizzled = value("channels").filter(|channels| channels.len() == 1).and_then(channel_of);
    let channel = way.channel.or(index).or(swizzled);
    let scale = value("scale").and_then(|scale| numbers(scale)?.first().copied()).unwrap_or(1.0);
    let next = input(node, "in").ok_or_else(|| Obstacle::Nowhere("in".to_owned()))?;
    follow(next, Way { channel, scale: scale * way.scale, ..way })
}

/// The input of the graph that `file` stands for.
fn of_interface<'a, 'd>(file: Node<'a, 'd>, depth: usize) -> Node<'a, 'd> {
    let outer = || {
        let face = file.attribute("interfacename").filter(|_| file.attribute("value").is_none())?;
        let mut graphs = file.ancestors().filter(|n| n.has_tag_name("nodegraph"));
        graphs.find_map(|graph| input(graph, face)).filter(|outer| *outer != file && depth > 0)
    };
    outer().map_or(file, |outer| of_interface(outer, depth - 1))
}

/// `0.5`, `1, 0.5, 0` or `true`.
fn numbers(text: &str) -> Option<Vec<f32>> {
    let number = |text: &str| match text.trim() {
        "true" => Some(1.0),
        "false" => Some(0.0),
        number => number.parse().ok().filter(|n: &f32| n.is_finite()),
    };
    text.split(',').map(number).collect()
}

/// Output `outg` or channels `g` is channel 1.
fn channel_of(output: &str) -> Option<usize> {
    match output {
        "outr" | "r" | "x" | "outx" => Some(0),
        "outg" | "g" | "y" | "outy" => Some(1),
        "outb" | "b" | "z" | "outz" => Some(2),
        _ => None,
    }
}
