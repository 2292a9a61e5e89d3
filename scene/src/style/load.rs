//! The styles that a transfer function names, found and decoded.

use super::theme::read;
use super::{Style, StyleError, Theme};
use crate::nearest::nearest;
use crate::source::Source;
use crate::tables::Styles;

/// The M distinct styles among the names `used`, each once, in the order in which they first occur. The index j of
/// [STF-3] is the position in the result. A single file of `[styles]` overrides the theme's style of the same name. If
/// no style is used, no file is opened. Only the pictures of used styles are decoded.
///
/// # Errors
/// A theme that does not exist, a style that neither the theme nor `[styles]` has (with the nearest name and all the
/// known ones), a file that cannot be read, or a picture that is no style.
pub fn load<'a>(
    files: &dyn Source,
    styles: &Styles,
    used: impl IntoIterator<Item = &'a str>,
) -> Result<Vec<Style>, StyleError> {
    let mut names: Vec<&str> = Vec::new();
    for name in used {
        if !names.contains(&name) {
            names.push(name);
        }
    }
    if names.is_empty() {
        return Ok(Vec::new());
    }
    let theme = Theme::open(files, &styles.theme)?;
    names.into_iter().map(|name| find(files, styles, &theme, name)).collect()
}

fn find(files: &dyn Source, styles: &Styles, theme: &Theme, name: &str) -> Result<Style, StyleError> {
    if let Some((_, single)) = styles.files.iter().find(|(known, _)| known == name) {
        return read(files, name, &single.path, single.linear);
    }
    theme.style(files, name).unwrap_or_else(|| {
        let mut known: Vec<String> =
            theme.names().map(Into::into).chain(styles.files.iter().map(|(name, _)| name.clone())).collect();
        known.sort();
        known.dedup();
        let near = nearest(name, known.iter().map(String::as_str)).map(Into::into);
        Err(StyleError::Unknown { name: name.into(), theme: theme.to_string(), near, known })
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::source::Disk;
    use crate::style::PictureFault;
    use crate::tables::{StyleFile, StyleSource};
    use image::{Rgba, RgbaImage};
    use std::path::PathBuf;

    /// A folder under the system's temporary one, emptied first and removed at the end.
    struct Folder(PathBuf);

    impl Folder {
        fn new(test: &str) -> Self {
            let path = std::env::temp_dir().join(format!("drypoint-styles-{}-{test}", std::process::id()));
            let _ = std::fs::remove_dir_all(&path);
            std::fs::create_dir_all(&path).unwrap();
            Self(path)
        }

        fn paint(&self, file: &str, texel: [u8; 4]) -> PathBuf {
            let path = self.0.join(file);
            RgbaImage::from_pixel(2, 2, Rgba(texel)).save_with_format(&path, image::ImageFormat::Png).unwrap();
            path
        }

        fn theme(&self) -> Styles {
            Styles { theme: StyleSource::Folder(self.0.clone()), files: Vec::new() }
        }
    }

    impl Drop for Folder {
        fn drop(&mut self) {
            let _ = std::fs::remove_dir_all(&self.0);
        }
    }

    #[test]
    fn the_format_knows_the_embedded_themes() {
        assert!(Theme::embedded_names().eq(crate::tables::styles::THEMES));
    }

    #[test]
    fn the_textbook_theme_is_there_and_square() {
        let names: Vec<String> =
            Theme::open(&Disk, &Styles::default().theme).unwrap().names().map(Into::into).collect();
        assert!(names.len() >= 6 && names.contains(&"wax".into()) && names.contains(&"metal".into()));
        for style in load(&Disk, &Styles::default(), names.iter().map(String::as_str)).unwrap() {
            assert_eq!(style.texels.len(), style.side * style.side, "{}", style.name);
        }
    }

    #[test]
    fn each_style_comes_once_in_order_of_first_use() {
        let styles = load(&Disk, &Styles::default(), ["wax", "metal", "wax", "bone", "metal"]).unwrap();
        let names: Vec<&str> = styles.iter().map(|style| style.name.as_str()).collect();
        assert_eq!(names, ["wax", "metal", "bone"]);
    }

    #[test]
    fn a_folder_is_a_theme_and_a_single_file_goes_over_it() {
        let folder = Folder::new("over");
        folder.paint("wax.png", [255, 0, 0, 255]);
        folder.paint("metal.PNG", [0, 255, 0, 255]);
        folder.paint(".hidden.png", [0; 4]);
        std::fs::write(folder.0.join("notes.txt"), "not a style").unwrap();
        let mut table = folder.theme();
        let theme = Theme::open(&Disk, &table.theme).unwrap();
        assert_eq!(theme.names().collect::<Vec<_>>(), ["metal", "wax"]);
        let other = folder.paint("other.picture", [0, 0, 255, 255]);
        table.files.push(("wax".into(), StyleFile { path: other, linear: true }));
        let styles = load(&Disk, &table, ["wax", "metal"]).unwrap();
        assert_eq!(styles[0].texel(0, 0), [0.0, 0.0, 1.0, 1.0]);
        assert_eq!(styles[1].texel(0, 0), [0.0, 1.0, 0.0, 1.0]);
    }

    #[test]
    fn an_unknown_style_is_named_with_its_neighbour_and_all_there_are() {
        let folder = Folder::new("unknown");
        folder.paint("bone.png", [0; 4]);
        folder.paint("metal.png", [0; 4]);
        let mut table = folder.theme();
        table.files.push(("wax".into(), StyleFile { path: "wax.png".into(), linear: false }));
        let text = load(&Disk, &table, ["metall"]).unwrap_err().to_string();
        let theme = folder.0.display();
        assert_eq!(
            text,
            format!("no style `metall` in theme {theme} (did you mean `metal`?); it has `bone`, `metal`, `wax`")
        );
        let text = load(&Disk, &Styles::default(), ["terracotta"]).unwrap_err().to_string();
        assert!(text.starts_with("no style `terracotta` in theme `textbook`; it has `bone`, "), "{text}");
    }

    #[test]
    fn an_unknown_theme_is_named_with_its_neighbour() {
        let table = Styles { theme: StyleSource::Embedded("textbok".into()), files: Vec::new() };
        let text = load(&Disk, &table, ["wax"]).unwrap_err().to_string();
        assert_eq!(
            text,
            "no theme `textbok` (did you mean `textbook`?); the program has `textbook`, `naturalist`, `studio`"
        );
        assert_eq!(load(&Disk, &table, []), Ok(Vec::new()));
    }

    #[test]
    fn faults_name_the_style_and_the_file() {
        let folder = Folder::new("faults");
        let missing = folder.0.join("no-such.png");
        let broken = folder.0.join("broken.png");
        std::fs::write(&broken, b"no picture").unwrap();
        let mut table = Styles::default();
        table.files.push(("a".into(), StyleFile { path: missing.clone(), linear: false }));
        table.files.push(("b".into(), StyleFile { path: broken.clone(), linear: false }));
        let text = load(&Disk, &table, ["a"]).unwrap_err().to_string();
        assert!(text.starts_with(&format!("style `a`: {}: ", missing.display())), "{text}");
        let error = load(&Disk, &table, ["b"]).unwrap_err();
        assert!(matches!(&error, StyleError::Picture { name, file, fault: PictureFault::Unreadable { .. } }
            if name == "b" && *file == broken));
    }

    #[test]
    fn two_pictures_of_one_name_are_ambiguous() {
        let folder = Folder::new("ambiguous");
        folder.paint("wax.png", [0; 4]);
        folder.paint("wax.jpeg", [0; 4]);
        let error = load(&Disk, &folder.theme(), ["wax"]).unwrap_err();
        assert!(matches!(&error, StyleError::Ambiguous { files, .. } if files == &["wax.jpeg", "wax.png"]), "{error}");
        let nowhere = Styles { theme: StyleSource::Folder(folder.0.join("none")), files: Vec::new() };
        assert!(matches!(load(&Disk, &nowhere, ["wax"]), Err(StyleError::Folder { .. })));
    }
}
