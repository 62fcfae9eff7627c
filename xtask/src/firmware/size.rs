//! How much memory an image takes, from its ELF file.

use anyhow::{Context, Result};
use object::{
    elf::{PT_LOAD, SHF_ALLOC, SHF_WRITE},
    read::elf::{ElfFile32, FileHeader, ProgramHeader, SectionHeader},
};
use std::{fs, path::Path};

/// Bytes of memory.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Size {
    /// What is loaded: code, constants, and the first values of variables.
    pub flash: u64,
    /// Variables, without the stack.
    pub ram: u64,
}

impl Size {
    /// The size of the image in a file.
    pub fn read(path: &Path) -> Result<Self> {
        let data = fs::read(path).with_context(|| path.display().to_string())?;
        Self::of(&data).with_context(|| path.display().to_string())
    }

    fn of(data: &[u8]) -> Result<Self> {
        let file = ElfFile32::<object::Endianness>::parse(data)?;
        let endian = file.endian();
        let loads = file.elf_header().program_headers(endian, data)?.iter();
        let loads = loads.filter(|segment| segment.p_type(endian) == PT_LOAD);
        let sections = file.elf_header().section_headers(endian, data)?.iter();
        let variables = sections.filter(|section| {
            let wanted = SHF_ALLOC | SHF_WRITE;
            section.sh_flags(endian) & wanted == wanted
        });
        Ok(Self {
            flash: loads.map(|segment| u64::from(segment.p_filesz(endian))).sum(),
            ram: variables.map(|section| u64::from(section.sh_size(endian))).sum(),
        })
    }
}
