//! Constants of standing balance.

/// How a body balances.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct BalanceSettings {
    /// How firmly the centre of pressure answers to the capture point's distance from where it should rest: that distance
    /// shrinks by this share times √(g/h) a second \[1\].
    pub firmness: f64,
    /// Where the weight rests along a sole, from the heel \[1 of its length\].
    pub rest_share: f64,
    /// The centre of pressure stays so far from the edges of a sole \[1 of the stature\].
    pub edge_margin: f64,
    /// Frequency with which hips and trunk come back upright \[Hz\].
    pub upright_hz: f64,
    /// Damping ratio of that \[1\].
    pub upright_damping: f64,
    /// Largest moment with which the trunk is thrown after a fall \[1 of m g h\].
    pub trunk_moment: f64,
    /// How far the trunk may lean in such a throw: forward, backward, sideways \[rad\].
    pub trunk_lean: [f64; 3],
    /// How far the arms swing \[rad\]; 0 leaves them alone.
    pub arm_swing: f64,
}

impl Default for BalanceSettings {
    fn default() -> BalanceSettings {
        BalanceSettings {
            firmness: 3.0,
            rest_share: 0.42,
            edge_margin: 0.004,
            upright_hz: 0.8,
            upright_damping: 0.9,
            trunk_moment: 0.12,
            trunk_lean: [0.6, 0.25, 0.3],
            arm_swing: 0.8,
        }
    }
}
