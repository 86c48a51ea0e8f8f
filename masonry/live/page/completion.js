// A list of possible continuations at the cursor, below the cursor.

export class Completion {
  constructor(editor, engine) {
    [this.editor, this.engine] = [editor, engine];
    this.list = document.getElementById("completion");
    this.area = editor.area;
    this.area.addEventListener("input", (event) => {
      if (event.inputType === "insertText" && /[\w"]/.test(event.data ?? "")) this.open();
      else this.close();
    });
    this.area.addEventListener("keydown", (event) => this.key(event), true);
    this.area.addEventListener("blur", () => this.close());
    this.list.addEventListener("pointerdown", (event) => {
      event.preventDefault();
      this.take([...this.list.children].indexOf(event.target.closest("li")), event);
    });
  }

  async open() {
    const [text, at] = [this.editor.text, this.area.selectionStart];
    // There is nothing to list without an answer; the solve of the same text shows the error.
    const { entries, before, after } = await this.engine.ask({ task: "complete", text, at }).catch(() => ({}));
    if (text !== this.editor.text || at !== this.area.selectionStart) return;
    this.close();
    if (!entries?.length) return;
    Object.assign(this, { entries, before, after, at });
    this.list.replaceChildren(...entries.map(({ name, meaning }, index) => {
      const item = document.createElement("li");
      [item.role, item.id, item.title] = ["option", `completion-${index}`, meaning];
      const small = document.createElement("small");
      small.textContent = `  ${meaning}`;
      item.append(name, small);
      return item;
    }));
    const until = text.slice(0, at).split("\n");
    const row = this.editor.layer.children[until.length - 1];
    const probe = document.createRange();
    probe.selectNodeContents(row);
    const letters = text.split("\n")[until.length - 1].length;
    const width = letters > 0 ? probe.getBoundingClientRect().width / letters : 0;
    this.list.style.left = `${8 + width * Math.max(until.at(-1).length - before, 0)}px`;
    this.list.hidden = false;
    // The list is above the line if there is no room below the line.
    const [below, above] = [row.offsetTop + row.offsetHeight, row.offsetTop - this.list.offsetHeight];
    const { scrollTop, clientHeight } = this.editor.box;
    const isBelow = below + this.list.offsetHeight <= scrollTop + clientHeight || above < scrollTop;
    this.list.style.top = `${isBelow ? below : above}px`;
    this.choose(0);
  }

  close() {
    this.list.hidden = true;
    this.area.removeAttribute("aria-activedescendant");
  }

  choose(index) {
    this.chosen = (index + this.entries.length) % this.entries.length;
    [...this.list.children].forEach((item, at) => item.setAttribute("aria-selected", at === this.chosen));
    this.list.children[this.chosen].scrollIntoView({ block: "nearest" });
    this.area.setAttribute("aria-activedescendant", `completion-${this.chosen}`);
  }

  key(event) {
    if (event.ctrlKey && event.key === " ") {
      event.preventDefault();
      this.open();
      return;
    }
    if (this.list.hidden || event.altKey) return;
    const actions = {
      ArrowDown: () => this.choose(this.chosen + 1),
      ArrowUp: () => this.choose(this.chosen - 1),
      Enter: () => this.take(this.chosen, event),
      Tab: () => this.take(this.chosen, event),
      Escape: () => this.close(),
    };
    if (!actions[event.key]) return;
    event.preventDefault();
    actions[event.key]();
  }

  take(index, event) {
    const entry = this.entries[index];
    this.close();
    if (!entry) return;
    const from = this.at - this.before;
    const rest = this.editor.text.slice(this.at).split("\n", 1)[0];
    const text = entry.name + (rest.trim() === "" ? this.after : "");
    this.editor.remember();
    this.editor.change([{ from, to: this.at, text }], event);
    this.area.setSelectionRange(from + text.length, from + text.length);
  }
}
