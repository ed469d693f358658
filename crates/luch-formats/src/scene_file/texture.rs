//! `texture "name" { … }`: pictures and patterns.

use super::decoder::Decoder;
use super::fields::Fields;
use super::source::Span;
use super::value::Range;
use super::{ImageSource, Named, TextureSource};
use luch_image::{Encoding, Rgb};
use luch_scene::{TextureFilter, Wrap};

const WRAPS: [(&str, Wrap); 3] = [("repeat", Wrap::Repeat), ("mirror", Wrap::Mirror), ("clamp", Wrap::Clamp)];

const FILTERS: [(&str, TextureFilter); 2] =
    [("bilinear", TextureFilter::Bilinear), ("nearest", TextureFilter::Nearest)];

const ENCODINGS: [(&str, Encoding); 2] = [("srgb", Encoding::Srgb), ("linear", Encoding::Linear)];

impl Decoder<'_> {
    pub(super) fn texture(&mut self, mut fields: Fields) {
        let name = self.required_name(&mut fields);
        let kind = fields.take_one_of(self, &["image", "checker"]);
        if kind.is_none() && fields.nothing_left() {
            let help = "write `image \"file.png\"` or `checker 0.8 0.2` in its block";
            self.problem(&fields.span, "`texture` lacks what it shows", Some(help.into()));
        }
        let source = kind.and_then(|field| match field.name {
            "image" => self.image(field.fields()).map(TextureSource::Image),
            _ => Some(self.checker(field.fields())),
        });
        fields.finish(self, "pattern");
        if let (Some(name), Some(value)) = (name, source) {
            self.scene.textures.push(Named { name: Some(name), value });
        }
    }

    /// `image "file.png" wrap="clamp" filter="nearest" encoding="linear"`.
    fn image(&mut self, mut fields: Fields) -> Option<ImageSource> {
        let path = match fields.argument() {
            Some(argument) => self.text("`image`", &argument),
            None => {
                self.problem(&fields.span, "`image` lacks the name of a file", None);
                None
            }
        };
        let wrap = self.wrap(&mut fields);
        let filter = self.word_or(&mut fields, "filter", &FILTERS, TextureFilter::Bilinear);
        let encodings = ENCODINGS.map(|(name, encoding)| (name, Some(encoding)));
        let encoding = self.word_or(&mut fields, "encoding", &encodings, None);
        fields.finish(self, "option");
        Some(ImageSource { path: path?, encoding, wrap, filter })
    }

    /// One word for u and v, or two.
    fn wrap(&mut self, fields: &mut Fields) -> [Wrap; 2] {
        let Some(field) = fields.take(self, "wrap") else { return [Wrap::Repeat; 2] };
        let mut inner = field.fields();
        let words: Vec<Option<Wrap>> =
            inner.all_arguments().iter().map(|argument| self.word("`wrap`", argument, &WRAPS)).collect();
        let wrap = match words.as_slice() {
            [both] => [*both, *both],
            [u, v] => [*u, *v],
            _ => {
                self.problem(&inner.span, "`wrap` has one word, or two for u and v", None);
                [None, None]
            }
        };
        inner.finish(self, "option");
        wrap.map(Option::unwrap_or_default)
    }

    /// `checker 0.8 0.2` for grays, or `checker { even …; odd … }`.
    fn checker(&mut self, mut fields: Fields) -> TextureSource {
        let arguments = fields.all_arguments();
        let mut colors = [Rgb::gray(0.8), Rgb::gray(0.2)];
        match arguments.as_slice() {
            [] => {
                for (name, color) in ["even", "odd"].into_iter().zip(&mut colors) {
                    *color = self.constant_or(&mut fields, name, Range::UNIT, *color);
                }
            }
            [_, _] => {
                for (argument, color) in arguments.iter().zip(&mut colors) {
                    let span: &Span = &argument.span;
                    let read = self.color("`checker`", span, std::slice::from_ref(argument), Range::UNIT);
                    *color = read.unwrap_or(*color);
                }
            }
            _ => {
                let help = "write `checker 0.8 0.2`, `checker \"#fff\" \"#000\"` or `checker { even 0.8 0.7 0.6; odd 0.2 }`";
                let message = format!("`checker` has {} values, expected two colours", arguments.len());
                self.problem(&fields.span, message, Some(help.into()));
            }
        }
        fields.finish(self, "option");
        let [even, odd] = colors;
        TextureSource::Checker { even, odd }
    }
}
