import { parts, replaced, stepOf, writtenAs } from "./numbers.js";

// The text of the scene: a text area below a layer of the same letters in colours, in which numbers can be dragged.

// The pixels of dragging for one step of a number: a number near the left edge of a screen can still reach zero.
const PIXELS = 2;
// Typing is undone in pieces of this time [ms].
const PIECE = 1000;
// Two clicks on a number within this time select it [ms]. Chosen: desktops take 400 to 500 ms.
const DOUBLE_CLICK = 400;

export class Editor {
  // `onChange(event)` is called for every change by hand, `onLine(line)` with the line of the cursor, and
  // `onNumber(number)` with the number that was dragged or is at the cursor.
  constructor({ onChange, onLine, onNumber }) {
    this.area = document.getElementById("scene");
    this.layer = document.getElementById("colours");
    this.lines = document.getElementById("lines");
    this.box = document.getElementById("editor");
    [this.onChange, this.onNumber] = [onChange, onNumber];
    this.rules = new Map();
    this.past = [];
    this.future = [];
    this.typed = 0;
    this.before = "";
    this.clicked = { from: -1, at: 0 };
    this.area.addEventListener("input", (event) => this.type(event));
    this.area.addEventListener("keydown", (event) => this.turnByKey(event));
    addEventListener("keydown", (event) => this.undoByKey(event));
    document.addEventListener("selectionchange", () => {
      if (document.activeElement !== this.area) return;
      onLine(this.lineAt(this.area.selectionStart));
      onNumber(this.numberAt(this.area.selectionStart));
    });
    this.area.addEventListener("blur", () => onLine(0));
    this.layer.addEventListener("pointerdown", (event) => this.hold(event));
  }

  get text() {
    return this.area.value;
  }

  // Replaces the text; undo restores the text before.
  set(text, event) {
    if (text === this.text) return;
    this.remember();
    this.put(text, event);
  }

  // Changes some places, each `{ from, to, text }`, of `base`: the present text, or the text at the beginning of a
  // drag. Undo restores the text that was remembered before.
  change(changes, event, base = this.text) {
    this.put(replaced(base, changes), event);
  }

  put(text, event) {
    const { selectionStart, selectionEnd } = this.area;
    this.area.value = text;
    if (document.activeElement === this.area) this.area.setSelectionRange(selectionStart, selectionEnd);
    this.before = text;
    this.draw();
    this.onChange(event);
  }

  // Begins with a new text; undo does not go back behind it.
  begin(text) {
    [this.past, this.future] = [[], []];
    this.put(text);
  }

  remember() {
    if (this.past.at(-1) !== this.before) this.past.push(this.before);
    this.future = [];
    this.typed = 0;
  }

  undo(event) {
    this.step(this.past, this.future, event);
  }

  redo(event) {
    this.step(this.future, this.past, event);
  }

  step(from, to, event) {
    while (from.length > 0 && from.at(-1) === this.text) from.pop();
    if (from.length === 0) return;
    to.push(this.text);
    this.typed = 0;
    this.put(from.pop(), event);
  }

  type(event) {
    if (event.timeStamp - this.typed > PIECE) this.remember();
    this.typed = event.timeStamp;
    this.before = this.text;
    this.draw();
    this.onChange(event);
  }

  // Works at any focus, since sliders and pictures change the text as well.
  undoByKey(event) {
    const letter = event.key.toLowerCase();
    if (!(event.ctrlKey || event.metaKey) || (letter !== "z" && letter !== "y")) return;
    event.preventDefault();
    if (letter === "y" || event.shiftKey) this.redo(event);
    else this.undo(event);
  }

  turnByKey(event) {
    if (!event.altKey || (event.key !== "ArrowUp" && event.key !== "ArrowDown")) return;
    const number = this.numberAt(this.area.selectionStart);
    if (!number) return;
    event.preventDefault();
    this.remember();
    this.turn(number, event.key === "ArrowUp" ? 1 : -1, event);
  }

  // Sets the properties of the numbers of this text from the engine: whether they count something, and their least
  // value.
  setRules(numbers) {
    this.rules = new Map(numbers.map((it) => [it.from, it]));
  }

  draw() {
    const rows = this.text.split("\n");
    this.lines.textContent = rows.map((_, index) => index + 1).join("\n");
    let from = 0;
    this.layer.replaceChildren(...rows.map((row) => {
      const line = document.createElement("span");
      line.className = "row";
      for (const { kind, text, at } of parts(row)) {
        const piece = document.createElement("span");
        piece.textContent = text;
        if (kind !== "other") piece.className = kind;
        if (kind === "number") piece.dataset.from = from + at;
        line.append(piece);
      }
      from += row.length + 1;
      return line;
    }));
    if (this.held) this.spanAt(this.held.from)?.classList.add("held");
  }

  spanAt(from) {
    return this.layer.querySelector(`[data-from="${from}"]`);
  }

  // The number at or beside a place in the text.
  numberAt(place) {
    const spans = [...this.layer.querySelectorAll(".number")];
    const span = spans.find((it) => {
      const from = Number(it.dataset.from);
      return from <= place && place <= from + it.textContent.length;
    });
    return span ? this.numberOf(span) : null;
  }

  numberOf(span) {
    const [from, written] = [Number(span.dataset.from), span.textContent];
    const value = Number(written.replaceAll("_", ""));
    // Properties of another number, from before this text is answered, are ignored.
    const known = this.rules.get(from);
    const { whole, least } = known?.value === value ? known : { whole: /^[+-]?\d+$/.test(written), least: null };
    // The last key before the number is its key, or the key of its list.
    const line = this.lineAt(from);
    const before = this.text.slice(0, from).split("\n").at(-1);
    const key = [...before.matchAll(/([\w-]+)\s*=/g)].at(-1)?.[1] ?? "number";
    return { from, to: from + written.length, written, value, whole, least, label: `${key} in line ${line}` };
  }

  // Holds a number with the pointer. A click without a movement sets the cursor, and the second of two clicks selects
  // the number.
  hold(event) {
    const span = event.target.closest(".number");
    if (!span || event.button !== 0) return;
    event.preventDefault();
    const number = this.numberOf(span);
    const { left, width } = span.getBoundingClientRect();
    const base = this.text;
    this.held = number;
    let isMoved = false;
    const move = (now) => {
      const steps = Math.trunc((now.clientX - event.clientX) / PIXELS);
      if (steps === 0 && !isMoved) return;
      if (!isMoved) this.remember();
      isMoved = true;
      this.turn(number, steps, now, base);
    };
    const release = () => {
      removeEventListener("pointermove", move);
      removeEventListener("pointerup", release);
      removeEventListener("pointercancel", release);
      this.held = null;
      this.draw();
      this.onNumber(this.numberAt(number.from));
      if (isMoved) return;
      const isDouble = this.clicked.from === number.from && event.timeStamp - this.clicked.at < DOUBLE_CLICK;
      this.clicked = { from: number.from, at: event.timeStamp };
      const at = number.from + Math.round(((event.clientX - left) / width) * number.written.length);
      // The line is in view; a browser would scroll to the end of the text area, which may be out of view.
      this.area.focus({ preventScroll: true });
      if (isDouble) this.area.setSelectionRange(number.from, number.to);
      else this.area.setSelectionRange(at, at);
    };
    addEventListener("pointermove", move);
    addEventListener("pointerup", release);
    addEventListener("pointercancel", release);
    span.classList.add("held");
  }

  // Changes a number by `steps` steps, or by tenths of them with Shift.
  turn({ from, to, written, value, whole, least }, steps, event, base = this.text) {
    const step = stepOf(value, whole, written) * (event.shiftKey && !whole ? 0.1 : 1);
    const turned = Math.max(value + steps * step, least ?? -Infinity);
    this.change([{ from, to, text: writtenAs(turned, written, step, whole) }], event, base);
  }

  lineAt(place) {
    return this.text.slice(0, place).split("\n").length;
  }

  // Marks lines.
  mark(first, last) {
    [...this.layer.children].forEach((row, index) => row.classList.toggle("marked", first <= index + 1 && index + 1 <= last));
  }

  show(line, column) {
    const rows = this.text.split("\n");
    const before = rows.slice(0, line - 1).reduce((sum, row) => sum + row.length + 1, 0);
    // Columns count letters, some of which take two units.
    const at = before + [...rows[line - 1]].slice(0, column - 1).join("").length;
    this.area.focus({ preventScroll: true });
    this.area.setSelectionRange(at, at);
    this.layer.children[line - 1]?.scrollIntoView({ block: "nearest" });
    // The row is as wide as the longest line, so that a browser would show its end instead of its beginning.
    if (column === 1) this.box.scrollLeft = 0;
  }

  // Shows the beginning of a text.
  rewind() {
    this.box.scrollTo(0, 0);
  }

  // Marks the place of a mistake, or no place without a line.
  fault(line, column) {
    for (const row of this.layer.children) row.classList.remove("wrong");
    const row = line ? this.layer.children[line - 1] : null;
    if (!row) return;
    row.classList.add("wrong");
    let left = column;
    for (const piece of row.children) {
      const letters = [...piece.textContent].length;
      piece.classList.toggle("at", left >= 1 && left <= letters);
      left -= letters;
    }
  }
}
