//! Steps one after another.

use super::verb::Action;
use super::{Arguments, Files, FormulaSurface, Kind, NoFiles, Verb, WorkshopError, find};
use crate::PolygonMesh;
use crate::height_map::HeightField;

/// One verb with its arguments as they were typed.
#[derive(Clone, Debug)]
pub struct Step {
    /// What is done.
    pub verb: &'static Verb,
    /// Names and texts; an empty name stands for the first parameter.
    pub given: Vec<(String, String)>,
}

impl Step {
    /// Reads words such as `twist`, `--angle`, `90deg`. Values stand in the next word or after `=`; flags need none.
    pub fn from_words(words: &[String]) -> Result<Self, WorkshopError> {
        let [name, words @ ..] = words else {
            return Err(WorkshopError::new("a step is empty: write a verb between two `|`"));
        };
        let verb = find(name)?;
        let mut given = Vec::new();
        let mut rest = words.iter().peekable();
        while let Some(word) = rest.next() {
            let Some(name) = word.strip_prefix("--") else {
                given.push((String::new(), word.clone()));
                continue;
            };
            if let Some((name, value)) = name.split_once('=') {
                given.push((name.into(), value.into()));
                continue;
            }
            let is_flag = verb.parameters.iter().any(|known| known.name == name && known.kind == Kind::Flag);
            let value = if is_flag {
                rest.next_if(|word| matches!(word.as_str(), "true" | "false" | "yes" | "no"))
            } else {
                rest.next()
            };
            match value {
                Some(value) => given.push((name.into(), value.clone())),
                None if is_flag => given.push((name.into(), "true".into())),
                None => return Err(WorkshopError::of(name, "lacks its value")),
            }
        }
        Ok(Self { verb, given })
    }

    /// The height field that `height-map` and `terrain` make, before it becomes triangles: for those who trace it as it is.
    pub fn height_field(&self, files: &mut dyn Files) -> Result<HeightField, WorkshopError> {
        super::heights::field(self.verb, &Arguments::read(self.verb, &self.given, files)?)
    }

    /// The formula of `implicit`, before its surface becomes triangles: for those who trace it as it is.
    pub fn formula(&self) -> Result<FormulaSurface, WorkshopError> {
        super::implicits::formula_surface(self.verb, &Arguments::read(self.verb, &self.given, &mut NoFiles)?)
    }

    /// Does it to a mesh; a verb that makes one wants none.
    pub fn run(
        &self,
        mesh: Option<PolygonMesh>,
        files: &mut dyn Files,
    ) -> Result<PolygonMesh, WorkshopError> {
        let arguments = Arguments::read(self.verb, &self.given, files)?;
        match (self.verb.action, mesh) {
            (Action::Make { run, .. }, None) => run(&arguments),
            (Action::Change { run, .. }, Some(mesh)) => run(mesh, &arguments),
            (Action::Make { .. }, Some(_)) => Err(WorkshopError::new(format!(
                "`{}` makes a mesh, so it can only come first",
                self.verb.name
            ))),
            (Action::Change { .. }, None) => Err(WorkshopError::new(format!(
                "`{}` changes a mesh, so one must come before it",
                self.verb.name
            ))),
        }
    }
}

/// Steps one after another: `cuboid --size 2 | twist --angle 90deg`.
#[derive(Clone, Debug)]
pub struct Pipeline {
    /// The steps.
    pub steps: Vec<Step>,
}

impl Pipeline {
    /// Reads steps with `|` between them. Words are parted by spaces; quotes, single or double, hold words together.
    pub fn parse(text: &str) -> Result<Self, WorkshopError> {
        let mut steps = Vec::new();
        for words in split(text)? {
            steps.push(Step::from_words(&words)?);
        }
        Ok(Self { steps })
    }

    /// Does all steps; the first makes a mesh.
    pub fn run(&self, files: &mut dyn Files) -> Result<PolygonMesh, WorkshopError> {
        self.run_on(None, files)
    }

    /// Does all steps; the first changes the mesh, if there is one.
    pub fn run_on(
        &self,
        mut mesh: Option<PolygonMesh>,
        files: &mut dyn Files,
    ) -> Result<PolygonMesh, WorkshopError> {
        for step in &self.steps {
            mesh = Some(step.run(mesh, files).map_err(|error| {
                let message = format!("{}: {}", step.verb.name, error.message);
                WorkshopError { message, ..error }
            })?);
        }
        mesh.ok_or_else(|| WorkshopError::new("the pipeline has no step"))
    }
}

/// Words of each step.
fn split(text: &str) -> Result<Vec<Vec<String>>, WorkshopError> {
    let mut steps = vec![Vec::new()];
    let mut word: Option<String> = None;
    let mut quote = None;
    for letter in text.chars() {
        match (quote, letter) {
            (Some(open), letter) if letter == open => quote = None,
            (Some(_), letter) => word.get_or_insert_default().push(letter),
            (None, '"' | '\'') => {
                quote = Some(letter);
                word.get_or_insert_default();
            }
            (None, '|') => {
                let last = steps.len() - 1;
                steps[last].extend(word.take());
                steps.push(Vec::new());
            }
            (None, letter) if letter.is_whitespace() => {
                let last = steps.len() - 1;
                steps[last].extend(word.take());
            }
            (None, letter) => word.get_or_insert_default().push(letter),
        }
    }
    if quote.is_some() {
        return Err(WorkshopError::new("a quote is not closed"));
    }
    let last = steps.len() - 1;
    steps[last].extend(word.take());
    Ok(steps)
}
