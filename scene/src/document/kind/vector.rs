//! Vectors, ranges and sizes.

use super::number::{Bounds, Whole};
use crate::document::check::Check;
use crate::document::describe::{Kind, Shape};
use crate::document::item::Item;
use crate::document::out::Out;
use serde_json::{Value as Json, json};

/// `N` numbers.
pub(crate) struct Numbers<const N: usize> {
    /// The value in words: `a point [x, y, z]`.
    pub(crate) what: &'static str,
    pub(crate) bounds: Bounds,
    pub(crate) rule: Rule,
}

/// A rule for `N` numbers together.
#[derive(Clone, Copy, PartialEq, Eq)]
pub(crate) enum Rule {
    /// Anything.
    Free,
    /// In non-decreasing order.
    Ascending,
    /// Not all 0.
    Direction,
}

impl<const N: usize> Numbers<N> {
    /// The item as `N` numbers, if it has as many and they obey the rules.
    pub(crate) fn of(&self, item: &Item) -> Option<[f64; N]> {
        let numbers: Option<Vec<f64>> = item.list()?.iter().map(Item::number).collect();
        let numbers: [f64; N] = numbers?.try_into().ok()?;
        let together = match self.rule {
            Rule::Free => true,
            Rule::Ascending => numbers.is_sorted(),
            Rule::Direction => numbers.iter().any(|&x| x != 0.0),
        };
        (together && numbers.iter().all(|&x| self.bounds.contain(x))).then_some(numbers)
    }
}

impl<const N: usize> Shape for Numbers<N> {
    fn expected(&self) -> String {
        let each = match self.bounds.words() {
            words if words.is_empty() => String::new(),
            words => format!(", each{words}"),
        };
        let together = match self.rule {
            Rule::Free => "",
            Rule::Ascending => ", the lower one first",
            Rule::Direction => ", not all 0",
        };
        format!("{}{each}{together}", self.what)
    }

    fn schema(&self) -> Json {
        json!({ "type": "array", "items": self.bounds.schema(), "minItems": N, "maxItems": N })
    }
}

impl<const N: usize> Kind for Numbers<N> {
    type Of = [f64; N];

    fn read(&self, item: &Item, check: &mut Check) -> Option<[f64; N]> {
        self.of(item).or_else(|| check.wrong(item, self.expected()))
    }

    fn write(&self, value: &[f64; N]) -> Out {
        Out::numbers(value)
    }
}

/// `N` whole numbers whose product is bounded, too, so that an allocation of this size is bounded.
pub(crate) struct Wholes<const N: usize> {
    /// The value in words: `a size [width, height]`.
    pub(crate) what: &'static str,
    pub(crate) each: Whole,
    /// Largest product.
    pub(crate) product: u64,
    /// The things that the product counts: `pixels`.
    pub(crate) of_what: &'static str,
}

impl<const N: usize> Wholes<N> {
    /// The item as `N` numbers, if it has as many and they obey the rules.
    pub(crate) fn of(&self, item: &Item) -> Option<[usize; N]> {
        let numbers: Option<Vec<u64>> = item.list()?.iter().map(|item| self.each.of(item)).collect();
        let numbers: [u64; N] = numbers?.try_into().ok()?;
        self.fits(numbers)
    }

    /// The numbers, if they and their product are small enough.
    pub(crate) fn fits(&self, numbers: [u64; N]) -> Option<[usize; N]> {
        let product = numbers.iter().try_fold(1u64, |product, &n| product.checked_mul(n))?;
        let all = numbers.iter().all(|n| (self.each.lo..=self.each.hi).contains(n)) && product <= self.product;
        let sizes: Option<Vec<usize>> = numbers.iter().map(|&n| usize::try_from(n).ok()).collect();
        sizes?.try_into().ok().filter(|_| all)
    }
}

impl<const N: usize> Shape for Wholes<N> {
    fn expected(&self) -> String {
        let Self { what, each, product, of_what } = self;
        format!("{what}, each a whole number{}, at most {product} {of_what}", each.words())
    }

    fn schema(&self) -> Json {
        json!({ "type": "array", "items": self.each.schema(), "minItems": N, "maxItems": N })
    }
}

impl<const N: usize> Kind for Wholes<N> {
    type Of = [usize; N];

    fn read(&self, item: &Item, check: &mut Check) -> Option<[usize; N]> {
        self.of(item).or_else(|| check.wrong(item, self.expected()))
    }

    fn write(&self, value: &[usize; N]) -> Out {
        Out::List(value.iter().map(|&n| Out::Whole(n as u64)).collect())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_product_is_bounded_without_overflow() {
        let size: Wholes<2> =
            Wholes { what: "a size", each: Whole { lo: 1, hi: u64::MAX }, product: 1 << 30, of_what: "pixels" };
        assert_eq!(size.fits([1 << 15, 1 << 15]), Some([1 << 15, 1 << 15]));
        assert_eq!(size.fits([1 << 15, (1 << 15) + 1]), None);
        assert_eq!(size.fits([1 << 40, 1 << 40]), None, "overflows 64 bits");
        assert_eq!(size.fits([0, 5]), None);
    }
}
