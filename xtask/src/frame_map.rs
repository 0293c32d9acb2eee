//! The picture of a frame's data flow, `docs/frame.svg`: written by `cargo xtask frame-map`, and held to this file by a test.
//!
//! SVG by hand and not by a library: it is a dozen boxes and arrows, and nothing in this package depends on anything.

use std::fmt::Write;

/// A box: a headline, lines below it, and the edge of its left upper corner with its size, all in pixels.
struct Block {
    title: &'static str,
    lines: &'static [&'static str],
    left: i32,
    top: i32,
    width: i32,
    height: i32,
    fill: &'static str,
}

/// An arrow through points, with a label at a place of its own; dashed for what comes from the step before.
struct Arrow {
    points: &'static [(i32, i32)],
    label: &'static str,
    at: (i32, i32),
    is_dashed: bool,
}

const WIDTH: i32 = 1200;
const HEIGHT: i32 = 520;
const LINE: i32 = 19;

const PHYSICS: &str = "#e6efe4";
const MOTION: &str = "#e4ebf5";
const CONTROL: &str = "#f7eddc";
const READER: &str = "#efefef";

const BLOCKS: [Block; 7] = [
    Block {
        title: "commands",
        lines: &["scene [[at]] [[when]] [keys]", "take · network · program", "scripts (Python, own process)"],
        left: 30,
        top: 60,
        width: 240,
        height: 100,
        fill: CONTROL,
    },
    Block {
        title: "sources",
        lines: &[
            "clip",
            "key poses, pose graphs",
            "live performer",
            "reach",
            "(one is current; an",
            "understudy stands by)",
        ],
        left: 30,
        top: 220,
        width: 190,
        height: 158,
        fill: MOTION,
    },
    Block {
        title: "wanted pose",
        lines: &["joint rotations, velocities", "root: free or placed", "gains; reflexes add torques"],
        left: 265,
        top: 245,
        width: 210,
        height: 102,
        fill: MOTION,
    },
    Block {
        title: "tracker",
        lines: &[
            "kinematic: pose as it is",
            "pd: joint springs",
            "kd: springs and pins",
            "response: dynamics",
            "none: limp",
        ],
        left: 520,
        top: 225,
        width: 190,
        height: 140,
        fill: MOTION,
    },
    Block {
        title: "world",
        lines: &["springs, pins, limits as", "rows of the solver", "contacts, warm start", "sub-steps × sweeps"],
        left: 760,
        top: 235,
        width: 180,
        height: 120,
        fill: PHYSICS,
    },
    Block {
        title: "Frame",
        lines: &["poses, velocities,", "contacts, support,", "external forces, hash"],
        left: 990,
        top: 245,
        width: 180,
        height: 102,
        fill: PHYSICS,
    },
    Block {
        title: "readers",
        lines: &["recording, report, take", "pictures, BVH, glTF, CSV", "session clients, VMC out"],
        left: 950,
        top: 60,
        width: 220,
        height: 100,
        fill: READER,
    },
];

const ARROWS: [Arrow; 9] = [
    Arrow { points: &[(125, 160), (125, 220)], label: "", at: (0, 0), is_dashed: false },
    Arrow {
        points: &[(270, 110), (615, 110), (615, 225)],
        label: "typed orders, before the step",
        at: (300, 102),
        is_dashed: false,
    },
    Arrow {
        points: &[(615, 110), (850, 110), (850, 235)],
        label: "pushes, props, gravity",
        at: (640, 102),
        is_dashed: false,
    },
    Arrow { points: &[(220, 296), (265, 296)], label: "", at: (0, 0), is_dashed: false },
    Arrow { points: &[(475, 296), (520, 296)], label: "", at: (0, 0), is_dashed: false },
    Arrow { points: &[(710, 296), (760, 296)], label: "", at: (0, 0), is_dashed: false },
    Arrow { points: &[(940, 296), (990, 296)], label: "", at: (0, 0), is_dashed: false },
    Arrow { points: &[(1080, 245), (1080, 160)], label: "each motion frame", at: (936, 208), is_dashed: false },
    Arrow {
        points: &[(1080, 347), (1080, 440), (16, 440), (16, 110), (30, 110)],
        label: "the Frame of the step before: sensors of scripts, [[when]], graphs, reflexes and trackers",
        at: (330, 432),
        is_dashed: true,
    },
];

/// Lines below the boxes that say what runs at which rate.
const RATES: [&str; 2] = [
    "every physics step (physics_hz, default 240 Hz): commands, scripts, sources, reflexes, pd and kd, world, Frame",
    "every motion frame (motion_hz, default 60 Hz, a whole number of physics steps): kinematic and response, readers",
];

/// The picture as SVG.
pub fn svg() -> String {
    let mut svg = String::new();
    let family = "font-family=\"sans-serif\"";
    put(
        &mut svg,
        format_args!(
            "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 {WIDTH} {HEIGHT}\" width=\"{WIDTH}\" height=\"{HEIGHT}\" {family}>"
        ),
    );
    put(&mut svg, format_args!("<title>How the data of a frame flows through a stage</title>"));
    put(
        &mut svg,
        format_args!(
            "<defs><marker id=\"tip\" viewBox=\"0 0 8 8\" refX=\"7\" refY=\"4\" markerWidth=\"8\" markerHeight=\"8\" \
             orient=\"auto\"><path d=\"M0 0L8 4L0 8z\"/></marker></defs>"
        ),
    );
    put(&mut svg, format_args!("<rect width=\"{WIDTH}\" height=\"{HEIGHT}\" fill=\"white\"/>"));
    put(
        &mut svg,
        format_args!("<text x=\"30\" y=\"34\" font-size=\"20\" font-weight=\"bold\">One step of a stage</text>"),
    );
    for arrow in &ARROWS {
        draw_arrow(&mut svg, arrow);
    }
    for block in &BLOCKS {
        draw_block(&mut svg, block);
    }
    for (at, text) in (0..).zip(RATES) {
        put(&mut svg, format_args!("<text x=\"30\" y=\"{}\" font-size=\"14\">{text}</text>", 474 + 22 * at));
    }
    svg.push_str("</svg>\n");
    svg
}

fn draw_arrow(svg: &mut String, arrow: &Arrow) {
    let points: Vec<String> = arrow.points.iter().map(|(x, y)| format!("{x},{y}")).collect();
    let dash = if arrow.is_dashed { " stroke-dasharray=\"7 5\"" } else { "" };
    put(
        svg,
        format_args!(
            "<polyline points=\"{}\" fill=\"none\" stroke=\"black\" stroke-width=\"1.6\"{dash} marker-end=\"url(#tip)\"/>",
            points.join(" ")
        ),
    );
    let (x, y) = arrow.at;
    if !arrow.label.is_empty() {
        put(
            svg,
            format_args!("<text x=\"{x}\" y=\"{y}\" font-size=\"14\" font-style=\"italic\">{}</text>", arrow.label),
        );
    }
}

fn draw_block(svg: &mut String, block: &Block) {
    let Block { title, lines, left, top, width, height, fill } = *block;
    put(
        svg,
        format_args!(
            "<rect x=\"{left}\" y=\"{top}\" width=\"{width}\" height=\"{height}\" rx=\"6\" fill=\"{fill}\" stroke=\"black\"/>"
        ),
    );
    let x = left + 12;
    put(svg, format_args!("<text x=\"{x}\" y=\"{}\" font-size=\"16\" font-weight=\"bold\">{title}</text>", top + 24));
    for (at, line) in lines.iter().enumerate() {
        let y = top + 46 + LINE * i32::try_from(at).unwrap_or(0);
        put(svg, format_args!("<text x=\"{x}\" y=\"{y}\" font-size=\"14\">{line}</text>"));
    }
}

/// Writing to a string cannot fail.
fn put(svg: &mut String, line: std::fmt::Arguments<'_>) {
    let _ = writeln!(svg, "{line}");
}
