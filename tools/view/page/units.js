// SPDX-License-Identifier: BSD-3-Clause
// Times, lengths and angles as texts. Times are whole nanoseconds of virtual time, exact in a number up to 2^53.

const SECOND = 1e9,
  MILLISECOND = 1e6,
  MICROSECOND = 1e3;

/** "34.422200000 s": an instant, in full. */
function instantText(time) {
  const whole = Math.floor(time / SECOND);
  return `${whole}.${String(Math.round(time - whole * SECOND)).padStart(9, "0")} s`;
}

/** "34.4222 s": an instant, without the zeros at its end. */
function shortInstantText(time) {
  return instantText(time).replace(/\.?0+ s$/, " s");
}

/** "1.25 ms": a span of time, in the unit that suits it. */
function spanText(span) {
  const size = Math.abs(span);
  if (size === 0) return "0 s";
  if (size < MICROSECOND) return `${Math.round(span)} ns`;
  if (size < MILLISECOND) return `${rounded(span / MICROSECOND)} µs`;
  if (size < SECOND) return `${rounded(span / MILLISECOND)} ms`;
  if (size < 120 * SECOND) return `${rounded(span / SECOND)} s`;
  return clockText(span);
}

/** "1:02:03": hours, minutes and seconds of a long span. */
function clockText(span) {
  const seconds = Math.round(span / SECOND),
    two = (value) => String(value).padStart(2, "0");
  const hours = Math.floor(seconds / 3600),
    minutes = Math.floor(seconds / 60) % 60;
  return hours > 0 ? `${hours}:${two(minutes)}:${two(seconds % 60)}` : `${minutes}:${two(seconds % 60)}`;
}

/** Four significant digits, without zeros at the end. */
const rounded = (value) => String(Number(value.toPrecision(4)));

const metres = (value) => `${value.toFixed(2)} m`;
const degrees = (angle) => `${((angle * 180) / Math.PI).toFixed(1)}°`;
const placeText = (x, y) => `(${x.toFixed(2)}, ${y.toFixed(2)}) m`;
const countText = (count) => String(count).replace(/\B(?=(\d{3})+$)/g, " ");

const UNITS = {ns: 1, us: MICROSECOND, µs: MICROSECOND, ms: MILLISECOND, s: SECOND, min: 60 * SECOND, h: 3600 * SECOND};

/** A time that was typed: "34.4", "12 ms", "1:02:03", "+0.5" (after `now`); null if it is none. */
function parseTime(text, now) {
  const match = /^\s*([+-]?)\s*(?:(?:(\d+):)?(\d+):)?(\d+(?:\.\d*)?|\.\d+)\s*([a-zµ]*)\s*$/.exec(text);
  if (!match || (match[5] && !(match[5] in UNITS))) return null;
  const [whole, fraction = ""] = match[4].split(".");
  // Digits of seconds are kept to the nanosecond, which the product of a fraction and 1e9 would not be.
  let time =
    match[5] && match[5] !== "s"
      ? Number(match[4]) * UNITS[match[5]]
      : Number(whole) * SECOND + Number((fraction + "000000000").slice(0, 9));
  time += (Number(match[2] ?? 0) * 3600 + Number(match[3] ?? 0) * 60) * SECOND;
  time = Math.round(time);
  return match[1] === "" ? time : now + (match[1] === "+" ? time : -time);
}

/** The angle's equal in (-pi, pi]. */
function wrapped(angle) {
  const turn = 2 * Math.PI;
  return angle - turn * Math.ceil((angle - Math.PI) / turn);
}
