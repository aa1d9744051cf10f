//! Tables of points: polygons and polylines as CSV.

/// The points of one polygon or polyline, and the line of the file that each is in.
#[derive(Clone, Debug, Default, PartialEq)]
pub(super) struct Outline {
    /// Of the column `id`, if the file has one.
    pub(super) id: Option<String>,
    /// In m.
    pub(super) points: Vec<[f64; 2]>,
    /// From 1.
    pub(super) lines: Vec<usize>,
}

/// What is wrong with a table, in which line, and what would be right.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Wrong {
    pub(super) line: usize,
    pub(super) message: String,
    pub(super) hint: &'static str,
}

/// Which column holds what.
#[derive(Clone, Copy)]
struct Columns {
    count: usize,
    id: Option<usize>,
    x: usize,
    y: usize,
}

/// What a table has if its first line does not say.
const PLAIN: Columns = Columns { count: 2, id: None, x: 0, y: 1 };

/// Reads a table: rows `x,y` with empty lines between outlines, or, after a line that names the columns `id`, `x` and `y` in any order,
/// rows whose id says which outline they are of. `#` begins a comment.
pub(super) fn outlines(text: &str) -> Result<Vec<Outline>, Wrong> {
    let mut outlines: Vec<Outline> = Vec::new();
    let (mut columns, mut is_first, mut is_apart) = (PLAIN, true, true);
    for (number, text) in (1..).zip(text.lines()) {
        let wrong = |message: String, hint| Wrong { line: number, message, hint };
        let row = text.split('#').next().unwrap_or_default().trim_start_matches('\u{feff}').trim();
        if row.is_empty() {
            // A line of a comment alone sets nothing apart.
            is_apart |= !text.contains('#');
            continue;
        }
        let cells: Vec<&str> = row.split(',').map(str::trim).collect();
        if std::mem::take(&mut is_first) && cells.iter().all(|cell| cell.parse::<f64>().is_err()) {
            columns = header(&cells).map_err(|message| wrong(message, "expected the columns x,y or id,x,y"))?;
            continue;
        }
        if cells.len() != columns.count {
            let message = format!("{} columns where there are {}", cells.len(), columns.count);
            return Err(wrong(message, "expected a row x,y, or a first line that names the columns, as in id,x,y"));
        }
        let number_in = |column: usize| {
            let value = cells[column].parse::<f64>().ok().filter(|x| x.is_finite());
            value
                .ok_or_else(|| wrong(format!("`{}` is not a finite number", cells[column]), "expected a length in m, as in 0.25"))
        };
        let (id, point) = (columns.id.map(|column| cells[column]), [number_in(columns.x)?, number_in(columns.y)?]);
        let goes_on = outlines.last().is_some_and(|last| if id.is_some() { last.id.as_deref() == id } else { !is_apart });
        is_apart = false;
        if !goes_on {
            if let Some(before) = id.and_then(|id| outlines.iter().find(|outline| outline.id.as_deref() == Some(id))) {
                let message = format!("the id `{}` was there before, in line {}", id.unwrap_or_default(), before.lines[0]);
                return Err(wrong(message, "expected the rows of one id to follow each other"));
            }
            outlines.push(Outline { id: id.map(str::to_owned), ..Outline::default() });
        }
        if let Some(last) = outlines.last_mut() {
            last.points.push(point);
            last.lines.push(number);
        }
    }
    Ok(outlines)
}

fn header(cells: &[&str]) -> Result<Columns, String> {
    let place = |name: &str| cells.iter().position(|cell| cell.eq_ignore_ascii_case(name));
    if let Some(other) = cells.iter().find(|cell| !["id", "x", "y"].iter().any(|name| cell.eq_ignore_ascii_case(name))) {
        return Err(format!("`{other}` is neither a number nor a column that is known"));
    }
    match (place("x"), place("y"), place("id")) {
        (Some(x), Some(y), id) if cells.len() == 2 + usize::from(id.is_some()) => Ok(Columns { count: cells.len(), id, x, y }),
        _ => Err("not one column x and one column y".to_owned()),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn wrong(text: &str) -> (usize, String) {
        let wrong = outlines(text).unwrap_err();
        (wrong.line, wrong.message)
    }

    #[test]
    fn empty_lines_set_outlines_apart_and_comments_do_not() {
        let found = outlines("# stones\n0,0\n 1.5 , 0 # a corner\n# still the first\n0,1e0\n\n\n5,5\n6,5\n").unwrap();
        assert_eq!(found.len(), 2);
        assert_eq!(found[0].points, [[0.0, 0.0], [1.5, 0.0], [0.0, 1.0]]);
        assert_eq!((found[0].lines.as_slice(), found[1].lines.as_slice()), ([2, 3, 5].as_slice(), [8, 9].as_slice()));
    }

    #[test]
    fn a_column_of_ids_sets_outlines_apart() {
        let found = outlines("\u{feff}y,x,ID\r\n0,1,a\r\n2,3,a\r\n\r\n4,5,a\r\n6,7,b\r\n").unwrap();
        assert_eq!(found.iter().map(|outline| outline.id.as_deref()).collect::<Vec<_>>(), [Some("a"), Some("b")]);
        assert_eq!((found[0].points.len(), found[1].points[0]), (3, [7.0, 6.0]));
        assert_eq!(wrong("id,x,y\na,0,0\nb,0,0\na,1,1"), (4, "the id `a` was there before, in line 2".to_owned()));
    }

    #[test]
    fn wrong_rows_are_named() {
        assert_eq!(wrong("0,0\n1,a"), (2, "`a` is not a finite number".to_owned()));
        assert_eq!(wrong("0,0\n1,nan").0, 2);
        assert_eq!(wrong("0,0\n\n1,2,3"), (3, "3 columns where there are 2".to_owned()));
        assert_eq!(wrong("x,z\n0,0"), (1, "`z` is neither a number nor a column that is known".to_owned()));
        assert_eq!(wrong("x,x\n0,0").0, 1);
        assert!(outlines("").unwrap().is_empty());
    }
}
