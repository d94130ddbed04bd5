"""Where compiled kernels are kept: a folder for each state of the sources that they come from."""

import hashlib
import os
import shutil
import sys
from functools import cache
from pathlib import Path

KERNEL_ROOMS = ("jit", "arithmetic", "engine", "concept", "plant", "loop")
"""What a compiled kernel can come from, relative to the package; the digest covers all of it."""

KEPT_FOLDERS = 24
"""Folders of the cache, one for each plant and one for all else, of which the last used are kept."""


def cache_folder(salt: str = "") -> Path | None:
    """Return the writable folder of today's kernels, or None when none can be written.

    Under `FCL_SIM_CACHE_DIR`, else the user's cache folder; named by a digest
    of the kernel sources and `salt`. Old folders are removed when a new one is
    made.
    """
    home = _cache_home()
    folder = home / hashlib.sha256(f"{_sources_digest()} {salt}".encode()).hexdigest()[:24]
    try:
        if not folder.is_dir():
            folder.mkdir(parents=True, exist_ok=True)
            _forget_old(home)
        os.utime(folder)  # a folder in use is not an old one, however many plants come and go
        return folder if os.access(folder, os.W_OK) else None
    except OSError:
        return None


def _cache_home() -> Path:
    chosen = os.environ.get("FCL_SIM_CACHE_DIR")
    if chosen:
        return Path(chosen)
    if sys.platform == "win32":
        base = os.environ.get("LOCALAPPDATA") or "~/AppData/Local"
    else:
        base = os.environ.get("XDG_CACHE_HOME") or "~/.cache"
    try:
        return Path(base).expanduser() / "fcl_sim" / "kernels"
    except RuntimeError:  # a user without a home folder
        return Path(os.devnull) / "fcl_sim"


def _forget_old(home: Path) -> None:
    folders = sorted(home.iterdir(), key=lambda each: each.stat().st_mtime, reverse=True)
    for folder in folders[KEPT_FOLDERS:]:
        shutil.rmtree(folder, ignore_errors=True)


@cache
def _sources_digest() -> str:
    package = Path(__file__).parent
    digest = hashlib.sha256()
    for file in (file for room in KERNEL_ROOMS for file in sorted((package / room).rglob("*.py"))):
        digest.update(file.relative_to(package).as_posix().encode())
        digest.update(file.read_bytes())
    return digest.hexdigest()
