//! Constants of standing balance.

/// Settings of the balance reflex.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct BalanceSettings {
    /// Gain of the centre of pressure on the capture point's distance from its resting point: that distance shrinks by
    /// this share times √(g/h) a second \[1\].
    pub firmness: f64,
    /// Resting position of the weight along a sole, from the heel \[1 of its length\].
    pub rest_share: f64,
    /// Margin of the centre of pressure to the edges of a sole \[1 of the stature\].
    pub edge_margin: f64,
    /// Return frequency of hips and trunk to upright \[Hz\].
    pub upright_hz: f64,
    /// Damping ratio of that \[1\].
    pub upright_damping: f64,
    /// Maximum moment of the trunk against a fall \[1 of m g h\].
    pub trunk_moment: f64,
    /// Maximum lean of the trunk: forward, backward, sideways \[rad\].
    pub trunk_lean: [f64; 3],
    /// Maximum swing of the arms \[rad\]; 0 switches it off.
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
