// The keys of the window, where they make sense in a page.

/** How far an arrow key moves the light, in units of half the width of the material. */
const STEP = 0.05;

/** @param {Figure} figure @param {HTMLElement} section @param {Gestures} gestures @param {() => void} reset */
function listenToKeys(figure, section, gestures, reset) {
  const { state } = figure;
  /** @param {number} by */
  const cycleQuantity = (by) => { state.quantity = QUANTITIES[(QUANTITIES.indexOf(state.quantity) + by + 5) % 5]; };
  /** @param {Endpoint} which @param {number} dx @param {number} dy */
  const step = (which, dx, dy) => {
    const [x, y] = overPlane(state.scene, which);
    moveOverPlane(state.scene, which, [x + dx * STEP, y + dy * STEP]);
  };
  /** @param {number} factor */
  const zoom = (factor) => {
    const box = figure.boxes()[0];
    gestures.zoom(factor, [box.x + box.width / 2, box.y + box.height / 2], box);
  };
  /** @type {Record<string, (shift: boolean) => void>} */
  const keys = {
    m: (shift) => cycleQuantity(shift ? -1 : 1),
    d: () => { if (figure.materials.length > 1) state.difference = !state.difference; },
    c: () => { state.layout = LAYOUTS[(LAYOUTS.indexOf(state.layout) + 1) % 3]; },
    e: (shift) => { state.exposure = clamp(state.exposure + (shift ? -0.5 : 0.5), -16, 16); },
    g: () => { state.peek = true; },
    f: () => { Object.assign(state, { zoom: 1, pan: [0, 0] }); },
    r: reset,
    "+": () => zoom(ZOOM_STEP),
    "=": () => zoom(ZOOM_STEP),
    "-": () => zoom(1 / ZOOM_STEP),
    arrowleft: (shift) => step(shift ? "view" : "light", -1, 0),
    arrowright: (shift) => step(shift ? "view" : "light", 1, 0),
    arrowup: (shift) => step(shift ? "view" : "light", 0, 1),
    arrowdown: (shift) => step(shift ? "view" : "light", 0, -1),
  };
  /** Whether the keys are the figure's. @param {KeyboardEvent} event */
  const isOurs = (event) => {
    const target = /** @type {HTMLElement} */ (event.target);
    const isTyping = target.matches("select, summary") || target.matches("input") && !target.matches("[type=checkbox]");
    const isNear = section.contains(target) || target === document.body && section.matches(":hover");
    return isNear && !isTyping && !event.ctrlKey && !event.metaKey && !event.altKey;
  };
  document.addEventListener("keydown", (event) => {
    if (!isOurs(event)) return;
    const key = event.key.toLowerCase();
    if (key === " " && document.activeElement === figure.canvas) {
      gestures.space = true;
      event.preventDefault();
      return;
    }
    const isPrediction = /^[1-9]$/.test(key) && Number(key) < figure.materials.length;
    if (isPrediction) state.prediction = Number(key) - 1;
    else if (keys[key]) keys[key](event.shiftKey);
    else return;
    event.preventDefault();
    figure.changed();
  });
  const release = () => {
    gestures.space = false;
    if (state.peek) figure.set({ peek: false });
  };
  document.addEventListener("keyup", (event) => { if (["g", " "].includes(event.key.toLowerCase())) release(); });
  addEventListener("blur", release);
}
