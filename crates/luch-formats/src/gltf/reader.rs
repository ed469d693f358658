//! Reading single elements of an accessor.

use super::accessor::{Accessor, Component};

/// An accessor with its bytes. Elements are read one at a time, so that what is not used costs nothing.
#[derive(Clone, Copy, Debug)]
pub(super) struct Reader<'b> {
    accessor: Accessor,
    base: Option<&'b [u8]>,
    stride: usize,
    sparse: Option<Replacements<'b>>,
    element_size: usize,
}

/// Sparse elements in place of those of the view.
#[derive(Clone, Copy, Debug)]
pub(super) struct Replacements<'b> {
    /// How many.
    pub(super) count: usize,
    /// Which elements are replaced, in rising order.
    pub(super) indices: &'b [u8],
    /// How `indices` are stored.
    pub(super) index_component: Component,
    /// The new elements, tightly packed.
    pub(super) values: &'b [u8],
}

impl Replacements<'_> {
    fn index(&self, place: usize) -> u32 {
        integer(self.index_component, &self.indices[place * self.index_component.size()..])
    }

    /// The indices must rise and lie below `most`.
    pub(super) fn check(&self, most: usize) -> Result<(), String> {
        let mut last = None;
        for place in 0..self.count {
            let index = self.index(place);
            if last.is_some_and(|last| index <= last) {
                return Err(format!(
                    "sparse index {place} is {index}, which is not more than the one before"
                ));
            }
            if index as usize >= most {
                return Err(format!("sparse index {place} is {index}, but there are {most} elements"));
            }
            last = Some(index);
        }
        Ok(())
    }

    /// The place among the replacements of element `index`.
    fn find(&self, index: usize) -> Option<usize> {
        let (mut low, mut high) = (0, self.count);
        while low < high {
            let middle = low + (high - low) / 2;
            match (self.index(middle) as usize).cmp(&index) {
                std::cmp::Ordering::Less => low = middle + 1,
                std::cmp::Ordering::Equal => return Some(middle),
                std::cmp::Ordering::Greater => high = middle,
            }
        }
        None
    }
}

impl<'b> Reader<'b> {
    /// A reader over bytes whose extent was checked by [`Accessor`].
    pub(super) fn new(
        accessor: Accessor,
        base: Option<&'b [u8]>,
        stride: usize,
        sparse: Option<Replacements<'b>>,
    ) -> Self {
        let element_size = accessor.form.column_size(accessor.component) * accessor.form.columns;
        Self { accessor, base, stride, sparse, element_size }
    }

    /// How many elements there are.
    pub(super) fn count(&self) -> usize {
        self.accessor.count
    }

    /// The bytes of an element; `None` if it is zero.
    fn bytes(&self, index: usize) -> Option<&'b [u8]> {
        if let Some(sparse) = &self.sparse
            && let Some(place) = sparse.find(index)
        {
            return Some(&sparse.values[place * self.element_size..]);
        }
        self.base.map(|base| &base[index * self.stride..])
    }

    /// The first `N` components of an element, column after column; those it does not have are zero.
    /// Normalised integers become fractions (glTF 2.0 specification, section 3.6.2.2).
    pub(super) fn numbers<const N: usize>(&self, index: usize) -> [f32; N] {
        let mut numbers = [0.0; N];
        let Some(bytes) = self.bytes(index) else { return numbers };
        let Accessor { component, form, normalized, .. } = self.accessor;
        let column_size = form.column_size(component);
        for (place, number) in numbers.iter_mut().enumerate().take(form.rows * form.columns) {
            let at = place / form.rows * column_size + place % form.rows * component.size();
            *number = decode(component, normalized, &bytes[at..]);
        }
        numbers
    }

    /// An element of an accessor of unsigned scalars.
    pub(super) fn index(&self, index: usize) -> u32 {
        self.bytes(index).map_or(0, |bytes| integer(self.accessor.component, bytes))
    }
}

fn integer(component: Component, bytes: &[u8]) -> u32 {
    match component.size() {
        1 => u32::from(bytes[0]),
        2 => u32::from(u16::from_le_bytes([bytes[0], bytes[1]])),
        _ => u32::from_le_bytes([bytes[0], bytes[1], bytes[2], bytes[3]]),
    }
}

fn decode(component: Component, normalized: bool, bytes: &[u8]) -> f32 {
    let whole = integer(component, bytes);
    let (value, largest) = match component {
        Component::F32 => return f32::from_bits(whole),
        Component::I8 => (f32::from(whole as u8 as i8), 127.0),
        Component::U8 => (whole as f32, 255.0),
        Component::I16 => (f32::from(whole as u16 as i16), 32767.0),
        Component::U16 => (whole as f32, 65535.0),
        Component::U32 => (whole as f32, 4_294_967_295.0),
    };
    if normalized { (value / largest).max(-1.0) } else { value }
}
