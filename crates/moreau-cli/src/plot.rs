//! Figures as SVG.

use kuva::prelude::*;
use std::sync::Arc;

/// Colours that people with any colour vision tell apart (Okabe & Ito 2008).
const COLOURS: [&str; 7] = ["#0072B2", "#D55E00", "#009E73", "#CC79A7", "#E69F00", "#56B4E9", "#000000"];

/// One curve.
pub(crate) struct Curve {
    pub(crate) name: String,
    pub(crate) points: Vec<(f64, f64)>,
}

/// Draws curves over a logarithmic vertical axis.
///
/// The logarithm is taken here and the ticks are labelled as powers: the library's own logarithmic axis ends at 1e-10.
pub(crate) fn semilog(title: &str, x_label: &str, y_label: &str, curves: &[Curve]) -> String {
    let log = |curve: &Curve| -> Vec<(f64, f64)> {
        curve.points.iter().filter(|(_, y)| *y > 0.0).map(|&(x, y)| (x, y.log10())).collect()
    };
    let ticks = TickFormat::Custom(Arc::new(|exponent: f64| format!("1e{exponent:.0}")));
    draw(title, x_label, y_label, curves, log, Some(ticks))
}

/// Draws curves over linear axes.
pub(crate) fn linear(title: &str, x_label: &str, y_label: &str, curves: &[Curve]) -> String {
    draw(title, x_label, y_label, curves, |curve| curve.points.clone(), None)
}

fn draw(
    title: &str,
    x_label: &str,
    y_label: &str,
    curves: &[Curve],
    points: impl Fn(&Curve) -> Vec<(f64, f64)>,
    y_ticks: Option<TickFormat>,
) -> String {
    let plots: Vec<Plot> = curves
        .iter()
        .enumerate()
        .map(|(i, curve)| {
            // Curves may lie on each other: thick and whole below, thin and broken above.
            let line = LinePlot::new()
                .with_data(points(curve))
                .with_color(COLOURS[i % COLOURS.len()])
                .with_stroke_width([6.0, 3.5, 3.5, 2.0, 1.5][i.min(4)])
                .with_legend(curve.name.clone());
            match i % 5 {
                1 | 3 => line.with_dashed().into(),
                4 => line.with_dotted().into(),
                _ => line.into(),
            }
        })
        .collect();
    let mut layout = Layout::auto_from_plots(&plots).with_title(title).with_x_label(x_label).with_y_label(y_label);
    if let Some(ticks) = y_ticks {
        layout = layout.with_y_tick_format(ticks).with_y_tick_step(1.0);
    }
    render_to_svg(plots, layout)
}
