//! The command as people run it: in a folder of its own, judged by what it writes, says and ends with.

mod bench;
mod book;
mod compare;
mod errors;
mod interrupt;
mod lab;
mod lab_render;
mod merge;
mod mesh;
mod outputs;
mod parameters;
mod reproduce;
mod safety;
mod workplace;
