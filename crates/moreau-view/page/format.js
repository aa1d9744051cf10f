// Numbers and elements as text.

/** A number with `digits` figures, with a power of ten where it is very small or great. */
function figures(x, digits = 3) {
    if (x === null || x === undefined || !Number.isFinite(x)) return "–";
    if (x === 0) return "0";
    const size = Math.abs(x);
    if (size >= 1e-3 && size < 1e6) return String(Number(x.toPrecision(Math.max(digits, Math.ceil(Math.log10(size) + 1e-9)))));
    const [mantissa, exponent] = x.toExponential(digits - 1).split("e");
    return `${Number(mantissa) === 1 ? "" : `${Number(mantissa)}·`}10${superscript(Number(exponent))}`;
}

const superscript = (exponent) => [...String(exponent)].map((c) => "⁻⁰¹²³⁴⁵⁶⁷⁸⁹"["-0123456789".indexOf(c)]).join("");

const PREFIXES = [[1, ""], [1e-3, "m"], [1e-6, "µ"], [1e-9, "n"]];

/** A length, mass or time in the prefix that suits it: 12.3 µm. */
function quantity(x, unit) {
    if (x === null || x === undefined || !Number.isFinite(x)) return "–";
    if (x === 0) return `0 ${unit}`;
    const [size, prefix] = PREFIXES.find(([least]) => Math.abs(x) >= 0.9995 * least) ?? PREFIXES.at(-1);
    return `${figures(x / size)} ${prefix}${unit}`;
}

/** A list of numbers in one array from `start` on. */
const tuple = (array, start, count) => Array.from({ length: count }, (_, k) => figures(array[start + k])).join(", ");

/** A new element with attributes and children. */
function element(name, attributes = {}, ...children) {
    const made = document.createElement(name);
    for (const [key, value] of Object.entries(attributes)) {
        if (key.startsWith("on")) made.addEventListener(key.slice(2), value);
        else if (value !== null && value !== false) made.setAttribute(key, value);
    }
    made.append(...children);
    return made;
}

const byId = (id) => document.getElementById(id);

/** Sets an element's text only if it is new, which spares the layout. */
function write(target, text) {
    if (target.textContent !== text) target.textContent = text;
}

const plural = (count, word) => `${count.toLocaleString("en").replaceAll(",", " ")} ${word}${count === 1 ? "" : "s"}`;
