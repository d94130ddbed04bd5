"""Files → text."""

import pytest

from fcl_sim import fcl
from fcl_sim.diagnostics import InputFault
from fcl_sim.fcl.reading import LONGEST_TEXT
from tests.fcl.texts import BATH, block


def write(folder, content, name="bath.fcl"):
    file = folder / name
    file.write_bytes(content)
    return file


def refusal(path):
    with pytest.raises(InputFault) as caught:
        fcl.read_file(path)
    (diagnostic,) = caught.value.diagnostics
    assert diagnostic.places[0].file == str(path)
    return diagnostic.message, diagnostic.hint


@pytest.mark.parametrize(
    "content",
    [
        BATH.encode(),
        b"\xef\xbb\xbf" + BATH.encode(),
        BATH.replace("\n", "\r\n").encode(),
        BATH.replace("\n", "\r").encode(),
        BATH.encode() + b"\x1a",
        BATH.encode() + b"\r\n\x1a\x1a",
        ("(* größer als 20 °C *)" + BATH).encode(),
    ],
    ids=["plain", "mark", "windows", "classic", "dos", "dos padded", "comment"],
)
def test_a_text_is_read_whatever_its_line_ends_and_marks(tmp_path, content):  # S15b
    reading = fcl.read_file(write(tmp_path, content))
    assert reading.diagnostics == ()
    assert reading.blocks == (block(BATH),)


@pytest.mark.parametrize(("encoding", "named"), [("cp1252", "Windows-1252"), ("utf-16", "UTF-16")])
def test_a_file_in_another_encoding_is_read_with_a_warning(tmp_path, encoding, named):  # S15b
    text = "(* a\n über 20 °C *)" + BATH
    file = write(tmp_path, text.encode(encoding))
    reading = fcl.read_file(file)
    assert reading.blocks == (block(BATH),)
    (warning,) = reading.diagnostics
    assert warning.message == f"this file is not UTF-8: it is read as {named}"
    span = warning.places[0].span
    assert (span.source.name, span.line, span.column) == (str(file), 2, 2)
    assert span.text == "ü"


@pytest.mark.parametrize("end", ["\n", "\r\n", "\r"])
def test_places_are_the_same_for_every_line_end(tmp_path, end):
    file = write(tmp_path, BATH.replace("inlet;", "intel;").replace("\n", end).encode())
    (diagnostic,) = fcl.read_file(file).diagnostics
    assert (diagnostic.places[0].span.line, diagnostic.places[0].span.column) == (26, 60)


def test_a_missing_file_is_refused_with_the_one_that_is_like_it(tmp_path):
    write(tmp_path, b"", "crane.fcl")
    assert refusal(tmp_path / "crnae.fcl") == (
        "there is no such file",
        f"did you mean `{tmp_path / 'crane.fcl'}`?",
    )
    assert refusal(tmp_path / "oven.fcl") == ("there is no such file", "")
    assert refusal(tmp_path / "nowhere" / "oven.fcl") == ("there is no such file", "")


def test_a_folder_is_refused_with_what_it_holds(tmp_path):
    write(tmp_path, b"", "b.fcl")
    write(tmp_path, b"", "a.fcl")
    assert refusal(tmp_path) == ("this is a folder, not a file", "it holds a.fcl or b.fcl")


def test_a_name_that_no_system_accepts_is_refused():
    message, _ = refusal("a\0b.fcl")
    assert message.startswith("this is not the name of a file")
    message, _ = refusal("x" * 5000 + ".fcl")
    assert message.startswith("this file cannot be read")


def test_a_file_that_may_not_be_read_is_refused(tmp_path, monkeypatch):
    file = write(tmp_path, b"")

    def refuse(*arguments, **more):
        raise PermissionError(13, "Permission denied")

    monkeypatch.setattr(type(file), "open", refuse)
    assert refusal(file) == ("this file cannot be read: Permission denied", "")


@pytest.mark.parametrize(
    "content", [bytes(range(256)) * 8, b"\x7fELF\x02\x01\x01" + bytes(50), BATH.encode("utf-16-le")]
)
def test_a_file_that_is_no_text_is_refused(tmp_path, content):
    assert refusal(write(tmp_path, content)) == ("this file is not a text", "FCL is plain text in UTF-8")


def test_one_nul_byte_does_not_make_a_text_something_else(tmp_path):
    (diagnostic,) = fcl.read_file(write(tmp_path, BATH.replace("IF ", "IF \0", 1).encode())).diagnostics
    assert diagnostic.code == "FCL112"


def test_a_file_beyond_all_measure_is_refused_without_being_read(tmp_path):
    file = write(tmp_path, b"")
    with file.open("r+b") as open_file:
        open_file.truncate(100 * LONGEST_TEXT)
    assert refusal(file)[0] == "this file is too large for a rule base: 8 MiB are read at most"


def test_an_empty_file_has_no_function_block(tmp_path):
    (diagnostic,) = fcl.read_file(write(tmp_path, b"")).diagnostics
    assert diagnostic.code == "FCL205"


def test_the_text_of_a_file_can_be_had_for_the_stages(tmp_path):
    source = fcl.open_source(write(tmp_path, b"\xef\xbb\xbf" + BATH.encode()))
    assert source.text == BATH
