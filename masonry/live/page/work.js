import { all, button, made, one } from "./elements.js";

// Questions that take longer than a solve: limits, ranges, thicknesses and studies, one at a time, and each can be stopped.

export class Work {
  constructor(engine, editor) {
    Object.assign(this, { engine, editor, running: null, arch: undefined, factors: [] });
    for (const it of all("#work [data-task]")) it.addEventListener("click", () => this.begin(it.dataset.task, it.textContent));
    one("#stop").addEventListener("click", () => this.running?.abort());
  }

  // The arch of which the least thickness is asked for, the first that has one; and the factors that a limit multiplies.
  offer(controls) {
    const label = controls.find((it) => it.label.startsWith("thickness of "))?.label;
    this.arch = label?.replace("thickness of ", "");
    one("[data-task=thickness]").hidden = this.arch === undefined;
    const factors = controls.filter(({ label, value }) => label.startsWith("factor of ") && value !== 1);
    this.factors = factors.map(({ label, value }) => ({ group: label.replace("factor of ", ""), value: Number(value.toPrecision(6)) }));
  }

  // What was found belongs to an earlier text.
  changed() {
    for (const section of all("#found section")) section.classList.add("old");
  }

  async begin(task, title) {
    this.running?.abort();
    const mine = (this.running = new AbortController());
    const tell = (news) => {
      if (this.running === mine) one("#news").textContent = news;
    };
    // A limit is a multiple of the load of the text, which has a factor of its own.
    const multiplied = (sentence) => {
      const own = task === "limit" && this.factors.find(({ group }) => sentence.includes(`"${group}"`));
      return own ? ` The limit multiplies the load with its factor of ${own.value}.` : "";
    };
    const question = { task, text: this.editor.text, law: one("#law").value, arch: this.arch };
    one("#stop").hidden = false;
    tell(`${title}: begun`);
    try {
      const onNews = (news) => tell(`${title}: ${news}`);
      const found = await this.engine.ask(question, { signal: mine.signal, onNews });
      tell(found.error?.message ?? `${title}: ${found.sentence}${multiplied(found.sentence)} The pictures are below.`);
      if (!found.error) show(title, found);
    } catch (error) {
      tell(error.name === "AbortError" ? `${one("#news").textContent} (stopped)` : error.message);
    }
    if (this.running !== mine) return;
    this.running = null;
    one("#stop").hidden = true;
  }
}

function show(title, { sentence, pictures, text }) {
  const heading = made("h2", { textContent: `${title}: ${sentence}` });
  const place = made("figure");
  const choices = pictures.map(({ name, picture }) => {
    const choice = button(name, () => {
      place.innerHTML = picture;
      for (const it of choices) it.setAttribute("aria-pressed", it === choice);
    });
    return choice;
  });
  const report = made("details", { open: pictures.length === 0 }, made("summary", { textContent: "Report" }));
  report.append(made("pre", { textContent: text }));
  one("#found").replaceChildren(made("section", {}, heading, made("div", {}, ...choices), place, report));
  choices[0]?.click();
}
