"""Draws how a learner got better; python3-pil draws."""


def picture(file, title, places, across, shares, levels):
    """Writes a PNG file. places: numbers along the axis below, which is called across; shares: of each line its name,
    colour and values in [0, 1]; levels: names, colours and values of lines that are dashed"""
    from PIL import Image, ImageDraw, ImageFont

    width, height, left, right, top, bottom = 720, 420, 70, 30, 50, 60
    image = Image.new("RGB", (width, height), "white")
    draw = ImageDraw.Draw(image)
    try:
        font = ImageFont.truetype("DejaVuSans.ttf", 14)
    except OSError:
        font = ImageFont.load_default()
    most = max(places[-1], 1)

    def at(place, share):
        return left + (width - left - right) * place / most, height - bottom - (height - top - bottom) * share

    for percent in range(0, 101, 20):
        y = at(0, percent / 100)[1]
        draw.line([(left, y), (width - right, y)], fill="#dddddd")
        draw.text((left - 45, y - 8), f"{percent} %", fill="black", font=font)
    step = next(s * 10**e for e in range(9) for s in (1, 2, 5) if most / (s * 10**e) <= 10)
    for place in range(0, int(most) + 1, step):
        draw.text((at(place, 0)[0] - 5, height - bottom + 8), str(place), fill="black", font=font)
    draw.text((width // 2 - 4 * len(across), height - bottom + 32), across, fill="black", font=font)
    draw.text((left, 14), title, fill="black", font=font)
    for name, colour, share in levels:
        y = at(0, share)[1]
        for x in range(left, width - right, 12):
            draw.line([(x, y), (x + 5, y)], fill=colour)
        draw.text((width - right - 8 * len(name), y - 20), name, fill=colour, font=font)
    for name, colour, values in shares:
        points = [at(*one) for one in zip(places, values)]
        draw.line(points, fill=colour, width=3)
        for x, y in points:
            draw.ellipse([x - 4, y - 4, x + 4, y + 4], fill=colour)
        x, y = points[-1]
        draw.text((x - 60, y + (10 if values[-1] > 0.5 else -26)), name, fill=colour, font=font)
    image.save(file, optimize=True)
