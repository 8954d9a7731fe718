"""parking_convert: converts problems and results between formats, which docs/scenarios.md describes."""
