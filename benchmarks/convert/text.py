"""Numbers and names in the formats of the project's other programs."""
import re

NUMBER = re.compile(r'[-+]?(?:\d+\.?\d*|\.\d+)(?:[eE][-+]?\d+)?', re.ASCII)


def pose_of(text):
    """x, y and yaw, separated by commas or blanks; None for other text."""
    words = text.replace(',', ' ').split()
    if len(words) != 3 or not all(map(NUMBER.fullmatch, words)):
        return None
    return tuple(map(float, words))


def number(value):
    """The shortest text of the same number; whole numbers without a point."""
    return repr(float(value)).removesuffix('.0')


def numbers(values, separator=', '):
    return separator.join(map(number, values))


def one_line(text):
    """Replaces all but printable ASCII by question marks."""
    return ''.join(each if ' ' <= each <= '~' else '?' for each in text)


def quoted(text, longest=60):
    return f"'{one_line(text[:longest])}{'...' if len(text) > longest else ''}'"


def counted(count, what, plural=None):
    return f'{count} {what if count == 1 else plural or what + "s"}'
