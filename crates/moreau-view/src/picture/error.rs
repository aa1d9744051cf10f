use std::path::PathBuf;

/// Why there is no picture or movie.
#[derive(Debug, thiserror::Error)]
pub enum Error {
    /// A side is zero or longer than 16384 pixels.
    #[error("a picture of {} × {} pixels cannot be made: each side must be from 1 to 16384", .0[0], .0[1])]
    Size([usize; 2]),
    /// A body refers to a mesh that is not there.
    #[error("body {body} has mesh {mesh}, but there are {meshes} meshes")]
    NoMesh {
        /// Index of the body.
        body: usize,
        /// The mesh it refers to.
        mesh: usize,
        /// How many there are.
        meshes: usize,
    },
    /// A polygon refers to a vertex that is not there.
    #[error("polygon {polygon} of mesh {mesh} has vertex {vertex}, but there are {vertices} vertices")]
    NoVertex {
        /// Index of the mesh.
        mesh: usize,
        /// Index of the polygon.
        polygon: usize,
        /// The vertex it refers to.
        vertex: usize,
        /// How many there are.
        vertices: usize,
    },
    /// A direction is zero or not finite, or a width is not positive.
    #[error("the camera's {0} must be finite and not zero")]
    Camera(&'static str),
    /// A file could not be written.
    #[error("cannot write {}: {source}", path.display())]
    Write {
        /// The file.
        path: PathBuf,
        /// What the system says.
        source: std::io::Error,
    },
    /// The name of a file says no format that can be written.
    #[error("{}: the name must end in {known}", path.display())]
    Format {
        /// The file.
        path: PathBuf,
        /// The endings that say a format.
        known: &'static str,
    },
    /// A movie can't run at this many images a second.
    #[error("a movie of {0} images a second cannot be made: from 1 to {1} are possible")]
    Rate(f64, f64),
    /// An image differs in size from the movie.
    #[error("an image of {} × {} pixels in a movie of {} × {}", .image[0], .image[1], .movie[0], .movie[1])]
    Frame {
        /// Size of the image.
        image: [usize; 2],
        /// Size of the movie.
        movie: [usize; 2],
    },
    /// A movie without images.
    #[error("{}: a movie needs at least one image", .0.display())]
    Empty(PathBuf),
    /// The program that makes MP4 files was not found.
    #[error("{}: MP4 files are made by the program ffmpeg, which is not on the PATH: install it, or name the movie .gif, which needs no other program", .0.display())]
    NoFfmpeg(PathBuf),
    /// The program that makes MP4 files gave up.
    #[error("{}: ffmpeg failed: {message}", path.display())]
    Ffmpeg {
        /// The file.
        path: PathBuf,
        /// Its last words.
        message: String,
    },
}
