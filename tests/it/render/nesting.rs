//! Solids within solids within solids: any number of shells around a point, against a pile of
//! plates worked out on paper.

use crate::common::plates::{Layer, check, half_sky, looking, pile, seen};
use crate::common::{lanes::with, scene};
use glam::DVec3;

/// Half the height of a shell's walls above each other.
const WALL: f64 = 0.25;

/// Index and absorption of a shell, from the outermost.
fn matter(shell: usize) -> (f64, f64) {
    ([1.5, 1.2, 1.35][shell % 3], 0.02 + 0.05 * (shell % 4) as f64)
}

/// So many boxes in each other, in an order of their own, and what they are made of; around one
/// middle, or on one ground.
fn shells(count: usize, on_ground: bool) -> String {
    let mut text = String::new();
    for shell in 0..count {
        let (n, absorption) = matter(shell);
        text += &format!("materials.m{shell}.dielectric = {{ ior = {n}, absorption = {absorption} }}\n");
    }
    for shell in (0..count).map(|i| i * 7 % count) {
        let (width, half) = (400.0 - shell as f64, WALL * (count - shell) as f64);
        let [height, middle] = if on_ground { [half, 0.5 * half] } else { [2.0 * half, 0.0] };
        text += &format!("[[objects]]\nmaterial = \"m{shell}\"\n");
        text += &format!("shape.box = {{ size = [{width}, {width}, {height}], center = [0, 0, {middle}] }}\n");
    }
    text
}

/// The walls that light crosses on its way in, the innermost last.
fn walls(count: usize) -> Vec<Layer> {
    (0..count).map(matter).map(|(n, absorption)| (n, absorption, WALL)).collect()
}

/// The light through all of them, as it would be if shells beyond a number were forgotten on the
/// way out.
fn through(count: usize, kept: usize, cos: f64) -> f64 {
    let way_in = walls(count);
    let way_out = way_in.iter().rev().map(|&(n, a, d)| (n, a, d)).enumerate();
    let way_out: Vec<Layer> = way_out.map(|(i, layer)| if i < kept { layer } else { (1.0, 0.0, 1.0) }).collect();
    100.0 * cos * pile(1.0, &[way_in, way_out].concat(), 1.0, cos).t
}

#[test]
#[ignore = "long: many seconds of paths"]
fn no_shell_is_forgotten_however_many_there_are() {
    for count in [8, 9, 23] {
        for cos in [1.0, 0.6] {
            let top = WALL * count as f64 * DVec3::Z;
            let text = seen(top, cos, 1) + &half_sky("\"E\"", false) + &shells(count, false);
            let wrong: &[f64] = if count > 8 { &[through(count, 8, cos)] } else { &[] };
            let name = format!("{count} shells, cos {cos}");
            check(&name, &mut scene(&text, &with(8, 128)), through(count, count, cos), wrong);
        }
    }
}

#[test]
fn a_camera_within_all_of_them_knows_all_of_them() {
    for count in [8, 12, 23] {
        let text = looking(DVec3::ZERO, -DVec3::Z, 1) + &half_sky("\"E\"", false) + &shells(count, false);
        let way_out: Vec<Layer> = walls(count).into_iter().rev().collect();
        let (n, ..) = way_out[0];
        // The other half of the shells throws light back, whose pile is the same seen from the
        // middle.
        let half = pile(n, &way_out, 1.0, 1.0);
        let right = n * n * 100.0 * half.t / (1.0 - half.r * half.r);
        check(&format!("from within {count}"), &mut scene(&text, &with(8, 128)), right, &[right / n / n]);
    }
}

/// All of their lower faces coincide: from the innermost there is one step into the open.
#[test]
fn shells_on_one_ground_have_one_lower_face() {
    for count in [8, 9, 23] {
        let text = seen(WALL * count as f64 * DVec3::Z, 0.6, 1) + &half_sky("\"E\"", false) + &shells(count, true);
        let light = |layers: &[Layer]| 60.0 * pile(1.0, layers, 1.0, 0.6).t;
        // A step on the way, as if some were left behind before others.
        let (way, (n, _)) = (walls(count), matter(count - 2));
        let wrong = light(&[way.clone(), vec![(n, 0.0, 1.0)]].concat());
        check(&format!("{count} shells on one ground"), &mut scene(&text, &with(8, 128)), light(&way), &[wrong]);
    }
}
