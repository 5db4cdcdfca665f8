"""Wishes that wait: in order, few, merged only where both together say the same."""

import pytest

from taichi_spmhd.live.desk import Desk
from taichi_spmhd.live.wishes import MOST, MOST_PUSHES, Full, Wishes


def slid(value: float, name: str = "xi") -> dict:
    return {"do": "number", "panel": 0, "part": "DivBSource", "name": name, "value": value}


def push() -> dict:
    return {"do": "poke", "panel": 0, "kind": "push", "x": 0.5, "y": 0.5, "dx": 0.1, "dy": 0.0, "radius": 0.1}


def queued(*wishes: dict) -> list[dict]:
    """What the main thread takes after these."""
    queue = Wishes()
    for wish in wishes:
        queue.put(wish)
    return [{key: value for key, value in wish.items() if key != "at"} for wish in queue.take()]


def test_a_dragged_slider_leaves_one_wish_with_the_last_value():
    taken = queued(slid(0.1), slid(0.2), slid(0.7, "alpha"), slid(0.3), {"do": "pause"})
    assert [(wish["do"], wish.get("value")) for wish in taken] == [("number", 0.7), ("number", 0.3), ("pause", None)]


def test_numbers_rise_along_the_queue():
    # who reads applied = 4 believes that 2 was granted, too
    taken = queued(slid(0.1), slid(0.7, "alpha"), {"do": "draw", "log": True}, slid(0.2), {"do": "pause"})
    assert [wish["id"] for wish in taken] == [2, 3, 4, 5]


def test_nothing_is_merged_across_other_wishes():
    taken = queued(slid(0.0), {"do": "step"}, slid(1.0))
    assert [wish.get("value") for wish in taken] == [0.0, None, 1.0]
    taken = queued(slid(0.0), {"do": "choose", "variant": "xi = 1"}, slid(0.5))
    assert [wish.get("value") for wish in taken] == [0.0, None, 0.5]


def test_drawings_merge_to_what_both_would_have_drawn():
    both = queued(
        {"do": "draw", "member": "B", "axis": 2, "limits": [0, 1], "lines": True}, {"do": "draw", "draw": "sph"}
    )
    assert both == [{"do": "draw", "member": "B", "axis": 2, "limits": [0, 1], "lines": True, "draw": "sph", "id": 2}]
    # rho has no axis 2: another member sets axis and limits back, as it does when granted alone
    (both,) = queued({"do": "draw", "member": "B", "axis": 2, "limits": [0, 1]}, {"do": "draw", "member": "rho"})
    assert both == {"do": "draw", "member": "rho", "id": 2}


def test_the_queue_is_bounded():
    queue = Wishes()
    for _ in range(MOST):
        queue.put({"do": "step"})
    with pytest.raises(Full):
        queue.put({"do": "step"})
    assert len(queue.take()) == MOST and queue.put({"do": "step"}) == MOST + 1


def test_a_pointer_dragged_for_long_leaves_room_for_pause():
    queue = Wishes()
    for _ in range(MOST_PUSHES):
        queue.put(push())
    with pytest.raises(Full):
        queue.put(push())
    queue.put({"do": "pause"})
    assert [wish["do"] for wish in queue.take()][-2:] == ["poke", "pause"]


def test_a_wish_wakes_the_main_thread():
    desk = Desk()
    desk.put({"do": "play"})
    desk.wait(60.0)  # returns at once, or the test's own limit ends it
    (wish,) = desk.take()
    assert wish["do"] == "play" and wish["id"] == 1
