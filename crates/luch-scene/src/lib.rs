//! What is to be drawn, as plain data
