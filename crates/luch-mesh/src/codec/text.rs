//! Writing text: numbers and rows, many rows on all threads.

use std::io::Write;

use rayon::prelude::*;

/// Rows that one task writes.
const ROWS: usize = 1 << 14;

/// The texts of `count` rows, one after another. `write` appends one row; the text is the same for any number of threads.
pub(super) fn write_rows(text: &mut Vec<u8>, count: usize, write: impl Fn(usize, &mut Vec<u8>) + Sync) {
    // Blocks of some tasks at a time: the pieces never take as much memory as the whole.
    let block = ROWS * 64;
    for first in (0..count).step_by(block) {
        let last = count.min(first + block);
        let pieces: Vec<Vec<u8>> = (first..last)
            .into_par_iter()
            .step_by(ROWS)
            .map(|start| {
                let mut piece = Vec::new();
                (start..last.min(start + ROWS)).for_each(|row| write(row, &mut piece));
                piece
            })
            .collect();
        pieces.iter().for_each(|piece| text.extend_from_slice(piece));
    }
}

/// Appends the shortest text that reads back as the same number.
pub(super) fn put_f32(text: &mut Vec<u8>, number: f32) {
    let size = number.abs();
    // Writing to a vector cannot fail.
    let _ = if number == 0.0 || !number.is_finite() || (1e-5..1e16).contains(&size) {
        write!(text, "{number}")
    } else {
        write!(text, "{number:e}")
    };
}

/// Appends numbers, each with a space before it.
pub(super) fn put_all(text: &mut Vec<u8>, numbers: &[f32]) {
    for &number in numbers {
        text.push(b' ');
        put_f32(text, number);
    }
}

/// Appends a whole number.
pub(super) fn put_integer(text: &mut Vec<u8>, mut number: u64) {
    let mut digits = [0u8; 20];
    let mut at = digits.len();
    loop {
        at -= 1;
        digits[at] = b'0' + (number % 10) as u8;
        number /= 10;
        if number == 0 {
            break;
        }
    }
    text.extend_from_slice(&digits[at..]);
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn rows_stand_in_order() {
        let mut text = Vec::new();
        write_rows(&mut text, 3 * ROWS + 5, |row, text| {
            put_integer(text, row as u64);
            text.push(b'\n');
        });
        let lines: Vec<usize> =
            text.split(|b| *b == b'\n').filter_map(|l| std::str::from_utf8(l).ok()?.parse().ok()).collect();
        assert!(lines.into_iter().eq(0..3 * ROWS + 5));
    }

    #[test]
    fn numbers_come_back() {
        for number in [0.0, -0.0, 1.0, 0.1, -1e-7, 3.4e38, 1e-45, 16_777_217.0, 1.0 / 3.0] {
            let mut text = Vec::new();
            put_f32(&mut text, number);
            let read: f32 = std::str::from_utf8(&text).unwrap().parse().unwrap();
            assert_eq!(read.to_bits(), number.to_bits());
        }
    }
}
