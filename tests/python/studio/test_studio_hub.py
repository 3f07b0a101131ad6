"""Viewers, each with its own queue."""

import asyncio
import json
import struct
from collections import deque

import numpy as np
from punctura.studio import hub as hubs
from punctura.studio.hub import Hub, Viewer
from punctura.studio.wire.frames import split
from punctura.studio.wire.messages import (
    ExerciseStatus,
    Hello,
    LimitsPart,
    MembraneEvent,
    Notice,
    RecordingStatus,
    SceneMessage,
)
from punctura.studio.wire.messages import Status as Health

FRAME = b"PNT2" + bytes(999_996)
MOST = hubs.MOST_TICK_BYTES // len(FRAME)  # such frames that wait


def hello(viewer):
    device = {"backend": "", "model": "", "simulated": True, "has_orientation": True, "max_force": 3.3, "rate": 1.0}
    told = {
        "protocol": 1,
        "version": "",
        "viewer": viewer,
        "device": device,
        "second_device": "",
        "scenes": [],
        "exercises": [],
        "figures": False,
    }
    limits = dict.fromkeys(LimitsPart.model_fields, 1.0) | {"dead_man_buttons": []}
    return Hello.model_validate(told | {"limits": limits})


def run(test):
    """A viewer on its own event loop, where `post` runs at once."""

    async def on_loop():
        hub = Hub()
        hub.attach(asyncio.get_running_loop())
        hub.post = lambda call: call()
        await test(hub)

    asyncio.run(on_loop())


async def all_of(viewer):
    return [await viewer.take() for _ in range(viewer.waiting)]


def test_a_stalled_viewer_loses_its_own_frames_and_nobody_else_s():
    async def test(hub):
        stalled, quick = hub.join(hello), hub.join(hello)
        await all_of(quick)
        got = 0
        for _ in range(1000):
            hub.frame(FRAME)
            got += sum(data == FRAME for data in await all_of(quick))
        assert (got, quick.dropped) == (1000, 0)
        waits = [d for d in await all_of(stalled) if d == FRAME]
        assert stalled.dropped + len(waits) == 1000 and len(waits) <= MOST

    run(test)


def test_frames_are_lost_in_one_go_and_messages_never():
    async def test(hub):
        viewer = hub.join(hello)
        await all_of(viewer)
        hub.send(Notice(text="before"))
        for i in range(MOST + 1):
            hub.frame(struct.pack("<I", i) + FRAME[4:])
        hub.send(Notice(text="after"))
        data = await all_of(viewer)
        assert [d for d in data if isinstance(d, bytes)] == [struct.pack("<I", MOST) + FRAME[4:]]
        assert ["before" in data[0], "after" in data[-1]] == [True, True]
        assert viewer.dropped == MOST

    run(test)


def test_a_viewer_that_reads_no_message_either_has_to_go():
    async def test(hub):
        viewer = hub.join(hello)
        for _ in range(hubs.MOST_MESSAGES // 1000):
            hub.send(Notice(text="x" * 1000))
        assert viewer.closed and viewer.waiting == 0
        assert await viewer.take() is None

    run(test)


def test_a_stalled_viewer_is_told_the_last_of_what_is_told_again_and_again():
    async def test(hub):
        viewer = hub.join(hello)
        await all_of(viewer)
        for rows in range(1000):
            hub.send(RecordingStatus(name="r", rows=rows, lost=0, seconds=0.0, trouble=""))
            hub.frame(FRAME)
        assert viewer._bytes < 200 and len(viewer._queue) < 3 * MOST
        (last,) = [d for d in await all_of(viewer) if isinstance(d, str)]
        assert '"rows":999' in last and viewer._bytes == 0
        hub.send(RecordingStatus(name="", rows=0, lost=0, seconds=0.0, trouble=""))
        assert len(await all_of(viewer)) == 1

    run(test)


def test_a_page_that_answers_gets_every_tick_soon_however_slowly_it_takes_messages():
    """60 frames a second come, and the page takes 4 messages a second; then it takes none for four seconds."""

    async def test(hub):
        viewer, got, on_way = hub.join(hello), [], deque()
        await all_of(viewer)
        viewer.took()
        for turn in range(1200):
            hub.frame(struct.pack("<I", turn))
            while viewer.ready:
                on_way.append(await viewer.take())
            assert len(on_way) <= hubs.MOST_ON_WAY
            if turn % 15 == 0 and not 600 <= turn < 840:
                got += frames_of(on_way.popleft())
                viewer.took()
                assert turn - got[-1] <= 2 * 15 or 840 <= turn < 960
        assert got == list(range(len(got))) and viewer.dropped == 0

    run(test)


def frames_of(message):
    """The numbers in the frames of a message."""
    return [struct.unpack("<I", frame)[0] for frame in split(message)]


def test_a_page_that_does_not_answer_any_more_has_to_go():
    async def test():
        now = 0.0
        viewer = Viewer(1, lambda: now)
        viewer.took()
        for _ in range(hubs.MOST_ON_WAY + 1):
            viewer.put(FRAME)
            if viewer.ready:
                await viewer.take()
        now = hubs.UNREAD_S / 2
        viewer.took()
        await viewer.take()
        now *= 2.9
        viewer.put(FRAME)
        assert not viewer.closed and not viewer.ready
        now = 1.5 * hubs.UNREAD_S
        viewer.put(FRAME)
        assert viewer.closed == hubs.UNREAD and await viewer.take() is None

    asyncio.run(test())


def test_a_message_with_several_frames_has_a_bound():
    async def test():
        viewer, frame = Viewer(1), bytes(hubs.MOST_JOINED // 4)
        viewer.took()
        for _ in range(10):
            viewer.put(frame)
        assert [len(split(await viewer.take())) for _ in range(hubs.MOST_ON_WAY)] == [4, 4]

    asyncio.run(test())


def test_a_message_with_ticks_ends_where_another_message_comes():
    async def test(hub):
        viewer = hub.join(hello)
        await all_of(viewer)
        viewer.took()
        for turn in range(4):
            hub.frame(struct.pack("<I", turn))
            if turn == 2:
                hub.send(Notice(text="between"))
        ticks, words = await viewer.take(), await viewer.take()
        assert frames_of(ticks) == [0, 1, 2] and "between" in words and frames_of(await viewer.take()) == [3]

    run(test)


def test_a_page_slower_than_frames_and_messages_is_told_of_an_exercise_each_second():
    """60 frames and 14 messages a second come, and the page takes 60 entries a second."""

    async def test(hub):
        viewer, got = hub.join(hello), []
        await all_of(viewer)
        for turn in range(1200):
            hub.frame(FRAME)
            if turn % 15 == 0:
                hub.send(RecordingStatus(name="r", rows=turn, lost=0, seconds=0.0, trouble=""))
            if turn % 6 == 0:
                hub.send(exercise(turn))
            told = await viewer.take()
            if isinstance(told, str) and '"exercise"' in told:
                got.append(json.loads(told)["time"])
        assert got == sorted(got)
        assert max(np.diff([0, *got, 1200])) <= 60  # what it gets is at most a second old

    run(test)


def test_a_message_waits_for_the_scene_that_it_belongs_to():
    async def test(hub):
        viewer = hub.join(hello)
        await all_of(viewer)
        for turn in range(3):
            hub.send(exercise(10 * turn))
            hub.send(exercise(10 * turn + 1))
            hub.send(SceneMessage.model_validate({"scene": VIEW, "new_run": True, "run": turn}))
        told = [json.loads(data) for data in await all_of(viewer)]
        assert [one.get("time", one.get("run")) for one in told] == [1, 0, 11, 1, 21, 2]

    run(test)


def exercise(time):
    return ExerciseStatus(exercise="e", running=True, instruction="", goals=[], result="", time=time)


def test_there_is_room_for_so_many_and_no_more():
    async def test(hub):
        viewers = [hub.join(hello) for _ in range(hubs.MOST_VIEWERS)]
        assert all(viewers) and hub.join(hello) is None
        hub.leave(viewers[3])
        assert hub.join(hello) is not None

    run(test)


def test_control_goes_to_the_first_and_when_its_holder_leaves_to_the_next_who_comes():
    async def test(hub):
        first, second = hub.join(hello), hub.join(hello)
        assert hub.holder == first.number
        hub.take_control(second)
        assert hub.holder == second.number
        hub.leave(second)
        assert hub.holder is None
        assert '"holder":null' in (await all_of(first))[-1]
        third = hub.join(hello)
        assert hub.holder == third.number

    run(test)


VIEW = {
    "number": 3, "name": "s", "diameter": 1e-3, "tip_length": 3e-3, "direction": "stylus", "solver": "exact",
    "rate": 1600.0, "force_scale": 1.0, "membranes": [], "laws": [], "tables": {}, "lumen": [],
}  # fmt: skip


def test_a_newcomer_is_told_the_scene_as_a_new_run():
    async def test(hub):
        hub.send(SceneMessage.model_validate({"scene": VIEW, "new_run": False, "run": 0}))
        viewer = hub.join(hello)
        (scene,) = [d for d in await all_of(viewer) if '"scene"' in d and '"kind":"scene"' in d]
        assert '"new_run":true' in scene

    run(test)


def test_a_newcomer_is_told_what_has_happened_in_this_run_and_nothing_of_the_one_before():
    def pop(tick):
        return MembraneEvent(
            what="pop", membrane=0, name="skin", tick=tick, time=tick / 1600, depth=4e-3,
            force_before=0.7, force_after=0.4, drop=0.3,
        )  # fmt: skip

    async def test(hub):
        hub.send(pop(1))
        hub.send(SceneMessage.model_validate({"scene": VIEW, "new_run": True, "run": 0}))
        hub.send(pop(2))
        hub.send(SceneMessage.model_validate({"scene": VIEW, "new_run": False, "run": 0}))
        told = [json.loads(data) for data in await all_of(hub.join(hello))]
        kinds = [message["kind"] for message in told]
        assert [message["tick"] for message in told if message["kind"] == "event"] == [2]
        assert kinds.index("scene") < kinds.index("event")

    run(test)


def test_each_is_told_its_own_losses():
    spread = {"p50": 0.0, "p99": 0.0, "p99_9": 0.0, "largest": 0.0, "edges": [0.0], "counts": []}
    health = {
        "ticks": 0, "late": 0, "lost": 0, "period": spread, "compute": spread, "viewers": 0, "dropped": 0,
        "armed": True, "hand": "target", "compare": False, "statements": [], "second": None,
    }  # fmt: skip

    async def test(hub):
        viewer = hub.join(hello)
        for _ in range(MOST + 1):
            hub.frame(FRAME)
        other = hub.join(hello)
        hub.send(Health.model_validate(health))
        assert f'"viewers":2,"dropped":{MOST}' in (await all_of(viewer))[-1]
        assert '"viewers":2,"dropped":0' in (await all_of(other))[-1]

    run(test)
