//! A formula in text becomes a fast function.
