//! Colours that say something, also to those who see fewer of them and on a grey printer.

/// The eight colours of Okabe and Ito but for yellow, which is too faint on white.
const CATEGORIES: [[u8; 3]; 7] =
    [[0, 114, 178], [213, 94, 0], [0, 158, 115], [204, 121, 167], [230, 159, 0], [86, 180, 233], [0, 0, 0]];

/// The colour of a category; they repeat after seven.
#[must_use]
pub fn category(index: usize) -> [u8; 3] {
    CATEGORIES[index % CATEGORIES.len()]
}

/// Dark blue over green to light yellow, for 0 to 1; what lies outside has the colour of the nearer end, NaN is grey.
///
/// The map is a helix in Oklab: lightness and hue change at constant rates at a constant distance from an axis. Equal differences in
/// value are therefore equal differences to the eye, and lightness alone tells the order.
#[must_use]
pub fn sequential(value: f64) -> [u8; 3] {
    if value.is_nan() {
        return [128; 3];
    }
    let t = value.clamp(0.0, 1.0);
    let angle = -1.6747 - 2.3368 * t;
    oklab(0.32 + 0.60 * t, 0.0653 + 0.1478 * angle.cos(), 0.0270 + 0.1478 * angle.sin())
}

/// Blue for -1 over near-white for 0 to red-orange for 1; outside the nearer end, NaN is grey.
///
/// Two straight lines in Oklab with the same lightness at both ends.
#[must_use]
pub fn diverging(value: f64) -> [u8; 3] {
    if value.is_nan() {
        return [128; 3];
    }
    let t = value.clamp(-1.0, 1.0);
    let (a, b) = if t < 0.0 { (-0.03, -0.125) } else { (0.125, 0.09) };
    oklab(0.95 - 0.42 * t.abs(), a * t.abs(), b * t.abs())
}

/// Part of the way from one colour to another, 0 to 1, in linear light.
#[must_use]
pub fn mix(from: [u8; 3], to: [u8; 3], part: f64) -> [u8; 3] {
    let part = part.clamp(0.0, 1.0) as f32;
    std::array::from_fn(|i| encode(linear(from[i]) * (1.0 - part) + linear(to[i]) * part))
}

/// A colour of Oklab (Ottosson 2020) in sRGB.
fn oklab(lightness: f64, a: f64, b: f64) -> [u8; 3] {
    let l = (lightness + 0.396_337_777_4 * a + 0.215_803_757_3 * b).powi(3);
    let m = (lightness - 0.105_561_345_8 * a - 0.063_854_172_8 * b).powi(3);
    let s = (lightness - 0.089_484_177_5 * a - 1.291_485_548_0 * b).powi(3);
    [
        4.076_741_662_1 * l - 3.307_711_591_3 * m + 0.230_969_929_2 * s,
        -1.268_438_004_6 * l + 2.609_757_401_1 * m - 0.341_319_396_5 * s,
        -0.004_196_086_3 * l - 0.703_418_614_7 * m + 1.707_614_701_0 * s,
    ]
    .map(|x| encode(x as f32))
}

/// Light of a value of sRGB, 0 to 1.
pub(super) fn linear(value: u8) -> f32 {
    let v = f32::from(value) / 255.0;
    if v <= 0.04045 { v / 12.92 } else { ((v + 0.055) / 1.055).powf(2.4) }
}

/// The value of sRGB nearest to some light; light outside 0 to 1 is cut.
pub(super) fn encode(light: f32) -> u8 {
    let x = light.clamp(0.0, 1.0);
    let v = if x <= 0.003_130_8 { 12.92 * x } else { 1.055 * x.powf(1.0 / 2.4) - 0.055 };
    (255.0 * v + 0.5) as u8
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_sequential_map_grows_lighter_evenly() {
        let light = |t: f64| {
            let [r, g, b] = sequential(t).map(linear);
            (0.2126 * r + 0.7152 * g + 0.0722 * b).cbrt()
        };
        let steps: Vec<f32> = (0..20).map(|i| light(f64::from(i + 1) / 20.0) - light(f64::from(i) / 20.0)).collect();
        assert!(steps.iter().all(|&s| s > 0.01 && s < 0.05), "{steps:?}");
        assert_eq!(sequential(-3.0), sequential(0.0));
        assert_eq!(sequential(f64::INFINITY), sequential(1.0));
    }

    #[test]
    fn light_and_values_are_inverse() {
        assert!((0..=255).all(|v| encode(linear(v)) == v));
        assert_eq!(category(7), category(0));
        assert_eq!(mix([0; 3], [255; 3], 1.0), [255; 3]);
    }
}
