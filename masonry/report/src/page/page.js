"use strict";
(() => {
  const all = (query, within = document) => [...within.querySelectorAll(query)];
  const one = (query, within = document) => within.querySelector(query);
  const root = document.documentElement;
  root.classList.add("js");

  // The view: a picture, a step, and a scale of its displacements.
  const keys = all("#switches button").map((it) => it.dataset.picture);
  const step = one("#step");
  const scale = one("#scale");
  const seen = { picture: keys[0], step: step ? Number(step.max) : 0, scale: 1 };

  const short = (value) => String(Number(value.toPrecision(3)));

  // The data of a path in the file.
  const paths = new WeakMap();
  function ofFile(path) {
    if (!paths.has(path)) paths.set(path, path.getAttribute("d"));
    return paths.get(path);
  }

  // Moves elements: scale 0 is the place before the movement, scale 1 the place in the file.
  function moveTo(svg, by) {
    const number = /-?[0-9.]+/g;
    for (const it of all("[data-before]", svg)) {
      const after = ofFile(it).match(number).map(Number);
      let k = 0;
      const between = (before) => Number(before) + (after[k++] - before) * by;
      it.setAttribute("d", it.dataset.before.replace(number, (before) => between(before).toFixed(2)));
    }
    for (const it of all("[data-moved]", svg)) {
      const [x, y] = it.dataset.moved.split(",").map((value) => (value * (by - 1)).toFixed(2));
      it.setAttribute("transform", `translate(${x} ${y})`);
    }
  }

  function show() {
    for (const button of all("#switches button")) {
      button.setAttribute("aria-pressed", button.dataset.picture === seen.picture);
    }
    let position = null;
    for (const figure of all("figure[data-picture]")) {
      const isNow = figure.dataset.picture === seen.picture;
      figure.classList.toggle("now", isNow);
      for (const frame of all(".frame", figure)) {
        const shown = frame.dataset.step === undefined || Number(frame.dataset.step) === seen.step;
        frame.classList.toggle("now", shown);
        if (shown && frame.dataset.step !== undefined) {
          position = Number(frame.dataset.position);
          one("#steps output").textContent = frame.dataset.name;
        }
        const svg = one("svg", frame);
        const { magnified, amplitude } = svg.dataset;
        if (shown && (magnified || amplitude)) moveTo(svg, seen.scale);
        const text = magnified
          ? `magnified ${short(Number(magnified) * seen.scale)} times`
          : `amplitude ${short(seen.scale)}`;
        if (shown && magnified) {
          const legend = all(".legend text", svg).find((it) => it.textContent.startsWith("magnified "));
          if (legend) legend.textContent = text;
        }
        if (shown && isNow) {
          one("#scales").hidden = !(magnified || amplitude);
          one("#scales output").textContent = text;
        }
      }
    }
    for (const line of position === null ? [] : all("[data-steps]")) {
      line.setAttribute("transform", `translate(${line.dataset.steps.split(" ")[position]} 0)`);
    }
    if (step) step.value = seen.step;
    scale.value = seen.scale;
  }

  function read() {
    const wanted = new URLSearchParams(location.hash.slice(1));
    if (keys.includes(wanted.get("picture"))) seen.picture = wanted.get("picture");
    const within = (name, most) => {
      const value = wanted.has(name) ? Number(wanted.get(name)) : NaN;
      if (value >= 0 && value <= most) seen[name] = value;
    };
    if (step) within("step", Number(step.max));
    within("scale", Number(scale.max));
    show();
  }

  function choose(change) {
    Object.assign(seen, change);
    history.replaceState(null, "", "#" + new URLSearchParams(seen));
    show();
  }

  if (keys.length > 0) {
    for (const button of all("#switches button")) {
      button.addEventListener("click", () => choose({ picture: button.dataset.picture }));
    }
    step?.addEventListener("input", () => choose({ step: Number(step.value) }));
    scale.addEventListener("input", () => choose({ scale: Number(scale.value) }));
    addEventListener("hashchange", read);
    read();
  }

  // A click on the head of a column sorts by it, another click reverses the order; empty cells come last.
  function sort(head) {
    const table = head.closest("table");
    const column = [...head.parentNode.children].indexOf(head);
    const way = head.getAttribute("aria-sort") === "ascending" ? -1 : 1;
    all("th", table).forEach((it) => it.removeAttribute("aria-sort"));
    head.setAttribute("aria-sort", way > 0 ? "ascending" : "descending");
    const body = table.tBodies[0];
    const cell = (row) => row.children[column];
    const order = (a, b) => {
      const [x, y] = [cell(a), cell(b)];
      const isEmpty = [x, y].map((it) => it.textContent === "");
      if (isEmpty[0] || isEmpty[1]) return isEmpty[0] - isEmpty[1];
      const isNumber = x.dataset.value !== undefined && y.dataset.value !== undefined;
      return way * (isNumber ? x.dataset.value - y.dataset.value : x.textContent.localeCompare(y.textContent));
    };
    body.append(...[...body.rows].sort(order));
  }
  for (const head of all("th")) {
    head.tabIndex = 0;
    head.addEventListener("click", () => sort(head));
    head.addEventListener("keydown", (event) => {
      if (event.key === "Enter") sort(head);
    });
  }
})();
