import { all, one } from "./elements.js";
import { become } from "./picture.js";

// Tables that are sorted by a column: by the values of numbers, or else by words; empty cells come last.

export class Tables {
  constructor(place) {
    this.place = place;
    // The columns by which tables are sorted, by the titles of the tables.
    this.sorted = new Map();
    place.addEventListener("click", (event) => {
      const head = event.target.closest("th");
      if (head) this.turn(head);
    });
  }

  // Shows other tables, which are sorted like those before.
  show(markup) {
    const next = this.place.cloneNode(false);
    next.innerHTML = markup;
    for (const head of all("th", next)) {
      const name = head.textContent;
      head.innerHTML = '<button type="button"></button>';
      head.firstChild.textContent = name;
    }
    for (const table of all("table", next)) this.sort(table);
    become(this.place, next);
  }

  turn(head) {
    const way = head.getAttribute("aria-sort") === "ascending" ? "descending" : "ascending";
    const table = head.closest("table");
    this.sorted.set(titleOf(table), { column: head.textContent, way });
    this.sort(table);
  }

  sort(table) {
    const sorted = this.sorted.get(titleOf(table));
    if (!sorted) return;
    const heads = all("th", table);
    const column = heads.findIndex((it) => it.textContent === sorted.column);
    if (column < 0) return;
    for (const head of heads) head.removeAttribute("aria-sort");
    heads[column].setAttribute("aria-sort", sorted.way);
    const sign = sorted.way === "ascending" ? 1 : -1;
    const order = (a, b) => {
      const [x, y] = [a, b].map((row) => row.children[column]);
      const [noX, noY] = [x, y].map((it) => it.textContent === "");
      if (noX || noY) return noX - noY;
      const areNumbers = x.dataset.value !== undefined && y.dataset.value !== undefined;
      return sign * (areNumbers ? x.dataset.value - y.dataset.value : x.textContent.localeCompare(y.textContent, "en", { numeric: true }));
    };
    const body = table.tBodies[0];
    body.append(...[...body.rows].sort(order));
  }
}

const titleOf = (table) => one("h2", table.closest("section")).textContent;
