//! Accessors: typed elements laid over buffer views, with sparse replacements.

use super::budget::Budget;
use super::buffer::{Buffers, View};
use super::json::{Json, List, short};
use super::reader::{Reader, Replacements};
use crate::Problem;

/// How one component is stored.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Component {
    /// Signed, 8 bits.
    I8,
    /// Unsigned, 8 bits.
    U8,
    /// Signed, 16 bits.
    I16,
    /// Unsigned, 16 bits.
    U16,
    /// Unsigned, 32 bits.
    U32,
    /// IEEE 754 single precision.
    F32,
}

impl Component {
    fn parse(json: &Json) -> Result<Self, Problem> {
        Ok(match json.whole()? {
            5120 => Component::I8,
            5121 => Component::U8,
            5122 => Component::I16,
            5123 => Component::U16,
            5125 => Component::U32,
            5126 => Component::F32,
            other => {
                let message =
                    format!("is {other}; component types are 5120, 5121, 5122, 5123, 5125 and 5126");
                return Err(json.problem(message));
            }
        })
    }

    /// Bytes of one component.
    pub(super) fn size(self) -> usize {
        match self {
            Component::I8 | Component::U8 => 1,
            Component::I16 | Component::U16 => 2,
            Component::U32 | Component::F32 => 4,
        }
    }
}

/// The form of an element: a scalar, a vector, or a matrix in columns.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) struct Form {
    /// Components of a column.
    pub(super) rows: usize,
    /// 1 for scalars and vectors.
    pub(super) columns: usize,
}

impl Form {
    /// A vector of `rows` components; 1 is a scalar.
    pub(super) const fn vector(rows: usize) -> Self {
        Self { rows, columns: 1 }
    }

    fn parse(json: &Json) -> Result<Self, Problem> {
        Ok(match json.text()? {
            "SCALAR" => Form::vector(1),
            "VEC2" => Form::vector(2),
            "VEC3" => Form::vector(3),
            "VEC4" => Form::vector(4),
            "MAT2" => Form { rows: 2, columns: 2 },
            "MAT3" => Form { rows: 3, columns: 3 },
            "MAT4" => Form { rows: 4, columns: 4 },
            other => {
                let message =
                    format!("is \"{}\"; types are SCALAR, VEC2, VEC3, VEC4, MAT2, MAT3, MAT4", short(other));
                return Err(json.problem(message));
            }
        })
    }

    /// Bytes from one column to the next: columns of matrices begin at multiples of four.
    pub(super) fn column_size(self, component: Component) -> usize {
        let bytes = self.rows * component.size();
        if self.columns == 1 { bytes } else { bytes.next_multiple_of(4) }
    }

    /// What an element takes up.
    fn extent(self, component: Component) -> Extent {
        let column = self.column_size(component);
        // The padding of the last column may lie beyond the end of the view.
        Extent {
            packed: column * self.columns,
            needed: column * (self.columns - 1) + self.rows * component.size(),
        }
    }
}

/// Bytes of an element.
#[derive(Clone, Copy, Debug)]
struct Extent {
    /// From one element to the next if nothing lies between them.
    packed: usize,
    /// Those that hold components.
    needed: usize,
}

/// A list of elements whose every byte is known to lie inside its view.
#[derive(Clone, Copy, Debug)]
pub(super) struct Accessor {
    /// How a component is stored.
    pub(super) component: Component,
    /// The form of an element.
    pub(super) form: Form,
    /// How many elements there are.
    pub(super) count: usize,
    /// Whether integers stand for fractions of their largest value.
    pub(super) normalized: bool,
    /// Where the elements are; `None` if they are all zero.
    base: Option<Base>,
    sparse: Option<Sparse>,
}

#[derive(Clone, Copy, Debug)]
struct Base {
    view: usize,
    offset: usize,
    stride: usize,
}

/// Elements that are replaced.
#[derive(Clone, Copy, Debug)]
struct Sparse {
    count: usize,
    indices: Base,
    index_component: Component,
    values: Base,
}

impl Accessor {
    /// Checks all accessors of the document.
    pub(super) fn parse_all(
        root: &Json,
        buffers: &Buffers,
        budget: &mut Budget,
    ) -> Result<Vec<Self>, Problem> {
        let checked = |json: Json| {
            let accessor = Self::parse(&json, buffers.views())?;
            if let Some(sparse) = accessor.sparse
                && buffers.has_bytes(sparse.indices.view)
            {
                budget.take(sparse.count, 1, &json)?;
                let replaced = sparse.open(buffers, &json)?;
                replaced.check(accessor.count).map_err(|message| json.problem(message))?;
            }
            Ok(accessor)
        };
        root.list("accessors")?.iter().map(checked).collect()
    }

    fn parse(json: &Json, views: &[View]) -> Result<Self, Problem> {
        let component = Component::parse(&json.need("componentType")?)?;
        let form = Form::parse(&json.need("type")?)?;
        let count = json.need("count")?.size()?;
        let normalized = json.get("normalized")?.map(|flag| flag.boolean()).transpose()?.unwrap_or(false);
        let extent = form.extent(component);
        let base = match json.get("bufferView")? {
            Some(_) => Some(Base::parse(json, views, extent, count, true)?),
            None => None,
        };
        let sparse =
            json.get("sparse")?.map(|json| Sparse::parse(&json, views, extent, count)).transpose()?;
        Ok(Self { component, form, count, normalized, base, sparse })
    }

    /// True if the elements are stored somewhere, rather than all zero.
    pub(super) fn has_bytes(&self) -> bool {
        self.base.is_some() || self.sparse.is_some()
    }

    /// Opens the accessor for reading; `json` is its place in the document.
    pub(super) fn reader<'b>(&self, buffers: &'b Buffers, json: &Json) -> Result<Reader<'b>, Problem> {
        let base = self.base.map(|base| base.bytes(buffers, json)).transpose()?;
        let stride = self.base.map_or(0, |base| base.stride);
        let sparse = self.sparse.map(|sparse| sparse.open(buffers, json)).transpose()?;
        Ok(Reader::new(*self, base, stride, sparse))
    }
}

impl Base {
    /// `count` elements in the view that `json` names, interleaved if the view may have a stride.
    fn parse(
        json: &Json,
        views: &[View],
        extent: Extent,
        count: usize,
        strided: bool,
    ) -> Result<Self, Problem> {
        let view = json.need("bufferView")?.reference_within(views.len(), "/bufferViews")?;
        let offset = json.get("byteOffset")?.map_or(Ok(0), |offset| offset.size())?;
        let size = extent.needed;
        let stride = views[view].stride.filter(|_| strided).unwrap_or(extent.packed);
        if stride < size {
            let message =
                format!("has elements of {size} bytes, but /bufferViews/{view} has a stride of {stride}");
            return Err(json.problem(message));
        }
        let last = count.saturating_sub(1).checked_mul(stride);
        let needed = if count == 0 { Some(0) } else { last.and_then(|last| last.checked_add(size)) };
        let end = needed.and_then(|needed| needed.checked_add(offset));
        if end.is_none_or(|end| end > views[view].length) {
            return Err(json.problem(format!(
                "{count} elements of {size} bytes, {stride} apart, from byte {offset} on do not fit /bufferViews/{view} of \
                 {} bytes",
                views[view].length
            )));
        }
        Ok(Self { view, offset, stride })
    }

    fn bytes<'b>(&self, buffers: &'b Buffers, owner: &Json) -> Result<&'b [u8], Problem> {
        Ok(&buffers.bytes(self.view, owner)?[self.offset..])
    }
}

impl Sparse {
    fn parse(json: &Json, views: &[View], extent: Extent, most: usize) -> Result<Self, Problem> {
        let count_json = json.need("count")?;
        let count = count_json.size()?;
        if count > most {
            return Err(count_json.problem(format!("is {count}, more than the accessor's {most} elements")));
        }
        let indices = json.need("indices")?;
        let component_json = indices.need("componentType")?;
        let index_component = Component::parse(&component_json)?;
        if !matches!(index_component, Component::U8 | Component::U16 | Component::U32) {
            return Err(component_json.problem("sparse indices are of type 5121, 5123 or 5125"));
        }
        let index_extent = Form::vector(1).extent(index_component);
        Ok(Self {
            count,
            indices: Base::parse(&indices, views, index_extent, count, false)?,
            index_component,
            values: Base::parse(&json.need("values")?, views, extent, count, false)?,
        })
    }

    fn open<'b>(&self, buffers: &'b Buffers, owner: &Json) -> Result<Replacements<'b>, Problem> {
        let Self { count, index_component, .. } = *self;
        let (indices, values) = (self.indices.bytes(buffers, owner)?, self.values.bytes(buffers, owner)?);
        Ok(Replacements { count, indices, index_component, values })
    }
}

/// The accessor that `json` refers to, which must have one of `forms`.
pub(super) fn referenced<'a>(
    json: &Json,
    list: &List<'a>,
    accessors: &[Accessor],
    forms: &[Form],
) -> Result<(Accessor, Json<'a>), Problem> {
    let index = json.reference(list)?;
    let accessor = accessors[index];
    if forms.contains(&accessor.form) {
        return Ok((accessor, list.at(index)));
    }
    let name = |form: &Form| match *form {
        Form { rows: 1, columns: 1 } => "SCALAR".to_owned(),
        Form { rows, columns: 1 } => format!("VEC{rows}"),
        Form { rows, .. } => format!("MAT{rows}"),
    };
    let expected: Vec<_> = forms.iter().map(name).collect();
    let (path, found) = (list.path(), name(&accessor.form));
    Err(json.problem(format!("refers to {path}/{index} of type {found}, expected {}", expected.join(" or "))))
}
