//! Conversion of arguments: Python objects to numbers and vectors, and vectors back.

use super::interpreter;
use rustpython_vm::builtins::{PyFloat, PyInt, PyList, PyTuple};
use rustpython_vm::{PyObject, PyObjectRef, PyPayload, PyResult, VirtualMachine};

/// Maps an error to Python's `ValueError`.
pub(super) fn raised<T>(vm: &VirtualMachine, result: Result<T, String>) -> PyResult<T> {
    result.map_err(|message| vm.new_value_error(message))
}

/// A finite number.
pub(super) fn number(vm: &VirtualMachine, value: &PyObject, what: &str) -> PyResult<f64> {
    let number = if let Some(float) = value.downcast_ref::<PyFloat>() {
        float.to_f64()
    } else if value.downcast_ref::<PyInt>().is_some() {
        value.try_float(vm)?.to_f64()
    } else {
        return Err(vm.new_type_error(format!("{what} must be a number, not {}", value.class().name())));
    };
    if number.is_finite() {
        Ok(number)
    } else {
        Err(vm.new_value_error(format!("{what} must be finite, not {number}")))
    }
}

/// A finite number, at least 0, if one is given.
pub(super) fn seconds(vm: &VirtualMachine, value: Option<&PyObjectRef>) -> PyResult<Option<f64>> {
    let Some(value) = value else { return Ok(None) };
    let secs = number(vm, value, "seconds")?;
    if secs >= 0.0 { Ok(Some(secs)) } else { Err(vm.new_value_error(format!("seconds must not be negative: {secs}"))) }
}

/// Three finite numbers.
pub(super) fn three(vm: &VirtualMachine, value: &PyObject, what: &str) -> PyResult<[f64; 3]> {
    let of = |elements: &[PyObjectRef]| match elements {
        [x, y, z] => Ok([number(vm, x, what)?, number(vm, y, what)?, number(vm, z, what)?]),
        _ => Err(vm.new_value_error(format!("{what} must be three numbers (x, y, z), not {}", elements.len()))),
    };
    if let Some(tuple) = value.downcast_ref::<PyTuple>() {
        of(tuple.as_slice())
    } else if let Some(list) = value.downcast_ref::<PyList>() {
        of(&list.borrow_vec())
    } else {
        let kind = value.class().name().to_string();
        Err(vm.new_type_error(format!("{what} must be three numbers (x, y, z), not {kind}")))
    }
}

/// A `Vector`.
pub(super) fn vector(vm: &VirtualMachine, numbers: [f64; 3]) -> PyResult {
    let elements: Box<[PyObjectRef]> = numbers.map(|number| vm.ctx.new_float(number).into()).into();
    Ok(PyTuple::new_unchecked(elements).into_ref_with_type(vm, interpreter::vector_class(vm))?.into())
}

/// A list of `Vector`s.
pub(super) fn vectors(vm: &VirtualMachine, points: &[[f64; 3]]) -> PyResult {
    let points: PyResult<Vec<PyObjectRef>> = points.iter().map(|&point| vector(vm, point)).collect();
    Ok(vm.ctx.new_list(points?).into())
}
