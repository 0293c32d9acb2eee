//! The interpreter, reduced to what a controller needs.

use super::{character, console, devices, maths, random, words};
use rustpython_vm::builtins::PyTypeRef;
use rustpython_vm::common::rc::PyRc;
use rustpython_vm::compiler::Mode;
use rustpython_vm::scope::Scope;
use rustpython_vm::{Interpreter, InterpreterBuilder, PyPayload, PyResult, Settings, VirtualMachine};
use std::cell::OnceCell;

/// Our Python prelude: vectors, and the filter of imports.
const PRELUDE: &str = include_str!("prelude.py");

/// What `math` and the built-in functions lack, in Python.
const STANDARD: &str = include_str!("standard.py");

/// Parts of RustPython that a controller does not need. Without `host_env` it has no files, sockets, processes or signals to
/// begin with; these hold a clock and ways to run bytes as code.
const REMOVED: [&str; 6] = ["time", "marshal", "atexit", "_symtable", "gc", "errno"];

/// Built-in functions that are removed.
const REMOVED_FUNCTIONS: [&str; 3] = ["open", "input", "breakpoint"];

/// Maximum call depth, as in CPython.
const NESTING: usize = 1000;

thread_local! {
    static VECTOR: OnceCell<PyTypeRef> = const { OnceCell::new() };
}

/// The class `Vector` of the prelude.
pub(super) fn vector_class(vm: &VirtualMachine) -> PyTypeRef {
    VECTOR.with(|class| class.get().cloned()).unwrap_or_else(|| vm.ctx.types.tuple_type.to_owned())
}

pub(super) fn new() -> Interpreter {
    let mut settings = Settings::default();
    // Same text, same order of everything.
    settings.hash_seed = Some(0);
    settings.ignore_environment = true;
    settings.import_site = false;
    settings.install_signal_handlers = false;
    settings.isolated = true;
    settings.safe_path = true;
    settings.user_site_directory = false;
    settings.write_bytecode = false;
    let builder = InterpreterBuilder::new().settings(settings);
    let modules = [
        character::module_def(&builder.ctx),
        console::module_def(&builder.ctx),
        devices::module_def(&builder.ctx),
        maths::module_def(&builder.ctx),
        random::module_def(&builder.ctx),
        words::module_def(&builder.ctx),
    ];
    let builder = builder.add_native_modules(&modules).init_hook(|vm| {
        if let Some(state) = PyRc::get_mut(&mut vm.state) {
            for name in REMOVED {
                state.module_defs.remove(name);
            }
        }
    });
    let interpreter = builder.build();
    interpreter.enter_and_expect(prepare, "the interpreter cannot be prepared");
    interpreter
}

fn prepare(vm: &VirtualMachine) -> PyResult<()> {
    vm.recursion_limit.set(NESTING);
    for module in ["_console", "_character", "_devices", "_words"] {
        vm.import(module, 0)?;
    }
    for name in ["stdout", "stderr", "__stdout__", "__stderr__"] {
        vm.sys_module.set_attr(vm.ctx.intern_str(name), console::Console {}.into_pyobject(vm), vm)?;
    }
    for name in REMOVED_FUNCTIONS {
        vm.builtins.dict().del_item(name, vm)?;
    }
    let standard = run(vm, STANDARD)?;
    let real = vm.builtins.get_attr("round", vm)?;
    let round = standard.globals.get_item("_rounded", vm)?.call((real,), vm)?;
    vm.builtins.set_attr("round", round, vm)?;
    let scope = run(vm, PRELUDE)?;
    let class = scope.globals.get_item("Vector", vm)?.try_into_value::<PyTypeRef>(vm)?;
    VECTOR.with(|kept| drop(kept.set(class)));
    // From here on a script can import what it is told of and nothing else.
    let gate = scope.globals.get_item("gate", vm)?;
    let real = vm.builtins.get_attr("__import__", vm)?;
    let gate = gate.call((real,), vm)?;
    vm.builtins.set_attr("__import__", gate, vm)
}

/// Runs a text of our own in a scope of its own.
fn run(vm: &VirtualMachine, text: &str) -> PyResult<Scope> {
    let code =
        vm.compile(text, Mode::Exec, "<sinew>".to_owned()).map_err(|error| vm.new_syntax_error(&error, Some(text)))?;
    let scope = vm.new_scope_with_builtins();
    scope.globals.set_item("__name__", vm.ctx.new_str("sinew").into(), vm)?;
    vm.run_code_obj(code, scope.clone())?;
    Ok(scope)
}
