// The part of the plane of the material that a pane shows from above, and texels in it: the twin of src/core/picture/camera.rs.

/**
 * @typedef {[number, number, number]} Vector
 * @typedef {{kind: "near" | "distant", view: Vector, light: Vector}} Scene
 * @typedef {{width: number, height: number}} Grid
 * @typedef {{origin: [number, number], half: [number, number]}} Camera  The point in the middle of the pane, and half of its sides there.
 */

/** Room left around the material when it is fitted into a pane. */
const MARGIN = 1.03;
/** Least and greatest magnification of the fitted material. */
const ZOOMS = [0.1, 1000];

/** @param {number} x @param {number} low @param {number} high */
const clamp = (x, low, high) => Math.min(Math.max(x, low), high);

/** Fits the material into a pane, magnified by `zoom` and moved by `pan`, in units of the pane. @param {Grid} grid @param {number} aspect @param {number} zoom @param {[number, number]} pan @returns {Camera} */
function flatCamera({ width, height }, aspect, zoom, pan) {
  const spacings = Math.max(width, 2) - 1;
  const reach = Math.max(height / spacings, width / spacings / aspect) * MARGIN;
  return { origin: [-pan[0] / zoom * reach * aspect, -pan[1] / zoom * reach], half: [reach * aspect / zoom, reach / zoom] };
}

/** The point of the plane that is seen at (x, y) of the pane. @param {Camera} camera @param {number} x @param {number} y @returns {[number, number]} */
const planeFromNdc = ({ origin, half }, x, y) => [origin[0] + half[0] * x, origin[1] + half[1] * y];

/** The texel that covers a point of the plane. @param {Grid} grid @param {[number, number]} point @returns {[number, number] | null} */
function texelAt(grid, [x, y]) {
  const spacings = Math.max(grid.width, 2) - 1;
  const [column, row] = [0.5 * (x * spacings + grid.width), 0.5 * (grid.height - y * spacings)];
  const inside = column >= 0 && column < grid.width && row >= 0 && row < grid.height;
  return inside ? [Math.floor(column), Math.floor(row)] : null;
}

// How the light and the view of a scene move: the twin of src/viewer/model/endpoint.rs.

/** @typedef {"light" | "view"} Endpoint */

/** Least height of a light or a view: from within the plane nothing is seen. */
const LOWEST = 0.01;
/** Largest coordinate. */
const FARTHEST = 1000;

/** @param {Vector} a */
const norm = (a) => Math.hypot(...a);
/** @param {Vector} a @returns {Vector} */
const unit = (a) => [a[0] / norm(a), a[1] / norm(a), a[2] / norm(a)];

/** @param {Scene} scene @param {Endpoint} which @param {number[]} p */
function setEndpoint(scene, which, [x, y, z]) {
  scene[which] = [clamp(x, -FARTHEST, FARTHEST), clamp(y, -FARTHEST, FARTHEST), clamp(z, LOWEST, FARTHEST)];
}

/** The projection onto the plane, where the handle is. @param {Scene} scene @param {Endpoint} which @returns {[number, number]} */
function overPlane(scene, which) {
  const [x, y] = scene.kind === "distant" ? unit(scene[which]) : scene[which];
  return [x, y];
}

/** Moves an endpoint so that its projection is (x, y). @param {Scene} scene @param {Endpoint} which @param {number[]} point */
function moveOverPlane(scene, which, [x, y]) {
  if (scene.kind === "near") return setEndpoint(scene, which, [x, y, scene[which][2]]);
  const shrink = Math.min(Math.sqrt(1 - LOWEST * LOWEST) / Math.max(Math.hypot(x, y), Number.MIN_VALUE), 1);
  const [sx, sy] = [x * shrink, y * shrink];
  const distance = norm(scene[which]);
  setEndpoint(scene, which, [sx, sy, Math.sqrt(Math.max(1 - sx * sx - sy * sy, 0))].map((c) => c * distance));
}
