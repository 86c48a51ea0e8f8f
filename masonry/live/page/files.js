import { button, made, one } from "./elements.js";

// The file of the scene, scenes to begin with, and exports.

// The time between two checks for a change of the file on the disk [ms].
const LOOK = 1000;

// The name under which a tab keeps a text that was not saved.
const UNSAVED = "unsaved";

// The endings of names of files, and their types.
const EXPORTS = {
  page: ["html", "text/html"],
  text: ["txt", "text/plain"],
  json: ["json", "application/json"],
  dxf: ["dxf", "image/vnd.dxf"],
};

export class Files {
  // `onBegin()` is called for a new scene that is independent of the one before.
  constructor(engine, editor, picture, onBegin) {
    Object.assign(this, { engine, editor, picture, onBegin });
    // The names of the files that were open, by their texts.
    this.known = new Map();
    // The name and the text of the file; null and the initial text for a new scene.
    [this.name, this.saved] = [null, editor.text];
    // The save that runs, and the text on the disk if it differs both from the present text and from the saved one.
    [this.saving, this.conflict] = [null, null];
    one("#save").addEventListener("click", () => this.save());
    one("#begin").addEventListener("change", ({ target }) => this.take(target));
    one("#export").addEventListener("change", ({ target }) => this.export(target));
    addEventListener("keydown", (event) => {
      if (!(event.ctrlKey || event.metaKey) || event.key.toLowerCase() !== "s") return;
      event.preventDefault();
      if (!event.repeat) this.save();
    });
    addEventListener("beforeunload", (event) => {
      if (this.isChanged) event.preventDefault();
    });
    // The last events that a page is sure to receive.
    addEventListener("pagehide", () => this.leave());
    document.addEventListener("visibilitychange", () => document.hidden && this.leave());
  }

  get isChanged() {
    return this.editor.text !== this.saved;
  }

  // The name of the file without its ending.
  get stem() {
    return this.name?.replace(/\.toml$/, "") ?? "scene";
  }

  // Keeps unsaved changes for the next page in this tab.
  leave() {
    try {
      if (this.isChanged) sessionStorage.setItem(UNSAVED, JSON.stringify({ name: this.name, text: this.editor.text }));
      else if (one("#unsaved").hidden) sessionStorage.removeItem(UNSAVED);
    } catch {
      // The storage is full: the browser has asked whether to leave.
    }
  }

  // Offers to restore the text that the page before in this tab has not saved.
  offer() {
    const { name, text } = JSON.parse(sessionStorage.getItem(UNSAVED) ?? "{}");
    if (text === undefined || text === this.editor.text) return;
    const place = one("#unsaved");
    const drop = () => {
      sessionStorage.removeItem(UNSAVED);
      tell(place, "");
    };
    const take = async () => {
      // No part of the text is saved without a file.
      const saved = name === null ? "" : (await this.engine.load(name).catch(failed)).text;
      this.editor.set(text);
      this.rename(name, saved ?? "");
      drop();
    };
    const what = name === null ? "a new scene" : name;
    tell(place, `Changes of ${what} were not saved before this page was loaded.`, { Restore: take, Discard: drop });
  }

  // If undo leads back to the text of a file that was open, the text belongs to this file again.
  changed() {
    const known = this.name === null ? this.known.get(this.editor.text) : undefined;
    if (known !== undefined) [this.name, this.saved] = [known, this.editor.text];
    one("#name").textContent = this.name ?? "New scene";
    one("#name").classList.toggle("changed", this.isChanged);
  }

  rename(name, saved) {
    [this.name, this.saved] = [name, saved];
    if (name !== null) this.known.set(saved, name);
    this.changed();
  }

  // Loads the scene of the command, or the first of the scenes to begin with.
  async begin() {
    const [scenes, { name, text, error }] = await Promise.all([this.engine.ask({ task: "begin" }), this.engine.load()]);
    this.scenes = scenes;
    one("#begin").append(...scenes.map((it) => made("option", { value: it.name, textContent: it.meaning })));
    if (error) tell(one("#notice"), error.message);
    this.editor.begin(text ?? scenes[0].text);
    this.rename(name, this.editor.text);
    this.offer();
    if (this.engine.hasFiles) setInterval(() => this.lookAtDisk(), LOOK);
  }

  async take(select) {
    const { text } = this.scenes.find((it) => it.name === select.value);
    select.value = "";
    // A save that ended later would give its name to the new scene.
    await this.saving;
    if (this.isChanged && !confirm("The changes of this scene are not saved. Begin another one?")) return;
    this.settle();
    tell(one("#unsaved"), "");
    this.editor.set(text);
    this.editor.rewind();
    this.rename(null, text);
    this.onBegin();
  }

  // Saves, one save at a time. If a save is refused since the file has changed, the conflict is shown at once.
  async save() {
    if (this.saving !== null) return;
    this.saving = this.write();
    await this.saving;
    this.saving = null;
    await this.lookAtDisk();
  }

  async write() {
    const { text } = this.editor;
    if (!this.engine.hasFiles) {
      download("scene.toml", text, "application/toml");
      return this.rename(null, text);
    }
    const given = this.name ?? prompt("Name of the new file, which is written beside the scene that was opened, or else into the directory in which masonry was started.", "scene.toml");
    if (given === null) return;
    const name = given.endsWith(".toml") ? given : `${given}.toml`;
    // The file of a new scene must not exist yet, unless it may be replaced.
    const there = this.name === null ? (await this.engine.load(name).catch(failed)).text : this.saved;
    if (this.name === null && there !== undefined && !confirm(`There is a file ${name}. Replace it?`)) return;
    const was = there ?? null;
    const { error } = await this.engine.save({ name, text, was }).catch(failed);
    if (!error) this.rename(name, text);
    tell(one("#notice"), error?.message ?? "");
  }

  // Loads a change on the disk, if there are no unsaved changes.
  async lookAtDisk() {
    const { name, saved } = this;
    if (name === null || this.saving !== null) return;
    const { text } = await this.engine.load(name).catch(failed);
    // The file that was read is out of date if another one was saved or chosen in the meantime.
    if (text === undefined || this.saving !== null || name !== this.name || saved !== this.saved) return;
    if (text === saved) return this.settle();
    const keep = () => {
      this.rename(name, text);
      this.settle();
    };
    const load = () => {
      keep();
      this.editor.set(text);
    };
    if (!this.isChanged) return load();
    if (text === this.conflict) return;
    this.conflict = text;
    tell(one("#conflict"), "The file has changed on the disk.", { "Load it": load, "Keep this text": keep });
  }

  // Ends a conflict, and removes the notice of the save that it has stopped.
  settle() {
    if (this.conflict === null) return;
    this.conflict = null;
    tell(one("#conflict"), "");
    tell(one("#notice"), "");
  }

  async export(select) {
    const format = select.value;
    select.value = "";
    if (format === "picture") {
      const { svg } = this.picture;
      if (svg) download(`${this.stem}.svg`, new XMLSerializer().serializeToString(svg), "image/svg+xml");
      return;
    }
    const { file, error } = await this.engine.ask({ task: "export", text: this.editor.text, format }).catch(failed);
    const [end, type] = EXPORTS[format];
    if (error) tell(one("#notice"), error.message);
    else download(`${this.stem}.${end}`, file, type);
  }
}

// The answer of an engine that has failed.
const failed = (error) => ({ error });

// Shows a message with buttons, or hides its place if the message is empty.
function tell(place, message, actions = {}) {
  place.hidden = message === "";
  place.replaceChildren(`${message} `);
  for (const [name, action] of Object.entries(actions)) {
    place.append(button(name, action), " ");
  }
}

function download(name, text, type) {
  const address = URL.createObjectURL(new Blob([text], { type }));
  made("a", { href: address, download: name }).click();
  setTimeout(() => URL.revokeObjectURL(address), LOOK);
}
