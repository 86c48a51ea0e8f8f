import { all, button, made, one } from "./elements.js";
import { rangeOf } from "./numbers.js";
import { put } from "./picture.js";
import { Tables } from "./tables.js";

// Questions that take longer than a solve: limits, ranges, thicknesses, studies, and values at which the verdict
// changes. One question runs at a time, and each can be stopped.

// The question about a number, by the present verdict.
const ASKED = { stands: "falls at?", falls: "stands at?", undecided: "changes at?" };

export class Work {
  constructor(engine, editor) {
    Object.assign(this, { engine, editor, running: null, arch: undefined, factors: [], asked: ASKED.undecided });
    this.choose(null);
    for (const it of all("#work [data-task]")) it.addEventListener("click", () => this.begin(it.dataset.task, it.textContent));
    one("#change").addEventListener("click", () => {
      const number = this.number;
      const edit = { from: number.from, to: number.to, before: "", part: 1 };
      this.ask({ ...number, edits: [edit], range: rangeOf(number) });
    });
    one("#scene").addEventListener("keydown", (event) => {
      if (!event.altKey || event.key !== "Enter") return;
      event.preventDefault();
      one("#change").click();
    });
    one("#stop").addEventListener("click", () => this.running?.abort());
  }

  // Sets the first arch of a scene, for its least thickness, and the factors that a limit multiplies.
  offer(controls, hasTrain) {
    one("[data-task=train]").hidden = !hasTrain;
    const label = controls.find((it) => it.label.startsWith("thickness of "))?.label;
    this.arch = label?.replace("thickness of ", "");
    one("[data-task=thickness]").hidden = this.arch === undefined;
    const factors = controls.filter(({ label, value }) => label.startsWith("factor of ") && value !== 1);
    this.factors = factors.map(({ label, value }) => ({ group: label.replace("factor of ", ""), value: Number(value.toPrecision(6)) }));
  }

  // Chooses a number of the text, for the search without a slider.
  choose(number) {
    this.number = number;
    const button = one("#change");
    button.disabled = number === null;
    button.dataset.asks = number?.label ?? "number at the cursor";
    this.name(button);
  }

  // Names the buttons of numbers by their question, which depends on the last verdict, and by their number if it does
  // not stand beside them.
  nameNumbers(verdict) {
    this.asked = ASKED[verdict] ?? this.asked;
    for (const it of all("[data-asks]")) this.name(it);
  }

  name(button) {
    const full = `${button.dataset.asks}: ${this.asked}`;
    button.textContent = button.id === "change" ? full : this.asked;
    button.setAttribute("aria-label", full);
    button.title = "Finds values of this number between which the verdict changes";
  }

  // Searches for values of a number at which the verdict changes.
  ask({ label, edits, value, range, whole = false }) {
    this.begin("change", "Search", { label, edits, value, range, whole });
  }

  // Removes the results, which belong to another scene.
  clear() {
    this.running?.abort();
    this.running = null;
    one("#stop").hidden = true;
    one("#news").textContent = "";
    one("#found").replaceChildren();
  }

  // Marks the results, which belong to an earlier text; numbers may have other places.
  changed() {
    const now = this.number && this.editor.numberAt(this.number.from);
    this.choose(now?.label === this.number?.label ? now : null);
    age(true);
  }

  async begin(task, title, more = {}) {
    this.running?.abort();
    const mine = (this.running = new AbortController());
    const question = { task, text: this.editor.text, law: one("#law").value, arch: this.arch, ...more };
    const isOld = () => question.text !== this.editor.text;
    const tell = (news) => {
      if (this.running !== mine) return;
      one("#news").textContent = news;
      one("#news").classList.toggle("old", isOld());
    };
    // A limit multiplies the load of the text, which has its own factor.
    const multiplied = (sentence) => {
      const own = task === "limit" && this.factors.find(({ group }) => sentence.includes(`"${group}"`));
      return own ? ` The limit multiplies the load with its factor of ${own.value}.` : "";
    };
    one("#stop").hidden = false;
    tell(`${title}: begun`);
    try {
      const onNews = (news) => tell(`${title}: ${news}`);
      const found = await this.engine.ask(question, { signal: mine.signal, onNews });
      tell(found.error?.message ?? `${title}: ${found.sentence}${multiplied(found.sentence)} ${found.pictures.length > 0 ? "The pictures are" : "The report is"} below.`);
      if (!found.error) {
        show(title, found);
        age(isOld());
      }
    } catch (error) {
      tell(error.name === "AbortError" ? `${one("#news").textContent} (stopped)` : error.message);
    }
    if (this.running !== mine) return;
    this.running = null;
    one("#stop").hidden = true;
  }
}

// Marks the results as those of an earlier text, or of the present one.
function age(isOld) {
  for (const it of all("#found > section, #news")) it.classList.toggle("old", isOld);
}

function show(title, { sentence, pictures, tables, text }) {
  const heading = made("h2", { textContent: `${title}: ${sentence}` });
  const place = made("figure");
  const choices = pictures.map(({ name, picture }) => {
    const choice = button(name, () => {
      put(place, picture);
      for (const it of choices) it.setAttribute("aria-pressed", it === choice);
    });
    return choice;
  });
  const report = made("details", { open: pictures.length === 0 }, made("summary", { textContent: "Report" }));
  report.append(made("pre", { textContent: text }));
  const numbers = made("details", { hidden: tables === "" }, made("summary", { textContent: "Tables" }), made("div"));
  new Tables(numbers.lastChild).show(tables);
  one("#found").replaceChildren(made("section", {}, heading, made("div", {}, ...choices), made("div", {}, place), numbers, report));
  choices[0]?.click();
}
