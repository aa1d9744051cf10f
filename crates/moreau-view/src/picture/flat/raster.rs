//! Pixels.

use super::mark::{Mark, Page, Place};
use crate::picture::image::check_size;
use crate::picture::{Error, Image};
use tiny_skia::{Color, FillRule, LineCap, LineJoin, Paint, Path, PathBuilder, Pixmap, Stroke, Transform};

pub(super) fn draw(page: &Page, across: usize) -> Result<Image, Error> {
    let scale = across as f64 / page.size.x;
    let size = [across, (page.size.y * scale).round() as usize];
    check_size(size)?;
    let mut map = Pixmap::new(size[0] as u32, size[1] as u32).ok_or(Error::Size(size))?;
    if let Some([r, g, b]) = page.background {
        map.fill(Color::from_rgba8(r, g, b, 255));
    }
    let transform = Transform::from_scale(scale as f32, scale as f32);
    for mark in &page.marks {
        let Some(path) = path(mark) else { continue };
        if let Some(colour) = mark.style.fill {
            map.fill_path(&path, &paint(colour, mark.style.opacity), FillRule::Winding, transform, None);
        }
        if let Some((colour, width)) = mark.style.stroke {
            let line = Stroke { width: width as f32, line_cap: LineCap::Round, line_join: LineJoin::Round, ..Stroke::default() };
            map.stroke_path(&path, &paint(colour, 1.0), &line, transform, None);
        }
    }
    let pixel = |p: &tiny_skia::PremultipliedColorU8| {
        let c = p.demultiply();
        [c.red(), c.green(), c.blue(), c.alpha()]
    };
    Ok(Image { size, pixels: map.pixels().iter().map(pixel).collect() })
}

fn paint([r, g, b]: [u8; 3], opacity: f64) -> Paint<'static> {
    let mut paint = Paint { anti_alias: true, ..Paint::default() };
    paint.set_color_rgba8(r, g, b, (255.0 * opacity).round() as u8);
    paint
}

fn path(mark: &Mark) -> Option<Path> {
    let mut path = PathBuilder::new();
    match &mark.place {
        Place::Disk { centre, radius } => path.push_circle(centre.x as f32, centre.y as f32, *radius as f32),
        Place::Polygon(points) => {
            let (first, rest) = points.split_first()?;
            path.move_to(first.x as f32, first.y as f32);
            rest.iter().for_each(|p| path.line_to(p.x as f32, p.y as f32));
            path.close();
        }
        Place::Lines(lines) => {
            for [a, b] in lines {
                path.move_to(a.x as f32, a.y as f32);
                path.line_to(b.x as f32, b.y as f32);
            }
        }
    }
    path.finish()
}
