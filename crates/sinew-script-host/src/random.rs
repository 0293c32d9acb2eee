//! The module `random`: pseudo-random numbers from the scene's seed.

pub(super) use random::module_def;

#[rustpython_vm::pymodule(name = "random")]
pub(super) mod random {
    use crate::stage;
    use rustpython_vm::function::ArgIntoFloat;
    use rustpython_vm::{PyObjectRef, PyResult, VirtualMachine};

    /// From 0 up to but not 1, in steps of 2⁻⁵³. SplitMix64 (Steele, Lea, Flood 2014).
    fn next() -> f64 {
        let bits = stage::with(|stage| {
            stage.random = stage.random.wrapping_add(0x9e37_79b9_7f4a_7c15);
            let mut bits = stage.random;
            bits = (bits ^ (bits >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
            bits = (bits ^ (bits >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
            bits ^ (bits >> 31)
        });
        (bits >> 11) as f64 / (1u64 << 53) as f64
    }

    #[pyfunction]
    fn seed(seed: i64) {
        stage::with(|stage| stage.random = seed.cast_unsigned());
    }

    #[pyfunction(name = "random")]
    fn unit() -> f64 {
        next()
    }

    #[pyfunction]
    fn uniform(a: ArgIntoFloat, b: ArgIntoFloat) -> f64 {
        let (a, b) = (a.into_float(), b.into_float());
        a + (b - a) * next()
    }

    /// Normal distribution by Box and Muller; the second number of each pair is dropped, so that the seed is the whole state.
    #[pyfunction]
    fn gauss(mu: ArgIntoFloat, sigma: ArgIntoFloat) -> f64 {
        let (length, angle) = (next(), next());
        let normal = (-2.0 * libm::log(1.0 - length)).sqrt() * libm::cos(std::f64::consts::TAU * angle);
        mu.into_float() + sigma.into_float() * normal
    }

    /// Both ends are included.
    #[pyfunction]
    fn randint(a: i64, b: i64, vm: &VirtualMachine) -> PyResult<i64> {
        let count = i128::from(b) - i128::from(a) + 1;
        if count < 1 {
            return Err(vm.new_value_error(format!("nothing lies between {a} and {b}")));
        }
        let step = (next() * count as f64) as i128;
        Ok(i64::try_from(i128::from(a) + step.min(count - 1)).unwrap_or(b))
    }

    #[pyfunction]
    fn choice(of: PyObjectRef, vm: &VirtualMachine) -> PyResult {
        let count = of.length(vm)?;
        if count == 0 {
            return Err(vm.new_index_error("nothing to choose from"));
        }
        of.get_item(&((next() * count as f64) as usize).min(count - 1), vm)
    }

    /// In place, from the end (Fisher and Yates; Knuth, The Art of Computer Programming 2, algorithm 3.4.2P).
    #[pyfunction]
    fn shuffle(of: PyObjectRef, vm: &VirtualMachine) -> PyResult<()> {
        for last in (1..of.length(vm)?).rev() {
            let other = ((next() * (last + 1) as f64) as usize).min(last);
            let (a, b) = (of.get_item(&last, vm)?, of.get_item(&other, vm)?);
            of.set_item(&last, b, vm)?;
            of.set_item(&other, a, vm)?;
        }
        Ok(())
    }

    /// `k` of them, none twice, in random order.
    #[pyfunction]
    fn sample(of: PyObjectRef, k: usize, vm: &VirtualMachine) -> PyResult {
        let mut from: Vec<PyObjectRef> = of.try_to_value(vm)?;
        if k > from.len() {
            return Err(vm.new_value_error("Sample larger than population or is negative"));
        }
        for place in 0..k {
            let count = from.len() - place;
            from.swap(place, place + ((next() * count as f64) as usize).min(count - 1));
        }
        from.truncate(k);
        Ok(vm.ctx.new_list(from).into())
    }
}
