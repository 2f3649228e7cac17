"""The page of the program's commands, of what the program itself says of them (`ortung --describe`)."""
import json
import re

PLAIN = re.compile(r"([\\`*_{}\[\]<>#|$~])")


def escaped(text):
    """Text as Markdown shows it, in a cell of a table too."""
    return PLAIN.sub(r"\\\1", text).replace("\n", " ")


def option_row(option):
    name = ", ".join(f"`{name}`" for name in option["names"]) or f"`{option['positional'].upper()}`"
    if not option["flag"] and option["names"]:
        choices = option.get("choices")
        name += " " + (" or ".join(f"`{choice}`" for choice in choices) if choices else "VALUE")
    how = [word for word, holds in (("required", option["required"]), ("repeatable", option["many"])) if holds]
    default = f"`{option['default']}`" if option.get("default") else "-"
    return f"| {name} | {escaped(option['help'])} | {', '.join(how + [default]) if how and default != '-' else ', '.join(how) or default} |"


def section(command):
    lines = [f"## {command['name']}", "", escaped(command["summary"]) + ".", ""]
    options = [o for o in command["options"] if "--help" not in o["names"]]
    if options:
        lines += ["| option | meaning | default |", "|---|---|---|", *map(option_row, options), ""]
    if footer := command["footer"].strip():
        lines += ["```text", footer, "```", ""]
    return "\n".join(lines)


def page(description):
    """@param description what `ortung --describe` prints: an object a line"""
    commands = [json.loads(line) for line in description.splitlines() if line]
    if not commands:
        raise ValueError("the program describes no command")
    head = ["# Commands", "",
            "All that `ortung` does, as the program describes itself: `ortung COMMAND --help` prints the same. Each command takes "
            "`--help`. Exit codes: 0 success, 1 failure, 2 wrong usage.", ""]
    head += ["| command | what it does |", "|---|---|"]
    for command in commands:
        anchor = re.sub(r"[^\w\- ]", "", command["name"].lower()).replace(" ", "-")
        head.append(f"| [{command['name']}](#{anchor}) | {escaped(command['summary'])} |")
    return "\n".join(head) + "\n\n" + "\n".join(map(section, commands))
