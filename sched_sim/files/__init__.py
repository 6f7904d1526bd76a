"""Reading and writing files: TOML, and the one way in which a file is written."""
