"""Slips in the crane's files: name, file, edit, and the whole message that a user reads."""

CONTROLLER = "crane.controller.toml"
TRANSFER = "transfer.toml"

RELATIVE = """
[[require]]
id          = "CR-9"
text        = "It settles about as fast as with the usual load."
metric      = { settling_time = { signal = "crane.distance", final = "0 m", band = "0.5 m" } }
max         = 1.2
relative_to = { variant = "light_load", as = "ratio" }
"""
"""A requirement that is relative to another run."""

SLIPS = [
    (
        "a key that nobody reads",
        TRANSFER,
        ("duration ", "duraton "),
        """\
scenarios/crane/transfer.toml:14:1: error[SCN201]: the scenario has no key `duraton`
  14 | duraton   = "60 s"
     | ^^^^^^^
  hint: did you mean `duration`?""",
    ),
    (
        "a time without a unit",
        TRANSFER,
        ('"60 s"', "60"),
        """\
scenarios/crane/transfer.toml:14:14: error[SCN204]: `duration` is a time and needs a unit, not 60 alone
  14 | duration   = 60
     |              ^^
  hint: write "60 s\"""",
    ),
    (
        "a quantity without quotes",
        TRANSFER,
        ('"60 s"', "60 s"),
        """\
scenarios/crane/transfer.toml:14:17: error[SCN102]: not TOML: something stands behind the value \
that does not belong there
  14 | duration   = 60 s
     |                 ^
  hint: write quantities in quotes: "60 s\"""",
    ),
    (
        "a bare number for a parameter with a unit",
        TRANSFER,
        ('"20 t"', "20"),
        """\
scenarios/crane/transfer.toml:19:28: error[SCN404]: `load_mass` is in kg, and this has no unit
  19 | parameters = { load_mass = 20, cable_length = "10 m" }
     |                            ^^
  hint: write "20 kg\"""",
    ),
    (
        "a parameter in a wrong unit",
        TRANSFER,
        ('"20 t"', '"20 m"'),
        """\
scenarios/crane/transfer.toml:19:28: error[SCN404]: `load_mass` is in kg, and this is in m
  19 | parameters = { load_mass = "20 m", cable_length = "10 m" }
     |                            ^^^^^^
  hint: write it in kg, or in a unit that converts to it""",
    ),
    (
        "a parameter out of its range",
        TRANSFER,
        ('"20 t"', '"-20 t"'),
        """\
scenarios/crane/transfer.toml:19:28: error[SCN310]: `load_mass` cannot be -20 t
  19 | parameters = { load_mass = "-20 t", cable_length = "10 m" }
     |                            ^^^^^^^
  hint: it must be at least 0 kg: m: container and spreader""",
    ),
    (
        "a parameter that the plant does not have",
        TRANSFER,
        ("load_mass", "laod_mass"),
        """\
scenarios/crane/transfer.toml:19:16: error[SCN309]: the plant `crane` has no parameter called `laod_mass`
  19 | parameters = { laod_mass = "20 t", cable_length = "10 m" }
     |                ^^^^^^^^^
  hint: did you mean `load_mass`?""",
    ),
    (
        "a missing file",
        TRANSFER,
        ('"crane.controller.toml"', '"crane.controler.toml"'),
        """\
scenarios/crane/transfer.toml:15:23: error[SCN101]: there is no file `scenarios/crane/crane.controler.toml`
  15 | controller = { file = "crane.controler.toml", inputs = { distance = "crane.distance", angle = "crane…
     |                       ^^^^^^^^^^^^^^^^^^^^^^
  hint: did you mean `crane.controller.toml`?""",
    ),
    (
        "a missing rule base",
        CONTROLLER,
        ("crane_completed.fcl", "crane_complete.fcl"),
        """\
scenarios/crane/crane.controller.toml:19:10: error[SCN101]: \
there is no file `scenarios/crane/crane_complete.fcl`
  19 | file   = "crane_complete.fcl"
     |          ^^^^^^^^^^^^^^^^^^^^
  hint: did you mean `crane_completed.fcl`?""",
    ),
    (
        "an unknown plant",
        TRANSFER,
        ('"crane"', '"crain"'),
        """\
scenarios/crane/transfer.toml:18:14: error[PLT101]: there is no plant called `crain`
  18 | model      = "crain"
     |              ^^^^^^^
  hint: did you mean `crane`?""",
    ),
    (
        "a requirement on an unknown signal",
        TRANSFER,
        ('signal = "crane.distance"', 'signal = "crane.distanse"'),
        """\
scenarios/crane/transfer.toml:48:39: error[SCN403]: there is no signal called `crane.distanse`
  48 | metric = { settling_time = { signal = "crane.distanse", final = "0 m", band = "0.5 m" } }
     |                                       ^^^^^^^^^^^^^^^^
  hint: did you mean `crane.distance`?""",
    ),
    (
        "an argument in a wrong unit",
        TRANSFER,
        ('band = "0.5 m"', 'band = "0.5 deg"'),
        """\
scenarios/crane/transfer.toml:48:79: error[SCN404]: `band` of `settling_time` is in m, and this is in deg
  48 | metric = { settling_time = { signal = "crane.distance", final = "0 m", band = "0.5 deg" } }
     |                                                                               ^^^^^^^^^
  hint: write it in m, or in a unit that converts to it""",
    ),
    (
        "a bound without a unit",
        TRANSFER,
        ('max    = "35 s"', "max    = 35"),
        """\
scenarios/crane/transfer.toml:49:10: error[SCN404]: \
a settling time of `crane.distance` is in s, and this has no unit
  49 | max    = 35
     |          ^^
  hint: write "35 s\"""",
    ),
    (
        "a requirement without a bound",
        TRANSFER,
        ('max    = "35 s"\n', ""),
        """\
scenarios/crane/transfer.toml:45:3: error[SCN406]: the requirement bounds nothing
  45 | [[require]]
     |   ^^^^^^^
  hint: give `min` or `max` or both, as in max = "35 s\"""",
    ),
    (
        "an unknown metric",
        TRANSFER,
        ("settling_time =", "setling_time ="),
        """\
scenarios/crane/transfer.toml:48:12: error[SCN401]: there is no metric called `setling_time`
  48 | metric = { setling_time = { signal = "crane.distance", final = "0 m", band = "0.5 m" } }
     |            ^^^^^^^^^^^^
  hint: did you mean `settling_time`?""",
    ),
    (
        "an unknown argument, which is the missing one",
        TRANSFER,
        ('final = "0 m"', 'finale = "0 m"'),
        """\
scenarios/crane/transfer.toml:48:57: error[SCN402]: `settling_time` has no argument `finale`
  48 | metric = { settling_time = { signal = "crane.distance", finale = "0 m", band = "0.5 m" } }
     |                                                         ^^^^^^
  hint: did you mean `final`?""",
    ),
    (
        "an unknown variant in an expectation",
        TRANSFER,
        ('{ raw_distance = "fail" }', '{ raw_distence = "fail" }'),
        """\
scenarios/crane/transfer.toml:50:12: error[SCN405]: there is no variant called `raw_distence`
  50 | expect = { raw_distence = "fail" }
     |            ^^^^^^^^^^^^
  hint: did you mean `raw_distance`?""",
    ),
    (
        "an expectation of something else than a miss",
        TRANSFER,
        ('expect = { raw_distance = "fail" }', 'expect = "pass"'),
        """\
scenarios/crane/transfer.toml:50:10: error[SCN203]: `expect` can only be `fail`, not `pass`
  50 | expect = "pass"
     |          ^^^^^^
  hint: write expect = "fail", or name the runs: expect = { base = "fail" }""",
    ),
    (
        "two requirements with one id",
        TRANSFER,
        ('"CR-2"', '"CR-1"'),
        """\
scenarios/crane/transfer.toml:53:10: error[SCN407]: two requirements are called `CR-1`
  53 | id     = "CR-1"
     |          ^^^^^^
  scenarios/crane/transfer.toml:46:10: the first of them
  46 | id     = "CR-1"
     |          ^^^^^^""",
    ),
    (
        "a variant of a block that is not there",
        TRANSFER,
        ("controller.blocks.rules.inputs", "controller.blocks.rule.inputs"),
        """\
scenarios/crane/transfer.toml:25:1: error[SCN301]: the controller has no block `rule` to change
  25 | "controller.blocks.rule.inputs.distance" = "distance"
     | ^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^
  hint: did you mean `rules`?""",
    ),
    (
        "a variant of a key of the controller that is not there",
        TRANSFER,
        ("controller.scan", "controller.scann"),
        """\
scenarios/crane/transfer.toml:43:1: error[SCN201]: `controller` has no key `scann`
  43 | "controller.scann" = "100 ms"
     | ^^^^^^^^^^^^^^^^^^
  hint: did you mean `scan`?""",
    ),
    (
        "a variant that changes the requirements",
        TRANSFER,
        ("[variants.light_load]", "[variants.light_load]\nrequire = []"),
        """\
scenarios/crane/transfer.toml:32:1: error[SCN301]: the variant `light_load` cannot change `require`
  32 | require = []
     | ^^^^^^^
  hint: a requirement names the runs it is asked of, runs = ["NAME"], and those that miss it, \
expect = { NAME = "fail" }""",
    ),
    (
        "one value under two writings of its key",
        TRANSFER,
        (
            '"plant.parameters.load_mass" = "10 t"',
            '"plant.start.rate" = "0 rad/s"\nplant.start.rate = "1 rad/s"',
        ),
        """\
scenarios/crane/transfer.toml:34:13: error[SCN103]: `rate` is given twice
  34 | plant.start.rate = "1 rad/s"
     |             ^^^^
  scenarios/crane/transfer.toml:33:1: given here first
  33 | "plant.start.rate" = "0 rad/s"
     | ^^^^^^^^^^^^^^^^^^""",
    ),
    (
        "a key of a later version",
        TRANSFER,
        ("[plant]", 'extend = "other.toml"\n[plant]'),
        """\
scenarios/crane/transfer.toml:17:1: error[SCN205]: `extend` is not read by this version
  17 | extend = "other.toml"
     | ^^^^^^
  hint: write what differs as a variant: [variants.NAME]""",
    ),
    (
        "a scan time beside the controller's",
        TRANSFER,
        ("duration ", 'scan = "20 ms"\nduration '),
        """\
scenarios/crane/transfer.toml:14:1: error[SCN303]: the scan time belongs to the controller
  14 | scan = "20 ms"
     | ^^^^
  hint: to run it at another scan time, write controller.scan""",
    ),
    (
        "a latency beyond the scan time",
        TRANSFER,
        ("[plant]", '[timing]\nlatency = "60 ms"\n[plant]'),
        """\
scenarios/crane/transfer.toml:18:11: error[WIR401]: the latency must lie between 0 and the scan time, 0.05 s
  18 | latency = "60 ms"
     |           ^^^^^^^
  also at scenarios/crane/crane.controller.toml:4:9""",
    ),
    (
        "a duration that is not a whole number of scans",
        CONTROLLER,
        ('"50 ms"', '"70 ms"'),
        """\
scenarios/crane/transfer.toml:14:14: error[WIR401]: \
the duration of 60 s is not a whole number of scans of 0.07 s
  14 | duration   = "60 s"
     |              ^^^^^^
  also at scenarios/crane/crane.controller.toml:4:9
  hint: a run ends with a scan; 59.99 s would do""",
    ),
    (
        "an unknown signal within the controller",
        CONTROLLER,
        ('distance = "predicted"', 'distance = "predikted"'),
        """\
scenarios/crane/crane.controller.toml:21:23: error[SCN306]: the controller has no signal called `predikted`
  21 | inputs = { distance = "predikted", angle = "angle" }
     |                       ^^^^^^^^^^^
  hint: did you mean `predicted`?""",
    ),
    (
        "a controller that looks into the plant",
        CONTROLLER,
        ('distance = "predicted"', 'distance = "crane.distance"'),
        """\
scenarios/crane/crane.controller.toml:21:23: error[SCN306]: \
the controller has no signal called `crane.distance`
  21 | inputs = { distance = "crane.distance", angle = "angle" }
     |                       ^^^^^^^^^^^^^^^^
  hint: a controller sees its own inputs and blocks: speed, predicted, rules, distance or angle""",
    ),
    (
        "an unknown kind of block",
        CONTROLLER,
        ('"differentiator"', '"differentiater"'),
        """\
scenarios/crane/crane.controller.toml:14:22: error[SCN302]: there is no kind of block called `differentiater`
  14 | speed     = { type = "differentiater", input = "-distance", filter = "0.05 s" }
     |                      ^^^^^^^^^^^^^^^^
  hint: did you mean `differentiator`?""",
    ),
    (
        "an unknown parameter of a block",
        CONTROLLER,
        ("filter =", "filtre ="),
        """\
scenarios/crane/crane.controller.toml:14:61: error[SCN201]: `speed` has no key `filtre`
  14 | speed     = { type = "differentiator", input = "-distance", filtre = "0.05 s" }
     |                                                             ^^^^^^
  hint: did you mean `filter`?""",
    ),
    (
        "a parameter of a block in a wrong unit",
        CONTROLLER,
        ('"0.05 s"', "0.05"),
        """\
scenarios/crane/crane.controller.toml:14:70: error[SCN404]: `filter` is in s, and this has no unit
  14 | speed     = { type = "differentiator", input = "-distance", filter = 0.05 }
     |                                                                      ^^^^
  hint: write "0.05 s\"""",
    ),
    (
        "two things of a controller with one name",
        CONTROLLER,
        ("predicted = { type", "angle = { type"),
        """\
scenarios/crane/crane.controller.toml:15:1: error[SCN307]: two things of the controller are called `angle`
  15 | angle = { type = "sum", terms = { distance = 1.0, speed = "-6 s" } } # where the head will be in 6 s
     | ^^^^^
  scenarios/crane/crane.controller.toml:8:1: the other one
  8 | angle    = "deg" # of the container, positive ahead of the head
    | ^^^^^
  hint: inputs, blocks and outputs need names of their own""",
    ),
    (
        "an input whose signal has another unit",
        CONTROLLER,
        ('distance = "m" ', 'distance = "km"'),
        """\
scenarios/crane/transfer.toml:15:70: error[SCN308]: \
the controller's input `distance` is in km, and `crane.distance` is in m
  15 | … { file = "crane.controller.toml", inputs = { distance = "crane.distance", angle = "crane.angle" } }
     |                                                           ^^^^^^^^^^^^^^^^
  scenarios/crane/crane.controller.toml:7:12: its unit is declared here
  7 | distance = "km"  # from the crane head to the target, positive before it
    |            ^^^^""",
    ),
    (
        "inputs of a controller and their wires that do not match",
        CONTROLLER,
        ('angle    = "deg"', 'winkel   = "deg"'),
        """\
scenarios/crane/transfer.toml:15:1: error[SCN305]: the controller's input `winkel` is not connected
  15 | controller = { file = "crane.controller.toml", inputs = { distance = "crane.distance", angle = "cran…
     | ^^^^^^^^^^
  hint: say what it reads, a signal in deg: inputs = { winkel = "..." }
scenarios/crane/transfer.toml:15:88: error[SCN304]: the controller has no input `angle`
  15 | … { file = "crane.controller.toml", inputs = { distance = "crane.distance", angle = "crane.angle" } }
     |                                                                             ^^^^^
  hint: it has distance or winkel""",
    ),
]
