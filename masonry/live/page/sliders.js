import { made, one } from "./elements.js";
import { stepOf, writtenAs } from "./numbers.js";

// Sliders of what a scene offers, which change the numbers of its text.

export class Sliders {
  constructor(editor) {
    this.editor = editor;
    this.box = one("#controls");
  }

  // Shows the sliders of a text. One that has made the text that is there now stays where it is.
  show(controls, text) {
    this.text = text;
    const old = new Map([...this.box.children].map((it) => [it.offer.label, it]));
    const labels = controls.map((control) => old.get(control.label) ?? this.made(control));
    // An element that is taken out and put in again loses hold and focus.
    const isSame = labels.length === old.size && labels.every((it, index) => it === this.box.children[index]);
    if (!isSame) this.box.replaceChildren(...labels);
    labels.forEach((label, index) => {
      const control = (label.offer = controls[index]);
      const input = one("input", label);
      if (label.held?.text !== this.editor.text && !label.waiting) {
        input.max = Math.max(control.most, control.value);
        input.step = stepOf(Number(input.max), false) / 10;
        input.value = control.value;
      }
      one("output", label).textContent = Number(control.value.toPrecision(6));
    });
    const next = labels.find((label) => label.waiting);
    if (next) this.move(next, one("input", next), next.waiting);
  }

  made(control) {
    const input = made("input", { type: "range", min: 0, max: control.most });
    const text = made("span", { textContent: control.label, title: control.label });
    const label = made("label", { offer: control }, text, input, made("output"));
    input.addEventListener("input", (event) => this.move(label, input, event));
    input.addEventListener("change", () => label.held && (label.held.isOver = true));
    return label;
  }

  // From its first movement on a slider changes the text as it was then. It goes on from its own text, also after it was let go,
  // until an answer says where the numbers of this text are. Another slider that is moved before the answer waits for it.
  move(label, input, event) {
    const isOwn = label.held?.text === this.editor.text;
    const isKnown = this.text === this.editor.text;
    label.waiting = isOwn || isKnown ? null : event;
    if (label.waiting) return;
    if (!isOwn || (label.held.isOver && isKnown)) {
      label.held = { edits: label.offer.edits, base: this.editor.text };
      this.editor.remember();
    }
    const { edits, base } = label.held;
    const [step, value] = [Number(input.step), Number(input.value)];
    const changes = edits.map(({ from, to, before, part }) => {
      return { from, to, text: before + writtenAs(value * part, base.slice(from, to), step, false) };
    });
    this.editor.change(changes, event, base);
    label.held.text = this.editor.text;
  }
}
