// How the light and the view of a scene move: the twin of src/viewer/model/endpoint.rs.

/** @typedef {"light" | "view"} Endpoint */

/** Least height of a light or a view: from within the plane nothing is seen. */
const LOWEST = 0.01;
/** Largest coordinate. */
const FARTHEST = 1000;
/** Least height of a position that a direction becomes, as a share of its distance. */
const LOWEST_SHARE = 0.1;
/** @type {Endpoint[]} */
const ENDPOINTS = ["light", "view"];

/** @param {Vector} a */
const norm = (a) => Math.hypot(...a);
/** @param {Vector} a @returns {Vector} */
const unit = (a) => [a[0] / norm(a), a[1] / norm(a), a[2] / norm(a)];

/** @param {Scene} scene @param {Endpoint} which @param {number[]} p */
function setEndpoint(scene, which, [x, y, z]) {
  if (![x, y, z].every(Number.isFinite)) return;
  scene[which] = [clamp(x, -FARTHEST, FARTHEST), clamp(y, -FARTHEST, FARTHEST), clamp(z, LOWEST, FARTHEST)];
}

/** The projection onto the plane, where the handle is. @param {Scene} scene @param {Endpoint} which @returns {[number, number]} */
function overPlane(scene, which) {
  const [x, y] = scene.kind === "distant" ? unit(scene[which]) : scene[which];
  return [x, y];
}

/** (x, y), no longer than `most`. @param {number} x @param {number} y @param {number} most */
function within(x, y, most) {
  const shrink = Math.min(most / Math.max(Math.hypot(x, y), Number.MIN_VALUE), 1);
  return [x * shrink, y * shrink];
}

/** Near-field or distant, such that it looks the same from the middle. @param {Scene} scene @param {Scene["kind"]} kind */
function setKind(scene, kind) {
  if (scene.kind === kind) return;
  scene.kind = kind;
  if (kind === "distant") return;
  for (const which of ENDPOINTS) {
    const [x, y, height] = scene[which];
    const length = norm(scene[which]);
    const z = Math.max(height, LOWEST_SHARE * length);
    setEndpoint(scene, which, [...within(x, y, Math.sqrt(Math.max(length * length - z * z, 0))), z]);
  }
}

/** Moves an endpoint so that its projection is (x, y). @param {Scene} scene @param {Endpoint} which @param {number[]} point */
function moveOverPlane(scene, which, [x, y]) {
  if (scene.kind === "near") return setEndpoint(scene, which, [x, y, scene[which][2]]);
  const [sx, sy] = within(x, y, Math.sqrt(1 - LOWEST * LOWEST));
  const distance = norm(scene[which]);
  setEndpoint(scene, which, [sx, sy, Math.sqrt(Math.max(1 - sx * sx - sy * sy, 0))].map((c) => c * distance));
}
