//! Charts, in one style: colours that everybody tells apart, as SVG, PNG or PDF.

use crate::failure::Failure;
use clap::ValueEnum;
use kuva::backend::pdf::PdfBackend;
use kuva::backend::raster::RasterBackend;
use kuva::prelude::*;
use kuva::render::figure::Figure;
use kuva::render::render::Scene;
use std::path::Path;
use std::sync::Arc;

/// Colours that people with any colour vision tell apart (Okabe & Ito 2008).
const COLOURS: [&str; 7] = ["#0072B2", "#D55E00", "#009E73", "#CC79A7", "#E69F00", "#56B4E9", "#000000"];

/// One curve.
pub(crate) struct Curve {
    pub(crate) name: String,
    pub(crate) points: Vec<(f64, f64)>,
}

/// Curves in their axes.
pub(crate) struct Chart {
    plots: Vec<Plot>,
    layout: Layout,
}

/// What a figure is written as.
#[derive(Clone, Copy, clap::ValueEnum)]
pub(crate) enum Form {
    Svg,
    Png,
    Pdf,
}

impl Form {
    /// The one that the name of a file asks for.
    pub(crate) fn of(path: &Path) -> Result<Self, Failure> {
        let ending = path.extension().unwrap_or_default().to_string_lossy();
        Self::from_str(&ending, true)
            .map_err(|_| Failure::usage(format!("{}: the name must end in .svg, .png or .pdf", path.display())))
    }

    /// The ending of its files.
    pub(crate) fn ending(self) -> &'static str {
        match self {
            Self::Svg => "svg",
            Self::Png => "png",
            Self::Pdf => "pdf",
        }
    }

    fn write(self, scene: &Scene) -> Result<Vec<u8>, Failure> {
        match self {
            Self::Svg => Ok(SvgBackend.render_scene(scene).into_bytes()),
            Self::Png => RasterBackend::new().with_scale(2.0).render_scene(scene).map_err(Failure::file),
            Self::Pdf => PdfBackend::new().render_scene(scene).map_err(Failure::file),
        }
    }
}

impl Chart {
    /// The chart alone.
    pub(crate) fn draw(self, form: Form) -> Result<Vec<u8>, Failure> {
        form.write(&render_multiple(self.plots, self.layout))
    }
}

/// Charts one below the other under a title.
pub(crate) fn figure(title: &str, charts: Vec<Chart>, form: Form) -> Result<Vec<u8>, Failure> {
    let (plots, layouts): (Vec<_>, Vec<_>) = charts.into_iter().map(|chart| (chart.plots, chart.layout)).unzip();
    let figure = Figure::new(plots.len(), 1).with_title(title).with_plots(plots).with_layouts(layouts);
    form.write(&figure.with_cell_size(760.0, 300.0).render())
}

/// Draws curves over a logarithmic vertical axis.
///
/// The logarithm is taken here and the ticks are labelled as powers: the library's own logarithmic axis ends at 1e-10.
pub(crate) fn semilog(title: &str, x_label: &str, y_label: &str, curves: &[Curve]) -> Chart {
    let log = |curve: &Curve| -> Vec<(f64, f64)> {
        curve.points.iter().filter(|(_, y)| *y > 0.0).map(|&(x, y)| (x, y.log10())).collect()
    };
    let ticks = TickFormat::Custom(Arc::new(|exponent: f64| format!("1e{exponent:.0}")));
    draw(title, x_label, y_label, curves, log, |layout| layout.with_y_tick_format(ticks).with_y_tick_step(1.0))
}

/// Draws curves over linear axes.
pub(crate) fn linear(title: &str, x_label: &str, y_label: &str, curves: &[Curve]) -> Chart {
    draw(title, x_label, y_label, curves, |curve| curve.points.clone(), |layout| layout)
}

/// Draws performance profiles: parts from 0 to 1 over τ ≥ 1, whose logarithm to base 2 is taken here as in [`semilog`].
pub(crate) fn profile(title: &str, curves: &[Curve]) -> Chart {
    let log = |curve: &Curve| curve.points.iter().map(|&(tau, part)| (tau.log2(), part)).collect();
    let ticks = TickFormat::Custom(Arc::new(|exponent: f64| format!("{}", exponent.exp2())));
    let end = curves.iter().flat_map(|curve| &curve.points).map(|&(tau, _)| tau.log2()).fold(0.0, f64::max);
    // Ten ticks or so, at whole powers.
    let step = (end / 10.0).ceil().max(1.0);
    let axes = |layout: Layout| {
        let layout = layout.with_x_tick_format(ticks).with_x_tick_step(step).with_x_axis_min(0.0).with_x_axis_max(end.max(1.0));
        layout.with_y_axis_min(0.0).with_y_axis_max(1.02).with_y_tick_step(0.2)
    };
    draw(title, "τ", "part of the problems", curves, log, axes)
}

fn draw(
    title: &str,
    x_label: &str,
    y_label: &str,
    curves: &[Curve],
    points: impl Fn(&Curve) -> Vec<(f64, f64)>,
    axes: impl FnOnce(Layout) -> Layout,
) -> Chart {
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
    let layout = Layout::auto_from_plots(&plots).with_title(title).with_x_label(x_label).with_y_label(y_label);
    Chart { layout: axes(layout), plots }
}
