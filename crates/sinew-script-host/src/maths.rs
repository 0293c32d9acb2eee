//! The module `math`: libm's functions, whose bits are the same on every machine.

pub(super) use math::module_def;

#[rustpython_vm::pymodule(name = "math")]
pub(super) mod math {
    use rustpython_vm::function::{ArgIntoFloat, OptionalArg, PosArgs};
    use rustpython_vm::{FromArgs, PyObjectRef, PyResult, VirtualMachine};

    #[pyattr]
    #[allow(non_upper_case_globals, reason = "Python's name")]
    const pi: f64 = std::f64::consts::PI;
    #[pyattr]
    #[allow(non_upper_case_globals, reason = "Python's name")]
    const tau: f64 = std::f64::consts::TAU;
    #[pyattr]
    #[allow(non_upper_case_globals, reason = "Python's name")]
    const e: f64 = std::f64::consts::E;
    #[pyattr]
    #[allow(non_upper_case_globals, reason = "Python's name")]
    const inf: f64 = f64::INFINITY;
    #[pyattr]
    #[allow(non_upper_case_globals, reason = "Python's name")]
    const nan: f64 = f64::NAN;

    /// Python's own errors: no answer, or one too large.
    fn checked(vm: &VirtualMachine, result: f64, arguments: &[f64]) -> PyResult<f64> {
        if result.is_nan() && !arguments.iter().any(|argument| argument.is_nan()) {
            return Err(vm.new_value_error("math domain error"));
        }
        if result.is_infinite() && arguments.iter().all(|argument| argument.is_finite()) {
            return Err(vm.new_overflow_error("math range error"));
        }
        Ok(result)
    }

    fn one(vm: &VirtualMachine, x: ArgIntoFloat, function: fn(f64) -> f64) -> PyResult<f64> {
        let x = x.into_float();
        checked(vm, function(x), &[x])
    }

    fn two(vm: &VirtualMachine, x: ArgIntoFloat, y: ArgIntoFloat, function: fn(f64, f64) -> f64) -> PyResult<f64> {
        let (x, y) = (x.into_float(), y.into_float());
        checked(vm, function(x, y), &[x, y])
    }

    #[pyfunction]
    fn sqrt(x: ArgIntoFloat, vm: &VirtualMachine) -> PyResult<f64> {
        one(vm, x, f64::sqrt)
    }
    #[pyfunction]
    fn exp(x: ArgIntoFloat, vm: &VirtualMachine) -> PyResult<f64> {
        one(vm, x, libm::exp)
    }
    #[pyfunction]
    fn sin(x: ArgIntoFloat, vm: &VirtualMachine) -> PyResult<f64> {
        one(vm, x, libm::sin)
    }
    #[pyfunction]
    fn cos(x: ArgIntoFloat, vm: &VirtualMachine) -> PyResult<f64> {
        one(vm, x, libm::cos)
    }
    #[pyfunction]
    fn tan(x: ArgIntoFloat, vm: &VirtualMachine) -> PyResult<f64> {
        one(vm, x, libm::tan)
    }
    #[pyfunction]
    fn asin(x: ArgIntoFloat, vm: &VirtualMachine) -> PyResult<f64> {
        one(vm, x, libm::asin)
    }
    #[pyfunction]
    fn acos(x: ArgIntoFloat, vm: &VirtualMachine) -> PyResult<f64> {
        one(vm, x, libm::acos)
    }
    #[pyfunction]
    fn atan(x: ArgIntoFloat, vm: &VirtualMachine) -> PyResult<f64> {
        one(vm, x, libm::atan)
    }
    #[pyfunction]
    fn sinh(x: ArgIntoFloat, vm: &VirtualMachine) -> PyResult<f64> {
        one(vm, x, libm::sinh)
    }
    #[pyfunction]
    fn cosh(x: ArgIntoFloat, vm: &VirtualMachine) -> PyResult<f64> {
        one(vm, x, libm::cosh)
    }
    #[pyfunction]
    fn tanh(x: ArgIntoFloat, vm: &VirtualMachine) -> PyResult<f64> {
        one(vm, x, libm::tanh)
    }
    #[pyfunction]
    fn cbrt(x: ArgIntoFloat, vm: &VirtualMachine) -> PyResult<f64> {
        one(vm, x, libm::cbrt)
    }
    #[pyfunction]
    fn exp2(x: ArgIntoFloat, vm: &VirtualMachine) -> PyResult<f64> {
        one(vm, x, libm::exp2)
    }
    #[pyfunction]
    fn expm1(x: ArgIntoFloat, vm: &VirtualMachine) -> PyResult<f64> {
        one(vm, x, libm::expm1)
    }
    #[pyfunction]
    fn asinh(x: ArgIntoFloat, vm: &VirtualMachine) -> PyResult<f64> {
        one(vm, x, libm::asinh)
    }
    #[pyfunction]
    fn acosh(x: ArgIntoFloat, vm: &VirtualMachine) -> PyResult<f64> {
        one(vm, x, libm::acosh)
    }
    #[pyfunction]
    fn atanh(x: ArgIntoFloat, vm: &VirtualMachine) -> PyResult<f64> {
        one(vm, x, libm::atanh)
    }
    #[pyfunction]
    fn erf(x: ArgIntoFloat, vm: &VirtualMachine) -> PyResult<f64> {
        one(vm, x, libm::erf)
    }
    #[pyfunction]
    fn erfc(x: ArgIntoFloat, vm: &VirtualMachine) -> PyResult<f64> {
        one(vm, x, libm::erfc)
    }
    #[pyfunction]
    fn log1p(x: ArgIntoFloat, vm: &VirtualMachine) -> PyResult<f64> {
        let x = x.into_float();
        if x <= -1.0 { Err(vm.new_value_error("math domain error")) } else { Ok(libm::log1p(x)) }
    }
    #[pyfunction]
    fn remainder(x: ArgIntoFloat, y: ArgIntoFloat, vm: &VirtualMachine) -> PyResult<f64> {
        two(vm, x, y, libm::remainder)
    }
    #[pyfunction]
    fn modf(x: ArgIntoFloat) -> (f64, f64) {
        let (part, whole) = libm::modf(x.into_float());
        (part, whole)
    }
    #[pyfunction]
    fn fabs(x: ArgIntoFloat, vm: &VirtualMachine) -> PyResult<f64> {
        one(vm, x, f64::abs)
    }
    #[pyfunction]
    fn degrees(x: ArgIntoFloat, vm: &VirtualMachine) -> PyResult<f64> {
        one(vm, x, f64::to_degrees)
    }
    #[pyfunction]
    fn radians(x: ArgIntoFloat, vm: &VirtualMachine) -> PyResult<f64> {
        one(vm, x, f64::to_radians)
    }
    #[pyfunction]
    fn atan2(y: ArgIntoFloat, x: ArgIntoFloat, vm: &VirtualMachine) -> PyResult<f64> {
        two(vm, y, x, libm::atan2)
    }
    #[pyfunction]
    fn pow(x: ArgIntoFloat, y: ArgIntoFloat, vm: &VirtualMachine) -> PyResult<f64> {
        two(vm, x, y, libm::pow)
    }
    #[pyfunction]
    fn fmod(x: ArgIntoFloat, y: ArgIntoFloat, vm: &VirtualMachine) -> PyResult<f64> {
        two(vm, x, y, libm::fmod)
    }
    #[pyfunction]
    fn copysign(x: ArgIntoFloat, y: ArgIntoFloat, vm: &VirtualMachine) -> PyResult<f64> {
        two(vm, x, y, f64::copysign)
    }
    #[pyfunction]
    fn log(x: ArgIntoFloat, base: OptionalArg<ArgIntoFloat>, vm: &VirtualMachine) -> PyResult<f64> {
        let natural = logarithm(vm, x.into_float(), libm::log)?;
        match base.into_option() {
            Some(base) => {
                let base = logarithm(vm, base.into_float(), libm::log)?;
                if base == 0.0 { Err(vm.new_zero_division_error("division by zero")) } else { Ok(natural / base) }
            }
            None => Ok(natural),
        }
    }
    #[pyfunction]
    fn log2(x: ArgIntoFloat, vm: &VirtualMachine) -> PyResult<f64> {
        logarithm(vm, x.into_float(), libm::log2)
    }
    #[pyfunction]
    fn log10(x: ArgIntoFloat, vm: &VirtualMachine) -> PyResult<f64> {
        logarithm(vm, x.into_float(), libm::log10)
    }

    fn logarithm(vm: &VirtualMachine, x: f64, function: fn(f64) -> f64) -> PyResult<f64> {
        if x <= 0.0 { Err(vm.new_value_error("math domain error")) } else { Ok(function(x)) }
    }

    #[pyfunction]
    fn hypot(numbers: PosArgs<ArgIntoFloat>, vm: &VirtualMachine) -> PyResult<f64> {
        let numbers: Vec<f64> = numbers.into_iter().map(ArgIntoFloat::into_float).collect();
        checked(vm, numbers.iter().fold(0.0, |length, &number| libm::hypot(length, number)), &numbers)
    }

    #[pyfunction]
    fn isfinite(x: ArgIntoFloat) -> bool {
        x.into_float().is_finite()
    }
    #[pyfunction]
    fn isinf(x: ArgIntoFloat) -> bool {
        x.into_float().is_infinite()
    }
    #[pyfunction]
    fn isnan(x: ArgIntoFloat) -> bool {
        x.into_float().is_nan()
    }

    #[derive(FromArgs)]
    struct Close {
        #[pyarg(positional)]
        a: ArgIntoFloat,
        #[pyarg(positional)]
        b: ArgIntoFloat,
        #[pyarg(named, optional)]
        rel_tol: OptionalArg<ArgIntoFloat>,
        #[pyarg(named, optional)]
        abs_tol: OptionalArg<ArgIntoFloat>,
    }

    #[pyfunction]
    fn isclose(close: Close) -> bool {
        let (a, b) = (close.a.into_float(), close.b.into_float());
        let or = |given: OptionalArg<ArgIntoFloat>, usual| given.into_option().map_or(usual, ArgIntoFloat::into_float);
        let (rel_tol, abs_tol) = (or(close.rel_tol, 1e-9), or(close.abs_tol, 0.0));
        a == b || (a - b).is_finite() && (a - b).abs() <= (rel_tol * a.abs().max(b.abs())).max(abs_tol)
    }

    #[pyfunction]
    fn floor(x: PyObjectRef, vm: &VirtualMachine) -> PyResult {
        vm.call_method(&x, "__floor__", ())
    }
    #[pyfunction]
    fn ceil(x: PyObjectRef, vm: &VirtualMachine) -> PyResult {
        vm.call_method(&x, "__ceil__", ())
    }
    #[pyfunction]
    fn trunc(x: PyObjectRef, vm: &VirtualMachine) -> PyResult {
        vm.call_method(&x, "__trunc__", ())
    }
}
