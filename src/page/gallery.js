// The gallery of a ranking: a drag over any picture moves the light of all of them.

/**
 * @typedef {{material: StoredMaterial, exposure: number}} Relit
 * @typedef {{pictures: (Relit | null)[], scene: Scene, model: Record<string, number>, epsilon: number,
 *   shaders: Record<string, ShaderText>}} GalleryData
 * @typedef {{image: HTMLImageElement, canvas: HTMLCanvasElement, relit: Relit, maps: "asked" | Maps | null, key: string}} Picture
 */

/** How far a press moves before it is a drag, in CSS pixels. */
const DRAG = 4;
/** How far an arrow key moves the light, in units of half the width of the material. */
const ARROW = 0.1;

class Gallery {
  /** @param {GalleryData} data @param {HTMLElement} root */
  constructor(data, root) {
    this.data = data;
    this.root = root;
    this.scene = structuredClone(data.scene);
    this.isLive = false;
    this.requested = false;
    this.canvas = document.createElement("canvas");
    this.shading = new Shading(this.canvas, data.shaders, []);
    /** @type {Picture[]} */
    this.pictures = [...root.querySelectorAll("img")].flatMap((image) => {
      const relit = data.pictures[Number(image.dataset.picture)];
      if (!relit) return [];
      const canvas = Object.assign(document.createElement("canvas"), { hidden: true, role: "img", ariaLabel: image.alt });
      image.after(canvas);
      return [{ image, canvas, relit, maps: null, key: "" }];
    });
    /** @type {{picture: Picture, from: [number, number], moves: boolean} | null} */
    this.press = null;
    this.dragged = false;
    root.addEventListener("pointerdown", (event) => this.down(event));
    root.addEventListener("pointermove", (event) => this.move(event));
    for (const kind of /** @type {const} */ (["pointerup", "pointercancel"])) root.addEventListener(kind, () => { this.press = null; });
    // The link below a picture is followed by a click, and not dragged.
    root.addEventListener("dragstart", (event) => { if (this.at(event.target)) event.preventDefault(); });
    // A click by a key has no detail.
    root.addEventListener("click", (event) => { if (this.dragged && event.detail > 0) event.preventDefault(); }, true);
    root.addEventListener("keydown", (event) => this.key(event));
    // Other rows come into the window: scrolled, or sorted.
    for (const kind of ["scroll", "resize", "click"]) addEventListener(kind, () => this.changed(), { passive: true });
    // Pictures outside of the window have the light of the file.
    addEventListener("beforeprint", () => this.reset());
    this.canvas.addEventListener("webglcontextlost", () => this.reset());
  }

  /** The picture of an element, or of a link around it. @param {EventTarget | null} target */
  at(target) {
    return this.pictures.find(({ image, canvas }) => image === target || canvas === target || target !== null && target === image.closest("a"));
  }

  /** @param {PointerEvent} event */
  down(event) {
    const picture = this.at(event.target);
    this.dragged = false;
    if (picture && event.button === 0) this.press = { picture, from: [event.clientX, event.clientY], moves: false };
  }

  /** @param {PointerEvent} event */
  move(event) {
    const { press, root } = this;
    if (!press) return;
    const { picture, from: [x, y] } = press;
    if (!press.moves && Math.hypot(event.clientX - x, event.clientY - y) < DRAG) return;
    if (!press.moves) root.setPointerCapture(event.pointerId);
    press.moves = this.dragged = true;
    const { left, top, width, height } = this.box(picture);
    const camera = this.camera(picture, width / height);
    const point = planeFromNdc(camera, 2 * (event.clientX - left) / width - 1, 1 - 2 * (event.clientY - top) / height);
    if (point) this.relight(point);
  }

  /** @param {KeyboardEvent} event */
  key(event) {
    const steps = /** @type {Record<string, [number, number]>} */ ({ ArrowLeft: [-1, 0], ArrowRight: [1, 0], ArrowUp: [0, 1], ArrowDown: [0, -1] });
    const step = steps[event.key];
    if (!step || event.altKey || event.ctrlKey || event.metaKey || !this.at(event.target)) return;
    event.preventDefault();
    const [x, y] = overPlane(this.scene, "light");
    this.relight([x + ARROW * step[0], y + ARROW * step[1]]);
  }

  /** Moves the light over a point of the plane. @param {number[]} point */
  relight(point) {
    moveOverPlane(this.scene, "light", point);
    this.isLive = true;
    this.root.classList.add("live");
    this.changed();
  }

  /** Shows the pictures of the file again. */
  reset() {
    this.scene = structuredClone(this.data.scene);
    this.isLive = false;
    for (const picture of this.pictures) {
      [picture.image.hidden, picture.canvas.hidden, picture.key] = [false, true, ""];
    }
    this.root.classList.remove("live");
  }

  /** Where a picture is in the window. @param {Picture} picture */
  box({ image, canvas }) {
    return (canvas.hidden ? image : canvas).getBoundingClientRect();
  }

  /** Draws in the next frame, once the light has moved. */
  changed() {
    if (this.requested || !this.isLive) return;
    this.requested = true;
    requestAnimationFrame(() => {
      this.requested = false;
      this.draw();
    });
  }

  /** @param {Picture} picture @param {number} aspect */
  camera({ relit: { material } }, aspect) {
    return zoomed(flatCamera(material, aspect), MARGIN, [0, 0]);
  }

  /** Draws the pictures in the window that are not drawn yet. */
  draw() {
    // All places before any change, so that the page is laid out once.
    const boxes = this.pictures.map((picture) => this.box(picture));
    this.pictures.forEach((picture, index) => {
      const { width, height, top, bottom } = boxes[index];
      if (!this.isLive || bottom < 0 || top > innerHeight) return;
      if (picture.maps === null) this.decode(picture, index);
      const [w, h] = [width, height].map((side) => Math.max(Math.round(side * devicePixelRatio), 1));
      const key = JSON.stringify([this.scene, w, h]);
      if (picture.maps === null || picture.maps === "asked" || picture.key === key) return;
      picture.key = key;
      this.drawOne(picture, index, w, h);
    });
  }

  /** @param {Picture} picture @param {number} index @param {number} width @param {number} height in physical pixels */
  drawOne(picture, index, width, height) {
    const { canvas: gl, scene, data: { model, epsilon } } = this;
    const { canvas, relit: { exposure } } = picture;
    if (gl.width < width || gl.height < height) [gl.width, gl.height] = [Math.max(gl.width, width), Math.max(gl.height, height)];
    const camera = this.camera(picture, width / height);
    const shown = { exposure, range: 1, clipping: false, tiled: false, falseColour: false };
    const pane = { material: index, difference: null, wipe: null };
    this.shading.pane(pane, { scene, quantity: "rendering", model, epsilon }, camera, { x: 0, y: 0, width, height }, shown);
    if (canvas.width !== width || canvas.height !== height) [canvas.width, canvas.height] = [width, height];
    [picture.image.hidden, canvas.hidden] = [true, false];
    const context = canvas.getContext("2d");
    context?.drawImage(gl, 0, gl.height - height, width, height, 0, 0, width, height);
    const at = ndcFromPoint(camera, [...overPlane(scene, "light"), 0]);
    if (!context || !at) return;
    const dot = new Path2D();
    dot.arc(0.5 * width * (at[0] + 1), 0.5 * height * (1 - at[1]), 5 * devicePixelRatio, 0, 2 * Math.PI);
    Object.assign(context, { fillStyle: "#ffd34d", strokeStyle: "#14161a", lineWidth: 1.5 * devicePixelRatio });
    context.fill(dot);
    context.stroke(dot);
  }

  /** @param {Picture} picture @param {number} index */
  async decode(picture, index) {
    picture.maps = "asked";
    const maps = picture.maps = await decodeMaterial(picture.relit.material);
    this.shading.add(index, maps);
    this.changed();
  }
}

function startGallery() {
  const data = document.getElementById("data")?.textContent;
  const root = document.querySelector(".gallery");
  const hint = document.getElementById("relight");
  if (!data || !(root instanceof HTMLElement) || !hint) return;
  try {
    if (!("DecompressionStream" in window)) throw new Error("this browser inflates no data");
    const gallery = new Gallery(JSON.parse(data), root);
    hint.querySelector("button")?.addEventListener("click", () => gallery.reset());
    Object.assign(window, { svbrdf: { gallery } });
  } catch (error) {
    hint.textContent = `These are still pictures: ${error instanceof Error ? error.message : String(error)}.`;
  }
  hint.hidden = false;
}

startGallery();
