// How the light and the view of a scene move: the twin of src/viewer/model/view/endpoint.rs.

/** @typedef {"light" | "view"} Endpoint */

/** Least height of a light or a view: from within the plane nothing is seen. */
const LOWEST = 0.01;
/** Largest coordinate. */
const FARTHEST = 1000;
/** Least height of an endpoint that is orbited, as a share of its distance: the cosine of 85 degrees. */
const ORBIT_LOWEST = Math.cos(85 * Math.PI / 180);
/** Least height of a position that a direction becomes, as a share of its distance. */
const LOWEST_SHARE = 0.1;

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

/** Near-field or distant, such that it looks the same from the middle. @param {Scene} scene @param {Scene["kind"]} kind */
function setKind(scene, kind) {
  if (scene.kind === kind) return;
  scene.kind = kind;
  if (kind === "distant") return;
  for (const which of /** @type {Endpoint[]} */ (["light", "view"])) {
    const [x, y, height] = scene[which];
    const length = norm(scene[which]);
    const z = Math.max(height, LOWEST_SHARE * length);
    const across = Math.hypot(x, y);
    const shrink = across > 0 ? Math.min(Math.sqrt(Math.max(length * length - z * z, 0)) / across, 1) : 1;
    setEndpoint(scene, which, [x * shrink, y * shrink, z]);
  }
}

/** Moves an endpoint so that its projection is (x, y). @param {Scene} scene @param {Endpoint} which @param {number[]} point */
function moveOverPlane(scene, which, [x, y]) {
  if (scene.kind === "near") return setEndpoint(scene, which, [x, y, scene[which][2]]);
  const rim = Math.sqrt(1 - LOWEST * LOWEST);
  const across = Math.hypot(x, y);
  const shrink = across > 0 ? Math.min(rim / across, 1) : 1;
  const [sx, sy] = [x * shrink, y * shrink];
  const distance = norm(scene[which]);
  setEndpoint(scene, which, [sx, sy, Math.sqrt(Math.max(1 - sx * sx - sy * sy, 0))].map((c) => c * distance));
}

/** Turns an endpoint about the middle of the material, in radians. @param {Scene} scene @param {Endpoint} which @param {number} sideways @param {number} upwards */
function orbit(scene, which, sideways, upwards) {
  const steepest = Math.PI / 2 - 1e-3;
  const p = scene[which];
  const length = norm(p);
  const longitude = clamp(Math.atan2(p[0], p[2]) + sideways, -steepest, steepest);
  const latitude = clamp(Math.asin(p[1] / length) + upwards, -steepest, steepest);
  const [x, y] = [Math.cos(latitude) * Math.sin(longitude), Math.sin(latitude)];
  const lowest = Math.max(Math.min(ORBIT_LOWEST, p[2] / length), LOWEST / length);
  const z = Math.min(Math.max(Math.cos(latitude) * Math.cos(longitude), lowest), 1);
  const shrink = Math.sqrt((1 - z * z) / Math.max(x * x + y * y, Number.MIN_VALUE));
  setEndpoint(scene, which, [x * shrink, y * shrink, z].map((c) => c * length));
}

/** @param {Scene} scene @param {Endpoint} which @param {number} factor */
function scaleHeight(scene, which, factor) {
  const [x, y, z] = scene[which];
  setEndpoint(scene, which, [x, y, z * factor]);
}
