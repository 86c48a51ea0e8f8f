import { SVG } from "./elements.js";
import { writtenAs } from "./numbers.js";

// Handles in the picture: openings, and ends of supports. Lengths are in units of the scene.

// Radius of the end of a support, and breadth of a side, in units of the picture.
const NEAR = 7;

export class Handles {
  // Handles change the text of `editor`.
  constructor(figure, editor) {
    [this.figure, this.editor] = [figure, editor];
    this.layer = document.createElementNS(SVG, "svg");
    this.layer.classList.add("handles");
    figure.append(this.layer);
    this.shapes = new Map();
  }

  // Puts the handles of a text over its picture, if the picture has a scale.
  show(handles, picture, text) {
    this.text = text;
    const frame = picture?.dataset.frame?.split(" ").map(Number);
    const seen = new Map(frame ? handles.map((it) => [it.label, it]) : []);
    for (const [label, shape] of this.shapes) {
      if (!seen.has(label)) this.shapes.delete(label) && shape.remove();
    }
    if (!frame) return;
    const [x, y, scale] = frame;
    this.layer.setAttribute("viewBox", picture.getAttribute("viewBox"));
    this.scale = scale;
    for (const [label, handle] of seen) {
      if (!this.shapes.has(label)) this.shapes.set(label, this.made(label));
      const shape = this.shapes.get(label);
      shape.handle = handle;
      const [left, right] = [handle.low[0], handle.high[0]].map((at) => x + scale * at);
      const [bottom, top] = [handle.low[1], handle.high[1]].map((at) => y - scale * at);
      const isEnd = left === right || top === bottom;
      shape.classList.toggle("end", isEnd);
      const room = isEnd ? NEAR : 0;
      const sizes = { x: left - room, y: top - room, width: right - left + 2 * room, height: bottom - top + 2 * room };
      for (const [name, value] of Object.entries(sizes)) shape.setAttribute(name, value.toFixed(1));
    }
  }

  made(label) {
    const shape = document.createElementNS(SVG, "rect");
    shape.classList.add("handle");
    shape.setAttribute("tabindex", "0");
    shape.setAttribute("role", "button");
    shape.setAttribute("aria-label", `${label}: arrow keys move it`);
    shape.append(Object.assign(document.createElementNS(SVG, "title"), { textContent: label }));
    shape.addEventListener("pointerdown", (event) => this.hold(shape, event));
    shape.addEventListener("keydown", (event) => {
      const ways = { ArrowLeft: [-1, 0], ArrowRight: [1, 0], ArrowUp: [0, 1], ArrowDown: [0, -1] };
      const way = ways[event.key];
      if (!way) return;
      event.preventDefault();
      if (this.isOld) return;
      this.editor.remember();
      this.move(shape.handle, way.map((steps) => steps * this.step()), event);
    });
    this.layer.append(shape);
    return shape;
  }

  // The length of the last digit of places: the round one below two pixels.
  step() {
    return 10 ** Math.floor(Math.log10(2 / this.scale));
  }

  // Whether the handles are those of an older text, whose numbers have other places.
  get isOld() {
    return this.text !== this.editor.text;
  }

  hold(shape, event) {
    event.preventDefault();
    if (this.isOld) return;
    shape.focus();
    shape.setPointerCapture(event.pointerId);
    shape.classList.add("held");
    const [{ handle }, base] = [shape, this.editor.text];
    // The size on the screen may differ from that of the picture.
    const pixels = this.layer.getScreenCTM().a * this.scale;
    let isMoved = false;
    const move = (now) => {
      if (!isMoved) this.editor.remember();
      isMoved = true;
      const lengths = [now.clientX - event.clientX, event.clientY - now.clientY].map((it) => it / pixels);
      this.move(handle, lengths, now, base);
    };
    const release = () => {
      shape.classList.remove("held");
      for (const name of ["pointermove", "pointerup", "pointercancel"]) shape.removeEventListener(name, listeners[name]);
    };
    const listeners = { pointermove: move, pointerup: release, pointercancel: release };
    for (const [name, listener] of Object.entries(listeners)) shape.addEventListener(name, listener);
  }

  // Moves a handle of a text by two lengths. A key, which comes without the base text of a drag, changes a count by
  // one.
  move(handle, lengths, event, base) {
    const text = base ?? this.editor.text;
    const changes = ["right", "up"].flatMap((way, index) =>
      handle[way].map(({ from, to, value, whole, least, per_length: slope }) => {
        const by = whole && base === undefined ? Math.sign(lengths[index]) : lengths[index] * slope;
        const step = whole ? 1 : this.step();
        const moved = Math.max(Math.round((value + by) / step) * step, least ?? -Infinity);
        const written = text.slice(from, to);
        return { from, to, text: by === 0 ? written : writtenAs(moved, written, step, whole) };
      }),
    );
    this.editor.change(changes, event, text);
  }
}
