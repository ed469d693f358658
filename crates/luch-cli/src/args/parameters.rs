//! Values for the parameters of a scene.

use crate::failure::Failure;
use clap::Args;
use luch::formats::{Files, Loaded, load_with_parameters};
use std::collections::BTreeMap;
use std::path::Path;

/// What a Mitsuba scene leaves open.
#[derive(Args, Clone, Debug, Default)]
pub(crate) struct ParameterArgs {
    /// A value for a parameter of a Mitsuba scene: `$NAME`, or one with a `<default>` (may be given several times)
    #[arg(short = 'D', long = "define", value_name = "NAME=VALUE", value_parser = definition)]
    define: Vec<Definition>,
}

/// A name and its value.
#[derive(Clone, Debug)]
struct Definition {
    name: String,
    value: String,
}

/// `name=value`; the value may be empty and may hold more such signs.
fn definition(text: &str) -> Result<Definition, String> {
    match text.split_once('=') {
        Some((name, value)) if !name.is_empty() => {
            Ok(Definition { name: name.to_owned(), value: value.to_owned() })
        }
        _ => Err(format!("`{text}` has no name and value; write NAME=VALUE, such as spp=64")),
    }
}

impl ParameterArgs {
    /// The values by their names.
    ///
    /// # Errors
    /// If a name is there twice.
    pub(crate) fn values(&self) -> Result<BTreeMap<String, String>, Failure> {
        let mut values = BTreeMap::new();
        for Definition { name, value } in &self.define {
            if let Some(first) = values.insert(name.clone(), value.clone()) {
                return Err(Failure::usage(format!(
                    "-D {name} is given twice, with `{first}` and with `{value}`"
                )));
            }
        }
        Ok(values)
    }

    /// The scene in a file with these values.
    pub(crate) fn load(&self, path: &Path, files: &Files) -> Result<Loaded, Failure> {
        Ok(load_with_parameters(path, files, &self.values()?)?)
    }
}
