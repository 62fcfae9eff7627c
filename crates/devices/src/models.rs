//! The list of controllers. A new one is a folder beside this file and one line here.

use crate::{Controller, cmd4cr, flash::Flash, guide::Guide, pd42, pmx2ed};
use alloc::boxed::Box;

/// The language of a controller's standalone programs.
#[derive(Clone, Copy, Debug)]
pub enum Language {
    /// Trinamic's.
    Tmcl,
    /// The language of Performax and Commander.
    Ascript(&'static ascript::Dialect),
}

/// A kind of controller that can be built.
pub struct Model {
    /// Its name on the command line and in bench files.
    pub name: &'static str,
    /// Its maker's name and what it is, for people.
    pub title: &'static str,
    /// What its programs are written in.
    pub language: Language,
    /// The product's name on USB if it is a device of reports there (HID), without the digits of its
    /// [number](crate::Controller::number) that follow; `None` for a serial port.
    pub hid_product: Option<&'static str>,
    /// Bytes of flash that it needs, a multiple of the page.
    pub flash_bytes: u32,
    /// What people can know of it.
    pub guide: &'static Guide,
    /// Builds one that has just been switched on, at clock 0. `seed` is what its random numbers start
    /// from.
    pub build: fn(flash: Box<dyn Flash + Send>, seed: u64) -> Box<dyn Controller + Send>,
}

/// All models.
pub static MODELS: &[Model] = &[
    Model {
        name: "pd42-1140",
        title: "Trinamic PD42-1140, TMCL firmware V1.47",
        language: Language::Tmcl,
        hid_product: None,
        flash_bytes: pd42::FLASH_BYTES,
        guide: &pd42::guide::GUIDE,
        build: |flash, seed| Box::new(pd42::Pd42::new(flash, seed)),
    },
    Model {
        name: "pmx-2ed",
        title: "Arcus PMX-2ED-SA, firmware V128BL",
        language: Language::Ascript(&ascript::dialect::PERFORMAX_2),
        hid_product: Some(pmx2ed::NAME),
        flash_bytes: pmx2ed::FLASH_BYTES,
        guide: &pmx2ed::guide::GUIDE,
        build: |flash, _| Box::new(pmx2ed::Pmx2ed::new(flash)),
    },
    Model {
        name: "cmd-4cr",
        title: "Nippon Pulse CMD-4CR, firmware V126BL",
        language: Language::Ascript(&ascript::dialect::COMMANDER),
        hid_product: Some(cmd4cr::NAME),
        flash_bytes: cmd4cr::FLASH_BYTES,
        guide: &cmd4cr::guide::GUIDE,
        build: |flash, _| Box::new(cmd4cr::Cmd4cr::new(flash)),
    },
];

/// The model of this name.
pub fn model(name: &str) -> Option<&'static Model> {
    MODELS.iter().find(|model| model.name == name)
}
