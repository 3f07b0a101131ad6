"""The protocol between the studio's server and its page: ticks as binary frames, everything else as JSON."""

from punctura.studio.wire.frames import Frame, FrameError, decode_ticks, encode_ticks
from punctura.studio.wire.messages import PROTOCOL, Message, parse_request

__all__ = ["PROTOCOL", "Frame", "FrameError", "Message", "decode_ticks", "encode_ticks", "parse_request"]
