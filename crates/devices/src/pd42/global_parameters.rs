//! The global parameters of the PD42-1140 (manual, chapter 5, tables 18 and 20). Bank 2 is the user
//! variables, 256 of them, of which the first [`STORABLE_VARIABLES`] can be stored (table 19).

use crate::parameter::parameters;

const MAX: i32 = i32::MAX;

/// How many user variables can be stored.
pub const STORABLE_VARIABLES: u8 = 56;

/// Bank 0: the module.
pub mod module {
    use super::{MAX, parameters};

    parameters! {
        /// All global parameters of bank 0, by number.
        TABLE {
            65 BAUD_RATE GPRS485BaudRate, "RS485 baud rate" [0, 8] RWA = 0 ""
                "0 9600 to 8 230400 bit/s, from the next start on." gp_65_and_69_rates;
            66 SERIAL_ADDRESS GPSerialAddress, "Serial address" [1, 255] RWA = 1 ""
                "Address of the module on RS-485." gp_66_serial_address;
            67 ASCII_MODE GPASCIIMode, "ASCII mode" [0, 63] RWA = 0 ""
                "Bit 0 starts in ASCII mode, bits 4 and 5 choose the echo." gp_67_ascii_mode;
            68 SERIAL_HEARTBEAT GPSerialHeartbeat, "Serial heartbeat" [0, 65535] RWA = 0 "ms"
                "A longer silence on RS-485 and USB stops the motor; 0 never." gp_68_serial_heartbeat;
            69 CAN_BIT_RATE GPCANBitRate, "CAN bit rate" [2, 8] RWA = 8 ""
                "2 20 kbit/s to 8 1 Mbit/s, from the next start on." gp_65_and_69_rates;
            70 CAN_REPLY_ID GPCANReplyId, "CAN reply ID" [0, 2047] RWA = 2 ""
                "Identifier of the module's CAN replies." gp_70_and_71_can_ids;
            71 CAN_ID GPCANId, "CAN ID" [0, 2047] RWA = 1 ""
                "Identifier that the module listens to." gp_70_and_71_can_ids;
            75 TELEGRAM_PAUSE GPTelegramPauseTime, "Telegram pause time" [0, 255] RWA = 0 "ms"
                "Pause before a reply on RS-485." gp_75_telegram_pause;
            76 HOST_ADDRESS GPSerialHostAddress, "Serial host address" [0, 255] RWA = 2 ""
                "First byte of serial replies." gp_76_host_address;
            77 AUTO_START GPAutoStart, "Auto start mode" [0, 1] RWA = 0 ""
                "1 starts the program at power-up." gp_77_auto_start;
            79 SWITCH_POLARITY GPEndSwitchPolarity, "End switch polarity" [0, 1] RWA = 0 ""
                "1 inverts both stop switches." gp_79_switch_polarity;
            81 CODE_PROTECTION GPTMCLCodeProtection, "TMCL code protection" [0, 3] RWA = 0 ""
                "Bit 0 against reading, bit 1 against overwriting; giving up bit 0 erases the program." gp_81_code_protection;
            82 CAN_HEARTBEAT GPCANHeartbeat, "CAN heartbeat" [0, 65535] RWA = 0 "ms"
                "A longer silence on CAN stops the motor; 0 never." gp_82_can_heartbeat;
            83 CAN_SECONDARY_ID GPCANSecondaryId, "CAN secondary address" [0, 2047] RWA = 0 ""
                "Commands to this identifier are executed and not answered; 0 off." gp_83_secondary_can_id;
            84 COORDINATE_STORAGE GPCoordinateStorage, "Coordinate storage" [0, 1] RWA = 0 ""
                "1 stores every coordinate when it is set and restores them at power-up." gp_84_coordinate_storage;
            85 KEEP_VARIABLES_OUT GPDoNotRestoreUserVariables, "Do not restore user variables" [0, 1] RWA = 0 ""
                "1 leaves the user variables at 0 at power-up." gp_85_do_not_restore;
            87 SECONDARY_ADDRESS GPSerialSecondaryAddress, "Serial secondary address" [0, 255] RWA = 0 ""
                "Commands to this address are executed and not answered; 0 off." gp_87_secondary_address;
            90 REVERSE_SHAFT GPReverseShaft, "Reverse shaft" [0, 1] RWA = 0 ""
                "1 turns motor and encoder the other way." gp_90_reverse_shaft;
            128 PROGRAM_STATUS GPTMCLApplicationStatus, "TMCL application status" [0, 3] R = 0 ""
                "0 stop, 1 run, 2 step, 3 reset." gp_128_to_130_program;
            129 DOWNLOAD_MODE GPDownloadMode, "Download mode" [0, 1] R = 0 ""
                "1 while commands are stored instead of executed." gp_128_to_130_program;
            130 PROGRAM_COUNTER GPTMCLProgramCounter, "TMCL program counter" [0, 2047] R = 0 ""
                "Address of the present program command." gp_128_to_130_program;
            132 TICK_TIMER GPTickTimer, "TMCL tick timer" [0, MAX] RW = 0 "ms"
                "Counts milliseconds; can be set." gp_132_tick_timer;
            133 RANDOM GPRandomNumber, "Random number" [0, MAX] RW = 0 ""
                "A new random number at each reading; writing sets the seed." gp_133_random;
            255 SUPPRESS_REPLY GPSuppressReply, "Suppress reply" [0, 1] RW = 0 ""
                "1 leaves out all replies but those of GAP, GGP and GIO." gp_255_suppress_reply;
        }
    }
}

/// Bank 3: interrupts.
pub mod interrupts {
    use super::parameters;

    parameters! {
        /// All global parameters of bank 3; each has the number of its interrupt.
        TABLE {
            0 TIMER_0 GPTimer0Period, "Timer 0 period" [0, -1] RW = 0 "ms"
                "Time between two interrupts of timer 0; 0 off." bank_3_timers;
            1 TIMER_1 GPTimer1Period, "Timer 1 period" [0, -1] RW = 0 "ms"
                "Time between two interrupts of timer 1; 0 off." bank_3_timers;
            2 TIMER_2 GPTimer2Period, "Timer 2 period" [0, -1] RW = 0 "ms"
                "Time between two interrupts of timer 2; 0 off." bank_3_timers;
            27 STOP_LEFT GPStopLeftTrigger, "Stop left 0 trigger transition" [0, 3] RW = 0 ""
                "0 off, 1 low-high, 2 high-low, 3 both." bank_3_triggers;
            28 STOP_RIGHT GPStopRightTrigger, "Stop right 0 trigger transition" [0, 3] RW = 0 ""
                "0 off, 1 low-high, 2 high-low, 3 both." bank_3_triggers;
            39 INPUT_0 GPInput0Trigger, "Input 0 trigger transition" [0, 3] RW = 0 ""
                "0 off, 1 low-high, 2 high-low, 3 both." bank_3_triggers;
            40 INPUT_1 GPInput1Trigger, "Input 1 trigger transition" [0, 3] RW = 0 ""
                "0 off, 1 low-high, 2 high-low, 3 both." bank_3_triggers;
            41 INPUT_2 GPInput2Trigger, "Input 2 trigger transition" [0, 3] RW = 0 ""
                "0 off, 1 low-high, 2 high-low, 3 both." bank_3_triggers;
            42 INPUT_3 GPInput3Trigger, "Input 3 trigger transition" [0, 3] RW = 0 ""
                "0 off, 1 low-high, 2 high-low, 3 both." bank_3_triggers;
        }
    }
}
