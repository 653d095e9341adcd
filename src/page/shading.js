// The passes of the window in WebGL 2: texels are shaded, then shown. The shaders are made from the WGSL of the window.

/**
 * @typedef {{vertex: string, fragment: string, bindings: Record<string, string>,
 *   uniforms: Record<string, Record<string, number>>}} ShaderText
 * @typedef {{program: WebGLProgram, text: ShaderText, blocks: Map<string, {buffer: WebGLBuffer, index: number}>,
 *   textures: string[]}} Program
 * @typedef {{texture: WebGLTexture, framebuffer: WebGLFramebuffer, key: string}} Target
 * @typedef {{maps: WebGLTexture[], shaded: Target, difference: Target, size: [number, number]}} Uploaded
 * @typedef {{x: number, y: number, width: number, height: number}} Box  In pixels, y upwards from the lower edge.
 */

const QUANTITIES = ["rendering", "normal", "diffuse", "specular", "roughness"];
/** How numbers become colours: radiance, albedo, data. @type {Record<string, number>} */
const ENCODINGS = { rendering: 0, normal: 2, diffuse: 1, specular: 1, roughness: 2 };
/** @type {Record<string, number>} */
const DIFFERENCES = { none: 0, log: 1, "signed-log": 2, absolute: 3, signed: 4, relative: 5, angle: 6 };
const BACKGROUND = [0.141, 0.149, 0.165];

/** The members of a uniform that hold whole numbers. */
const WHOLE = new Set([
  "stride", "size", "corner", "rays.near", "model.clamp_n_dot_h", "quantity", "mode", "difference", "encoding", "kind",
]);

class Shading {
  /** @param {HTMLCanvasElement} canvas @param {Record<string, ShaderText>} shaders @param {Maps[]} materials */
  constructor(canvas, shaders, materials) {
    const gl = canvas.getContext("webgl2", { alpha: false, antialias: false, depth: false, preserveDrawingBuffer: false });
    if (!gl) throw new Error("this browser has no WebGL 2");
    this.gl = gl;
    this.materials = materials;
    const whole = gl.getExtension("EXT_color_buffer_float") !== null;
    if (!whole && !gl.getExtension("EXT_color_buffer_half_float")) {
      throw new Error("this graphics adapter renders no floating-point numbers");
    }
    this.format = whole ? gl.RGBA32F : gl.RGBA16F;
    this.largest = whole ? 3.4028234663852886e38 : 65504;
    this.programs = Object.fromEntries(Object.entries(shaders).map(([name, text]) => [name, this.program(text)]));
    this.uploaded = materials.map((material) => this.upload(material));
  }

  /** @param {ShaderText} text @returns {Program} */
  program(text) {
    const gl = this.gl;
    const program = gl.createProgram();
    for (const [kind, source] of /** @type {[number, string][]} */ ([[gl.VERTEX_SHADER, text.vertex], [gl.FRAGMENT_SHADER, text.fragment]])) {
      const shader = /** @type {WebGLShader} */ (gl.createShader(kind));
      gl.shaderSource(shader, source);
      gl.compileShader(shader);
      gl.attachShader(program, shader);
    }
    gl.linkProgram(program);
    if (!gl.getProgramParameter(program, gl.LINK_STATUS)) {
      throw new Error(`a shader cannot be compiled: ${gl.getProgramInfoLog(program) ?? ""}`);
    }
    const blocks = new Map();
    /** @type {string[]} */
    const textures = [];
    gl.useProgram(program);
    for (const [variable, name] of Object.entries(text.bindings)) {
      const block = gl.getUniformBlockIndex(program, name);
      if (block === gl.INVALID_INDEX) {
        gl.uniform1i(gl.getUniformLocation(program, name), textures.length);
        textures.push(variable);
        continue;
      }
      const index = blocks.size;
      gl.uniformBlockBinding(program, block, index);
      blocks.set(variable, { buffer: gl.createBuffer(), index });
    }
    return { program, text, blocks, textures };
  }

  /** @param {Maps} material @returns {Uploaded} */
  upload({ width, height, normalRoughness, diffuse, specular }) {
    const gl = this.gl;
    const side = gl.getParameter(gl.MAX_TEXTURE_SIZE);
    if (Math.max(width, height) > side) throw new Error(`this graphics adapter has textures of at most ${side} texels`);
    const maps = [normalRoughness, diffuse, specular].map((numbers) => this.texture(gl.RGBA32F, width, height, numbers));
    return { maps, shaded: this.target(width, height), difference: this.target(width, height), size: [width, height] };
  }

  /** @param {number} format @param {number} width @param {number} height @param {Float32Array | null} numbers */
  texture(format, width, height, numbers) {
    const gl = this.gl;
    const texture = gl.createTexture();
    gl.bindTexture(gl.TEXTURE_2D, texture);
    gl.texStorage2D(gl.TEXTURE_2D, 1, format, width, height);
    gl.texParameteri(gl.TEXTURE_2D, gl.TEXTURE_MIN_FILTER, gl.NEAREST);
    gl.texParameteri(gl.TEXTURE_2D, gl.TEXTURE_MAG_FILTER, gl.NEAREST);
    if (numbers) gl.texSubImage2D(gl.TEXTURE_2D, 0, 0, 0, width, height, gl.RGBA, gl.FLOAT, numbers);
    return texture;
  }

  /** @param {number} width @param {number} height @returns {Target} */
  target(width, height) {
    const gl = this.gl;
    const texture = this.texture(this.format, width, height, null);
    const framebuffer = gl.createFramebuffer();
    gl.bindFramebuffer(gl.FRAMEBUFFER, framebuffer);
    gl.framebufferTexture2D(gl.FRAMEBUFFER, gl.COLOR_ATTACHMENT0, gl.TEXTURE_2D, texture, 0);
    return { texture, framebuffer, key: "" };
  }

  /**
   * Runs a pass over a box of a framebuffer.
   * @param {string} name @param {Record<string, Record<string, number | number[]>>} uniforms
   * @param {Record<string, WebGLTexture>} textures @param {WebGLFramebuffer | null} framebuffer @param {Box} box
   */
  draw(name, uniforms, textures, framebuffer, box) {
    const gl = this.gl;
    const { program, text, blocks, textures: units } = this.programs[name];
    gl.useProgram(program);
    for (const [variable, { buffer, index }] of blocks) {
      const places = text.uniforms[variable];
      const bytes = new DataView(new ArrayBuffer(Math.ceil(places[""] / 16) * 16));
      for (const [member, value] of Object.entries(uniforms[variable])) {
        [value].flat().forEach((number, i) => {
          const at = places[member] + 4 * i;
          if (WHOLE.has(member)) bytes.setUint32(at, number, true);
          else bytes.setFloat32(at, number, true);
        });
      }
      gl.bindBuffer(gl.UNIFORM_BUFFER, buffer);
      gl.bufferData(gl.UNIFORM_BUFFER, bytes.buffer, gl.DYNAMIC_DRAW);
      gl.bindBufferBase(gl.UNIFORM_BUFFER, index, buffer);
    }
    units.forEach((variable, unit) => {
      gl.activeTexture(gl.TEXTURE0 + unit);
      gl.bindTexture(gl.TEXTURE_2D, textures[variable]);
    });
    gl.bindFramebuffer(gl.FRAMEBUFFER, framebuffer);
    gl.viewport(box.x, box.y, box.width, box.height);
    gl.drawArrays(gl.TRIANGLES, 0, 3);
  }

  /** The texels of a material, shaded unless they are already. @param {number} index @param {Shaded} how */
  shade(index, { scene, quantity, model }) {
    const { maps, shaded, size } = this.uploaded[index];
    const rendered = quantity === "rendering" ? scene : null;
    const key = JSON.stringify([rendered, quantity]);
    if (shaded.key === key) return shaded;
    const isNear = scene.kind === "near";
    const shading = {
      "rays.view": isNear ? scene.view : unit(scene.view), "rays.light": isNear ? scene.light : unit(scene.light),
      "rays.near": isNear ? 1 : 0,
      ...Object.fromEntries(Object.entries(model).map(([name, value]) => [`model.${name}`, value])),
      largest: this.largest, stride: 1, size,
    };
    const page = { quantity: QUANTITIES.indexOf(quantity) };
    const textures = { normal_roughness: maps[0], diffuse: maps[1], specular: maps[2] };
    this.draw("shade", { shading, page }, textures, shaded.framebuffer, { x: 0, y: 0, width: size[0], height: size[1] });
    shaded.key = key;
    return shaded;
  }

  /** The difference of every texel from the ground truth, computed unless it is already. @param {number} index @param {Shaded} how @param {string} kind */
  differences(index, how, kind) {
    const prediction = this.shade(index, how);
    const reference = this.shade(0, how);
    const { difference, size } = this.uploaded[index];
    const key = `${prediction.key} ${kind}`;
    if (difference.key !== key) {
      const page = { kind: DIFFERENCES[kind], epsilon: how.epsilon };
      const textures = { prediction: prediction.texture, reference: reference.texture };
      this.draw("difference", { page }, textures, difference.framebuffer, { x: 0, y: 0, width: size[0], height: size[1] });
      difference.key = key;
    }
    return difference;
  }

  /** The numbers of a rectangle of texels: four each. @param {Target} target @param {Box} box */
  read(target, { x, y, width, height }) {
    const gl = this.gl;
    const numbers = new Float32Array(4 * width * height);
    gl.bindFramebuffer(gl.FRAMEBUFFER, target.framebuffer);
    gl.readPixels(x, y, width, height, gl.RGBA, gl.FLOAT, numbers);
    return numbers;
  }

  /**
   * Draws a pane: a material, its difference from the ground truth, or a wipe of both.
   * @param {Pane} pane @param {Shaded} how @param {Camera} camera @param {Box} box @param {{exposure: number, range: number}} shown
   */
  pane(pane, how, { origin, half }, box, shown) {
    const material = this.shade(pane.material, how);
    const reference = pane.wipe === null && pane.difference === null ? material : this.shade(0, how);
    const page = { mode: pane.wipe === null ? 0 : 1, difference: DIFFERENCES[pane.difference ?? "none"], encoding: ENCODINGS[how.quantity] };
    const params = {
      "camera.origin": [...origin, 1], "camera.origin_right": [half[0], 0, 0], "camera.origin_up": [0, half[1], 0],
      "camera.direction": [0, 0, -1], background: BACKGROUND, exposure: 2 ** shown.exposure, epsilon: how.epsilon,
      wipe: 2 * (pane.wipe ?? 0) - 1, range: shown.range, stride: 1, size: this.uploaded[pane.material].size, corner: [box.x, box.y],
    };
    const textures = { shown: material.texture, reference: reference.texture };
    this.draw("display", { params, page }, textures, null, box);
  }

  /** Fills the canvas with the background. */
  clear() {
    const gl = this.gl;
    gl.bindFramebuffer(gl.FRAMEBUFFER, null);
    gl.clearColor(BACKGROUND[0], BACKGROUND[1], BACKGROUND[2], 1);
    gl.clear(gl.COLOR_BUFFER_BIT);
  }

  /** The colours of a box of the canvas, lowest row first; in the task that has drawn them. @param {Box} box */
  pixels({ x, y, width, height }) {
    const gl = this.gl;
    const bytes = new Uint8Array(4 * width * height);
    gl.bindFramebuffer(gl.FRAMEBUFFER, null);
    gl.readPixels(x, y, width, height, gl.RGBA, gl.UNSIGNED_BYTE, bytes);
    return bytes;
  }
}
