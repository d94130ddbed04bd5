"""Conformance as a JSON document, for other programs."""

from collections.abc import Iterable
from typing import Any

from fcl_sim.fcl.conformance_engine import data_check_list
from fcl_sim.fcl.conformance_features import features, level
from fcl_sim.fcl.conformance_figures import FIGURES, data_types, line_comments
from fcl_sim.fcl.conformance_tables import TABLES
from fcl_sim.fcl.conformance_text import lines_of
from fcl_sim.model import FunctionBlock

SCHEMA = 1


def tables_document() -> dict[str, Any]:
    """Return our own Tables 8 to 11 for `json.dumps`."""
    return {
        "schema": SCHEMA,
        "tables": {
            str(number): [
                {
                    "element": row.element,
                    "keyword": row.keyword,
                    "details": row.details,
                    "statement": row.ours,
                }
                for row in rows
            ]
            for number, rows in TABLES.items()
        }
        | {"11": [{"data": title, "statement": words} for title, words in data_check_list()]},
    }


def blocks_document(file: str, blocks: Iterable[FunctionBlock]) -> dict[str, Any]:
    """Return what each function block of a file needs, for `json.dumps`."""
    return {"schema": SCHEMA, "file": file, "blocks": [_block(each) for each in blocks]}


def _block(block: FunctionBlock) -> dict[str, Any]:
    return {
        "name": block.name,
        "level": str(level(block)),
        "features": [
            {
                "level": str(each.row.level),
                "table": each.row.table,
                "element": each.row.element,
                "keyword": each.row.keyword,
                "feature": each.words,
                "lines": lines_of(each.places),
            }
            for each in features(block)
        ],
        "data": {
            "data_types": list(data_types(block)),
            "line_comments": len(line_comments(block)),
            **{key: figure.most(block).number for key, figure in FIGURES.items()},
        },
    }
