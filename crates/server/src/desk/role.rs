//! What parameters are for, as the page is told: the roles of the devices' guides, by name.

use devices::guide;
use serde::Serialize;
use ts_rs::TS;
use utoipa::ToSchema;

/// Declares the roles once for both sides; one that the guides have and this list has not does not compile.
macro_rules! roles {
    ($($name:ident),* $(,)?) => {
        /// What a parameter is for.
        #[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, TS, ToSchema)]
        #[serde(rename_all = "snake_case")]
        pub(crate) enum Role {
            $(#[doc = concat!("See `", stringify!($name), "` of the guides.")] $name,)*
        }

        impl From<guide::Role> for Role {
            fn from(role: guide::Role) -> Self {
                match role {
                    $(guide::Role::$name => Self::$name,)*
                }
            }
        }
    };
}

roles! {
    HighSpeed, LowSpeed, Acceleration, Deceleration, OwnDeceleration, SCurve, SpeedWindow, ClosedLoop, ClosedLoopRatio,
    PulserEnable, Microsteps, PulseDivisor, RampDivisor,
}
