//! Says what a mesh file holds: `cargo run --release --example inspect -- teapot.stl`, with `--cross` also which faces cross
//! one another, with `--time` how long reading and looking took.

use std::path::Path;
use std::time::Instant;

use luch_mesh::codec::{self, Format};
use luch_mesh::inspect::{Options, inspect};

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let words: Vec<String> = std::env::args().skip(1).collect();
    let (flags, files): (Vec<&String>, Vec<&String>) = words.iter().partition(|word| word.starts_with("--"));
    let [path] = *files else { return Err("usage: inspect FILE [--cross] [--time]".into()) };
    let has = |name: &str| flags.iter().any(|flag| *flag == name);
    let start = Instant::now();
    let bytes = std::fs::read(path)?;
    let extension = Path::new(path).extension().and_then(|e| e.to_str()).unwrap_or("");
    let format = Format::from_extension(extension)
        .or_else(|| Format::from_magic(&bytes))
        .ok_or("neither OBJ, PLY, STL, OFF nor 3MF")?;
    let read = start.elapsed();
    let decoded = codec::decode(&bytes, format).map_err(|error| format!("{path}: {error}"))?;
    drop(bytes);
    let decode = start.elapsed() - read;
    let report =
        inspect(&decoded.mesh, &Options { self_intersections: has("--cross"), ..Options::default() });
    let look = start.elapsed() - read - decode;
    let mut text: String = decoded.warnings.iter().map(|warning| format!("warning: {warning}\n")).collect();
    text += &report.to_string();
    if has("--time") {
        text += &format!("seconds: {read:.3?} from the disk, {decode:.3?} to decode, {look:.3?} to look\n");
    }
    std::io::Write::write_all(&mut std::io::stdout(), text.as_bytes())?;
    Ok(())
}
