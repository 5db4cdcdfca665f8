"""All hard cases, by name."""

from . import blasts, edges, fields, flows, jumps, schemes, starts

CASES = {case.name: case for part in (fields, blasts, flows, starts, jumps, edges, schemes) for case in part.CASES}
