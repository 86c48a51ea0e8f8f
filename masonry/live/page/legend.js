import { SVG, all, made, one } from "./elements.js";

// The legend of a picture on a narrow screen: below the picture, in letters of the page, since those of the picture
// would be too small.

// The width below which the letters of a picture, which is 900 wide, have less than two thirds of their size [px].
const NARROW = 600;
// The distance between lines of one entry is less than this number of letter heights; entries are farther apart.
const NEXT_LINE = 1.6;
// The largest number of labels of hinges for which larger letters have room. Chosen.
const FEW = 24;
// The height of letters in a narrow drawing [px].
const LETTERS = 11;
// Half the sizes of a symbol in a legend, and the free space around a drawing, in units of the picture.
const [HALF_WIDTH, HALF_HEIGHT, EDGE] = [32, 9, 12];

export const isNarrow = (figure) => figure.clientWidth > 0 && figure.clientWidth < NARROW;

// Reduces a picture that is too narrow for its legend to its drawing, and returns the entries of the legend as a list.
export function legendBelow(svg) {
  const drawing = one(".drawing", svg);
  const legend = one(".legend", svg);
  if (!drawing || !legend) return null;
  // Letters of a readable size count for the size of the drawing.
  svg.classList.add("narrow");
  svg.classList.toggle("few", all(".labels text", drawing).length <= FEW);
  svg.style.setProperty("--letters", `${(LETTERS * drawing.getBBox().width) / svg.clientWidth}px`);
  const { x, y, width, height } = drawing.getBBox();
  const box = [x - EDGE, y - EDGE, width + 2 * EDGE, height + 2 * EDGE];
  svg.setAttribute("viewBox", box.map((it) => it.toFixed(1)).join(" "));
  svg.setAttribute("width", box[2].toFixed(1));
  svg.setAttribute("height", box[3].toFixed(1));
  for (const it of all(".title, .legend", svg)) it.setAttribute("display", "none");
  const list = made("ul", { className: "legend" });
  // The symbol of the next entry, and the last line of text.
  let [symbol, last] = ["", null];
  for (const part of legend.children) {
    if (part.tagName !== "text") {
      [symbol, last] = [symbolOf(part), null];
      continue;
    }
    const [x, y, size] = ["x", "y", "font-size"].map((name) => Number(part.getAttribute(name)));
    const goesOn = last !== null && x === last.x && y - last.y < NEXT_LINE * size;
    if (goesOn) list.lastChild.lastChild.textContent += ` ${part.textContent}`;
    else list.append(made("li", {}, symbol, made("span", { textContent: part.textContent })));
    [symbol, last] = ["", { x, y }];
  }
  return list;
}

// The symbol of an entry, which is drawn about its middle, as a separate picture.
function symbolOf(part) {
  const symbol = document.createElementNS(SVG, "svg");
  symbol.setAttribute("viewBox", `${-HALF_WIDTH} ${-HALF_HEIGHT} ${2 * HALF_WIDTH} ${2 * HALF_HEIGHT}`);
  symbol.setAttribute("aria-hidden", "true");
  symbol.append(...[...part.children].map((it) => it.cloneNode(true)));
  return symbol;
}
