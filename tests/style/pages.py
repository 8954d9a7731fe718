"""The pages of the documentation and how many words each may have; shared by the checks of the pages."""

# Tables and code blocks count, generated attachments do not. A tenth more is allowed.
BUDGETS = {
    # Start
    'README.md': 500,
    'docs/getting-started.md': 1400,
    'docs/using-the-planner.md': 900,
    'docs/parameters.md': 900,
    'docs/troubleshooting.md': 450,
    'docs/limits.md': 500,
    'docs/examples.md': 350,
    'docs/citing.md': 100,
    # Use
    'docs/scenarios.md': 1500,
    'docs/python.md': 800,
    'docs/nav2.md': 450,
    'docs/playground.md': 250,
    # Compare
    'docs/benchmarking.md': 1200,
    'docs/benchmark-reference.md': 2400,
    'docs/extending.md': 900,
    # How it works
    'docs/planner.md': 1500,
    'docs/footprint-checks.md': 1060,
    'docs/manoeuvres.md': 1300,
    'docs/trajectories-and-tracking.md': 1500,
    'docs/automatic-parking.md': 700,
    # Results
    'docs/results.md': 1650,
    'docs/paper.md': 2000,
    # Project
    'docs/architecture.md': 1200,
    'CONTRIBUTING.md': 800,
    'CHANGELOG.md': 1200,
}

