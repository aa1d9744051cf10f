//! SVG.

use super::mark::{Mark, Page, Place, Style};
use glam::DVec2;
use std::fmt::Write;

pub(super) fn write(page: &Page, title: &str) -> String {
    let (width, height) = (number(page.size.x), number(page.size.y));
    let mut out = format!(
        "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"{width}pt\" height=\"{height}pt\" viewBox=\"0 0 {width} {height}\" \
         stroke-linecap=\"round\" stroke-linejoin=\"round\">\n<title>{}</title>\n",
        escape(title)
    );
    if let Some(colour) = page.background {
        out += &format!("<rect width=\"{width}\" height=\"{height}\" fill=\"{}\"/>\n", hex(colour));
    }
    // Marks of one style share a group, which says it once.
    for group in page.marks.chunk_by(|a, b| a.style == b.style) {
        out += &format!("<g{}>\n", style(&group[0].style));
        group.iter().for_each(|mark| place(mark, &mut out));
        out += "</g>\n";
    }
    out + "</svg>\n"
}

fn style(style: &Style) -> String {
    let mut out = format!(" fill=\"{}\"", style.fill.map_or_else(|| "none".into(), hex));
    if style.fill.is_some() && style.opacity < 1.0 {
        out += &format!(" fill-opacity=\"{}\"", number(style.opacity));
    }
    if let Some((colour, width)) = style.stroke {
        out += &format!(" stroke=\"{}\" stroke-width=\"{}\"", hex(colour), number(width));
    }
    out
}

fn place(mark: &Mark, out: &mut String) {
    let point = |p: &DVec2| format!("{} {}", number(p.x), number(p.y));
    // Writing to a string does not fail.
    let _ = match &mark.place {
        Place::Disk { centre, radius } => {
            let [x, y, r] = [centre.x, centre.y, *radius].map(number);
            writeln!(out, "<circle cx=\"{x}\" cy=\"{y}\" r=\"{r}\"/>")
        }
        Place::Polygon(points) => {
            let points: Vec<String> = points.iter().map(point).collect();
            writeln!(out, "<polygon points=\"{}\"/>", points.join(" "))
        }
        Place::Lines(lines) => {
            let lines: String = lines.iter().map(|[a, b]| format!("M{}L{}", point(a), point(b))).collect();
            writeln!(out, "<path d=\"{lines}\"/>")
        }
    };
}

/// A number to a hundredth of a point, without what says nothing.
fn number(x: f64) -> String {
    let text = format!("{x:.2}");
    let text = text.trim_end_matches('0').trim_end_matches('.');
    if text == "-0" { "0".into() } else { text.into() }
}

fn hex([r, g, b]: [u8; 3]) -> String {
    format!("#{r:02x}{g:02x}{b:02x}")
}

fn escape(text: &str) -> String {
    // Control characters have no place in XML, not even escaped.
    let text: String = text.chars().filter(|c| !c.is_control()).collect();
    text.replace('&', "&amp;").replace('<', "&lt;").replace('>', "&gt;")
}
