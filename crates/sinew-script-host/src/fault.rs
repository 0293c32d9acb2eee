//! Converts Python exceptions and syntax errors to `ScriptError`, with their line.

use super::cut;
use rustpython_vm::builtins::PyBaseExceptionRef;
use rustpython_vm::compiler::CompileError;
use rustpython_vm::{AsObject, VirtualMachine};
use sinew_script::{ScriptError, ScriptErrorKind};

/// Maximum length of Python's own message \[characters\].
const MAX_MESSAGE: usize = 2000;

/// An uncaught exception. Its line is that of the innermost frame in the script.
pub(super) fn of_exception(vm: &VirtualMachine, exception: &PyBaseExceptionRef, file: &str) -> ScriptError {
    let (mut line, mut next) = (None, exception.__traceback__());
    while let Some(entry) = next {
        if entry.frame.code.source_path().as_str() == file {
            line = u32::try_from(entry.lineno.get()).ok();
        }
        next = entry.next.lock().clone();
    }
    ScriptError { kind: ScriptErrorKind::Raised, file: file.to_owned(), line, message: words(vm, exception) }
}

/// A syntax error.
pub(super) fn of_compiler(vm: &VirtualMachine, error: &CompileError, source: &str, file: &str) -> ScriptError {
    let (line, _) = error.python_location();
    let exception = vm.new_syntax_error(error, Some(source));
    let kind = exception.class().name().to_string();
    let message = exception.get_arg(0).and_then(|words| Some(words.str(vm).ok()?.to_string_lossy().into_owned()));
    let message = format!("{kind}: {}", cut(&message.unwrap_or_else(|| error.to_string()), MAX_MESSAGE));
    let line = u32::try_from(line).ok().filter(|&line| line > 0);
    ScriptError { kind: ScriptErrorKind::Text, file: file.to_owned(), line, message }
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
