import { one } from "./elements.js";
import { engineOfPage } from "./engine.js";
import { Completion } from "./completion.js";
import { Editor } from "./editor.js";
import { Picture } from "./picture.js";
import { Handles } from "./handles.js";
import { Sliders } from "./sliders.js";
import { Answers } from "./answers.js";
import { Work } from "./work.js";
import { Files } from "./files.js";

// The page: its parts, and the connections between them.

// The engine is also available to scripts in the console of the browser, by this name.
const engine = (globalThis.masonryLive = engineOfPage());

const editor = new Editor({
  onChange(event) {
    one("#undo").disabled = editor.past.length === 0;
    one("#redo").disabled = editor.future.length === 0;
    files.changed();
    work.changed();
    answers.changed(event);
  },
  onLine(line) {
    const place = picture.mark(line);
    editor.mark(place?.first ?? 0, place?.last ?? -1);
  },
  onNumber: (number) => work.choose(number),
});
const picture = new Picture((place) => {
  editor.mark(place.first, place.last);
  editor.show(place.first, 1);
}, () => answers.changed());
const handles = new Handles(one("#picture"), editor);
const work = new Work(engine, editor);
const sliders = new Sliders(editor, ({ most, ...control }) => work.ask({ ...control, range: [0, most] }));
const files = new Files(engine, editor, picture, () => work.clear());
const answers = new Answers({
  engine,
  editor,
  picture,
  handles,
  show({ numbers, controls, places, has_train, shown }, text) {
    editor.setRules(numbers);
    // If a mistake hides the contents of the text, the sliders stay where they are.
    if (shown || controls.length > 0) sliders.show(controls, text);
    work.offer(controls, has_train);
    work.nameNumbers(shown?.verdict);
    picture.places = places;
  },
});
new Completion(editor, engine);

one("#undo").addEventListener("click", (event) => editor.undo(event));
one("#redo").addEventListener("click", (event) => editor.redo(event));
one("#keep").addEventListener("click", (event) => answers.keep(event));
files.begin().catch((error) => answers.fail(error));
