"""Reading TOML files and writing files that appear only when they are complete."""
