// The controls of the figure: every one writes the state, and shows it after every frame.

/** @param {Figure} figure @param {(id: string) => HTMLElement} element @param {() => void} reset */
function bindControls(figure, element, reset) {
  const { state, materials } = figure;
  const select = (/** @type {string} */ id) => /** @type {HTMLSelectElement} */ (element(id));
  const input = (/** @type {string} */ id) => /** @type {HTMLInputElement} */ (element(id));
  /** @param {HTMLSelectElement} list @param {[string, string][]} options */
  const fill = (list, options) => list.replaceChildren(...options.map(([value, text]) => new Option(text, value)));
  const capital = (/** @type {string} */ text) => text[0].toUpperCase() + text.slice(1);

  fill(select("quantity"), QUANTITIES.map((quantity) => [quantity, capital(quantity)]));
  fill(select("prediction"), materials.slice(1).map(({ name }, i) => [String(i), name]));
  for (const id of ["difference", "layout"]) element(id).closest("label")?.toggleAttribute("hidden", materials.length < 2);
  element("peek").hidden = materials.length < 2;
  element("prediction-label").hidden = materials.length < 3;

  /** @param {string} id @param {(value: string) => void} change */
  const on = (id, change) => element(id).addEventListener("input", (event) => {
    change(/** @type {HTMLInputElement} */ (event.target).value);
    figure.changed();
  });
  on("quantity", (value) => { state.quantity = value; });
  on("layout", (value) => { state.layout = value; });
  on("prediction", (value) => {
    state.prediction = Number(value);
    if (state.layout === "side-by-side" && figure.hasRoom()) state.layout = "single";
  });
  on("drag", (value) => { state.drag = value; });
  on("exposure", (value) => { state.exposure = Number(value); });
  on("difference", () => { state.difference = input("difference").checked; });
  element("fit").addEventListener("click", () => figure.set({ zoom: 1, pan: [0, 0] }));
  element("reset").addEventListener("click", () => { reset(); figure.changed(); });
  const peek = element("peek");
  peek.addEventListener("pointerdown", (event) => { peek.setPointerCapture(event.pointerId); figure.set({ peek: true }); });
  for (const kind of ["pointerup", "pointercancel", "blur"]) peek.addEventListener(kind, () => figure.set({ peek: false }));
  // By the keyboard, it stays until it is pressed again.
  peek.addEventListener("keydown", (event) => {
    if (event.key === "Enter" || event.key === " ") { figure.set({ peek: !state.peek }); event.preventDefault(); }
  });

  figure.watchers.push(() => {
    const values = { quantity: state.quantity, layout: state.layout, prediction: String(state.prediction), drag: state.drag };
    for (const [id, value] of Object.entries(values)) select(id).value = value;
    input("difference").checked = state.difference;
    input("exposure").value = String(state.exposure);
    element("exposure-text").textContent = `${state.exposure > 0 ? "+" : state.exposure < 0 ? "\u2212" : ""}${Number(Math.abs(state.exposure).toFixed(2))} EV`;
    peek.setAttribute("aria-pressed", String(state.peek));
  });
}

/** Worst scenes put light and view of the figure there. @param {Figure} figure @param {HTMLElement} section */
function linkScenes(figure, section) {
  document.querySelectorAll("button[data-scene]").forEach((button) => {
    button.removeAttribute("disabled");
    button.addEventListener("click", () => {
      const { scene, exposure } = figure.data.scenes[Number(/** @type {HTMLElement} */ (button).dataset.scene)];
      Object.assign(figure.state.scene, structuredClone(scene));
      figure.set({ exposure, quantity: "rendering", zoom: 1, pan: [0, 0] });
      section.scrollIntoView({ block: "start" });
      figure.canvas.focus({ preventScroll: true });
    });
  });
}
