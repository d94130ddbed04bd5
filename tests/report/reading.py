"""Reads a PDF back: its words, its tags, its fonts, as a screen reader or an archive would."""

import re
from collections.abc import Iterator

import pikepdf
from pikepdf import Array, Dictionary, Name, Object, Pdf

SHOWS = {"Tj", "TJ", "'", '"'}


def words(pdf: Pdf) -> str:
    """Return all text of a PDF, in the order in which it is drawn, without any white space."""
    return "".join(page_words(pdf))


def page_words(pdf: Pdf) -> list[str]:
    """Return the text of each page, as `words` has it."""
    return ["".join(_drawn(page)) for page in pdf.pages]


def bare(text: str) -> str:
    """Return text as `words` has it."""
    return re.sub(r"\s+", "", text)


def _drawn(content: Object) -> Iterator[str]:
    resources = content.get(Name.Resources, Dictionary())
    fonts = {name: _characters(font) for name, font in resources.get(Name.Font, Dictionary()).items()}
    forms = resources.get(Name.XObject, Dictionary())
    characters: dict[int, str] = {}
    spoken: list[str | None] = []
    for operands, operator in pikepdf.parse_content_stream(content):
        match str(operator):
            case "Tf":
                characters = fonts[str(operands[0])]
            case "BDC" | "BMC":
                spoken.append(_actual(operands))
            case "EMC":
                yield bare(spoken.pop() or "")
            case "Do" if forms[operands[0]].get(Name.Subtype) == Name.Form:
                yield from _drawn(forms[operands[0]])
            case show if show in SHOWS and not any(each is not None for each in spoken):
                yield from _decoded(operands[-1], characters)


def _actual(operands: list[Object]) -> str | None:
    """Return what marked content says it means, where it does."""
    properties = operands[-1]
    if isinstance(properties, Dictionary) and Name.ActualText in properties:
        return str(properties.ActualText)
    return None


def _decoded(shown: Object, characters: dict[int, str]) -> Iterator[str]:
    pieces = shown if isinstance(shown, Array) else [shown]
    for piece in pieces:
        if isinstance(piece, pikepdf.String):
            codes = bytes(piece)
            for at in range(0, len(codes), 2):
                yield re.sub(r"\s", "", characters[int.from_bytes(codes[at : at + 2])])


def _characters(font: Object) -> dict[int, str]:
    """Return what the codes of a font mean, from its ToUnicode map."""
    table = font[Name.ToUnicode].read_bytes().decode("ascii")
    found = {}
    for block in re.findall(r"beginbfchar(.*?)endbfchar", table, re.DOTALL):
        for code, text in re.findall(r"<([0-9A-Fa-f]+)>\s*<([0-9A-Fa-f]*)>", block):
            found[int(code, 16)] = bytes.fromhex(text).decode("utf-16-be")
    for block in re.findall(r"beginbfrange(.*?)endbfrange", table, re.DOTALL):
        for first, last, text in re.findall(r"<(\w+)>\s*<(\w+)>\s*<(\w+)>", block):
            start = int.from_bytes(bytes.fromhex(text))
            for code in range(int(first, 16), int(last, 16) + 1):
                value = start + code - int(first, 16)
                found[code] = value.to_bytes(len(text) // 2).decode("utf-16-be")
    return found


def tags(pdf: Pdf) -> Iterator[Object]:
    """Yield every structure element of a tagged PDF."""
    waiting = [pdf.Root.StructTreeRoot]
    while waiting:
        element = waiting.pop()
        if Name.S in element:
            yield element
        kids = element.get(Name.K, Array([]))
        nodes = [kid for kid in (kids if isinstance(kids, Array) else [kids]) if isinstance(kid, Dictionary)]
        waiting += [kid for kid in nodes if Name.S in kid or Name.K in kid]


def alternatives(pdf: Pdf) -> list[str]:
    """Return the alternative text of every figure."""
    return [str(tag.get(Name.Alt, "")) for tag in tags(pdf) if Name.Figure == tag.S]


def fonts(pdf: Pdf) -> Iterator[Object]:
    """Yield every font of a PDF, those inside of figures too."""
    for each in pdf.objects:
        if isinstance(each, Dictionary) and each.get(Name.Type) == Name.FontDescriptor:
            yield each
