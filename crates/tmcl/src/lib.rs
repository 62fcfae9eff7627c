//! tmcl
