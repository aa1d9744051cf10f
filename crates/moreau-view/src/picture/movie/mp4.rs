//! MP4, by the program ffmpeg.

use crate::picture::{Error, file};
use std::io::{ErrorKind, Read, Seek, Write};
use std::path::{Path, PathBuf};
use std::process::{Child, ChildStdin, Command, Stdio};
use tempfile::TempPath;

pub(super) const MAX_RATE: f64 = 240.0;
pub(super) const PROGRAM: &str = "ffmpeg";

#[derive(Debug)]
pub(super) struct Mp4 {
    path: PathBuf,
    /// The file that ffmpeg writes.
    made: Option<TempPath>,
    child: Child,
    /// Closed when all images are there.
    images: Option<ChildStdin>,
    /// What ffmpeg complains about. A file, so that it never waits for us to read it.
    complaints: std::fs::File,
}

impl Mp4 {
    pub(super) fn open(program: &str, path: &Path, size: [usize; 2], rate: f64) -> Result<Self, Error> {
        let failed = |source| file::failed(path, source);
        let made = file::beside(path)?.into_temp_path();
        let complaints = tempfile::tempfile().map_err(failed)?;
        let mut child = Command::new(program)
            .args(["-loglevel", "error", "-y", "-f", "rawvideo", "-pix_fmt", "rgb24"])
            .args(["-s", &format!("{}x{}", size[0], size[1]), "-r", &rate.to_string(), "-i", "-"])
            // The format wants even sides. Colours as players expect them.
            .args(["-vf", "pad=ceil(iw/2)*2:ceil(ih/2)*2:color=white,scale=out_color_matrix=bt709:out_range=tv,format=yuv420p"])
            .args(["-colorspace", "bt709", "-color_primaries", "bt709", "-color_trc", "bt709"])
            .args(["-c:v", "libx264", "-crf", "17", "-movflags", "+faststart", "-f", "mp4"])
            .arg(&made)
            .stdin(Stdio::piped())
            .stdout(Stdio::null())
            .stderr(complaints.try_clone().map_err(failed)?)
            .spawn()
            .map_err(|e| if e.kind() == ErrorKind::NotFound { Error::NoFfmpeg(path.to_owned()) } else { failed(e) })?;
        let images = child.stdin.take();
        Ok(Self { path: path.to_owned(), made: Some(made), child, images, complaints })
    }

    pub(super) fn add(&mut self, colours: &[[u8; 3]]) -> Result<(), Error> {
        let written = self.images.as_mut().map_or(Ok(()), |images| images.write_all(colours.as_flattened()));
        match written {
            Ok(()) => Ok(()),
            // It takes no more, and knows better than we why.
            Err(_) => Err(self.complaint()),
        }
    }

    pub(super) fn finish(mut self) -> Result<(), Error> {
        drop(self.images.take());
        let status = self.child.wait().map_err(|e| file::failed(&self.path, e))?;
        match self.made.take() {
            Some(made) if status.success() => made.persist(&self.path).map_err(|e| file::failed(&self.path, e.error)),
            _ => Err(self.complaint()),
        }
    }

    /// What ffmpeg said at last.
    fn complaint(&mut self) -> Error {
        drop(self.images.take());
        let mut text = String::new();
        let read =
            self.child.wait().and_then(|_| self.complaints.rewind()).and_then(|()| self.complaints.read_to_string(&mut text));
        let message = match read {
            Ok(_) if !text.trim().is_empty() => text.trim().to_owned(),
            Ok(_) => "without a word".to_owned(),
            Err(e) => e.to_string(),
        };
        Error::Ffmpeg { path: self.path.clone(), message }
    }
}

impl Drop for Mp4 {
    fn drop(&mut self) {
        // Of a movie that is not finished nothing must be left, neither the program nor its file.
        drop(self.images.take());
        let _ = self.child.kill();
        let _ = self.child.wait();
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn without_ffmpeg_the_error_says_what_to_do_and_nothing_is_left() {
        let folder = tempfile::tempdir().unwrap();
        let error = Mp4::open("no-such-program-here", &folder.path().join("a.mp4"), [16, 16], 25.0).unwrap_err();
        assert!(matches!(error, Error::NoFfmpeg(_)));
        assert!(error.to_string().contains(".gif"), "{error}");
        assert_eq!(std::fs::read_dir(folder.path()).unwrap().count(), 0);
    }

    #[cfg(unix)]
    #[test]
    fn a_program_that_gives_up_is_an_error_and_leaves_nothing() {
        let folder = tempfile::tempdir().unwrap();
        let mut movie = Mp4::open("false", &folder.path().join("a.mp4"), [16, 16], 25.0).unwrap();
        // It may take an image before it is gone.
        let added = movie.add(&[[0; 3]; 256]);
        let error = added.and_then(|()| movie.finish()).unwrap_err();
        assert!(matches!(error, Error::Ffmpeg { .. }), "{error}");
        assert_eq!(std::fs::read_dir(folder.path()).unwrap().count(), 0);
    }
}
