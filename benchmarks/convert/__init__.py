"""parking_convert: problems and results from one format into another. docs/formats.md describes the formats."""
