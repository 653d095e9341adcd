// Pass 2 of the window.

// Constants of the pipeline: drivers compile and run what is needed and no more. As uniforms they make Mesa's lavapipe compile the
// shader anew for every pane of every frame.
override MODE: u32 = MODE_VALUE;
override DIFFERENCE: u32 = DIFFERENCE_NONE;
override ENCODING: u32 = ENCODING_RADIANCE;
override SHOW_CLIPPING: bool = false;
override FALSE_COLOUR: bool = false;
// Whether pixels show the nearest texel: none covers more than one, or a draft is enough.
override NEAREST: bool = false;

@fragment
fn display(corner: Corner) -> @location(0) vec4f {
    return displayed(corner);
}
