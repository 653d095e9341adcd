//! Connections of MaterialX: the inputs of a node, and the nodes and inputs that they lead to.

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
