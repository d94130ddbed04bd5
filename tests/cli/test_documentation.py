import re

from fcl_sim.cli.doors import Exit
from fcl_sim.cli.program import COMMANDS, program
from tests.house.places import ROOT

PAGE = (ROOT / "docs" / "command-line.md").read_text("utf-8")


def test_the_page_names_every_command_and_no_other():
    assert re.findall(r"^\| `fcl-sim (\w+)", PAGE, re.MULTILINE) == list(COMMANDS)


def test_the_page_names_every_exit_code_and_no_other():
    assert re.findall(r"^\| (\d+) \|", PAGE, re.MULTILINE) == [str(int(code)) for code in Exit]


def options_of(*names):
    return {
        each
        for name in names
        for parameter in program.get_command(None, name).params
        for each in parameter.opts
    }


def test_what_the_page_on_build_servers_calls_is_there():
    page = (ROOT / "docs" / "ci.md").read_text("utf-8")
    called = re.findall(r"fcl-sim (run|check|schema) ([^`\n]*)", page)
    assert {name for name, _ in called} == {"run", "check", "schema"}
    for name, rest in called:
        assert set(re.findall(r"--[\w-]+", rest)) <= options_of(name)
    assert set(re.findall(r"^\| `(--\w+)`", page, re.MULTILINE)) <= options_of("run")
    codes = {int(each) for each in re.findall(r"^\| (\d+) \|", page, re.MULTILINE)}
    assert codes == {0, 1, 3, 4}
    assert codes <= {int(each) for each in Exit}


def test_the_short_help_of_a_command_begins_its_long_help():
    for name, short in COMMANDS.items():
        command = program.get_command(None, name)
        assert command.help.partition("\n")[0] == short


def test_every_option_that_the_page_shows_is_there():
    commands = [program.get_command(None, name) for name in COMMANDS]
    commands += [each for group in commands for each in getattr(group, "commands", {}).values()]
    options = {option for command in commands for each in command.params for option in each.opts}
    assert set(re.findall(r"`(--[\w-]+)", PAGE)) - {"--help"} <= options
