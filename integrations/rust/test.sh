#!/usr/bin/env bash
# The Rust crate: the same forces as the core. Nothing is downloaded.
source "$(dirname "$0")/../tools.sh"
need cargo cargo
build_library
make_reference
mkdir -p "$work"
export REFERENCE=$reference PUNCTURA_LIB_DIR=$library CARGO_TARGET_DIR=$work/target
cd "$here"
cargo test --offline --quiet
cargo run --offline --quiet --example insert "$reference/scene.toml"
