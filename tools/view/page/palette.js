// SPDX-License-Identifier: BSD-3-Clause
// Colours of the canvases: the palette of Okabe and Ito, which people with any of the usual kinds of colour vision can
// tell apart, in a light and a dark set. States of tasks differ in pattern, too.

const LIGHT = {
  floor: "#ffffff",
  outside: "#eef0f3",
  grid: "#e4e7eb",
  text: "#1c2430",
  dim: "#5a6472",
  wall: "#4a5361",
  furniture: "#d5dae1",
  furnitureLine: "#8f99a8",
  unknown: "#fff0da",
  unknownLine: "#b86e00",
  robots: ["#0072b2", "#d55e00", "#008a64", "#a8548a", "#b87a00", "#2f8fc4", "#6b6b6b", "#7a5fb5"],
  estimate: "#d55e00",
  odometry: "#b0558e",
  laser: "#0f7fb8",
  sonar: "#b87a00",
  route: "#c77700",
  goal: "#008a64",
  segment: "#008a64",
  select: "#d0006f",
  running: "#0072b2",
  ready: "#56b4e9",
  blocked: "#e69f00",
  idle: "#aab2bd",
  late: "#d55e00",
  readyGround: "#e3f3fc",
  blockedGround: "#fdf2dc",
  lateGround: "#fbe4d6",
  arrow: "#45505e",
  band: "#f4f6f8",
  instant: "#fbf1f6"
};
const DARK = {
  floor: "#1b2028",
  outside: "#12151a",
  grid: "#262c36",
  text: "#e6eaf0",
  dim: "#9aa5b4",
  wall: "#a3aebd",
  furniture: "#333c49",
  furnitureLine: "#66717f",
  unknown: "#40301a",
  unknownLine: "#f0a836",
  robots: ["#56b4e9", "#f0864a", "#2dbf94", "#dc94bf", "#e8b43c", "#8fc9ee", "#b8bec6", "#a996e0"],
  estimate: "#f0864a",
  odometry: "#dc94bf",
  laser: "#56b4e9",
  sonar: "#e8c34a",
  route: "#f0b040",
  goal: "#2dbf94",
  segment: "#2dbf94",
  select: "#ff5fae",
  running: "#3f9fe0",
  ready: "#8fd0f5",
  blocked: "#d9982a",
  idle: "#566070",
  late: "#f0713a",
  readyGround: "#2a3f4c",
  blockedGround: "#3a3223",
  lateGround: "#46291d",
  arrow: "#aeb8c5",
  band: "#20262f",
  instant: "#2b2129"
};

/** The colours now in force; `chosen` is "light", "dark" or, as the system has it, "auto". */
const theme = {
  chosen: "auto",
  system: matchMedia("(prefers-color-scheme: dark)"),
  colours: LIGHT,
  patterns: new Map(),
  get dark() {
    return this.chosen === "dark" || (this.chosen === "auto" && this.system.matches);
  },
  choose(chosen) {
    this.chosen = chosen;
    this.colours = this.dark ? DARK : LIGHT;
    this.patterns.clear();
    document.documentElement.dataset.theme = this.dark ? "dark" : "light";
  }
};

/** A fill of lines over a tint: kind is "rising", "falling", "crossed", "upright" or "dotted". */
function hatch(context, kind, colour, ground = null) {
  const key = `${kind} ${colour} ${ground}`;
  if (!theme.patterns.has(key))
    theme.patterns.set(key, context.createPattern(hatchTile(kind, colour, ground), "repeat"));
  return theme.patterns.get(key);
}

function hatchTile(kind, colour, ground) {
  const tile = document.createElement("canvas"),
    size = 6;
  tile.width = tile.height = size;
  const pen = tile.getContext("2d");
  if (ground) {
    pen.fillStyle = ground;
    pen.fillRect(0, 0, size, size);
  }
  pen.strokeStyle = pen.fillStyle = colour;
  pen.lineWidth = 1.5;
  pen.beginPath();
  // Each line is drawn beyond the tile and in its neighbours, so that the tiles join.
  for (const shift of [-size, 0, size]) {
    if (kind === "rising" || kind === "crossed") (pen.moveTo(shift - 1, size + 1), pen.lineTo(shift + size + 1, -1));
    if (kind === "falling" || kind === "crossed") (pen.moveTo(shift - 1, -1), pen.lineTo(shift + size + 1, size + 1));
  }
  if (kind === "upright") (pen.moveTo(1, 0), pen.lineTo(1, size));
  pen.stroke();
  if (kind === "dotted") (pen.fillRect(1, 1, 1.5, 1.5), pen.fillRect(4, 4, 1.5, 1.5));
  return tile;
}
