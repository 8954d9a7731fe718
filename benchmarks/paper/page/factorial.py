"""The two-level factorial of the five improvements: main effects, and how two improvements change each other's effect."""
import itertools
import math

from formatting import shown
from design import FACTORS, KEYS, VARIANTS
from paired import LEVEL, NEAR, comparison_of, correct
from study import MEASURES

EFFECT_MEASURES = ('total', 'cells', 'expanded', 'length', 'turning')
NAMES = {key: name for key, name, _, _ in FACTORS}


def effect_of(keys, figures):
    """The factor by which the improvements keys change a figure of one map: with one key with / without it, with two
    the factor by which each changes the effect of the other. Geometric mean over all combinations of the rest.

    figures: variant -> value. None when one is missing or not positive."""
    total, terms = 0.0, 0
    for variant in VARIANTS:
        value = figures.get(variant, 0.0)
        if not value > 0.0:
            return None
        present = variant.replace('none', '')
        sign = math.prod(1 if key in present else -1 for key in keys)
        total += sign * math.log(value)
        terms += 1
    return math.exp(total * 2 ** len(keys) / terms)


def effects(study, measure):
    """Of all improvements and pairs of them, over the maps: {keys: Comparison}, one family of tests."""
    per_map = {}
    for variant in VARIANTS:
        for name, value in study.figures(measure, variant).items():
            per_map.setdefault(name, {})[variant] = value
    found = {}
    for keys in [key for count in (1, 2) for key in itertools.combinations(KEYS, count)]:
        values = [effect for effect in (effect_of(keys, figures) for figures in per_map.values()) if effect is not None]
        found[keys] = comparison_of(values)
    correct(list(found.values()))
    return found


def is_certain(effect):
    return effect.certain and effect.chance < LEVEL and not effect.low <= 1.0 <= effect.high


def cell(effect):
    if not effect.ratios:
        return '–'
    text = shown(effect.middle)
    if effect.certain:
        text += f' ({shown(effect.low)} to {shown(effect.high)})'
    return f'**{text}**' if is_certain(effect) else text


def main_table(found):
    """found: {measure: effects()}."""
    lines = ['| improvement | ' + ' | '.join(MEASURES[measure][0].split(',')[0] for measure in found) + ' |',
             '| --- |' + ' ---: |' * len(found)]
    for key in KEYS:
        lines.append(f'| {NAMES[key]} | ' + ' | '.join(cell(each[(key,)]) for each in found.values()) + ' |')
    return '\n'.join(lines)


def interaction_table(found):
    """Those of at least 5 % that are certain."""
    lines = ['| two improvements | figure | factor |', '| --- | --- | ---: |']
    for measure, each in found.items():
        for keys, effect in each.items():
            if len(keys) == 2 and is_certain(effect) and abs(math.log(effect.middle)) > math.log(NEAR):
                lines.append(f'| {NAMES[keys[0]]}, {NAMES[keys[1]]} | {MEASURES[measure][0].split(",")[0]} | '
                             f'{cell(effect)} |')
    return '\n'.join(lines) if len(lines) > 2 else 'None is certain.'

