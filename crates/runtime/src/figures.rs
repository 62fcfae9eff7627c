//! Counters of what the main loop and the player have done, since the start.

/// How things stand.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Figures {
    /// How often the controller's clock had to wait.
    pub slips: u32,
    /// For how many timer ticks in all.
    pub slipped_ticks: u64,
    /// Timer ticks that the main loop was awake, without the player's interrupt.
    pub awake_ticks: u64,
    /// Timer ticks in the player's interrupt.
    pub player_ticks: u64,
    /// Pulses played, of all axes.
    pub pulses: u64,
    /// Times that the controller was advanced.
    pub advances: u64,
    /// Replies that were dropped because the port had no room.
    pub dropped_replies: u32,
}
