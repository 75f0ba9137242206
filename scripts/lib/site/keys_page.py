"""The page with all keys of decks, from what the command says of them (`atrapos keys`)."""
import re

HEAD = """# All keys of a deck

Made from the tables by which `atrapos` reads decks (`atrapos keys` prints them): what is here is accepted, and nothing else is. What the keys are for is told in
[The deck](deck.md).
"""


def page(lines):
    """lines: those of `atrapos keys`, 'path: what is accepted [default]. meaning'."""
    text, block = HEAD, None
    for line in lines:
        path, rest = line.split(": ", 1)
        where, key = path.rpartition("/")[::2]
        accepts, meaning = rest.split(". ", 1)
        default = re.search(r" \[(.*)\]$", accepts)
        if default:
            accepts = accepts[:default.start()]
        if where != block:
            block = where
            text += f"\n## {'`' + where + '`' if where else 'The deck'}\n\n"
            text += "| key | value | default | meaning |\n|---|---|---|---|\n"
        cells = [f"`{key}`", accepts, f"`{default.group(1)}`" if default else "", meaning]
        text += "| " + " | ".join(cell.replace("|", "\\|") for cell in cells) + " |\n"
    return text
