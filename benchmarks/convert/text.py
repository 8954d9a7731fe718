"""Numbers and names as the project's other programs read and write them."""
import re

NUMBER = re.compile(r'[-+]?(?:\d+\.?\d*|\.\d+)(?:[eE][-+]?\d+)?', re.ASCII)


def pose_of(text):
    """x, y and yaw, with commas or blanks between them; None for anything else."""
    words = text.replace(',', ' ').split()
    if len(words) != 3 or not all(map(NUMBER.fullmatch, words)):
        return None
    return tuple(map(float, words))


def number(value):
    """The shortest text that reads as the same number; whole numbers without a point."""
    return repr(float(value)).removesuffix('.0')


def numbers(values, separator=', '):
    return separator.join(map(number, values))


def one_line(text):
    """What is not printable ASCII becomes a question mark."""
    return ''.join(each if ' ' <= each <= '~' else '?' for each in text)


def quoted(text, longest=60):
    return f"'{one_line(text[:longest])}{'...' if len(text) > longest else ''}'"


def counted(count, what, plural=None):
    return f'{count} {what if count == 1 else plural or what + "s"}'
