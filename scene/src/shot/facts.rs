//! Settings of a shot that measured facts of its data depend on.

use super::{Axis, Shot};

impl Shot {
    /// Whether the facts that were measured for the shot `before` are those of this one, over the same volumes. Facts of meshes
    /// and distances to labels depend on data that may differ, so they are measured for each shot.
    pub fn keeps_facts_of(&self, before: &Self) -> bool {
        self.number == before.number && self.meshes.is_empty() && before.meshes.is_empty() && {
            let [settings, old] = [self, before].map(|shot| shot.facts().collect::<Option<Vec<_>>>());
            settings.is_some() && settings == old
        }
    }

    /// The settings that the facts of each object depend on; none for one that has distances to labels.
    fn facts(&self) -> impl Iterator<Item = Option<impl PartialEq>> {
        self.objects.iter().map(|object| {
            let rows = object.function.nodes().2;
            let is_to_label = |axis: &Axis<u32>| matches!(axis, Axis::DistanceToLabel(_));
            let has_distances = rows.is_some_and(|rows| rows.over.iter().any(is_to_label));
            (!has_distances).then_some((object.reconstruction, object.rung, object.skip_empty, object.gradient_range))
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
    fn facts_stay_unless_a_setting_that_they_depend_on_differs() {
        let nodes = "[transfer]\nkind = \"regular\"\nnodes = [{ at = 1, color = \"red\", opacity = 1 }]\n";
        let before = format!("{nodes}[shading]\n");
        let cases = [
            ("", true),
            ("[camera]\ndirection = [1, 2, 3]\n", true),
            ("[camera]\nprojection = \"perspective\"\n", true),
            ("[picture]\nsize = [20, 30]\n", true),
            ("[[clip]]\nnormal = [1, 0, 0]\npoint = [0, 0, 0]\n", true),
            ("[sampling]\nstep = 0.3\n", true),
            ("[surface]\niso = 5\nlook = \"phong\"\n", true),
            ("[sampling]\nkernel = \"bspline\"\n", false),
            ("[sampling]\nnumber = \"f32\"\n", false),
            ("[sampling]\nskip_empty = false\n", false),
            ("[[mesh]]\nfile = \"a.ply\"\n", false),
        ];
        for (table, keeps) in cases {
            let [before, after] = [&before, &format!("{before}{table}")].map(|text| shot(text));
            assert_eq!(after.keeps_facts_of(&before), keeps, "{table}");
            assert_eq!(before.keeps_facts_of(&after), keeps, "{table}");
        }
        let white = before.replace("red", "white");
        assert!(shot(&white).keeps_facts_of(&shot(&before)));
        // Without light no gradient is read.
        assert!(!shot(nodes).keeps_facts_of(&shot(&before)));
    }
}
