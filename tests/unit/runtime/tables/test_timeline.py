"""Times of recordings as one line: the same however the recordings are cut into stretches."""

from io import BytesIO

import pytest
from busservo import recordings
from busservo._library import CODEC
from framewire.tables.by_entry import events_by_entry
from framewire.tables.stats.timeline import Clockwork, Timeline

RECORDING = """\
# recorded of 'a line' from 2026-01-02 09:08:07.250000 +0000 on
55 55 02 07  # 3.000000 s, host: ActionGroupStop()
55 55 02 07  # 10.000000 s, host: ActionGroupStop()
55 55 02 07  # 4.500000 s, host: ActionGroupStop()
55 55 02 07  # 10.250000 s, host: ActionGroupStop()
55 55 02 07  # 9.750000 s, host: ActionGroupStop()
55 55 02 07  # 11.000000 s, host: ActionGroupStop()
# recorded of 'a line' from 2026-01-03 09:08:07.250000 +0000 on
55 55 02 07  # 1.000000 s, host: ActionGroupStop()
55 55 02 07  # 0.500000 s, host: ActionGroupStop()
55 55 02 07  # 1.500000 s, host: ActionGroupStop()
"""


@pytest.mark.parametrize("many", [1, 2, 3, 4, 5, 100])
def test_times_that_go_back_stand_still_until_they_are_reached(many: int) -> None:
    clockwork, timeline = Clockwork(), Timeline()
    seconds: list[float] = []
    recording: list[int] = []
    for stretch in events_by_entry(CODEC, recordings.read(BytesIO(RECORDING.encode())), many):
        moments = clockwork.moments(stretch)
        assert moments is not None
        timeline.add(stretch, moments)
        seconds += moments.seconds.tolist()
        recording += moments.recording.tolist()
    assert seconds == [3.0, 10.0, 10.0, 10.25, 10.25, 11.0, 11.0, 11.0, 11.5]
    assert recording == [0, 0, 0, 0, 0, 0, 1, 1, 1]
    assert (timeline.first, timeline.last, timeline.recordings) == (3.0, 11.5, 2)
    assert [(each.seconds, each.time, each.offset) for each in timeline.silences] == [
        (7.0, 3.0, 4),
        (0.75, 10.25, 20),
        (0.5, 11.0, 32),
        (0.25, 10.0, 12),
    ]
