//! RAM is scarce: what the queues and the main loop take on a 32-bit chip is a little less than here.

use crate::rig::Rig;
use crate::session::Settings;
use devices::cmd4cr::Cmd4cr;
use devices::pd42::Pd42;
use runtime::{Loop, Player, Queues};

#[test]
fn everything_fits() {
    fn check<C: devices::Controller, const AXES: usize>(most: usize) {
        let rig = size_of::<Rig<'_, AXES, 25_000_000>>();
        let main = size_of::<Loop<'_, '_, C, Rig<'_, AXES, 25_000_000>, AXES>>() - rig;
        let bytes = size_of::<Queues<AXES>>() + size_of::<Player<'_, AXES>>() + main;
        assert!(bytes <= most, "{bytes} bytes");
    }
    check::<Pd42<Settings>, 1>(3 << 10);
    check::<Cmd4cr<Settings>, 4>(6 << 10);
}
