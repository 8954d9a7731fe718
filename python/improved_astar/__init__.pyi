from typing import Any, Dict, Optional, Tuple

from ._core import (Drive as Drive, Error as Error, ParkingPlan as ParkingPlan, ParkingPlanner as ParkingPlanner,
                    PathLike, Result as Result, Scenario as Scenario, Slot as Slot, Vehicle as Vehicle,
                    Verdict as Verdict, __version__ as __version__, check as check, plan as plan,
                    plan_batch as plan_batch, vehicles as vehicles)

class Animation:
    """A page that animates a drive: notebooks display it, save() writes it to a file."""
    page: str
    height: int
    def __init__(self, page: str, height: int) -> None: ...
    def save(self, path: PathLike) -> PathLike:
        """Writes the page to a self-contained HTML file and returns its path."""
    def _repr_html_(self) -> str: ...

def animate(self: Drive, title: Optional[str] = None, height: int = 760) -> Animation:
    """Returns the Animation of a result: the car on the map, and plots of speed, acceleration and steering.

    title : plain text
    height : pixels in a notebook
    """

def parameters() -> Dict[str, Tuple[Any, str, str, str]]:
    """Returns the parameters of the planner: {name: (default, allowed values, unit, meaning)}."""

def plot(self: Drive, path: Optional[PathLike] = None, axes: Any = None, footprints: float = 1.5) -> Any:
    """Draws a result with obstacles, slot, path, outlines of the car and a legend, and returns the axes.

    path : picture file to write (.png, .svg, .pdf)
    axes : matplotlib axes for the drawing
    footprints : metres between outlines of the car; 0 for none
    """

def read_runs(path: PathLike) -> Any:
    """Returns the runs of a comparison as a pandas DataFrame with one row per run.

    path : a database, or the output folder of parking_benchmark with its benchmark.db
    """
