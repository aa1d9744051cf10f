// Colours that people who see fewer of them can still tell apart.

/** Okabe and Ito's colours, for things that have names. */
const NAMED = ["#0072b2", "#e69f00", "#009e73", "#cc79a7", "#56b4e9", "#d55e00", "#f0e442", "#7f7f7f"];

/** Statuses of contacts in the order of their codes. */
const STATUS = ["open", "sticking", "sliding"];
const STATUS_COLOURS = ["#8a8f98", "#3f9be0", "#f0781e"];

const bytes = (hex) => [1, 3, 5].map((i) => parseInt(hex.slice(i, i + 2), 16));
const fractions = (hex) => bytes(hex).map((x) => x / 255);

/** sRGB bytes of a colour of OKLab's lightness, chroma and hue in degrees. */
function fromLightness(lightness, chroma, hue) {
    const a = chroma * Math.cos((hue * Math.PI) / 180), b = chroma * Math.sin((hue * Math.PI) / 180);
    const l = (lightness + 0.3963377774 * a + 0.2158037573 * b) ** 3;
    const m = (lightness - 0.1055613458 * a - 0.0638541728 * b) ** 3;
    const s = (lightness - 0.0894841775 * a - 1.291485548 * b) ** 3;
    const linear = [
        4.0767416621 * l - 3.3077115913 * m + 0.2309699292 * s,
        -1.2684380046 * l + 2.6097574011 * m - 0.3413193965 * s,
        -0.0041960863 * l - 0.7034186147 * m + 1.707614701 * s,
    ];
    return linear.map((x) => {
        const y = clamp(x, 0, 1);
        return Math.round(255 * (y <= 0.0031308 ? 12.92 * y : 1.055 * y ** (1 / 2.4) - 0.055));
    });
}

/** Lightness, chroma and hue at even places: lightness rises evenly, so that order is seen without hue, and chroma stays what screens have. */
const STOPS = [[0.3, 0.13, 305], [0.405, 0.12, 278], [0.51, 0.095, 238], [0.615, 0.095, 192], [0.72, 0.135, 158], [0.82, 0.165, 128], [0.92, 0.175, 105]];

/** 256 colours from dark violet to light yellow. */
function rampBytes() {
    const ramp = new Uint8Array(4 * 256);
    for (let i = 0; i < 256; i++) {
        const x = (i / 255) * (STOPS.length - 1), k = Math.min(Math.floor(x), STOPS.length - 2);
        ramp.set([...fromLightness(...STOPS[k].map((y, j) => y + (x - k) * (STOPS[k + 1][j] - y))), 255], 4 * i);
    }
    return ramp;
}

/** The colours of names, repeated: a name's index is its place. */
function namedBytes() {
    const ramp = new Uint8Array(4 * 256);
    for (let i = 0; i < 256; i++) ramp.set([...bytes(NAMED[i % NAMED.length]), 255], 4 * i);
    return ramp;
}

/** What the drawing needs of the theme, as fractions. */
function themeColours() {
    const style = getComputedStyle(document.documentElement);
    const colour = (name) => fractions(style.getPropertyValue(name).trim());
    return { ground: colour("--picture"), line: colour("--outline"), still: colour("--still"), faint: colour("--faint"), mark: colour("--mark") };
}
