//! Python controllers of a scene.

use super::error::Fault;
use schemars::JsonSchema;
use serde::Deserialize;

/// A Python controller: a class with `start()` and `step()`, in a file or in the scene itself.
#[derive(Clone, Debug, Default, PartialEq, Deserialize, JsonSchema)]
#[serde(default, deny_unknown_fields)]
pub struct ControllerSpec {
    /// The file, relative to the scene's folder.
    pub file: Option<String>,
    /// The Python text, in place of a file.
    pub text: Option<String>,
    /// The class; the table's own name when left out.
    pub class: Option<String>,
}

impl ControllerSpec {
    pub(super) fn check(&self, name: &str) -> Result<(), Fault> {
        let at = |key| ["controllers", name, key];
        match (&self.file, &self.text) {
            (Some(_), Some(_)) => return Err(Fault::at(&at("text"), "there is a file too; keep one of file and text")),
            (None, None) => {
                let problem = "it has no Python; add file = \"NAME.py\" or text = \"\"\"...\"\"\"";
                return Err(Fault::at(&["controllers", name], problem));
            }
            _ => {}
        }
        let (key, class) = match &self.class {
            Some(class) => (&at("class")[..], class.as_str()),
            None => (&["controllers", name][..], name),
        };
        let mut letters = class.chars();
        let sound = letters.next().is_some_and(|first| first.is_alphabetic() || first == '_')
            && letters.all(|letter| letter.is_alphanumeric() || letter == '_');
        if !sound {
            return Err(Fault::at(key, "this cannot be the name of a Python class; add class = \"NAME\""));
        }
        Ok(())
    }
}
