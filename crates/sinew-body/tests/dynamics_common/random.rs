//! Numbers that look random and are the same in every run (xorshift, Marsaglia 2003).

pub struct Random(u64);

impl Random {
    pub fn new(seed: u64) -> Random {
        Random(seed.wrapping_mul(0x9E37_79B9_7F4A_7C15) | 1)
    }

    /// Between −1 and 1.
    pub fn next(&mut self) -> f64 {
        self.0 ^= self.0 << 13;
        self.0 ^= self.0 >> 7;
        self.0 ^= self.0 << 17;
        (self.0 >> 11) as f64 / (1_u64 << 52) as f64 - 1.0
    }

    pub fn vector(&mut self, scale: f64) -> glam::DVec3 {
        glam::DVec3::new(self.next(), self.next(), self.next()) * scale
    }

    pub fn rotation(&mut self) -> glam::DQuat {
        loop {
            let q = glam::DQuat::from_xyzw(self.next(), self.next(), self.next(), self.next());
            if q.length_squared() > 0.01 {
                return q.normalize();
            }
        }
    }

    pub fn numbers(&mut self, count: usize, scale: f64) -> Vec<f64> {
        (0..count).map(|_| self.next() * scale).collect()
    }
}
