import { all, button, made, one } from "./elements.js";
import { put } from "./picture.js";
import { valueOf } from "./sliders.js";
import { Tables } from "./tables.js";

// Solves the text, always the newest and one at a time, and shows the answer.

// An answer within this time seems immediate; the picture grows pale if a solve takes longer [ms].
const AT_ONCE = 100;
// The longest time for a solve of an older text, so that pictures follow a continuous drag. Longer solves are stopped:
// a reader who waits for longer than a second loses the thread [ms].
const PATIENCE = 1000;
// The number of scenes that are kept for comparison, as in the engine; the oldest is dropped beyond it.
const MOST_KEPT = 3;

const NAMES = {
  answer: "Answer", forces: "Forces", stresses: "Stresses", cracks: "Cracks",
  deformed: "Deformed", mechanism: "Mechanism", scene: "Scene", tables: "Tables", report: "Report",
};

export class Answers {
  // `show(answer, text)` updates the parts of the page that change the text.
  constructor({ engine, editor, picture, handles, show }) {
    Object.assign(this, { engine, editor, picture, handles, parts: show });
    // The view, and the answer to the last text that could be solved.
    this.seen = { show: "answer", step: null };
    this.last = null;
    // Scenes for comparison, the newest first.
    this.kept = [];
    this.tables = new Tables(one("#tables"));
    // The reason for which the picture is that of an earlier text after a solve, or null.
    this.reason = null;
    // The solve that runs, and the event that starts the next one.
    this.running = null;
    this.next = null;
    one("#steps input").addEventListener("input", (event) => this.look({ step: Number(event.target.value) }, event));
  }

  // Shows another view of the same scene.
  look(change, event) {
    Object.assign(this.seen, change);
    this.changed(event);
  }

  changed(event) {
    this.next = event ?? { timeStamp: performance.now() };
    if (this.running === null) this.solve();
  }

  async solve() {
    while (this.next !== null) {
      const [event, text] = [this.next, this.editor.text];
      this.next = null;
      this.running = { text, began: performance.now(), controller: new AbortController() };
      this.age();
      const ageing = setInterval(() => this.age(), AT_ONCE);
      try {
        const { signal } = this.running.controller;
        const onNews = (news) => (this.running.news = news);
        const beside = this.kept.map((it) => it.text);
        const answer = await this.engine.ask({ task: "solve", text, beside, ...this.seen }, { signal, onNews });
        this.show(answer, text);
        painted(event, answer.shown?.seconds ?? 0);
      } catch (error) {
        if (error.name !== "AbortError") this.fail(error);
      } finally {
        clearInterval(ageing);
      }
    }
    this.running = null;
    this.age();
  }

  // Keeps the last good picture, with its age. Stops the solve of an older text after `PATIENCE`.
  age() {
    const time = this.running === null ? 0 : performance.now() - this.running.began;
    if (time > PATIENCE && this.running.text !== this.editor.text) this.running.controller.abort();
    const isOld = time > AT_ONCE || this.reason !== null;
    one("#shown").classList.toggle("stale", isOld);
    one("#verdict").classList.toggle("old", isOld);
    one("#shown").setAttribute("aria-busy", this.running !== null);
    one("#age").hidden = !isOld;
    one("#age").textContent = time > AT_ONCE
      ? `Solving for ${(time / 1000).toFixed(1)} s${this.running.news ? ` (${this.running.news})` : ""}. Verdict and picture are those of the text before.`
      : this.reason;
  }

  show(answer, text) {
    this.reason = answer.error ? "The text has a mistake: verdict and picture are those of the text before." : null;
    if (answer.numbers) this.parts(answer, text);
    this.showFault(answer.error, text === this.editor.text);
    // A handle that was dragged too far can be dragged back.
    if (answer.error) return this.handles.show(answer.handles ?? [], this.picture.svg, text);
    this.last = { ...answer, text };
    const { verdict, sentence, warnings, seconds, picture, tables, report } = answer.shown;
    setVerdict(verdict, sentence);
    const time = (1000 * seconds).toFixed(seconds < 0.01 ? 1 : 0);
    one("#warnings").textContent = [...warnings, `Solved in ${time} ms.`].join(" ");
    this.showTabs(answer.shown);
    one("#report").hidden = report === null;
    one("#tables").hidden = tables === null;
    one("#shown").classList.toggle("words", picture === null);
    if (report !== null) one("#report").textContent = report;
    if (tables !== null) this.tables.show(tables);
    if (picture !== null) this.picture.show(picture);
    this.handles.show(answer.handles, picture === null ? null : this.picture.svg, text);
    this.showKept(answer.shown);
  }

  showFault(error, isCurrent) {
    const place = one("#fault");
    place.hidden = error == null;
    if (isCurrent) this.editor.fault(error?.line, error?.column);
    if (error == null) return;
    const { message, line, column } = error;
    place.replaceChildren(message);
    if (line) place.prepend(button(`Line ${line}, column ${column}`, () => this.editor.show(line, column)));
  }

  // Shows an error of the program, not of the scene.
  fail(error) {
    setVerdict("", error.message);
    this.reason = "There is no answer: the picture is that of the text before.";
  }

  showTabs({ choices, steps }) {
    const tabs = one("#tabs");
    if (all("button", tabs).map((it) => it.dataset.show).join() !== choices.join()) {
      tabs.replaceChildren(...choices.map((choice) => {
        const tab = button(NAMES[choice], (event) => this.look({ show: choice }, event));
        tab.dataset.show = choice;
        return tab;
      }));
    }
    for (const tab of tabs.children) tab.setAttribute("aria-pressed", tab.dataset.show === this.seen.show);
    one("#steps").hidden = steps.length < 2;
    const slider = one("#steps input");
    slider.max = Math.max(steps.length - 1, 0);
    slider.value = this.seen.step ?? slider.max;
    one("#steps output").textContent = steps[slider.value] ?? "";
  }

  // Keeps the present verdict and picture beside later ones.
  keep(event) {
    if (this.last === null) return;
    const { text, shown, controls } = this.last;
    const values = controls.map((it) => `${it.label} ${valueOf(it)}`).join(", ");
    const kept = { text };
    const drop = (now) => {
      this.kept = this.kept.filter((it) => it !== kept);
      kept.section.remove();
      this.changed(now);
    };
    kept.figure = made("figure");
    // Pictures side by side have one upper edge.
    kept.section = made("section", {}, kept.figure, made("h2", { textContent: `Kept: ${shown.sentence}` }),
      button("Back to this", (now) => this.editor.set(text, now)),
      button("Drop", drop),
      made("p", { textContent: values }),
    );
    this.kept.unshift(kept);
    one("#kept").prepend(kept.section);
    for (const { section } of this.kept.splice(MOST_KEPT)) section.remove();
    this.changed(event);
  }

  // Shows the kept pictures, and the sentence on their scale. Pictures that were kept or dropped since are updated with
  // the next answer.
  showKept({ beside, scale }) {
    one("#scale").hidden = scale === null;
    one("#scale").textContent = scale ?? "";
    beside.forEach(({ picture }, index) => {
      const kept = this.kept[index];
      if (kept && picture !== null && beside.length === this.kept.length) put(kept.figure, picture);
    });
  }
}

function setVerdict(verdict, sentence) {
  one("#verdict").className = verdict;
  // Screen readers announce only differences.
  if (one("h1").textContent !== sentence) one("h1").textContent = sentence;
  document.title = `${verdict}: masonry live`;
}

// Measures the time from an input to the picture on the screen, for `performance.getEntriesByName("answer")`.
function painted(event, seconds) {
  requestAnimationFrame(() => {
    const { port1, port2 } = new MessageChannel();
    port1.onmessage = () => performance.measure("answer", { start: event.timeStamp, detail: { solve: 1000 * seconds } });
    port2.postMessage(null);
  });
}
