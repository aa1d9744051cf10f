//! A drawing as marks on a page.

use super::{Drawing, Figure, Outline, Window};
use crate::picture::{Error, colour};
use glam::DVec2;

/// Room about the figures, as a part of the longer side.
const MARGIN: f64 = 0.04;
/// Distance and length of hatches, in points.
const HATCH: f64 = 5.0;

/// Where ink goes, in points from the upper left corner.
#[derive(Debug, Clone)]
pub(super) enum Place {
    Disk { centre: DVec2, radius: f64 },
    Polygon(Vec<DVec2>),
    Lines(Vec<[DVec2; 2]>),
}

/// Colours and line of a mark.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Style {
    pub fill: Option<[u8; 3]>,
    /// Colour and width in points.
    pub stroke: Option<([u8; 3], f64)>,
    /// Of the filled area.
    pub opacity: f64,
}

#[derive(Debug, Clone)]
pub(super) struct Mark {
    pub place: Place,
    pub style: Style,
}

/// Marks in the order in which they cover each other.
#[derive(Debug, Clone)]
pub(super) struct Page {
    /// Width and height in points.
    pub size: DVec2,
    pub background: Option<[u8; 3]>,
    pub marks: Vec<Mark>,
}

impl Page {
    pub(super) fn new(drawing: &Drawing) -> Result<Self, Error> {
        let Window { min, max } = drawing.window.unwrap_or_else(|| fit(&drawing.figures));
        let (min, max) = (DVec2::from(min), DVec2::from(max));
        let scale = drawing.width / (max - min).x;
        let size = (max - min) * scale;
        if !(size.is_finite() && size.min_element() > 0.0 && scale > 0.0) {
            return Err(Error::Camera("window and width"));
        }
        let on_page = OnPage { corner: DVec2::new(min.x, max.y), scale, size };
        let mut marks = Vec::new();
        let there = |f: &&Figure| f.position.iter().all(|x| x.is_finite()) && f.angle.is_finite();
        let ground = |f: &&Figure| matches!(f.outline, Outline::HalfPlane { .. });
        let grounds: Vec<_> = drawing.figures.iter().filter(there).filter_map(|f| on_page.line(f)).collect();
        for ground in &grounds {
            marks.extend(on_page.ground(ground, &grounds));
        }
        for figure in drawing.figures.iter().filter(there).filter(|f| !ground(f)) {
            on_page.body(figure, drawing.spokes, &mut marks);
        }
        for link in &drawing.links {
            let line = [link.from, link.to].map(|p| on_page.point(p.into()));
            let style = Style { fill: None, stroke: Some((link.colour, link.width * scale)), opacity: 1.0 };
            if line.iter().all(|p| p.is_finite()) && link.width > 0.0 {
                marks.push(Mark { place: Place::Lines(vec![line]), style });
            }
        }
        Ok(Self { size, background: drawing.background, marks })
    }
}

/// From the plane to the page.
struct OnPage {
    /// The upper left corner of the window.
    corner: DVec2,
    scale: f64,
    size: DVec2,
}

impl OnPage {
    fn point(&self, p: DVec2) -> DVec2 {
        let q = (p - self.corner) * self.scale;
        DVec2::new(q.x, -q.y)
    }

    fn body(&self, figure: &Figure, spokes: bool, marks: &mut Vec<Mark>) {
        let (position, turn) = (DVec2::from(figure.position), DVec2::from_angle(figure.angle));
        let dark = colour::mix(figure.colour, [30, 34, 40], 0.75);
        // Lines of small bodies are thin, or they would be all that one sees.
        let line = |size: f64| 0.05 * (size * self.scale).clamp(2.0, 14.0);
        let style = |size: f64| Style {
            fill: Some(figure.colour),
            stroke: Some((dark, line(size))),
            opacity: figure.opacity.clamp(0.0, 1.0),
        };
        match &figure.outline {
            Outline::Disk { radius } => {
                let (centre, style) = (self.point(position), style(*radius));
                marks.push(Mark { place: Place::Disk { centre, radius: radius * self.scale }, style });
                if spokes {
                    let rim = self.point(position + turn * *radius);
                    let style = Style { fill: None, ..style };
                    marks.push(Mark { place: Place::Lines(vec![[centre, rim]]), style });
                }
            }
            Outline::Polygons(polygons) => {
                for polygon in polygons {
                    let size = polygon.iter().map(|&p| DVec2::from(p).length()).fold(0.0, f64::max);
                    let points = polygon.iter().map(|&p| self.point(position + turn.rotate(p.into()))).collect();
                    marks.push(Mark { place: Place::Polygon(points), style: style(size) });
                }
            }
            Outline::HalfPlane { .. } => {}
        }
    }

    /// The border of a half-plane.
    fn line(&self, figure: &Figure) -> Option<Border> {
        let Outline::HalfPlane { normal } = figure.outline else { return None };
        let normal = DVec2::from_angle(figure.angle).rotate(normal.into()).try_normalize()?;
        Some(Border { foot: self.point(figure.position.into()), normal: DVec2::new(normal.x, -normal.y), colour: figure.colour })
    }

    /// The border within the page and outside all half-planes, and its hatches; none where it is out of sight.
    fn ground(&self, border: &Border, grounds: &[Border]) -> Vec<Mark> {
        let (p, n, along) = (border.foot, border.normal, border.normal.perp());
        let page = [
            Border { foot: DVec2::ZERO, normal: DVec2::X, ..*border },
            Border { foot: DVec2::ZERO, normal: DVec2::Y, ..*border },
            Border { foot: self.size, normal: -DVec2::X, ..*border },
            Border { foot: self.size, normal: -DVec2::Y, ..*border },
        ];
        let all = (f64::NEG_INFINITY, f64::INFINITY);
        let cut = page.iter().chain(grounds).try_fold(all, |part, other| other.cut(part, p, along));
        let Some((from, to)) = cut else { return Vec::new() };
        let first = (from / HATCH).ceil() as i64;
        let last = (to / HATCH).floor() as i64;
        let hatch = |i: i64| {
            let start = p + along * (i as f64 * HATCH);
            [start, start + (along - n) * HATCH]
        };
        let lines = |width: f64, lines: Vec<[DVec2; 2]>| Mark {
            place: Place::Lines(lines),
            style: Style { fill: None, stroke: Some((border.colour, width)), opacity: 1.0 },
        };
        vec![lines(0.4, (first..=last).map(hatch).collect()), lines(1.0, vec![[p + along * from, p + along * to]])]
    }
}

/// The border of a half-plane on the page.
struct Border {
    foot: DVec2,
    /// Out of the half-plane.
    normal: DVec2,
    colour: [u8; 3],
}

impl Border {
    /// What of a part of the line through `p` is outside this half-plane, or on its border.
    fn cut(&self, (from, to): (f64, f64), p: DVec2, along: DVec2) -> Option<(f64, f64)> {
        let (height, rise) = (self.normal.dot(p - self.foot), self.normal.dot(along));
        let (from, to) = if rise.abs() < 1e-9 {
            (from, if height < -1e-9 { from } else { to })
        } else if rise > 0.0 {
            (from.max(-height / rise), to)
        } else {
            (from, to.min(-height / rise))
        };
        (from < to).then_some((from, to))
    }
}

/// The window about all bounded figures.
fn fit(figures: &[Figure]) -> Window {
    let (mut min, mut max) = (DVec2::INFINITY, DVec2::NEG_INFINITY);
    let mut hold = |p: DVec2, radius: f64| {
        if p.is_finite() {
            (min, max) = (min.min(p - radius), max.max(p + radius));
        }
    };
    for figure in figures {
        let (position, turn) = (DVec2::from(figure.position), DVec2::from_angle(figure.angle));
        match &figure.outline {
            Outline::Disk { radius } => hold(position, *radius),
            Outline::Polygons(polygons) => {
                polygons.iter().flatten().for_each(|&p| hold(position + turn.rotate(p.into()), 0.0));
            }
            Outline::HalfPlane { .. } => {}
        }
    }
    if !(min.is_finite() && max.is_finite()) {
        (min, max) = (DVec2::splat(-0.5), DVec2::splat(0.5));
    }
    let room = MARGIN * (max - min).max_element().max(f64::MIN_POSITIVE);
    Window { min: (min - room).into(), max: (max + room).into() }
}
