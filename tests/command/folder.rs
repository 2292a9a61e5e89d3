//! A folder of its own for each test, and the binary run in it.

use std::ffi::OsStr;
use std::io::Write;
use std::path::{Path, PathBuf};
use std::process::{Command, Output, Stdio};

/// A folder that goes away with the test.
pub(crate) struct Folder(tempfile::TempDir);

/// What a run said.
pub(crate) struct Said {
    pub(crate) code: Option<i32>,
    pub(crate) out: String,
    pub(crate) err: String,
}

impl Folder {
    pub(crate) fn new() -> Self {
        Self(tempfile::tempdir().unwrap())
    }

    pub(crate) fn path(&self, name: &str) -> PathBuf {
        self.0.path().join(name)
    }

    pub(crate) fn write(&self, name: &str, bytes: impl AsRef<[u8]>) {
        let path = self.path(name);
        std::fs::create_dir_all(path.parent().unwrap()).unwrap();
        std::fs::write(path, bytes).unwrap();
    }

    pub(crate) fn read(&self, name: &str) -> Vec<u8> {
        std::fs::read(self.path(name)).unwrap_or_else(|e| panic!("{name}: {e}"))
    }

    /// Every file and folder below, with its length, in alphabetical order.
    pub(crate) fn listing(&self) -> Vec<(PathBuf, u64)> {
        fn walk(folder: &Path, found: &mut Vec<(PathBuf, u64)>) {
            for entry in std::fs::read_dir(folder).unwrap() {
                let entry = entry.unwrap();
                // A file that is being replaced may be gone by now.
                let Ok(metadata) = entry.metadata() else { continue };
                let is_folder = metadata.is_dir();
                found.push((entry.path(), if is_folder { 0 } else { metadata.len() }));
                if is_folder {
                    walk(&entry.path(), found);
                }
            }
        }
        let mut found = Vec::new();
        walk(self.0.path(), &mut found);
        found.sort();
        found
    }

    /// The binary in this folder, with no shared volumes and nothing on standard input.
    pub(crate) fn command<S: AsRef<OsStr>>(&self, words: impl IntoIterator<Item = S>) -> Command {
        let mut command = Command::new(env!("CARGO_BIN_EXE_drypoint"));
        command.args(words).current_dir(self.0.path()).env("DRYPOINT_DATA", "").stdin(Stdio::null());
        command
    }

    pub(crate) fn run<S: AsRef<OsStr>>(&self, words: impl IntoIterator<Item = S>) -> Said {
        said(self.command(words).output().unwrap())
    }

    /// Runs a line of words without blanks in them.
    pub(crate) fn line(&self, line: &str) -> Said {
        self.run(line.split(' ').filter(|word| !word.is_empty()))
    }

    /// The same with a text on standard input.
    pub(crate) fn line_with(&self, line: &str, input: &str) -> Said {
        let mut command = self.command(line.split(' '));
        let mut child = command.stdin(Stdio::piped()).stdout(Stdio::piped()).stderr(Stdio::piped()).spawn().unwrap();
        // A command may end before it has read all.
        let _ = child.stdin.take().unwrap().write_all(input.as_bytes());
        said(child.wait_with_output().unwrap())
    }

    /// Runs a line that must succeed, and gives what it printed.
    pub(crate) fn good(&self, line: &str) -> String {
        let said = self.line(line);
        assert_eq!(said.code, Some(0), "{line}\n{}", said.err);
        said.out
    }

    /// Runs a line that must be refused with exit code 2, nothing on standard output, and no file changed; gives what it
    /// said.
    pub(crate) fn refused(&self, line: &str) -> String {
        let before = self.listing();
        let said = self.line(line);
        assert_eq!(said.code, Some(2), "{line}\n{}", said.err);
        assert_eq!(said.out, "", "{line}");
        assert_eq!(self.listing(), before, "{line}");
        let lines: Vec<&str> = said.err.lines().collect();
        for three in lines.chunks(3) {
            let begins = |i: usize, mark: &str| three.get(i).is_some_and(|line: &&str| line.starts_with(mark));
            assert!(begins(0, "error: ") && begins(1, "  at: ") && begins(2, "  try: "), "{line}\n{}", said.err);
        }
        said.err
    }

    /// A torus in f64 with 24 voxels a side, as `torus.nrrd`.
    pub(crate) fn torus(&self) {
        self.good("-q phantom torus --size 24 --type f64 -o torus.nrrd");
    }

    /// A small scene of a torus, as `scene.toml`, with more lines at its end.
    pub(crate) fn scene(&self, more: &str) {
        self.write("scene.toml", format!("{SCENE}{more}"));
    }
}

/// A torus in wax, small enough to be rendered in no time.
pub(crate) const SCENE: &str = r#"drypoint = 1
[volume]
phantom = { name = "torus", size = 20 }
[picture]
size = [24, 16]
[transfer]
nodes = [{ at = 90, style = "wax", opacity = 0 }, { at = 160, style = "wax", opacity = 0.9 }]
"#;

fn said(output: Output) -> Said {
    let text = |bytes: Vec<u8>| String::from_utf8(bytes).unwrap();
    Said { code: output.status.code(), out: text(output.stdout), err: text(output.stderr) }
}
