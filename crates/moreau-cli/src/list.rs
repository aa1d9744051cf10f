//! `moreau list`, `moreau schema`: the tables.

use crate::failure::{Failure, say};
use crate::table::aligned;
use clap::ValueEnum;
use moreau::joints::JOINTS;
use moreau::scene::{BUILDERS, Scene};
use moreau::solve::global::GLOBAL_METHODS;
use moreau::solve::law::LAWS;
use moreau::solve::local::LOCAL_METHODS;
use moreau::solve::{CRITERIA, Row};
use moreau::{observe::OUTPUTS, shape};

/// What to list.
#[derive(Clone, Copy, ValueEnum)]
enum What {
    /// Contact laws
    Laws,
    /// Local solvers
    Local,
    /// Global solvers
    Global,
    /// Measures that end a solve
    Criteria,
    /// Shapes
    Shapes,
    /// Joints
    Joints,
    /// Builders
    Builders,
    /// Outputs
    Outputs,
}

/// Arguments of `moreau list`.
#[derive(clap::Args)]
pub(crate) struct Args {
    what: What,
}

/// Prints one table.
pub(crate) fn list(args: &Args) -> Result<(), Failure> {
    let row = |row: &Row| vec![row.name.to_owned(), row.about.to_owned()];
    let rows: Vec<Vec<String>> = match args.what {
        What::Laws => LAWS.iter().map(row).collect(),
        What::Local => LOCAL_METHODS.iter().map(|(_, it)| row(it)).collect(),
        What::Global => GLOBAL_METHODS.iter().map(|(_, it)| row(it)).collect(),
        What::Criteria => CRITERIA.iter().map(|(_, it)| row(it)).collect(),
        What::Shapes => {
            let named = |dimension: &str, it: &Row| vec![it.name.to_owned(), dimension.to_owned(), it.about.to_owned()];
            let plane = shape::plane::SHAPES.iter().map(|it| named("2D", it));
            plane.chain(shape::solid::SHAPES.iter().map(|it| named("3D", it))).collect()
        }
        What::Joints => JOINTS.iter().map(|(_, it)| row(it)).collect(),
        What::Builders => {
            let dimensions = |in_them: &[usize]| in_them.iter().map(|d| format!("{d}D")).collect::<Vec<_>>().join(" ");
            BUILDERS.iter().map(|(in_them, it)| vec![it.name.to_owned(), dimensions(in_them), it.about.to_owned()]).collect()
        }
        What::Outputs => OUTPUTS.iter().map(row).collect(),
    };
    say(&aligned(&rows))
}

/// Prints the schema.
pub(crate) fn schema() -> Result<(), Failure> {
    say(&format!("{:#}\n", Scene::schema()))
}
