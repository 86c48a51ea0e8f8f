// Operates a page as a reader does, and leaves what it saw in the document.
(() => {
  const all = (query, within = document) => [...within.querySelectorAll(query)];
  const one = (query) => document.querySelector(query);
  const isSeen = (it) => it.getClientRects().length > 0;
  const seen = () => ({
    pictures: all("figure[data-picture]").filter(isSeen).map((it) => it.dataset.picture),
    pressed: all("#switches button[aria-pressed=true]").map((it) => it.dataset.picture),
    frames: all("figure.now .frame").filter(isSeen).map((it) => it.dataset.name),
    step: one("#steps output").textContent,
    scale: isSeen(one("#scales")) ? one("#scales output").textContent : null,
    mark: one("[data-steps]").getAttribute("transform").match(/[0-9.]+/)[0],
    hash: location.hash,
  });
  const pick = (name) => one(`#switches button[data-picture=${name}]`).click();
  const slide = (id, value) => {
    one(id).value = value;
    one(id).dispatchEvent(new Event("input"));
  };
  const corner = () => {
    // At the top, where it moves.
    const block = all("figure.now .frame.now .drawing .deformed path").at(-1);
    const last = (data) => data.match(/-?[0-9.]+/g).slice(-2).map(Number);
    const legend = all("figure.now .frame.now .legend text").map((it) => it.textContent);
    return { legend, before: last(block.dataset.before), now: last(block.getAttribute("d")) };
  };
  const column = (title, head) => {
    const table = all("section.table").find((it) => it.querySelector("h2").textContent === title);
    const heads = all("th", table);
    const index = heads.findIndex((it) => it.textContent.startsWith(head));
    heads[index].click();
    return all("tbody tr", table).map((row) => Number(row.children[index].dataset.value));
  };

  const log = { opened: seen() };
  pick("deformed");
  log.deformed = { ...seen(), corner: corner() };
  slide("#scale", 0);
  log.still = { ...seen(), corner: corner() };
  slide("#scale", 2);
  log.twice = { ...seen(), corner: corner() };
  slide("#step", 0);
  log.first = seen();
  pick("forces");
  log.forces = seen();
  log.ascending = column("Joints", "N ");
  log.descending = column("Joints", "N ");
  location.hash = "#picture=scene&step=1";
  addEventListener("hashchange", () => {
    log.addressed = seen();
    log.marks = one("[data-steps]").dataset.steps.split(" ");
    log.errors = window.errors ?? [];
    const note = document.createElement("pre");
    note.id = "probe";
    note.textContent = JSON.stringify(log);
    document.body.append(note);
  });
})();
