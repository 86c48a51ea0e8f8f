import { engineOfPage } from "./engine.js";
import { stepOf, writtenAs } from "./numbers.js";
import { Completion } from "./completion.js";
import { Editor } from "./editor.js";
import { Picture } from "./picture.js";
import { Handles } from "./handles.js";

// The page: what is written is solved, and what was solved is shown.

// What comes within this time is there at once, as a hand feels it: a picture that is older grows pale [ms].
const AT_ONCE = 100;
// A solve that is younger is waited for when the text changes, so that pictures follow a hand that goes on. An older one is
// stopped: thoughts do not wait longer [ms].
const PATIENCE = 1000;
// How often the page looks for a change of the file on the disk [ms].
const LOOK = 1000;

const one = (query, within = document) => within.querySelector(query);
const all = (query, within = document) => [...within.querySelectorAll(query)];
const made = (tag, properties, ...children) => {
  const element = Object.assign(document.createElement(tag), properties);
  element.append(...children);
  return element;
};

// By this name it answers scripts in the console of the browser too.
const engine = (globalThis.masonryLive = engineOfPage());
// The file, and the text that it has; what is seen; the answer to the text that was solved last.
const file = { name: null, saved: null };
const seen = { show: "answer", step: null };
let answer = null;

const editor = new Editor({ onChange: changed, onLine: (line) => markAround(line) });
const picture = new Picture((place) => {
  editor.mark(place.first, place.last);
  editor.show(place.first, 1);
});
const handles = new Handles(one("#picture"), editor);
new Completion(editor, engine);

// --- Solving: one at a time, always the newest text.

let running = null;
// The event that the running solve, and the one after it, answers.
let newest = null;

function changed(event) {
  newest = event ?? { timeStamp: performance.now() };
  one("#name").classList.toggle("changed", file.name !== null && editor.text !== file.saved);
  one("#undo").disabled = editor.past.length === 0;
  one("#redo").disabled = editor.future.length === 0;
  all("#found section").forEach((it) => it.classList.add("old"));
  if (running === null) solve();
}

// Stops a solve of an older text, after the patience for it has ended.
function stopIfOutdated() {
  if (newest !== null && performance.now() - running.began > PATIENCE) running.controller.abort();
}

async function solve() {
  while (newest !== null) {
    const [event, text] = [newest, editor.text];
    newest = null;
    running = { began: performance.now(), controller: new AbortController() };
    age();
    const ageing = setInterval(() => {
      age();
      stopIfOutdated();
    }, AT_ONCE);
    try {
      const question = { task: "solve", text, ...seen };
      const { signal } = running.controller;
      const found = await engine.ask(question, { signal, onNews: (news) => (running.news = news) });
      show(found, text);
      painted(event, found.shown?.seconds ?? 0);
    } catch (error) {
      if (error.name !== "AbortError") fail(error);
    } finally {
      clearInterval(ageing);
    }
  }
  running = null;
  age();
}

// The last good picture stays, and says how old it is.
function age() {
  const time = running === null ? 0 : performance.now() - running.began;
  const isOld = time > AT_ONCE || answer?.error != null;
  one("#shown").classList.toggle("stale", isOld);
  one("#shown").setAttribute("aria-busy", running !== null);
  one("#age").hidden = time <= AT_ONCE;
  one("#age").textContent = `solving for ${(time / 1000).toFixed(1)} s: ${running?.news ?? ""} (the picture is that of the text before)`;
}

// Measures from an input to the picture on the screen, as `performance.getEntriesByName("answer")` has it.
function painted(event, seconds) {
  requestAnimationFrame(() => {
    const { port1, port2 } = new MessageChannel();
    port1.onmessage = () => performance.measure("answer", { start: event.timeStamp, detail: { solve: 1000 * seconds } });
    port2.postMessage(null);
  });
}

// --- Showing an answer.

function show(found, text) {
  const isMistaken = found.error != null;
  answer = isMistaken ? { ...answer, error: found.error } : { ...found, text };
  if (found.numbers) {
    editor.setRules(found.numbers);
    showControls(found.controls);
    picture.places = found.places;
  }
  showFault(found.error, text === editor.text);
  if (isMistaken) return;
  const { verdict, sentence, warnings, seconds, picture: markup, report } = found.shown;
  setVerdict(verdict, sentence);
  one("#warnings").textContent = [...warnings, `Solved in ${milliseconds(seconds)} ms.`].join(" ");
  showTabs(found.shown);
  one("#report").hidden = report === null;
  one("#picture").hidden = report !== null;
  if (report !== null) one("#report").textContent = report;
  else picture.show(markup);
  handles.show(found.handles, report === null ? picture.svg : null);
}

// Two digits below ten.
function milliseconds(seconds) {
  return (1000 * seconds).toFixed(seconds < 0.01 ? 1 : 0);
}

function setVerdict(verdict, sentence) {
  one("#verdict").className = verdict;
  // Only what differs is announced.
  if (one("h1").textContent !== sentence) one("h1").textContent = sentence;
  document.title = `${verdict}: masonry live`;
}

function showFault(error, isCurrent) {
  const place = one("#fault");
  place.hidden = error == null;
  if (isCurrent) editor.fault(error?.line, error?.column);
  if (error == null) return;
  const { message, line, column } = error;
  place.replaceChildren(message);
  if (!line) return;
  const go = made("button", { type: "button", textContent: `Line ${line}, column ${column}` });
  go.addEventListener("click", () => editor.show(line, column));
  place.prepend(go);
}

function fail(error) {
  setVerdict("", error.message);
  one("#shown").classList.add("stale");
}

const NAMES = { answer: "Answer", forces: "Forces", stresses: "Stresses", cracks: "Cracks", deformed: "Deformed", mechanism: "Mechanism", scene: "Scene", report: "Report" };

function showTabs({ choices, steps }) {
  const tabs = one("#tabs");
  if (all("button", tabs).map((it) => it.dataset.show).join() !== choices.join()) {
    tabs.replaceChildren(...choices.map((choice) => {
      const tab = made("button", { type: "button", textContent: NAMES[choice] });
      tab.dataset.show = choice;
      tab.addEventListener("click", (event) => look({ show: choice }, event));
      return tab;
    }));
  }
  for (const tab of tabs.children) tab.setAttribute("aria-pressed", tab.dataset.show === seen.show);
  one("#steps").hidden = steps.length < 2;
  const [slider, name] = [one("#steps input"), one("#steps output")];
  slider.max = Math.max(steps.length - 1, 0);
  slider.value = seen.step ?? slider.max;
  name.textContent = steps[slider.value] ?? "";
}

function look(change, event) {
  Object.assign(seen, change);
  changed(event);
}

one("#steps input").addEventListener("input", (event) => look({ step: Number(event.target.value) }, event));

// --- Sliders of what a scene offers. A slider that is held stays as it is.

function showControls(controls) {
  const box = one("#controls");
  const old = new Map([...box.children].map((it) => [it.offer.label, it]));
  const labels = controls.map((control) => old.get(control.label) ?? slider(control));
  // An element that is taken out and put in again loses hold and focus.
  if (labels.length !== old.size || labels.some((it, index) => it !== box.children[index])) box.replaceChildren(...labels);
  labels.forEach((label, index) => {
    const control = (label.offer = controls[index]);
    const input = one("input", label);
    if (!label.held) {
      input.max = Math.max(control.most, control.value);
      input.value = control.value;
    }
    one("output", label).textContent = Number(control.value.toPrecision(6));
  });
  one("[data-task=thickness]").hidden = firstArch(controls) === undefined;
}

function slider({ label: text, most }) {
  const input = made("input", { type: "range", min: 0, max: most, step: "any" });
  const label = made("label", { offer: { label: text } }, made("span", { textContent: text, title: text }), input, made("output"));
  input.addEventListener("input", (event) => {
    if (!label.held) {
      label.held = { control: label.offer, base: editor.text };
      editor.remember();
    }
    const { control, base } = label.held;
    const step = stepOf(Number(input.max), false) / 10;
    const value = Math.round(input.value / step) * step;
    const changes = control.edits.map(({ from, to, before, part }) => {
      return { from, to, text: before + writtenAs(value * part, base.slice(from, to), step, false) };
    });
    editor.change(changes, event, base);
  });
  input.addEventListener("change", () => (label.held = null));
  return label;
}

// --- Between text and picture.

function markAround(line) {
  const place = picture.mark(line);
  editor.mark(place?.first ?? 0, place?.last ?? -1);
}

// --- Work that takes longer.

let work = null;

for (const button of all("#work [data-task]")) {
  button.addEventListener("click", async () => {
    work?.abort();
    const { task } = button.dataset;
    const question = { task, text: editor.text, law: one("#law").value };
    if (task === "thickness") question.arch = firstArch(answer.controls);
    const mine = (work = new AbortController());
    const news = one("#news");
    one("#stop").hidden = false;
    news.textContent = `${button.textContent}: begun`;
    try {
      const found = await engine.ask(question, { signal: mine.signal, onNews: (it) => (news.textContent = `${button.textContent}: ${it}`) });
      news.textContent = "";
      if (found.error) news.textContent = found.error.message;
      else showFound(button.textContent, found);
    } catch (error) {
      if (error.name !== "AbortError") news.textContent = error.message;
      else if (work === mine) news.textContent += " (stopped)";
    }
    if (work === mine) {
      work = null;
      one("#stop").hidden = true;
    }
  });
}
one("#stop").addEventListener("click", () => work?.abort());

// The name of the first arch whose thickness has a slider.
function firstArch(controls) {
  const label = controls.find((it) => it.label.startsWith("thickness of "))?.label;
  return label?.replace("thickness of ", "");
}

function showFound(title, { sentence, pictures, text }) {
  const section = made("section", {}, made("h2", { textContent: `${title}: ${sentence}` }));
  const place = made("figure");
  const names = pictures.map(({ name, picture: markup }, index) => {
    const button = made("button", { type: "button", textContent: name });
    button.addEventListener("click", () => {
      place.innerHTML = markup;
      names.forEach((it) => it.setAttribute("aria-pressed", it === button));
    });
    if (index === 0) queueMicrotask(() => button.click());
    return button;
  });
  const report = made("details", { open: pictures.length === 0 }, made("summary", { textContent: "Report" }), made("pre", { textContent: text }));
  section.append(made("div", {}, ...names), place, report);
  one("#found").replaceChildren(section);
}

// --- Comparison.

one("#keep").addEventListener("click", () => {
  if (!answer?.shown) return;
  const { text, shown } = answer;
  const section = made("section", {}, made("h2", { textContent: `Kept: ${shown.sentence}` }));
  const back = made("button", { type: "button", textContent: "Back to this" });
  back.addEventListener("click", (event) => editor.set(text, event));
  const drop = made("button", { type: "button", textContent: "Drop" });
  drop.addEventListener("click", () => section.remove());
  const copy = made("figure");
  if (picture.svg) copy.append(picture.svg.cloneNode(true));
  section.append(back, drop, copy);
  one("#kept").prepend(section);
});

// --- Files.

function notice(message, actions = {}) {
  const place = one("#notice");
  place.hidden = message === "";
  place.replaceChildren(`${message} `);
  for (const [name, action] of Object.entries(actions)) {
    const button = made("button", { type: "button", textContent: name });
    button.addEventListener("click", () => {
      notice("");
      action();
    });
    place.append(button, " ");
  }
}

function download(name, text, type) {
  const address = URL.createObjectURL(new Blob([text], { type }));
  made("a", { href: address, download: name }).click();
  setTimeout(() => URL.revokeObjectURL(address), LOOK);
}

async function save() {
  const text = editor.text;
  if (!engine.hasFiles) return download(file.name ?? "scene.toml", text, "application/toml");
  const name = file.name ?? prompt("Name of the new scene file", "scene.toml");
  if (name === null) return;
  const { error } = await engine.save({ name, text, was: file.saved }).catch((failure) => ({ error: failure }));
  if (error) return notice(error.message);
  Object.assign(file, { name, saved: text });
  one("#name").textContent = name;
  notice("");
  changed();
}

// A change on the disk is loaded, if nothing was changed here.
async function lookAtDisk() {
  const { name, text } = await engine.load().catch(() => ({}));
  if (!name || name !== file.name || text === file.saved) return;
  const take = () => {
    file.saved = text;
    editor.set(text);
  };
  if (editor.text === file.saved) return take();
  if (one("#notice").hidden) notice("The file has changed on the disk.", { "Load it": take, "Keep this text": () => (file.saved = text) });
}

const EXPORTS = { page: ["page.html", "text/html"], text: ["report.txt", "text/plain"], json: ["result.json", "application/json"], dxf: ["scene.dxf", "image/vnd.dxf"] };

one("#export").addEventListener("change", async ({ target }) => {
  const format = target.value;
  target.value = "";
  if (format === "picture") {
    if (picture.svg) download(`${answer.shown.show}.svg`, new XMLSerializer().serializeToString(picture.svg), "image/svg+xml");
    return;
  }
  const [name, type] = EXPORTS[format];
  const { file: text, error } = await engine.ask({ task: "export", text: editor.text, format });
  if (error) notice(error.message);
  else download(name, text, type);
});

one("#begin").addEventListener("change", ({ target }) => {
  const { text } = beginnings.find((it) => it.name === target.value);
  target.value = "";
  Object.assign(file, { name: null, saved: null });
  one("#name").textContent = "";
  editor.set(text);
});

one("#save").addEventListener("click", save);
one("#undo").addEventListener("click", (event) => editor.undo(event));
one("#redo").addEventListener("click", (event) => editor.redo(event));
addEventListener("keydown", (event) => {
  if (!(event.ctrlKey || event.metaKey) || event.key.toLowerCase() !== "s") return;
  event.preventDefault();
  save();
});

// --- The beginning.

let beginnings = [];

async function begin() {
  const [scenes, { name, text, error }] = await Promise.all([engine.ask({ task: "begin" }), engine.load()]);
  beginnings = scenes;
  one("#begin").append(...scenes.map((it) => made("option", { value: it.name, textContent: it.meaning })));
  if (error) notice(error.message);
  if (!name) return editor.begin(scenes[0].text);
  Object.assign(file, { name, saved: text });
  one("#name").textContent = name;
  editor.begin(text);
  setInterval(lookAtDisk, LOOK);
}

begin().catch(fail);
