//! The table of words: PMX manual, tables 10.0 and those of section 7; CMD manual, table 5-42. To add one, add
//! an entry here; compiler, compiled lines, decompiler and documentation follow.

#[cfg(feature = "std")]
use super::Doc;
use super::Index::{AnalogInput, Enable, Input, Output, Port, Program, PwmOutput, Subroutine, Variable};
use super::Kind::{Action, Command, Comment, Register, Structure};
use super::Suffix::{Axis, Direction, Helix, Home, Index, None, Plane, Target, Targets};
use super::{Access, Entry, Kind};

/// What a family's programs can do with a word, in the words of the table below.
macro_rules! access {
    (-) => {
        Option::None
    };
    (R) => {
        Some(Access::Read)
    };
    (W) => {
        Some(Access::Write)
    };
    (RW) => {
        Some(Access::ReadWrite)
    };
    (F) => {
        Some(Access::Flow)
    };
}

macro_rules! words {
    ($($number:literal $word:ident $name:literal $kind:expr, $suffix:expr, $performax:tt $commander:tt,
        $pmx_section:literal $cmd_section:literal $summary:literal $example:literal $test:literal;)*) => {
        /// A word. The manual may give one name to several, as `DO` and `DO[1-8]`.
        #[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
        #[repr(u8)]
        pub enum Word {
            $(#[doc = $summary] $word = $number,)*
        }

        /// The words, an entry each.
        pub static TABLE: &[Entry] = &[$(Entry {
            word: Word::$word,
            name: $name,
            kind: $kind,
            suffix: $suffix,
            performax: access!($performax),
            commander: access!($commander),
            #[cfg(feature = "std")]
            doc: Doc {
                performax_section: $pmx_section,
                commander_section: $cmd_section,
                summary: $summary,
                example: $example,
                test: $test,
            },
        },)*];
    };
}

// The number stands in compiled lines, which devices keep in flash: it is never given to another word.
// Then name, kind, suffix, access of Performax and Commander programs, their manuals' sections, what it
// does, an example, and the test that holds it.
words! {
    1 Comment ";" Comment, None, F F,
        "10.1" "5.2" "Begins a comment, which ends with the line." ";a comment" "comments";
    2 Prg "PRG" Structure, Index(Program), F F,
        "7.19.2" "2.7.1" "Begins a program." "PRG 0" "programs";
    3 End "END" Structure, None, F F,
        "10.1" "2.7.1" "Ends a program." "END" "programs";
    4 Sub "SUB" Structure, Index(Subroutine), F F,
        "7.19.4" "2.7.4" "Begins a subroutine." "SUB 1" "subroutines";
    5 EndSub "ENDSUB" Structure, None, F F,
        "7.19.4" "2.7.4" "Ends a subroutine." "ENDSUB" "subroutines";
    6 Gosub "GOSUB" Structure, Index(Subroutine), F F,
        "7.19.4" "2.7.4" "Executes a subroutine." "GOSUB 1" "subroutines";
    7 If "IF" Structure, None, F F,
        "10.1" "2.7.2" "Executes the statements behind it if the condition holds." "IF DI1=1" "branches";
    8 ElseIf "ELSEIF" Structure, None, F F,
        "10.1" "2.7.2" "Another condition, for when those before it do not hold." "ELSEIF V1&7!=0" "branches";
    9 Else "ELSE" Structure, None, F F,
        "10.1" "2.7.2" "What to execute when no condition holds." "ELSE" "branches";
    10 EndIf "ENDIF" Structure, None, F F,
        "10.1" "2.7.2" "Ends what began with IF." "ENDIF" "branches";
    11 While "WHILE" Structure, None, F F,
        "10.1" "2.7.2" "Repeats the statements behind it while the condition holds." "WHILE V1<10" "loops";
    12 EndWhile "ENDWHILE" Structure, None, F F,
        "10.1" "2.7.2" "Ends what began with WHILE." "ENDWHILE" "loops";
    13 V "V" Kind::Variable, Index(Variable), RW RW,
        "7.19.6" "2.7.6" "A variable." "V1=V2+1" "variables";

    20 Abort "ABORT" Action, None, W W,
        "7.7" "2.2.3" "Stops all axes at once." "ABORT" "stopping";
    21 AbortAxis "ABORT" Action, Axis, W W,
        "7.7" "2.2.3" "Stops an axis at once." "ABORTX" "stopping";
    22 Stop "STOP" Action, None, W W,
        "7.7" "2.2.3" "Stops all axes with deceleration." "STOP" "stopping";
    23 StopAxis "STOP" Action, Axis, W W,
        "7.7" "2.2.3" "Stops an axis with deceleration." "STOPX" "stopping";
    24 Abs "ABS" Action, None, W W,
        "7.8" "2.2.4.1" "Targets are positions from now on." "ABS" "modes";
    25 Inc "INC" Action, None, W W,
        "7.8" "2.2.4.1" "Targets are distances from now on." "INC" "modes";
    26 Eclear "ECLEAR" Action, Axis, W W,
        "7.11" "2.1.3.1.1.1" "Clears the errors of an axis." "ECLEARX" "errors_and_settings";
    27 Store "STORE" Action, None, W W,
        "7.20" "2.1.1.1" "Writes the settings to flash." "STORE" "errors_and_settings";
    28 Wait "WAIT" Action, Axis, W W,
        "10.1" "5.2" "Waits until an axis stands still." "WAITX" "waiting";
    29 Delay "DELAY" Command, None, W W,
        "10.1" "5.2" "Waits for so many milliseconds." "DELAY=1000" "waiting";
    30 Sr "SR" Command, Index(Program), W W,
        "7.19.2" "2.7.8" "Stops (0), starts (1), pauses (2) or continues (3) a program." "SR0=1" "program_control";
    31 Jog "JOG" Action, Direction, W W,
        "7.6" "2.2.2" "Moves an axis until it is stopped." "JOGX+" "jogging";
    32 Home "HOME" Action, Home, W W,
        "7.10.1" "2.2.5" "Searches home at high speed; on the Commander as the mode says." "HOMEX-0" "homing";
    33 HlHome "HLHOME" Action, Direction, W -,
        "7.10.5" "" "Searches home at high speed, then at low speed." "HLHOMEX+" "homing";
    34 LHome "LHOME" Action, Direction, W -,
        "7.10.2" "" "Searches home at a limit switch." "LHOMEX+" "homing";
    35 ZHome "ZHOME" Action, Direction, W -,
        "7.10.3" "" "Searches home, then the Z-index." "ZHOMEX+" "homing";
    36 Zome "ZOME" Action, Direction, W -,
        "7.10.4" "" "Searches the Z-index." "ZOMEX-" "homing";
    37 ZMove "ZMOVE" Action, Direction, - W,
        "" "2.2.5.1" "Moves by a number of Z-index pulses." "ZMOVEX+" "homing";
    38 X "X" Action, Target, W W,
        "7.8.1" "2.2.4.2" "Moves axis X." "X1000" "moves";
    39 Y "Y" Action, Target, W W,
        "7.8.1" "2.2.4.2" "Moves axis Y." "Y-1000" "moves";
    40 Z "Z" Action, Target, - W,
        "" "2.2.4.2" "Moves axis Z." "ZV1" "moves";
    41 U "U" Action, Target, - W,
        "" "2.2.4.2" "Moves axis U." "U0" "moves";
    42 Linear "" Action, Targets, W W,
        "7.8.2" "2.3.1" "Moves several axes along a line." "X1000Y2000" "moves";
    43 Cir "CIR" Action, Plane(2), - W,
        "" "2.3.2" "Moves two axes around a circle: its centre." "CIRXYP1000:0" "arcs";
    44 Arc "ARC" Action, Plane(3), - W,
        "" "2.3.2.1" "Moves two axes along an arc: its centre, and the angle of its end." "ARCXYN0:1000:90000" "arcs";
    45 CirT "CIRT" Action, Helix(3), - W,
        "" "2.3.3" "Moves X and Y around a circle, and Z along a line: centre, and Z's position."
        "CIRTP1000:0:500" "arcs";
    46 ArcT "ARCT" Action, Helix(4), - W,
        "" "2.3.3" "Moves X and Y along an arc, and Z along a line: centre, angle, and Z's position."
        "ARCTN0:1000:90000:V1" "arcs";
    47 BufOn "BUFON" Action, None, - W,
        "" "2.3.4" "Moves go to the buffer from now on." "BUFON" "buffer";
    48 BufOff "BUFOFF" Action, None, - W,
        "" "2.3.4" "Moves are executed at once from now on." "BUFOFF" "buffer";
    49 IStart "ISTART" Action, None, - W,
        "" "2.3.4" "Executes the moves in the buffer." "ISTART" "buffer";
    50 SynOn "SYNON" Action, Axis, - W,
        "" "2.1.3.2.2" "Enables the synchronization output of an axis." "SYNONX" "synchronization";
    51 SynOff "SYNOFF" Action, Axis, - W,
        "" "2.1.3.2.2" "Disables the synchronization output of an axis." "SYNOFFX" "synchronization";

    60 Hspd "HSPD" Register, None, RW RW,
        "7.1" "2.1.4" "High speed of all axes that have none of their own." "HSPD=1000" "speeds";
    61 HspdAxis "HSPD" Register, Axis, RW RW,
        "7.1" "2.1.4" "High speed of an axis." "HSPDX=V1" "speeds";
    62 Lspd "LSPD" Register, None, RW RW,
        "7.1" "2.1.4" "Low speed of all axes that have none of their own." "LSPD=100" "speeds";
    63 LspdAxis "LSPD" Register, Axis, RW RW,
        "7.1" "2.1.4" "Low speed of an axis." "LSPDX=100" "speeds";
    64 Acc "ACC" Register, None, RW RW,
        "7.1" "2.1.4" "Acceleration in ms of all axes that have none of their own." "ACC=300" "speeds";
    65 AccAxis "ACC" Register, Axis, RW RW,
        "7.1" "2.1.4" "Acceleration of an axis in ms." "ACCX=V1" "speeds";
    66 Dec "DEC" Register, None, RW RW,
        "7.1" "2.1.4" "Deceleration in ms of all axes that have none of their own." "DEC=300" "speeds";
    67 DecAxis "DEC" Register, Axis, RW RW,
        "7.1" "2.1.4" "Deceleration of an axis in ms." "DECX=300" "speeds";
    68 Scv "SCV" Register, Axis, RW -,
        "7.1" "" "Whether an axis accelerates along an S-curve." "SCVX=1" "speeds";
    69 Sspd "SSPD" Register, Axis, W W,
        "7.3" "2.4.1" "Changes the speed of an axis in motion." "SSPDX=V1" "speeds";
    70 SspdM "SSPDM" Register, Axis, W W,
        "7.3" "2.4.1" "The window of speeds for changes in motion." "SSPDMX=1" "speeds";

    71 P "P" Register, Axis, RW RW,
        "7.4" "2.6.1.1" "Position of an axis in pulses." "PX=0" "positions";
    72 E "E" Register, Axis, RW RW,
        "7.4" "2.6.1.2" "Position of an encoder." "EX=0" "positions";
    73 Ps "PS" Register, Axis, R R,
        "7.2" "2.6.2.2" "Speed of an axis." "V1=PSX" "positions";
    74 Mst "MST" Register, Axis, R R,
        "7.12" "2.6.2.1" "Status of an axis." "V1=MSTX&7" "positions";

    75 Di "DI" Register, None, R R,
        "7.13.1" "2.1.3.2.1" "All digital inputs." "V1=DI" "inputs_and_outputs";
    76 DiBit "DI" Register, Index(Input), R R,
        "7.13.1" "2.1.3.2.1" "A digital input." "IF DI1=0" "inputs_and_outputs";
    77 Do "DO" Register, None, RW RW,
        "7.13.2" "2.1.3.2.2" "All digital outputs." "DO=2" "inputs_and_outputs";
    78 DoBit "DO" Register, Index(Output), RW RW,
        "7.13.2" "2.1.3.2.2" "A digital output." "DO2=1" "inputs_and_outputs";
    79 Eo "EO" Register, None, RW RW,
        "7.5" "2.1.2.1" "All enable outputs." "EO=3" "inputs_and_outputs";
    80 EoBit "EO" Register, Index(Enable), RW RW,
        "7.5" "2.1.2.1" "The enable output of an axis." "EO1=1" "inputs_and_outputs";
    81 Ai "AI" Register, Index(AnalogInput), R R,
        "7.14" "2.1.3.3.2" "An analog input in mV." "WHILE AI2>2500" "inputs_and_outputs";
    82 Io "IO" Register, None, - RW,
        "" "2.1.3.3.1" "All configurable inputs and outputs." "IO=64" "inputs_and_outputs";
    83 IoBit "IO" Register, Index(Port), - RW,
        "" "2.1.3.3.1" "A configurable input or output." "IO7=1" "inputs_and_outputs";
    84 Eint "EINT" Register, None, - RW,
        "" "2.1.7" "Whether moves of several axes go along a line." "EINT=1" "modes";

    85 Sl "SL" Register, Axis, W RW,
        "7.17" "2.5.3" "Whether StepNLoop is on." "SLX=1" "step_n_loop";
    86 Sls "SLS" Register, Axis, R R,
        "7.17" "2.5.3" "Status of StepNLoop." "V3=SLSX" "step_n_loop";
    87 Toc "TOC" Register, None, W -,
        "7.18" "" "Time-out of the communication in ms." "TOC=1000" "errors_and_settings";

    88 JoyEna "JOYENA" Register, None, W RW,
        "7.15" "2.5.1" "Axes that follow the joystick, a bit each." "JOYENA=3" "joystick";
    89 JoyHs "JOYHS" Register, Axis, W RW,
        "7.15" "2.5.1.2" "High speed under the joystick." "JOYHSX=2000" "joystick";
    90 JoyDel "JOYDEL" Register, Axis, W W,
        "7.15" "2.5.1.2" "Most change of speed under the joystick." "JOYDELX=100" "joystick";
    91 JoyTol "JOYTOL" Register, Axis, W -,
        "7.15" "" "Half the width, in mV, of the zone in which the joystick rests." "JOYTOLX=200" "joystick";
    92 JoyNo "JOYNO" Register, Axis, W -,
        "7.15" "" "Negative outer limit of the joystick." "JOYNOX=-10000" "joystick";
    93 JoyNi "JOYNI" Register, Axis, W -,
        "7.15" "" "Negative inner limit of the joystick." "JOYNIX=-9000" "joystick";
    94 JoyPi "JOYPI" Register, Axis, W -,
        "7.15" "" "Positive inner limit of the joystick." "JOYPIX=9000" "joystick";
    95 JoyPo "JOYPO" Register, Axis, W -,
        "7.15" "" "Positive outer limit of the joystick." "JOYPOX=10000" "joystick";

    96 SynCfg "SYNCFG" Register, Axis, - RW,
        "" "2.1.3.2.2" "Condition and source of the synchronization output." "SYNCFGX=1" "synchronization";
    97 SynPos "SYNPOS" Register, Axis, - RW,
        "" "2.1.3.2.2" "Position, or distance, at which it acts." "SYNPOSX=V1" "synchronization";
    98 SynStat "SYNSTAT" Register, Axis, - R,
        "" "2.1.3.2.2" "Status of the synchronization output." "V1=SYNSTATX" "synchronization";

    99 MpgE "MPGE" Register, Axis, - RW,
        "" "2.1.3.1.4" "Whether an axis follows its manual pulse generator." "MPGEX=1" "latches_and_more";
    100 Pwm "PWM" Register, Index(PwmOutput), - RW,
        "" "2.1.3.3.3" "A PWM output in percent." "PWM1=25" "latches_and_more";
    101 Lt "LT" Register, Axis, - W,
        "" "2.1.3.2.1" "Whether the position latch of an axis waits for its input." "LTX=1" "latches_and_more";
    102 Lts "LTS" Register, Axis, - R,
        "" "2.1.3.2.1" "Status of the position latch." "WHILE LTSX=1" "latches_and_more";
    103 Lte "LTE" Register, Axis, - R,
        "" "2.1.3.2.1" "The encoder position that was latched." "V1=LTEX" "latches_and_more";
    104 Ltp "LTP" Register, Axis, - R,
        "" "2.1.3.2.1" "The pulse position that was latched." "V1=LTPX" "latches_and_more";
}

/// For each number the position of its word in the table, or [`NO_WORD`].
static POSITIONS: [u8; 256] = {
    let mut positions = [NO_WORD; 256];
    let mut position = 0;
    while position < TABLE.len() {
        positions[TABLE[position].word as usize] = position as u8;
        position += 1;
    }
    positions
};
const NO_WORD: u8 = u8::MAX;

/// Where in the table a word stands.
pub(super) fn position(word: Word) -> usize {
    usize::from(POSITIONS[word as usize])
}

/// The word of a number.
pub(super) fn by_number(number: u8) -> Option<Word> {
    TABLE.get(usize::from(POSITIONS[usize::from(number)])).map(|entry| entry.word)
}
