"""Man pages from the program's description of its commands."""

import json
import subprocess
from datetime import datetime, timezone


def pages(program, time) -> dict[str, str]:
    """The text of each page by its name: one for the program, one for each subcommand."""
    dump = subprocess.run(
        [program, "--experimental-dump-help"], check=True, capture_output=True).stdout
    command = json.loads(dump)["command"]
    date = datetime.fromtimestamp(time, timezone.utc).strftime("%Y-%m-%d")
    version = subprocess.run([program, "--version"], check=True, capture_output=True, text=True)
    heading = f'"{date}" "{version.stdout.strip()}"'
    subcommands = [c for c in command["subcommands"] if c["commandName"] != "help"]
    result = {command["commandName"]: page(command, command["commandName"], heading, subcommands)}
    for subcommand in subcommands:
        name = f"{command['commandName']}-{subcommand['commandName']}"
        result[name] = page(subcommand, name, heading, [])
    return result


def page(command, name, heading, subcommands) -> str:
    title = name.upper()
    lines = [f'.TH "{title}" 1 {heading}', ".SH NAME", f"{name} \\- {escaped(command['abstract'])}"]
    lines += [".SH SYNOPSIS", f".B {name.replace('-cli-', '-cli ')}"]
    arguments = [a for a in command.get("arguments", []) if a["shouldDisplay"]]
    lines += [escaped(synopsis(a)) for a in arguments if a["kind"] == "positional"]
    lines += ["[options]"]
    if command.get("discussion"):
        lines += [".SH DESCRIPTION", ".nf", escaped(command["discussion"]), ".fi"]
    if arguments:
        lines += [".SH OPTIONS"]
    for argument in arguments:
        lines += [".TP", f".B {escaped(usage(argument))}", escaped(description(argument))]
    if subcommands:
        lines += [".SH COMMANDS"]
    for subcommand in subcommands:
        full = f"{name}-{subcommand['commandName']}"
        lines += [".TP", f".BR {full} (1)", escaped(subcommand["abstract"])]
    return "\n".join(lines) + "\n"


def escaped(text) -> str:
    """Text in which roff finds no requests."""
    text = text.replace("\\", "\\e").replace("-", "\\-")
    return "\n".join("\\&" + line if line[:1] in (".", "'") else line for line in text.split("\n"))


def synopsis(argument) -> str:
    name = f"<{argument['valueName']}>" + (" ..." if argument["isRepeating"] else "")
    return f"[{name}]" if argument["isOptional"] else name


def usage(argument) -> str:
    if argument["kind"] == "positional":
        return f"<{argument['valueName']}>"
    names = [
        ("--" if name["kind"] == "long" else "-") + name["name"] for name in argument["names"]]
    value = f" <{argument['valueName']}>" if argument["kind"] == "option" else ""
    return ", ".join(names) + value


def description(argument) -> str:
    text = argument.get("abstract", "")
    if argument.get("allValues"):
        text += " Values: " + ", ".join(argument["allValues"]) + "."
    if argument.get("defaultValue"):
        text += f" The default is {argument['defaultValue']}."
    return text
