//! Any commands at any time, with a main loop that is late at random: what the controllers plan is what the pins show.

use crate::session::{Main, cmd4cr, pass, pd42, pmx2ed, session, tmcl};
use devices::{Controller, Port};
use proptest::prelude::*;

/// What happens from outside.
#[derive(Clone, Debug)]
enum Happening {
    /// Bytes come.
    Command(Vec<u8>),
    /// An input changes.
    Input(usize, i32),
    /// So many microseconds pass.
    Wait(u64),
    /// The main loop is away, so many microseconds.
    Away(u64),
    /// So is the interrupt.
    Stall(u64),
    /// From now on the main loop is late, by up to so many microseconds.
    Latency(u64),
}

fn happening(command: impl Strategy<Value = Vec<u8>>, pins: usize) -> impl Strategy<Value = Happening> {
    prop_oneof![
        6 => command.prop_map(Happening::Command),
        1 => (0..pins, 0..2).prop_map(|(pin, level)| Happening::Input(pin, level)),
        6 => (100u64..60_000).prop_map(Happening::Wait),
        1 => (100u64..30_000).prop_map(Happening::Away),
        1 => (1u64..8000).prop_map(Happening::Stall),
        1 => (0u64..400).prop_map(Happening::Latency),
    ]
}

fn script<C: Controller, const AXES: usize, const HZ: u32>(
    main: &mut Main<'_, '_, C, AXES, HZ>,
    happenings: &[Happening],
) {
    let ticks = |us: u64| us * u64::from(HZ) / 1_000_000;
    for happening in happenings {
        match happening {
            Happening::Command(bytes) => {
                main.hardware().port(Port::Usb).to_device.extend(bytes);
                pass(main, 300);
            }
            Happening::Input(pin, level) => {
                main.hardware().inputs.insert(*pin, *level);
            }
            Happening::Wait(us) => pass(main, *us),
            Happening::Away(us) => main.hardware().pass(ticks(*us)),
            Happening::Stall(us) => {
                main.hardware().stall(ticks(*us));
                main.hardware().pass(0);
            }
            Happening::Latency(us) => main.hardware().latency = ticks(*us),
        }
    }
    main.hardware().latency = 0;
}

/// Until nothing moves any more, and all of it has been played.
fn rest<C: Controller, const AXES: usize, const HZ: u32>(main: &mut Main<'_, '_, C, AXES, HZ>, stop: &[u8]) {
    main.hardware().port(Port::Usb).to_device.extend(stop);
    pass(main, 200_000);
}

fn ascii(commands: &'static [&'static str]) -> impl Strategy<Value = Vec<u8>> {
    (prop::sample::select(commands), -3000i32..3000).prop_map(|(command, number)| {
        let command =
            command.replace('#', &number.to_string()).replace('+', &number.unsigned_abs().to_string());
        format!("{command}\r").into_bytes()
    })
}

fn frame() -> impl Strategy<Value = Vec<u8>> {
    let any = (0u8..3, -4000i32..4000);
    let opcodes = prop::sample::select(&[1u8, 2, 3, 4, 4, 4, 5, 14]);
    (opcodes, any).prop_map(|(opcode, (kind, value))| {
        let (kind, value) = match opcode {
            1 | 2 => (0, value.abs() / 2),
            4 => (kind % 2, value),
            5 => (4 + kind % 2, value.abs() / 2),
            14 => (kind % 2, value & 1),
            _ => (0, 0),
        };
        tmcl(opcode, kind, value).to_vec()
    })
}

const MOVES: &[&str] = &[
    "X#",
    "Y#",
    "X#Y#",
    "JX+",
    "JY-",
    "STOP",
    "ABORT",
    "STOPX",
    "HSPD=+",
    "HSPD=20000",
    "ACC=+",
    "DEC=20",
    "LSPD=300",
    "ABS",
    "INC",
    "DO=+",
    "DO=3",
    "EO=3",
    "CLRX",
    "CLRY",
    "PX=#",
    "SSPDX=+",
    "HX+0",
    "HLHOMEY-",
];

const MORE: &[&str] = &[
    "X#",
    "Z#U#",
    "X#Y#Z#",
    "JX+",
    "JU-",
    "STOP",
    "ABORTZ",
    "HSPD=+",
    "HSPD=20000",
    "ACC=+",
    "DEC=20",
    "ABS",
    "INC",
    "DO=+",
    "DO=5",
    "EO=15",
    "CLRX",
    "CLRY",
    "CIRXYP#:#",
    "ARCXYN#:#:90",
    "IO=+",
    "IOCFG=7",
    "PWM1=30",
    "HX+0",
];

proptest! {
    #![proptest_config(ProptestConfig::with_cases(24))]

    #[test]
    fn of_a_pd42(happenings in prop::collection::vec(happening(frame(), 3), 1..40)) {
        let heard = session::<_, 1, 25_000_000>(pd42(), |main| {
            script(main, &happenings);
            rest(main, &[tmcl(5, 5, 2000), tmcl(3, 0, 0)].concat());
        });
        heard.check_order(22.0);
    }

    #[test]
    fn of_a_pmx2ed(happenings in prop::collection::vec(happening(ascii(MOVES), 16), 1..40)) {
        let heard = session::<_, 2, 170_000_000>(pmx2ed(), |main| {
            main.hardware().port(Port::Usb).to_device.extend(b"EO=3\rHSPD=9000\rACC=50\r");
            script(main, &happenings);
            rest(main, b"ABORT\r");
        });
        heard.check_order(22.0);
    }

    #[test]
    fn of_a_cmd4cr(happenings in prop::collection::vec(happening(ascii(MORE), 42), 1..40)) {
        let heard = session::<_, 4, 1_000_000>(cmd4cr(), |main| {
            main.hardware().port(Port::Usb).to_device.extend(b"EO=15\rHSPD=9000\rACC=50\r");
            script(main, &happenings);
            rest(main, b"ABORT\r");
        });
        heard.check_order(22.0);
    }
}
