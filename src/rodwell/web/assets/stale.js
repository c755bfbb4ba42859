// What goes while other inputs are computed: every number, mark and label that belongs to the old ones.
import { showNumbers } from "./panel.js";

const $ = (id) => document.getElementById(id);

// Nothing may be read that belongs to other inputs: numbers go, pictures turn pale.
export function clear() {
  document.body.classList.add("updating");
  $("busy").textContent = "updating …";
  for (const id of ["buckles", "lifts-off", "snaps"]) $(id).textContent = "…";
  document.querySelectorAll("#string td").forEach((cell) => { cell.textContent = "…"; });
}

// Nor may a state that belongs to others than those displayed.
export function blank() {
  document.body.classList.add("blank");
  noNumbers();
  $("rod").querySelectorAll(".tag, .scale").forEach((each) => { each.style.visibility = "hidden"; });
}

// Nor what belongs to a state that is not shown.
export function noNumbers() {
  for (const id of ["now", "headline", "verdict"]) $(id).textContent = "…";
  showNumbers(null);
  document.querySelectorAll("#push text, #side text").forEach((text) => text.remove());
  for (const id of ["bar-first", "bar-last"]) $(id).textContent = "";
  $("cursor").textContent = "";
}
