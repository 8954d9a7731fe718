"""parking_convert: problems and results from one format into another. docs/scenarios.md describes the formats."""
