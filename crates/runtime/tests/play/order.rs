//! What happens at the same time, too late, too often or very seldom.

use crate::script::{Act, HZ, Script};
use crate::session::{Heard, pass, pd42, say, session, tmcl};
use devices::Port;
use motion::train::EVERY_SLOT;
use motion::{Direction, Moment, Train};

/// So many pulses, so many clocks apart.
fn train(start: u64, spacing: u64, count: u32) -> Train {
    let direction = Direction::Positive;
    let start = Moment::at(start);
    Train { start, interval: spacing << 32, add: 0, jerk: 0, count, direction, mask: EVERY_SLOT }
}

fn play<const TIMER: u32>(acts: &[(u64, Act)], ms: u64) -> Heard<Script> {
    session::<_, 2, TIMER>(Script::new(acts), |main| pass(main, 1000 * ms))
}

/// On a slow timer many clocks are one tick. What was first stays first.
#[test]
fn within_a_tick() {
    fn check<const TIMER: u32>() {
        let mut acts = Vec::new();
        for k in 0..20 {
            let at = 20_000 + 40_001 * k;
            acts.extend([
                (at, Act::Output(3, k % 2 == 0)),
                (at + 1, Act::Train(0, train(at, 1, 1))),
                (at + 2, Act::Output(3, k % 2 != 0)),
                (at + 3, Act::Train(1, train(at, 3, 1))),
                (at + 3, Act::Release(2)),
                (at + 4, Act::Train(0, train(at, 4, 1))),
                (at + 4, Act::Output(2, k % 2 == 0)),
            ]);
        }
        let heard = play::<TIMER>(&acts, 80);
        assert_eq!(heard.check_order(1000.0), 60);
        assert_eq!((heard.log.len(), heard.figures.slips), (140, 0));
    }
    check::<1_000_000>();
    check::<25_000_000>();
    check::<170_000_000>();
}

/// Spacings that change, in some slots or all, and from tick to tick of the main loop.
#[test]
fn curves_and_masks() {
    fn check<const TIMER: u32>(mask: u64, interval: u64, add: i64, jerk: i64) {
        let curve = Train {
            interval: interval << 28,
            add: add << 28,
            jerk: jerk << 28,
            count: if mask == EVERY_SLOT { 60 } else { mask.count_ones() },
            direction: Direction::Negative,
            mask,
            ..train(20_000, 0, 0)
        };
        let even = train(20_000, 700, 60);
        let acts = [(curve.edge(1), Act::Train(0, curve)), (20_700, Act::Train(1, even))];
        let heard = play::<TIMER>(&acts, 100);
        assert_eq!(heard.check_ticks(), curve.count as usize + 60);
    }
    for mask in [EVERY_SLOT, 1, 1 << 63, 0x8000_0000_0000_0001, 0x00F0_3355_0000_8001, u64::MAX >> 2, 0b10] {
        check::<25_000_000>(mask, 16 * 700, 0, 0);
        check::<25_000_000>(mask, 16 * 900, -170, 0);
        check::<170_000_000>(mask, 16 * 3000, -1500, 35);
        check::<170_000_000>(mask, 16 * 400 + 7, 300, -2);
        check::<1_000_000>(mask, 16 * 3000, -1501, 33);
    }
}

/// There is no room for all that happens within a horizon: the main loop waits, nothing is lost.
#[test]
fn more_than_queues_hold() {
    let every = u64::from(HZ) / 1_000_000 * 10;
    let pulse =
        |k| (20_000 + every * k, Act::Train((k % 2) as usize, train(20_000 + every * (k - 1), every, 1)));
    let acts: Vec<_> = (1..=1000).map(pulse).collect();
    let heard = play::<25_000_000>(&acts, 100);
    assert_eq!(heard.check_order(22.0), 1000);
    let acts: Vec<_> = (0..1000).map(|k| (20_000 + every * k, Act::Output(3, k % 2 == 0))).collect();
    let heard = play::<25_000_000>(&acts, 100);
    assert_eq!((heard.check_order(0.0), heard.log.len()), (0, 1000));
}

/// Pulses are so rare that 32 bits of ticks do not reach from one to the next.
#[test]
fn minutes_apart() {
    let rare = train(0, 1_900_000_000, 2);
    let heard = session::<_, 2, 170_000_000>(Script::new(&[(1_900_000_000, Act::Train(1, rare))]), |main| {
        pass(main, 238_000_000);
    });
    assert_eq!(heard.check_ticks(), 2);
}

/// Trains of nearly as many pulses a second as there are ticks: the main loop goes on, the plan gets late.
#[test]
fn faster_than_the_interrupt() {
    let fast = train(20_000, 1, 16_000_000);
    let heard = session::<_, 2, 25_000_000>(Script::new(&[(20_000, Act::Train(0, fast))]), |main| {
        pass(main, 1_000_000);
        assert!(main.hardware().feeds > 100, "the main loop has its share");
    });
    assert!(heard.figures.slips > 0);
    let played = heard.log.len();
    assert!((100_000..16_000_000).contains(&played), "{played}");
}

/// Stops on the way are no end; the plan is as if they were not there.
#[test]
fn stops_short_of_the_clock() {
    let pulses = train(20_000, 20_000, 200);
    let acts: Vec<_> = (0..200).map(|k| (30_000 + 19_000 * k, Act::Stop(5))).collect();
    let acts = [&acts[..], &[(40_000, Act::Train(0, pulses))]].concat();
    assert_eq!(play::<25_000_000>(&acts, 300).check_ticks(), 200);
}

/// What makes no progress at all is a fault, and no endless loop.
#[test]
#[should_panic(expected = "no progress")]
fn stands_still() {
    play::<25_000_000>(&[(20_000, Act::Stop(u32::MAX))], 10);
}

/// The main loop is away, with the interrupt at work or not: time has stood still.
#[test]
fn the_main_loop_is_late() {
    fn check(us: u64, interrupts: bool, tolerance_us: f64) {
        let heard = session::<_, 1, 25_000_000>(pd42(), |main| {
            say(main, Port::Usb, &tmcl(1, 0, 2000));
            for _ in 0..10 {
                pass(main, 50_000);
                if interrupts {
                    main.hardware().pass(us * 25);
                } else {
                    main.hardware().stall(us * 25);
                    main.hardware().pass(0);
                }
            }
            say(main, Port::Usb, &tmcl(3, 0, 0));
            pass(main, 2_000_000);
        });
        assert!(heard.check_order(tolerance_us) > 1000);
        let late = if interrupts { us.saturating_sub(500) } else { us.saturating_sub(20) };
        let slipped = heard.figures.slipped_ticks / 25;
        let expected = if us < 100 { 0..=0 } else { 10 * late..=10 * (us + 300) };
        assert!(expected.contains(&slipped), "{us} us: {:?}", heard.figures);
        assert_eq!(heard.figures.slips > 0, us >= 100);
    }
    check(22_000, true, 4.0);
    check(1000, true, 4.0);
    check(90, true, 4.0);
    check(22_000, false, 24.0);
    check(5000, false, 24.0);
    check(15, false, 24.0);
}
