"""Letters and widths are those that FreeType reads from the same fonts."""

import pytest
from matplotlib.ft2font import FT2Font, LoadFlags

from fcl_sim.report import lettering, truetype

FONTS = [lettering.fonts() / name for name in ("DejaVuSans.ttf", "DejaVuSans-Bold.ttf")]


@pytest.mark.parametrize("file", FONTS, ids=lambda file: file.stem)
def test_every_letter_of_a_font_is_as_wide_as_freetype_has_it(file):
    found, font = truetype.read(file), FT2Font(str(file))
    assert dict(found.glyphs) == {code: glyph for code, glyph in font.get_charmap().items() if glyph}
    widths = {
        code: font.load_glyph(glyph, flags=LoadFlags.NO_SCALE).horiAdvance
        for code, glyph in font.get_charmap().items()
    }
    assert {code: found.advance(chr(code)) for code in widths} == widths


@pytest.mark.parametrize("file", FONTS, ids=lambda file: file.stem)
def test_both_maps_of_a_font_agree_on_the_letters_that_both_have(file, monkeypatch):
    whole = truetype.read(file).glyphs
    monkeypatch.setattr(truetype, "UNICODE", {(3, 1): 4})
    small = truetype.read(file).glyphs
    assert dict(small) == {code: glyph for code, glyph in whole.items() if code < 0x10000}


def test_a_letter_that_the_font_lacks_is_as_wide_as_its_box():
    font = truetype.read(FONTS[0])
    assert font.advance("\N{CJK UNIFIED IDEOGRAPH-6F22}") == font.advances[0]


def test_a_font_without_a_map_of_unicode_is_refused(monkeypatch):
    monkeypatch.setattr(truetype, "UNICODE", {(9, 9): 4})
    with pytest.raises(ValueError, match="no map of Unicode"):
        truetype.read(FONTS[0])
