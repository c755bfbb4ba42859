// The keyboard, for everything.
const $ = (id) => document.getElementById(id);

export function keys(page) {
  const help = $("help");
  $("help-open").onclick = () => help.showModal();
  $("help-close").onclick = () => help.close();

  addEventListener("keydown", (event) => {
    if (event.ctrlKey || event.metaKey || event.altKey || help.open) return;
    if (event.key === "?") { event.preventDefault(); help.showModal(); return; }
    const target = event.target, writing = target.matches?.("input[type=number], select");
    if (writing || !page.diagram() || !page.state()) return;
    const inViewer = target.closest?.(".stage");
    if (event.key === "ArrowRight" || event.key === "ArrowLeft") {
      if (inViewer) return;
      event.preventDefault();
      page.step((event.key === "ArrowRight" ? 1 : -1) * (event.shiftKey ? 0.1 : 0.01));
    } else if (event.key === "PageDown" || event.key === "PageUp") {
      if (inViewer) return;
      event.preventDefault();
      special(event.key === "PageDown" ? 1 : -1);
    } else if (/^[0-9]$/.test(event.key)) {
      const number = Number(event.key), b = page.diagram().branches[number - 1];
      if (number === 0 && page.diagram().straight) page.go(page.chosen({ branch: "straight", load: null }), true);
      else if (b) page.go(page.chosen({ branch: b.name, load: null }), true);
    } else if (event.key === "b" || event.key === "B") {
      page.beyond();
    } else if (event.key === "p" || event.key === "P") {
      page.play();
    }
  });

  // The next special point of the branch shown, in the order of travel; of the straight rod: of the first branch.
  function special(way) {
    const { branch, load, special: at } = page.state();
    const name = branch || page.shown()?.branch || "";
    const b = page.diagram().branches.find((each) => each.name === name) || page.diagram().branches[0];
    let next;
    if (at !== null && b.name === name) next = at + way;
    else if (way > 0) next = b.special.findIndex((p) => p.load > load);
    else next = b.special.findLastIndex((p) => p.load < load);
    if (next >= 0 && next < b.special.length) page.go({ branch: b.name, which: 0, special: next, load: b.special[next].load }, true);
  }
}
