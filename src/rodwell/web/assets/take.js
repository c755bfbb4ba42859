// What can be taken along: scripts, commands, files of the state shown, the diagram, the page.
import { copy, pixels, save, saveBlob, snapshot, standalone } from "./panel.js";

export class Taking {
  constructor(page) {
    this.page = page; // shown(), state(), hello(), request(), values(), ask(kind, content), svg(), rod()
    this.copying = "python"; // which text is wanted
    this.saving = ""; // which file
    this.still = false; // whether a still picture stands in for the rod that cannot be turned
    const on = (name, act) => document.querySelectorAll(`[data-${name}]`).forEach((button) => {
      button.onclick = () => { if (page.shown()) act(button.dataset[name]); }; // without a state its numbers are those of other inputs, or gone
    });
    on("copy", (what) => { this.copying = what; page.ask("copy", page.request()); });
    on("save", (kind) => this.file(kind));
    on("diagram", (kind) => this.diagram(kind));
  }

  async file(kind) {
    const { page } = this;
    if (kind === "page") saveBlob("rodwell.html", await snapshot({ ...page.state(), values: page.values() }, page.hello(), page.rod()));
    else { this.saving = kind; page.ask("file", { ...page.request(), suffix: kind }); }
  }

  async diagram(kind) {
    const svg = this.page.svg(), drawing = standalone(svg);
    saveBlob(`diagram.${kind}`, kind === "svg" ? drawing : await pixels(drawing, svg));
  }

  picture() {
    this.still = true;
    this.page.ask("file", { ...this.page.request(), suffix: "png" });
  }

  haveCopy({ texts }) { copy(texts[this.copying], this.copying === "python" ? "script" : "command"); }

  haveFile({ suffix, type, content }) {
    if (this.still && suffix === "png" && this.saving !== "png") {
      const still = document.querySelector("#rod .still");
      still.src = `data:${type};base64,${content}`;
      still.hidden = false;
      return;
    }
    this.saving = "";
    save(suffix === "toml" ? "case.toml" : `state.${suffix}`, type, content);
  }
}
