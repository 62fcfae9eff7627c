//! Tables of text. Columns are known by their names in the first row.

use super::{
    NS_PER_SECOND, Problem,
    table::{Row, nanoseconds, number, put},
};
use crate::record::Plot;
use csv::{Reader, StringRecord};
use std::io::BufRead;

/// The columns that a plot has use for; those that a file lacks are empty.
#[derive(Default)]
struct Columns {
    seconds: Option<usize>,
    event: Option<usize>,
    axis: Option<usize>,
    position: Option<usize>,
    encoder: Option<usize>,
    speed: Option<usize>,
    pin: Option<usize>,
    value: Option<usize>,
    unit: Option<usize>,
    text: Option<usize>,
}

impl Columns {
    fn of(head: &StringRecord) -> Self {
        let column = |name| head.iter().position(|other| other == name);
        Self {
            seconds: column("seconds"),
            event: column("event"),
            axis: column("axis"),
            position: column("position"),
            encoder: column("encoder"),
            speed: column("speed"),
            pin: column("pin"),
            value: column("value"),
            unit: column("unit"),
            text: column("text"),
        }
    }
}

pub(super) fn read(input: &mut impl BufRead, title: &str) -> Result<Plot, Problem> {
    let mut reader = Reader::from_reader(input);
    let columns = Columns::of(reader.headers().map_err(problem)?);
    if columns.seconds.is_none() || columns.event.is_none() {
        return Err(Problem::at(1, "the table of a recording has the columns `seconds` and `event`"));
    }
    let mut plot = None;
    let mut record = StringRecord::new();
    while reader.read_record(&mut record).map_err(problem)? {
        let line = record.position().map_or(0, csv::Position::line);
        let row = row(&columns, &record).map_err(|text| Problem::at(line, text))?;
        let plot = plot.get_or_insert_with(|| Plot::new(title, NS_PER_SECOND, row.at));
        put(plot, &row).map_err(|text| Problem::at(line, text))?;
    }
    plot.ok_or_else(|| "there is nothing in it".into())
}

fn row<'a>(columns: &Columns, record: &'a StringRecord) -> Result<Row<'a>, String> {
    let field = |column: Option<usize>| column.and_then(|column| record.get(column)).unwrap_or_default();
    let text = |column| Some(field(column)).filter(|text| !text.is_empty());
    Ok(Row {
        at: nanoseconds(field(columns.seconds))?,
        event: field(columns.event),
        axis: text(columns.axis),
        position: number(field(columns.position))?,
        encoder: number(field(columns.encoder))?,
        speed: number(field(columns.speed))?,
        pin: text(columns.pin),
        value: number(field(columns.value))?,
        unit: text(columns.unit),
        text: text(columns.text),
    })
}

fn problem(error: csv::Error) -> Problem {
    let line = error.position().map(csv::Position::line);
    Problem { line, text: error.to_string() }
}
