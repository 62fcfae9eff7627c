//! Firmware of the Nippon Pulse CMD-4CR.
#![no_std]
#![no_main]

use cortex_m_rt::entry;
use devices::cmd4cr::{Cmd4cr, FLASH_BYTES};
use images::{Image, Model, Settings, board};
use static_cell::ConstStaticCell;

const MODEL: Model = Model { name: "cmd-4cr", settings_bytes: FLASH_BYTES };

type Controller = Cmd4cr<Settings>;

static CONTROLLER: ConstStaticCell<Controller> = ConstStaticCell::new(Controller::off(MODEL.settings()));
static IMAGE: Image<Controller, 4> = Image::new();

#[entry]
fn main() -> ! {
    IMAGE.run(MODEL, CONTROLLER.take(), Controller::power_on)
}

board::player_interrupt!(IMAGE.play());
