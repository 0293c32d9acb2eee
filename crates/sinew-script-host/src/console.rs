//! Standard output of a script: `print` is captured for the reply.

pub(super) use console::{Console, module_def};

#[rustpython_vm::pymodule(name = "_console")]
pub(super) mod console {
    use crate::stage;
    use rustpython_vm::{PyPayload, VirtualMachine, builtins::PyStrRef, pyclass};

    #[pyattr]
    #[pyclass(name = "Console")]
    #[derive(Debug, PyPayload)]
    pub(crate) struct Console {}

    #[pyclass]
    impl Console {
        #[pymethod]
        fn write(&self, text: PyStrRef, _vm: &VirtualMachine) -> usize {
            stage::with(|stage| stage.print(&text.to_string_lossy()));
            text.char_len()
        }

        #[pymethod]
        fn flush(&self) {}
    }
}
