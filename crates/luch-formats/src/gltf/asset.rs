//! The version of the format that a file is written in.

use super::json::{Json, short};
use super::notices::Notices;
use crate::Problem;

/// "major.minor".
fn parse_version(json: &Json) -> Result<[u32; 2], Problem> {
    let text = json.text()?;
    let numbers =
        text.split_once('.').and_then(|(major, minor)| Some([major.parse().ok()?, minor.parse().ok()?]));
    numbers.ok_or_else(|| json.problem(format!("\"{}\" is no version; \"2.0\" is one", short(text))))
}

/// Accepts versions that a reader of 2.0 may read (section 3.2): any 2.x that does not demand more.
pub(super) fn check(root: &Json, notices: &mut Notices) -> Result<(), Problem> {
    let asset = root.need("asset")?;
    let version_json = asset.need("version")?;
    let version = parse_version(&version_json)?;
    if version[0] != 2 {
        return Err(
            version_json.problem(format!("the file is glTF {}.{}; 2.0 is read", version[0], version[1]))
        );
    }
    if let Some(json) = asset.get("minVersion")? {
        let least = parse_version(&json)?;
        if least > [2, 0] {
            return Err(json.problem(format!(
                "the file demands a reader of glTF {}.{}; this is one of 2.0",
                least[0], least[1]
            )));
        }
    }
    if version > [2, 0] {
        notices.add(version_json.path(), format!("the file is glTF 2.{}, read as 2.0", version[1]));
    }
    Ok(())
}
