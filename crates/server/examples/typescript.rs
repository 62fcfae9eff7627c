//! Prints the types of the HTTP interface as TypeScript.

fn main() {
    print!("{}", server::typescript());
}
