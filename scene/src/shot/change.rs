//! The difference between two shots, as a renderer answers it.

use super::{Axis, Shot};

/// How much of a shot differs from another one over the same data. Each level includes those before it.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum ShotChange {
    /// Nothing differs: frames are equal.
    Nothing,
    /// The camera, with the lights that follow it. See [`Shot::seen_from`].
    View,
    /// Numbers, colours, functions, clip planes, effects, size or layers. Measured facts of the data stay.
    Look,
    /// Facts of the data have to be measured anew.
    Facts,
}

impl Shot {
    /// Returns how much of this shot differs from the one `before` over the same data.
    pub fn change_from(&self, before: &Self) -> ShotChange {
        let [view, old] = [&self.view, &before.view];
        let has_lens = view.size == old.size && view.perspective == old.perspective;
        if self == before {
            ShotChange::Nothing
        } else if has_lens && *self == before.seen_from(view.clone()) {
            ShotChange::View
        } else if self.facts().eq(before.facts()) && self.number == before.number && self.meshes == before.meshes {
            ShotChange::Look
        } else {
            ShotChange::Facts
        }
    }

    /// The settings that the facts of an object depend on.
    fn facts(&self) -> impl Iterator<Item = impl PartialEq> {
        self.objects.iter().map(|object| {
            let rows = object.function.nodes().2;
            let labels = |axis: &Axis<u32>| if let Axis::DistanceToLabel(id) = axis { Some(*id) } else { None };
            let distances = rows.map(|rows| rows.over.each_ref().map(labels));
            (object.reconstruction, object.rung, object.skip_empty, object.gradient_range, distances)
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::file::{Overrides, parse};
    use crate::plan::Plan;
    use crate::shot::VolumeFacts;
    use crate::space::Grid;
    use crate::transfer::Function;
    use crate::view::View;
    use crate::volume::{Volume, Voxels};
    use std::path::Path;
    use std::sync::Arc;

    /// The shot of a scene with further tables.
    fn shot(tables: &str) -> Shot {
        let head = "drypoint = 1\n[volume]\nfile = \"a.nrrd\"\n";
        let scene = parse(&format!("{head}{tables}"), Path::new("s"), &Overrides::default());
        let scene = scene.unwrap_or_else(|faults| panic!("{faults}"));
        let grid = Grid::with_spacing([9, 9, 9], [0.5, 1.0, 1.0]).unwrap();
        let volume = Volume::new(grid.clone(), Voxels::U8(vec![0; 729]), 1.0, 0.0).unwrap();
        let function =
            Function::new(scene.transfer.as_ref().unwrap(), [0.0, 9.0], &volume, &|_| None).unwrap().unwrap();
        let view = View::new(&scene.camera, &grid, scene.picture.size).unwrap();
        let facts = VolumeFacts { grid: &grid, is_integer: true };
        Shot::resolve(&scene, &Plan::new(&scene), facts, Arc::new(function), view).unwrap()
    }

    #[test]
    fn a_change_is_as_large_as_what_renderers_have_to_do() {
        let nodes = "[transfer]\nkind = \"regular\"\nnodes = [{ at = 1, color = \"red\", opacity = 1 }]\n";
        let before = format!("{nodes}[shading]\n");
        let cases = [
            (String::new(), ShotChange::Nothing),
            ("[camera]\ndirection = [1, 2, 3]\n".into(), ShotChange::View),
            ("[camera]\nheight = 3\n".into(), ShotChange::View),
            ("[camera]\nprojection = \"perspective\"\n".into(), ShotChange::Look),
            ("[picture]\nsize = [20, 30]\n".into(), ShotChange::Look),
            ("[[clip]]\nnormal = [1, 0, 0]\npoint = [0, 0, 0]\n".into(), ShotChange::Look),
            ("[sampling]\nstep = 0.3\n".into(), ShotChange::Look),
            ("[surface]\niso = 5\nlook = \"phong\"\n".into(), ShotChange::Look),
            ("[sampling]\nkernel = \"bspline\"\n".into(), ShotChange::Facts),
            ("[sampling]\nnumber = \"f32\"\n".into(), ShotChange::Facts),
            ("[sampling]\nskip_empty = false\n".into(), ShotChange::Facts),
        ];
        for (table, level) in cases {
            let [before, after] = [&before, &format!("{before}{table}")].map(|text| shot(text));
            assert_eq!(after.change_from(&before), level, "{table}");
            assert_eq!(before.change_from(&after), level, "{table}");
        }
        let white = before.replace("red", "white");
        assert_eq!(shot(&white).change_from(&shot(&before)), ShotChange::Look);
        // Without light no gradient is read.
        assert_eq!(shot(nodes).change_from(&shot(&before)), ShotChange::Facts);
    }
}
