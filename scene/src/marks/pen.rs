//! Pens.

/// What draws a layer: a pen of `[[pen]]`, or the colour that an effect has in place of one ([IO-7]).
#[derive(Clone, Debug, PartialEq)]
pub struct Pen {
    /// Number of the layer, from 1, in the order of `[[pen]]`.
    pub number: usize,
    /// What the layer is called.
    pub name: String,
    /// Across the nib, in mm.
    pub width: f64,
    /// Linear, straight.
    pub color: [f64; 4],
}

impl Pen {
    /// The layer's name for plotters: number, name and width, such as `1-black 0.3`; the first digits are the number.
    pub fn label(&self) -> String {
        format!("{}-{} {}", self.number, self.name, self.width)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_label_begins_with_the_number() {
        let pen = |number, name: &str, width| Pen { number, name: name.into(), width, color: [0.0, 0.0, 0.0, 1.0] };
        assert_eq!(pen(1, "black", 0.3).label(), "1-black 0.3");
        assert_eq!(pen(12, "2nd red", 1.0).label(), "12-2nd red 1");
    }
}
