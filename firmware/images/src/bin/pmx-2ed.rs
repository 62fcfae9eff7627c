//! Firmware of the Arcus PMX-2ED-SA.
#![no_std]
#![no_main]

use cortex_m_rt::entry;
use devices::pmx2ed::{FLASH_BYTES, Pmx2ed};
use images::{Image, Model, Settings, board};
use static_cell::ConstStaticCell;

const MODEL: Model = Model { name: "pmx-2ed", settings_bytes: FLASH_BYTES };

type Controller = Pmx2ed<Settings>;

static CONTROLLER: ConstStaticCell<Controller> = ConstStaticCell::new(Controller::off(MODEL.settings()));
static IMAGE: Image<Controller, 2> = Image::new();

#[entry]
fn main() -> ! {
    IMAGE.run(MODEL, CONTROLLER.take(), Controller::power_on)
}

board::player_interrupt!(IMAGE.play());
