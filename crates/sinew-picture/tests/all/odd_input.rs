//! Nothing that is put into a picture makes it panic, hang or take all memory.

use crate::common;

use glam::{DQuat, DVec3};
use sinew_picture::{
    Arrow, Camera, Capsule, Colour, Cuboid, Figure, Filmstrip, Hit, Limit, Mark, Panel, Plot, Series, Shade, Sheet,
    Style, limits,
};

const ODD: [f64; 10] = [f64::NAN, f64::INFINITY, f64::NEG_INFINITY, f64::MAX, f64::MIN, 1e-310, -0.0, 0.0, 1e30, -1e6];

fn small(panels: Vec<Panel>) -> Filmstrip {
    Filmstrip { panels, style: Style { width_px: 480, ..Style::default() }, ..Filmstrip::default() }
}

#[test]
fn nothing_at_all_still_makes_a_picture() {
    assert!(Filmstrip::default().to_png().is_ok());
    assert!(small(vec![Panel::default(); 3]).to_png().is_ok());
    assert!(small(vec![Panel { ghost: Some(Figure::default()), ..Panel::default() }]).to_png().is_ok());
    assert!(Plot::default().to_png().is_ok());
    assert!(Sheet::default().to_png().is_ok());
}

#[test]
fn a_capsule_that_is_not_finite_is_skipped_and_the_rest_is_drawn() {
    let whole = common::walker(0.3, 0.0);
    let follow = Some(DVec3::new(0.0, 0.9, 0.36));
    let draw = |figure: Figure| small(vec![Panel { figure, follow, ..Panel::default() }]).draw().unwrap();
    let expected = draw(whole.clone());
    for odd in [f64::NAN, f64::INFINITY, f64::NEG_INFINITY, 1e30] {
        let mut figure = whole.clone();
        figure.capsules.push(Capsule::new(DVec3::new(odd, 1.0, 0.0), DVec3::Y, 0.1, Shade::Left));
        figure.capsules.push(Capsule::new(DVec3::ZERO, DVec3::new(0.0, 0.0, odd), 0.1, Shade::Left));
        if !odd.is_finite() {
            figure.capsules.push(Capsule::tapered(DVec3::ZERO, DVec3::Y, 0.1, odd, Shade::Left));
        }
        assert!(draw(figure) == expected, "{odd}");
    }
}

#[test]
fn odd_numbers_anywhere_in_a_filmstrip_do_no_harm() {
    for odd in ODD {
        let point = DVec3::new(odd, 1.0, -odd);
        let mut figure = common::walker(0.2, 0.3);
        figure.capsules.push(Capsule::tapered(point, DVec3::Y, 0.1, 0.2, Shade::Custom(Colour::hex(0x123456))));
        figure.capsules.push(Capsule::tapered(DVec3::ZERO, DVec3::Y, odd, 0.2, Shade::Object));
        figure.capsules.push(Capsule::tapered(DVec3::ZERO, DVec3::splat(odd), 1e-300, 1e-9, Shade::Object));
        let boxes = [(point, DVec3::ONE, 1.0), (DVec3::Y, point, 1.0), (DVec3::Y, DVec3::splat(odd), odd)]
            .into_iter()
            .map(|(centre, size_m, turn)| Cuboid {
                centre,
                rotation: DQuat::from_xyzw(0.0, turn, 0.0, 1.0),
                size_m,
                shade: Shade::Object,
            });
        let arrow = |at, force_n| Arrow { at, force_n, label: String::new() };
        let panel = Panel {
            time_secs: odd,
            ghost: Some(figure.clone()),
            figure,
            arrows: vec![arrow(point, DVec3::X), arrow(DVec3::Y, point), arrow(DVec3::Y, DVec3::splat(odd))],
            follow: Some(point),
            caption: format!("{odd}"),
            objects: Figure { capsules: Vec::new(), boxes: boxes.collect() },
            hits: vec![Hit { at: point, label: format!("{odd}") }],
        };
        let mut strip = small(vec![common::panel(0.9), panel]);
        assert!(strip.draw().is_ok(), "{odd}");
        strip.camera = Camera { azimuth_rad: odd, elevation_rad: odd }.about_heading(point);
        strip.style.floor_m = odd;
        assert!(strip.draw().is_ok(), "{odd}");
        assert!(strip.spot(0, point).is_none_or(|spot| spot.0.is_finite()));
    }
}

#[test]
fn every_camera_can_look_from_straight_above_to_straight_below() {
    for step in -8..=8 {
        let camera = Camera { azimuth_rad: 0.7 * f64::from(step), elevation_rad: 0.2 * f64::from(step) };
        assert!(Filmstrip { camera, ..small(vec![common::panel(0.9)]) }.draw().is_ok());
    }
}

#[test]
fn enormous_sizes_are_clamped() {
    let style = Style { width_px: u32::MAX, columns: usize::MAX, ..Style::default() };
    let picture = Filmstrip { style, ..Filmstrip::default() }.draw().unwrap();
    assert_eq!(picture.width(), limits::MAX_WIDTH_PX);
    assert_eq!(
        Filmstrip { style: Style { width_px: 0, columns: 0, ..Style::default() }, ..small(vec![]) }
            .draw()
            .unwrap()
            .width(),
        limits::MIN_WIDTH_PX
    );

    let many = small(vec![Panel::default(); 2_000]);
    assert!(many.draw().unwrap().height() <= limits::MAX_HEIGHT_PX);
    assert!(
        many.spot(limits::MAX_PANELS, DVec3::ZERO).is_none()
            && many.spot(limits::MAX_PANELS - 1, DVec3::ZERO).is_some()
    );

    let huge = Figure::new(vec![Capsule::new(DVec3::splat(-9e6), DVec3::splat(9e6), 1e300, Shade::Left); 3_000]);
    let text = "W".repeat(100_000);
    let panel = Panel { figure: huge, caption: text.clone(), ..Panel::default() };
    let strip = Filmstrip { title: text.clone(), subtitle: text.clone(), ..small(vec![panel]) };
    let pieces = vec![strip.into()];
    assert!(Sheet { pieces, title: text.clone(), footer: text, width_px: 480, ..Sheet::default() }.draw().is_ok());
}

#[test]
fn odd_numbers_anywhere_in_a_plot_do_no_harm() {
    for odd in ODD {
        let points = vec![(0.0, 1.0), (odd, 0.5), (0.5, odd), (odd, odd), (1.0, 2.0)];
        let plot = Plot {
            title: "\u{0}\u{7f}\n漢字 🦴".to_owned(),
            y_label: "y".repeat(10_000),
            series: vec![Series::new("a", points), Series::new("", vec![(odd, odd)]), Series::new("no points", vec![])],
            marks: vec![
                Mark { from_secs: odd, to_secs: 0.5, label: "one".to_owned() },
                Mark { from_secs: 0.2, to_secs: odd, label: "two".to_owned() },
            ],
            limits: vec![Limit { value: odd, label: "limit".to_owned() }],
            width_px: 480,
            aspect: odd,
            ..Plot::default()
        };
        assert!(plot.draw().is_ok(), "{odd}");
    }
}

#[test]
fn a_long_recording_and_many_lines_can_be_plotted() {
    let points: Vec<(f64, f64)> =
        (0..100_000).map(|step| f64::from(step) / 120.0).map(|x| (x, libm::sin(40.0 * x))).collect();
    let plot = Plot { series: vec![Series::new("long", points)], width_px: 900, ..Plot::default() };
    let picture = plot.draw().unwrap();
    let spot = plot.spot(400.0, 0.98);
    // The swings are far narrower than a pixel: the line covers all between its extremes.
    assert!(picture.pixel(spot.0 as u32, spot.1 as u32).is_some_and(|[red, _, blue]| blue > red + 60));

    let mark = |step: u32| Mark { from_secs: f64::from(step) * 0.001, to_secs: 0.9, label: format!("mark {step}") };
    let series = (0..500).map(|line| Series::new(format!("line {line}"), vec![(0.0, 0.0), (1.0, f64::from(line))]));
    let plot = Plot { series: series.collect(), marks: (0..500).map(mark).collect(), width_px: 480, ..Plot::default() };
    assert!(plot.draw().unwrap().height() <= limits::MAX_HEIGHT_PX);
}
