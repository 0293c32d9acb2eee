//! One of several things with names, as a user tells it: by name, or by number from 1.

use crate::{Error, Place};

/// Names that a message lists.
const LISTED: usize = 20;
/// Characters of a name that are compared, so that a long one costs nothing.
const COMPARED: usize = 64;

/// The name that a misspelt one is nearest to, if one is near: by insertions, deletions, substitutions and swaps of letters
/// (Damerau and Levenshtein), at most one and a quarter of the name's letters; case does not count.
///
/// ```
/// assert_eq!(sinew_motion::nearest_name("gaurd", ["stand", "guard"]), Some("guard"));
/// assert_eq!(sinew_motion::nearest_name("fly", ["stand", "guard"]), None);
/// ```
pub fn nearest_name<'a>(wanted: &str, names: impl IntoIterator<Item = &'a str>) -> Option<&'a str> {
    let compared = |name: &str| name.chars().take(COMPARED).collect::<String>().to_lowercase();
    let wanted = compared(wanted);
    let distance = |name: &'a str| (strsim::damerau_levenshtein(&wanted, &compared(name)), name);
    let near = |(distance, name): &(usize, &str)| {
        let letters = name.chars().count();
        *distance < letters && *distance <= 1 + letters / 4
    };
    names.into_iter().map(distance).min().filter(near).map(|(_, name)| name)
}

/// Index of the one that `wanted` tells. Each has one or more names; an exact name comes before one in another case, and a
/// name before a number. `what` is the word for one and for many: `("animation", "animations")`.
///
/// # Errors
/// None is called so: the error lists all, with their numbers.
pub(crate) fn choose(what: (&str, &str), wanted: &str, names: &[Vec<&str>]) -> Result<usize, Error> {
    let wanted = wanted.trim();
    let find = |same: &dyn Fn(&str) -> bool| names.iter().position(|names| names.iter().any(|name| same(name)));
    let number =
        || wanted.parse::<usize>().ok().and_then(|number| number.checked_sub(1)).filter(|at| *at < names.len());
    let lower = wanted.to_lowercase();
    if let Some(at) =
        find(&|name| name == wanted).or_else(|| find(&|name| name.to_lowercase() == lower)).or_else(number)
    {
        return Ok(at);
    }
    let near = nearest_name(wanted, names.iter().flatten().copied());
    let near = near.map_or(String::new(), |name| format!("did you mean {name:?}? "));
    let wanted: String = wanted.chars().take(COMPARED).collect();
    let problem = format!("no {} {wanted:?} among its {} {}", what.0, names.len(), what.1);
    Err(Error::new(Place::File, problem, format!("{near}there are {}", listed(names.iter().map(|names| names[0])))))
}

/// `1 "Run", 2 "Walk"`: names with the numbers by which they can be told, cut short when there are many.
pub(crate) fn listed<'a>(names: impl ExactSizeIterator<Item = &'a str>) -> String {
    let count = names.len();
    let mut text: Vec<String> =
        names.take(LISTED).enumerate().map(|(at, name)| format!("{} {name:?}", at + 1)).collect();
    if count > LISTED {
        text.push(format!("and {} more", count - LISTED));
    }
    text.join(", ")
}

#[cfg(test)]
mod tests {
    use super::choose;

    const WHAT: (&str, &str) = ("animation", "animations");

    #[test]
    fn a_name_comes_before_a_number_and_an_exact_name_before_another_case() {
        let names = [vec!["run"], vec!["Run"], vec!["1"], vec!["Armature", "Hips"]];
        for (wanted, at) in [("Run", 1), ("RUN", 0), ("1", 2), ("2", 1), ("hips", 3), (" 4 ", 3)] {
            assert_eq!(choose(WHAT, wanted, &names).unwrap(), at, "{wanted}");
        }
    }

    #[test]
    fn an_unknown_one_is_refused_with_all_that_there_are_and_the_nearest() {
        let names = [vec!["Run"], vec!["Walk"]];
        let error = choose(WHAT, "Wlak", &names).unwrap_err().to_string();
        for word in ["\"Wlak\"", "did you mean \"Walk\"", "1 \"Run\", 2 \"Walk\""] {
            assert!(error.contains(word), "{error}");
        }
        for wanted in ["0", "3", "-1", ""] {
            assert!(choose(WHAT, wanted, &names).is_err(), "{wanted}");
        }
    }
}
