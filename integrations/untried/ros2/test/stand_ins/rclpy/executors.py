"""A stand-in for rclpy's executors."""


class ExternalShutdownException(Exception):
    """The program was told to end."""
