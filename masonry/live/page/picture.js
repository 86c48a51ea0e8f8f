import { isNarrow, legendBelow } from "./legend.js";

// The picture of the answer, which changes in place, and the places of the text that describe its elements.

// The kinds of elements, and the attribute with their name in the text: the class for a joint.
const KINDS = { block: "block", joint: "class", support: "support", load: "name" };
// Marks of more elements than these are pale.
const MANY = 12;
const SELECTOR = Object.keys(KINDS).map((kind) => `[data-${kind}]`).join(",");

export class Picture {
  // `onPlace(place)` is called with the place of the text that describes a clicked element, `onWidth()` if the picture
  // gets or loses room for a legend.
  constructor(onPlace, onWidth) {
    this.figure = document.getElementById("picture");
    this.places = [];
    this.figure.addEventListener("click", (event) => {
      const element = event.target.closest(SELECTOR);
      const place = element && this.placeOf(this.named(element));
      if (place) onPlace(place);
    });
    let wasNarrow = isNarrow(this.figure);
    new ResizeObserver(() => {
      if (isNarrow(this.figure) === wasNarrow) return;
      wasNarrow = !wasNarrow;
      onWidth();
    }).observe(this.figure);
  }

  get svg() {
    return pictureIn(this.figure);
  }

  show(markup) {
    put(this.figure, markup);
    if (this.line) this.mark(this.line);
  }

  // The element itself, or, for a mark that has only the number of a joint, the element with the class of the joint.
  named(element) {
    const { joint, class: name } = element.dataset;
    if (joint === undefined || name !== undefined) return element;
    return this.svg.querySelector(`[data-joint="${joint}"][data-class]`) ?? element;
  }

  // The place that describes an element; for a brick, the place of its wall, whose name precedes the first slash.
  placeOf(element) {
    for (const [kind, key] of Object.entries(KINDS)) {
      const name = element.dataset[key];
      if (element.dataset[kind] === undefined || name === undefined) continue;
      const of = (it) => it.kind === kind && (it.name === name || name.startsWith(`${it.name}/`));
      const place = this.places.filter(of).sort((a, b) => b.name.length - a.name.length)[0];
      if (place) return place;
    }
    return null;
  }

  // Marks the elements that the lines around a line describe.
  mark(line) {
    this.line = line;
    const place = this.places.find((it) => it.first <= line && line <= it.last);
    let count = 0;
    for (const element of this.svg?.querySelectorAll(SELECTOR) ?? []) {
      count += element.classList.toggle("found", place !== undefined && this.placeOf(element) === place);
    }
    // Other marks on the bricks of a wall must stay visible if all bricks are marked.
    this.svg?.classList.toggle("many", count > MANY);
    return place;
  }
}

const pictureIn = (figure) => figure.querySelector("svg:not(.handles)");

// Shows a picture in a figure; the picture before changes into it. A narrow picture has its legend below it.
export function put(figure, markup) {
  // There are half as many nodes without line ends.
  const innerHTML = markup.replaceAll(">\n<", "><");
  const { content } = Object.assign(document.createElement("template"), { innerHTML });
  const [old, next] = [pictureIn(figure), content.firstElementChild];
  if (old) become(old, next);
  else figure.prepend(next);
  const picture = pictureIn(figure);
  picture.setAttribute("role", "img");
  if (figure.nextElementSibling?.matches(".legend")) figure.nextElementSibling.remove();
  const legend = isNarrow(figure) ? legendBelow(picture) : null;
  if (legend) figure.after(legend);
}

// Gives an element the attributes and children of another one, and keeps elements of the same kind, so that they move.
// The browser itself skips equal nodes, which is faster than any script.
export function become(old, next) {
  if (old.isEqualNode(next)) return;
  const names = next.getAttributeNames();
  for (const name of names) {
    const value = next.getAttribute(name);
    if (old.getAttribute(name) !== value) old.setAttribute(name, value);
  }
  if (old.attributes.length > names.length) {
    for (const name of old.getAttributeNames()) {
      if (!next.hasAttribute(name)) old.removeAttribute(name);
    }
  }
  if (!old.firstChild && !next.firstChild) return;
  let before = old.firstChild;
  for (const child of [...next.childNodes]) {
    const following = before?.nextSibling ?? null;
    if (before === null) old.append(child);
    else if (before.nodeName !== child.nodeName) before.replaceWith(child);
    else if (child.nodeType === Node.ELEMENT_NODE) become(before, child);
    else before.data = child.data;
    before = following;
  }
  while (before !== null) {
    const following = before.nextSibling;
    before.remove();
    before = following;
  }
}
