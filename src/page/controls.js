// The controls of the figure: every one writes the state, and shows it after every frame.

/** @param {Figure} figure @param {(id: string) => HTMLElement} element @param {() => void} reset */
function bindControls(figure, element, reset) {
  const { state, data, materials } = figure;
  const select = (/** @type {string} */ id) => /** @type {HTMLSelectElement} */ (element(id));
  const input = (/** @type {string} */ id) => /** @type {HTMLInputElement} */ (element(id));
  /** @param {HTMLSelectElement} list @param {[string, string][]} options */
  const fill = (list, options) => list.replaceChildren(...options.map(([value, text]) => new Option(text, value)));
  const capital = (/** @type {string} */ text) => text[0].toUpperCase() + text.slice(1);

  fill(select("quantity"), QUANTITIES.map((quantity) => [quantity, capital(quantity)]));
  fill(select("prediction"), materials.slice(1).map(({ name }, i) => [String(i), name]));
  for (const id of ["difference", "kind", "layout"]) element(id).closest("label")?.toggleAttribute("hidden", materials.length < 2);
  element("peek").hidden = materials.length < 2;
  element("prediction-label").hidden = materials.length < 3;

  /** @param {string} id @param {(value: string) => void} change */
  const on = (id, change) => element(id).addEventListener("input", (event) => {
    change(/** @type {HTMLInputElement} */ (event.target).value);
    figure.changed();
  });
  on("quantity", (value) => { state.quantity = value; });
  on("kind", (value) => { state.kinds[state.quantity] = value; });
  on("layout", (value) => { state.layout = value; });
  on("prediction", (value) => {
    state.prediction = Number(value);
    if (state.layout === "side-by-side" && figure.hasRoom()) state.layout = "single";
  });
  on("near", (value) => setKind(state.scene, /** @type {Scene["kind"]} */ (value)));
  on("drag", (value) => { state.drag = value; });
  on("exposure", (value) => { state.exposure = Number(value); });
  on("difference", () => { state.difference = input("difference").checked; });
  for (const which of ENDPOINTS) {
    [0, 1, 2].forEach((i) => on(`${which}-${i}`, (value) => {
      const p = [...state.scene[which]];
      p[i] = Number(value);
      setEndpoint(state.scene, which, p);
    }));
  }
  element("fit").addEventListener("click", () => figure.set({ zoom: 1, pan: [0, 0] }));
  element("reset").addEventListener("click", () => { reset(); figure.changed(); });
  const peek = element("peek");
  peek.addEventListener("pointerdown", (event) => { peek.setPointerCapture(event.pointerId); figure.set({ peek: true }); });
  for (const kind of ["pointerup", "pointercancel", "blur"]) peek.addEventListener(kind, () => figure.set({ peek: false }));
  // By the keyboard, it stays until it is pressed again.
  peek.addEventListener("keydown", (event) => {
    if (event.key === "Enter" || event.key === " ") { figure.set({ peek: !state.peek }); event.preventDefault(); }
  });

  let kinds = "";
  figure.watchers.push(() => {
    const all = data.kinds[state.quantity];
    if (kinds !== state.quantity) fill(select("kind"), all.map(({ key, name }) => [key, capital(name)]));
    kinds = state.quantity;
    const values = {
      quantity: state.quantity, kind: figure.kind().key, layout: state.layout, prediction: String(state.prediction),
      near: state.scene.kind, drag: state.drag,
    };
    for (const [id, value] of Object.entries(values)) select(id).value = value;
    input("difference").checked = state.difference;
    select("kind").disabled = !state.difference || all.length < 2;
    input("exposure").value = String(state.exposure);
    element("exposure-text").textContent = `${state.exposure > 0 ? "+" : state.exposure < 0 ? "\u2212" : ""}${Number(Math.abs(state.exposure).toFixed(2))} EV`;
    peek.setAttribute("aria-pressed", String(state.peek));
    for (const which of ENDPOINTS) {
      state.scene[which].forEach((number, i) => {
        const field = input(`${which}-${i}`);
        if (document.activeElement !== field) field.value = String(Number(number.toFixed(4)));
      });
    }
  });
}
