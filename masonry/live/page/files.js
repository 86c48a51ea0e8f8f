import { button, made, one } from "./elements.js";

// The file of the scene, scenes to begin with, and files to take away.

// How often the page looks for a change of the file on the disk [ms].
const LOOK = 1000;

const EXPORTS = {
  page: ["page.html", "text/html"],
  text: ["report.txt", "text/plain"],
  json: ["result.json", "application/json"],
  dxf: ["scene.dxf", "image/vnd.dxf"],
};

export class Files {
  constructor(engine, editor, picture) {
    Object.assign(this, { engine, editor, picture });
    // The name of the file, and the text that it has.
    [this.name, this.saved] = [null, null];
    one("#save").addEventListener("click", () => this.save());
    one("#begin").addEventListener("change", ({ target }) => this.take(target));
    one("#export").addEventListener("change", ({ target }) => this.export(target));
    addEventListener("keydown", (event) => {
      if (!(event.ctrlKey || event.metaKey) || event.key.toLowerCase() !== "s") return;
      event.preventDefault();
      this.save();
    });
    addEventListener("beforeunload", (event) => {
      if (this.isChanged) event.preventDefault();
    });
  }

  get isChanged() {
    return this.name !== null && this.editor.text !== this.saved;
  }

  changed() {
    one("#name").classList.toggle("changed", this.isChanged);
  }

  rename(name, saved) {
    [this.name, this.saved] = [name, saved];
    one("#name").textContent = name ?? "New scene";
    this.changed();
  }

  // Loads the scene of the command, or the first to begin with.
  async begin() {
    const [scenes, { name, text, error }] = await Promise.all([this.engine.ask({ task: "begin" }), this.engine.load()]);
    this.scenes = scenes;
    one("#begin").append(...scenes.map((it) => made("option", { value: it.name, textContent: it.meaning })));
    if (error) notice(error.message);
    if (!name) return this.editor.begin(scenes[0].text);
    this.rename(name, text);
    this.editor.begin(text);
    setInterval(() => this.lookAtDisk(), LOOK);
  }

  take(select) {
    const { text } = this.scenes.find((it) => it.name === select.value);
    select.value = "";
    this.rename(null, null);
    this.editor.set(text);
  }

  async save() {
    const { text } = this.editor;
    if (!this.engine.hasFiles) return download(this.name ?? "scene.toml", text, "application/toml");
    const name = this.name ?? prompt("Name of the new scene file", "scene.toml");
    if (name === null) return;
    const { error } = await this.engine.save({ name, text, was: this.saved }).catch((failure) => ({ error: failure }));
    if (error) return notice(error.message);
    this.rename(name, text);
    notice("");
  }

  // A change on the disk is loaded, if nothing was changed here.
  async lookAtDisk() {
    const { name, text } = await this.engine.load().catch(() => ({}));
    if (!name || name !== this.name || text === this.saved) return;
    const load = () => {
      this.rename(name, text);
      this.editor.set(text);
    };
    if (!this.isChanged) load();
    else if (one("#notice").hidden) {
      notice("The file has changed on the disk.", { "Load it": load, "Keep this text": () => this.rename(name, text) });
    }
  }

  async export(select) {
    const format = select.value;
    select.value = "";
    if (format === "picture") {
      const { svg } = this.picture;
      if (svg) download("picture.svg", new XMLSerializer().serializeToString(svg), "image/svg+xml");
      return;
    }
    const { file, error } = await this.engine.ask({ task: "export", text: this.editor.text, format });
    const [name, type] = EXPORTS[format];
    if (error) notice(error.message);
    else download(name, file, type);
  }
}

function notice(message, actions = {}) {
  const place = one("#notice");
  place.hidden = message === "";
  place.replaceChildren(`${message} `);
  for (const [name, action] of Object.entries(actions)) {
    place.append(button(name, () => {
      notice("");
      action();
    }), " ");
  }
}

function download(name, text, type) {
  const address = URL.createObjectURL(new Blob([text], { type }));
  made("a", { href: address, download: name }).click();
  setTimeout(() => URL.revokeObjectURL(address), LOOK);
}
