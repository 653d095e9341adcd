// Maps as the report stores them: planes of whole numbers, predicted from their neighbours, deflated, in base64.

/**
 * @typedef {{data: string, palette: string | null}} Plane
 * @typedef {{name: string, width: number, height: number, planes: Plane[],
 *   normal: number[], diffuse: number[], specular: number[], roughness: number[]}} StoredMaterial
 * @typedef {{name: string, width: number, height: number, normalRoughness: Float32Array, diffuse: Float32Array,
 *   specular: Float32Array}} Maps  Four numbers for each texel, row 0 on top.
 */

/** @param {string} text */
const bytesFromBase64 = (text) => Uint8Array.from(atob(text), (c) => c.charCodeAt(0));

/** @param {string} text @returns {Promise<Uint8Array>} */
async function inflate(text) {
  const stream = new Blob([bytesFromBase64(text)]).stream().pipeThrough(new DecompressionStream("deflate-raw"));
  return new Uint8Array(await new Response(stream).arrayBuffer());
}

/**
 * The values of a plane: those of its palette, or those that `decode` makes of numbers in [0, 1]. The prediction is left + above - above
 * left.
 * @param {Plane} plane @param {number} width @param {number} height @param {(x: number) => number} decode
 */
async function decodePlane({ data, palette }, width, height, decode) {
  const bytes = await inflate(data);
  const count = width * height;
  const most = palette === null ? 65535 : 255;
  if (bytes.length !== (palette === null ? 2 : 1) * count) throw new Error("a map is damaged");
  const known = palette === null ? null : new Float32Array(bytesFromBase64(palette).buffer);
  const stored = new Uint16Array(count);
  const values = new Float64Array(count);
  for (let i = 0; i < count; i++) {
    const column = i % width;
    const left = column > 0 ? stored[i - 1] : 0;
    const above = i >= width ? stored[i - width] : 0;
    const corner = column > 0 && i >= width ? stored[i - width - 1] : 0;
    const residual = known ? bytes[i] : bytes[i] * 256 + bytes[count + i];
    stored[i] = (residual + left + above - corner) & most;
    values[i] = known ? known[stored[i]] : decode(stored[i] / most);
  }
  return values;
}

/** The sRGB transfer function (IEC 61966-2-1), from encoded to linear. @param {number} encoded */
function linearFromSrgb(encoded) {
  return encoded <= 0.04045 ? encoded / 12.92 : ((encoded + 0.055) / 1.055) ** 2.4;
}

/** The unit vector of a point of the octahedron. @param {number} u @param {number} v both in [-1, 1] */
function normalFromOctahedron(u, v) {
  const z = 1 - Math.abs(u) - Math.abs(v);
  const folded = z < 0 ? [(1 - Math.abs(v)) * (u < 0 ? -1 : 1), (1 - Math.abs(u)) * (v < 0 ? -1 : 1)] : [u, v];
  return normalized(folded[0], folded[1], z);
}

/** @param {number} x @param {number} y @param {number} z */
function normalized(x, y, z) {
  const length = Math.hypot(x, y, z);
  return [x / length, y / length, z / length];
}

/** @param {StoredMaterial} stored @returns {Promise<Maps>} */
async function decodeMaterial(stored) {
  const { name, width, height } = stored;
  /** @param {number[]} indices @param {(x: number) => number} decode */
  const channels = (indices, decode) => Promise.all(indices.map((index) => decodePlane(stored.planes[index], width, height, decode)));
  const [normal, diffuse, specular, roughness] = await Promise.all([
    // Octahedral coordinates: 0 is one of the whole numbers.
    channels(stored.normal, (x) => x * 65535 / 32767 - 1),
    channels(stored.diffuse, linearFromSrgb),
    channels(stored.specular, linearFromSrgb),
    channels(stored.roughness, (x) => x),
  ]);
  const maps = [0, 1, 2].map(() => new Float32Array(4 * width * height));
  for (let i = 0; i < width * height; i++) {
    const [x, y, z] = normal.map((channel) => channel[i]);
    maps[0].set(z === undefined ? normalFromOctahedron(x, y) : normalized(x, y, z), 4 * i);
    maps[0][4 * i + 3] = roughness[0][i];
    for (let channel = 0; channel < 3; channel++) {
      maps[1][4 * i + channel] = diffuse[channel][i];
      maps[2][4 * i + channel] = specular[channel][i];
    }
  }
  return { name, width, height, normalRoughness: maps[0], diffuse: maps[1], specular: maps[2] };
}
