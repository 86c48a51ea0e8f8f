// A worker with the solver: first it gets the compiled module, then questions, one after the other. `wasm_bindgen` stands before
// this script.
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
    // Out of the promise, so that the page hears of it.
    setTimeout(() => { throw error; });
  }
};
