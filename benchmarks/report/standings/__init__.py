"""Planners against each other over all problems: profiles, penalised times, ranks and paired tests.

Definitions and their sources: docs/metrics.md."""
