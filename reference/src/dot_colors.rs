//! Dots in the colours of a transfer function, with one layer for each pen or for each of a few colours ([STIP-16]).
//!
//! A colour belongs to a voxel, not to a frame: no dot changes its layer while a camera turns.

use crate::labels::Labels;
use crate::number::Vec3;
use crate::style_transfer_functions::{Spheres, StyleIndex};
use crate::transfer::{IndexTable, NodesError, Piecewise};
use drypoint_scene::color::{Rgb, linear_to_oklab, linear_to_srgb, srgb_to_linear, unpremultiply};
use drypoint_scene::points::{PointVoxel, Points};
use drypoint_scene::shot::Mix;
use drypoint_scene::space::Grid;
use drypoint_scene::style::Style;
use drypoint_scene::transfer::Function;
use std::collections::BTreeMap;

/// The colour of a voxel whose label has no row.
const NONE: Rgb = [0.0; 3];

/// The source of the dots' colours.
#[derive(Clone, Copy, Debug)]
pub struct VoxelColors<'a> {
    /// The function over the volume's values, or over value and label.
    pub function: &'a Function,
    /// The styles that the function names, in their order.
    pub styles: &'a [Style],
    /// The interpolation of styles ([STF-3]).
    pub mix: Mix,
    /// The labels, if the function is over labels.
    pub labels: Option<&'a Labels<'a>>,
    /// Whether a dot has its label's colour whatever its value: the colour of the row's most opaque node, the first
    /// of equals.
    pub by_label: bool,
    /// The values at which V is 0 and 1 ([STIP-1]).
    pub range: [f64; 2],
}

/// A row of nodes, as colours over the value.
struct ColorRow {
    over_value: Piecewise<f64>,
    table: Option<IndexTable<f64>>,
    shown: ColorSource,
    /// The colour of the most opaque node.
    flat: Rgb,
}

enum ColorSource {
    Colors(Vec<Rgb>),
    Styles(StyleIndex),
}

impl VoxelColors<'_> {
    /// The colour of each voxel's dots: the function's colour at V, whatever its opacity. A style is evaluated facing
    /// the eye, N = (0, 0, 1), so that a dot keeps its colour while the camera turns.
    ///
    /// # Errors
    /// The nodes do not make a function.
    pub fn of(&self, points: &Points, grid: &Grid) -> Result<Vec<Rgb>, NodesError> {
        let (at, _, rows) = self.function.nodes();
        let spheres = Spheres::new(self.styles, self.mix);
        let (lines, ids) = match rows {
            None => (vec![self.line(0..at.len(), &spheres)?], None),
            Some(rows) => {
                let lines = rows.spans(at.len()).map(|span| self.line(span, &spheres)).collect::<Result<_, _>>()?;
                (lines, Some(&rows.at))
            }
        };
        let ([lo, hi], [first, last]) = (self.range, grid.index_box());
        let of = |voxel: &PointVoxel| {
            let line = match (ids, self.labels) {
                (Some(ids), Some(labels)) => {
                    // The centre of a partial box ([STIP-2]) can lie outside.
                    let at = grid.to_index(points.grid.to_world(voxel.centre())).clamp(first, last);
                    let id = f64::from(labels.id_at(Vec3::<f64>::from_glam(at)));
                    let Some(row) = ids.iter().position(|at| *at == id) else { return NONE };
                    &lines[row]
                }
                _ => &lines[0],
            };
            if self.by_label { line.flat } else { line.at(lo + voxel.value * (hi - lo), &spheres) }
        };
        Ok(points.voxels.iter().map(of).collect())
    }

    /// The function's colour at each of some values, whatever its opacity; styles face the eye as in [`of`](Self::of). Of a
    /// function over two quantities it is that of the first row.
    ///
    /// # Errors
    /// The nodes do not make a function.
    pub fn at_values(&self, values: &[f64]) -> Result<Vec<Rgb>, NodesError> {
        let (at, _, rows) = self.function.nodes();
        let first = rows.and_then(|rows| rows.spans(at.len()).next()).unwrap_or(0..at.len());
        let spheres = Spheres::new(self.styles, self.mix);
        let line = self.line(first, &spheres)?;
        Ok(values.iter().map(|&value| line.at(value, &spheres)).collect())
    }

    fn line(&self, nodes: std::ops::Range<usize>, spheres: &Spheres<f64>) -> Result<ColorRow, NodesError> {
        let (at, opacity, _) = self.function.nodes();
        let (at, opacity) = (&at[nodes.clone()], &opacity[nodes.clone()]);
        // Every node counts, even an invisible one: places without opacity would not be found.
        let over_value = Piecewise::new(at, &vec![1.0; at.len()])?;
        let table = self.function.table().map(|(index, nodes)| IndexTable::new(index, nodes));
        let own = |n: usize| if table.is_some() { 0..n } else { nodes.clone() };
        let shown = match self.function {
            Function::Regular(all) => ColorSource::Colors(all.color[own(all.color.len())].to_vec()),
            Function::Style { nodes: all, .. } => {
                ColorSource::Styles(StyleIndex::new(&all.color[own(all.color.len())]))
            }
        };
        let most = (0..at.len()).rev().max_by(|&a, &b| opacity[a].total_cmp(&opacity[b])).map_or(0.0, |i| at[i]);
        let mut line = ColorRow { over_value, table, shown, flat: NONE };
        line.flat = line.at(most, spheres);
        Ok(line)
    }
}

impl ColorRow {
    fn at(&self, value: f64, spheres: &Spheres<f64>) -> Rgb {
        // The function is opaque everywhere, so every value has a place.
        let Some(place) = self.over_value.locate(value) else { return NONE };
        let place = self.table.as_ref().map_or(place, |table| table.between_nodes(&place));
        match &self.shown {
            ColorSource::Colors(colors) => place.color(colors),
            ColorSource::Styles(index) => {
                let [r, g, b, _] = unpremultiply(spheres.lookup(&index.blend(&place), 0.0, 0.0));
                [r, g, b]
            }
        }
    }
}

/// The nearest of `inks` for each colour, in OKLab, where equal distances look equal; the first of equals. `inks`
/// must not be empty.
pub fn nearest(colors: &[Rgb], inks: &[Rgb]) -> Vec<usize> {
    let inks: Vec<Rgb> = inks.iter().copied().map(linear_to_oklab).collect();
    let mut known: BTreeMap<[u64; 3], usize> = BTreeMap::new();
    let nearest = |color: &Rgb| {
        *known.entry(color.map(f64::to_bits)).or_insert_with(|| {
            let color = linear_to_oklab(*color);
            let distance = |ink: &Rgb| (0..3).map(|c| (ink[c] - color[c]) * (ink[c] - color[c])).sum::<f64>();
            (0..inks.len()).min_by(|&a, &b| distance(&inks[a]).total_cmp(&distance(&inks[b]))).unwrap_or(0)
        })
    };
    colors.iter().map(nearest).collect()
}

/// At most `most` colours for many, from light to dark, each with one byte per channel in sRGB for vector files. If
/// there are few enough colours, they are returned themselves. Otherwise they are means of a median cut in OKLab,
/// which halves the widest box until there are enough.
pub fn palette(colors: &[Rgb], most: usize) -> Vec<Rgb> {
    // A histogram of the colours as bytes.
    let byte = |c: f64| (linear_to_srgb(c.clamp(0.0, 1.0)) * 255.0).round_ties_even() as u8;
    let mut weights: BTreeMap<[u8; 3], f64> = BTreeMap::new();
    for color in colors {
        *weights.entry(color.map(byte)).or_default() += 1.0;
    }
    let light = |bytes: [u8; 3]| bytes.map(|c| srgb_to_linear(f64::from(c) / 255.0));
    let mut boxes: Vec<Vec<([u8; 3], Rgb, f64)>> = if weights.len() <= most {
        weights.into_iter().map(|(c, n)| vec![(c, linear_to_oklab(light(c)), n)]).collect()
    } else {
        vec![weights.into_iter().map(|(c, n)| (c, linear_to_oklab(light(c)), n)).collect()]
    };
    let width = |b: &[([u8; 3], Rgb, f64)], c: usize| {
        let ends = b.iter().fold([f64::MAX, f64::MIN], |[lo, hi], (_, lab, _)| [lo.min(lab[c]), hi.max(lab[c])]);
        ends[1] - ends[0]
    };
    // Median cut: halves the box with the longest side, by weight along this side.
    while boxes.len() < most {
        let sides = boxes.iter().enumerate().flat_map(|(i, b)| (0..3).map(move |c| (i, c, b)));
        let widest = sides.map(|(i, c, b)| (width(b, c), i, c)).max_by(|a, b| a.0.total_cmp(&b.0));
        let Some((_, i, c)) = widest.filter(|(width, ..)| *width > 0.0) else { break };
        let mut cut = std::mem::take(&mut boxes[i]);
        cut.sort_by(|a, b| a.1[c].total_cmp(&b.1[c]).then(a.0.cmp(&b.0)));
        let half = cut.iter().map(|(.., n)| n).sum::<f64>() / 2.0;
        let mut sum = 0.0;
        let first = cut
            .iter()
            .take_while(|(.., n)| {
                sum += n;
                sum <= half
            })
            .count();
        let second = cut.split_off(first.clamp(1, cut.len() - 1));
        boxes[i] = cut;
        boxes.push(second);
    }
    // The mean of each box in linear light, rounded to bytes.
    let mean = |b: &Vec<([u8; 3], Rgb, f64)>| {
        let all: f64 = b.iter().map(|(.., n)| n).sum();
        let mean = [0, 1, 2].map(|c| b.iter().map(|(bytes, _, n)| light(*bytes)[c] * n).sum::<f64>() / all);
        light(mean.map(byte))
    };
    let mut palette: Vec<Rgb> = boxes.iter().filter(|b| !b.is_empty()).map(mean).collect();
    palette.sort_by(|a, b| linear_to_oklab(*b)[0].total_cmp(&linear_to_oklab(*a)[0]));
    palette.dedup();
    palette
}

/// The points of each layer: the points of its voxels, in their order. `of` holds each voxel's layer.
pub fn split(points: &Points, of: &[usize], layers: usize) -> Vec<Points> {
    let layer = |l: usize| {
        let own: Vec<usize> = (0..points.voxels.len()).filter(|&i| of[i] == l).collect();
        let mut offsets = Vec::with_capacity(own.len() * points.each);
        own.iter().for_each(|&i| offsets.extend_from_slice(points.of(i)));
        Points {
            offsets,
            voxels: own.iter().map(|&i| points.voxels[i]).collect(),
            grid: points.grid.clone(),
            ..*points
        }
    };
    (0..layers).map(layer).collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use drypoint_scene::glam::DVec3;
    use drypoint_scene::transfer::Nodes;

    const RED: Rgb = [1.0, 0.0, 0.0];
    const BLUE: Rgb = [0.0, 0.0, 1.0];

    fn points(values: &[f64]) -> (Points, Grid) {
        let grid = Grid::with_spacing([values.len(), 2, 2], [1.0; 3]).unwrap();
        let voxel =
            |(x, &value): (usize, &f64)| PointVoxel { cell: [x as u32, 0, 0], value, magnitude: 1.0, normal: DVec3::X };
        let voxels: Vec<PointVoxel> = values.iter().enumerate().map(voxel).collect();
        let offsets = (0..2 * values.len()).map(|i| [i as f32, 0.0, 0.0]).collect();
        (Points { grid: grid.clone(), each: 2, full: 2.0, voxels, offsets }, grid)
    }

    fn nodes<C>(color: Vec<C>) -> Nodes<C> {
        Nodes { at: vec![100.0, 200.0], opacity: vec![0.0, 0.5], color, index: None, rows: None }
    }

    fn of(function: &Function, styles: &[Style], by_label: bool, values: &[f64]) -> Vec<Rgb> {
        let (points, grid) = points(values);
        let range = [50.0, 250.0];
        VoxelColors { function, styles, mix: Mix::Premultiplied, labels: None, by_label, range }
            .of(&points, &grid)
            .unwrap()
    }

    /// V = ¼, ½ and ¾ of [50, 250] are 100, 150 and 200. Values beyond have the last node's colour.
    #[test]
    fn colours_of_a_regular_function_by_hand() {
        let function = Function::Regular(nodes(vec![RED, BLUE]));
        let found = of(&function, &[], false, &[0.0, 0.25, 0.5, 0.75, 1.0]);
        assert_eq!(found, [RED, RED, [0.5, 0.0, 0.5], BLUE, BLUE]);
        assert_eq!(of(&function, &[], true, &[0.0]), [BLUE]);
        let colors = VoxelColors {
            function: &function,
            styles: &[],
            mix: Mix::Premultiplied,
            labels: None,
            by_label: false,
            range: [0.0, 1.0],
        };
        assert_eq!(colors.at_values(&[50.0, 150.0, 300.0]), Ok(vec![RED, [0.5, 0.0, 0.5], BLUE]));
    }

    /// The middle of a picture with an odd side is a texel's centre, whatever lies at its border.
    #[test]
    fn a_style_where_it_faces_the_eye() {
        let style = |name: &str, middle: Rgb| {
            let texel = |t: usize| if t == 12 { [middle[0], middle[1], middle[2], 1.0] } else { [0.3, 0.4, 0.5, 1.0] };
            Style::from_straight(name, 5, &(0..25).map(texel).collect::<Vec<_>>(), true).unwrap()
        };
        let function = Function::Style { nodes: nodes(vec![0, 1]), names: vec!["a".into(), "b".into()] };
        let found = of(&function, &[style("a", RED), style("b", BLUE)], false, &[0.25, 0.5, 1.0]);
        assert_eq!(found, [RED, [0.5, 0.0, 0.5], BLUE]);
    }

    #[test]
    fn the_nearest_ink() {
        let inks = [[0.0; 3], [1.0; 3], RED];
        assert_eq!(nearest(&[[0.01; 3], [0.8; 3], [0.6, 0.02, 0.01], RED, [0.0; 3]], &inks), [0, 1, 2, 2, 0]);
        // The first of equals.
        assert_eq!(nearest(&[BLUE], &[RED, RED]), [0]);
    }

    #[test]
    fn few_colours_stay_as_they_are_and_many_become_few() {
        let grey = |i: usize| [srgb_to_linear(i as f64 / 255.0); 3];
        let few = [grey(10), grey(200), grey(10), RED];
        assert_eq!(palette(&few, 16), [grey(200), RED, grey(10)]);
        let many: Vec<Rgb> = (0..256).map(grey).collect();
        let found = palette(&many, 16);
        assert_eq!(found.len(), 16);
        // A ramp is cut into parts of equal weight or width: a grey's distance from its colour is at most the width
        // of a part.
        let of = nearest(&many, &found);
        let lightness = |c: Rgb| linear_to_oklab(c)[0];
        assert!(many.iter().zip(&of).all(|(c, &i)| (lightness(*c) - lightness(found[i])).abs() < 1.0 / 8.0));
        assert!(found.windows(2).all(|w| lightness(w[0]) > lightness(w[1])));
        assert!(palette(&[], 16).is_empty());
    }

    #[test]
    fn every_point_is_in_one_layer() {
        let (points, _) = points(&[0.1, 0.2, 0.3, 0.4]);
        let layers = split(&points, &[1, 0, 1, 2], 4);
        assert_eq!(layers.iter().map(|l| l.voxels.len()).collect::<Vec<_>>(), [1, 2, 1, 0]);
        assert_eq!(layers[1].offsets, [[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [4.0, 0.0, 0.0], [5.0, 0.0, 0.0]]);
        assert_eq!(layers[1].of(1), points.of(2));
    }
}
