"""The stream decoder and `decode` of every spec say what the reference says, cut in any way."""

from __future__ import annotations

import importlib
import importlib.util
import sys
from functools import cache
from itertools import pairwise
from typing import TYPE_CHECKING, Any

import pytest
from framegen.model.codec import NotAFrame
from framegen.model.codec import decode as reference_decode
from framegen.model.stream import Event, Line, joined
from hypothesis import given
from hypothesis import strategies as st

from tests.specimens import BUSSERVO, DEMO, files_of, model_of
