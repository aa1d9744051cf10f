//! `moreau render`.

use crate::failure::{Failure, say};
use crate::outputs::Replace;
use moreau_view::picture::movie::Movie;
use moreau_view::picture::{Camera, Error};
use moreau_view::recording::Recording;
use moreau_view::render::{Colour, Look, Shot, window};
use std::path::{Path, PathBuf};

/// Arguments of `moreau render`.
#[derive(clap::Args)]
pub(crate) struct Args {
    /// The folder that moreau run wrote
    run: PathBuf,
    /// The picture (.png; of a scene in the plane also .svg and .pdf) or movie (.gif, or .mp4 where ffmpeg is installed)
    /// [default: picture.png in that folder]
    #[arg(long)]
    out: Option<PathBuf>,
    #[command(flatten)]
    replace: Replace,
    /// The time of the picture, s; the frame that is nearest is taken [default: the last]
    #[arg(long)]
    time: Option<f64>,
    /// A picture in the movie every so many seconds [default: one for each frame]
    #[arg(long, value_name = "SECONDS", conflicts_with = "time")]
    every: Option<f64>,
    /// Pictures a second in the movie
    #[arg(long, default_value_t = 25.0)]
    rate: f64,
    /// Width and height in pixels; in the plane the height follows from the bodies
    #[arg(long, value_name = "WxH", default_value = "1280x960", value_parser = size)]
    size: [usize; 2],
    /// Draw the forces between bodies
    #[arg(long)]
    chains: bool,
    /// What the colours of bodies tell
    #[arg(long, value_enum, default_value_t = By::Material)]
    colour: By,
    /// The direction in which one looks, three numbers with commas
    #[arg(long, value_name = "X,Y,Z", value_delimiter = ',', allow_hyphen_values = true)]
    look: Vec<f64>,
}

#[derive(Clone, Copy, clap::ValueEnum)]
enum By {
    Material,
    Speed,
}

fn size(text: &str) -> Result<[usize; 2], String> {
    let sides = text.split_once('x').and_then(|(w, h)| Some([w.trim().parse().ok()?, h.trim().parse().ok()?]));
    sides.ok_or_else(|| format!("{text:?} is no size; 1280x960 is one"))
}

/// Draws and writes.
pub(crate) fn run(args: &Args) -> Result<(), Failure> {
    let recording = Recording::open(&args.run).map_err(Failure::file)?;
    let frames = recording.trajectory.frames();
    if frames == 0 {
        return Err(Failure::file(format!("{}: the trajectory has no frame yet", args.run.display())));
    }
    let direction = match args.look.as_slice() {
        [] => None,
        &[x, y, z] => Some([x, y, z]),
        other => return Err(Failure::usage(format!("--look has {} numbers; three are right", other.len()))),
    };
    let colour = if matches!(args.colour, By::Speed) { Colour::Speed } else { Colour::Material };
    let camera = Camera { direction, ..Camera::default() };
    let look = Look { size: args.size, chains: args.chains, colour, camera, window: None };
    let out = args.replace.in_run(&args.run, "picture.png", args.out.as_deref())?;
    let is_movie = out.extension().is_some_and(|ending| ["gif", "mp4"].iter().any(|movie| ending.eq_ignore_ascii_case(movie)));
    let count = if is_movie { movie(args, &recording, look, &out)? } else { picture(args, &recording, &look, &out)? };
    say(&format!("{}: {count}\n", out.display()))
}

/// The frame whose time is nearest.
fn nearest(times: &[f64], time: f64) -> usize {
    let off = |i: usize| (times[i] - time).abs();
    (1..times.len()).fold(0, |best, i| if off(i) < off(best) { i } else { best })
}

fn picture(args: &Args, recording: &Recording, look: &Look, out: &Path) -> Result<String, Failure> {
    let times = recording.trajectory.times();
    let frame = args.time.map_or(times.len() - 1, |time| nearest(times, time));
    let shot = Shot::of(recording, frame, look).map_err(Failure::file)?;
    shot.save(out).map_err(wrong)?;
    Ok(format!("the state at {:.6} s", times[frame]))
}

fn movie(args: &Args, recording: &Recording, mut look: Look, out: &Path) -> Result<String, Failure> {
    let times = recording.trajectory.times();
    let frames: Vec<usize> = match args.every {
        Some(every) if every > 0.0 => {
            let (first, last) = (times[0], times[times.len() - 1]);
            let count = ((last - first) / every).floor() as usize;
            (0..=count).map(|k| nearest(times, first + every * k as f64)).collect()
        }
        Some(every) => return Err(Failure::usage(format!("--every is {every}; more than 0 is right"))),
        None => (0..times.len()).collect(),
    };
    if recording.trajectory.header().dimension == 2 {
        look.window = window(recording, &frames).map_err(Failure::file)?;
    }
    let mut movie: Option<Movie> = None;
    for &frame in &frames {
        let shot = Shot::of(recording, frame, &look).map_err(Failure::file)?;
        if let (Shot::Space(picture), true) = (&shot, look.camera.width.is_none()) {
            // The camera stands still, and sees all of the first picture.
            look.camera = picture.fitted_camera().map_err(wrong)?;
        }
        let image = shot.image().map_err(wrong)?;
        let movie = match &mut movie {
            Some(movie) => movie,
            none => none.insert(Movie::open(out, image.size, args.rate).map_err(wrong)?),
        };
        movie.add(&image).map_err(wrong)?;
    }
    movie.map_or(Ok(()), Movie::finish).map_err(wrong)?;
    Ok(format!("{} pictures, {} a second", frames.len(), args.rate))
}

fn wrong(error: Error) -> Failure {
    match error {
        Error::Write { .. } | Error::NoFfmpeg(_) | Error::Ffmpeg { .. } => Failure::file(error),
        _ => Failure::usage(error),
    }
}
