//! A Python exception as an error with its line.

use super::cut;
use rustpython_vm::builtins::PyBaseExceptionRef;
use rustpython_vm::compiler::CompileError;
use rustpython_vm::{AsObject, VirtualMachine};
use sinew_script::ScriptError;

/// Characters of Python's own words that are kept.
const MAX_MESSAGE: usize = 2000;

/// An exception that nobody caught. Its line is the innermost one that stands in the script.
pub(super) fn of_exception(vm: &VirtualMachine, exception: &PyBaseExceptionRef, file: &str) -> ScriptError {
    let (mut line, mut next) = (None, exception.__traceback__());
    while let Some(entry) = next {
        if entry.frame.code.source_path().as_str() == file {
            line = u32::try_from(entry.lineno.get()).ok();
        }
        next = entry.next.lock().clone();
    }
    ScriptError { file: file.to_owned(), line, message: words(vm, exception) }
}

/// A text that is no Python.
pub(super) fn of_compiler(vm: &VirtualMachine, error: &CompileError, source: &str, file: &str) -> ScriptError {
    let (line, _) = error.python_location();
    let exception = vm.new_syntax_error(error, Some(source));
    let kind = exception.class().name().to_string();
    let message = exception.get_arg(0).and_then(|words| Some(words.str(vm).ok()?.to_string_lossy().into_owned()));
    let message = format!("{kind}: {}", cut(&message.unwrap_or_else(|| error.to_string()), MAX_MESSAGE));
    ScriptError { file: file.to_owned(), line: u32::try_from(line).ok().filter(|&line| line > 0), message }
}

/// "ValueError: ...". The exception's `__str__` may be the script's own and raise again.
fn words(vm: &VirtualMachine, exception: &PyBaseExceptionRef) -> String {
    let kind = exception.class().name().to_string();
    match exception.as_object().str(vm) {
        Ok(words) if words.is_empty() => kind,
        Ok(words) => format!("{kind}: {}", cut(&words.to_string_lossy(), MAX_MESSAGE)),
        Err(_) => kind,
    }
}
