"""Stand-ins for two messages of geometry_msgs, with the fields that the node uses."""

from types import SimpleNamespace

from builtin_interfaces.msg import Time


def _header() -> SimpleNamespace:
    return SimpleNamespace(stamp=Time(), frame_id="")


class PoseStamped:
    def __init__(self) -> None:
        self.header = _header()
        position = SimpleNamespace(x=0.0, y=0.0, z=0.0)
        self.pose = SimpleNamespace(position=position, orientation=SimpleNamespace(x=0.0, y=0.0, z=0.0, w=1.0))


class WrenchStamped:
    def __init__(self) -> None:
        self.header = _header()
        force, torque = (SimpleNamespace(x=0.0, y=0.0, z=0.0) for _ in range(2))
        self.wrench = SimpleNamespace(force=force, torque=torque)
