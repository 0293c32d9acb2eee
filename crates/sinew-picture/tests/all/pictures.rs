//! What a viewer relies on when reading a picture.

use crate::common;

use glam::{DQuat, DVec3};
use sinew_picture::{
    Arrow, Camera, Capsule, Cuboid, Figure, Filmstrip, Hit, Image, Limit, Mark, Panel, Plot, Series, Shade, Sheet,
    Style,
};

fn strip(panels: Vec<Panel>) -> Filmstrip {
    Filmstrip { panels, style: Style { width_px: 900, columns: 4, ..Style::default() }, ..Filmstrip::default() }
}

fn bare(figure: Figure) -> Panel {
    Panel { figure, follow: Some(DVec3::ZERO), ..Panel::default() }
}

fn trunk(shade: Shade) -> Capsule {
    Capsule::new(DVec3::new(0.0, 0.6, 0.0), DVec3::new(0.0, 1.5, 0.0), 0.15, shade)
}

/// Red, green, blue at a spot.
fn pixel(picture: &Image, spot: (f32, f32)) -> [u8; 3] {
    picture.pixel(spot.0 as u32, spot.1 as u32).expect("the spot should lie in the picture")
}

fn is_arrow(pixel: [u8; 3]) -> bool {
    pixel[0] > 150 && pixel[1] < 90 && pixel[2] < 150
}

fn is_body([red, green, blue]: [u8; 3]) -> bool {
    // The warm grey of trunks, in light or shadow; the sky is bluish.
    red > blue && green > blue
}

fn differing(one: &Image, other: &Image) -> usize {
    assert_eq!((one.width(), one.height()), (other.width(), other.height()));
    one.rgba().chunks_exact(4).zip(other.rgba().chunks_exact(4)).filter(|(one, other)| one != other).count()
}

#[test]
fn an_arrow_ends_at_the_point_of_application() {
    let at = DVec3::new(0.15, 1.2, 0.0);
    for (force_n, camera) in [
        (DVec3::new(-100.0, 0.0, 0.0), Camera::front()),
        (DVec3::new(0.0, -80.0, 60.0), Camera::side()),
        (DVec3::new(-70.0, 10.0, -80.0), Camera::three_quarter()),
    ] {
        let mut panel = bare(Figure::new(vec![trunk(Shade::Midline)]));
        panel.arrows = vec![Arrow { at, force_n, label: String::new() }];
        let strip = Filmstrip { camera, ..strip(vec![panel]) };
        let picture = strip.draw().unwrap();
        // 3 cm behind the tip the head is several pixels wide; 3 cm beyond it there is none of it.
        let back = strip.spot(0, at - force_n.normalize() * 0.03).unwrap();
        let beyond = strip.spot(0, at + force_n.normalize() * 0.03).unwrap();
        assert!(is_arrow(pixel(&picture, back)), "{:?}", pixel(&picture, back));
        assert!(!is_arrow(pixel(&picture, beyond)));
    }
}

#[test]
fn a_push_along_the_line_of_sight_still_shows() {
    let view = Camera::front().view();
    for force_n in [view.toward * 50.0, view.toward * -50.0] {
        let mut panel = bare(Figure::new(vec![trunk(Shade::Midline)]));
        let plain = Filmstrip { camera: Camera::front(), ..strip(vec![panel.clone()]) };
        panel.arrows = vec![Arrow { at: DVec3::Y, force_n, label: "x".to_owned() }];
        let pushed = Filmstrip { camera: Camera::front(), ..strip(vec![panel]) };
        let spot = pushed.spot(0, DVec3::Y).unwrap();
        assert!(is_arrow(pixel(&pushed.draw().unwrap(), spot)));
        assert!(!is_arrow(pixel(&plain.draw().unwrap(), spot)));
    }
}

#[test]
fn the_ghost_lies_behind_the_body() {
    let body = Figure::new(vec![trunk(Shade::Left)]);
    // The ghost is nearer to the viewer, and also stands out to the right.
    let ghost = Capsule::new(DVec3::new(0.0, 1.0, 0.5), DVec3::new(0.4, 1.0, 0.5), 0.1, Shade::Midline);
    let look = |ghost: Option<Figure>| {
        let strip = Filmstrip { camera: Camera::front(), ..strip(vec![Panel { ghost, ..bare(body.clone()) }]) };
        let spots = [DVec3::Y, DVec3::new(0.4, 1.0, 0.5)].map(|point| strip.spot(0, point).unwrap());
        let picture = strip.draw().unwrap();
        spots.map(|spot| pixel(&picture, spot))
    };
    let (with, without) = (look(Some(Figure::new(vec![ghost]))), look(None));
    assert_eq!(with[0], without[0], "the body should hide the ghost");
    assert_ne!(with[1], without[1], "the ghost should show beside the body");
}

#[test]
fn a_nearer_limb_hides_a_farther_one_whatever_their_order() {
    let near = Capsule::new(DVec3::new(-0.2, 1.0, 0.3), DVec3::new(0.2, 1.0, 0.3), 0.08, Shade::Left);
    let capsules = [trunk(Shade::Right), near];
    let draw = |capsules: Vec<Capsule>| {
        let strip = Filmstrip { camera: Camera::front(), ..strip(vec![bare(Figure::new(capsules))]) };
        (strip.draw().unwrap(), strip.spot(0, DVec3::new(0.0, 1.0, 0.38)).unwrap())
    };
    let (one, spot) = draw(capsules.to_vec());
    let (other, _) = draw(capsules.iter().rev().copied().collect());
    assert_eq!(differing(&one, &other), 0);
    let [red, _, blue] = pixel(&one, spot);
    assert!(blue > red, "the left limb, in front, is blue");
}

#[test]
fn a_limb_that_leads_past_another_is_hidden_only_where_it_lies_behind() {
    // An X seen from above: each leads past the other, on one side before it and on the other behind.
    let limb =
        |depth: f64, shade| Capsule::new(DVec3::new(-0.4, 1.0, depth), DVec3::new(0.4, 1.0, -depth), 0.06, shade);
    // Level, so that one lies exactly before the other.
    let camera = Camera { azimuth_rad: 0.0, elevation_rad: 0.0 };
    for capsules in
        [[limb(0.6, Shade::Left), limb(-0.5, Shade::Right)], [limb(0.5, Shade::Left), limb(-0.6, Shade::Right)]]
    {
        let strip = Filmstrip { camera, ..strip(vec![bare(Figure::new(capsules.to_vec()))]) };
        let picture = strip.draw().unwrap();
        let is_blue = |x: f64, z: f64| {
            let [red, _, blue] = pixel(&picture, strip.spot(0, DVec3::new(x, 1.0, z)).unwrap());
            blue > red
        };
        assert!(is_blue(-0.2, 0.3), "the left limb comes first at one end");
        assert!(!is_blue(0.2, 0.3), "the right limb at the other");
    }
}

#[test]
fn left_and_right_have_different_tints() {
    let side = |x: f64, shade| Capsule::new(DVec3::new(x, 0.6, 0.0), DVec3::new(x, 1.4, 0.0), 0.1, shade);
    let figure = Figure::new(vec![side(0.2, Shade::Left), side(-0.2, Shade::Right)]);
    let strip = Filmstrip { camera: Camera::front(), ..strip(vec![bare(figure)]) };
    let picture = strip.draw().unwrap();
    let at = |x: f64| pixel(&picture, strip.spot(0, DVec3::new(x, 1.0, 0.1)).unwrap());
    assert!(at(0.2)[2] > at(0.2)[0] + 40, "left is blue: {:?}", at(0.2));
    assert!(at(-0.2)[0] > at(-0.2)[2] + 40, "right is orange: {:?}", at(-0.2));
}

#[test]
fn same_input_gives_the_same_bytes() {
    let sheet = || Sheet {
        title: "Twice".to_owned(),
        pieces: vec![strip((0..3).map(|step| common::panel(0.3 * f64::from(step))).collect()).into(), plot().into()],
        width_px: 900,
        ..Sheet::default()
    };
    assert_eq!(sheet().to_png().unwrap(), sheet().to_png().unwrap());
}

#[test]
fn every_text_is_drawn() {
    let plain = || Filmstrip {
        title: "A".to_owned(),
        subtitle: "B".to_owned(),
        ..strip(vec![Panel { caption: "C".to_owned(), time_secs: 1.0, ..bare(Figure::new(vec![trunk(Shade::Left)])) }])
    };
    let first = plain().draw().unwrap();
    let changes: [fn(&mut Filmstrip); 4] = [
        |strip| strip.title = "Walk".to_owned(),
        |strip| strip.subtitle = "Walk".to_owned(),
        |strip| strip.panels[0].caption = "Walk".to_owned(),
        |strip| strip.panels[0].time_secs = 8.88,
    ];
    for change in changes {
        let mut strip = plain();
        change(&mut strip);
        assert!(differing(&first, &strip.draw().unwrap()) > 20);
    }
}

#[test]
fn panels_share_one_scale_even_when_one_body_is_larger() {
    let tall = Capsule::new(DVec3::new(0.0, 0.3, 0.0), DVec3::new(0.0, 2.5, 0.0), 0.3, Shade::Midline);
    let strip = strip(vec![bare(Figure::new(vec![trunk(Shade::Left)])), bare(Figure::new(vec![tall]))]);
    let metre = |index| {
        let spot = |y: f64| strip.spot(index, DVec3::Y * y).unwrap();
        (spot(0.0).1 - spot(1.0).1, spot(0.0).1)
    };
    assert_eq!(metre(0), metre(1));
}

#[test]
fn the_body_stays_in_the_middle_while_the_floor_moves_under_it() {
    let travels = [0.0, 0.25, 1.0];
    let panel = |travel: f64| {
        let hips = DVec3::new(0.0, 0.9, travel);
        Panel { follow: Some(hips), ..bare(Figure::new(vec![Capsule::ball(hips, 0.2, Shade::Midline)])) }
    };
    let strip = Filmstrip { camera: Camera::side(), ..strip(travels.map(panel).to_vec()) };
    let picture = strip.draw().unwrap();
    // A patch of each panel around a point that travels with the body: its middle, and the floor below.
    let patch = |index: usize, height: f64| {
        let (x, y) = strip.spot(index, DVec3::new(0.0, height, travels[index])).unwrap();
        let (x, y) = (x.round() as i32, y.round() as i32);
        let spots = (-3..=3).flat_map(move |down| (-30..=30).map(move |right| (x + right, y + down)));
        spots.map(|(x, y)| pixel(&picture, (x as f32, y as f32))).collect::<Vec<_>>()
    };
    assert!(patch(0, 0.9) == patch(1, 0.9) && patch(0, 0.9) == patch(2, 0.9), "bodies look the same");
    assert!(patch(0, 0.0) != patch(1, 0.0), "a quarter of a metre shows on the floor");
    assert!(patch(0, 0.0) == patch(2, 0.0), "the tiles repeat after a metre");
}

#[test]
fn a_box_hides_what_is_behind_it_and_nothing_beside_it() {
    let cuboid = Cuboid {
        centre: DVec3::new(0.0, 1.0, 0.4),
        rotation: DQuat::IDENTITY,
        size_m: DVec3::new(0.5, 0.3, 0.1),
        shade: Shade::Object,
    };
    let objects = Figure { boxes: vec![cuboid], ..Figure::default() };
    let figure = Figure::new(vec![trunk(Shade::Right)]);
    let strip = Filmstrip { camera: Camera::front(), ..strip(vec![Panel { objects, ..bare(figure) }]) };
    let picture = strip.draw().unwrap();
    let at = |x: f64, y: f64, z: f64| pixel(&picture, strip.spot(0, DVec3::new(x, y, z)).unwrap());
    let is_green = |[red, green, _]: [u8; 3]| green > red;
    // Near every corner of its front, and in its middle.
    for (x, y) in [(0.0, 1.0), (0.23, 1.13), (-0.23, 1.13), (0.23, 0.87), (-0.23, 0.87)] {
        assert!(is_green(at(x, y, 0.45)), "{:?} at {x} {y}", at(x, y, 0.45));
    }
    assert!(!is_green(at(0.0, 1.3, 0.15)), "the trunk above it");
    assert!(!is_green(at(0.0, 0.7, 0.15)), "the trunk below it");
}

#[test]
fn a_standing_body_is_240_pixels_high_in_a_picture_1800_pixels_wide() {
    // A second body two metres away, and a ball far off, which may leave the picture.
    let mut both = vec![trunk(Shade::Left)];
    both.push(Capsule { from: DVec3::new(2.0, 0.2, 0.0), to: DVec3::new(2.0, 1.5, 0.0), ..trunk(Shade::Right) });
    let ball = Figure::new(vec![Capsule::ball(DVec3::new(9.0, 0.3, 0.0), 0.2, Shade::Object)]);
    let panel = Panel { objects: ball, ..bare(Figure::new(both)) };
    let style = Style { width_px: 1800, columns: 12, ..Style::default() };
    let strip = Filmstrip { camera: Camera::front(), style, panels: vec![panel; 12], ..Filmstrip::default() };
    let height = strip.spot(0, DVec3::ZERO).unwrap().1 - strip.spot(0, DVec3::Y * 1.7).unwrap().1;
    assert!(height >= 237.0, "{height}"); // seen 8 degrees from above: 1 % less
    let tall = Style { body_height_m: 10.0, ..strip.style.clone() };
    let giant = Capsule::new(DVec3::Y, DVec3::Y * 9.0, 0.9, Shade::Midline);
    let strip = Filmstrip { panels: vec![bare(Figure::new(vec![giant]))], style: tall, ..strip };
    let spot = strip.spot(0, DVec3::new(0.0, 9.7, 0.3)).unwrap();
    assert!(is_body(pixel(&strip.draw().unwrap(), spot)), "the head of a tall body is in the picture");
}

#[test]
fn an_impact_is_marked_where_it_happens() {
    let at = DVec3::new(0.1, 1.2, 0.1);
    let panel =
        Panel { hits: vec![Hit { at, label: "9 N s".to_owned() }], ..bare(Figure::new(vec![trunk(Shade::Left)])) };
    let plain = Panel { hits: Vec::new(), ..panel.clone() };
    let strips = [panel, plain].map(|panel| Filmstrip { camera: Camera::front(), ..strip(vec![panel]) });
    let (x, y) = strips[0].spot(0, at).unwrap();
    let pictures = strips.map(|strip| strip.draw().unwrap());
    // On the ray to the right of the middle; the middle itself stays free.
    assert_ne!(pixel(&pictures[0], (x + 5.0, y)), pixel(&pictures[1], (x + 5.0, y)));
    assert_eq!(pixel(&pictures[0], (x, y)), pixel(&pictures[1], (x, y)));
}

#[test]
fn a_foot_under_the_floor_looks_unlike_one_on_it() {
    let foot = |height: f64| {
        let ball = Capsule::ball(DVec3::new(0.0, height, 0.0), 0.05, Shade::Left);
        let strip =
            Filmstrip { camera: Camera::side(), ..strip(vec![bare(Figure::new(vec![ball, trunk(Shade::Left)]))]) };
        let spot = strip.spot(0, DVec3::new(0.0, height, 0.0)).unwrap();
        pixel(&strip.draw().unwrap(), spot)
    };
    let (on, under) = (foot(0.06), foot(-0.12));
    assert!(on[2] > on[0] + 60 && under[2] < under[0] + 60, "{on:?} {under:?}");
}

fn plot() -> Plot {
    let line =
        |scale: f64| (0..200).map(move |step| 0.01 * f64::from(step)).map(move |x| (x, scale * libm::sin(2.0 * x)));
    Plot {
        title: "Deflection".to_owned(),
        x_label: "time (s)".to_owned(),
        y_label: "deflection (°)".to_owned(),
        series: vec![Series::new("leftHand", line(30.0).collect()), Series::new("head", line(12.0).collect())],
        marks: vec![Mark { from_secs: 1.2, to_secs: 1.3, label: "push".to_owned() }],
        limits: vec![Limit { value: 2.0, label: "2°".to_owned() }],
        width_px: 1200,
        ..Plot::default()
    }
}

#[test]
fn a_line_runs_through_its_points_and_a_mark_shades_its_interval() {
    let plot = plot();
    let picture = plot.draw().unwrap();
    let [red, _, blue] = pixel(&picture, plot.spot(0.5, 30.0 * libm::sin(1.0)));
    assert!(blue > red + 80, "the first line is blue");
    let [_, green, _] = pixel(&picture, plot.spot(1.25, 29.0));
    let [_, clear, _] = pixel(&picture, plot.spot(1.45, 29.0));
    assert!(green < 235 && clear > 250, "{green} {clear}");
}

#[test]
fn the_legend_never_lies_on_the_lines() {
    // The second, longer name sets the width of the legend.
    let named = |first: &str| {
        let mut plot = plot();
        plot.series[0].name = first.to_owned();
        plot.series[1].name = "a name of some length".to_owned();
        plot
    };
    let plots = (named("leftHand"), named("rightFoot"));
    let (one, two) = (plots.0.draw().unwrap(), plots.1.draw().unwrap());
    let right = plots.0.spot(1.99, 0.0).0 as u32;
    let changed = |columns: std::ops::Range<u32>| {
        let spots = columns.flat_map(|x| (0..one.height()).map(move |y| (x, y)));
        spots.filter(|&(x, y)| one.pixel(x, y) != two.pixel(x, y)).count()
    };
    assert_eq!(changed(0..right), 0);
    assert!(changed(right..one.width()) > 20);
    let widest = Plot { series: vec![Series::new("x".repeat(500), vec![(0.0, 0.0), (1.0, 1.0)])], ..plot() };
    assert!(widest.spot(1.0, 0.0).0 > 500.0, "a long name should leave room for the lines");
}

#[test]
fn lines_differ_even_without_colour() {
    let ink = |count: usize| {
        let flat = vec![(0.0, 0.0), (1.0, 1.0)];
        let mut plot = Plot { series: vec![Series::new("a", vec![]); count], limits: vec![], marks: vec![], ..plot() };
        plot.series[count - 1].points = flat;
        let picture = plot.draw().unwrap();
        let on = |step: u32| pixel(&picture, plot.spot(f64::from(step) / 400.0, f64::from(step) / 400.0))[0] < 220;
        (20..380).filter(|&step| on(step)).count()
    };
    assert!(ink(1) > 350, "the first is solid");
    assert!(ink(2) < 300 && ink(2) > 100, "the second is dashed");
}

#[test]
fn a_sheet_holds_its_pieces_unchanged_from_top_to_bottom() {
    let strip = strip(vec![common::panel(0.9)]);
    let plot = Plot { width_px: 900, ..plot() };
    let sheet = Sheet { pieces: vec![strip.clone().into(), plot.clone().into()], width_px: 900, ..Sheet::default() };
    let (sheet, strip, plot) = (sheet.draw().unwrap(), strip.draw().unwrap(), plot.draw().unwrap());
    let cut = (strip.rgba().len(), plot.rgba().len());
    assert!(sheet.rgba()[..cut.0] == *strip.rgba());
    assert!(sheet.rgba()[cut.0..cut.0 + cut.1] == *plot.rgba());
}
