"""Figures in the format for readers."""
import math
import re


def own_name(planner):
    """The name of a planner without that of its results: "RRT (old)" is RRT."""
    return re.sub(r' \(.*\)$', '', planner)


def shown(value, digits=3):
    """A number with at least that many significant digits, and no exponent."""
    if value is None or math.isnan(value):
        return '–'
    if math.isinf(value):
        return '∞'
    if value == 0.0:
        return '0'
    return f'{value:.{min(6, max(0, digits - 1 - math.floor(math.log10(abs(value)))))}f}'


def shown_time(seconds):
    """A time such as 4.81 ms, 1.20 s or ∞."""
    if not math.isfinite(seconds):
        return shown(seconds)
    if seconds < 1e-3:
        return shown(1e6 * seconds) + ' µs'
    return shown(1e3 * seconds) + ' ms' if seconds < 1.0 else shown(seconds) + ' s'


def shown_in(value, unit, digits=3):
    """A value with its unit; empty without a value."""
    return shown(value, digits) + (f' {unit}' if unit and math.isfinite(value) else '')


def percent(share):
    return f'{100.0 * share:.0f} %'


def probability(p):
    """A probability such as p = 0.012 or p < 0.0001."""
    return 'p < 0.0001' if p < 1e-4 else f'p = {p:.2g}'
