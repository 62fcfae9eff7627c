//! Motors that fall out of step, pulse by pulse and train by train.

use super::{
    shaft::{Edge, Shaft, Side},
    stall::Field,
    torque::Torque,
};
use devices::Drive;
use motion::{Direction, Moment, Train, train::EVERY_SLOT};
use proptest::prelude::*;

/// Half the torque at 1,000 full steps a second, none at 2,000; a clock of 1 MHz and ten positions a full step.
const CURVE: &[[f64; 2]] = &[[0.0, 1.0], [2000.0, 0.0]];
const CYCLE: i64 = 40;

fn shaft(load: f64, stops: Option<[i64; 2]>) -> Shaft {
    let torque = Torque::new(CURVE, 0.0, 10, 1_000_000).unwrap();
    let mut shaft = Shaft::new(0, stops).with_field(Some(Field::new(torque, 10)));
    shaft.set_load((load * 1000.0) as u32);
    shaft
}

/// Pulses as far apart as this, in clocks, from where the last one ended.
struct Pulses(Moment);

impl Pulses {
    fn go(&mut self, shaft: &mut Shaft, clocks: u64, pulses: i64) -> i64 {
        let train = Train {
            start: self.0,
            interval: clocks << 32,
            add: 0,
            jerk: 0,
            count: pulses.unsigned_abs() as u32,
            direction: Direction::of(pulses),
            mask: EVERY_SLOT,
        };
        shaft.follow(&train);
        self.0 = train.moment(train.count);
        shaft.position(Side::Motor)
    }
}

/// Half the load stalls above 1,000 full steps a second: faster than a pulse of a tenth of a full step in 100
/// clocks.
#[test]
fn a_pulse_that_comes_too_soon_is_lost() {
    let check = |clocks: &[u64], expected: i64| {
        let (mut shaft, mut pulses) = (shaft(0.5, None), Pulses(Moment::at(0)));
        let reached = clocks.iter().map(|clocks| pulses.go(&mut shaft, *clocks, 1)).last();
        assert_eq!(reached, Some(expected), "{clocks:?}");
        assert_eq!(shaft.odometer(), clocks.len() as i64);
    };
    check(&[500, 100, 100, 100], 4);
    check(&[500, 100, 99], 2);
    // The next one that is slow enough takes the rotor to the field.
    check(&[500, 100, 99, 99, 100], 5);
    // The first has none before it.
    check(&[1], 1);
}

#[test]
fn what_is_lost_are_whole_cycles() {
    for lost in 1..200 {
        let (mut shaft, mut pulses) = (shaft(0.5, None), Pulses(Moment::at(0)));
        assert_eq!(pulses.go(&mut shaft, 200, 50), 50);
        assert_eq!(pulses.go(&mut shaft, 50, lost), 50, "it stands while it is too fast");
        let there = pulses.go(&mut shaft, 200, 100);
        assert_eq!((150 + lost - there) % CYCLE, 0, "{lost} lost, {there}");
        let nearest = (50 + lost - there + 100).abs();
        assert!(nearest <= lost + CYCLE / 2, "{lost} lost, {there}");
    }
}

#[test]
fn the_rotor_comes_back_the_shorter_way() {
    let check = |lost: i64, expected: i64| {
        let (mut shaft, mut pulses) = (shaft(0.5, None), Pulses(Moment::at(0)));
        pulses.go(&mut shaft, 200, 100);
        pulses.go(&mut shaft, 50, lost);
        assert_eq!(pulses.go(&mut shaft, 200, 1), expected, "{lost}");
    };
    check(9, 110);
    check(19, 120);
    check(20, 81);
    check(39, 100);
    check(59, 120);
}

#[test]
fn a_motor_without_torque_stands() {
    let (mut shaft, mut pulses) = (shaft(1.5, None), Pulses(Moment::at(0)));
    assert_eq!(pulses.go(&mut shaft, 1000, 500), 0);
    shaft.set_load(0);
    assert_eq!(pulses.go(&mut shaft, 1000, 20), 0, "after 13 cycles");
    shaft.set_drive(Drive { step: 1, parts: 1, current: 0 });
    assert_eq!(pulses.go(&mut shaft, 1000, 20), 0);
    shaft.set_drive(Drive { step: 1, parts: 1, current: 32 });
    assert_eq!(pulses.go(&mut shaft, 1000, 10), -10, "half a cycle back");
}

#[test]
fn a_stop_costs_whole_cycles() {
    let (mut shaft, mut pulses) = (shaft(0.0, Some([-100, 1000])), Pulses(Moment::at(0)));
    assert_eq!(pulses.go(&mut shaft, 500, -115), -100);
    assert_eq!(shaft.load_permille(), 1000);
    assert_eq!(pulses.go(&mut shaft, 500, 15), -100, "the field has to come back first");
    assert_eq!(pulses.go(&mut shaft, 500, 15), -85);
    // More than half a cycle: it springs back from the stop to the pole behind.
    assert_eq!(pulses.go(&mut shaft, 500, -40), -85);
    assert_eq!(pulses.go(&mut shaft, 500, -1000 - 15), -100);
    let free = pulses.go(&mut shaft, 500, 500);
    assert_eq!((free - (-115 + 15 + 15 - 40 - 1015 + 500)) % CYCLE, 0, "{free}");
}

#[test]
fn the_load_is_a_part_of_the_torque_that_is_left() {
    let (mut shaft, mut pulses) = (shaft(0.25, None), Pulses(Moment::at(0)));
    for (clocks, permille) in [(10_000, 251), (200, 333), (100, 500), (80, 667)] {
        pulses.go(&mut shaft, clocks, 2);
        assert_eq!(shaft.load_permille(), permille, "{clocks}");
    }
}

#[test]
fn a_window_leaves_room_for_what_may_be_lost() {
    let mut shaft = shaft(0.5, None);
    let edge = |below, above| Edge { side: Side::Motor, below, above };
    assert_eq!(shaft.window(&[]), (-super::zone::NEVER, super::zone::NEVER));
    assert_eq!(shaft.window(&[edge(-5000, 4020)]), (-1000, 1000));
    assert_eq!(shaft.window(&[edge(-5000, 27)]), (-1, 1));
    shaft.lose(3);
    assert_eq!(shaft.window(&[edge(-5000, 4020)]), (-1, 1));
}

fn trains() -> impl Strategy<Value = Vec<Train>> {
    let train =
        (60_u64..400, -100_i64..100, -4_i64..4, 1_u32..50, any::<bool>(), any::<u64>(), any::<bool>());
    let train = train.prop_map(|(clocks, add, jerk, count, up, mask, masked)| Train {
        start: Moment::at(0),
        interval: clocks << 32,
        add: add << 24,
        jerk: jerk << 20,
        count: if masked { (mask | 1).count_ones() } else { count },
        direction: if up { Direction::Positive } else { Direction::Negative },
        mask: if masked { mask | 1 } else { EVERY_SLOT },
    });
    prop::collection::vec(train, 1..12).prop_map(|mut trains| {
        let mut end = Moment::at(7);
        for train in &mut trains {
            train.start = end;
            end = train.moment(train.count);
        }
        trains
    })
}

/// Pulse by pulse, from their moments alone.
fn oracle(trains: &[Train], load: f64) -> Vec<i64> {
    let (mut rotor, mut field, mut last) = (0_i64, 0_i64, None);
    let mut places = Vec::new();
    for train in trains {
        for k in 1..=train.count {
            let moment = train.moment(k);
            let interval = last.and_then(|last| moment.since(last)).unwrap_or(u64::MAX);
            last = Some(moment);
            field += train.direction.sign();
            // In clocks: a tenth of a full step at the speed where this much torque is left.
            let limit = 1e6 * 0.1 / (2000.0 * (1.0 - load));
            if interval as f64 / 4_294_967_296.0 >= limit {
                let ahead = (field - rotor).rem_euclid(CYCLE);
                rotor += if ahead > CYCLE / 2 { ahead - CYCLE } else { ahead };
            }
            places.push(rotor);
        }
    }
    places
}

proptest! {
    #[test]
    fn how_trains_are_cut_does_not_matter(
        trains in trains(),
        load in prop::sample::select(vec![0.0, 0.25, 0.5, 0.75]),
        cuts in prop::collection::vec(1_u32..20, 100),
    ) {
        let places = oracle(&trains, load);
        let (mut whole, mut cut) = (shaft(load, None), shaft(load, None));
        let mut cuts = cuts.iter().cycle();
        let mut done = 0;
        for train in &trains {
            whole.follow(train);
            done += train.count as usize;
            prop_assert_eq!(whole.position(Side::Motor), places[done - 1]);
            let mut rest = *train;
            while let Some(&k) = cuts.next().filter(|k| **k < rest.count) {
                let (head, tail) = rest.split(k);
                cut.follow(&head);
                rest = tail;
            }
            cut.follow(&rest);
            prop_assert_eq!(cut.position(Side::Motor), places[done - 1]);
            prop_assert_eq!(cut.load_permille(), whole.load_permille());
        }
    }
}
