//! `wedge`: a page to print and measure, and the plot of what was measured ([STIP-17]).

use crate::folder::Folder;

#[test]
fn a_page_its_table_and_its_plot() {
    let folder = Folder::new();
    for name in ["wedge.svg", "wedge.pdf", "wedge.png"] {
        folder.good(&format!("wedge -o {name} --pen black -q --set picture.dpi=100"));
    }
    let table = String::from_utf8(folder.read("wedge.csv")).unwrap();
    assert!(table.starts_with("wanted,measured\n0,\n0.05,\n"), "{table}");
    let svg = String::from_utf8(folder.read("wedge.svg")).unwrap();
    assert!(svg.contains("1-black 0.3") && svg.matches("h0").count() > 10_000);
    // Printed a quarter too dark.
    let measured: String = table
        .lines()
        .enumerate()
        .map(|(i, line)| match line.trim_end_matches(',').parse::<f64>() {
            Ok(wanted) => format!("{wanted},{}\n", (1.25 * wanted).min(1.0)),
            Err(_) => format!("{}{line}\n", if i == 0 { "" } else { "?" }),
        })
        .collect();
    folder.write("measured.csv", &measured);
    for name in ["plot.svg", "plot.png"] {
        folder.good(&format!("wedge --measured measured.csv -o {name} -q"));
    }
    // A table that is filled in stays, also where nobody may write to it.
    let mut permissions = std::fs::metadata(folder.path("wedge.csv")).unwrap().permissions();
    folder.write("wedge.csv", &measured);
    permissions.set_readonly(true);
    std::fs::set_permissions(folder.path("wedge.csv"), permissions).unwrap();
    let said = folder.line("wedge -o wedge.svg --pen black --set picture.dpi=100");
    assert!(said.code == Some(0) && said.err.ends_with("wedge.csv: is there and stays as it is\n"), "{}", said.err);
    assert_eq!(folder.read("wedge.csv"), measured.as_bytes());
    // With the table the page has fewer dots.
    let pens = "pen=[{name=\"black\",tone=\"measured.csv\"}]";
    let said = folder.run(["wedge", "-o", "second.svg", "--pen", "black", "--set", pens]);
    assert_eq!(said.code, Some(0), "{}", said.err);
    let second = String::from_utf8(folder.read("second.svg")).unwrap();
    assert!(second.matches("h0").count() * 5 < svg.matches("h0").count() * 4);
}

#[test]
fn faults_are_told() {
    let folder = Folder::new();
    folder.write("bad.csv", "wanted,measured\n0.1,0.1\n0.2,2\n");
    for (line, words) in [
        ("wedge -o a.csv --pen black", &["written beside the page", "a.csv"][..]),
        ("wedge -o a.svg", &["--pen"]),
        ("wedge --measured bad.csv -o a.svg", &["found 2, expected a coverage from 0 to 1", "bad.csv, line 3"]),
        ("wedge --measured none.csv -o a.svg", &["cannot be read", "none.csv"]),
        ("wedge --measured bad.csv -o a.pdf", &["not written as .pdf"]),
    ] {
        let said = folder.line(line);
        assert_eq!(said.code, Some(2), "{line}: {}", said.err);
        assert!(words.iter().all(|word| said.err.contains(word)), "{line}: {}", said.err);
    }
    let pens = "pen=[{name=\"fine\"}]";
    let said = folder.run(["wedge", "-o", "a.svg", "--pen", "broad", "--set", pens]);
    assert!(said.code == Some(2) && said.err.contains("no pen \"broad\"") && said.err.contains("fine"), "{}", said.err);
    assert!(!folder.path("a.svg").exists());
}
