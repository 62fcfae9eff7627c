//! Firmware of the Trinamic PD42-1140.
#![no_std]
#![no_main]

use cortex_m_rt::entry;
use devices::pd42::{FLASH_BYTES, Pd42};
use images::{Image, Model, Settings, board};
use static_cell::ConstStaticCell;

const MODEL: Model = Model { name: "pd42-1140", settings_bytes: FLASH_BYTES };

type Controller = Pd42<Settings>;

static CONTROLLER: ConstStaticCell<Controller> = ConstStaticCell::new(Controller::off(MODEL.settings()));
static IMAGE: Image<Controller, 1> = Image::new();

#[entry]
fn main() -> ! {
    IMAGE.run(MODEL, CONTROLLER.take(), |module| module.power_on(board::seed()))
}

board::player_interrupt!(IMAGE.play());
