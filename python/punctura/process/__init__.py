"""The process that runs Punctura: signals that end it, and streams that never make it wait."""
