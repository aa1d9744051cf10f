//! PDF.

use super::mark::{Mark, Page, Place, Style};
use flate2::Compression;
use flate2::write::ZlibEncoder;
use glam::DVec2;
use pdf_writer::types::{LineCapStyle, LineJoinStyle};
use pdf_writer::{Content, Filter, Finish, Name, Pdf, Rect, Ref, TextStr};
use std::io::Write;

/// Distance of the handles of a Bézier curve that runs along a quarter of the unit circle.
const HANDLE: f64 = 0.552_284_75;

pub(super) fn write(page: &Page, title: &str) -> Vec<u8> {
    let [catalog, pages, sheet, stream, info] = [1, 2, 3, 4, 5].map(Ref::new);
    let mut opacities: Vec<f64> = page.marks.iter().map(|m| m.style.opacity).collect();
    opacities.sort_unstable_by(f64::total_cmp);
    opacities.dedup();
    let mut pdf = Pdf::new();
    pdf.catalog(catalog).pages(pages);
    pdf.pages(pages).kids([sheet]).count(1);
    let mut entry = pdf.page(sheet);
    entry.parent(pages).contents(stream).media_box(Rect::new(0.0, 0.0, page.size.x as f32, page.size.y as f32));
    let mut resources = entry.resources();
    let mut states = resources.ext_g_states();
    for (i, opacity) in opacities.iter().enumerate() {
        states.insert(Name(&name(i))).start::<pdf_writer::writers::ExtGraphicsState>().non_stroking_alpha(*opacity as f32);
    }
    states.finish();
    resources.finish();
    entry.finish();
    pdf.document_info(info).title(TextStr(title));
    let content = content(page, &opacities);
    match compress(&content) {
        Ok(small) => drop(pdf.stream(stream, &small).filter(Filter::FlateDecode)),
        Err(_) => drop(pdf.stream(stream, &content)),
    }
    pdf.finish()
}

fn compress(content: &[u8]) -> std::io::Result<Vec<u8>> {
    let mut encoder = ZlibEncoder::new(Vec::new(), Compression::default());
    encoder.write_all(content)?;
    encoder.finish()
}

/// The name of a state of opacity.
fn name(index: usize) -> Vec<u8> {
    format!("O{index}").into_bytes()
}

fn content(page: &Page, opacities: &[f64]) -> Vec<u8> {
    let mut out = Content::new();
    // Marks count from the top, PDF from the bottom.
    out.transform([1.0, 0.0, 0.0, -1.0, 0.0, page.size.y as f32]);
    out.set_line_cap(LineCapStyle::RoundCap).set_line_join(LineJoinStyle::RoundJoin);
    if let Some(colour) = page.background {
        fill(&mut out, colour);
        out.rect(0.0, 0.0, page.size.x as f32, page.size.y as f32).fill_nonzero();
    }
    for group in page.marks.chunk_by(|a, b| a.style == b.style) {
        let style = group[0].style;
        if let Some(index) = opacities.iter().position(|&o| o == style.opacity) {
            out.set_parameters(Name(&name(index)));
        }
        if let Some(colour) = style.fill {
            fill(&mut out, colour);
        }
        if let Some((colour, width)) = style.stroke {
            let [r, g, b] = colour.map(|x| f32::from(x) / 255.0);
            out.set_stroke_rgb(r, g, b).set_line_width(round(width));
        }
        group.iter().for_each(|mark| place(mark, &mut out));
    }
    out.finish().to_vec()
}

fn fill(out: &mut Content, colour: [u8; 3]) {
    let [r, g, b] = colour.map(|x| f32::from(x) / 255.0);
    out.set_fill_rgb(r, g, b);
}

fn place(mark: &Mark, out: &mut Content) {
    match &mark.place {
        Place::Disk { centre, radius } => circle(*centre, *radius, out),
        Place::Polygon(points) => {
            let Some((first, rest)) = points.split_first() else { return };
            out.move_to(round(first.x), round(first.y));
            for p in rest {
                out.line_to(round(p.x), round(p.y));
            }
            out.close_path();
        }
        Place::Lines(lines) => {
            for [a, b] in lines {
                out.move_to(round(a.x), round(a.y)).line_to(round(b.x), round(b.y));
            }
        }
    }
    match mark.style {
        Style { fill: Some(_), stroke: Some(_), .. } => out.fill_nonzero_and_stroke(),
        Style { fill: Some(_), stroke: None, .. } => out.fill_nonzero(),
        _ => out.stroke(),
    };
}

fn circle(centre: DVec2, radius: f64, out: &mut Content) {
    let point = |x: f64, y: f64| (round(centre.x + radius * x), round(centre.y + radius * y));
    let start = point(1.0, 0.0);
    out.move_to(start.0, start.1);
    let mut at = DVec2::X;
    for _ in 0..4 {
        let next = at.perp();
        let [one, two] = [at + next * HANDLE, next + at * HANDLE].map(|p| point(p.x, p.y));
        let end = point(next.x, next.y);
        out.cubic_to(one.0, one.1, two.0, two.1, end.0, end.1);
        at = next;
    }
    out.close_path();
}

/// To a thousandth of a point, which nobody sees and which keeps the file small.
fn round(x: f64) -> f32 {
    ((x * 1000.0).round() / 1000.0) as f32
}
