//! What the project's pages say, as far as a machine can hold them to it.

/// The cells of every row of the table under a heading (`## Rooms`).
pub fn rows(page: &str, heading: &str) -> Vec<Vec<String>> {
    let section = page.lines().skip_while(|line| *line != heading).skip(1).take_while(|line| !line.starts_with("## "));
    let rows = section.filter(|line| line.starts_with('|')).skip(2);
    let cells = |row: &str| row.trim_matches('|').split('|').map(|cell| cell.trim().to_owned()).collect();
    rows.map(cells).collect()
}

/// The first cell of every row of the table under a heading, without its backticks.
pub fn first_cells(page: &str, heading: &str) -> Vec<String> {
    let firsts = rows(page, heading).into_iter().filter_map(|row| row.into_iter().next());
    firsts.map(|cell| cell.trim_matches('`').to_owned()).collect()
}

/// Targets of the page's links, without what follows a `#`; links to elsewhere and to places on the page itself left out.
pub fn relative_links(page: &str) -> Vec<String> {
    let targets = page.split("](").skip(1).filter_map(|rest| rest.split(')').next());
    let paths = targets.filter_map(|target| target.split('#').next());
    paths.filter(|path| !path.is_empty() && !path.contains("://")).map(str::to_owned).collect()
}

/// What stands in backticks and looks like a path of the repository: it has a `/` and begins with one of its folders.
pub fn named_paths(page: &str, folders: &[String]) -> Vec<String> {
    let mut fenced = false;
    let mut paths = Vec::new();
    for line in page.lines() {
        if line.starts_with("```") {
            fenced = !fenced;
        } else if !fenced {
            let quoted = line.split('`').skip(1).step_by(2);
            let is_path = |text: &&str| match text.split_once('/') {
                Some((folder, _)) => folders.iter().any(|known| known == folder) && !text.contains([' ', '*']),
                None => false,
            };
            paths.extend(quoted.filter(is_path).map(str::to_owned));
        }
    }
    paths
}

/// The lines of the page's shell blocks.
pub fn shell_lines(page: &str) -> Vec<String> {
    let mut inside = false;
    let mut lines: Vec<String> = Vec::new();
    let mut continued = false;
    for line in page.lines() {
        if line.starts_with("```") {
            inside = line == "```sh";
        } else if inside {
            let (text, more) = match line.strip_suffix('\\') {
                Some(text) => (text, true),
                None => (line, false),
            };
            let text = text.split(" #").next().unwrap_or_default().trim();
            match lines.last_mut() {
                Some(last) if continued => *last = format!("{last} {text}"),
                _ => lines.push(text.to_owned()),
            }
            continued = more;
        }
    }
    lines.retain(|line| !line.is_empty() && !line.starts_with('#'));
    lines
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn shell_lines_lose_their_remarks_and_are_joined() {
        let page = "```sh\n# first\nsinew inspect a.bvh   # what is it\nsinew respond \\\n  a.bvh\n```\n```rust\nlet a;\n```\n";
        assert_eq!(shell_lines(page), ["sinew inspect a.bvh", "sinew respond a.bvh"]);
    }

    #[test]
    fn links_to_elsewhere_are_not_ours() {
        let page = "[a](docs/a.png) [b](https://example.org) [c](#there) [d](B.md#part)";
        assert_eq!(relative_links(page), ["docs/a.png", "B.md"]);
    }

    #[test]
    fn the_first_cells_are_those_of_the_section() {
        let page = "## Other\n| x | y |\n|---|---|\n| z | |\n## Rooms\n| crate | for |\n|---|---|\n| `a` | 1 |\n| `b` | 2 |\n## End\n| c |";
        assert_eq!(first_cells(page, "## Rooms"), ["a", "b"]);
    }
}
