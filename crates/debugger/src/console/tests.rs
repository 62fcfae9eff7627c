//! Sessions, as they are typed.

use super::*;
use crate::{Code, Target};
use sim::DeviceConfig;
use source::Source;

/// A move there and back in a subroutine, twice.
const ASCRIPT: &str = "\
PRG 0
EO=3
V1=0
WHILE V1<2
GOSUB 1
V1=V1+1
ENDWHILE
END
SUB 1
X1000
WAITX
X0
WAITX
ENDSUB
";

const TMCL: &str = "\
start: GGP 1, 2
  CALC ADD, 2
  AGP 1, 2
  CSUB sub
  WAIT TICKS, 0, 5
  JA start
sub: SIO 0, 2, 1
  RSUB
";

fn console(model: &str, source: &str) -> Console {
    let model = devices::model(model).expect("a model");
    let code = match model.language {
        devices::Language::Tmcl => {
            Code::tmcl(tmcl::asm::assemble("a.tmc", source.as_bytes(), &tmcl::asm::NoFiles))
                .expect("it is right")
        }
        devices::Language::Ascript(dialect) => {
            let compilation = ascript::compile("a.prg", source.as_bytes(), dialect);
            Code::ascript(Source::new("a.prg", source.as_bytes()), compilation.code.expect("it is right"))
        }
    };
    let target = Target { code, config: DeviceConfig::new(model), inputs: Vec::new(), faults: Vec::new() };
    Console::new(Debugger::new(target, 10.0).expect("it starts"))
}

/// Types lines that begin with the prompt and compares what is said between them.
#[track_caller]
fn check(model: &str, source: &str, session: &str) {
    let mut console = console(model, source);
    let typed = session.lines().filter_map(|line| line.strip_prefix(PROMPT));
    let said: String = typed.map(|line| format!("{PROMPT}{line}\n{}", console.execute(line).text)).collect();
    assert_eq!(said, session);
}

#[test]
fn steps() {
    check(
        "pmx-2ed",
        ASCRIPT,
        "\
(debug) step
0.000100 s, program 0
    2 > EO=3
",
    );
}

#[test]
fn steps_of_tmcl() {
    check(
        "pd42-1140",
        TMCL,
        "\
(debug) next
0.000050 s
    2 >   CALC ADD, 2
",
    );
}
