//! Every edge in its tick.

use crate::rig::What;
use crate::session::{Main, cmd4cr, commands, pass, pd42, pmx2ed, say, session, tmcl};
use devices::{Controller, Port};
use motion::Direction::{Negative, Positive};
use std::collections::BTreeSet;

/// Ramps, a cruise, a way back, a stop in the middle.
fn drive_pd42<C: Controller, const HZ: u32>(main: &mut Main<'_, '_, C, 1, HZ>) {
    let mut command = |opcode, kind, value, us| {
        let reply = say(main, Port::Usb, &tmcl(opcode, kind, value));
        assert_eq!(reply[2], 100);
        pass(main, us);
    };
    command(5, 4, 1500, 0);
    command(5, 5, 1800, 0);
    command(4, 0, 9000, 600_000);
    command(4, 0, -300, 300_000);
    command(2, 0, 200, 200_000);
    command(1, 0, 2000, 300_000);
    command(3, 0, 0, 300_000);
}

#[test]
fn of_one_axis() {
    fn check<const HZ: u32>() {
        let heard = session::<_, 1, HZ>(pd42(), drive_pd42);
        assert!(heard.check_ticks() > 10_000);
        let both = [Positive, Negative].map(|way| {
            heard
                .log
                .iter()
                .any(|(_, what)| matches!(what, What::Pulse(0, direction, _) if *direction == way))
        });
        assert_eq!(both, [true; 2]);
    }
    check::<25_000_000>();
    check::<170_000_000>();
    check::<1_000_000>();
}

#[test]
fn of_two_axes_and_a_line() {
    fn check<const HZ: u32>() {
        let heard = session::<_, 2, HZ>(pmx2ed(), |main| {
            commands(main, "EO=3 HSPD=40000 LSPD=500 ACC=100 DEC=50 X9000 Y-2000");
            pass(main, 400_000);
            commands(main, "HSPD=3000 ABS X0Y0");
            pass(main, 500_000);
            commands(main, "STOP");
            pass(main, 200_000);
        });
        assert!(heard.check_ticks() > 5000);
    }
    check::<25_000_000>();
    check::<170_000_000>();
    check::<1_000_000>();
}

#[test]
fn of_four_axes_a_circle_and_outputs() {
    fn check<const HZ: u32>() {
        let heard = session::<_, 4, HZ>(cmd4cr(), |main| {
            commands(main, "EO=15 HSPD=20000 LSPD=500 ACC=100 DEC=50 X900 Y-2000 Z3000 U-7");
            pass(main, 400_000);
            commands(main, "HSPD=5000 X0Y0Z0 DO=5");
            pass(main, 1_500_000);
            commands(main, "CIRXYP1000:0 DO=10");
            pass(main, 100_000);
            commands(main, "DO=3");
            pass(main, 2_000_000);
        });
        assert!(heard.check_ticks() > 10_000);
        assert!(heard.log.iter().any(|(_, what)| matches!(what, What::Output(..))));
    }
    check::<25_000_000>();
    check::<170_000_000>();
    check::<1_000_000>();
}

/// The axes of a path step in the same clocks, and so in one call.
#[test]
fn of_the_same_clock_are_one_step() {
    let heard = session::<_, 2, 25_000_000>(pmx2ed(), |main| {
        commands(main, "EO=3 HSPD=5000 X3000Y1999");
        pass(main, 2_000_000);
    });
    assert_eq!(heard.check_ticks(), 4999);
    let dues = heard.log.iter().filter_map(|(_, what)| match what {
        What::Pulse(_, _, due) => Some(due),
        _ => None,
    });
    let dues = dues.collect::<BTreeSet<_>>();
    assert_eq!((dues.len(), heard.steps), (3000, 3000));
}
