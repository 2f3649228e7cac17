"""Bar charts of docs/results.md, as small SVG that needs no fonts and can be read on light and on dark pages."""
import math
from xml.sax.saxutils import escape

# Pages embed pictures as images, which know nothing of the page's colours: so each of these stands out against white and black.
TEXT = "#777777"
LINE = "#99999966"
INSIDE = "#ffffff"  # on a bar
COLOURS = ("#2f7fd0", "#c4651c", "#8a6d9e", "#4d8f55")
LEFT, WIDTH, BAR, GAP, TOP = 190, 430, 13, 9, 34


def steps(most):
    """Round numbers from 0 on, of which the last is at least `most`."""
    step = 10.0 ** math.floor(math.log10(most / 4))
    step *= next(factor for factor in (1, 2, 2.5, 5, 10) if most / (step * factor) <= 5)
    return [i * step for i in range(math.ceil(most / step - 1e-9) + 1)]


def text(x, y, words, anchor="start", more=""):
    return '<text x="%.0f" y="%.0f" text-anchor="%s"%s>%s</text>' % (x, y, anchor, more, escape(words))


def bar(x, y, value, colour, shown, clipped):
    """A bar from 0 to `value` [px], with its figure behind it; one that is longer than the chart ends in an arrow."""
    end = x + value
    if clipped:
        shape = "M%.1f %.1fH%.1fl6 %.1fl-6 %.1fH%.1fz" % (x, y, end - 6, BAR / 2, BAR / 2, x)
    else:
        shape = "M%.1f %.1fH%.1fv%dH%.1fz" % (x, y, end, BAR, x)
    return '<path d="%s" fill="%s"/>' % (shape, colour) + text(end + 5, y + BAR - 3, shown)


def chart(title, unit, series, most=None, digits=0):
    """A picture of groups of bars: a group for each label, in it a bar for each series that has the label.
    @param series [(name, number of the colour, {label: (value, low, high)})] in the order of the legend; low and high may be None
    @param most end of the axis, in units; None: beyond the greatest value
    @return the text of an SVG file"""
    labels = list(dict.fromkeys(label for *_, values in series for label in values))
    highest = max(v if high is None else high for *_, values in series for v, _, high in values.values())
    ticks = steps(most or highest)
    scale = WIDTH / ticks[-1]
    parts, y = [], TOP
    for label in labels:
        having = [(colour, values[label]) for _, colour, values in series if label in values]
        height = BAR * len(having)
        parts.append(text(LEFT - 8, y + height / 2 + 4, label, "end"))
        for colour, (value, low, high) in having:
            length = min(value * scale, WIDTH)
            shown = format(value, ",.%df" % digits)
            if low is None:
                parts.append(bar(LEFT, y, length, COLOURS[colour], shown, value > ticks[-1]))
            else:
                parts.append(bar(LEFT, y, length, COLOURS[colour], "", False))
                for begin, end, stroke in ((low, value, INSIDE), (value, high, TEXT)):
                    parts.append('<path d="M%.1f %.1fH%.1f" stroke="%s" stroke-width="2"/>'
                                 % (LEFT + max(begin, 0) * scale, y + BAR / 2, LEFT + end * scale, stroke))
                parts.append(text(LEFT + high * scale + 5, y + BAR - 3, shown))
            y += BAR
        y += GAP
    grid = ['<path d="M%.1f %dV%.0f" stroke="%s"/>' % (LEFT + tick * scale, TOP - 4, y, LINE) for tick in ticks]
    grid += [text(LEFT + tick * scale, y + 14, format(tick, ",g"), "middle") for tick in ticks]
    grid.append(text((LEFT + WIDTH + 60) / 2, y + 30, unit, "middle"))
    at = LEFT
    for name, colour, values in series:
        if list(values) == [name]:  # its bar says it
            continue
        grid.append('<path d="M%.0f 12h10v10h-10z" fill="%s"/>' % (at, COLOURS[colour]) + text(at + 14, 21, name))
        at += 28 + 6.4 * len(name)
    return ('<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 %d %.0f" width="%d" role="img" font-family="sans-serif" '
            'font-size="11" fill="%s"><title>%s</title>\n%s\n</svg>\n'
            % (LEFT + WIDTH + 60, y + 38, LEFT + WIDTH + 60, TEXT, escape(title), "\n".join(grid + parts)))
