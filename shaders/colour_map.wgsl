// A perceptually ordered colour map, black to yellow, encoded for the screen: the twin of src/colour_map.rs.
// The polynomial fit of matplotlib's `inferno` that Matt Zucker placed under CC0.

fn heat(amount: f32) -> vec3f {
    let t = clamp(amount, 0.0, 1.0);
    let c0 = vec3f(0.0002189403691192265, 0.001651004631001012, -0.01948089843709184);
    let c1 = vec3f(0.1065134194856116, 0.5639564367884091, 3.932712388889277);
    let c2 = vec3f(11.60249308247187, -3.972853965665698, -15.9423941062914);
    let c3 = vec3f(-41.70399613139459, 17.43639888205313, 44.35414519872813);
    let c4 = vec3f(77.162935699427, -33.40235894210092, -81.80730925738993);
    let c5 = vec3f(-71.31942824499214, 32.62606426397723, 73.20951985803202);
    let c6 = vec3f(25.13112622477341, -12.24266895238567, -23.07032500287172);
    let colour = c0 + t * (c1 + t * (c2 + t * (c3 + t * (c4 + t * (c5 + t * c6)))));
    return clamp(colour, vec3f(0.0), vec3f(1.0));
}

// Of signed amounts: negative ones blue to cyan, positive ones red to yellow, black at 0.
fn diverging(amount: f32) -> vec3f {
    let t = min(abs(amount), 1.0);
    let colour = clamp(vec3f(2.2 * t, 1.6 * t - 0.5, 3.0 * t - 2.2), vec3f(0.0), vec3f(1.0));
    return select(colour, colour.zyx, amount < 0.0);
}
