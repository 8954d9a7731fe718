"""Types of the extension module. Arrays of a result are read-only views of its memory."""
import os
from typing import Any, Dict, Iterable, List, Optional, Sequence, Tuple, Union

import numpy
from numpy.typing import ArrayLike, NDArray

Pose = Tuple[float, float, float]
"""x and y in metres and yaw in radians, of the midpoint of the rear axle."""
PathLike = Union[str, 'os.PathLike[str]']

__version__: str

class Error(ValueError):
    """Invalid value or file. The one-line message names the field or file and a valid alternative."""

def vehicles() -> List[str]:
    """Returns the names of the known vehicles."""

class Vehicle:
    """A car: its body relative to the rear axle, and its limits.

    Vehicle("vw_golf8")                     a known car, see vehicles()
    Vehicle("van.yaml")                     a car from a file
    Vehicle("vw_golf8", width=1.9)          a known car with another width
    Vehicle(wheelbase=2.9, width=1.9)       the car of TPCAP with two other fields
    Vehicle(wheelbase=1.5, outline=corners) a body that is any simple polygon: an n x 2 array in the frame of the car

    The fields are in metres, radians and other SI units: wheelbase, front_overhang, rear_overhang, width,
    max_steering_angle (mean of the front wheels), max_speed, max_acceleration, max_steering_rate. With an outline,
    overhangs and width are those of its bounding rectangle. Other lengths replace the outline by a rectangle.
    """
    def __init__(self, name_or_file: str = 'tpcap', *, name: str = ..., wheelbase: float = ...,
                 front_overhang: float = ..., rear_overhang: float = ..., width: float = ...,
                 max_steering_angle: float = ..., max_speed: float = ..., max_acceleration: float = ...,
                 max_steering_rate: float = ..., outline: ArrayLike = ...) -> None: ...
    @property
    def name(self) -> str:
        """Name of the car; custom after a change of its fields."""
    @property
    def wheelbase(self) -> float:
        """Distance between the axles in metres."""
    @property
    def front_overhang(self) -> float:
        """Distance from front axle to front bumper in metres."""
    @property
    def rear_overhang(self) -> float:
        """Distance from rear axle to rear bumper in metres."""
    @property
    def width(self) -> float:
        """Width of the body in metres."""
    @property
    def max_steering_angle(self) -> float:
        """Maximum steering angle in radians, mean of the front wheels."""
    @property
    def max_speed(self) -> float:
        """Maximum speed in m/s, in both directions."""
    @property
    def max_acceleration(self) -> float:
        """Maximum acceleration in m/s^2, of either sign."""
    @property
    def max_steering_rate(self) -> float:
        """Maximum steering rate in rad/s."""
    @property
    def turning_radius(self) -> float:
        """Minimum turning radius of the midpoint of the rear axle in metres."""
    @property
    def length(self) -> float:
        """Length from bumper to bumper in metres."""
    @property
    def outline(self) -> NDArray[numpy.float64]:
        """Corners of the body in the frame of the car, counter-clockwise, as an n x 2 array; empty for a rectangle."""
    def footprint(self, pose: ArrayLike) -> NDArray[numpy.float64]:
        """Returns the corners of the body at a pose, counter-clockwise, as an n x 2 array. Those of a rectangle begin
        at the rear right."""

class Slot:
    """A parking slot: a rectangle with a pose at its centre.

    In perpendicular and angled slots, +x of the pose points out of the slot towards the aisle. In parallel slots, +x
    is the direction of travel in the adjacent lane. See docs/scenarios.md for the fields.
    """
    def __init__(self, kind: str, pose: ArrayLike, length: float, width: float, entry: str = 'reverse',
                 angle: float = ..., side: str = 'either', depth: Optional[float] = None,
                 lateral_offset: float = 0.0) -> None: ...
    @property
    def kind(self) -> str:
        """Kind of slot: perpendicular, parallel or angled."""
    @property
    def pose(self) -> Pose:
        """Pose of the centre of the slot: (x, y, yaw)."""
    @property
    def length(self) -> float:
        """Length along the parked car in metres."""
    @property
    def width(self) -> float:
        """Width across the parked car in metres."""
    @property
    def entry(self) -> str:
        """Direction in which the car enters: reverse, forward or either."""
    @property
    def angle(self) -> float:
        """Angle between +x of the pose and the aisle of an angled slot, in radians."""
    @property
    def side(self) -> str:
        """Side of the aisle on which the slot lies: right, left or either."""
    @property
    def depth(self) -> Optional[float]:
        """Metres between the closed end of the slot and the car, or None for a centred car."""
    @property
    def lateral_offset(self) -> float:
        """Offset of the parked car to the left of the slot's axis in metres."""
    @property
    def outline(self) -> NDArray[numpy.float64]:
        """Corners of the slot as a 4 x 2 array."""
    def goals(self, vehicle: Vehicle) -> List[Pose]:
        """Returns the poses (x, y, yaw) of a car parked in the slot, preferred first."""

class Scenario:
    """A parking problem: obstacles, a vehicle, start and goals.

    Scenario.read(path)                                  from a file: YAML or TPCAP case
    Scenario.from_polygons(polygons, start, goal)        from lists or arrays of corners
    Scenario.from_grid(array, start, goal, resolution=)  from a NumPy array or the path of a map

    Coordinates are those of the given file or data, in metres and radians. Poses (x, y, yaw) are of the midpoint of
    the rear axle. A scenario is immutable; replace() returns a modified copy.
    """
    @staticmethod
    def read(path: PathLike, vehicle: Union[None, PathLike, Vehicle] = None, *,
             text: Optional[bytes] = None) -> 'Scenario':
        """Reads a scenario file; its format is detected automatically.

        vehicle : a name, a file or a Vehicle that replaces the one of the file
        text : the content of path, if it was already read, for example from a pipe
        """
    @staticmethod
    def from_polygons(polygons: Iterable[ArrayLike], start: ArrayLike, goal: Optional[ArrayLike] = None, *,
                      slot: Optional[Slot] = None, vehicle: Union[PathLike, Vehicle] = 'tpcap',
                      name: str = 'polygons') -> 'Scenario':
        """Creates a scenario from polygons, each an array of n rows (x, y).

        goal : one pose, or n rows of poses; alternatively a Slot as slot
        """
    @staticmethod
    def from_grid(grid: Union[ArrayLike, PathLike], start: ArrayLike, goal: Optional[ArrayLike] = None, *,
                  slot: Optional[Slot] = None, resolution: Optional[float] = None,
                  origin: Optional[ArrayLike] = None, vehicle: Union[PathLike, Vehicle] = 'tpcap',
                  name: str = 'grid', unknown_is_occupied: bool = True) -> 'Scenario':
        """Creates a scenario from a map.

        grid : a 2-D array (0 free, 1 occupied, -1 or 2 unknown; row 0 is the lowest), or the path of a ROS map or a
            SurroundOcc .npy file
        resolution : metres per cell, for arrays only
        origin : pose of the lower left corner, for arrays only
        goal : one pose, or n rows of poses; alternatively a Slot as slot
        """
    def replace(self, *, start: Optional[ArrayLike] = None, goal: Optional[ArrayLike] = None,
                slot: Optional[Slot] = None, vehicle: Union[None, PathLike, Vehicle] = None) -> 'Scenario':
        """Returns a copy with another start, goal, slot or car."""
    def is_free(self, poses: ArrayLike) -> NDArray[numpy.bool_]:
        """Returns an array of n bool: whether the car is free of collision at each of n poses."""
    def clearance_at(self, poses: ArrayLike) -> NDArray[numpy.float64]:
        """Returns the distance between the car and the nearest obstacle at each of n poses in metres; 0 in collision.
        """
    @property
    def name(self) -> str:
        """Name of the scenario."""
    @property
    def vehicle(self) -> Vehicle:
        """The Vehicle that parks."""
    @property
    def start(self) -> Pose:
        """Start pose of the car: (x, y, yaw)."""
    @property
    def goals(self) -> List[Pose]:
        """Goal poses as a list of (x, y, yaw); those of the slot if there is one."""
    @property
    def slot(self) -> Optional[Slot]:
        """The Slot in which the car parks, or None."""
    @property
    def polygons(self) -> List[NDArray[numpy.float64]]:
        """Obstacles as a list of n x 2 arrays; empty for a map."""
    @property
    def files(self) -> List[str]:
        """Files from which the scenario was read: its own, and those of its map and car."""
    @property
    def unknown_is_occupied(self) -> bool:
        """Whether unknown cells of a map are obstacles."""
    @property
    def grid(self) -> Optional[NDArray[numpy.uint8]]:
        """Cells of a map: 0 free, 1 occupied, 2 unknown. A read-only view of the scenario's memory; None for polygons.
        """
    @property
    def resolution(self) -> Optional[float]:
        """Metres per cell of a map; None for polygons."""
    @property
    def origin(self) -> Optional[Pose]:
        """Pose of the lower left corner of a map; None for polygons."""
    @property
    def bounds(self) -> Tuple[float, float, float, float]:
        """Bounds of the world: (min x, min y, max x, max y)."""

class Drive:
    """A path in a scenario, common base of Result and ParkingPlan."""
    @property
    def scenario(self) -> Scenario:
        """The Scenario of the path."""
    @property
    def status(self) -> str:
        """Status of the plan, see Result and ParkingPlan."""
    @property
    def path(self) -> NDArray[numpy.float64]:
        """States of the path at most 0.1 m apart, an n x 5 array: x, y, yaw, direction (1 or -1) and curvature (1/m) of
        the arc to the state. No rows without a path.
        """
    @property
    def pieces(self) -> NDArray[numpy.float64]:
        """Pieces of the exact path, an m x 4 array: initial curvature (1/m), signed length (m), sharpness (1/m^2), turn
        on the spot (rad).
        """
    @property
    def length(self) -> Optional[float]:
        """Length of the path in metres; None without a path."""
    @property
    def cusps(self) -> Optional[int]:
        """Number of changes of direction; None without a path."""
    @property
    def clearance(self) -> Optional[float]:
        """Minimum distance between the car and obstacles along the path in metres; None without a path."""
    @property
    def trajectory(self) -> NDArray[numpy.float64]:
        """Quickest trajectory near the path, at most 0.05 s between rows: an n x 8 array of t, x, y, yaw, v,
        acceleration, steering, steering rate. Computed on first use.
        """
    @property
    def duration(self) -> float:
        """Duration of the trajectory in seconds."""
    @property
    def trajectory_info(self) -> Dict[str, Any]:
        """Properties of the trajectory, a dict: duration, fallback (whether it stops to steer), reason of the fallback,
        tpcap_cost, gear_changes.
        """
    @property
    def cost(self) -> float:
        """Cost in metres: length and penalties; infinite without a path."""
    @property
    def statistics(self) -> Dict[str, float]:
        """Statistics of planning as a dict, see Result and ParkingPlan."""
    def plot(self, path: Optional[PathLike] = None, axes: Any = None, footprints: float = 1.5) -> Any:
        """Draws the result with matplotlib and returns the axes."""
    def animate(self, title: Optional[str] = None, height: int = 760) -> Any:
        """Returns an Animation of the drive along the trajectory."""
    def __bool__(self) -> bool:
        """Whether planning was successful, see Result and ParkingPlan."""

class Result(Drive):
    """Result of plan().

    It is True if the path reaches a goal exactly. Arrays are created on first use and then kept.
    """
    @property
    def reason(self) -> str:
        """Reason why there is no exact solution; empty otherwise."""
    @property
    def notice(self) -> str:
        """One line on an escape, or on straights shorter than the parameters require; empty otherwise."""
    @property
    def escape(self) -> Optional[Dict[str, float]]:
        """Escape from contact with which the path begins: depth of the contact and signed length in metres, curvature
        in 1/m. None without an escape."""
    @property
    def bound(self) -> float:
        """Ratio of the cost to a lower bound of the cost of any path (see docs/planner.md); infinite if unknown."""
    @property
    def goal(self) -> Optional[Pose]:
        """Goal pose that the path reaches or approaches; None without a path."""
    @property
    def parameters(self) -> Dict[str, Union[bool, int, float, str]]:
        """All parameters of the planner, as a dict."""

class ParkingPlan(Drive):
    """Result of ParkingPlanner.plan(). It is True if a path was found."""
    @property
    def found(self) -> bool:
        """Whether a path was found."""
    @property
    def message(self) -> str:
        """One line: the kind of plan, or the reason of the failure."""
    @property
    def goal(self) -> Optional[Pose]:
        """Chosen goal pose; None without a path."""
    @property
    def gap(self) -> float:
        """Gap kept around the car while planning, in metres."""
    @property
    def turning_radius(self) -> float:
        """Planned turning radius in metres."""
    @property
    def is_smooth(self) -> bool:
        """Whether the curvature of the path is continuous between its cusps."""

class ParkingPlanner:
    """Plans paths into slots with as much clearance as possible and a continuous curvature. It constructs a manoeuvre
    if one fits, and searches the rest of the path.

    tight : whether to use parameters for slots with centimetres of clearance
    time_limit : seconds for all attempts
    gaps : list of metres kept around the car, one per attempt
    gap_worth : metres, weight of the gap against the cost of a path
    expansions_per_gap : limit of expansions per attempt
    radius_factor : planned turning radius over the minimum of the car
    gear_change_penalty : metres, cost of a change of direction
    steering_change_penalty : metres, cost of steering to full lock
    preferred_clearance : metres kept from obstacles where that is cheap
    clearance_cost : extra cost per metre driven closer than that
    way_in : method of planning the slot entry: searched, one_sweep or in_stretches
    aisle_width : metres
    smooth : whether to make the curvature continuous
    """
    def __init__(self, tight: bool = False, *, time_limit: float = 10.0, gaps: Sequence[float] = ...,
                 gap_worth: float = ..., expansions_per_gap: int = ..., radius_factor: float = ...,
                 gear_change_penalty: float = ..., steering_change_penalty: float = ...,
                 preferred_clearance: float = ..., clearance_cost: float = ..., way_in: str = ...,
                 aisle_width: float = ..., smooth: bool = True) -> None: ...
    def plan(self, scenario: Scenario) -> ParkingPlan:
        """Plans from the start of a scenario to its goal or slot and returns a ParkingPlan."""

class Verdict:
    """Result of check(). It is True for a valid path."""
    @property
    def valid(self) -> bool:
        """Whether the path is valid."""
    @property
    def fault(self) -> str:
        """First fault found: none, no_path, not_finite, wrong_start, misses_goal, not_drivable or collision."""
    @property
    def reason(self) -> str:
        """Description and place of the fault; empty for a valid path."""
    @property
    def states(self) -> int:
        """Number of tested poses."""
    @property
    def collisions(self) -> int:
        """Number of tested poses in collision."""
    @property
    def max_curvature(self) -> float:
        """Maximum curvature of the path in 1/m."""
    def __bool__(self) -> bool:
        """Whether the path is valid."""

# parameters:begin, the table of parameters
def plan(scenario: Scenario, time_limit: float = 1.0, anytime: bool = False, max_expansions: int = 0, *,
         parameter_set: str = 'default', motion_model: str = 'car', turning_radius: float = 3.0,
         xy_resolution: float = 0.0, heading_bins: int = 72, steering_angles: int = 3, bidirectional: bool = True,
         search_from: str = 'goal', open_list: str = 'binary_heap', heuristic_weight_far: float = 2.5,
         heuristic_weight_near: float = 2.5, near_goal_distance: float = 5.0, tie_break: float = 0.001,
         heuristic: str = 'default', obstacle_heuristic: bool = True, detours: bool = True,
         obstacle_loading: str = 'lazy', adaptive_resolution: bool = True, analytic_expansion: bool = True,
         reverse_penalty: float = 0.0, gear_change_penalty: float = 0.5, steering_change_penalty: float = 0.1,
         preferred_clearance: float = 0.1, clearance_cost: float = 10.0, smoothing: str = 'bspline',
         shortening: bool = True, approximate: bool = True, max_memory_mb: int = 512,
         goal_tolerance: float = 1e-05, initial_straight: float = 0.0, final_straight: float = 0.0,
         escape: bool = False, max_escape_depth: float = 0.05) -> Result:
    """Plans a path from the start of a scenario to its goal, or to the nearest of several.

    time_limit : seconds
    anytime : whether to improve the path until the time limit
    max_expansions : limit of the number of expansions, independent of any clock; 0: no limit

    See docs/parameters.md for the other parameters. Other Python threads continue during the search, and Ctrl-C
    interrupts it. Raises Error for an invalid value.
    """
def plan_batch(scenarios: Iterable[Scenario], threads: int = 0, time_limit: float = 1.0, anytime: bool = False,
               max_expansions: int = 0, *, parameter_set: str = 'default', motion_model: str = 'car',
               turning_radius: float = 3.0, xy_resolution: float = 0.0, heading_bins: int = 72,
               steering_angles: int = 3, bidirectional: bool = True, search_from: str = 'goal',
               open_list: str = 'binary_heap', heuristic_weight_far: float = 2.5, heuristic_weight_near: float = 2.5,
               near_goal_distance: float = 5.0, tie_break: float = 0.001, heuristic: str = 'default',
               obstacle_heuristic: bool = True, detours: bool = True, obstacle_loading: str = 'lazy',
               adaptive_resolution: bool = True, analytic_expansion: bool = True, reverse_penalty: float = 0.0,
               gear_change_penalty: float = 0.5, steering_change_penalty: float = 0.1,
               preferred_clearance: float = 0.1, clearance_cost: float = 10.0, smoothing: str = 'bspline',
               shortening: bool = True, approximate: bool = True, max_memory_mb: int = 512,
               goal_tolerance: float = 1e-05, initial_straight: float = 0.0, final_straight: float = 0.0,
               escape: bool = False, max_escape_depth: float = 0.05) -> List[Result]:
    """Plans many scenarios in parallel and returns their Results in the same order.

    threads : number of threads; 0 for one per core

    The other arguments are those of plan().
    """
# parameters:end

def check(scenario: Scenario, path: Union[Drive, ArrayLike], exact: bool = True) -> Verdict:
    """Checks a path with code that is independent of the planner. The path must lead from the start to a goal within
    the turning radius of the car. Its body must be free of collision, tested every 5 mm.

    path : a Result, a ParkingPlan, or an array of n rows (x, y, yaw, ...), joined by arcs
    exact : False for a path that only ends near a goal

    Returns a Verdict.
    """
