"""What a participant reads beside the protocol's own texts, and its checks."""

import re
from collections.abc import Iterable, Iterator

from punctura.errors import Problem
from punctura.files.fields import Text
from punctura.files.tables import Table


class WordsTable(Table):
    """Each sentence and each answer of a session, in English if left out. A text in braces is filled in."""

    agree: Text = "Do you agree?"
    full_word: Text = "Type {yes} or {no}, then Enter"
    declined: Text = "Then there is no session. Thank you."
    unfelt: Text = "No haptic device: the simulated one is used, and no hand feels a force."
    begins: Text = "The session begins."  # without an instruction
    resumed: Text = "{done} of {trials} trials are done."
    go_on: Text = "Go on"
    wait: Text = "Hold the needle in front of the tissue."
    trial: Text = "Trial {trial} of {trials}: {stroke}"
    interval: Text = "Trial {trial} of {trials}, interval {interval}: {stroke}"
    practice: Text = "Practice."
    stroke: Text = "push the needle through the tissue, then draw it out."
    deeper: Text = "Not through yet: push deeper."
    right: Text = "Right."
    wrong: Text = "No, it was another one."
    block: Text = "A block is over."
    rest: Text = "Rest for at least {seconds} s."
    early: Text = "The needle was in the tissue too early."  # this and the next seven: why a trial is repeated
    weak: Text = "The force was not on yet: wait a moment before you push."
    short: Text = "The needle did not go through the tissue."
    cut: Text = "The device could not give the whole force: push more slowly, and rest a moment."
    off: Text = "The force was turned off."
    fault: Text = "The device has stopped its force. If that happens again, please call the experimenter."
    failed: Text = "Something went wrong, but not by you. If that happens again, please call the experimenter."
    unmasked: Text = "The masking noise did not play: touch the page, or press a key."
    repeated: Text = "The trial is repeated."
    back: Text = "The force comes back when you go on."
    paused: Text = "The session has paused. Please call the experimenter."
    last: Text = "That was the last trial. Thank you."
    force_off: Text = "Force off (Esc)"
    sound: Text = "Press a key or touch the page for the sound."
    gone: Text = "The studio is not connected."
    number: Text = "A number above 0, then Enter"
    yes: Text = "yes"
    no: Text = "no"
    first: Text = "first"
    second: Text = "second"
    third: Text = "third"
    less: Text = "less"
    more: Text = "more"
    equal: Text = "equal"


def plain(text: str) -> str:
    """As texts are compared: typed ones may have another case."""
    return text.strip().casefold()


def problems_of(words: WordsTable, answers: Iterable[str]) -> Iterator[Problem]:
    """An empty text, braces that nothing fills in, and two answers that read the same."""
    for key, field in WordsTable.model_fields.items():
        text, filled = getattr(words, key), re.findall(r"{(\w+)}", field.default)
        if set("{}") & set(re.sub("|".join(["{{", "}}", *(f"{{{name}}}" for name in filled)]), "", text)):
            allowed = " and ".join(f"{{{name}}}" for name in filled) or "no braces"
            yield Problem(f"words.{key}", text, f"may have {allowed}, and no other text in braces")
        if not text.strip():
            yield Problem(f"words.{key}", text, "must not be empty: leave it out for English")
    read: dict[str, str] = {}
    for key in answers:
        text = plain(getattr(words, key))
        if text in read:
            yield Problem(f"words.{key}", text, f"is what {read[text]} reads, too; give each answer its own")
        read.setdefault(text, key)
