// A worker with the solver: the first message has the compiled module, later ones have questions. The script that
// defines `wasm_bindgen` precedes this one.
let ready;
onmessage = async ({ data }) => {
  if (data.module) {
    ready = wasm_bindgen({ module_or_path: data.module }).then(() => new wasm_bindgen.LiveEngine());
    return;
  }
  try {
    const solver = await ready;
    postMessage({ answer: solver.answer(data.question, (news) => postMessage({ news })) });
  } catch (error) {
    // The error is thrown outside the promise, so that the page receives it.
    setTimeout(() => { throw error; });
  }
};
