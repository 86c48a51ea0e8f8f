// Two engines with one interface: a server that has served the page, and workers with the solver in this page.
//
// `ask(question, { signal, onNews })` resolves to the answer; a signal that aborts ends the work, and `ask` rejects
// with an `AbortError`.

// The engine of this page: workers if the page contains the solver, or else its server.
export function engineOfPage() {
  const solver = document.getElementById("solver");
  return solver ? new Workers(solver) : new Server(new URLSearchParams(location.search).get("token"));
}

class Server {
  constructor(token) {
    this.headers = { "Content-Type": "application/json", "X-Masonry-Token": token ?? "" };
    this.hasFiles = true;
  }

  async ask(question, { signal, onNews } = {}) {
    const reply = await this.request("/ask", { method: "POST", body: JSON.stringify(question), signal });
    const reader = reply.body.pipeThrough(new TextDecoderStream()).getReader();
    let rest = "";
    for (;;) {
      const { value, done } = await reader.read();
      if (done) break;
      rest += value;
      const lines = rest.split("\n");
      rest = lines.pop();
      for (const line of lines) {
        const said = JSON.parse(line);
        if (said.news === undefined) return said;
        onNews?.(said.news);
      }
    }
    throw new Error("the command has ended: start `masonry live` again");
  }

  // Loads a file of the page; the newest without a name.
  async load(name = null) {
    return this.post("/load", { name });
  }

  async save(file) {
    return this.post("/save", file);
  }

  async post(path, body) {
    return (await this.request(path, { method: "POST", body: JSON.stringify(body) })).json();
  }

  async request(path, options = {}) {
    let reply;
    try {
      reply = await fetch(path, { ...options, headers: this.headers });
    } catch (error) {
      if (error.name === "AbortError") throw error;
      throw new Error("the command has ended: start `masonry live` again");
    }
    if (!reply.ok) throw new Error(await reply.text());
    return reply;
  }
}

// Workers with the solver. A worker whose answer is no longer needed is ended, since its work cannot be stopped
// otherwise.
class Workers {
  constructor(solver) {
    this.idle = [];
    this.hasFiles = false;
    this.parts = compiled(solver);
  }

  async ask(question, { signal, onNews } = {}) {
    const worker = this.idle.pop() ?? (await this.start());
    return new Promise((resolve, reject) => {
      const end = (isUsable) => {
        signal?.removeEventListener("abort", stop);
        if (isUsable) this.idle.push(worker);
        else worker.terminate();
      };
      const stop = () => {
        end(false);
        reject(new DOMException("stopped", "AbortError"));
      };
      worker.onmessage = ({ data }) => {
        if (data.news !== undefined) return onNews?.(data.news);
        end(true);
        resolve(JSON.parse(data.answer));
      };
      worker.onerror = (event) => {
        end(false);
        reject(new Error(`the solver has failed: this is a fault of the program, please report it with the scene (${event.message})`));
      };
      if (signal?.aborted) return stop();
      signal?.addEventListener("abort", stop);
      worker.postMessage({ question: JSON.stringify(question) });
    });
  }

  async start() {
    const { script, module } = await this.parts;
    const worker = new Worker(script);
    worker.postMessage({ module });
    return worker;
  }

  async load() {
    return { name: null, text: null };
  }
}

// The page contains the solver as gzip in base64; it is compiled once for all workers.
async function compiled(solver) {
  const bytes = Uint8Array.from(atob(solver.textContent.trim()), (letter) => letter.charCodeAt(0));
  const plain = new Blob([bytes]).stream().pipeThrough(new DecompressionStream("gzip"));
  const module = await WebAssembly.compile(await new Response(plain).arrayBuffer());
  const source = document.getElementById("worker").textContent;
  return { module, script: URL.createObjectURL(new Blob([source], { type: "text/javascript" })) };
}
