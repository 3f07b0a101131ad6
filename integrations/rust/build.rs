//! Links libpunctura. Set PUNCTURA_LIB_DIR if it is not in the linker's own path.

fn main() {
    println!("cargo:rerun-if-env-changed=PUNCTURA_LIB_DIR");
    if let Ok(folder) = std::env::var("PUNCTURA_LIB_DIR") {
        println!("cargo:rustc-link-search=native={folder}");
    }
    println!("cargo:rustc-link-lib=dylib=punctura");
}
