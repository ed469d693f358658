//! The values of properties: numbers, colours, spectra, transforms.

use super::read::Reading;
use super::tree::Value;
use super::{literal, spectrum, transform};
use crate::Files;
use crate::scene_file::{Span, clip};
use roxmltree::Node;

impl Reading<'_> {
    /// The value of a property; `None`, perhaps with a problem, if there is none.
    pub(super) fn value(&mut self, node: Node, tag: &str) -> Option<Value> {
        if tag == "transform" {
            let mut matrix = glam::DMat4::IDENTITY;
            for child in node.children().filter(Node::is_element) {
                let span = self.span(child);
                match transform::step(child.tag_name().name(), &mut |name| self.attribute(child, name)) {
                    Ok(step) => matrix = step * matrix,
                    Err(message) => self.report.add(&span, message, None),
                }
            }
            if !matrix.is_finite() {
                self.report.add(&self.span(node), "this transform has numbers that are too large", None);
                return Some(Value::Transform(glam::DMat4::IDENTITY));
            }
            return Some(Value::Transform(matrix));
        }
        let span = match node.attribute_node("value") {
            Some(value) => Span { source: self.source, bytes: value.range_value() },
            None => self.span(node),
        };
        let text = self.attribute(node, "value");
        let parsed = match tag {
            "integer" => literal::integer(&text?).map(Value::Integer),
            "float" => literal::number(&text?).map(Value::Float),
            "boolean" => literal::flag(&text?).map(Value::Flag),
            "string" => Ok(Value::Text(text?)),
            "rgb" => literal::color(&text?).map(Value::Color),
            "srgb" => literal::screen_color(&text?).map(Value::Color),
            "point" | "vector" => match text {
                Some(text) => literal::vector(&text).map(Value::Vector),
                None => self.components(node).map(Value::Vector),
            },
            "blackbody" => self.blackbody(node),
            _ => match (text, self.attribute(node, "filename")) {
                (Some(text), _) => spectrum::literal(&text),
                (None, Some(file)) => self.spectrum_file(&file),
                (None, None) => return None,
            },
        };
        match parsed {
            Ok(value) => Some(value),
            Err(message) => {
                self.report.add(&span, message, None);
                None
            }
        }
    }

    /// `x`, `y` and `z`, each 0 if it is missing.
    fn components(&mut self, node: Node) -> Result<glam::Vec3, String> {
        let mut component = |name| match self.attribute(node, name) {
            Some(text) => literal::number(&text),
            None => Ok(0.0),
        };
        let [x, y, z] = [component("x")?, component("y")?, component("z")?];
        Ok(glam::DVec3::new(x, y, z).as_vec3())
    }

    fn blackbody(&mut self, node: Node) -> Result<Value, String> {
        let temperature = match self.attribute(node, "temperature").or_else(|| self.attribute(node, "value"))
        {
            // Old files write the unit.
            Some(text) => literal::number(text.trim_end_matches(['K', 'k']))?,
            None => return Err("this `blackbody` lacks its attribute `temperature`".to_owned()),
        };
        let scale = self.attribute(node, "scale").map_or(Ok(1.0), |text| literal::number(&text))?;
        if !(1.0..=1e6).contains(&temperature) || !(0.0..=1e12).contains(&scale) {
            return Err(format!(
                "a body of {temperature} K times {scale} is no light: 1 to 1e6 K, 0 to 1e12"
            ));
        }
        Ok(Value::Blackbody { temperature, scale })
    }

    fn spectrum_file(&mut self, file: &str) -> Result<Value, String> {
        let bytes =
            self.files.read(&Files::beside(&self.main, file)).map_err(|problem| problem.to_string())?;
        spectrum::file(&String::from_utf8_lossy(&bytes))
            .map_err(|message| format!("{}: {message}", clip(file)))
    }
}
