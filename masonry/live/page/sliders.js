import { button, made, one } from "./elements.js";
import { stepOf, writtenAs } from "./numbers.js";

// Sliders of a scene, which change the numbers of its text.

// The value of a control in words.
export const valueOf = ({ value, is_largest: isLargest }) => `${isLargest ? "≤ " : ""}${Number(value.toPrecision(6))}`;

export class Sliders {
  // `onAsk(control)` is called with the control for which changes of the verdict are searched.
  constructor(editor, onAsk) {
    [this.editor, this.onAsk] = [editor, onAsk];
    this.box = one("#controls");
  }

  // Shows the sliders of a text. A slider that has made the present text stays where it is.
  show(controls, text) {
    this.text = text;
    const old = new Map([...this.box.children].map((it) => [it.offer.label, it]));
    const rows = controls.map((control) => old.get(control.label) ?? this.made(control));
    // An element that is taken out and put in again would lose the pointer and the focus.
    const isSame = rows.length === old.size && rows.every((it, index) => it === this.box.children[index]);
    if (!isSame) this.box.replaceChildren(...rows);
    rows.forEach((row, index) => {
      const control = (row.offer = controls[index]);
      const input = one("input", row);
      if (row.held?.text !== this.editor.text && !row.waiting) {
        input.max = Math.max(control.most, control.value);
        input.step = stepOf(Number(input.max), false) / 10;
        input.value = control.value;
      }
      one("output", row).textContent = valueOf(control);
    });
    const next = rows.find((row) => row.waiting);
    if (next) this.move(next, one("input", next), next.waiting);
  }

  made(control) {
    const input = made("input", { type: "range", min: 0, max: control.most });
    const text = made("span", { textContent: control.label, title: control.label });
    const ask = button("", () => this.onAsk(row.offer));
    ask.dataset.asks = control.label;
    const row = made("div", { offer: control }, made("label", {}, text, input, made("output")), ask);
    input.addEventListener("input", (event) => this.move(row, input, event));
    input.addEventListener("change", () => row.held && (row.held.isOver = true));
    return row;
  }

  // A slider changes the text as it was at its first movement. The slider continues from its own text, even after its
  // release, until an answer gives the places of the numbers in this text. Another slider that is moved before the
  // answer waits for the answer.
  move(row, input, event) {
    const isOwn = row.held?.text === this.editor.text;
    const isKnown = this.text === this.editor.text;
    row.waiting = isOwn || isKnown ? null : event;
    if (row.waiting) return;
    if (!isOwn || (row.held.isOver && isKnown)) {
      row.held = { edits: row.offer.edits, base: this.editor.text };
      this.editor.remember();
    }
    const { edits, base } = row.held;
    const [step, value] = [Number(input.step), Number(input.value)];
    const changes = edits.map(({ from, to, before, part }) => {
      return { from, to, text: before + writtenAs(value * part, base.slice(from, to), step, false) };
    });
    this.editor.change(changes, event, base);
    row.held.text = this.editor.text;
  }
}
