//! Verbs, flags, and how wrong ones are refused.

use crate::folder::Folder;
use std::process::Stdio;

#[test]
fn without_a_verb_it_renders() {
    let folder = Folder::new();
    folder.good("-q --size 12x9 --set volume.phantom.size=24");
    folder.good("-q render --size 12x9 --set volume.phantom.size=24 -o same.png");
    assert_eq!(folder.read("drypoint.png"), folder.read("same.png"));
    folder.scene("");
    assert_eq!(folder.line("scene.toml").err, "scene.png\n");
    assert_eq!(folder.line("render scene.toml -q").err, "");
}

#[test]
fn help_and_version_are_no_errors() {
    let folder = Folder::new();
    for line in ["--help", "-h", "help", "help probe", "render --help", "-q probe -h"] {
        assert!(folder.good(line).contains("Usage: drypoint"), "{line}");
    }
    assert_eq!(folder.good("--version"), concat!("drypoint ", env!("CARGO_PKG_VERSION"), "\n"));
    let help = folder.good("--help");
    for verb in [
        "render",
        "view",
        "info",
        "probe",
        "pick",
        "phantom",
        "plan",
        "styles",
        "compare",
        "cost",
        "figure",
        "sheet",
        "halo",
        "wedge",
        "schema",
        "completions",
    ] {
        assert!(help.contains(&format!("\n  {verb} ")), "{verb}\n{help}");
    }
}

#[test]
fn wrong_use_is_told_in_three_lines() {
    let folder = Folder::new();
    for (line, expected) in [
        (
            "rendre",
            "error: there is no verb \"rendre\"\n  at: drypoint\n  try: write render; `drypoint --help` tells what there is\n",
        ),
        (
            "render --sise 3x4",
            "error: unexpected argument '--sise' found\n  at: drypoint render\n  try: write --size; `drypoint render --help` tells what there is\n",
        ),
        (
            "phantom",
            "error: the following required arguments were not provided: --output <FILE> <NAME>\n  at: drypoint phantom\n  try: `drypoint phantom --help` tells what there is\n",
        ),
        (
            "render --backend gpuu",
            "error: invalid value 'gpuu' for '--backend <BACKEND>' [possible values: reference, gpu, gpu-fast]\n  at: drypoint render\n  try: write gpu; `drypoint render --help` tells what there is\n",
        ),
        (
            "-q -v",
            "error: the argument '--quiet' cannot be used with '--verbose'\n  at: drypoint render\n  try: `drypoint render --help` tells what there is\n",
        ),
        (
            "render --threads 0",
            "error: invalid value '0' for '--threads <N>': 0 is not in 1..=1024\n  at: drypoint render\n  try: `drypoint render --help` tells what there is\n",
        ),
        (
            "render --size 800",
            "error: \"800\" is no size\n  at: --size 800\n  try: write width and height in pixels, such as 800x600\n",
        ),
    ] {
        assert_eq!(folder.refused(line), expected, "{line}");
    }
}

/// A command without graphics says how to get them; one with graphics that finds no adapter says what to install.
#[test]
fn a_card_that_is_not_there_is_an_error_with_a_remedy() {
    let folder = Folder::new();
    let (what, remedy) = match cfg!(feature = "gpu") {
        false => (
            "this command was built without the GPU backend",
            "build it with `cargo build --release --features gpu`, or leave --backend out: the CPU renders",
        ),
        true => (
            "no graphics adapter was found",
            "install a Vulkan driver (on Debian without a graphics card: mesa-vulkan-drivers), or leave --backend out",
        ),
    };
    // Elsewhere than on Linux a card may be there.
    if cfg!(all(feature = "gpu", not(target_os = "linux"))) {
        return;
    }
    let none = [("VK_DRIVER_FILES", "/none"), ("VK_ICD_FILENAMES", "/none")];
    for line in ["render --backend gpu", "validate scene.toml"] {
        let output = folder.command(line.split(' ')).envs(none).output().unwrap();
        let expected = format!("error: {what}\n  at: --backend gpu\n  try: {remedy}\n");
        assert_eq!((output.status.code(), String::from_utf8(output.stderr).unwrap()), (Some(2), expected));
    }
}

#[test]
fn a_reader_that_goes_away_is_no_error() {
    let folder = Folder::new();
    let mut child = folder.command(["schema"]).stdout(Stdio::piped()).stderr(Stdio::piped()).spawn().unwrap();
    drop(child.stdout.take());
    let output = child.wait_with_output().unwrap();
    assert_eq!((output.status.code(), output.stderr.as_slice()), (Some(0), &b""[..]));
}

#[test]
fn nor_is_a_closed_standard_error() {
    let folder = Folder::new();
    folder.scene("");
    let mut child = folder.command(["-v", "scene.toml"]).stderr(Stdio::piped()).spawn().unwrap();
    drop(child.stderr.take());
    assert_eq!(child.wait().unwrap().code(), Some(0));
    assert!(folder.path("scene.png").is_file());
    let mut child = folder.command(["gone.toml"]).stderr(Stdio::piped()).spawn().unwrap();
    drop(child.stderr.take());
    assert_eq!(child.wait().unwrap().code(), Some(2));
}
