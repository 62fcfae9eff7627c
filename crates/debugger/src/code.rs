//! A program and the sources that it comes from.

use ascript::compiler;
use sim::{Program, fault};
use source::Source;
use tmcl::asm::Assembly;

/// A line of a source.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub struct Place {
    /// The file, as an index of [`Code::files`].
    pub file: usize,
    /// The line, from 1.
    pub line: usize,
}

/// A name for an address.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Label {
    /// The name: that of the source, or `PRG0` and `SUB3`.
    pub name: String,
    /// The address.
    pub address: u16,
}

/// A program as its controller holds it, and where each of its addresses comes from.
#[derive(Clone, Debug)]
pub struct Code {
    /// What is loaded.
    pub program: Program,
    /// The sources; the first is the main one.
    pub files: Vec<Source>,
    /// By address.
    places: Vec<Place>,
    /// By address.
    labels: Vec<Label>,
}

impl Code {
    /// What a source of TMCL was assembled to; `None` if it has errors.
    pub fn tmcl(assembly: Assembly) -> Option<Self> {
        let program = assembly.program?;
        let places = program.map.iter().map(|place| Place { file: place.file, line: place.line });
        let labels = program.symbols.into_iter().filter(|symbol| symbol.label);
        // An address is one of 2,048.
        let labels = labels.map(|symbol| Label { name: symbol.name, address: symbol.value as u16 });
        let (places, labels) = (places.collect(), labels.collect());
        Some(Self::new(Program::Tmcl(program.commands), assembly.files, places, labels))
    }

    /// What a source of A-SCRIPT was compiled to.
    pub fn ascript(source: Source, code: compiler::Code) -> Self {
        let places = code.map.iter().map(|&line| Place { file: 0, line }).collect();
        let name = |line: &ascript::Line| match *line {
            ascript::Line::Program(number) => Some(format!("PRG{number}")),
            ascript::Line::Subroutine(number) => Some(format!("SUB{number}")),
            _ => None,
        };
        let lines = (0..).zip(&code.lines);
        let labels = lines.filter_map(|(address, line)| Some(Label { name: name(line)?, address })).collect();
        Self::new(Program::Ascript(code.lines), vec![source], places, labels)
    }

    fn new(program: Program, files: Vec<Source>, places: Vec<Place>, mut labels: Vec<Label>) -> Self {
        labels.sort_by_key(|label| label.address);
        Self { program, files, places, labels }
    }

    /// The line that an address comes from; `None` behind the end of the program.
    pub fn place(&self, address: u16) -> Option<Place> {
        self.places.get(usize::from(address)).copied()
    }

    /// Whether a line begins at an address: it may become several of them.
    pub fn is_statement(&self, address: u16) -> bool {
        let before = address.checked_sub(1).and_then(|before| self.place(before));
        self.place(address).is_none_or(|place| before != Some(place))
    }

    /// The line, or the first one behind it, that became something, and the addresses where it begins.
    pub fn find(&self, place: Place) -> Option<(Place, Vec<u16>)> {
        let behind = self.places.iter().filter(|it| it.file == place.file && it.line >= place.line);
        let found = *behind.min()?;
        let addresses = (0..).zip(&self.places).filter(|(_, it)| **it == found).map(|(address, _)| address);
        Some((found, addresses.filter(|&address| self.is_statement(address)).collect()))
    }

    /// The address of a label; upper and lower case are the same, and spaces do not count.
    pub fn label(&self, name: &str) -> Option<u16> {
        let name: String = name.split_whitespace().collect();
        let same = |label: &&Label| label.name.eq_ignore_ascii_case(&name);
        self.labels.iter().find(same).map(|label| label.address)
    }

    /// The address of a place that a scenario names: a line of the main source that becomes something, or a label.
    pub fn address(&self, place: &fault::Place<'_>) -> Option<u16> {
        match *place {
            fault::Place::Line(line) => {
                let line = Place { file: 0, line: line as usize };
                let address = self.places.iter().position(|place| *place == line)?;
                Some(address as u16)
            }
            fault::Place::Label(name) => self.label(name),
        }
    }

    /// All labels, by address.
    pub fn labels(&self) -> &[Label] {
        &self.labels
    }

    /// The last label at or before an address: what the routine is called.
    pub fn routine(&self, address: u16) -> Option<&str> {
        let end = self.labels.partition_point(|label| label.address <= address);
        self.labels[..end].last().map(|label| label.name.as_str())
    }

    /// The text of a line, if there is one.
    pub fn text(&self, place: Place) -> Option<&str> {
        let file = self.files.get(place.file)?;
        let inside = (1..=file.line_count()).contains(&place.line);
        inside.then(|| file.slice(&file.line_span(place.line)))
    }

    /// The number of a file: by its whole name, or by the last part of its path.
    pub fn file(&self, name: &str) -> Option<usize> {
        let last = |path: &str| path.rsplit(['/', '\\']).next().map(str::to_owned);
        let whole = self.files.iter().position(|file| file.name == name);
        whole.or_else(|| self.files.iter().position(|file| last(&file.name) == last(name)))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use ascript::dialect::COMMANDER;
    use tmcl::asm::{NoFiles, assemble};

    #[test]
    fn lines_of_tmcl() {
        let text = "// nothing\nstart: MVP ABS, 0, 5\n\n  WAIT POS, 0, 0\nend: JA start\n";
        let code = Code::tmcl(assemble("dir/a.tmc", text.as_bytes(), &NoFiles)).expect("it is right");
        let check = |line, expected: Option<(usize, &[u16])>| {
            let found = code.find(Place { file: 0, line });
            let found = found.as_ref().map(|(place, addresses)| (place.line, &addresses[..]));
            assert_eq!(found, expected, "{line}");
        };
        check(1, Some((2, &[0])));
        check(3, Some((4, &[1])));
        check(5, Some((5, &[2])));
        check(6, None);
        assert_eq!(code.label("END"), Some(2));
        assert_eq!(code.routine(1), Some("start"));
        assert_eq!(
            (code.file("a.tmc"), code.file("dir/a.tmc"), code.file("b.tmc")),
            (Some(0), Some(0), None)
        );
    }

    #[test]
    fn a_line_of_ascript_begins_once() {
        let text = "PRG 0\nV1=V1+2\nIF DI1=DI2\nGOSUB 3\nENDIF\nEND\nSUB 3\nENDSUB\n";
        let compiled = compiler::compile("a.prg", text.as_bytes(), &COMMANDER).code.expect("it is right");
        let code = Code::ascript(Source::new("a.prg", text.as_bytes()), compiled);
        let (place, addresses) = code.find(Place { file: 0, line: 3 }).expect("the line of IF");
        assert_eq!((place.line, addresses.len()), (3, 1));
        assert!(code.is_statement(addresses[0]) && !code.is_statement(addresses[0] + 1));
        assert_eq!(code.text(place), Some("IF DI1=DI2"));
        assert_eq!(
            (code.label("sub 3").and_then(|it| code.routine(it)), code.routine(0)),
            (Some("SUB3"), Some("PRG0"))
        );
    }
}
