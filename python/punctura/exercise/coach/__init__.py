"""The coach: what went well in an attempt, and what to change next time, from measured numbers (docs/exercises.md)."""
