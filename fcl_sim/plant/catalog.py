"""Find a plant by name: in the bench, among entry points, among the shipped plants."""

import hashlib
import importlib.metadata
import sys
from collections.abc import Callable, Iterable
from dataclasses import dataclass
from functools import lru_cache
from importlib.util import module_from_spec, spec_from_file_location
from pathlib import Path
from types import ModuleType
from typing import Any

from fcl_sim.diagnostics import InputFault, nearest
from fcl_sim.diagnostics.spelling import listed
from fcl_sim.plant.contract import check_functions, fault_in
from fcl_sim.plant.declaration import Plant
from fcl_sim.plant.declared import check_declaration
from fcl_sim.plant.functions import DEFAULTS, PARTS, REQUIRED, PlantFunctions, as_entry

GROUP = "fcl_sim.plants"


@dataclass(frozen=True, slots=True, kw_only=True)
class PlantModel:
    """A plant that keeps the contract: its declaration, file, the file's digest, its functions.

    `samples` says whether it does something at each scan. `constants` stand
    before its parameters in p. `delay` is None, or else the plant is linear,
    x' = M x, its inputs are its last states, and what is written arrives there
    so many nanoseconds later (`plant.linear`).
    """

    declaration: Plant
    path: Path
    digest: str
    functions: PlantFunctions
    samples: bool
    constants: tuple[float, ...] = ()
    delay: int | None = None


def shipped_bench() -> Path:
    """Return the folder that holds the shipped `plants/` and `scenarios/`."""
    package = Path(__file__).parent.parent
    inside = package / "bench"
    return inside if inside.is_dir() else package.parent


def find(name: str, bench: Path | None = None, others: Iterable[str] = ()) -> PlantModel:
    """Return the plant called `name`.

    Looked up as `plants/NAME.py` of `bench`, then among the entry points of the
    group `fcl_sim.plants`, then among the shipped plants. InputFault when there
    is none or when it breaks the contract; it knows of `others`, that have no file.
    """
    folders = [folder / "plants" for folder in (bench, shipped_bench()) if folder is not None]
    if bench is not None and (folders[0] / f"{name}.py").is_file():
        return load(folders[0] / f"{name}.py")
    for point in importlib.metadata.entry_points(group=GROUP, name=name):
        return load(_file_of(point))
    if (folders[-1] / f"{name}.py").is_file():
        return load(folders[-1] / f"{name}.py")
    known = {file.stem for folder in folders for file in folder.glob("[!_]*.py")}
    known |= {point.name for point in importlib.metadata.entry_points(group=GROUP)} | {*others}
    near = nearest(name, known)
    hint = f"did you mean `{near}`?" if near else f"there are {listed(sorted(known))}"
    raise InputFault.at_file("PLT101", "", f"there is no plant called `{name}`", hint)


def _file_of(point: importlib.metadata.EntryPoint) -> Path:
    spec = importlib.util.find_spec(point.module)
    if spec is None or spec.origin is None:
        raise InputFault.at_file(
            "PLT102",
            point.module,
            f"the entry point `{point.name}` of {GROUP} names a module that is not there",
        )
    return Path(spec.origin)


def load(path: Path) -> PlantModel:
    """Return the plant of the file `path`; InputFault when it breaks the contract.

    Loading runs the file's code, as it must to be a plant.
    """
    try:
        text = path.read_bytes()
    except OSError as error:
        raise InputFault.at_file(
            "PLT102", str(path), f"the plant cannot be read: {error.strerror}"
        ) from error
    return _model(path, hashlib.sha256(text).hexdigest())


@lru_cache(maxsize=64)
def _model(path: Path, digest: str) -> PlantModel:
    """Return the plant of a file with that content; all that runs it share one, and its machine code."""
    module = _import(path, digest)
    plant = check_declaration(module, path)
    given: dict[str, Callable[..., Any]] = {
        part: getattr(module, part) for part in PARTS if hasattr(module, part)
    }
    check_functions(plant, given, path)
    missing = {part: DEFAULTS[part] for part in PARTS if part not in given and part not in REQUIRED}
    entries = {part: as_entry(part, function, digest) for part, function in given.items()}
    entries |= {part: as_entry(part, function, "") for part, function in missing.items()}
    return PlantModel(
        declaration=plant,
        path=path,
        digest=digest,
        functions=PlantFunctions(**entries, path=path),
        samples="sample" in given,
    )


def _import(path: Path, digest: str) -> ModuleType:
    # Machine code is cached with the name of its module, so the module must be findable by it.
    name = f"fcl_sim_plant_{path.stem}_{digest[:16]}"
    if name in sys.modules:
        return sys.modules[name]
    spec = spec_from_file_location(name, path)
    assert spec is not None  # noqa: S101  a path that ends in .py always has one
    assert spec.loader is not None  # noqa: S101
    module = module_from_spec(spec)
    sys.modules[name] = module
    try:
        spec.loader.exec_module(module)
    except Exception as error:
        del sys.modules[name]
        raise fault_in(path, error, "the plant's file cannot be run") from error
    return module
