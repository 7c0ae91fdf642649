"use strict";
const by = (id) => document.getElementById(id);
const wipe = by("wipe"), slider = by("slider");
const sides = ["left", "right"];
const thumbs = document.querySelectorAll(".thumb");

function move() {
  wipe.style.setProperty("--edge", slider.value + "%");
  slider.setAttribute("aria-valuetext", Math.round(slider.value) + " % " + by("left-tag").textContent);
}

function show(side) {
  const chosen = by(side), source = by(chosen.value);
  by(side + "-picture").src = source.src;
  by(side + "-picture").alt = source.alt;
  const option = chosen.selectedOptions[0], group = option.parentElement.label;
  by(side + "-tag").textContent = chosen.value.startsWith("picture") ? option.textContent : group + ": " + option.textContent;
  for (const thumb of thumbs) thumb.setAttribute("aria-pressed", String(thumb.dataset.key === by("right").value));
  move();
}

slider.addEventListener("input", move);
for (const side of sides) by(side).addEventListener("change", () => show(side));
for (const thumb of thumbs) {
  thumb.addEventListener("click", () => { by("right").value = thumb.dataset.key; show("right"); });
}
by("left").value = "picture-0";
by("right").value = "picture-1";
sides.forEach(show);
