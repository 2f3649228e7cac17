"""Sentences about arguments that a function does not take. It is loaded with the first such call."""
import difflib
import functools
import inspect
import re

_REFUSED = re.compile(r"(\w+)\(\): incompatible (function|constructor) arguments")
_SIGNATURE = re.compile(r"^    1\. ([\w.]*)\((.*)\)(?: -> .*)?$", re.MULTILINE)
_LONGEST = 60  # letters of a value that is shown

# How pybind11 writes a type, which values are of it, and how a sentence calls it.
_KINDS = {
    "os.PathLike": (lambda one: isinstance(one, (str, bytes)) or hasattr(one, "__fspath__"), "a path, as str or pathlib.Path"),
    "str": (lambda one: isinstance(one, (str, bytes)), "a text (str)"),
    "int": (lambda one: hasattr(one, "__index__"), "a whole number (int)"),
    "float": (lambda one: hasattr(one, "__float__") or hasattr(one, "__index__"), "a number (float)"),
    "bool": (lambda one: one is None or hasattr(one, "__bool__"), "True or False"),
    "dict": (lambda one: isinstance(one, dict), "a dict"),
    "sequence": (lambda one: _is_list(one), "a list"),
}


def _is_list(one):
    return hasattr(one, "__len__") and hasattr(one, "__getitem__") and not isinstance(one, (str, bytes, dict))


def _split(text):
    """Splits at the commas that no bracket encloses."""
    depth, parts = 0, [""]
    for letter in text:
        depth += (letter in "[({<") - (letter in "])}>")
        if letter == "," and depth == 0:
            parts.append("")
        else:
            parts[-1] += letter
    return [part.strip() for part in parts if part.strip()]


def _kind(kind):
    """Returns whether a value may be of a kind, and what a sentence calls it."""
    if kind in _KINDS:
        return _KINDS[kind]
    inside = re.fullmatch(r"(Optional|List)\[(.*?)(?:\[(\d+)\])?\]", kind)
    if inside:
        fits, name = _kind(inside[2])
        if inside[1] == "Optional":
            return lambda one: one is None or fits(one), f"{name} or None"
        return (lambda one: _is_list(one) and len(one) == int(inside[3] or len(one)) and all(map(fits, one)),
                f"a list of {inside[3] or 'any length'}, each {name}")
    if kind.startswith("Union["):
        kinds = [_kind(one) for one in _split(kind[len("Union["):-1])]
        return lambda one: any(fits(one) for fits, _ in kinds), " or ".join(name for _, name in kinds)
    if kind.startswith("ortung."):
        last = kind.rpartition(".")[2]
        return lambda one: last in [base.__name__ for base in type(one).__mro__], f"{_article(last)} {last}"
    return lambda one: True, kind


def _article(word):
    return "an" if word[0].lower() in "aeiou" else "a"


def shown(value):
    """Returns what a sentence calls a value: its repr, or the name of its class if that is long or fails."""
    try:
        text = repr(value)
    except Exception:  # of a class of the user's
        return f"{_article(type(value).__name__)} {type(value).__name__}"
    return text if len(text) <= _LONGEST else f"{_article(type(value).__name__)} {type(value).__name__}"


def unknown(who, name, names):
    """Says that there is no argument of a name, and which one was meant or which there are."""
    near = difflib.get_close_matches(name, names, 1, 0.6)
    longer = [one for one in names if one.startswith(name) or name.startswith(one)]
    if near or longer:
        return f"{who}() has no argument '{name}': did you mean '{(near or longer)[0]}'?"
    return f"{who}() has no argument '{name}', it takes {', '.join(names) or 'none'}"


def _sentence(who, wanted, args, kwargs):
    """Says what is wrong with a call. wanted: of each argument its name, its kind, and whether it may be left out."""
    names = [name for name, _, _ in wanted]
    for name in kwargs:
        if name not in names:
            return unknown(who, name, names)
    if len(args) > len(names):
        return f"{who}() takes {', '.join(names) or 'no arguments'}; {len(args)} arguments were given by their places"
    for name in names[:len(args)]:
        if name in kwargs:
            return f"{who}() got '{name}' twice, by its place and by its name"
    given = {**dict(zip(names, args)), **kwargs}
    missing = [f"'{name}', {_kind(kind)[1]}" for name, kind, may_lack in wanted if name not in given and not may_lack]
    if missing:
        return f"{who}() lacks {' and '.join(missing)}"
    for name, kind, _ in wanted:
        if name in given and not _kind(kind)[0](given[name]):
            return f"{who}(): {name} is {shown(given[name])}, expected {_kind(kind)[1]}"
    for name, kind, _ in wanted:
        if name in given and "int" in kind and isinstance(given[name], int):
            lower = "a whole number that fits its range; most may not be negative"
            return f"{who}(): {name} is {shown(given[name])}, expected {lower}" if given[name] < 0 else \
                f"{who}(): {name} is {shown(given[name])}, expected a smaller whole number"
    return None


def told(error, args, kwargs):
    """Returns the error with a sentence in the place of pybind11's list of signatures, or the same error if it is about
    something else."""
    text = str(error)
    refused, signature = _REFUSED.match(text), _SIGNATURE.findall(text)
    if not refused or len(signature) != 1 or "\n    2. " in text:
        return error
    owner, inside = signature[0]
    parts = _split(inside)
    who = refused[1]
    if refused[2] == "constructor":
        who, args = owner.rpartition(".")[2], args[1:]
    elif parts and parts[0].startswith("self: "):
        who = f"{parts[0].rpartition('.')[2]}.{who}"
        parts, args = parts[1:], args[1:]
    wanted = []
    for part in parts:
        name, _, rest = part.partition(": ")
        kind, has_default, _ = rest.partition(" = ")
        wanted.append((name, kind, bool(has_default)))
    sentence = _sentence(who, wanted, args, kwargs)
    if sentence is None:
        return error
    better = TypeError(sentence)
    better.__cause__ = error.__cause__
    return better


def need(who, name, value, kind, origin):
    """Raises TypeError, which says what was expected and where that comes from, unless the value is of a class."""
    if not isinstance(value, kind):
        expected = f"{_article(kind.__name__)} {kind.__name__} ({origin})"
        raise TypeError(f"{who}(): {name} is {shown(value)}, expected {expected}")


def plainly(function):
    """Lets a function written in Python refuse unknown names of arguments as those of C++ do."""
    names = list(inspect.signature(function).parameters)

    @functools.wraps(function)
    def checked(*args, **kwargs):
        for name in kwargs:
            if name not in names:
                raise TypeError(unknown(function.__name__, name, names))
        return function(*args, **kwargs)

    return checked
