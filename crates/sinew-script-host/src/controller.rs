//! The controller: the instance of the script's class, called in every step.

use super::state::{self, Defined, Kept};
use super::{fault, words};
use rustpython_vm::builtins::{PyDictRef, PyType};
use rustpython_vm::compiler::Mode;
use rustpython_vm::{PyObjectRef, PyResult, VirtualMachine};
use sinew_script::{ScriptError, ScriptErrorKind};

pub(super) struct Controller {
    file: String,
    class: String,
    pub instance: PyObjectRef,
    /// The global variables of its module, and the names that the text defines.
    pub globals: PyDictRef,
    pub defined: Defined,
    /// Set while `start()` or `reload()` is still to be called; holds the previous instance, if there was one.
    pub before: Option<Option<PyObjectRef>>,
    /// An exception was raised: it is no longer called.
    pub is_stopped: bool,
}

impl Controller {
    /// Compiles a text and creates an instance of its class.
    pub fn load(vm: &VirtualMachine, source: &str, file: &str, class: &str) -> Result<Controller, ScriptError> {
        let (instance, globals, defined) = instance(vm, source, file, class)?;
        Ok(Controller {
            file: file.to_owned(),
            class: class.to_owned(),
            instance,
            globals,
            defined,
            before: Some(None),
            is_stopped: false,
        })
    }

    /// Continues with another text; with the present one if the new one is invalid.
    pub fn reload(&mut self, vm: &VirtualMachine, source: &str) -> Result<(), ScriptError> {
        let new;
        (new, self.globals, self.defined) = instance(vm, source, &self.file, &self.class)?;
        self.before = Some(Some(std::mem::replace(&mut self.instance, new)));
        self.is_stopped = false;
        Ok(())
    }

    /// Compiles a text, creates the instance and restores a saved state.
    pub fn restore(&mut self, vm: &VirtualMachine, source: &str, kept: Option<&Kept>) -> Result<(), ScriptError> {
        *self = Controller::load(vm, source, &self.file, &self.class)?;
        let Some(kept) = kept else { return Ok(()) };
        state::restore(vm, self, kept).map_err(|exception| fault::of_exception(vm, &exception, &self.file))
    }

    /// Calls `start()` if it is still to be called, then `step()`.
    pub fn step(&mut self, vm: &VirtualMachine) -> Result<(), ScriptError> {
        if self.is_stopped {
            return Ok(());
        }
        let called = self.call(vm);
        called.map_err(|exception| {
            self.is_stopped = true;
            fault::of_exception(vm, &exception, &self.file)
        })
    }

    fn call(&mut self, vm: &VirtualMachine) -> PyResult<()> {
        if let Some(before) = self.before.take() {
            let method = |name| vm.get_attribute_opt(self.instance.clone(), name);
            match (before, method("reload")?, method("start")?) {
                (Some(old), Some(reload), _) => drop(reload.call((old,), vm)?),
                (_, _, Some(start)) => drop(start.call((), vm)?),
                _ => {}
            }
        }
        vm.call_method(&self.instance, "step", ()).map(drop)
    }
}

/// An instance of the class, the global variables of the text, and the names that it defines.
fn instance(
    vm: &VirtualMachine,
    source: &str,
    file: &str,
    class: &str,
) -> Result<(PyObjectRef, PyDictRef, Defined), ScriptError> {
    let code = vm
        .compile(source, Mode::Exec, file.to_owned())
        .map_err(|error| fault::of_compiler(vm, &error, source, file))?;
    let wrong =
        |message: String| ScriptError { kind: ScriptErrorKind::Text, file: file.to_owned(), line: None, message };
    let raised = |exception| fault::of_exception(vm, &exception, file);
    let scope = vm.new_scope_with_builtins();
    words::offer(vm, &scope.globals).map_err(raised)?;
    let offered: Vec<String> = classes(vm, &scope.globals);
    vm.run_code_obj(code, scope.clone()).map_err(raised)?;
    let Some(made) = scope.globals.get_item_opt(class, vm).map_err(raised)? else {
        let own: Vec<String> = classes(vm, &scope.globals).into_iter().filter(|name| !offered.contains(name)).collect();
        let found = if own.is_empty() { "it has none".to_owned() } else { format!("it has: {}", own.join(", ")) };
        return Err(wrong(format!("there is no class {class} in the file; {found}")));
    };
    let instance = made.call((), vm).map_err(raised)?;
    match vm.get_attribute_opt(instance.clone(), "step").map_err(raised)? {
        Some(step) if step.is_callable() => {
            let defined = Defined::of(vm, &scope.globals);
            Ok((instance, scope.globals.clone(), defined))
        }
        _ => Err(wrong(format!("class {class} has no step(self), which is called in every step"))),
    }
}

/// Names of the classes in a scope.
fn classes(vm: &VirtualMachine, globals: &rustpython_vm::builtins::PyDictRef) -> Vec<String> {
    let items = globals.items_vec();
    let classes = items.iter().filter(|(_, value)| value.downcast_ref::<PyType>().is_some());
    classes.filter_map(|(name, _)| Some(super::cut(&name.str(vm).ok()?.to_string_lossy(), 60))).take(30).collect()
}
