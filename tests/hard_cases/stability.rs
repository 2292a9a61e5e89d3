//! Every hard case as a record: what could break, what is done, and how far off it may be and is. The same record is a
//! test and a row of `docs/stability.md`.

use drypoint::scene::tables::Number;
use std::path::Path;
use std::sync::OnceLock;

/// One hard case.
pub(crate) struct Case {
    /// What is done to the picture.
    pub(crate) name: &'static str,
    /// What could break.
    pub(crate) breaks: &'static str,
    /// What is done about it, with the rule.
    pub(crate) done: &'static str,
    /// What is measured, in which unit.
    pub(crate) of: &'static str,
    /// The largest that it may be; 0 where nothing may differ.
    pub(crate) bound: f64,
    /// Where the bound comes from.
    pub(crate) why: &'static str,
    /// Measures it. A case that has nothing to measure panics.
    pub(crate) measure: fn() -> f64,
}

/// The hard cases of a file.
pub(crate) struct Theme {
    title: &'static str,
    cases: &'static [Case],
    /// What was measured, so that test and page need it once.
    found: OnceLock<Vec<f64>>,
}

/// Half of what 1 and the next f32 are apart: what one rounding in f32 takes of a number at most.
pub(crate) const U: f64 = f32::EPSILON as f64 / 2.0;

/// What one rounding takes of a number of that type at most.
pub(crate) fn rounding(number: Number) -> f64 {
    match number {
        Number::F64 => f64::EPSILON / 2.0,
        Number::F32 => U,
    }
}

/// Every theme, in the order of the page.
static THEMES: &[&Theme] = &[
    &crate::slabs::THEME,
    &crate::steps::THEME,
    &crate::eye::THEME,
    &crate::symmetry::THEME,
    &crate::mirror::THEME,
    &crate::scales::THEME,
    &crate::anisotropy::THEME,
    &crate::offset::THEME,
    &crate::degenerate::THEME,
    &crate::thresholds::THEME,
    &crate::opacities::THEME,
    &crate::styles::THEME,
    &crate::termination::THEME,
    &crate::borders::THEME,
    &crate::small::THEME,
    &crate::masks::THEME,
    &crate::meshes::THEME,
    &crate::empty::THEME,
    &crate::surfaces::THEME,
    &crate::stipples::THEME,
    &crate::toon::THEME,
    &crate::lighting::THEME,
    &crate::strokes::THEME,
    &crate::halos::THEME,
    &crate::objects::THEME,
];

/// What makes the page be written.
const WRITE: &str = "DRYPOINT_WRITE_STABILITY";

impl Theme {
    pub(crate) const fn new(title: &'static str, cases: &'static [Case]) -> Self {
        Self { title, cases, found: OnceLock::new() }
    }

    fn found(&self) -> &[f64] {
        self.found.get_or_init(|| self.cases.iter().map(|case| (case.measure)()).collect())
    }

    /// Asserts that every case keeps its bound, and says what was measured.
    pub(crate) fn hold(&self) {
        assert!(THEMES.iter().any(|theme| std::ptr::eq(*theme, self)), "{} is not among the themes", self.title);
        let mut broken = Vec::new();
        for (case, &found) in self.cases.iter().zip(self.found()) {
            println!("{}: {found:e} of {:e}, {}", case.name, case.bound, case.of);
            // What is not a number is no error that is small enough.
            if !(0.0..=case.bound).contains(&found) {
                broken.push(format!("{}: {} is {found:e}, bound {:e}", case.name, case.of, case.bound));
            }
        }
        assert!(broken.is_empty(), "{}\n{}", self.title, broken.join("\n"));
    }
}

/// How many of two lists' numbers differ; all where they are not of one length.
pub(crate) fn differing<T: PartialEq>(a: &[T], b: &[T]) -> f64 {
    let differ = a.iter().zip(b).filter(|(a, b)| a != b).count();
    if a.len() == b.len() { differ as f64 } else { a.len().max(b.len()) as f64 }
}

/// The larger of two errors; NaN where one of them is, which `f64::max` would hide.
pub(crate) fn worse(a: f64, b: f64) -> f64 {
    if a.is_nan() || b.is_nan() { f64::NAN } else { a.max(b) }
}

/// The worst of many errors.
pub(crate) fn worst(errors: impl IntoIterator<Item = f64>) -> f64 {
    errors.into_iter().fold(0.0, worse)
}

/// A number of the page: two digits, rounded up.
fn number(x: f64) -> String {
    if x == 0.0 {
        return "0".into();
    }
    let nearest = format!("{x:.1e}");
    let (digits, exponent) = nearest.split_once('e').unwrap();
    let (mut tenths, mut exponent): (u32, i32) = (digits.replace('.', "").parse().unwrap(), exponent.parse().unwrap());
    if nearest.parse::<f64>().unwrap() < x {
        tenths += 1;
    }
    if tenths == 100 {
        (tenths, exponent) = (10, exponent + 1);
    }
    // As text and back: the shortest digits of a number are those that are meant.
    let short = |e: i32| format!("{tenths}e{e}").parse::<f64>().unwrap().to_string();
    if (-2..4).contains(&exponent) {
        return short(exponent - 1);
    }
    let raised = |c| match c {
        '-' => '⁻',
        '1' => '¹',
        '2' => '²',
        '3' => '³',
        // The other superscripts stand in a row.
        c => char::from_u32(0x2070 + c as u32 - '0' as u32).unwrap(),
    };
    let power: String = exponent.to_string().chars().map(raised).collect();
    if tenths == 10 { format!("10{power}") } else { format!("{}·10{power}", short(-1)) }
}

/// The page.
fn page() -> String {
    let count: usize = THEMES.iter().map(|theme| theme.cases.len()).sum();
    let mut page = HEAD.replace("{count}", &count.to_string());
    for theme in THEMES {
        page += &format!("\n## {}\n\n", theme.title);
        page += "| case | what could break | what is done | what is measured | bound | why | measured |\n";
        page += "|---|---|---|---|--:|---|--:|\n";
        for (case, &found) in theme.cases.iter().zip(theme.found()) {
            // A bar within a cell would end it.
            let [name, breaks, done, of, why] =
                [case.name, case.breaks, case.done, case.of, case.why].map(|text| text.replace('|', "\\|"));
            let (bound, found) = (number(case.bound), number(found));
            page += &format!("| {name} | {breaks} | {done} | {of} | {bound} | {why} | {found} |\n");
        }
    }
    page
}

const HEAD: &str = "# Stability

What could go wrong at the edges of the mathematics, what is done about it, and how far off the renderer is then.
Each of the {count} rows is a test in `tests/hard_cases`: it measures an error, and the error must keep a bound that follows from the formulas.
A bound of 0 means that not one number may differ.

`cargo run --release -p drypoint-docs -- stability` measures all of them and writes this page.
Measured errors are rounded up to two digits; another machine may differ in them where a test itself calls its system's functions, never in a bound.
Pictures do not differ between machines: a test holds the hashes of twelve files, PNG, EXR, SVG, PDF, lists and a volume, with styles, labels, contours, Phong, an iso-surface, stipples and strokes, in f64 and f32; it was run on x86-64 with AVX2, and on aarch64 under qemu, on Linux. A picture drawn in WebAssembly has the bytes of that on x86-64.
ε is 2⁻⁵², u is 2⁻²⁴, half of the ε of f32, α₀ an opacity per reference length Δ₀, Δ the step, L the length of a ray inside the box; *in units of* a bound means that the bound is 1 there.

Rows in f32 have `sampling.number = \"f32\"`, which rays alone know: points, strokes and outlines are computed in f64 whatever it says, so that their themes have no such row.
";

/// A page without its last column, which is what was measured.
fn without_measured(page: &str) -> String {
    let row = |line: &str| match line.trim_end_matches('|').rsplit_once('|') {
        Some((rest, _)) if line.starts_with("| ") => rest.to_owned(),
        _ => line.to_owned(),
    };
    page.lines().map(row).collect::<Vec<_>>().join("\n")
}

#[test]
fn the_page_has_every_case_and_its_bound() {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("docs/stability.md");
    if std::env::var_os(WRITE).is_some() {
        THEMES.iter().for_each(|theme| theme.hold());
        std::fs::write(&path, page()).unwrap();
        return;
    }
    let there = std::fs::read_to_string(&path).unwrap().replace("\r\n", "\n");
    let hint = "write it with: cargo run --release -p drypoint-docs -- stability";
    assert_eq!(without_measured(&there), without_measured(&page()), "{hint}");
}

#[test]
fn numbers_are_rounded_up() {
    let shown = [0.0, 1e-12, 1.01e-12, 9.99e-13, 3.1101, 0.0421, 12.0, 160.0, 0.5, 1.0, 2e30, 0.00999];
    let texts = ["0", "10⁻¹²", "1.1·10⁻¹²", "10⁻¹²", "3.2", "0.043", "12", "160", "0.5", "1", "2·10³⁰", "0.01"];
    assert_eq!(shown.map(number), texts);
}

#[test]
fn what_is_no_number_is_the_worst() {
    assert!(worst([0.0, f64::NAN, 1.0]).is_nan() && worst([2.0, 1.0]) == 2.0);
    assert_eq!([differing(&[1, 2], &[1, 3]), differing(&[1], &[1, 2]), differing(&[1], &[1])], [1.0, 2.0, 0.0]);
}
